//! A path that stands in an answer of before, with what its certificate claims.

use super::answer::{ANSWER_SCHEMA, EscapeRecord};
use super::motion_record::MotionRecord;
use super::path_document::{PathDocument, PoseRecord};
use super::request_document::RequestDocument;
use crate::geometry::{Pose2, angle_difference};
use crate::path::CurvePath;
use crate::planner::Escape;
use crate::scenario::{Request, ScenarioError, StartContact, StartHeading};
use thiserror::Error;

/// The part of a stored answer that `check` needs.
#[derive(Clone, Debug)]
pub struct StoredPath {
    /// The path, from its segments.
    pub path: CurvePath,
    /// The request that it answered, if that is on record.
    pub request: Option<Request>,
    /// The drive out of contact before it, if there is one; the request then begins where it ends.
    pub escape: Option<Escape>,
    /// The sampled poses on record; followers drive these, so they too need a look.
    pub poses: Vec<PoseRecord>,
    /// Hashes of its certificate, if it has one.
    pub hashes: Option<CertificateHashes>,
    /// Numbers of its certificate, if it has one.
    pub numbers: Option<CertificateNumbers>,
    /// The drive in time on record, if there is one.
    pub motion: Option<MotionRecord>,
}

/// The numbers that a certificate claims about a path.
#[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize)]
pub struct CertificateNumbers {
    /// True where the path can be driven.
    pub valid: bool,
    /// Least clearance, meters.
    pub min_clearance_m: f64,
    /// Largest curvature, 1/m.
    pub max_curvature_per_m: f64,
    /// Distance from the goal, meters.
    pub goal_error_m: f64,
    /// Angle from the goal heading, radians.
    pub goal_error_rad: f64,
}

/// The hashes of everything that a certificate vouches for.
#[derive(Clone, Debug, PartialEq, Eq, serde::Deserialize)]
pub struct CertificateHashes {
    /// Hash of the map.
    pub map_hash: String,
    /// Hash of the vehicle.
    pub vehicle_hash: String,
    /// Hash of the path.
    pub path_hash: String,
}

/// Why an answer cannot be read back.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AnswerError {
    /// No JSON, or not this document.
    #[error("no answer document: {0}; hint: it is written by `plan --json` or `plan --out F.json`")]
    Json(serde_json::Error),
    /// Another document, or another version of it.
    #[error("schema {found:?}; this version reads {ANSWER_SCHEMA:?}")]
    Schema {
        /// The schema found.
        found: String,
    },
    /// An answer without a path.
    #[error("the answer holds no path; its status is {status:?}")]
    NoPath {
        /// Its status.
        status: String,
    },
    /// The request on record makes no sense.
    #[error("the answer's request: {0}")]
    Request(#[from] ScenarioError),
}

impl StoredPath {
    /// Reads the path of an answer document. Nothing about the path is believed: the judge has
    /// yet to see it.
    ///
    /// # Errors
    /// Not an answer document of this version, or one without a path.
    pub fn from_json(text: &str) -> Result<Self, AnswerError> {
        let stored: StoredAnswer = serde_json::from_str(text).map_err(AnswerError::Json)?;
        if stored.schema != ANSWER_SCHEMA {
            return Err(AnswerError::Schema {
                found: stored.schema,
            });
        }
        let path = stored.path.as_ref().and_then(PathDocument::curve_path);
        let (hashes, numbers) = match stored.certificate {
            Some(certificate) => (Some(certificate.hashes), Some(certificate.numbers)),
            None => (None, None),
        };
        let request = stored.provenance.and_then(|p| p.request);
        let defaults = RequestDocument::default();
        let request = request.map(|r| r.recorded_onto(&defaults)).transpose()?;
        let escape = stored.escape.and_then(|record| {
            let (n_cells, path) = (record.n_cells, record.path.curve_path()?);
            Some(Escape { path, n_cells })
        });
        // A drive that begins elsewhere leads nowhere: the path is then judged from the start.
        let is_of = |request: &Request| {
            let escape = escape
                .as_ref()
                .filter(|_| request.start_contact == StartContact::Escape);
            escape
                .filter(|escape| is_same(escape.path.start(), request.start))
                .map(|e| e.path.end())
        };
        let request = request.map(|request| match is_of(&request) {
            Some(start) => Request {
                start,
                start_heading: StartHeading::Exact,
                ..request
            },
            None => request,
        });
        Ok(Self {
            path: path.ok_or(AnswerError::NoPath {
                status: stored.status,
            })?,
            request,
            escape,
            poses: stored.path.map(|path| path.poses).unwrap_or_default(),
            hashes,
            numbers,
            motion: stored.motion,
        })
    }
}

/// True for poses that differ by rounding.
fn is_same(a: Pose2, b: Pose2) -> bool {
    const TOLERANCE: f64 = 1e-6;
    a.position().distance(b.position()) <= TOLERANCE
        && angle_difference(a.heading, b.heading).abs() <= TOLERANCE
}

#[derive(serde::Deserialize)]
struct StoredAnswer {
    schema: String,
    status: String,
    path: Option<PathDocument>,
    escape: Option<EscapeRecord>,
    certificate: Option<StoredCertificate>,
    motion: Option<MotionRecord>,
    provenance: Option<StoredProvenance>,
}

#[derive(serde::Deserialize)]
struct StoredCertificate {
    #[serde(flatten)]
    hashes: CertificateHashes,
    #[serde(flatten)]
    numbers: CertificateNumbers,
}

#[derive(serde::Deserialize)]
struct StoredProvenance {
    request: Option<RequestDocument>,
}

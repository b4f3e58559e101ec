//! A path read from a file: an answer of ours, or samples from any source.

use crate::files;
use anyhow::{Context, Result, anyhow};
use formicar::collision::ObstacleMap;
use formicar::path::CurvePath;
use formicar::planner::{
    CertificateHashes, CertificateNumbers, Escape, MotionRecord, PoseRecord, StoredPath,
};
use formicar::scenario::Request;
use formicar::validation::{
    CURVATURE_TOLERANCE, FOREIGN_CURVATURE_SLACK, ForeignPath, ReadSamples, Report, judge,
    judge_path,
};
use formicar::vehicle::Vehicle;
use serde::Serialize;
use std::path::Path;

/// The kind of a path file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Source {
    /// The segments of an answer.
    Segments,
    /// Poses with headings: arcs and gears reconstructed.
    Poses,
    /// Points without headings: headings, arcs and gears reconstructed.
    Points,
}

/// A path and the record that its file holds about it.
pub(crate) struct PathFile {
    path: ForeignPath,
    pub(crate) source: Source,
    /// What of the file was read, in words.
    pub(crate) reading: String,
    /// Advice for a reader who expected another reading.
    pub(crate) hint: Option<&'static str>,
    pub(crate) sample_deviation_m: f64,
    request: Option<Request>,
    /// The drive out of contact before the path of an answer.
    pub(crate) escape: Option<Escape>,
    pub(crate) poses: Option<Vec<PoseRecord>>,
    pub(crate) hashes: Option<CertificateHashes>,
    pub(crate) numbers: Option<CertificateNumbers>,
    /// The drive in time of an answer.
    pub(crate) motion: Option<MotionRecord>,
}

/// Reads a path; the name `-` is stdin.
pub(crate) fn read(path: &Path, vehicle: &Vehicle) -> Result<PathFile> {
    let text = files::read_document(path)?;
    let name = || path.display().to_string();
    if is_answer(&text) {
        let stored = StoredPath::from_json(&text).with_context(name)?;
        return Ok(PathFile {
            path: stored.path.into(),
            source: Source::Segments,
            reading: "the segments of an answer".to_owned(),
            hint: None,
            sample_deviation_m: 0.0,
            request: stored.request,
            escape: stored.escape,
            poses: Some(stored.poses),
            hashes: stored.hashes,
            numbers: stored.numbers,
            motion: stored.motion,
        });
    }
    let ReadSamples {
        samples,
        reading,
        hint,
    } = ReadSamples::from_text(&text).with_context(name)?;
    let path = ForeignPath::new(&samples, vehicle.motion());
    Ok(PathFile {
        path: path.ok_or_else(|| anyhow!("no poses")).with_context(name)?,
        source: match samples.headings {
            Some(_) => Source::Poses,
            None => Source::Points,
        },
        reading,
        hint,
        sample_deviation_m: samples.deviation_m(),
        request: None,
        escape: None,
        poses: None,
        hashes: None,
        numbers: None,
        motion: None,
    })
}

/// True for a JSON object other than a message of ROS, which has poses at its top.
fn is_answer(text: &str) -> bool {
    #[derive(serde::Deserialize)]
    struct Top {
        schema: Option<serde::de::IgnoredAny>,
        poses: Option<serde::de::IgnoredAny>,
    }
    let is_message = |top: Top| top.schema.is_none() && top.poses.is_some();
    text.trim_start().starts_with('{') && !serde_json::from_str(text).is_ok_and(is_message)
}

impl PathFile {
    /// Share by which the curvature may exceed the vehicle's limit.
    pub(crate) fn curvature_slack(&self) -> f64 {
        match self.source {
            Source::Segments => CURVATURE_TOLERANCE,
            Source::Poses | Source::Points => FOREIGN_CURVATURE_SLACK,
        }
    }

    /// The path of an answer, as it is on record.
    pub(crate) fn recorded_path(&self) -> Option<&CurvePath> {
        (self.source == Source::Segments).then(|| self.path.path())
    }

    /// The path with the judge's findings.
    pub(crate) fn judged(
        &self,
        obstacles: &ObstacleMap,
        vehicle: &Vehicle,
    ) -> (&CurvePath, Report) {
        self.path.judged_by(|path| match &self.request {
            Some(request) => judge(obstacles, vehicle, request, path),
            None => judge_path(obstacles, vehicle, path, self.curvature_slack()),
        })
    }
}

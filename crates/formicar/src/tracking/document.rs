//! A simulated drive as a document.

use super::clearance::DrivenClearance;
use super::config::TrackingConfig;
use super::trace::{TracePoint, Tracking, TrackingStatus, TrackingSummary};

/// Name and version of the document of a drive.
pub const TRACKING_SCHEMA: &str = "formicar/track/1";

/// The document that front ends print about a simulated drive.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TrackingDocument<'a> {
    /// Name and version of this document: `formicar/track/1`.
    pub schema: &'static str,
    /// True if the vehicle arrived and its body touched nothing.
    pub tracked: bool,
    /// The ending of the drive.
    pub status: TrackingStatus,
    /// Every parameter.
    pub config: &'a TrackingConfig,
    /// The drive in numbers.
    pub summary: &'a TrackingSummary,
    /// The clearance of the body.
    pub clearance: &'a DrivenClearance,
    /// The vehicle over time.
    pub trace: &'a [TracePoint],
}

impl Tracking {
    /// The drive as a document.
    pub fn document<'a>(&'a self, clearance: &'a DrivenClearance) -> TrackingDocument<'a> {
        TrackingDocument {
            schema: TRACKING_SCHEMA,
            tracked: self.status == TrackingStatus::Arrived && clearance.contact.is_none(),
            status: self.status,
            config: &self.config,
            summary: &self.summary,
            clearance,
            trace: &self.trace,
        }
    }
}

//! The judge's result: every violation, or a certificate.

use crate::geometry::Pose2;
use std::ops::Deref;

/// The judge's findings on one path; world coordinates.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Report {
    /// True if nothing was violated.
    pub valid: bool,
    /// Least distance from the footprint (with its safety margin) to an occupied cell square or
    /// the map border along the whole swept path; 0 when touching.
    pub min_clearance_m: f64,
    /// The pose where the clearance is least.
    pub tightest: Pose2,
    /// Arc length at that pose.
    pub tightest_s_m: f64,
    /// Largest absolute curvature.
    pub max_curvature_per_m: f64,
    /// Fastest change of the curvature per driven meter along a segment; 0 on lines and arcs, whose
    /// jumps are not counted.
    pub max_curvature_rate_per_m2: f64,
    /// True if the curvature jumps nowhere inside one gear. Where the vehicle stands, at a change
    /// of gear and at both ends, its wheels may turn.
    pub is_curvature_continuous: bool,
    /// The goal at which the path ends, or to which it comes nearest: its index among the request's
    /// goals, the first is 0; null where no goal was given.
    pub goal_index: Option<usize>,
    /// Distance of the last pose from that goal; 0 where no goal was given.
    pub goal_error_m: f64,
    /// Heading difference of the last pose from the goal, as the goal-heading mode counts it.
    pub goal_error_rad: f64,
    /// Arc length at which each via point is passed first, in their order, up to the first that
    /// is missed.
    pub via_s_m: Vec<f64>,
    /// The violations, in order of arc length.
    pub violations: Vec<Violation>,
    /// What the findings take as given, in words: doubts about the map file, and the ground that
    /// keep-out maps close; none of most.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Vec::is_empty")
    )]
    pub assumptions: Vec<String>,
    /// Hash of what the judge saw of the map, 32 hexadecimal digits.
    pub map_hash: String,
    /// Hash of what the judge used of the vehicle.
    pub vehicle_hash: String,
    /// Hash of the path.
    pub path_hash: String,
}

/// A violation on a path.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Violation {
    /// The kind of violation.
    pub kind: ViolationKind,
    /// Arc length where it is worst (or where it lies), meters.
    pub s_m: f64,
    /// Pose there.
    pub pose: Pose2,
    /// The value found, in the unit of the limit.
    pub amount: f64,
    /// The value allowed.
    pub limit: f64,
    /// Both as a sentence with units.
    pub message: String,
}

/// Kinds of violations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum ViolationKind {
    /// The body touches an occupied cell.
    Collision,
    /// The body leaves the map.
    LeavesMap,
    /// The curvature exceeds the vehicle's limit.
    Curvature,
    /// The curvature jumps or changes too fast, on a path that was asked to be continuous.
    CurvatureChange,
    /// Two segments do not join.
    Discontinuity,
    /// The path does not begin at the start.
    Start,
    /// The path does not end at the goal.
    Goal,
    /// The path does not pass a via point after the one before it.
    Via,
    /// A gear that the request forbids.
    Gear,
    /// A number that is not finite, or a negative length.
    Malformed,
}

impl ViolationKind {
    /// The kind in words.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Collision => "collision",
            Self::LeavesMap => "out of the map",
            Self::Curvature => "curvature",
            Self::CurvatureChange => "change of curvature",
            Self::Discontinuity => "discontinuity",
            Self::Start => "start",
            Self::Goal => "goal",
            Self::Via => "via point",
            Self::Gear => "gear",
            Self::Malformed => "malformed",
        }
    }
}

impl Violation {
    /// The distance of the value from the one allowed, in the unit of the limit.
    pub fn excess(&self) -> f64 {
        (self.amount - self.limit).abs()
    }
}

/// The judge's proof that a path can be driven. Only the judge makes one.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct Certificate(Report);

impl Report {
    /// The same findings with what they take as given of the map, which the judge does not see.
    #[must_use]
    pub fn assuming(self, assumptions: &[String]) -> Self {
        Self {
            assumptions: assumptions.to_vec(),
            ..self
        }
    }

    /// The certificate, if nothing was violated; otherwise the report back.
    ///
    /// # Errors
    /// The report itself, where something was violated.
    pub fn certify(self) -> Result<Certificate, Box<Self>> {
        if self.valid && self.violations.is_empty() {
            Ok(Certificate(self))
        } else {
            Err(Box::new(self))
        }
    }
}

impl Deref for Certificate {
    type Target = Report;
    fn deref(&self) -> &Report {
        &self.0
    }
}

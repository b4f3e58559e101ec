//! A drive in time, in files.

use crate::motion::{MotionConfig, MotionStatus, ProfileSource};
use crate::path::{CurvePath, Phase, Stop, TimedPath};
use crate::planner::{DriveQuestion, TimedPlan};
use crate::scenario::{MovingError, MovingObstacle, Predictions};
use crate::validation::TimedReport;

/// Name and version of the document of moving obstacles.
pub const MOVING_SCHEMA: &str = "formicar/moving/1";

/// Moving obstacles and how far they are predicted, as a file.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct MovingDocument {
    /// Name and version of this document: `formicar/moving/1`; may be left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Time up to which the motions are predicted, seconds, above 0; from then on obstacles are
    /// taken to stand.
    pub horizon_s: f64,
    /// The obstacles.
    pub obstacles: Vec<MovingObstacle>,
}

impl MovingDocument {
    /// The predictions, checked.
    ///
    /// # Errors
    /// As [`Predictions::new`].
    pub fn predictions(&self) -> Result<Predictions, MovingError> {
        Predictions::new(self.obstacles.clone(), self.horizon_s)
    }
}

impl From<&Predictions> for MovingDocument {
    fn from(predictions: &Predictions) -> Self {
        let obstacles = predictions.obstacles().iter();
        Self {
            schema: Some(MOVING_SCHEMA.to_owned()),
            horizon_s: predictions.horizon_s(),
            obstacles: obstacles.map(|o| o.source().clone()).collect(),
        }
    }
}

/// A drive along the path of an answer.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct MotionRecord {
    /// `arrives`, or `waits` before an obstacle that stays in the way; missing where there is no
    /// drive.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub status: Option<MotionStatus>,
    /// Why there is no drive; missing where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Limits, present speed and distance to be kept.
    pub config: MotionConfig,
    /// The moving obstacles.
    pub moving: MovingDocument,
    /// The file of the speed zones; missing without any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed_zones: Option<String>,
    /// The profile in numbers; missing where there is no drive.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<ProfileRecord>,
    /// The judge's findings on the drive; missing where there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certificate: Option<TimedReport>,
}

/// A profile of arc length over time.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ProfileRecord {
    /// Where it comes from: `fastest` where nothing is in the way, or `lattice`.
    pub source: ProfileSource,
    /// Time of the drive, seconds.
    pub duration_s: f64,
    /// Time of the drive where nothing is in the way, seconds.
    pub unhindered_s: f64,
    /// The places where the vehicle stands for a while.
    pub stops: Vec<Stop>,
    /// The phases: within each the jerk is constant.
    pub phases: Vec<Phase>,
}

impl MotionRecord {
    /// The record of a drive.
    pub fn new(question: &DriveQuestion, plan: &TimedPlan) -> Self {
        let (motion, timed) = (&plan.motion, &plan.motion.timed);
        Self {
            status: Some(motion.status),
            profile: Some(ProfileRecord {
                source: motion.source,
                duration_s: timed.duration_s(),
                unhindered_s: motion.unhindered_s,
                stops: timed.stops(),
                phases: timed.phases().to_vec(),
            }),
            certificate: Some((*plan.certificate).clone()),
            ..Self::refused(question, None)
        }
    }

    /// The record of a drive that there is not, and why.
    pub fn refused(question: &DriveQuestion, reason: Option<String>) -> Self {
        Self {
            status: None,
            reason,
            config: question.config.clone(),
            moving: question.predictions.into(),
            speed_zones: None,
            profile: None,
            certificate: None,
        }
    }

    /// The same with the file of its speed zones.
    #[must_use]
    pub fn with_speed_zones(self, speed_zones: Option<String>) -> Self {
        Self {
            speed_zones,
            ..self
        }
    }

    /// The drive along the path that it was recorded with; none where there is no drive.
    pub fn timed(&self, path: &CurvePath) -> Option<TimedPath> {
        let profile = self.profile.as_ref()?;
        Some(TimedPath::new(path.clone(), profile.phases.clone()))
    }
}

//! Control laws for the steering.

use super::view::View;
use super::{MpcParameters, PurePursuit, RegulatedPurePursuit, Stanley};
use crate::parameters::{OutOfRange, Parameters};

/// What turns the wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(tag = "law", rename_all = "kebab-case"))]
pub enum Controller {
    /// The path's own steering angle over the driven length: nobody looks where the vehicle is.
    OpenLoop,
    /// Steers along the circle to a point ahead on the path.
    PurePursuit(PurePursuit),
    /// Points the front wheels along the path, and towards it where the front axle is off it.
    Stanley(Stanley),
    /// Pure pursuit that slows down in turns, near obstacles and toward stops; in time alone.
    RegulatedPurePursuit(RegulatedPurePursuit),
    /// Looks ahead with a model of the vehicle; in time alone.
    Mpc(MpcParameters),
}

impl Default for Controller {
    fn default() -> Self {
        Self::Stanley(Stanley::default())
    }
}

impl Parameters for Controller {
    fn check(&self) -> Result<(), OutOfRange> {
        match self {
            Self::OpenLoop => Ok(()),
            Self::PurePursuit(law) => law.check(),
            Self::Stanley(law) => law.check(),
            Self::RegulatedPurePursuit(law) => law.check(),
            Self::Mpc(parameters) => parameters.check(),
        }
    }
}

impl Controller {
    /// The word for the law, as in files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::OpenLoop => "open-loop",
            Self::PurePursuit(_) => "pure-pursuit",
            Self::Stanley(_) => "stanley",
            Self::RegulatedPurePursuit(_) => "regulated-pure-pursuit",
            Self::Mpc(_) => "mpc",
        }
    }

    /// The steering angle that the law asks for, radians, whatever the vehicle can do.
    pub(super) fn steer_rad(&self, view: &View) -> f64 {
        match self {
            // Those that need a speed of their own steer by the path where they are asked for an angle
            // alone; drives at one speed refuse them.
            Self::OpenLoop | Self::RegulatedPurePursuit(_) | Self::Mpc(_) => {
                let curvature_per_m = view.stretch.curvature_at(view.driven_m);
                (view.wheelbase_m * curvature_per_m).atan()
            }
            Self::PurePursuit(law) => law.steer_rad(view),
            Self::Stanley(law) => law.steer_rad(view),
        }
    }

    /// True for a law that needs a timed path: [`track_in_time`](super::track_in_time).
    pub fn needs_time(&self) -> bool {
        matches!(self, Self::RegulatedPurePursuit(_) | Self::Mpc(_))
    }

    pub(super) fn for_wheelbase(self, wheelbase_m: f64) -> Self {
        match self {
            Self::PurePursuit(law) => Self::PurePursuit(law.for_wheelbase(wheelbase_m)),
            Self::RegulatedPurePursuit(law) => {
                Self::RegulatedPurePursuit(law.for_wheelbase(wheelbase_m))
            }
            other => other,
        }
    }
}

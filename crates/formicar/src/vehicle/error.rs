//! Errors in the description of a vehicle.

use crate::geometry::PolygonError;
use crate::parameters::OutOfRange;
use thiserror::Error;

/// An error in the description of a vehicle.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum VehicleError {
    /// A measure outside its range.
    #[error("vehicle {0}")]
    OutOfRange(#[from] OutOfRange),
    /// A measure is missing.
    #[error("vehicle {name} is missing; hint: {hint}")]
    Missing {
        /// The measure.
        name: &'static str,
        /// The measures to give instead.
        hint: &'static str,
    },
    /// Two statements of the steering limit.
    #[error(
        "min_turning_radius_m = {radius_m} and max_steer ({steer_rad} rad, so {implied_m} m) disagree by more than 1 %; hint: give one of them"
    )]
    LimitsDisagree {
        /// Radius given, meters.
        radius_m: f64,
        /// Steering limit given, radians.
        steer_rad: f64,
        /// Radius that the steering limit implies, meters.
        implied_m: f64,
    },
    /// A vehicle without a turning radius.
    #[error(
        "the vehicle turns on the spot ({name} = {value}); formicar plans for steered axles, whose turning radius is above 0"
    )]
    TurnsOnTheSpot {
        /// The measure that says so.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// The footprint is no convex polygon.
    #[error("vehicle footprint: {0}")]
    Footprint(#[from] PolygonError),
    /// The body is given twice.
    #[error("vehicle has a footprint and parts; hint: give one of them")]
    FootprintAndParts,
    /// A part of the body is no convex polygon, or cannot be read.
    #[error("part {number}: {error}")]
    Part {
        /// Its number, the first is 1.
        number: usize,
        /// The problem.
        error: Box<VehicleError>,
    },
    /// The footprint string cannot be read.
    #[error("vehicle footprint: {0}")]
    FootprintText(String),
    /// A preset name that nobody knows.
    #[error("no vehicle preset is named {name:?}; there are {}", super::PRESET_NAMES.join(", "))]
    UnknownPreset {
        /// The name asked for.
        name: String,
    },
}

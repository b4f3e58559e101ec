//! Predictions that make no sense.

use crate::geometry::PolygonError;
use thiserror::Error;

/// An error in the prediction of moving obstacles; `obstacle` is a name, or a number counted from
/// 1.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MovingError {
    /// A number that is infinite or not a number.
    #[error("obstacle {obstacle}: {what} is not finite: {value}")]
    NotFinite {
        /// The obstacle.
        obstacle: String,
        /// The name of the number.
        what: &'static str,
        /// As printed.
        value: String,
    },
    /// A number outside its range.
    #[error("obstacle {obstacle}: {what} = {value}; it must be {range}")]
    OutOfRange {
        /// The obstacle.
        obstacle: String,
        /// The name of the number.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The allowed values.
        range: &'static str,
    },
    /// Corners that are no convex polygon.
    #[error("obstacle {obstacle}: {source}")]
    Shape {
        /// The obstacle.
        obstacle: String,
        /// What is wrong with them.
        source: PolygonError,
    },
    /// Way points whose times do not rise.
    #[error(
        "obstacle {obstacle}: way point {index} is at {t_s} s, the one before it at {before_s} s; hint: times must rise"
    )]
    TimesRunBack {
        /// The obstacle.
        obstacle: String,
        /// Its place in the list, counted from 1.
        index: usize,
        /// Its time, seconds.
        t_s: f64,
        /// The time before it, seconds.
        before_s: f64,
    },
    /// A motion by way points without any.
    #[error("obstacle {obstacle}: no way points; hint: one pose is an obstacle that stands")]
    NoWaypoints {
        /// The obstacle.
        obstacle: String,
    },
    /// More obstacles or way points than are looked at.
    #[error("{n} {what}; at most {limit} are allowed")]
    TooMany {
        /// Obstacles or way points.
        what: &'static str,
        /// How many there are.
        n: usize,
        /// The most that are allowed.
        limit: usize,
    },
    /// A horizon that is none.
    #[error("horizon_s = {value}; it must be above 0 and at most 600 s")]
    Horizon {
        /// Its value.
        value: f64,
    },
    /// An obstacle that is off the map when the prediction begins.
    #[error(
        "obstacle {obstacle} begins at ({x:.3}, {y:.3}) m, off the map; hint: check frame and units, or leave it out until it enters"
    )]
    OffTheMap {
        /// The obstacle.
        obstacle: String,
        /// Meters.
        x: f64,
        /// Meters.
        y: f64,
    },
    /// An obstacle that overlaps the vehicle when the prediction begins.
    #[error(
        "obstacle {obstacle} begins inside the vehicle, which stands at ({x:.3}, {y:.3}) m; hint: take the vehicle's own body out of what its sensors see"
    )]
    InsideTheVehicle {
        /// The obstacle.
        obstacle: String,
        /// The vehicle's place, meters.
        x: f64,
        /// The vehicle's place, meters.
        y: f64,
    },
}

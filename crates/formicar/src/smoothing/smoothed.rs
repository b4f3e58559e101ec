//! The result of smoothing.

use super::two_turning::TwoTurning;
use crate::geometry::Point2;
use crate::path::{CurvePath, WaypointPath};

/// A drivable curve and the polyline that it was made from; world coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Smoothed {
    /// The curve.
    pub path: CurvePath,
    /// The polyline whose corners were rounded.
    pub waypoints: WaypointPath,
    /// Its corners, in order.
    pub corners: Vec<CornerRecord>,
}

/// A corner of the polyline and how it was rounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CornerRecord {
    /// The corner.
    pub place: Point2,
    /// Turn of the polyline, radians, positive left.
    pub turn_rad: f64,
    /// The way in which the corner was made drivable.
    pub rounding: Rounding,
}

/// The way in which a corner was made drivable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rounding {
    /// By two arcs.
    TwoTurning(TwoTurning),
    /// By a Dubins or Reeds-Shepp curve that passes it.
    Curve,
    /// By the B-spline that it is a control point of.
    Spline,
    /// Not at all: a point turns on the spot.
    None,
}

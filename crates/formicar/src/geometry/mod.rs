//! Points, poses, angles, polygons, curves of bounded curvature, splines, clothoids and biarcs in
//! the plane.

mod angle;
mod b_spline;
mod biarc;
mod clothoid;
mod curve;
pub mod dubins;
pub mod joins;
mod point;
mod polygon;
mod pose;
pub mod reeds_shepp;
mod turning_circles;

#[cfg(feature = "serde")]
pub(crate) use angle::MAX_STATED_HEADING_RAD;
pub use angle::{angle_difference, wrap_angle, yaw_of_quaternion};
pub use b_spline::BSpline;
pub use biarc::flattest_biarc;
pub use curve::{Arc, Curve};
pub use point::Point2;
pub use polygon::{ConvexPolygon, PolygonError};
pub use pose::Pose2;

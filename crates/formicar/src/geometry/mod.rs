//! Points, poses, angles, polygons and curves of bounded curvature in the plane.

mod angle;
mod curve;
pub mod dubins;
mod point;
mod polygon;
mod pose;
pub mod reeds_shepp;
mod turning_circles;

pub use angle::{angle_difference, wrap_angle};
pub use curve::{Arc, Curve};
pub use point::Point2;
pub use polygon::{ConvexPolygon, PolygonError};
pub use pose::Pose2;

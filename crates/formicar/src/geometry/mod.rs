//! Points, poses, angles, polygons and curves of bounded curvature in the plane.

mod angle;
mod point;
mod polygon;
mod pose;

pub use angle::{angle_difference, wrap_angle};
pub use point::Point2;
pub use polygon::{ConvexPolygon, PolygonError};
pub use pose::Pose2;

//! The picture of a plan: map, poses, path, swept ground, tightest place and strip charts.

use super::Picture;
use crate::geometry::{Point2, Pose2};
use crate::map::OccupancyGrid;
use crate::path::{CurvePath, Direction};
use crate::vehicle::Vehicle;

/// What the strip charts show at one place of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfilePoint {
    /// Arc length driven so far, metres.
    pub s_m: f64,
    /// Curvature of the rear-axle centre's path, positive left.
    pub curvature_per_m: f64,
    /// Steering angle, where the wheelbase is known.
    pub steer_rad: Option<f64>,
    /// Distance from the footprint to the nearest obstacle; points that are not finite are left out.
    pub clearance_m: f64,
    /// The gear in which the place is reached.
    pub direction: Direction,
}

/// All that the picture of a plan, or of a failure, is made from.
#[derive(Clone, Copy, Debug)]
pub struct PlanPicture<'a> {
    /// The ground.
    pub map: &'a OccupancyGrid,
    /// The vehicle, with its limits and footprint.
    pub vehicle: &'a Vehicle,
    /// Where it stands.
    pub start: Pose2,
    /// Where it should go.
    pub goal: Pose2,
    /// The path, if there is one.
    pub path: Option<&'a CurvePath>,
    /// Values along the path; empty for no charts.
    pub profile: &'a [ProfilePoint],
    /// The tightest place and its clearance in metres.
    pub tightest: Option<(Point2, f64)>,
    /// Heading.
    pub title: &'a str,
    /// Key numbers, or the reason why there is no path.
    pub caption: &'a str,
}

/// The picture of a plan.
pub fn plan_picture(plan: &PlanPicture) -> Picture {
    Picture {
        title: plan.title.to_owned(),
        caption: plan.caption.to_owned(),
    }
}

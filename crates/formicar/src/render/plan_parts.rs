//! What the picture of a plan shows.

use super::ProfilePoint;
use crate::geometry::{Point2, Pose2};
use crate::map::OccupancyGrid;
use crate::path::CurvePath;
use crate::planner::Explanation;
use crate::vehicle::Vehicle;

/// The parts of the picture of a plan, or of a failure.
///
/// [`Plan::picture`](crate::planner::Plan::picture) and
/// [`NotFound::picture`](crate::planner::NotFound::picture) fill them in; for other pictures, end a
/// literal with `..PlanPicture::new(map, vehicle, start, goal)`.
#[derive(Clone, Copy, Debug)]
pub struct PlanPicture<'a> {
    /// The map.
    pub map: &'a OccupancyGrid,
    /// The vehicle, with its limits and footprint.
    pub vehicle: &'a Vehicle,
    /// The start pose.
    pub start: Pose2,
    /// The goal pose.
    pub goal: Pose2,
    /// Other places by name: goals that were not chosen, via points.
    pub places: &'a [(Point2, String)],
    /// The path, if there is one.
    pub path: Option<&'a CurvePath>,
    /// Values along the path; empty for no charts.
    pub profile: &'a [ProfilePoint],
    /// The reason why there is no path: its gap is ringed, its colliding cells are drawn.
    pub failure: Option<&'a Explanation>,
    /// The tightest place and its clearance in meters.
    pub tightest: Option<(Point2, f64)>,
    /// The heading.
    pub title: &'a str,
    /// Key numbers, or the reason why there is no path.
    pub caption: &'a str,
}

impl<'a> PlanPicture<'a> {
    /// A vehicle at its start and its goal on a map, and nothing else.
    pub fn new(map: &'a OccupancyGrid, vehicle: &'a Vehicle, start: Pose2, goal: Pose2) -> Self {
        Self {
            map,
            vehicle,
            start,
            goal,
            places: &[],
            path: None,
            profile: &[],
            failure: None,
            tightest: None,
            title: "",
            caption: "",
        }
    }
}

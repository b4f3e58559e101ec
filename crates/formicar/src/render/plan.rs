//! The picture of a plan: map, poses, path, swept ground, tightest place and strip charts.

use super::style::clearance_label;
use super::{Layout, Picture, PoseMark, ProfilePoint, Scene, focus, strip_charts};
use crate::geometry::{Point2, Pose2};
use crate::map::OccupancyGrid;
use crate::path::CurvePath;
use crate::vehicle::Vehicle;

/// A detail is shown where it enlarges the map at least so many times.
const WORTHWHILE_ENLARGEMENT: f64 = 1.25;

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

/// The picture of a plan, or of a request without one, for a page.
pub fn plan_picture(plan: &PlanPicture) -> Picture {
    plan_picture_in(plan, Layout::Page)
}

/// The picture of a plan, or of a request without one. Where the way is short beside the map, its
/// surroundings alone are shown.
pub fn plan_picture_in(plan: &PlanPicture, layout: Layout) -> Picture {
    let scene = drawn(Scene::part(plan.map, focus::bounds(plan), layout), plan);
    let detail = plan.tightest.and_then(|(place, clearance_m)| {
        let detail = Scene::detail(plan.map, place, detail_half_side_m(plan));
        let heading = format!("tightest place: {}", clearance_label(clearance_m));
        let enlarges = detail.px_per_m() >= WORTHWHILE_ENLARGEMENT * scene.px_per_m();
        enlarges.then(|| (drawn(detail, plan).without_legend(), heading))
    });
    Picture {
        title: plan.title.to_owned(),
        caption: plan.caption.to_owned(),
        scene: Some(scene),
        detail,
        charts: strip_charts(plan.profile, plan.vehicle),
        layout,
    }
}

fn drawn(mut scene: Scene, plan: &PlanPicture) -> Scene {
    if let Some(path) = plan.path {
        scene.swept(path, plan.vehicle).curve(path);
    }
    scene.pose(plan.start, plan.vehicle, PoseMark::Start);
    scene.pose(plan.goal, plan.vehicle, PoseMark::Goal);
    if let Some((place, clearance_m)) = plan.tightest {
        scene.tightest(place, clearance_m);
    }
    scene
}

/// Two vehicles across, and enough cells to recognize the place.
fn detail_half_side_m(plan: &PlanPicture) -> f64 {
    let (low, high) = plan.vehicle.footprint().bounds();
    (1.1 * (high.x - low.x)).max(6.0 * plan.map.frame().resolution_m())
}

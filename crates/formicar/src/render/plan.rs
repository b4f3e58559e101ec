//! The picture of a plan: map, poses, path, swept ground, tightest place and strip charts.

use super::style::clearance_label;
use super::view::frame_bounds;
use super::{CellStyle, Layout, Picture, PoseMark, ProfilePoint, Scene};
use super::{focus, palette, strip_charts};
use crate::geometry::{Point2, Pose2};
use crate::map::{BitGrid, Cell, OccupancyGrid};
use crate::path::CurvePath;
use crate::planner::Explanation;
use crate::vehicle::{Motion, Vehicle};

/// A detail enlarges the map at least so many times.
const ENLARGEMENT: f64 = 1.8;
/// Half the side of a detail, at least, to recognize the place by.
const MIN_HALF_SIDE_CELLS: f64 = 2.0;

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
    /// Other places by name: goals that were not chosen, via points.
    pub places: &'a [(Point2, String)],
    /// The path, if there is one.
    pub path: Option<&'a CurvePath>,
    /// Values along the path; empty for no charts.
    pub profile: &'a [ProfilePoint],
    /// Why there is no path: its gap is ringed, its colliding cells are drawn.
    pub failure: Option<&'a Explanation>,
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
    let scene = drawn(
        Scene::part(plan.map, focus::bounds(plan, layout), layout),
        plan,
    );
    let charts = strip_charts(plan.profile, plan.vehicle);
    let detail = detail(plan, &scene, layout);
    Picture {
        title: plan.title.to_owned(),
        caption: plan.caption.to_owned(),
        scene: Some(scene),
        detail,
        charts,
        layout,
        ..Picture::default()
    }
}

fn drawn(mut scene: Scene, plan: &PlanPicture) -> Scene {
    if let Some(path) = plan.path {
        scene.swept(path, plan.vehicle).curve(path);
    }
    scene.pose(plan.start, plan.vehicle, PoseMark::Start);
    scene.pose(plan.goal, plan.vehicle, PoseMark::Goal);
    if let Some(failure) = plan.failure {
        draw_failure(&mut scene, plan.map, failure);
    }
    for (place, name) in plan.places {
        scene.point(*place, name);
    }
    if let Some((place, clearance_m)) = plan.tightest {
        scene.tightest(place, clearance_m);
    }
    scene
}

/// The cells that a footprint covers, and the gap that is too narrow.
fn draw_failure(scene: &mut Scene, map: &OccupancyGrid, failure: &Explanation) {
    let frame = map.frame();
    if let Some(collision) = &failure.collision {
        let mut cells = BitGrid::new(frame.n_cols(), frame.n_rows());
        let on_map = |&&[col, row]: &&[u32; 2]| {
            (col as usize) < frame.n_cols() && (row as usize) < frame.n_rows()
        };
        for &[col, row] in collision.cells.iter().filter(on_map) {
            cells.insert(Cell::new(col, row));
        }
        let style = CellStyle {
            label: format!("under the {}", collision.end),
            color: palette::LIMIT,
        };
        scene.cells(&cells, &style);
    }
    if let Some(gap) = failure.gap {
        scene.gap(Point2::new(gap.x, gap.y), gap.gap_m);
    }
}

/// The tightest place enlarged, and its heading; a point has no body to look at.
fn detail(plan: &PlanPicture, scene: &Scene, layout: Layout) -> Option<(Scene, String)> {
    let (place, clearance_m) = plan.tightest?;
    if plan.vehicle.motion() == Motion::Point {
        return None;
    }
    let side_px = scene.detail_side_px(layout);
    let (low, high) = plan.vehicle.footprint().bounds();
    // Two vehicles across, or less where the map itself shows that much.
    let enlarged_m = 0.5 * side_px / (ENLARGEMENT * scene.px_per_m());
    let half_side_m = (1.1 * (high.x - low.x)).min(enlarged_m);
    let half_side_m = half_side_m.max(MIN_HALF_SIDE_CELLS * plan.map.frame().resolution_m());
    let half = Point2::new(half_side_m, half_side_m);
    let bounds = focus::within((place - half, place + half), frame_bounds(plan.map.frame()));
    let detail = drawn(Scene::detail(plan.map, bounds, side_px), plan);
    let heading = format!("tightest place: {}", clearance_label(clearance_m));
    Some((detail.without_legend(), heading))
}

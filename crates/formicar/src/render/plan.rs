//! The picture of a plan: map, poses, path, swept ground, tightest place and strip charts.

use super::plan_parts::PlanPicture;
use super::style::clearance_label;
use super::view::frame_bounds;
use super::{CellStyle, Layout, Picture, PoseMark, Scene};
use super::{focus, palette, strip_charts};
use crate::geometry::Point2;
use crate::map::{BitGrid, Cell, OccupancyGrid};
use crate::metrics::PathMetrics;
use crate::planner::{Explanation, NotFound, Plan};
use crate::scenario::Request;
use crate::vehicle::{Motion, Vehicle};

/// A detail enlarges the map at least so many times.
const ENLARGEMENT: f64 = 1.8;
/// Half the side of a detail, at least, to recognize the place by.
const MIN_HALF_SIDE_CELLS: f64 = 2.0;

impl Plan {
    /// The picture of the path on its map, with the tightest place and the key numbers. Title and
    /// caption are fields of the result.
    ///
    /// ```
    /// use formicar::{OccupancyGrid, PlannerConfig, Pose2, Scenario, Seed, Vehicle};
    ///
    /// let map = OccupancyGrid::from_rows(&["..............."; 10], 1.0)?;
    /// let [start, goal] = [3.0, 11.0].map(|x| Pose2::new(x, 5.0, 0.0));
    /// let scenario = Scenario::new(&map, Vehicle::warehouse_amr(), start, goal)?;
    /// let plan = formicar::plan(&scenario, &PlannerConfig::default(), Seed(1), &mut ())?.found()?;
    /// let svg = plan.picture(&map, scenario.vehicle()).to_svg();
    /// assert!(svg.contains("8.00 m, clearance"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn picture(&self, map: &OccupancyGrid, vehicle: &Vehicle) -> Picture {
        let tightest = self.certificate.tightest.position();
        plan_picture(&PlanPicture {
            path: Some(&self.path),
            tightest: Some((tightest, self.certificate.min_clearance_m)),
            caption: &key_numbers(&self.metrics, vehicle),
            ..PlanPicture::new(map, vehicle, self.path.start(), self.path.end())
        })
    }
}

impl NotFound {
    /// The picture of a request without a path: both ends, the obstacle in the way, and the reason.
    pub fn picture(&self, map: &OccupancyGrid, vehicle: &Vehicle, request: &Request) -> Picture {
        plan_picture(&PlanPicture {
            path: self.refused.as_ref().map(|(path, _)| path),
            failure: Some(&self.explanation),
            title: self.status.name(),
            caption: &self.reason,
            ..PlanPicture::new(map, vehicle, request.start, request.goal)
        })
    }
}

/// Length, clearance, largest curvature and number of cusps, in words.
pub(super) fn key_numbers(metrics: &PathMetrics, vehicle: &Vehicle) -> String {
    let mut parts = vec![
        format!("{:.2} m", metrics.length_m),
        format!("clearance {}", clearance_label(metrics.min_clearance_m)),
    ];
    let limit_per_m = vehicle.max_curvature_per_m();
    if limit_per_m.is_finite() {
        let largest_per_m = metrics.max_curvature_per_m;
        parts.push(format!(
            "curvature {largest_per_m:.2} of {limit_per_m:.2} 1/m"
        ));
        let plural = if metrics.n_cusps == 1 { "" } else { "s" };
        parts.push(format!("{} cusp{plural}", metrics.n_cusps));
    }
    parts.join(", ")
}

/// Draws a plan, or a request without one, as a page.
pub fn plan_picture(plan: &PlanPicture) -> Picture {
    plan_picture_in(plan, Layout::Page)
}

/// Draws a plan, or a request without one, in a layout. Where the path is short beside the map,
/// only its surroundings are shown.
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

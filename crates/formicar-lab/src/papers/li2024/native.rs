//! The path that a method found before it was made drivable.

use super::methods::Native;
use crate::papers::experiment::Ground;
use formicar::geometry::{Point2, Pose2};
use formicar::map::Cell;
use formicar::planner::{Outcome, Stages};

/// Its vertices, world coordinates; where a method has none of the kind asked for, those that it
/// has.
pub(super) fn polyline(native: Native, ground: &Ground, outcome: &Outcome) -> Vec<Point2> {
    let stages = outcome.stages();
    let kinds = match native {
        Native::Cells => [
            cells(ground, stages),
            nodes(ground, stages),
            joints(outcome),
        ],
        Native::Nodes => [
            nodes(ground, stages),
            cells(ground, stages),
            joints(outcome),
        ],
        Native::Curve => [
            joints(outcome),
            nodes(ground, stages),
            cells(ground, stages),
        ],
    };
    let found = kinds.into_iter().find(|points| !points.is_empty());
    found.unwrap_or_default()
}

/// Centers of the nodes of the polyline.
pub(super) fn nodes(ground: &Ground, stages: &Stages) -> Vec<Point2> {
    centers(ground, &stages.nodes)
}

fn cells(ground: &Ground, stages: &Stages) -> Vec<Point2> {
    let path = stages.grid_path.as_ref();
    path.map_or(Vec::new(), |path| centers(ground, &path.cells))
}

fn joints(outcome: &Outcome) -> Vec<Point2> {
    let Some((path, _)) = outcome.judged() else {
        return Vec::new();
    };
    let starts = path.segments().iter().map(|segment| segment.start);
    starts.chain([path.end()]).map(Pose2::position).collect()
}

fn centers(ground: &Ground, cells: &[Cell]) -> Vec<Point2> {
    let frame = ground.grid.frame();
    cells.iter().map(|&cell| frame.center(cell)).collect()
}

//! Tolls that teach a goal field, which has no headings, about a vehicle without reverse.

use super::{DriveProblem, FieldGrid};
use crate::geometry::{Point2, Pose2};
use crate::map::Cell;
use crate::search::STRAIGHT_COST;
use crate::vehicle::Gears;
use std::collections::BTreeSet;

/// Half the width of a bar, turning radii: beyond it the vehicle can turn around on either side.
const HALF_RADII: f64 = 3.0;
/// Toll of a cell of a bar, turning radii; a bar is two or three cells deep.
const TOLL_RADII: f64 = 5.0;
/// Depths at which a bar is marked, cells from the end's pose: no diagonal step slips through, and
/// the end's own cell stays free.
const DEPTHS_CELLS: [f64; 4] = [1.5, 2.0, 2.5, 3.0];

/// Tolls on a bar across the front of each goal and the back of the start, where headings are fixed
/// and reverse is not allowed. Without them the field leads to a goal from the wrong side, or out
/// of a start backwards.
pub(super) fn tolls(problem: &DriveProblem, grid: FieldGrid) -> Vec<(Cell, u32)> {
    let FieldGrid {
        resolution_m,
        n_cols,
        n_rows,
    } = grid;
    if problem.gears() != Gears::Forward {
        return Vec::new();
    }
    let radius_m = problem.map().radius_m();
    let are_fixed = |poses: &[Pose2], n_places| poses.len() == n_places;
    let mut bars = Vec::new();
    if are_fixed(problem.goals(), problem.n_goals()) {
        bars.extend(problem.goals().iter().map(|&goal| (goal, resolution_m)));
    }
    if are_fixed(problem.starts(), 1) {
        bars.push((problem.starts()[0], -resolution_m));
    }
    let on_map = |p: Point2| {
        let (col, row) = ((p.x / resolution_m).floor(), (p.y / resolution_m).floor());
        let inside = (0.0..n_cols as f64).contains(&col) && (0.0..n_rows as f64).contains(&row);
        inside.then_some((row as u32, col as u32))
    };
    let cells: BTreeSet<(u32, u32)> = bars
        .into_iter()
        .flat_map(|(pose, ahead_m)| bar(pose, ahead_m, HALF_RADII * radius_m))
        .filter_map(on_map)
        .collect();
    let toll = TOLL_RADII * radius_m / resolution_m * f64::from(STRAIGHT_COST);
    cells
        .into_iter()
        .map(|(row, col)| (Cell::new(col, row), toll as u32))
        .collect()
}

/// Places all over a bar across a heading, a cell of a signed size ahead, half a cell apart.
fn bar(pose: Pose2, ahead_m: f64, half_m: f64) -> impl Iterator<Item = Point2> {
    let step_m = 0.5 * ahead_m.abs();
    let n_beside = (half_m / step_m).ceil() as i64;
    DEPTHS_CELLS.into_iter().flat_map(move |depth| {
        (-n_beside..=n_beside)
            .map(move |i| pose.transform(Point2::new(depth * ahead_m, i as f64 * step_m)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::ObstacleMap;
    use crate::map::OccupancyGrid;
    use crate::objective::DriveCost;
    use crate::progress::Limits;
    use crate::scenario::Request;
    use crate::search::{DrivableMap, Guide, HybridAstarConfig, Inflation};
    use crate::vehicle::Vehicle;
    use std::sync::Arc;

    /// The way along the field from a start to a goal at (15, 15), both with heading 0.
    fn along_field_m(x: f64, gears: Gears) -> f64 {
        let row = ".".repeat(150);
        let map = OccupancyGrid::from_rows(&vec![&row[..]; 150], 0.2).unwrap();
        let obstacles = Arc::new(ObstacleMap::new(&map));
        let config = HybridAstarConfig::default();
        let vehicle = Vehicle::warehouse_amr();
        let map = DrivableMap::new(obstacles, &vehicle, &config).unwrap();
        let cost = DriveCost::default().of_vehicle(&vehicle);
        let start = Pose2::new(x, 15.0, 0.0);
        let request = Request {
            gears,
            ..Request::new(start, Pose2::new(15.0, 15.0, 0.0))
        };
        let problem = DriveProblem::new(&map, &config, &cost, &request);
        let mut nobody = ();
        let mut limits = Limits::new(&mut nobody, None, None);
        let guide = Guide::new(&problem, Inflation::Wide, &mut limits).unwrap();
        let along = guide.unwrap().along_field_m(&problem, start, &mut limits);
        along.unwrap().unwrap()
    }

    #[test]
    fn without_reverse_the_field_leads_around_to_the_back_of_a_goal() {
        let radius_m = Vehicle::warehouse_amr().min_turning_radius_m();
        for gears in [Gears::Forward, Gears::Both] {
            let from_behind_m = along_field_m(10.0, gears);
            assert!(from_behind_m < 5.01, "{gears:?}: {from_behind_m}");
        }
        let from_ahead_m = along_field_m(20.0, Gears::Both);
        assert!(from_ahead_m < 5.01, "{from_ahead_m}");
        let around_m = along_field_m(20.0, Gears::Forward);
        assert!(around_m > 4.0 + HALF_RADII * radius_m, "{around_m}");
    }
}

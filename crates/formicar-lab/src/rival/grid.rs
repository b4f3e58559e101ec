//! A* of the crate `pathfinding` as a rival: the same moves, costs and estimate as our `astar`.

use super::answer::RivalAnswer;
use super::question::{Ask, Question, RivalRequest};
use anyhow::Result;
use formicar::geometry::{Point2, Pose2};
use formicar::map::{
    Cell, DIAGONAL_COST, DiagonalRule, GridFrame, MoveMasks, STEPS, STRAIGHT_COST,
};
use pathfinding::prelude::astar;
use std::time::Instant;

/// The version that `Cargo.lock` holds.
const VERSION: &str = "pathfinding 4.16.0";

/// The crate's answer to a question: a path over cells, for points.
///
/// # Errors
/// A map that is none.
pub fn pathfinding_answer(question: &Question) -> Result<RivalAnswer> {
    let answer = match &question.ask {
        Ask::Version => RivalAnswer {
            status: "ready".to_owned(),
            ..RivalAnswer::default()
        },
        Ask::Plan(request) if request.vehicle.motion == "point" => plan(request)?,
        Ask::Plan(_) => RivalAnswer::without_path(
            "refused",
            "it plans over cells, for points; hint: MovingAI scenarios",
        ),
    };
    Ok(RivalAnswer {
        version: VERSION.to_owned(),
        ..answer
    })
}

fn plan(request: &RivalRequest) -> Result<RivalAnswer> {
    let begun = Instant::now();
    let frame = request.map.frame()?;
    let moves = MoveMasks::new(&request.map.cells()?, DiagonalRule::NoObstacles);
    let map_setup_s = begun.elapsed().as_secs_f64();
    let ends = [request.start, request.goal].map(|[x, y, _]| Point2::new(x, y));
    let is_free = |cell: &Cell| !moves.blocked().get(cell.col as usize, cell.row as usize);
    let [Some(start), Some(goal)] = ends.map(|end| frame.cell_at(end).filter(is_free)) else {
        return Ok(RivalAnswer::without_path(
            "refused",
            "an end is occupied or off the map",
        ));
    };
    let asked = Instant::now();
    let cells = search(&moves, start, goal);
    let query_s = asked.elapsed().as_secs_f64();
    let answer = match cells {
        Some(cells) => RivalAnswer {
            status: "found".to_owned(),
            poses: poses(&frame, ends, &cells),
            first_feasible_s: Some(query_s),
            ..RivalAnswer::default()
        },
        None => RivalAnswer::without_path("not_found", "no way between the cells"),
    };
    Ok(RivalAnswer {
        query_s: Some(query_s),
        map_setup_s: Some(map_setup_s),
        ..answer
    })
}

/// The cheapest way from cell to cell.
fn search(moves: &MoveMasks, start: Cell, goal: Cell) -> Option<Vec<Cell>> {
    let octile = |cell: &Cell| {
        let (dx, dy) = (cell.col.abs_diff(goal.col), cell.row.abs_diff(goal.row));
        dx.max(dy) * STRAIGHT_COST + dx.min(dy) * (DIAGONAL_COST - STRAIGHT_COST)
    };
    let successors = |&cell: &Cell| {
        let mask = moves.moves(cell);
        (0..8).filter(move |i| mask >> i & 1 == 1).map(move |i| {
            let (dx, dy) = STEPS[i];
            let col = cell.col.wrapping_add_signed(dx);
            let to = Cell::new(col, cell.row.wrapping_add_signed(dy));
            (to, [STRAIGHT_COST, DIAGONAL_COST][i % 2])
        })
    };
    astar(&start, successors, octile, |&cell| cell == goal).map(|(cells, _)| cells)
}

/// Centers of cells, between the ends themselves where these lie off their centers.
fn poses(frame: &GridFrame, [start, goal]: [Point2; 2], cells: &[Cell]) -> Vec<Vec<f64>> {
    let centers = cells.iter().map(|&cell| frame.center(cell));
    let mut points: Vec<Point2> = [start].into_iter().chain(centers).chain([goal]).collect();
    points.dedup();
    let points = points.into_iter().map(|point| Pose2::at(point, 0.0));
    points.map(|pose| vec![pose.x, pose.y]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rival::Verdict;
    use formicar::collision::ObstacleMap;
    use formicar::map::OccupancyGrid;
    use formicar::numeric::Seed;
    use formicar::scenario::Request;
    use formicar::vehicle::Vehicle;

    fn asked(rows: &[&str], vehicle: &Vehicle) -> (ObstacleMap, Request, RivalAnswer) {
        let map = ObstacleMap::new(&OccupancyGrid::from_rows(rows, 1.0).unwrap());
        let request = Request::new(Pose2::new(0.5, 0.5, 0.0), Pose2::new(4.5, 0.5, 0.0));
        let question = Question::plan(&map, vehicle, &request, Seed(0));
        let answer = pathfinding_answer(&question).unwrap();
        (map, request, answer)
    }

    #[test]
    fn the_shortest_way_is_valid() {
        let rows = [".....", "..#..", "..#.."];
        let (map, request, answer) = asked(&rows, &Vehicle::point());
        let samples = answer.samples();
        let verdict = Verdict::new(&map, &Vehicle::point(), &request, &samples).unwrap();
        assert_eq!(verdict.reason(), None);
        // No corner is cut: up to the free row, across, and down.
        assert!((verdict.path.length_m() - (4.0 + 2.0 * 2_f64.sqrt())).abs() < 1e-9);
    }

    #[test]
    fn what_it_cannot_do_has_a_word() {
        let rows = ["..#..", "..#..", "..#.."];
        assert_eq!(asked(&rows, &Vehicle::point()).2.status, "not_found");
        assert_eq!(asked(&rows, &Vehicle::sedan()).2.status, "refused");
        assert_eq!(asked(&["#...."], &Vehicle::point()).2.status, "refused");
        let ready = pathfinding_answer(&Question::version()).unwrap();
        assert_eq!(
            (ready.status.as_str(), ready.version.as_str()),
            ("ready", VERSION)
        );
    }

    #[test]
    fn the_version_is_that_of_the_lock_file() {
        let lock = include_str!("../../../../Cargo.lock");
        let (name, version) = VERSION.split_once(' ').unwrap();
        assert!(lock.contains(&format!("name = \"{name}\"\nversion = \"{version}\"")));
    }
}

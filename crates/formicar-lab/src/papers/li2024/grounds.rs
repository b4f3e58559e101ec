//! Grounds of the methods: start heading exact, goal heading any.

use crate::papers::experiment::{Ground, Setup};
use anyhow::{Context, Result};
use formicar::collision::ObstacleMap;
use formicar::map::format::{ReadOptions, read_car_scenarios, read_map};
use formicar::map::{DiagonalRule, MoveMasks};
use formicar::progress::Limits;
use formicar::scenario::{GoalHeading, Request, StartHeading};
use formicar::search::GoalField;
use formicar::vehicle::Vehicle;
use std::path::PathBuf;

/// The generated neighborhood with the route of the paper's length.
const MAP: &str = "li-neighborhood";
/// Length of the paper's route, meters.
const ROUTE_M: f64 = 92.0;
/// The ten scenarios of a neighborhood of the same size, within the folder of data sets.
const HOOD: [&str; 2] = ["car", "hood_800x500.json"];

/// The built-in neighborhood.
pub(super) fn neighborhood() -> Result<Ground> {
    let ground = Ground::builtin(MAP)?;
    Ok(Ground {
        request: Request {
            start_heading: StartHeading::Exact,
            ..ground.request
        },
        ..ground
    })
}

/// The scenarios of the data set, or the path of the missing file. A small setup takes the one
/// whose route is nearest to the paper's.
pub(super) fn hood(setup: &Setup) -> Result<Result<Vec<Ground>, PathBuf>> {
    let path = HOOD
        .iter()
        .fold(setup.data.clone(), |path, part| path.join(part));
    if !path.is_file() {
        return Ok(Err(path));
    }
    let mut grounds = Vec::new();
    for scenario in read_car_scenarios(&path)? {
        grounds.push(Ground {
            grid: read_map(&scenario.map, &ReadOptions::default())?,
            vehicle: Vehicle::new(scenario.vehicle)
                .with_context(|| format!("vehicle of {}", scenario.id))?,
            request: Request {
                goal_heading: GoalHeading::Any,
                ..Request::new(scenario.start, scenario.goal)
            },
            map: scenario.id,
        });
    }
    if setup.scale.is_small {
        let off_m = |ground: &Ground| (shortest_m(ground).unwrap_or(f64::INFINITY) - ROUTE_M).abs();
        grounds.sort_by(|a, b| off_m(a).total_cmp(&off_m(b)));
        grounds.truncate(1);
    }
    Ok(Ok(grounds))
}

/// Length of the shortest way over cells that are half the vehicle's width or more from obstacles;
/// `None` where there is no such way.
pub(super) fn shortest_m(ground: &Ground) -> Option<f64> {
    let obstacles = ObstacleMap::new(&ground.grid);
    let frame = ground.grid.frame();
    let half_width_cells = 0.5 * ground.vehicle.width_m() / frame.resolution_m();
    let grown = obstacles.distance().within(half_width_cells)?;
    let moves = MoveMasks::new(&grown, DiagonalRule::NoObstacles);
    let (start, goal) = (ground.request.start, ground.request.goal);
    let (start, goal) = (
        frame.cell_at(start.position())?,
        frame.cell_at(goal.position())?,
    );
    let mut nobody = ();
    let field = GoalField::new(&moves, &[goal], &mut Limits::new(&mut nobody, None, None));
    Some(field.ok()?.distance_cells(start)? * frame.resolution_m())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::papers::experiment::Scale;

    #[test]
    fn the_route_is_as_long_as_the_papers() {
        let route_m = shortest_m(&neighborhood().unwrap()).unwrap();
        assert!((route_m - ROUTE_M).abs() < 2.0, "{route_m}");
    }

    #[test]
    fn what_is_not_there_is_named() {
        let setup = Setup {
            scale: Scale::QUICK,
            data: PathBuf::from("nowhere"),
            n_jobs: 1,
        };
        let missing = hood(&setup).unwrap().unwrap_err();
        assert!(missing.ends_with("car/hood_800x500.json"));
    }
}

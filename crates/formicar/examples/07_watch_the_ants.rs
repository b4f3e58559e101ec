//! Watching ants: a colony on a grid problem, the iterations kept by an observer, one picture.
//!
//! `cargo run --release -p formicar --example 07_watch_the_ants`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::map::builtin::BuiltinMap;
use formicar::numeric::Seed;
use formicar::planner::{self, PlannerConfig, PlannerName};
use formicar::progress::AntFrames;
use formicar::render::{ColonyPicture, colony_picture};
use formicar::scenario::Scenario;
use formicar::vehicle::Vehicle;
use std::{error::Error, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let problem = BuiltinMap::by_name("lei-map1")?;
    let request = problem.request("across")?;
    let map = problem.grid();
    let scenario = Scenario::new(&map, Vehicle::lei2020(), request.start, request.goal)?;

    // The observer sees every iteration, and keeps some of them: ants, pheromone, numbers.
    let mut ants = AntFrames::new(map.frame().n_cols(), map.frame().n_rows());
    let config = PlannerConfig::of(PlannerName::Lei2020);
    let plan = planner::plan(&scenario, &config, Seed(1), &mut ants)?.found()?;

    for frame in ants.frames().iter().step_by(10) {
        let record = &frame.record;
        let (number, n_arrived) = (record.iteration + 1, record.n_arrived);
        let cost = record.best_so_far_cost.unwrap_or(f64::INFINITY);
        println!("iteration {number}: {n_arrived} ants arrived, best so far {cost:.1}");
    }

    // Handed all frames, the picture shows six of them side by side; here the last alone.
    let last = ants.frames().len().saturating_sub(1);
    let picture = colony_picture(&ColonyPicture {
        map: &map,
        vehicle: scenario.vehicle(),
        start: request.start,
        goal: request.goal,
        stages: &plan.stages,
        frames: &ants.frames()[last..],
        path: Some(&plan.path),
        title: "A colony that found its way",
        caption: &format!("{:.2} m", plan.metrics.length_m),
    });
    fs::create_dir_all("formicar-examples")?;
    fs::write("formicar-examples/07_watch_the_ants.svg", picture.to_svg())?;
    Ok(())
}

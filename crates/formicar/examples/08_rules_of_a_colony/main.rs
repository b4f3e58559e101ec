//! Pictures of what the rules of a colony do, each from the engine itself.
//!
//! `cargo run --release -p formicar --example 08_rules_of_a_colony`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

mod histories;
mod maps;

use formicar::colony::{ColonyConfig, ColonyProblem, ColonyRun, run};
use formicar::layers::obstacle_expansion;
use formicar::map::builtin::BuiltinMap;
use formicar::map::{DiagonalRule, MoveMasks, OccupancyGrid};
use formicar::numeric::Seed;
use formicar::progress::Limits;
use std::{error::Error, fs};

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    fs::create_dir_all("formicar-examples/rules")?;
    for (name, picture) in [
        ("heuristic", maps::heuristic()?),
        ("initial-pheromone", maps::initial_pheromone()?),
        ("transition", maps::transition()?),
        ("dead-ends", histories::dead_ends()?),
        ("evaporation", histories::evaporation()),
        ("deposit", histories::deposit()?),
        ("limits", histories::limits()?),
    ] {
        println!("{name}: {}", picture.caption);
        let file = format!("formicar-examples/rules/{name}.svg");
        fs::write(file, picture.to_svg())?;
    }
    Ok(())
}

/// A built-in map and its first request, with obstacles grown by some cells.
fn ground(name: &str, n_grown: u32) -> Outcome<(OccupancyGrid, ColonyProblem)> {
    let builtin = BuiltinMap::by_name(name)?;
    let (map, request) = (builtin.grid(), builtin.requests[0]);
    let mut blocked = map.lethal_cells();
    blocked.unite(&obstacle_expansion(&map.lethal_cells(), n_grown));
    let moves = MoveMasks::new(&blocked, DiagonalRule::NoObstacles);
    let cell = |position| map.frame().cell_at(position).ok_or("off the map");
    let (start, goal) = (
        cell(request.start.position())?,
        cell(request.goal.position())?,
    );
    Ok((map, ColonyProblem::new(moves, start, goal)))
}

fn send(problem: &ColonyProblem, config: &ColonyConfig) -> Outcome<ColonyRun> {
    let mut nobody = ();
    let mut limits = Limits::new(&mut nobody, None, None);
    Ok(run(problem, config, Seed(0), 1, &mut limits)?)
}

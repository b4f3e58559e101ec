//! A grid path made drivable: redundant nodes go, corners are rounded, headings are joined.
//!
//! `cargo run --release -p formicar --example 05_round_corners`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::collision::ObstacleMap;
use formicar::map::{Cell, DiagonalRule, MoveMasks, builtin::BuiltinMap};
use formicar::progress::Limits;
use formicar::render::{Picture, PoseMark, Scene};
use formicar::scenario::Request;
use formicar::search::{AstarWorkspace, astar};
use formicar::smoothing::{RedundantNodes, SmoothingConfig, SmoothingProblem, smooth};
use formicar::vehicle::Vehicle;
use std::{error::Error, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let builtin = BuiltinMap::by_name("lei-map1")?;
    let (map, vehicle) = (builtin.grid(), Vehicle::lei2020());
    let ends = builtin.request("across")?;
    let (start, goal) = (ends.start, ends.goal);

    // Obstacles grow by one cell, half the vehicle's width.
    let obstacles = ObstacleMap::new(&map);
    let blocked = obstacles.distance().within(1.0).ok_or("one cell")?;
    let rule = DiagonalRule::NoObstacles;
    let moves = MoveMasks::new(&blocked, rule);
    let [from, to] = [start, goal].map(|pose| map.frame().cell_at(pose.position()));
    let (from, to): (Cell, Cell) = from.zip(to).ok_or("ends on the map")?;
    let mut nobody = ();
    let mut limits = Limits::new(&mut nobody, None, None);
    let found = astar(&moves, from, to, &mut AstarWorkspace::new(), &mut limits)?;

    let nodes = RedundantNodes::Remove.apply(&blocked, rule, &found.path);
    let problem = SmoothingProblem {
        obstacles: &obstacles,
        vehicle: &vehicle,
        blocked: &blocked,
        rule,
    };
    let request = Request::new(start, goal);
    let smoothed = smooth(&problem, &SmoothingConfig::default(), &request, &nodes)?;
    let (n_cells, n_nodes) = (found.path.cells.len(), nodes.len());
    println!("{n_cells} nodes before, {n_nodes} after");

    let mut scene = Scene::new(&map);
    scene.swept(&smoothed.path, &vehicle).grid_path(&found.path);
    scene.waypoint_path(&smoothed.waypoints);
    scene.curve(&smoothed.path);
    scene.pose(start, &vehicle, PoseMark::Start);
    scene.pose(goal, &vehicle, PoseMark::Goal);
    let picture = Picture {
        title: format!("{n_cells} nodes before, {n_nodes} after"),
        scene: Some(scene),
        ..Picture::default()
    };
    fs::create_dir_all("formicar-examples")?;
    fs::write("formicar-examples/05_round_corners.svg", picture.to_svg())?;
    Ok(())
}

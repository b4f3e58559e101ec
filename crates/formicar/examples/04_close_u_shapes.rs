//! Where ants may walk: obstacles expanded by half the vehicle's width, U-shapes closed.
//!
//! `cargo run --release -p formicar --example 04_close_u_shapes`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::geometry::Pose2;
use formicar::layers::{Expansion, Layers, LayersConfig, PocketFate, UShapes};
use formicar::map::builtin::BuiltinMap;
use formicar::map::{BitGrid, Cell, DiagonalRule, MoveMasks};
use formicar::progress::Limits;
use formicar::render::{CellStyle, Picture, Scene};
use formicar::search::{AstarWorkspace, GridSearch, SearchError, astar};
use std::{error::Error, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let lei_map2 = BuiltinMap::by_name("lei-map2")?;
    let (map, request) = (lei_map2.grid(), lei_map2.request("across")?);
    let cell = |pose: Pose2| map.frame().cell_at(pose.position()).ok_or("off the map");
    let ends = [cell(request.start)?, cell(request.goal)?];

    let config = LayersConfig {
        expansion: Expansion::HalfWidth,
        u_shapes: UShapes::Close,
    };
    // The vehicle is 1 m wide, a cell half of that: two cells.
    let (obstacles, rule) = (map.lethal_cells(), DiagonalRule::default());
    let layers = Layers::new(&obstacles, &config, &ends, rule, 2.0);
    let mut all_open = layers.obstacles.clone();
    all_open.unite(&layers.expanded);
    let before = shortest(&all_open, ends)?;
    let after = shortest(&layers.blocked, ends)?;
    let caption = format!(
        "{} U-shapes of {} cells closed; the shortest way took {:.2} cells and takes {:.2}",
        layers.n_pockets(PocketFate::Closed),
        layers.closed.count(),
        before.length_cells(),
        after.length_cells(),
    );
    println!("{caption}");

    let mut scene = Scene::new(&map);
    scene.cells(&layers.expanded, &CellStyle::expanded());
    scene.cells(&layers.closed, &CellStyle::closed());
    scene.grid_path(&after.path);
    let picture = Picture {
        title: "Where ants may walk".to_owned(),
        caption,
        scene: Some(scene),
        ..Picture::default()
    };
    fs::create_dir_all("formicar-examples")?;
    fs::write("formicar-examples/04_close_u_shapes.svg", picture.to_svg())?;
    Ok(())
}

fn shortest(blocked: &BitGrid, [start, goal]: [Cell; 2]) -> Result<GridSearch, SearchError> {
    let (moves, mut nobody) = (MoveMasks::new(blocked, DiagonalRule::default()), ());
    let mut limits = Limits::new(&mut nobody, None, None);
    astar(&moves, start, goal, &mut AstarWorkspace::new(), &mut limits)
}

//! The judge on a path from elsewhere: poses in, every violation out.
//!
//! `cargo run --release -p formicar --example 03_judge_a_path`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::collision::ObstacleMap;
use formicar::geometry::Pose2;
use formicar::map::OccupancyGrid;
use formicar::render::{Picture, Scene};
use formicar::validation::{FOREIGN_CURVATURE_SLACK, judge_path, path_through_poses};
use formicar::vehicle::Vehicle;
use std::{error::Error, f64::consts::FRAC_PI_2, fs};

/// A corridor with a corner, cells of 1 m.
const CORNER: [&str; 5] = ["###..", "###..", "###..", ".....", "....."];

fn main() -> Result<(), Box<dyn Error>> {
    let map = OccupancyGrid::from_rows(&CORNER, 1.0)?;
    let obstacles = ObstacleMap::new(&map);
    let vehicle = Vehicle::warehouse_amr();
    let mut scene = Scene::new(&map);

    // The first turns tighter than the vehicle can, the last cuts the corner.
    for radius_m in [0.6, 1.4, 3.0] {
        let path = path_through_poses(&around_corner(radius_m), 0.0).ok_or("no poses")?;

        let report = judge_path(&obstacles, &vehicle, &path, FOREIGN_CURVATURE_SLACK);
        match report.violations.first() {
            None => println!("{radius_m} m: clearance {:.3} m", report.min_clearance_m),
            Some(first) => println!("{radius_m} m: {}", first.message),
        }
        let tightest = report.tightest.position();
        scene
            .curve(&path)
            .tightest(tightest, report.min_clearance_m);
    }

    let picture = Picture {
        title: "Three paths around a corner".to_owned(),
        scene: Some(scene),
        ..Picture::default()
    };
    fs::create_dir_all("formicar-examples")?;
    fs::write("formicar-examples/03_judge_a_path.svg", picture.to_svg())?;
    Ok(())
}

/// As another planner might hand it over: straight, a quarter turn, straight again.
fn around_corner(radius_m: f64) -> Vec<Pose2> {
    let turn = (0..=20).map(|i| {
        let angle = FRAC_PI_2 * f64::from(i) / 20.0;
        let x = 4.0 - radius_m + radius_m * angle.sin();
        Pose2::new(x, 1.0 + radius_m - radius_m * angle.cos(), angle)
    });
    let first = Pose2::new(0.8, 1.0, 0.0);
    let last = Pose2::new(4.0, 4.1, FRAC_PI_2);
    [first].into_iter().chain(turn).chain([last]).collect()
}

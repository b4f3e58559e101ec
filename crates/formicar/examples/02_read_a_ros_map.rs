//! A ROS map from disk, one prepared planner, several questions.
//!
//! `cargo run --release -p formicar --example 02_read_a_ros_map`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::geometry::{Point2, Pose2};
use formicar::map::format::write_map;
use formicar::map::{GridFrame, OCCUPIED, OccupancyGrid, UNKNOWN, UnknownPolicy};
use formicar::numeric::Seed;
use formicar::planner::{Outcome, Planner, PlannerConfig};
use formicar::render::{Picture, Scene};
use formicar::scenario::Request;
use formicar::vehicle::Vehicle;
use std::{error::Error, f64::consts::FRAC_PI_2, fs, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new("formicar-examples");
    fs::create_dir_all(folder)?;
    // A little map of our own in place of yours: writes rooms.yaml and rooms.pgm.
    let yaml = folder.join("rooms.yaml");
    let mut rooms = OccupancyGrid::free(GridFrame::new(240, 120, 0.05, Pose2::default())?);
    rooms.fill_polygon(&rectangle([5.6, 0.0], [6.2, 2.6]), OCCUPIED);
    rooms.fill_polygon(&rectangle([5.6, 3.8], [6.2, 6.0]), OCCUPIED);
    rooms.fill_polygon(&rectangle([9.5, 0.0], [12.0, 1.5]), UNKNOWN);
    write_map(&yaml, &rooms)?;

    let map = OccupancyGrid::read_ros_yaml(&yaml)?.with_unknown(UnknownPolicy::Occupied);
    let mut planner = Planner::new(&map, Vehicle::warehouse_amr(), PlannerConfig::default())?;
    let mut scene = Scene::new(&map);
    let start = Pose2::new(1.5, 1.0, FRAC_PI_2);
    let across = Pose2::new(10.0, 4.5, 0.0);
    let turned = Pose2::new(1.5, 1.0, -FRAC_PI_2);
    let unknown = Pose2::new(10.5, 0.8, 0.0);
    for goal in [across, turned, unknown] {
        // A goal that the vehicle cannot stand on is an error; finding no path is an outcome.
        match planner.plan(&Request::new(start, goal), Seed(0), &mut ()) {
            Ok(Outcome::Found(plan)) => {
                println!("found: {:.2} m", plan.metrics.length_m);
                scene.swept(&plan.path, planner.vehicle()).curve(&plan.path);
            }
            Ok(Outcome::NotFound(failure)) => println!("{:?}: {}", failure.status, failure.reason),
            Err(error) => println!("cannot be asked: {error}"),
        }
    }
    let picture = Picture {
        title: "Rooms".to_owned(),
        scene: Some(scene),
        ..Picture::default()
    };
    fs::write(folder.join("02_read_a_ros_map.svg"), picture.to_svg())?;
    Ok(())
}

fn rectangle([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> [Point2; 4] {
    [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| Point2::new(x, y))
}

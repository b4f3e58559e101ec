//! A path that is driven in time: behind a walker and a cart.
//!
//! `cargo run --release -p formicar --example 11_wait_for_a_cart`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::map::builtin::BuiltinMap;
use formicar::motion::MotionConfig;
use formicar::numeric::Seed;
use formicar::planner::{self, DriveQuestion, PlannerConfig, drive_in_time};
use formicar::scenario::{MovingObstacle, ObstacleMotion, ObstacleShape, Predictions, Scenario};
use formicar::vehicle::Vehicle;
use std::{error::Error, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let warehouse = BuiltinMap::by_name("warehouse")?;
    let request = warehouse.request("dock-to-rack")?;
    let (map, vehicle) = (warehouse.grid(), Vehicle::warehouse_amr());
    let scenario = Scenario::new(&map, vehicle.clone(), request.start, request.goal)?;
    let plan = planner::plan(&scenario, &PlannerConfig::default(), Seed(7), &mut ())?.found()?;

    let moving = |shape, pose, velocity_mps| MovingObstacle {
        name: None,
        shape,
        motion: ObstacleMotion::Velocity { pose, velocity_mps },
        growth_mps: 0.01,
    };
    let walker = ObstacleShape::Disc { radius_m: 0.3 };
    let cart = ObstacleShape::Polygon(vec![[-0.5, -0.3], [0.5, -0.3], [0.5, 0.3], [-0.5, 0.3]]);
    let obstacles = vec![
        moving(walker, [4.5, 8.6, 0.0], [0.6, 0.0]),
        moving(cart, [14.0, 16.0, 0.0], [-0.3, 0.0]),
    ];
    let predictions = Predictions::new(obstacles, 40.0)?;
    let config = MotionConfig::default();
    let question = DriveQuestion {
        predictions: &predictions,
        zones: None,
        config: &config,
    };
    let frame = scenario.obstacles().frame();
    let drive = drive_in_time(frame, &vehicle, &plan.path, &question)?;
    println!(
        "{:.1} s, {:.1} s of them for others; never nearer than {:.2} m",
        drive.motion.timed.duration_s(),
        drive.motion.lost_s(),
        drive.certificate.min_distance_m.unwrap_or(f64::INFINITY),
    );

    let picture = plan.picture(&map, &vehicle);
    let picture = picture.with_motion(&drive.motion, &predictions, &vehicle, 1.0);
    fs::create_dir_all("formicar-examples")?;
    fs::write("formicar-examples/11_wait_for_a_cart.svg", picture.to_svg())?;
    Ok(())
}

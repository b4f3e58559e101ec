//! A path that is driven, not only drawn: from a start that is a little off.
//!
//! `cargo run --release -p formicar --example 06_drive_a_path`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::map::builtin::BuiltinMap;
use formicar::numeric::Seed;
use formicar::planner::{self, PlannerConfig};
use formicar::render::{DrivePicture, drive_picture};
use formicar::scenario::Scenario;
use formicar::tracking::{
    Controller, PurePursuit, Stanley, StartOffset, TrackingConfig, TrackingError, track,
};
use formicar::vehicle::Vehicle;
use std::{error::Error, f64::consts::FRAC_PI_4, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let warehouse = BuiltinMap::by_name("warehouse")?;
    let request = warehouse.request("dock-to-rack")?;
    let (map, vehicle) = (warehouse.grid(), Vehicle::warehouse_amr());
    let scenario = Scenario::new(&map, vehicle.clone(), request.start, request.goal)?;
    let plan = planner::plan(&scenario, &PlannerConfig::default(), Seed(7), &mut ())?.found()?;

    // Ten centimeters to the left, looking a little to the right; wheels that take their time.
    let beside = TrackingConfig {
        start_offset: StartOffset {
            lateral_m: 0.1,
            heading_rad: -0.05,
            along_m: 0.0,
        },
        max_steer_rate_rad_per_s: Some(FRAC_PI_4),
        ..TrackingConfig::default()
    };
    let drive_by = |controller: Controller| -> Result<_, TrackingError> {
        let mut config = beside.clone();
        config.controller = controller;
        let drive = track(&plan.path, &vehicle, &config)?;
        let clearance = drive.clearance(scenario.obstacles(), &vehicle);
        let (name, least_m) = (controller.name(), clearance.min_clearance_m);
        println!("{name}: clearance {least_m:.2} m");
        Ok(drive)
    };
    // Nobody looks; the front axle is led back; a point ahead is steered for.
    drive_by(Controller::OpenLoop)?;
    drive_by(Controller::Stanley(Stanley::default()))?;
    let drive = drive_by(Controller::PurePursuit(PurePursuit::default()))?;

    let picture = drive_picture(&DrivePicture {
        map: &map,
        vehicle: &vehicle,
        planned: &plan.path,
        drive: &drive,
        tightest: None,
        title: "A driven path",
        caption: "by pure pursuit",
    });
    fs::create_dir_all("formicar-examples")?;
    fs::write("formicar-examples/06_drive_a_path.svg", picture.to_svg())?;
    Ok(())
}

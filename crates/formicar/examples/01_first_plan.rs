//! A first plan: from a loading dock into a rack aisle of the built-in warehouse.
//!
//! `cargo run --release -p formicar --example 01_first_plan`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::map::builtin::BuiltinMap;
use formicar::numeric::Seed;
use formicar::objective::DriveCost;
use formicar::planner::{self, PlannerConfig};
use formicar::render::{PlanPicture, plan_picture};
use formicar::scenario::Scenario;
use formicar::vehicle::Vehicle;
use std::{error::Error, fs, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    let warehouse = BuiltinMap::by_name("warehouse")?;
    let request = warehouse.request("dock-to-rack")?;
    let map = warehouse.grid();
    let vehicle = Vehicle::warehouse_amr();

    // Map, vehicle, start and goal are checked here: a pose inside a shelf is refused at once.
    let scenario = Scenario::new(&map, vehicle, request.start, request.goal)?;

    // Parameters are plain values: this robot should drive straight and keep its distance.
    let cost = DriveCost {
        bend_weight: 0.2,
        clearance_wish_m: 0.6,
        ..DriveCost::default()
    };
    let config = PlannerConfig {
        cost,
        ..PlannerConfig::default()
    };
    // `()` watches nothing and never cancels; the same seed gives the same path.
    let plan = planner::plan(&scenario, &config, Seed(7), &mut ())?.found()?;

    let caption = format!(
        "{:.2} m, clearance {:.2} m, {} cusps",
        plan.metrics.length_m, plan.certificate.min_clearance_m, plan.metrics.n_cusps
    );
    println!("{caption}");

    let tightest = plan.certificate.tightest.position();
    let picture = plan_picture(&PlanPicture {
        map: &map,
        vehicle: scenario.vehicle(),
        start: request.start,
        goal: request.goal,
        places: &[],
        failure: None,
        path: Some(&plan.path),
        profile: &[],
        tightest: Some((tightest, plan.certificate.min_clearance_m)),
        title: "A first plan",
        caption: &caption,
    });
    let folder = Path::new("formicar-examples");
    fs::create_dir_all(folder)?;
    fs::write(folder.join("01_first_plan.svg"), picture.to_svg())?;
    Ok(())
}

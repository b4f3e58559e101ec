//! A first plan: from a loading dock into a rack aisle of the built-in warehouse.
//!
//! `cargo run --release -p formicar --example 01_first_plan`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::map::builtin::BuiltinMap;
use formicar::objective::DriveCost;
use formicar::planner::FormicarParameters;
use formicar::render::Picture;
use formicar::{PlannerConfig, Scenario, Seed, Vehicle};
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
        clearance_wish_widths: 0.6,
        ..DriveCost::default()
    };
    let config = PlannerConfig::Formicar(FormicarParameters {
        cost,
        ..FormicarParameters::default()
    });
    // `()` watches nothing and never cancels; the same seed gives the same path.
    let plan = formicar::plan(&scenario, &config, Seed(7), &mut ())?.found()?;

    let picture = Picture {
        title: "A first plan".to_owned(),
        ..plan.picture(&map, scenario.vehicle())
    };
    println!("{}", picture.caption);

    let folder = Path::new("formicar-examples");
    fs::create_dir_all(folder)?;
    fs::write(folder.join("01_first_plan.svg"), picture.to_svg())?;
    Ok(())
}

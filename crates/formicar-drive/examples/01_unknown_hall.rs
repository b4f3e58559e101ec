//! A robot drives through a hall that it does not know, among walkers: a picture of the drive.

use formicar::scenario::GoalHeading;
use formicar::{OccupancyGrid, Pose2, Seed, Vehicle};
use formicar_drive::{
    DriveView, Driver, DriverConfig, KnownMap, RunConfig, Simulation, SimulationConfig, World,
    drive, drive_picture, random_walkers,
};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut rows = vec![".".repeat(90); 60];
    for row in rows.iter_mut().take(44) {
        row.replace_range(40..43, "###");
    }
    for row in rows.iter_mut().skip(24) {
        row.replace_range(62..65, "###");
    }
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let map = OccupancyGrid::from_rows(&rows, 0.1)?;
    let (start, goal) = (Pose2::new(0.8, 3.0, 0.0), Pose2::new(8.0, 3.0, 0.0));
    let (vehicle, seed) = (Vehicle::f1tenth(), Seed(3));

    let config = SimulationConfig {
        seed,
        position_noise_m: 0.02,
        heading_noise_rad: 0.017,
        ..SimulationConfig::default()
    };
    let walkers = random_walkers(&map, &vehicle, start, (3, seed));
    let world = World::new(map.clone(), Vec::new());
    let mut robot = Simulation::new(world, &vehicle, start, &config)?.with_agents(walkers)?;
    let known = KnownMap::unknown(*map.frame());
    let driver = DriverConfig {
        goal_heading: GoalHeading::Any,
        ..DriverConfig::for_simulation(&config)
    };
    let mut driver = Driver::new(known, &vehicle, goal, &driver)?;
    let record = drive(&mut robot, &mut driver, &RunConfig::default(), &mut ())?;

    let picture = drive_picture(&DriveView {
        map: &map,
        solids: &[],
        vehicle: &vehicle,
        record: &record,
        title: &format!("A hall that was not known: {}", record.status.name()),
        caption: &format!("{:.1} s, {:.2} m", record.duration_s, record.driven_m),
    });
    let file = std::env::temp_dir().join("01_unknown_hall.svg");
    std::fs::write(&file, picture.to_svg())?;
    println!("{}", file.display());
    Ok(())
}

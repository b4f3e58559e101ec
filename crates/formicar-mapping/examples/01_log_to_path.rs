//! From a lidar log to a map to a certified path.
//!
//! `cargo run --release -p formicar-mapping --example 01_log_to_path [LOG]`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::{PlannerConfig, Pose2, Request, Seed, Vehicle};
use formicar_mapping::log::carmen::parse_carmen;
use formicar_mapping::simulate::{Drive, DriveRule, Office};
use formicar_mapping::{Go, Log, MapReport, Mapper, MappingConfig};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    // A log in CARMEN's format, or the first scans of a drive through a simulated office.
    let log = match std::env::args().nth(1) {
        Some(path) => parse_carmen(&std::fs::read(path)?)?,
        None => simulated(160),
    };

    let mut mapper = Mapper::new(MappingConfig::default())?;
    mapper.resolve_ranges(&log);
    mapper.add_log(&log, |_| true, |_| Go::On)?;
    let built = mapper.finish(|_| Go::On)?;
    for (name, value) in MapReport::new(&mapper, &built).facts() {
        println!("{name:12} {value}");
    }

    // From where the drive began to where the robot was farthest away, on ground that was seen.
    let start = built.trajectory[0];
    let distance = |pose: &&Pose2| pose.position().distance(start.position());
    let farthest = built
        .trajectory
        .iter()
        .max_by(|a, b| distance(a).total_cmp(&distance(b)));
    let goal = farthest.copied().unwrap_or(start);
    let mut planner = formicar::Planner::new(
        &built.grid,
        Vehicle::warehouse_amr(),
        PlannerConfig::default(),
    )?;
    let plan = planner
        .plan(&Request::new(start, goal), Seed(7), &mut ())?
        .found()?;
    println!(
        "path         {:.2} m, clearance {:.2} m, certified",
        plan.metrics.length_m, plan.certificate.min_clearance_m
    );
    Ok(())
}

fn simulated(n_scans: usize) -> Log {
    let drive = Drive::new(&Office::new(Seed(3)), &DriveRule::default());
    let cut = |poses: Option<Vec<Pose2>>| poses.map(|poses| poses[..n_scans].to_vec());
    Log {
        scans: drive.log.scans[..n_scans].to_vec(),
        odometry: cut(drive.log.odometry),
        reference: cut(drive.log.reference),
        ..Log::default()
    }
}

//! Logs of real robots, where they are at hand.
#![allow(
    clippy::print_stdout,
    reason = "a test tells what it skips, and what it measured"
)]

use crate::drives::{first, mapped};
use formicar::collision::ObstacleMap;
use formicar::validation::judge_path;
use formicar::{OccupancyGrid, Planner, PlannerConfig, Pose2, Request, Seed, Vehicle};
use formicar_mapping::evaluate::{neighbor_pairs, relation_errors, trajectory_error};
use formicar_mapping::front_end::Quality;
use formicar_mapping::log::carmen::parse_carmen;
use formicar_mapping::{BuiltMap, Log, Mapper, MappingConfig};
use std::path::Path;

/// A log, if it is at hand.
fn log(name: &str) -> Option<Log> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/lidar");
    let path = folder.join(format!("{name}-corrected.log.gz"));
    let Ok(bytes) = std::fs::read(&path) else {
        println!("skipped: {} is not there", path.display());
        return None;
    };
    Some(parse_carmen(&bytes).unwrap())
}

#[test]
fn the_first_scans_of_the_intel_lab_agree_with_gmapping() {
    let Some(log) = log("intel") else {
        return;
    };
    assert_eq!((log.scans.len(), log.scans[0].ranges_m.len()), (910, 180));
    let log = first(&log, 150);
    let reference = log.reference.clone().unwrap();
    let (mapper, built) = mapped(&log, MappingConfig::default());
    let errors = relation_errors(&built.trajectory, &reference, &neighbor_pairs(150));
    assert!(errors.mean_m < 0.04 && errors.mean_deg < 0.6, "{errors:?}");
    assert!(
        mapper
            .places()
            .iter()
            .all(|place| place.quality != Quality::Lost)
    );
}

/// The map of the same scans at the poses of `GMapping`, carried onto ours by the rigid motion of
/// least squared distances.
fn map_of_gmapping(log: &Log, mapper: &Mapper, built: &BuiltMap) -> OccupancyGrid {
    let reference = log.reference.as_ref().unwrap();
    let onto_ours = trajectory_error(reference, &built.trajectory).alignment;
    let nodes = mapper.nodes().iter();
    let poses: Vec<Pose2> = nodes
        .map(|node| onto_ours.compose(reference[node.scan]))
        .collect();
    mapper.map_at(&poses).unwrap()
}

/// How paths between poses of a drive stand in two maps.
#[derive(Debug, Default)]
struct Stood {
    n_asked: usize,
    n_found: usize,
    n_with_margin: usize,
    n_without_margin: usize,
    least_clearance_m: f64,
}

/// Paths between 20 pairs of poses of the drive at which the vehicle with its margin is free.
fn paths(log: &Log) -> Stood {
    let (mapper, built) = mapped(log, MappingConfig::default());
    let theirs = ObstacleMap::new(&map_of_gmapping(log, &mapper, &built));
    let bare = Vehicle::warehouse_amr();
    let vehicle = bare.with_safety_margin(0.10).unwrap();
    let config = PlannerConfig::default();
    let mut planner = Planner::new(&built.grid, vehicle.clone(), config).unwrap();
    let mut draws = Seed(7).stream([0, 0]);
    let mut stood = Stood {
        least_clearance_m: f64::INFINITY,
        ..Stood::default()
    };
    let mut draw = || built.trajectory[draws.below(built.trajectory.len())];
    while stood.n_asked < 20 {
        let request = Request::new(draw(), draw());
        let Ok(outcome) = planner.plan(&request, Seed(0), &mut ()) else {
            // An end at which the vehicle does not stand freely.
            continue;
        };
        stood.n_asked += 1;
        let Ok(plan) = outcome.found() else {
            continue;
        };
        stood.n_found += 1;
        let is_valid = |vehicle: &Vehicle| judge_path(&theirs, vehicle, &plan.path, 0.0);
        let judged = is_valid(&bare);
        stood.n_with_margin += usize::from(is_valid(&vehicle).valid);
        stood.n_without_margin += usize::from(judged.valid);
        stood.least_clearance_m = stood.least_clearance_m.min(judged.min_clearance_m);
    }
    stood
}

#[test]
fn paths_on_maps_of_real_logs_stand_in_the_map_of_gmapping() {
    if std::env::var_os("FORMICAR_SLOW").is_none() {
        return;
    }
    for name in ["intel", "aces"] {
        let Some(log) = log(name) else {
            return;
        };
        let stood = paths(&log);
        println!("{name}: {stood:?}");
        assert!(stood.n_found >= 18, "{name}: {stood:?}");
        assert_eq!(stood.n_without_margin, stood.n_found, "{name}: {stood:?}");
    }
}

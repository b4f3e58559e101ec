//! The worlds of the BARN challenge (D. Perille, A. Truong, X. Xiao and P. Stone, *Benchmarking
//! Metric Ground Navigation*, SSRR 2020), driven with an unknown map: a line of CSV per drive.
//!
//! `barn WORLDS.json [FIRST..END [FIRST..END [FOLDER]]]`: worlds and seeds, without the last; a folder
//! gets a picture of every drive that fails.

use formicar::map::GridFrame;
use formicar::progress::StdClock;
use formicar::scenario::{GoalHeading, GoalTolerance, ObstacleShape};
use formicar::tracking::Actuators;
use formicar::{OccupancyGrid, Planner, PlannerConfig, Pose2, Request, Seed, Vehicle};
use formicar_drive::{
    Arrival, DriveRecord, DriveView, Driver, DriverConfig, KnownMap, RunConfig, Simulation,
    SimulationConfig, Solid, World, drive, drive_picture,
};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::error::Error;
use std::fs;

const RESOLUTION_M: f64 = 0.05;
const MAX_SPEED_MPS: f64 = 2.0;
const ARRIVES_M: f64 = 1.0;
const MAX_TIME_S: f64 = 100.0;

/// The file: cylinders by world.
#[derive(Deserialize)]
struct Barn {
    radius_m: f64,
    start: [f64; 3],
    goal: [f64; 3],
    worlds: BTreeMap<String, Vec<[f64; 2]>>,
}

struct Case {
    world: World,
    start: Pose2,
    goal: Pose2,
    /// Length of the path on the known map, meters.
    known_m: Option<f64>,
}

impl Barn {
    fn case(&self, cylinders: &[[f64; 2]]) -> Result<Case, Box<dyn Error>> {
        let [start, goal] = [self.start, self.goal].map(|[x, y, h]| Pose2::new(x, y, h));
        let frame = GridFrame::new(160, 340, RESOLUTION_M, Pose2::new(-6.25, -1.5, 0.0))?;
        let shape = ObstacleShape::Disc {
            radius_m: self.radius_m,
        };
        let solids = cylinders
            .iter()
            .map(|&[x, y]| Solid::placed(&shape, Pose2::new(x, y, 0.0)))
            .collect();
        Ok(Case {
            world: World::new(OccupancyGrid::free(frame), solids),
            known_m: self.known_m(frame, cylinders, [start, goal])?,
            start,
            goal,
        })
    }

    /// The length of a path to within the arrival distance, on a map of all cylinders.
    fn known_m(
        &self,
        frame: GridFrame,
        cylinders: &[[f64; 2]],
        [start, goal]: [Pose2; 2],
    ) -> Result<Option<f64>, Box<dyn Error>> {
        let mut map = OccupancyGrid::free(frame);
        for index in 0..frame.n_cells() {
            let center = frame.center(frame.cell(index));
            let touches = |&[x, y]: &[f64; 2]| {
                let apart = center - formicar::Point2::new(x, y);
                let half = 0.5 * RESOLUTION_M;
                let outside = |d: f64| (d.abs() - half).max(0.0);
                outside(apart.x).hypot(outside(apart.y)) <= self.radius_m
            };
            if cylinders.iter().any(touches) {
                map.set(frame.cell(index), 100);
            }
        }
        let mut planner = Planner::new(&map, Vehicle::f1tenth(), PlannerConfig::default())?;
        let request = Request {
            goal_heading: GoalHeading::Any,
            goal_tolerance: GoalTolerance {
                xy_m: ARRIVES_M,
                yaw_rad: 3.2,
            },
            budget_steps: Some(200_000),
            ..Request::new(start, goal)
        };
        let outcome = planner.plan(&request, Seed(1), &mut ())?;
        Ok(outcome.found().ok().map(|plan| plan.path.length_m()))
    }
}

/// The robot of the evidence: 2 m/s, 1.5 m/s^2, wheels of 200 degrees per second, noisy poses.
fn configs(seed: u64) -> (SimulationConfig, DriverConfig) {
    let simulation = SimulationConfig {
        seed: Seed(seed),
        position_noise_m: 0.02,
        heading_noise_rad: 1_f64.to_radians(),
        actuators: Actuators {
            max_acceleration_mps2: Some(1.5),
            max_braking_mps2: Some(1.5),
            ..Actuators::default()
        },
        max_steer_rate_rad_per_s: Some(200_f64.to_radians()),
        ..SimulationConfig::default()
    };
    let driver = DriverConfig {
        max_speed_mps: Some(MAX_SPEED_MPS),
        goal_heading: GoalHeading::Any,
        goal_tolerance: GoalTolerance {
            xy_m: 0.5,
            yaw_rad: 3.2,
        },
        ..DriverConfig::for_simulation(&simulation)
    };
    (simulation, driver)
}

fn driven(case: &Case, seed: u64) -> Result<DriveRecord, Box<dyn Error>> {
    let vehicle = Vehicle::f1tenth();
    let (simulation, driver) = configs(seed);
    let run = RunConfig {
        max_time_s: MAX_TIME_S,
        arrival: Arrival::Within {
            distance_m: ARRIVES_M,
        },
        ..RunConfig::default()
    };
    let known = KnownMap::unknown(*case.world.map().frame());
    let mut robot = Simulation::new(case.world.clone(), &vehicle, case.start, &simulation)?;
    let mut driver = Driver::new(known, &vehicle, case.goal, &driver)?;
    Ok(drive(
        &mut robot,
        &mut driver,
        &run,
        &mut StdClock::start(),
    )?)
}

/// 1[success] x OT / clip(T, 2 OT, 8 OT), OT the time of the known path at top speed.
fn score(case: &Case, record: &DriveRecord) -> f64 {
    let Some(known_m) = case.known_m.filter(|_| record.succeeds()) else {
        return 0.0;
    };
    let best_s = known_m / MAX_SPEED_MPS;
    best_s / record.duration_s.clamp(2.0 * best_s, 8.0 * best_s)
}

fn range(words: &str) -> Result<std::ops::Range<u64>, Box<dyn Error>> {
    let (first, end) = words.split_once("..").ok_or("a range is FIRST..END")?;
    Ok(first.parse()?..end.parse()?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let usage = "barn WORLDS.json [FIRST..END [FIRST..END [FOLDER]]]";
    let file = words.next().ok_or(usage)?;
    let barn: Barn = serde_json::from_str(&fs::read_to_string(file)?)?;
    let worlds = range(&words.next().unwrap_or_else(|| "0..300".to_owned()))?;
    let seeds = range(&words.next().unwrap_or_else(|| "1..2".to_owned()))?;
    let folder = words.next();
    println!(
        "world,seed,status,time_s,driven_m,known_m,score,min_distance_m,max_speed_mps,stops,\
         routes,flips,brakes,recoveries,controller_failures,plan_median_ms,plan_p99_ms,plan_worst_ms,\
         control_median_ms,control_p99_ms,control_worst_ms"
    );
    for world in worlds {
        let Some(cylinders) = barn.worlds.get(&world.to_string()) else {
            continue;
        };
        let case = barn.case(cylinders)?;
        for seed in seeds.clone() {
            let record = driven(&case, seed)?;
            print_row((world, seed), &case, &record);
            if let Some(folder) = folder.as_ref().filter(|_| !record.succeeds()) {
                let picture = drive_picture(&DriveView {
                    map: case.world.map(),
                    solids: case.world.solids(),
                    vehicle: &Vehicle::f1tenth(),
                    record: &record,
                    title: &format!("BARN world {world}, seed {seed}: {}", record.status.name()),
                    caption: &format!("{:.1} s, {:.2} m", record.duration_s, record.driven_m),
                });
                fs::write(format!("{folder}/{world}-{seed}.svg"), picture.to_svg())?;
            }
        }
    }
    Ok(())
}

fn print_row((world, seed): (u64, u64), case: &Case, record: &DriveRecord) {
    let counts = record.driver;
    print!(
        "{world},{seed},{},{:.2},{:.3},{:.3},{:.4},{:.4},{:.2},{},{},{},{},{},{}",
        record.status.name(),
        record.duration_s,
        record.driven_m,
        case.known_m.unwrap_or(f64::NAN),
        score(case, record),
        record.min_static_distance_m,
        record.max_speed_mps,
        record.n_stops,
        counts.n_routes,
        counts.n_flips,
        counts.n_emergency_brakes,
        counts.n_recoveries,
        counts.n_controller_failures,
    );
    if let Some(latencies) = record.latencies {
        for l in [latencies.planner, latencies.controller] {
            print!(",{:.2},{:.2},{:.2}", l.median_ms, l.p99_ms, l.worst_ms);
        }
    }
    println!();
}

//! Drives on known maps.

use crate::common::{Case, pillars};
use formicar::tracking::Actuators;
use formicar::vehicle::VehicleParameters;
use formicar::{OccupancyGrid, Pose2, Seed, Vehicle};
use formicar_drive::{
    DriveStatus, Driver, DriverConfig, KnownMap, Simulation, SimulationConfig, World,
};

const START: Pose2 = Pose2::new(0.8, 3.0, 0.0);
const GOAL: Pose2 = Pose2::new(8.0, 3.0, 0.0);

#[test]
fn a_known_hall_is_crossed_near_top_speed() {
    let record = Case::known(pillars(1), START, GOAL).drive();
    assert_eq!(record.status, DriveStatus::Arrived, "{:?}", record.driver);
    assert!(record.contacts.is_empty());
    assert!(record.goal_error_m < 0.11, "{}", record.goal_error_m);
    assert!(record.max_speed_mps > 1.2, "{}", record.max_speed_mps);
    assert!(record.min_static_distance_m > 0.0);
    assert!(record.driver.n_certified > 10);
}

#[test]
fn a_map_that_is_wrong_is_corrected_on_the_way() {
    let truth = pillars(1);
    let empty = OccupancyGrid::free(*truth.map().frame());
    let case = Case {
        known: KnownMap::prior(&empty),
        ..Case::known(truth, START, GOAL)
    };
    let record = case.drive();
    assert_eq!(record.status, DriveStatus::Arrived, "{:?}", record.driver);
    assert!(record.contacts.is_empty());
    assert!(record.driver.n_routes > 1);
}

#[test]
fn the_same_seed_gives_the_same_drive_to_the_bit() {
    let record = |seed| {
        let mut case = Case::known(pillars(2), START, GOAL);
        case.simulation.seed = Seed(seed);
        case.simulation.position_noise_m = 0.02;
        case.simulation.heading_noise_rad = 0.01;
        case.simulation.lidar.dropout = 0.05;
        case.simulation.actuators.delay_s = 0.04;
        case.driver = Case::usual(&case.simulation);
        case.drive()
    };
    let (one, two) = (record(7), record(7));
    assert_eq!(one, two);
    assert_eq!(
        serde_json::to_string(&one).unwrap(),
        serde_json::to_string(&two).unwrap()
    );
    assert_ne!(one.trace, record(8).trace);
}

#[test]
fn records_are_read_back_from_their_document() {
    let record = Case::known(pillars(3), START, GOAL).drive();
    let text = serde_json::to_string(&record).unwrap();
    assert_eq!(
        serde_json::from_str::<formicar_drive::DriveRecord>(&text).unwrap(),
        record
    );
}

#[test]
fn impossible_setups_are_refused_with_value_and_hint() {
    let hall = || {
        World::new(
            OccupancyGrid::from_rows(&["....#..."; 8], 0.5).unwrap(),
            Vec::new(),
        )
    };
    let vehicle = Vehicle::f1tenth();
    let usual = SimulationConfig::default();
    let start = |start, config: &SimulationConfig| {
        Simulation::new(hall(), &vehicle, start, config)
            .unwrap_err()
            .to_string()
    };
    assert!(start(Pose2::new(2.2, 2.0, 0.0), &usual).contains("touches an obstacle"));
    assert!(start(Pose2::new(-1.0, 2.0, 0.0), &usual).contains("outside the map"));
    assert!(start(Pose2::new(f64::NAN, 2.0, 0.0), &usual).contains("not finite"));
    let still = SimulationConfig {
        actuators: Actuators {
            max_acceleration_mps2: Some(0.0),
            ..Actuators::default()
        },
        ..usual.clone()
    };
    assert!(start(Pose2::new(1.0, 2.0, 0.0), &still).contains("max_acceleration_mps2"));
    let point = Simulation::new(hall(), &Vehicle::point(), Pose2::new(1.0, 2.0, 0.0), &usual);
    assert!(point.unwrap_err().to_string().contains("point"));
    let known = KnownMap::prior(hall().map());
    let goal = Driver::new(
        known.clone(),
        &vehicle,
        Pose2::new(9.0, 9.0, 0.0),
        &DriverConfig::default(),
    );
    assert!(
        goal.err()
            .unwrap()
            .to_string()
            .contains("goal (9.000, 9.000) m lies outside")
    );
    let unsteered = Vehicle::new(VehicleParameters {
        wheelbase_m: None,
        max_steer_rad: None,
        min_turning_radius_m: Some(1.0),
        ..Vehicle::f1tenth().parameters().clone()
    });
    if let Ok(unsteered) = unsteered {
        let refused = Driver::new(
            known,
            &unsteered,
            Pose2::new(1.0, 2.0, 0.0),
            &DriverConfig::default(),
        );
        assert!(refused.is_err());
    }
}

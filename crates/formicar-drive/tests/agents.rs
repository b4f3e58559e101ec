//! Drives among what moves.

use crate::common::Case;
use formicar::scenario::{ObstacleShape, TimedWaypoint};
use formicar::{OccupancyGrid, Point2, Pose2, Seed, Vehicle};
use formicar_drive::{
    Agent, AgentBehavior, Contacted, Culprit, DriveStatus, World, random_walkers,
};

fn hall() -> World {
    let map = OccupancyGrid::from_rows(&[".".repeat(100).as_str(); 60], 0.1).unwrap();
    World::new(map, Vec::new())
}

const START: Pose2 = Pose2::new(1.0, 3.0, 0.0);
const GOAL: Pose2 = Pose2::new(9.0, 3.0, 0.0);

fn disc(behavior: AgentBehavior) -> Agent {
    Agent {
        name: Some("disc".to_owned()),
        shape: ObstacleShape::Disc { radius_m: 0.3 },
        behavior,
    }
}

#[test]
fn a_robot_lets_a_crossing_pass() {
    let mut case = Case::known(hall(), START, GOAL);
    case.agents = vec![disc(AgentBehavior::Velocity {
        pose: [5.0, 0.6, 1.57],
        velocity_mps: [0.0, 0.8],
    })];
    let alone = Case::known(hall(), START, GOAL).drive();
    let record = case.drive();
    assert_eq!(record.status, DriveStatus::Arrived, "{:?}", record.driver);
    assert!(record.contacts.is_empty());
    assert!(
        record.min_agent_distance_m.unwrap() > 0.05,
        "{:?}",
        record.min_agent_distance_m
    );
    assert!(alone.min_agent_distance_m.is_none());
    assert!(record.duration_s >= alone.duration_s);
}

#[test]
fn who_runs_into_a_standing_robot_is_to_blame() {
    let mut case = Case::known(hall(), START, START);
    // The robot stands where it is to go: it has arrived, so it must be given some time.
    case.goal = Pose2::new(9.0, 3.0, 0.0);
    case.driver.settle_s = 5.0;
    case.run.max_time_s = 4.0;
    let at = |t_s, x| TimedWaypoint {
        t_s,
        pose: [x, 3.0, 3.0],
    };
    case.agents = vec![disc(AgentBehavior::Scripted(vec![
        at(0.0, 4.0),
        at(3.0, 1.5),
    ]))];
    let record = case.drive();
    assert_eq!(record.status, DriveStatus::TimedOut);
    let [contact] = &record.contacts[..] else {
        panic!("one contact, not {:?}", record.contacts)
    };
    assert_eq!(contact.by, Culprit::Other);
    assert_eq!(contact.with, Contacted::Agent("disc".to_owned()));
    assert_eq!(contact.robot_mps, 0.0);
    assert!(contact.other_closing_mps > 0.8);
    // Its front, 0.42 m ahead of the rear axle, is touched by a disc of 0.3 m.
    assert!((contact.place.x - 1.42).abs() < 1e-3, "{contact:?}");
}

#[test]
fn one_who_stands_in_the_way_is_driven_around() {
    let mut case = Case::known(hall(), START, GOAL);
    case.agents = vec![disc(AgentBehavior::Velocity {
        pose: [5.0, 3.0, 0.0],
        velocity_mps: [0.0, 0.0],
    })];
    let record = case.drive();
    assert_eq!(record.status, DriveStatus::Arrived, "{:?}", record.driver);
    assert!(record.contacts.is_empty());
}

#[test]
fn among_walkers_who_yield_the_robot_touches_nobody() {
    for seed in 1..4 {
        let mut case = Case::known(hall(), START, GOAL);
        case.simulation.seed = Seed(seed);
        let walkers = random_walkers(
            case.world.map(),
            &Vehicle::f1tenth(),
            START,
            (6, Seed(seed)),
        );
        let polite = walkers.into_iter().map(|walker| match walker.behavior {
            AgentBehavior::Walker {
                position: [x, y],
                speed_mps,
                ..
            } => Agent::walker(Point2::new(x, y), speed_mps, true),
            _ => walker,
        });
        case.agents = polite.collect();
        let record = case.drive();
        let caused = record.contacts.iter().filter(|c| c.by.is_robot());
        assert_eq!(caused.count(), 0, "seed {seed}: {:?}", record.contacts);
        assert_eq!(
            record.status,
            DriveStatus::Arrived,
            "seed {seed}: {:?}",
            record.driver
        );
    }
}

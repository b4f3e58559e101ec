//! Drives into the unknown.

use crate::common::{Case, pillars};
use formicar::{OccupancyGrid, Pose2};
use formicar_drive::{DriveStatus, UnknownGround, World};

const START: Pose2 = Pose2::new(0.8, 3.0, 0.0);
const GOAL: Pose2 = Pose2::new(8.0, 3.0, 0.0);

#[test]
fn random_halls_are_explored_without_a_touch() {
    let n_worlds = 6;
    let mut n_arrived = 0;
    for seed in 0..n_worlds {
        let record = Case::unknown(pillars(seed), START, GOAL).drive();
        assert!(
            record.contacts.is_empty(),
            "hall {seed}: {:?}",
            record.contacts
        );
        assert!(record.min_static_distance_m > 0.0, "hall {seed}");
        n_arrived += usize::from(record.status == DriveStatus::Arrived);
    }
    assert!(
        n_arrived + 1 >= n_worlds as usize,
        "{n_arrived} of {n_worlds}"
    );
}

/// A corridor that turns around a corner, behind which it is closed by a wall.
fn corner() -> World {
    let mut rows = vec!["#".repeat(80); 6];
    let open = format!("#{}#", ".".repeat(78));
    rows.extend(vec![open; 22]);
    rows.extend(vec!["#".repeat(80); 6]);
    // A screen across most of the corridor, and a pillar right behind its end.
    for row in rows.iter_mut().take(28).skip(14) {
        row.replace_range(40..42, "##");
    }
    for row in rows.iter_mut().take(14).skip(11) {
        row.replace_range(54..57, "###");
    }
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    World::new(OccupancyGrid::from_rows(&rows, 0.1).unwrap(), Vec::new())
}

#[test]
fn a_robot_can_stop_within_what_it_has_seen() {
    let (start, goal) = (Pose2::new(0.8, 1.2, 0.0), Pose2::new(7.2, 1.2, 0.0));
    let careful = Case::unknown(corner(), start, goal).drive();
    assert_eq!(careful.status, DriveStatus::Arrived, "{:?}", careful.driver);
    assert!(careful.contacts.is_empty());
    let mut case = Case::unknown(corner(), start, goal);
    case.driver.unknown = UnknownGround::TakeAsFree;
    let bold = case.drive();
    // The rule is what costs time: without it the robot is never slower here.
    assert!(
        bold.duration_s <= careful.duration_s + 0.5,
        "{} {}",
        bold.duration_s,
        careful.duration_s
    );
}

#[test]
fn a_goal_behind_walls_ends_in_time_without_a_touch() {
    let mut rows = vec![".".repeat(60); 40];
    for row in &mut rows {
        row.replace_range(40..42, "##");
    }
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let world = World::new(OccupancyGrid::from_rows(&rows, 0.1).unwrap(), Vec::new());
    let mut case = Case::unknown(world, Pose2::new(1.0, 2.0, 0.0), Pose2::new(5.3, 2.0, 0.0));
    case.run.max_time_s = 12.0;
    case.driver.budget_steps = 3000;
    let record = case.drive();
    assert_eq!(record.status, DriveStatus::TimedOut);
    assert!(record.contacts.is_empty());
}

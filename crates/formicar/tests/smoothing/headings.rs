//! Curves onto headings, past corners, and the whole way in reverse.

use super::{Place, either, free_request, open};
use formicar::geometry::{Pose2, dubins};
use formicar::map::{Cell, GridFrame, OccupancyGrid};
use formicar::path::Direction;
use formicar::scenario::{GoalHeading, Request};
use formicar::smoothing::{Corners, Rounding, SmoothingConfig, SmoothingError, smooth};
use formicar::validation::judge;
use formicar::vehicle::{Gears, Vehicle};
use std::f64::consts::{FRAC_PI_2, PI};

/// A corridor of 1.2 m, too narrow to turn around in.
const CORRIDOR: [&str; 7] = [
    "##############################",
    "##############################",
    "..............................",
    "..............................",
    "..............................",
    "##############################",
    "##############################",
];

fn corridor(origin: Pose2) -> Place {
    let map = OccupancyGrid::from_rows(&CORRIDOR, 0.4).unwrap();
    let frame = GridFrame::new(30, 7, 0.4, origin).unwrap();
    let map = OccupancyGrid::new(frame, map.values().to_vec()).unwrap();
    Place::new(&map, Vehicle::lei2020())
}

/// From one part of the corridor to another, with headings along its axis.
fn along(place: &Place, start_rad: f64, goal_rad: f64) -> Request {
    let frame = place.obstacles.frame();
    Request::new(
        frame.to_world(Pose2::new(4.0, 1.4, start_rad)),
        frame.to_world(Pose2::new(9.0, 1.4, goal_rad)),
    )
}

#[test]
fn where_it_cannot_turn_the_way_is_driven_in_reverse() {
    for config in either() {
        let place = corridor(Pose2::new(-3.0, 7.0, 2.5));
        let request = along(&place, PI, PI);
        let smoothed = place.certified(&config, &request).unwrap().unwrap();
        let segments = smoothed.path.segments();
        assert!(segments.iter().all(|s| s.direction == Direction::Reverse));
        assert!((smoothed.path.length_m() - 5.0).abs() < 1e-6);

        let forward = Request {
            gears: Gears::Forward,
            ..request
        };
        let error = place.certified(&config, &forward).unwrap().unwrap_err();
        assert!(matches!(error, SmoothingError::Heading { .. }), "{error}");
    }
}

#[test]
fn a_bidirectional_goal_takes_either_heading() {
    let place = corridor(Pose2::default());
    let exact = Request {
        gears: Gears::Forward,
        ..along(&place, 0.0, PI)
    };
    let both = Request {
        goal_heading: GoalHeading::Bidirectional,
        ..exact.clone()
    };
    let config = SmoothingConfig::lei2020();
    assert!(place.certified(&config, &both).unwrap().is_ok());
    let error = place.certified(&config, &exact).unwrap().unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("no free curve joins the goal's heading"),
        "{error}"
    );
}

#[test]
fn near_ends_are_joined_by_one_curve() {
    let place = Place::new(&open(40, 40), Vehicle::lei2020());
    let start = Pose2::new(8.0, 8.0, 0.0);
    let radius_m = place.vehicle.min_turning_radius_m();
    for goal in [
        Pose2::new(12.0, 11.0, FRAC_PI_2),
        Pose2::new(8.0, 8.0, PI),
        start,
    ] {
        let request = Request {
            gears: Gears::Forward,
            ..Request::new(start, goal)
        };
        let smoothed = place
            .certified(&SmoothingConfig::lei2020(), &request)
            .unwrap()
            .unwrap();
        let shortest_m = dubins::distance(start, goal, radius_m).unwrap();
        assert!(
            (smoothed.path.length_m() - shortest_m).abs() < 1e-9,
            "{goal:?}"
        );
        let free = Request {
            goal_heading: GoalHeading::Any,
            ..request
        };
        let smoothed = place
            .certified(&SmoothingConfig::lei2020(), &free)
            .unwrap()
            .unwrap();
        assert!(smoothed.path.length_m() <= shortest_m + 1e-9);
    }
}

#[test]
fn curves_pass_what_two_turns_cannot() {
    let place = Place::new(&open(60, 60), Vehicle::lei2020());
    let cells = [(10, 10), (17, 10), (17, 16), (24, 16)].map(|(c, r)| Cell::new(c, r));
    let request = free_request(&place, cells[0], cells[3]);
    let smoothed = smooth(
        &place.ground(),
        &SmoothingConfig::default(),
        &request,
        &cells,
    )
    .unwrap();
    assert!(judge(&place.obstacles, &place.vehicle, &request, &smoothed.path).valid);
    let by_curve = smoothed
        .corners
        .iter()
        .filter(|c| c.rounding == Rounding::Curve);
    assert!(by_curve.count() > 0);
    let plain = SmoothingConfig {
        corners: Corners::TwoTurning,
        ..SmoothingConfig::default()
    };
    assert!(smooth(&place.ground(), &plain, &request, &cells).is_err());
}

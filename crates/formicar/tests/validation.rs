//! The judge on paths with one fault each.

use formicar::collision::ObstacleMap;
use formicar::geometry::{Point2, Pose2};
use formicar::map::{GridFrame, OccupancyGrid};
use formicar::path::{CurvePath, CurveSegment, Direction};
use formicar::scenario::{GoalHeading, Request};
use formicar::validation::{Report, ViolationKind, judge, judge_path};
use formicar::vehicle::{Gears, Vehicle};
use std::f64::consts::{FRAC_PI_2, PI};

fn yard() -> OccupancyGrid {
    let frame = GridFrame::new(100, 60, 0.1, Pose2::new(-2.0, 3.0, 0.0)).expect("a valid frame");
    let mut map = OccupancyGrid::free(frame);
    for col in 40..50 {
        map.set(formicar::map::Cell::new(col, 20), 100);
    }
    map
}

fn straight(start: Pose2, length_m: f64) -> CurvePath {
    let mut path = CurvePath::new(start);
    path.push(0.0, length_m, Direction::Forward);
    path
}

fn verdict(request: &Request, path: &CurvePath) -> Report {
    judge(
        &ObstacleMap::new(&yard()),
        &Vehicle::warehouse_amr(),
        request,
        path,
    )
}

fn kinds(report: &Report) -> Vec<ViolationKind> {
    report.violations.iter().map(|v| v.kind).collect()
}

const START: Pose2 = Pose2::new(0.0, 4.0, 0.0);

#[test]
fn a_good_path_gets_its_certificate() {
    let report = verdict(
        &Request::new(START, Pose2::new(6.0, 4.0, 0.0)),
        &straight(START, 6.0),
    );
    assert!(report.valid, "{:?}", report.violations);
    // The body spans y = 3.69 to 4.31; the bar begins at 5.0, the border at 3.0.
    assert!(
        (report.min_clearance_m - 0.69).abs() < 1e-9,
        "{}",
        report.min_clearance_m
    );
    let certificate = report.certify().unwrap();
    assert_eq!(certificate.map_hash.len(), 32);
}

#[test]
fn the_tightest_place_is_where_the_bar_is() {
    let start = Pose2::new(0.0, 4.5, 0.0);
    let report = verdict(
        &Request::new(start, Pose2::new(6.0, 4.5, 0.0)),
        &straight(start, 6.0),
    );
    assert!((report.min_clearance_m - 0.19).abs() < 1e-9);
    assert!(
        (1.2..=3.2).contains(&report.tightest.x),
        "{:?}",
        report.tightest
    );
    assert!((report.tightest_s_m - report.tightest.x).abs() < 1e-9);
}

#[test]
fn a_collision_names_place_depth_and_stretch() {
    let start = Pose2::new(0.0, 4.8, 0.0);
    let report = verdict(
        &Request::new(start, Pose2::new(6.0, 4.8, 0.0)),
        &straight(start, 6.0),
    );
    assert_eq!(kinds(&report), [ViolationKind::Collision]);
    let violation = &report.violations[0];
    assert!(
        (violation.amount + 0.11).abs() < 1e-9,
        "{}",
        violation.amount
    );
    assert!(
        violation.message.contains("row") || violation.message.contains("cell (4"),
        "{}",
        violation.message
    );
    assert_eq!(report.min_clearance_m, 0.0);
    assert!(report.certify().is_err());
}

#[test]
fn leaving_the_map_is_a_violation() {
    let report = verdict(
        &Request::new(START, Pose2::new(7.9, 4.0, 0.0)),
        &straight(START, 7.9),
    );
    assert_eq!(kinds(&report), [ViolationKind::LeavesMap]);
    assert!((report.violations[0].amount + 0.675).abs() < 1e-9);
}

#[test]
fn curvature_beyond_the_limit() {
    let limit = Vehicle::warehouse_amr().max_curvature_per_m();
    let arc = |curvature| {
        let mut path = CurvePath::new(START);
        path.push(curvature, 0.5, Direction::Forward);
        let request = Request::new(START, path.end());
        verdict(&request, &path)
    };
    assert!(arc(limit).valid && arc(-limit).valid);
    assert_eq!(kinds(&arc(limit * 1.000_001)), [ViolationKind::Curvature]);
    let mut path = CurvePath::new(START);
    path.push(limit * 1.04, 0.5, Direction::Forward);
    let obstacles = ObstacleMap::new(&yard());
    assert!(judge_path(&obstacles, &Vehicle::warehouse_amr(), &path, 0.05).valid);
    assert!(!judge_path(&obstacles, &Vehicle::warehouse_amr(), &path, 0.03).valid);
}

#[test]
fn joints_must_meet() {
    let line = |start, length_m| CurveSegment {
        start,
        curvature_per_m: 0.0,
        curvature_rate_per_m2: 0.0,
        length_m,
        direction: Direction::Forward,
    };
    let broken = |second: Pose2| {
        let path = CurvePath::from_segments(START, vec![line(START, 2.0), line(second, 1.0)]);
        let request = Request {
            goal_heading: GoalHeading::Any,
            ..Request::new(START, path.end())
        };
        kinds(&verdict(&request, &path))
    };
    assert_eq!(broken(Pose2::new(2.0, 4.0, 0.0)), []);
    assert_eq!(broken(Pose2::new(2.0, 4.0, std::f64::consts::TAU)), []);
    assert_eq!(
        broken(Pose2::new(2.0, 4.00001, 0.0)),
        [ViolationKind::Discontinuity]
    );
    assert_eq!(
        broken(Pose2::new(2.0, 4.0, 0.00001)),
        [ViolationKind::Discontinuity]
    );
}

#[test]
fn ends_and_gears_as_requested() {
    let path = straight(START, 6.0);
    let goal = Pose2::new(6.0, 4.0, 0.0);
    let ask = |request: Request| kinds(&verdict(&request, &path));
    assert_eq!(
        ask(Request::new(Pose2::new(0.0, 4.0, 0.1), goal)),
        [ViolationKind::Start]
    );
    assert_eq!(
        ask(Request::new(START, Pose2::new(6.02, 4.0, 0.0))),
        [ViolationKind::Goal]
    );
    assert_eq!(ask(Request::new(START, Pose2::new(6.005, 4.0, 0.005))), []);
    assert_eq!(
        ask(Request::new(START, Pose2::new(6.0, 4.0, PI))),
        [ViolationKind::Goal]
    );
    let both_ways = Request {
        goal_heading: GoalHeading::Bidirectional,
        ..Request::new(START, Pose2::new(6.0, 4.0, PI))
    };
    assert_eq!(ask(both_ways), []);
    let mut back = CurvePath::new(goal);
    back.push(0.0, 6.0, Direction::Reverse);
    let forward = Request {
        gears: Gears::Forward,
        ..Request::new(goal, START)
    };
    assert_eq!(kinds(&verdict(&forward, &back)), [ViolationKind::Gear]);
    assert_eq!(kinds(&verdict(&Request::new(goal, START), &back)), []);
}

#[test]
fn numbers_that_are_none_are_malformed() {
    for (x, curvature_per_m, length_m) in [
        (f64::NAN, 0.0, 1.0),
        (0.0, f64::INFINITY, 1.0),
        (0.0, 0.0, -1.0),
        (0.0, 0.0, f64::NAN),
    ] {
        let start = Pose2::new(x, 4.0, 0.0);
        let segment = CurveSegment {
            start,
            curvature_per_m,
            curvature_rate_per_m2: 0.0,
            length_m,
            direction: Direction::Forward,
        };
        let report = verdict(
            &Request::new(START, START),
            &CurvePath::from_segments(START, vec![segment]),
        );
        assert_eq!(kinds(&report), [ViolationKind::Malformed]);
    }
}

#[test]
fn standing_still_is_a_path() {
    let report = verdict(&Request::new(START, START), &CurvePath::new(START));
    assert!(report.valid);
    assert!((report.min_clearance_m - 0.69).abs() < 1e-9);
}

#[test]
fn a_point_drives_a_polyline_along_corners() {
    let p = Point2::new;
    let path = CurvePath::from_polyline(&[p(1.0, 5.0), p(2.0, 4.9), p(2.0, 5.0), p(3.1, 5.0)]);
    let request = Request::new(
        Pose2::at(p(1.0, 5.0), 0.0),
        Pose2::at(p(3.1, 5.0), FRAC_PI_2),
    );
    let report = judge(
        &ObstacleMap::new(&yard()),
        &Vehicle::point(),
        &request,
        &path,
    );
    assert!(report.valid, "{:?}", report.violations);
    let through = CurvePath::from_polyline(&[p(1.0, 5.0), p(3.1, 5.05)]);
    let request = Request::new(Pose2::at(p(1.0, 5.0), 0.0), Pose2::at(p(3.1, 5.05), 0.0));
    let report = judge(
        &ObstacleMap::new(&yard()),
        &Vehicle::point(),
        &request,
        &through,
    );
    assert_eq!(kinds(&report)[0], ViolationKind::Collision);
}

//! B-splines over nodes: where the ends are, and that nobody but the judge looks at obstacles.

use super::*;
use formicar::geometry::Point2;
use formicar::smoothing::{Corners, Rounding};
use formicar::validation::ViolationKind;
use std::f64::consts::{FRAC_PI_2, PI};

fn splines(spline_spacing_radii: f64) -> SmoothingConfig {
    SmoothingConfig {
        corners: Corners::BSpline,
        spline_spacing_radii,
        ..SmoothingConfig::default()
    }
}

#[test]
fn a_spline_begins_and_ends_with_the_headings_that_are_asked_for() {
    let place = Place::new(&open(120, 120), Vehicle::warehouse_amr());
    let cells = [(20, 20), (60, 30), (90, 80)].map(|(c, r)| Cell::new(c, r));
    let at = |cell: Cell, heading| Pose2::at(place.obstacles.frame().center(cell), heading);
    let request = Request {
        gears: Gears::Forward,
        ..Request::new(at(cells[0], 0.4), at(cells[2], FRAC_PI_2))
    };
    for spacing in [0.0, 2.0, 8.0] {
        let smoothed = smooth(&place.ground(), &splines(spacing), &request, &cells).unwrap();
        assert_eq!(smoothed.path.start(), request.start);
        let report = judge(&place.obstacles, &place.vehicle, &request, &smoothed.path);
        let bends = |kind| kind == ViolationKind::Curvature;
        assert!(
            report.violations.iter().all(|v| bends(v.kind)),
            "{:?}",
            report.violations
        );
        assert!(
            smoothed
                .corners
                .iter()
                .all(|c| c.rounding == Rounding::Spline)
        );
    }
    let wide = smooth(&place.ground(), &splines(0.0), &request, &cells).unwrap();
    assert!(judge(&place.obstacles, &place.vehicle, &request, &wide.path).valid);
    let both_ways = Request {
        goal: at(cells[2], FRAC_PI_2 + PI),
        goal_heading: GoalHeading::Bidirectional,
        ..request
    };
    let same = smooth(&place.ground(), &splines(0.0), &both_ways, &cells).unwrap();
    assert!((same.path.length_m() - wide.path.length_m()).abs() < 1e-9);
}

#[test]
fn points_on_long_legs_keep_a_spline_near_the_polyline() {
    let place = Place::new(&open(120, 120), Vehicle::warehouse_amr());
    let cells = [(10, 10), (100, 10), (100, 100)].map(|(c, r)| Cell::new(c, r));
    let request = free_request(&place, cells[0], cells[2]);
    let miss_m = |spacing: f64| {
        let smoothed = smooth(&place.ground(), &splines(spacing), &request, &cells).unwrap();
        let corner: Point2 = smoothed.waypoints.points[1];
        let away = smoothed.path.sample(0.05);
        let away = away.iter().map(|p| p.pose.position().distance(corner));
        away.fold(f64::INFINITY, f64::min)
    };
    assert!(
        miss_m(0.0) > 10.0 * miss_m(2.0),
        "{} {}",
        miss_m(0.0),
        miss_m(2.0)
    );
}

#[test]
fn a_spline_through_an_obstacle_is_made_and_refused_by_the_judge() {
    let mut map = open(60, 60);
    for i in 0..30 {
        map.set(Cell::new(30, i), formicar::map::OCCUPIED);
    }
    let place = Place::new(&map, Vehicle::warehouse_amr());
    let cells = [(5, 20), (30, 33), (55, 20)].map(|(c, r)| Cell::new(c, r));
    let request = free_request(&place, cells[0], cells[2]);
    let smoothed = smooth(&place.ground(), &splines(0.0), &request, &cells).unwrap();
    let report = judge(&place.obstacles, &place.vehicle, &request, &smoothed.path);
    let kinds: Vec<_> = report.violations.iter().map(|v| v.kind).collect();
    assert_eq!(kinds, [ViolationKind::Collision]);
}

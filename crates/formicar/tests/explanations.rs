//! Failures that explain themselves: what collides, what lies apart, what is too narrow.

use formicar::collision::ObstacleMap;
use formicar::geometry::{Arc, Point2, Pose2};
use formicar::map::generate::{ScatterParameters, free_pose_pairs, scattered_obstacles};
use formicar::map::{Cell, OccupancyGrid};
use formicar::numeric::Seed;
use formicar::path::CurvePath;
use formicar::planner::{NotFound, Outcome, Planner, PlannerConfig, PlannerName};
use formicar::progress::Status;
use formicar::scenario::{GoalTolerance, Request, ViaPoint};
use formicar::validation::{CURVATURE_TOLERANCE, judge_path};
use formicar::vehicle::{Gears, Vehicle, VehicleParameters};
use std::f64::consts::PI;

fn ask(map: &OccupancyGrid, vehicle: Vehicle, request: &Request) -> Outcome {
    Planner::new(map, vehicle, PlannerConfig::default())
        .expect("valid parameters")
        .plan(request, Seed(1), &mut ())
        .expect("a valid request")
}

fn failure(map: &OccupancyGrid, vehicle: Vehicle, request: &Request) -> NotFound {
    match ask(map, vehicle, request) {
        Outcome::NotFound(failure) => *failure,
        Outcome::Found(plan) => panic!("{} m were found", plan.metrics.length_m),
    }
}

/// Two halls; between them a wall, in it a crack of one cell.
const HALLS: [&str; 8] = [
    ".........#.......",
    ".........#.......",
    ".........#.......",
    ".................",
    ".........#.......",
    ".........#.......",
    ".........#.......",
    ".........#.......",
];

/// A vehicle whose rear axle keeps more than a cell from obstacles.
fn careful() -> Vehicle {
    let vehicle = Vehicle::warehouse_amr().with_safety_margin(0.2);
    vehicle.expect("a margin")
}

fn halls() -> (OccupancyGrid, Request) {
    let map = OccupancyGrid::from_rows(&HALLS, 0.25).expect("rows");
    let request = Request::new(Pose2::new(0.8, 1.0, 0.0), Pose2::new(3.0, 1.0, 0.0));
    (map, request)
}

#[test]
fn a_crack_is_too_narrow_and_no_step_is_searched() {
    let (map, request) = halls();
    let failure = failure(&map, careful(), &request);
    assert_eq!((failure.status, failure.n_steps), (Status::NoPath, 0));
    let gap = failure.explanation.gap.expect("a gap");
    assert!(
        Point2::new(gap.x, gap.y).distance(Point2::new(2.375, 1.125)) < 0.3,
        "{gap:?}"
    );
    assert_eq!(
        (gap.gap_m, gap.vehicle_width_m),
        (0.25, careful().width_m())
    );
    let apart = failure.explanation.disconnected.expect("two parts");
    assert!(apart.n_cells_at_start > apart.n_cells_at_goal && apart.n_cells_at_goal > 0);
    assert!(
        failure.reason.contains("narrows to about 0.25 m"),
        "{}",
        failure.reason
    );
}

#[test]
fn a_search_that_is_cut_short_says_how_wide_the_widest_way_is() {
    let (_, request) = halls();
    let doored: Vec<String> = (0..HALLS.len())
        .map(|row| HALLS[if (2..6).contains(&row) { 3 } else { 0 }].to_owned())
        .collect();
    let rows: Vec<&str> = doored.iter().map(String::as_str).collect();
    let map = OccupancyGrid::from_rows(&rows, 0.25).expect("rows");
    // The goal faces the wall that it stands behind.
    let hurried = Request {
        budget_steps: Some(2),
        ..request.with_goal(Pose2::new(3.4, 0.5, PI))
    };
    let config = PlannerConfig::of(PlannerName::HybridAstar);
    let planner = Planner::new(&map, Vehicle::warehouse_amr(), config);
    let outcome = planner
        .expect("valid parameters")
        .plan(&hurried, Seed(1), &mut ());
    let Ok(Outcome::NotFound(failure)) = outcome else {
        panic!("found within two steps");
    };
    assert_eq!(failure.status, Status::BudgetExhausted);
    let gap = failure.explanation.gap.expect("a gap");
    assert!((gap.gap_m - 1.0).abs() < 0.26, "{gap:?}");
    assert!(gap.gap_m > gap.vehicle_width_m);
    let said = format!("{:.2} m at its narrowest", gap.gap_m);
    assert!(failure.reason.contains(&said), "{}", failure.reason);
}

/// A corridor of 8 cells of 0.1 m, closed at its left end.
fn corridor() -> OccupancyGrid {
    let rows: Vec<String> = (0..12)
        .map(|row| match row {
            2..10 => "#".to_owned() + &".".repeat(79),
            _ => "#".repeat(80),
        })
        .collect();
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    OccupancyGrid::from_rows(&rows, 0.1).expect("rows")
}

#[test]
fn a_corridor_that_the_vehicle_fits_is_not_called_too_narrow() {
    let broad = Vehicle::new(VehicleParameters {
        width_m: Some(0.75),
        ..Vehicle::warehouse_amr().parameters().clone()
    });
    let back = Request {
        gears: Gears::Forward,
        ..Request::new(Pose2::new(5.0, 0.6, 0.0), Pose2::new(2.0, 0.6, 0.0))
    };
    let failure = failure(&corridor(), broad.expect("a vehicle"), &back);
    assert_eq!(failure.status, Status::NoPath);
    let gap = failure.explanation.gap.expect("a gap");
    assert!((gap.gap_m - 0.8).abs() < 1e-9, "{gap:?}");
    assert!(failure.reason.contains("turning"), "{}", failure.reason);
    assert!(
        failure.reason.contains("allow reverse"),
        "{}",
        failure.reason
    );
}

#[test]
fn of_several_goals_the_one_with_the_widest_way_is_told_of() {
    let (sealed, open) = (Pose2::new(7.0, 0.6, 0.0), Pose2::new(2.0, 0.6, 0.0));
    let mut map = corridor();
    for row in 0..12 {
        map.set(Cell::new(60, row), 100);
    }
    for (goal, other) in [(sealed, open), (open, sealed)] {
        let back = Request {
            gears: Gears::Forward,
            other_goals: vec![other],
            ..Request::new(Pose2::new(4.0, 0.6, 0.0), goal)
        };
        let failure = failure(&map, Vehicle::warehouse_amr(), &back);
        assert!(failure.reason.contains("turning"), "{}", failure.reason);
        let gap = failure.explanation.gap.expect("a gap");
        assert!((gap.gap_m - 0.8).abs() < 1e-9, "{gap:?}");
    }
}

#[test]
fn a_budget_that_ends_while_other_headings_are_tried_names_the_leg_behind() {
    // Through a dead end to what lies behind the start: forward only there is no second leg.
    let request = Request {
        gears: Gears::Forward,
        via: vec![ViaPoint::new(Point2::new(6.0, 0.6))],
        budget_steps: Some(100),
        ..Request::new(Pose2::new(4.0, 0.6, 0.0), Pose2::new(2.0, 0.6, 0.0))
    };
    let failure = failure(&corridor(), Vehicle::warehouse_amr(), &request);
    assert_eq!(failure.explanation.leg, Some(2), "{}", failure.reason);
    assert!(
        failure.reason.starts_with("leg 2 of 2"),
        "{}",
        failure.reason
    );
}

#[test]
fn a_wall_without_a_crack_separates_however_thin_the_vehicle() {
    let rows = HALLS.map(|row| format!("{}#{}", &row[..9], &row[10..]));
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let map = OccupancyGrid::from_rows(&rows, 0.25).expect("rows");
    let (_, request) = halls();
    for vehicle in [Vehicle::warehouse_amr(), Vehicle::f1tenth()] {
        let failure = failure(&map, vehicle, &request);
        assert_eq!((failure.status, failure.n_steps), (Status::NoPath, 0));
        assert_eq!(failure.explanation.gap, None);
        assert!(failure.explanation.disconnected.is_some());
        assert!(
            failure.reason.contains("however thin"),
            "{}",
            failure.reason
        );
    }
}

#[test]
fn a_tolerance_that_reaches_over_the_wall_is_no_reason_to_refuse() {
    let (map, mut request) = halls();
    request.goal_tolerance = GoalTolerance {
        xy_m: 1.2,
        yaw_rad: 0.5,
    };
    if let Outcome::NotFound(failure) = ask(&map, careful(), &request) {
        assert_eq!(failure.explanation.disconnected, None);
    }
    request.goal_tolerance.xy_m = 0.3;
    let failure = failure(&map, careful(), &request);
    assert!(failure.explanation.disconnected.is_some());
}

#[test]
fn the_leg_that_is_sealed_off_is_named() {
    let (map, mut request) = halls();
    request.via = vec![ViaPoint::new(Point2::new(1.2, 1.0))];
    let failure = failure(&map, careful(), &request);
    assert_eq!((failure.explanation.leg, failure.n_steps), (Some(2), 0));
    assert!(
        failure.reason.starts_with("leg 2 of 2, from via point 1"),
        "{}",
        failure.reason
    );
}

#[test]
fn colliding_cells_are_listed() {
    let (map, mut request) = halls();
    request.goal = Pose2::new(2.2, 0.4, 0.0);
    let mut planner = Planner::new(&map, Vehicle::warehouse_amr(), PlannerConfig::default())
        .expect("valid parameters");
    let error = planner
        .plan(&request, Seed(1), &mut ())
        .expect_err("it collides");
    let collision = error
        .explanation()
        .and_then(|e| e.collision)
        .expect("cells");
    assert_eq!(collision.end, "goal");
    assert_eq!(collision.cells, [[9, 0], [9, 1], [9, 2]]);
}

/// A way of arcs that the judge finds valid, from a free pose on.
fn stroll(map: &OccupancyGrid, vehicle: &Vehicle, from: Pose2, seed: u64) -> CurvePath {
    let obstacles = ObstacleMap::new(map);
    let mut draw = Seed(seed).stream([0, 0]);
    let mut arcs: Vec<Arc> = Vec::new();
    let mut path = CurvePath::new(from);
    for _ in 0..200 {
        let sign = (draw.next_u64() % 3) as f64 - 1.0;
        let ahead = if draw.next_u64().is_multiple_of(4) {
            -0.3
        } else {
            0.3
        };
        arcs.push(Arc {
            curvature_per_m: sign * vehicle.max_curvature_per_m(),
            signed_length_m: ahead,
        });
        let longer = CurvePath::from_arcs(from, &arcs);
        if judge_path(&obstacles, vehicle, &longer, CURVATURE_TOLERANCE).valid {
            path = longer;
        } else {
            arcs.pop();
        }
    }
    path
}

/// Whoever has driven there, is not told that no way leads there.
#[test]
fn nothing_that_can_be_driven_is_refused_as_sealed_off() {
    let vehicle = Vehicle::f1tenth();
    let mut length_m = 0.0;
    for seed in 0..24 {
        let parameters = ScatterParameters {
            n_cols: 40,
            n_rows: 30,
            resolution_m: [0.11, 0.17, 0.23][seed as usize % 3],
            density: 0.08,
            ..ScatterParameters::default()
        };
        let map = scattered_obstacles(&parameters, Seed(seed)).expect("valid parameters");
        for (from, _) in free_pose_pairs(&map, &vehicle, 1, Seed(seed)).unwrap_or_default() {
            let path = stroll(&map, &vehicle, from, seed);
            length_m += path.length_m();
            let mut request = Request::new(path.start(), path.end());
            request.budget_steps = Some(1);
            for name in [PlannerName::HybridAstar, PlannerName::Astar] {
                let mut planner = Planner::new(&map, vehicle.clone(), PlannerConfig::of(name))
                    .expect("valid parameters");
                let outcome = planner.plan(&request, Seed(1), &mut ()).expect("a request");
                if let Outcome::NotFound(failure) = outcome {
                    assert_eq!(failure.explanation.disconnected, None, "seed {seed}");
                }
            }
        }
    }
    assert!(length_m > 50.0, "{length_m} m");
}

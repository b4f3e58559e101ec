//! Failures that explain themselves: what collides, what lies apart, what is too narrow.

use formicar::collision::{Body, Drive, ObstacleMap};
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
    // The same in both gears, where the trolley has no room to turn.
    let long = Vehicle::new(VehicleParameters {
        width_m: Some(0.75),
        rear_overhang_m: Some(0.9),
        min_turning_radius_m: Some(3.0),
        max_steer_deg: None,
        max_steer_rad: None,
        ..Vehicle::warehouse_amr().parameters().clone()
    });
    let turned = Request::new(Pose2::new(5.0, 0.6, 0.0), Pose2::new(3.0, 0.6, PI));
    let failure = self::failure(&corridor(), long.expect("a vehicle"), &turned);
    let reason = &failure.reason;
    assert!(!reason.contains("allow reverse"), "{reason}");
    assert!(reason.contains("step_radii"), "{reason}");
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

/// Vehicles of every kind: no body, hardly a body, wide bodies, the axle on the rim of the body and
/// outside it.
fn vehicles_of_every_kind() -> Vec<Vehicle> {
    let of_footprint = |text: &str| {
        let footprint = formicar::vehicle::FootprintSpec::RosString(text.to_owned());
        Vehicle::new(VehicleParameters {
            footprint: Some(footprint),
            min_turning_radius_m: Some(0.3),
            ..VehicleParameters::default()
        })
        .expect("a footprint")
    };
    vec![
        Vehicle::point(),
        Vehicle::f1tenth(),
        Vehicle::warehouse_amr(),
        Vehicle::warehouse_amr()
            .with_safety_margin(0.3)
            .expect("a margin"),
        of_footprint("[[-0.3,-0.001],[0.3,-0.001],[0.3,0.001],[-0.3,0.001]]"),
        of_footprint("[[0,0],[0.4,-0.1],[0.4,0.1]]"),
        of_footprint("[[-0.2,0],[0.1,-0.2],[0.1,0.2]]"),
        of_footprint("[[0.2,-0.1],[0.5,-0.1],[0.5,0.1],[0.2,0.1]]"),
    ]
}

/// Where a body that may also turn on the spot and slide gets to from a pose, in steps of a third
/// of a cell and eighths of a turn: at least where a car gets to with such poses.
struct Flood {
    reached: Vec<bool>,
    n_cols: usize,
}

impl Flood {
    const FINE: usize = 3;
    const TURNS: usize = 8;

    fn pose(n_cols: usize, map: &ObstacleMap, at: usize) -> Pose2 {
        let (place, turn) = (at / Self::TURNS, at % Self::TURNS);
        let step_m = map.frame().resolution_m() / Self::FINE as f64;
        let along = |n: usize| (n as f64 + 0.5) * step_m;
        let heading = turn as f64 * 2.0 * PI / Self::TURNS as f64;
        Pose2::new(along(place % n_cols), along(place / n_cols), heading)
    }

    fn from(map: &ObstacleMap, vehicle: &Vehicle, start: usize) -> Self {
        let body = Body::new(vehicle);
        let n_cols = map.frame().n_cols() * Self::FINE;
        let n = n_cols * map.frame().n_rows() * Self::FINE * Self::TURNS;
        let is_free = |at: usize| {
            let pose = map.frame().to_grid(Self::pose(n_cols, map, at));
            map.is_free(&body, &Drive::at(pose))
        };
        let mut reached = vec![false; n];
        let mut stack = vec![start];
        while let Some(at) = stack.pop() {
            if reached[at] || !is_free(at) {
                continue;
            }
            reached[at] = true;
            let (place, turn) = (at / Self::TURNS, at % Self::TURNS);
            let turned = [1, Self::TURNS - 1].map(|by| (turn + by) % Self::TURNS);
            stack.extend(turned.map(|turn| place * Self::TURNS + turn));
            let (col, row) = (place % n_cols, place / n_cols);
            let sides = [(col > 0, 1), (row > 0, n_cols)];
            stack.extend(
                sides
                    .into_iter()
                    .filter(|(is_on, _)| *is_on)
                    .map(|(_, by)| at - by * Self::TURNS),
            );
            let others = [(col + 1 < n_cols, 1), (true, n_cols)];
            let next = others.into_iter().filter(|(is_on, _)| *is_on);
            stack.extend(
                next.map(|(_, by)| at + by * Self::TURNS)
                    .filter(|&to| to < n),
            );
        }
        Self { reached, n_cols }
    }
}

fn is_refused_as_sealed_off(map: &OccupancyGrid, vehicle: &Vehicle, ends: [Pose2; 2]) -> bool {
    let mut request = Request::new(ends[0], ends[1]);
    request.budget_steps = Some(1);
    let config = PlannerConfig::of(PlannerName::Astar);
    let mut planner = Planner::new(map, vehicle.clone(), config).expect("valid parameters");
    match planner.plan(&request, Seed(1), &mut ()).expect("a request") {
        Outcome::NotFound(failure) => failure.explanation.disconnected.is_some(),
        Outcome::Found(_) => false,
    }
}

/// Where a flood of free poses gets to, no vehicle is told that no way leads there.
#[test]
fn no_vehicle_of_any_kind_is_refused_where_a_flood_gets_to() {
    let mut n_asked = vec![0; vehicles_of_every_kind().len()];
    for seed in 0..12 {
        let parameters = ScatterParameters {
            n_cols: 24,
            n_rows: 18,
            resolution_m: [0.11, 0.23, 0.5][seed as usize % 3],
            density: [0.05, 0.2][seed as usize % 2],
            ..ScatterParameters::default()
        };
        let map = scattered_obstacles(&parameters, Seed(seed)).expect("valid parameters");
        let obstacles = ObstacleMap::new(&map);
        for (kind, vehicle) in vehicles_of_every_kind().iter().enumerate() {
            let body = Body::new(vehicle);
            let n = 24 * 18 * (Flood::FINE * Flood::FINE * Flood::TURNS) as u64;
            let mut draw = Seed(seed).stream([1, kind as u64]);
            let pose = |at| Flood::pose(24 * Flood::FINE, &obstacles, at);
            let is_free = |&at: &usize| obstacles.is_free(&body, &Drive::at(pose(at)));
            let draws = (0..200).map(|_| (draw.next_u64() % n) as usize);
            let Some(start) = draws.into_iter().find(is_free) else {
                continue;
            };
            let flood = Flood::from(&obstacles, vehicle, start);
            assert_eq!(flood.n_cols, 72);
            let there: Vec<_> = (0..n as usize).filter(|&at| flood.reached[at]).collect();
            for goal in there.iter().step_by(there.len() / 8 + 1) {
                let ends = [pose(start), pose(*goal)];
                let refused = is_refused_as_sealed_off(&map, vehicle, ends);
                assert!(!refused, "seed {seed}, vehicle {kind}: {ends:?}");
                n_asked[kind] += 1;
            }
        }
    }
    assert!(n_asked.iter().all(|&n| n >= 20), "{n_asked:?}");
}

/// No place is walled in only because the nearest obstacle is farther away than distances are
/// told apart.
#[test]
fn no_vehicle_is_refused_far_from_all_obstacles() {
    let mut rows = vec![".".repeat(200); 200];
    rows[199].replace_range(0..1, "#");
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let map = OccupancyGrid::from_rows(&rows, 0.05).expect("rows");
    for (kind, vehicle) in vehicles_of_every_kind().iter().enumerate() {
        let [near, far] = [Pose2::new(1.5, 1.5, 0.0), Pose2::new(8.0, 8.0, 0.0)];
        for ends in [[near, far], [far, near]] {
            let refused = is_refused_as_sealed_off(&map, vehicle, ends);
            assert!(!refused, "vehicle {kind}");
        }
    }
}

//! Paths of continuous curvature: certified ones are what their certificate says, and what cannot
//! be made continuous says so.

use crate::quick_or_full;
use formicar::collision::{Body, ObstacleMap};
use formicar::geometry::{Pose2, angle_difference};
use formicar::map::generate::{ScatterParameters, free_pose_pairs, scattered_obstacles};
use formicar::map::{GridFrame, OccupancyGrid};
use formicar::numeric::Seed;
use formicar::objective::DriveCost;
use formicar::path::{CurvePath, Direction, SpeedLimits};
use formicar::planner::{Outcome, PathDocument, Plan, Planner, PlannerConfig, PlannerName};
use formicar::progress::Status;
use formicar::scenario::{CurvatureMode, CurvatureRate, Request};
use formicar::smoothing::Continuity;
use formicar::validation::{ViolationKind, judge};
use formicar::vehicle::{PRESET_NAMES, Vehicle, VehicleParameters};

fn continuous(start: Pose2, goal: Pose2, max_rate_per_m2: Option<f64>) -> Request {
    Request {
        curvature: CurvatureMode::Continuous(CurvatureRate { max_rate_per_m2 }),
        ..Request::new(start, goal)
    }
}

fn plan(map: &OccupancyGrid, vehicle: &Vehicle, request: &Request) -> Outcome {
    let config = PlannerConfig::of(PlannerName::HybridAstar);
    let mut planner = Planner::new(map, vehicle.clone(), config).expect("valid parameters");
    let outcome = planner.plan(request, Seed(1), &mut ());
    outcome.expect("a valid request")
}

/// The samples tell the rate by themselves: differences of headings give curvatures, differences
/// of those give rates. Nothing of the segments' own numbers is used.
fn assert_rate_of_samples(path: &CurvePath, limit_per_m2: f64) {
    const STEP_M: f64 = 0.01;
    let mut run: Vec<f64> = Vec::new();
    for segments in path.segments().chunk_by(|a, b| a.direction == b.direction) {
        run.clear();
        let length_m: f64 = segments.iter().map(|s| s.length_m).sum();
        let heading_at = |s_m: f64| {
            let mut left_m = s_m;
            for segment in segments {
                if left_m <= segment.length_m {
                    return segment.pose_at(left_m).heading;
                }
                left_m -= segment.length_m;
            }
            path.end().heading
        };
        let n = (length_m / STEP_M) as usize;
        run.extend((0..n).map(|i| heading_at(i as f64 * STEP_M)));
        let bends = |w: &[f64]| angle_difference(w[1], w[0]) / STEP_M;
        let bends: Vec<f64> = run.windows(2).map(bends).collect();
        for pair in bends.windows(2) {
            let rate = (pair[1] - pair[0]).abs() / STEP_M;
            // Joints may miss each other by 1e-10 rad.
            assert!(rate <= limit_per_m2 + 1e-4, "{rate} beyond {limit_per_m2}");
        }
    }
}

/// The certificate against dense standing bodies: no place of the path is nearer to anything than
/// the least clearance says.
fn assert_clearance_holds(obstacles: &ObstacleMap, vehicle: &Vehicle, plan: &Plan) {
    let body = Body::new(vehicle);
    let sampled = plan.path.sample(0.02).into_iter().map(|at| {
        let pose = obstacles.frame().to_grid(at.pose);
        obstacles.clearance_m(&body, pose)
    });
    let least_m = sampled.fold(f64::INFINITY, f64::min);
    assert!(least_m > 0.0);
    assert!(least_m >= plan.certificate.min_clearance_m - 1e-9);
}

#[test]
fn random_requests_get_what_they_ask_for_or_a_reason() {
    let parameters = ScatterParameters {
        n_cols: 80,
        n_rows: 60,
        resolution_m: 0.2,
        density: 0.05,
        max_obstacle_cells: 6,
    };
    let vehicle = Vehicle::warehouse_amr();
    let (mut n_found, mut n_refused) = (0, 0);
    for seed in 0..8 {
        let map = scattered_obstacles(&parameters, Seed(seed)).expect("valid parameters");
        let obstacles = ObstacleMap::new(&map);
        let pairs = free_pose_pairs(&map, &vehicle, 3, Seed(seed)).unwrap_or_default();
        for (i, (start, goal)) in pairs.into_iter().enumerate() {
            let rate = [0.5, 1.0, 4.0][i % 3];
            let request = Request {
                budget_steps: Some(10_000),
                ..continuous(start, goal, Some(rate))
            };
            match plan(&map, &vehicle, &request) {
                Outcome::Found(plan) => {
                    n_found += 1;
                    assert_is_as_asked(&obstacles, &vehicle, &request, &plan, rate);
                }
                Outcome::NotFound(failure) => {
                    n_refused += usize::from(failure.status == Status::Infeasible);
                    assert!(!failure.reason.contains("refused"), "{}", failure.reason);
                }
            }
        }
    }
    assert!(
        n_found >= 14,
        "{n_found} found, {n_refused} without transitions"
    );
}

fn assert_is_as_asked(
    obstacles: &ObstacleMap,
    vehicle: &Vehicle,
    request: &Request,
    plan: &Plan,
    rate: f64,
) {
    assert!(plan.certificate.is_curvature_continuous);
    assert!(plan.certificate.max_curvature_rate_per_m2 <= rate * (1.0 + 1e-9));
    assert_eq!(plan.metrics.n_curvature_jumps, 0);
    assert_eq!(
        plan.metrics.max_curvature_rate_per_m2,
        plan.certificate.max_curvature_rate_per_m2
    );
    assert_eq!(plan.path.start(), request.start);
    assert!(plan.certificate.goal_error_m <= 1e-2);
    assert_rate_of_samples(&plan.path, rate);
    assert_clearance_holds(obstacles, vehicle, plan);
    let document = PathDocument::new(&plan.path, obstacles, vehicle, 0.1);
    let text = serde_json::to_string(&document).expect("numbers");
    let back: PathDocument = serde_json::from_str(&text).expect("the same document");
    assert_eq!(back.curve_path().expect("a path"), plan.path);
}

fn field() -> OccupancyGrid {
    OccupancyGrid::free(GridFrame::new(200, 200, 0.2, Pose2::default()).expect("a valid frame"))
}

/// Left, ahead, right, and back to the left in reverse.
fn winding() -> CurvePath {
    let mut path = CurvePath::new(Pose2::new(10.0, 15.0, 0.2));
    path.push(0.4, 4.0, Direction::Forward);
    path.push(0.0, 3.0, Direction::Forward);
    path.push(-0.4, 5.0, Direction::Forward);
    path.push(0.4, 2.0, Direction::Reverse);
    path.push(0.0, 4.0, Direction::Reverse);
    path
}

#[test]
fn the_ends_of_a_path_stay_where_they_are() {
    let obstacles = ObstacleMap::new(&field());
    let path = winding();
    for max_rate_per_m2 in [0.25, 0.5, 2.0, 20.0] {
        let continuity = Continuity {
            obstacles: &obstacles,
            vehicle: &Vehicle::lei2020(),
            max_rate_per_m2,
            cost: &DriveCost::default(),
        };
        let smooth = continuity.apply(&path).expect("there is room");
        assert_eq!(smooth.start(), path.start());
        let (end, goal) = (smooth.end(), path.end());
        assert!(end.position().distance(goal.position()) < 1e-9);
        assert!(angle_difference(end.heading, goal.heading).abs() < 1e-9);
        assert_rate_of_samples(&smooth, max_rate_per_m2);
        let request = continuous(path.start(), path.end(), Some(max_rate_per_m2));
        let report = judge(&obstacles, &Vehicle::lei2020(), &request, &smooth);
        assert!(report.valid, "{:?}", report.violations);
    }
}

#[test]
fn the_judge_refuses_jumps_and_fast_changes() {
    let obstacles = ObstacleMap::new(&field());
    let vehicle = Vehicle::new(VehicleParameters {
        max_steer_rate_rad_per_s: None,
        ..Vehicle::lei2020().parameters().clone()
    })
    .expect("valid measures");
    let kinds = |path: &CurvePath, rate| {
        let request = continuous(path.start(), path.end(), rate);
        let report = judge(&obstacles, &vehicle, &request, path);
        let kinds = report.violations.iter().map(|v| v.kind);
        (kinds.collect::<Vec<_>>(), report.is_curvature_continuous)
    };
    let jumps = vec![ViolationKind::CurvatureChange; 3];
    assert_eq!(kinds(&winding(), Some(0.5)), (jumps, false));
    let mut clothoid = CurvePath::new(Pose2::new(10.0, 15.0, 0.2));
    clothoid.push_clothoid([0.0, 0.4], 1.0, Direction::Forward);
    assert_eq!(kinds(&clothoid, Some(0.5)), (vec![], true));
    let fast = vec![ViolationKind::CurvatureChange];
    assert_eq!(kinds(&clothoid, Some(0.3)), (fast.clone(), true));
    // The vehicle does not say how fast its wheels turn: nothing is certified without a limit.
    assert_eq!(kinds(&clothoid, None), (fast, true));
}

#[test]
fn the_vehicles_own_rate_bounds_its_paths_and_their_time() {
    let vehicle = Vehicle::new(VehicleParameters {
        max_steer_rate_rad_per_s: Some(0.6),
        speed_mps: Some(1.0),
        ..Vehicle::lei2020().parameters().clone()
    })
    .expect("valid measures");
    let (start, goal) = (Pose2::new(5.0, 5.0, 0.0), Pose2::new(20.0, 25.0, 1.5));
    let found = |request: &Request| plan(&field(), &vehicle, request).found().expect("a path");
    let smooth = found(&continuous(start, goal, None));
    assert!(smooth.certificate.max_curvature_rate_per_m2 <= 0.3 * (1.0 + 1e-9));
    let time_s = |plan: &Plan| plan.metrics.travel_time_s.expect("a vehicle with a speed");
    assert!(time_s(&smooth) >= smooth.metrics.length_m);
    // Arcs make it stop at every joint to turn its wheels.
    assert!(time_s(&found(&Request::new(start, goal))) > time_s(&smooth));
}

#[test]
fn where_there_is_room_walls_are_not_shaved() {
    let parameters = ScatterParameters {
        n_cols: 120,
        n_rows: 90,
        resolution_m: 0.2,
        density: 0.03,
        max_obstacle_cells: 6,
    };
    let vehicle = Vehicle::warehouse_amr();
    let blind = DriveCost {
        clearance_weight: 0.0,
        ..DriveCost::default()
    };
    let (mut n_better, mut n_worse) = (0, 0);
    for seed in 0..quick_or_full(4, 8) {
        let map = scattered_obstacles(&parameters, Seed(seed)).expect("valid parameters");
        let obstacles = ObstacleMap::new(&map);
        for (start, goal) in free_pose_pairs(&map, &vehicle, 4, Seed(seed)).unwrap_or_default() {
            let Outcome::Found(plan) = plan(&map, &vehicle, &Request::new(start, goal)) else {
                continue;
            };
            let clearance_m = |cost: &DriveCost| {
                let continuity = Continuity {
                    obstacles: &obstacles,
                    vehicle: &vehicle,
                    max_rate_per_m2: 0.8,
                    cost,
                };
                let smooth = continuity.apply(&plan.path).ok()?;
                let request = continuous(start, goal, Some(0.8));
                let certificate = judge(&obstacles, &vehicle, &request, &smooth).certify();
                Some(certificate.expect("a valid path").min_clearance_m)
            };
            if let (Some(blind_m), Some(default_m)) =
                (clearance_m(&blind), clearance_m(&DriveCost::default()))
            {
                n_better += usize::from(default_m > blind_m + 0.02);
                n_worse += usize::from(default_m < blind_m - 0.02);
            }
        }
    }
    // What is weighed is the whole way, so that its tightest place may pay for others.
    assert!(
        n_better >= quick_or_full(2, 4) && n_worse <= 1,
        "{n_better} better, {n_worse} worse"
    );
}

#[test]
fn a_rate_too_small_for_the_room_is_infeasible_and_says_where() {
    // Two bends of half a meter, and a rate at which the wheels need 400 m from one to the other.
    let obstacles = ObstacleMap::new(&field());
    let mut path = CurvePath::new(Pose2::new(20.0, 20.0, 0.0));
    path.push(0.4, 0.5, Direction::Forward);
    path.push(-0.4, 0.5, Direction::Forward);
    let continuity = Continuity {
        obstacles: &obstacles,
        vehicle: &Vehicle::lei2020(),
        max_rate_per_m2: 0.001,
        cost: &DriveCost::default(),
    };
    let problem = continuity.apply(&path).expect_err("no room");
    assert!(problem.to_string().contains("0.0010 1/m^2"), "{problem}");
}

#[test]
fn every_preset_that_steers_knows_its_pace_and_the_curvature_that_it_allows() {
    let (start, goal) = (Pose2::new(8.0, 8.0, 0.0), Pose2::new(26.0, 20.0, 1.0));
    for name in PRESET_NAMES.into_iter().filter(|name| *name != "point") {
        let vehicle = Vehicle::preset(name).expect("a preset");
        let limits = SpeedLimits::of(&vehicle).expect("a pace");
        limits.check().expect("limits in range");
        let outcome = plan(&field(), &vehicle, &continuous(start, goal, None));
        let plan = outcome.found().expect("a path");
        assert!(plan.metrics.travel_time_s.is_some(), "{name}");
    }
}

//! Requests as users make them: several goals, via points in order, ground to avoid.

use crate::quick_or_full;
use formicar::collision::ObstacleMap;
use formicar::geometry::{Point2, Pose2, angle_difference};
use formicar::layers::SoftCosts;
use formicar::map::generate::{ScatterParameters, free_pose_pairs, scattered_obstacles};
use formicar::map::{Cell, OccupancyGrid};
use formicar::numeric::Seed;
use formicar::path::CurvePath;
use formicar::planner::{Outcome, Plan, Planner, PlannerConfig, PlannerName};
use formicar::progress::Status;
use formicar::scenario::{Request, StartHeading, ViaPoint};
use formicar::validation::judge;
use formicar::vehicle::{Gears, Vehicle};
use std::f64::consts::{FRAC_PI_2, PI};

fn planner(map: &OccupancyGrid, vehicle: Vehicle, name: PlannerName) -> Planner {
    Planner::new(map, vehicle, PlannerConfig::of(name)).expect("valid parameters")
}

fn drive(map: &OccupancyGrid, request: &Request) -> Outcome {
    planner(map, Vehicle::warehouse_amr(), PlannerName::HybridAstar)
        .plan(request, Seed(1), &mut ())
        .expect("a valid request")
}

fn found(outcome: Outcome) -> Plan {
    outcome.found().expect("a path")
}

/// A small map with obstacles strewn over it, and pairs of free poses.
fn strewn(seed: u64) -> (OccupancyGrid, Vec<(Pose2, Pose2)>) {
    let parameters = ScatterParameters {
        n_cols: 100,
        n_rows: 80,
        resolution_m: 0.1,
        density: 0.01,
        ..ScatterParameters::default()
    };
    let map = scattered_obstacles(&parameters, Seed(seed)).expect("valid parameters");
    let pairs = free_pose_pairs(&map, &Vehicle::warehouse_amr(), 3, Seed(seed));
    (map, pairs.unwrap_or_default())
}

/// What hybrid A* minimizes, without what obstacles near by add.
fn cost(plan: &Plan) -> f64 {
    let metrics = &plan.metrics;
    metrics.length_m + metrics.reverse_length_m + metrics.n_cusps as f64
}

/// How many times as much as the best way to one goal alone the way to any of them may cost: the
/// weight of the estimate.
const MOST_ABOVE_BEST: f64 = 1.5;

#[test]
fn of_several_goals_a_near_one_is_reached() {
    let mut n_compared = 0;
    for seed in 0..quick_or_full(3, 6) {
        let (map, pairs) = strewn(seed);
        let [(start, goal), (_, second), (_, third)] = pairs[..] else {
            continue;
        };
        let mut request = Request::new(start, goal);
        request.budget_steps = Some(20_000);
        request.other_goals = vec![second, third];
        let alone = request
            .goals()
            .map(|goal| drive(&map, &request.with_goal(goal)));
        let alone: Vec<f64> = alone
            .filter_map(|o| o.found().ok())
            .map(|p| cost(&p))
            .collect();
        let Some(best) = alone.iter().copied().reduce(f64::min) else {
            continue;
        };
        let plan = found(drive(&map, &request));
        let reached = request
            .goals()
            .nth(plan.certificate.goal_index.expect("a goal"));
        let off = reached
            .expect("one of them")
            .position()
            .distance(plan.path.end().position());
        assert!(off <= request.goal_tolerance.xy_m && plan.metrics.goal_error_m == off);
        assert!(
            cost(&plan) <= MOST_ABOVE_BEST * best + 0.1,
            "seed {seed}: {} where {best} is the best alone",
            cost(&plan)
        );
        n_compared += 1;
    }
    assert!(n_compared >= quick_or_full(2, 4), "{n_compared}");
}

/// The second goal is nearer as the crow flies, the first along the ground.
const TWO_GOALS: [&str; 9] = [
    "............#.......",
    "............#.......",
    "............#.......",
    "............#.......",
    "............#.......",
    "............#.......",
    "............#.......",
    "....................",
    "....................",
];

#[test]
fn planners_over_cells_and_colonies_take_the_goal_that_is_nearest_on_the_ground() {
    let map = OccupancyGrid::from_rows(&TWO_GOALS, 0.5).expect("rows");
    let mut request = Request::new(Pose2::new(4.75, 3.75, 0.0), Pose2::new(7.25, 3.75, 0.0));
    request.other_goals = vec![Pose2::new(0.75, 3.75, 0.0)];
    for name in PlannerName::ALL {
        let is_of_cars = matches!(
            name,
            PlannerName::Formicar | PlannerName::HybridAstar | PlannerName::Faco2024
        );
        if is_of_cars {
            continue;
        }
        let mut planner = planner(&map, Vehicle::point(), name);
        let plan = found(planner.plan(&request, Seed(1), &mut ()).expect("a request"));
        assert_eq!(plan.certificate.goal_index, Some(1), "{name:?}");
    }
    let mut planner = planner(&map, Vehicle::f1tenth(), PlannerName::Faco2024);
    let plan = found(planner.plan(&request, Seed(1), &mut ()).expect("a request"));
    assert_eq!(plan.certificate.goal_index, Some(1));
}

#[test]
fn a_goal_that_cannot_be_reached_leaves_the_others() {
    let rows = ["......#...", "......#...", "......#...", "......#..."];
    let map = OccupancyGrid::from_rows(&rows, 1.0).expect("rows");
    let mut request = Request::new(Pose2::new(4.5, 2.0, 0.0), Pose2::new(8.5, 2.0, 0.0));
    request.other_goals = vec![Pose2::new(1.5, 2.0, 0.0)];
    for name in [
        PlannerName::HybridAstar,
        PlannerName::Dijkstra,
        PlannerName::MaxMin,
    ] {
        let mut planner = planner(&map, Vehicle::f1tenth(), name);
        let plan = found(planner.plan(&request, Seed(1), &mut ()).expect("a request"));
        assert_eq!(plan.certificate.goal_index, Some(1), "{name:?}");
    }
}

/// Whether a path passes the via points in order, by dense samples.
fn passes_in_order(path: &CurvePath, via: &[ViaPoint]) -> bool {
    let mut left = via.iter().peekable();
    for at in path.sample(1e-3) {
        let within = |via: &&ViaPoint| {
            let off_rad = via
                .heading_rad
                .map_or(0.0, |h| angle_difference(at.pose.heading, h).abs());
            at.pose.position().distance(via.position) <= via.tolerance.xy_m + 1e-3
                && off_rad <= via.tolerance.yaw_rad + 1e-3
        };
        while left.next_if(within).is_some() {}
    }
    left.peek().is_none()
}

#[test]
fn via_points_are_passed_in_order() {
    let mut n_found = 0;
    for seed in 0..4 {
        let (map, pairs) = strewn(seed);
        let [(start, goal), (first, second), _] = pairs[..] else {
            continue;
        };
        let via = [first, second].map(|pose| ViaPoint::new(pose.position()));
        let with_heading = [via[0].with_heading(first.heading), via[1]];
        for via in [via, with_heading, [via[1], via[0]]] {
            let mut request = Request::new(start, goal);
            request.via = via.to_vec();
            request.budget_steps = Some(quick_or_full(5_000, 40_000));
            let Outcome::Found(plan) = drive(&map, &request) else {
                continue;
            };
            let obstacles = ObstacleMap::new(&map);
            let report = judge(&obstacles, &Vehicle::warehouse_amr(), &request, &plan.path);
            assert!(report.valid, "seed {seed}: {:?}", report.violations);
            assert_eq!(report.via_s_m.len(), via.len());
            assert!(report.via_s_m.is_sorted());
            assert!(passes_in_order(&plan.path, &via), "seed {seed}");
            n_found += 1;
        }
    }
    assert!(n_found >= quick_or_full(2, 6), "{n_found}");
}

#[test]
fn planners_pass_via_points() {
    let map = OccupancyGrid::from_rows(&TWO_GOALS, 0.5).expect("rows");
    let mut request = Request::new(Pose2::new(4.75, 3.75, 0.0), Pose2::new(7.25, 3.75, 0.0));
    request.via = [(0.75, 2.25), (3.25, 0.75)]
        .map(|(x, y)| ViaPoint::new(Point2::new(x, y)))
        .to_vec();
    // Ants that steer need more room.
    let names = PlannerName::ALL.into_iter();
    for name in names.filter(|&name| name != PlannerName::Faco2024) {
        let vehicle = match name {
            PlannerName::Formicar | PlannerName::HybridAstar => Vehicle::f1tenth(),
            _ => Vehicle::point(),
        };
        let mut planner = planner(&map, vehicle, name);
        let plan = found(planner.plan(&request, Seed(1), &mut ()).expect("a request"));
        assert_eq!(plan.certificate.via_s_m.len(), 2, "{name:?}");
        assert!(passes_in_order(&plan.path, &request.via), "{name:?}");
    }
}

#[test]
fn ants_that_steer_pass_via_points() {
    let rows = vec![".".repeat(120); 80];
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let map = OccupancyGrid::from_rows(&rows, 0.2).expect("rows");
    let mut request = Request::new(Pose2::new(3.1, 3.1, 0.0), Pose2::new(20.1, 12.1, 0.0));
    request.via = vec![ViaPoint::new(Point2::new(11.1, 8.1))];
    let mut planner = planner(&map, Vehicle::lei2020(), PlannerName::Faco2024);
    let plan = found(planner.plan(&request, Seed(1), &mut ()).expect("a request"));
    assert!(passes_in_order(&plan.path, &request.via));
}

/// A lane around a block, too narrow to turn in.
const LANE: [&str; 7] = [
    ".......", //
    ".#####.", //
    ".#####.", //
    ".#####.", //
    ".#####.", //
    ".#####.", //
    ".......", //
];

#[test]
fn where_a_heading_of_its_own_choice_leads_no_further_others_are_tried() {
    // 1.6 m to a letter, in cells of 0.4 m.
    let wide = LANE.map(|row| row.chars().flat_map(|c| [c; 4]).collect::<String>());
    let rows: Vec<&str> = wide.iter().flat_map(|row| [row.as_str(); 4]).collect();
    let map = OccupancyGrid::from_rows(&rows, 0.4).expect("rows");
    // The short way to the via point is to the left, against the goal's heading.
    let mut request = Request {
        start_heading: StartHeading::Any,
        gears: Gears::Forward,
        ..Request::new(Pose2::new(5.6, 0.8, 0.0), Pose2::new(5.6, 10.4, PI))
    };
    request.via = vec![ViaPoint::new(Point2::new(0.8, 4.0))];
    let past_via_alone = Request {
        goal_heading: formicar::scenario::GoalHeading::Any,
        ..Request::new(request.start, Pose2::new(0.8, 4.0, 0.0))
    };
    let past_via_alone = Request {
        start_heading: StartHeading::Any,
        gears: Gears::Forward,
        ..past_via_alone
    };
    let own_choice = found(drive(&map, &past_via_alone)).path.end().heading;
    assert!(
        angle_difference(own_choice, FRAC_PI_2).abs() < 0.5,
        "{own_choice}"
    );
    let plan = found(drive(&map, &request));
    assert!(passes_in_order(&plan.path, &request.via));
    assert!(plan.metrics.length_m > 40.0, "the long way around");
}

#[test]
fn a_failure_names_its_leg() {
    let rows = ["......#...", "......#...", "......#...", "......#..."];
    let map = OccupancyGrid::from_rows(&rows, 1.0).expect("rows");
    let mut request = Request::new(Pose2::new(1.5, 2.0, 0.0), Pose2::new(8.5, 2.0, 0.0));
    request.via = vec![ViaPoint::new(Point2::new(4.5, 2.0))];
    for name in [PlannerName::HybridAstar, PlannerName::Astar] {
        let mut planner = planner(&map, Vehicle::f1tenth(), name);
        let outcome = planner.plan(&request, Seed(1), &mut ()).expect("a request");
        let Outcome::NotFound(failure) = outcome else {
            panic!("{name:?} drove through a wall")
        };
        assert_eq!(failure.status, Status::NoPath);
        let start = "leg 2 of 2, from via point 1 to goal: ";
        assert!(failure.reason.starts_with(start), "{}", failure.reason);
    }
}

#[test]
fn the_budget_holds_over_all_legs() {
    let map = OccupancyGrid::from_rows(&TWO_GOALS, 0.5).expect("rows");
    let mut request = Request::new(Pose2::new(4.75, 3.75, 0.0), Pose2::new(7.25, 3.75, 0.0));
    request.via = vec![ViaPoint::new(Point2::new(0.75, 2.25))];
    let all_steps = found(drive(&map, &request)).n_steps;
    request.budget_steps = Some(all_steps);
    assert_eq!(found(drive(&map, &request)).n_steps, all_steps);
    request.budget_steps = Some(all_steps - 1);
    let Outcome::NotFound(failure) = drive(&map, &request) else {
        panic!("one step too many")
    };
    assert_eq!(failure.status, Status::BudgetExhausted);
    assert_eq!(failure.n_steps, all_steps - 1);
    assert!(
        failure.reason.starts_with("leg 2 of 2"),
        "{}",
        failure.reason
    );
}

/// A hall of 12 x 8 m with costs on a block across the straight way.
fn hall(is_unwanted: impl Fn(Cell) -> bool) -> (OccupancyGrid, SoftCosts) {
    let rows = vec![".".repeat(60); 40];
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let map = OccupancyGrid::from_rows(&rows, 0.2).expect("rows");
    let frame = map.frame();
    let value = |i| f32::from(u8::from(is_unwanted(frame.cell(i))));
    let values = (0..frame.n_cells()).map(value).collect();
    let costs = SoftCosts::new(*frame, values, 5.0).expect("values from 0 to 1");
    (map, costs)
}

/// Meters driven over unwanted ground.
fn unwanted_m(path: &CurvePath, costs: &SoftCosts) -> f64 {
    let spacing_m = 0.01;
    let samples = path.sample(spacing_m).into_iter();
    samples
        .map(|at| costs.value_at(at.pose.position()) * spacing_m)
        .sum()
}

#[test]
fn soft_costs_are_driven_around_where_that_is_worth_it() {
    let block = |cell: Cell| (25..35).contains(&cell.col) && cell.row < 28;
    let (map, costs) = hall(block);
    let request = Request::new(Pose2::new(1.5, 4.0, 0.0), Pose2::new(10.5, 4.0, 0.0));
    let straight = found(drive(&map, &request));
    let mut planner =
        planner(&map, Vehicle::warehouse_amr(), PlannerName::HybridAstar).with_soft_costs(&costs);
    let around = found(planner.plan(&request, Seed(1), &mut ()).expect("a request"));
    assert!(unwanted_m(&straight.path, &costs) > 1.9);
    let rest_m = unwanted_m(&around.path, &costs);
    assert!(rest_m < 0.7, "{rest_m} m of unwanted ground are left");
    assert!(around.metrics.length_m > straight.metrics.length_m);
}

#[test]
fn soft_costs_fail_no_search() {
    let (map, costs) = hall(|_| true);
    let request = Request::new(Pose2::new(1.5, 4.0, 0.0), Pose2::new(10.5, 4.0, FRAC_PI_2));
    let n_steps = found(drive(&map, &request)).n_steps;
    // Just as many steps as the search without them needs.
    let request = Request {
        budget_steps: Some(n_steps),
        ..request
    };
    let mut planner =
        planner(&map, Vehicle::warehouse_amr(), PlannerName::HybridAstar).with_soft_costs(&costs);
    found(planner.plan(&request, Seed(1), &mut ()).expect("a request"));
}

//! The one protocol that every planner passes.

use formicar::collision::{Body, Drive, ObstacleMap};
use formicar::colony::Stop;
use formicar::colony::chord::{FootprintSafety, Safety};
use formicar::colony::evaporation::{Constant, Evaporation};
use formicar::evolution::{AstarSeeded, InitialPopulation};
use formicar::geometry::{Point2, Pose2};
use formicar::layers::Expansion;
use formicar::map::generate::{ScatterParameters, free_pose_pairs, scattered_obstacles};
use formicar::map::{Cell, OCCUPIED, OccupancyGrid, builtin};
use formicar::numeric::Seed;
use formicar::planner::{Outcome, Plan, PlanError, Planner, PlannerConfig, PlannerName};
use formicar::progress::{Event, Observer, Status};
use formicar::scenario::{GoalHeading, GoalTolerance, MotionMode, Request, StartHeading};
use formicar::smoothing::{CornerRecord, Rounding};
use formicar::validation::judge;
use formicar::vehicle::{Motion, Vehicle};
use std::time::Duration;

/// A problem that a planner should solve: a car for those that drive, a point for the others.
struct Case {
    map: OccupancyGrid,
    vehicle: Vehicle,
    request: Request,
}

fn case(planner: PlannerName) -> Case {
    if planner == PlannerName::Faco2024 {
        return yard_case();
    }
    let (name, vehicle) = match planner {
        PlannerName::Formicar | PlannerName::HybridAstar | PlannerName::Lei2020 => {
            ("lei-map1", Vehicle::lei2020())
        }
        _ => ("wang-open", Vehicle::point()),
    };
    let builtin = builtin::BuiltinMap::by_name(name).expect("a built-in map");
    let ends = &builtin.requests[0];
    Case {
        map: builtin.grid(),
        vehicle,
        request: Request::new(ends.start, ends.goal),
    }
}

/// A yard large beside the steps of a colony that steps by chords.
fn yard_case() -> Case {
    let mut map = OccupancyGrid::from_rows(&[&".".repeat(120)[..]; 80], 0.2).expect("rows");
    for (col, row) in (40..60).flat_map(|col| (20..60).map(move |row| (col, row))) {
        map.set(Cell::new(col, row), OCCUPIED);
    }
    Case {
        map,
        vehicle: Vehicle::lei2020(),
        request: Request::new(Pose2::new(3.1, 8.1, 0.0), Pose2::new(19.1, 8.1, 0.0)),
    }
}

fn plan_with(
    planner: PlannerName,
    case: &Case,
    request: &Request,
    observer: &mut dyn Observer,
) -> Outcome {
    let mut planner = Planner::new(&case.map, case.vehicle.clone(), PlannerConfig::of(planner))
        .expect("valid parameters");
    planner
        .plan(request, Seed(1), observer)
        .expect("a valid request")
}

fn found(outcome: Outcome) -> Plan {
    outcome.found().expect("a path")
}

#[test]
fn solves_its_case_and_passes_the_judge() {
    for name in PlannerName::ALL {
        let case = case(name);
        let plan = found(plan_with(name, &case, &case.request, &mut ()));
        let report = judge(
            &ObstacleMap::new(&case.map),
            &case.vehicle,
            &case.request,
            &plan.path,
        );
        assert!(report.valid, "{name:?}: {:?}", report.violations);
        assert_eq!(report.path_hash, plan.certificate.path_hash);
        assert_eq!(plan.metrics.min_clearance_m, report.min_clearance_m);
    }
}

#[test]
fn the_same_question_gets_the_same_answer_byte_for_byte() {
    for name in PlannerName::ALL {
        let case = case(name);
        let mut warm = Planner::new(&case.map, case.vehicle.clone(), PlannerConfig::of(name))
            .expect("valid parameters");
        let first = found(
            warm.plan(&case.request, Seed(1), &mut ())
                .expect("a valid request"),
        );
        let back = Request::new(case.request.goal, case.request.start);
        let _ = warm.plan(&back, Seed(1), &mut ()).expect("a valid request");
        let again = found(
            warm.plan(&case.request, Seed(1), &mut ())
                .expect("a valid request"),
        );
        let cold = found(plan_with(name, &case, &case.request, &mut ()));
        assert_eq!(first.path, again.path, "{name:?}");
        assert_eq!(first.path, cold.path, "{name:?}");
        assert_eq!(first.certificate, cold.certificate, "{name:?}");
    }
}

#[test]
fn a_budget_stops_it() {
    for name in PlannerName::ALL {
        let case = case(name);
        let all_steps = found(plan_with(name, &case, &case.request, &mut ())).n_steps;
        let limited = |budget| {
            let request = Request {
                budget_steps: Some(budget),
                ..case.request.clone()
            };
            plan_with(name, &case, &request, &mut ())
        };
        assert_eq!(limited(all_steps).status(), Status::Found, "{name:?}");
        if name.has_ants() {
            assert_colony_stops(&limited(all_steps / 2), all_steps / 2);
            assert_eq!(limited(1).status(), Status::BudgetExhausted, "{name:?}");
            continue;
        }
        if matches!(name, PlannerName::Ga | PlannerName::Aga) {
            assert_population_stops(&limited(all_steps / 2), all_steps / 2);
            assert_population_stops(&limited(1), 1);
            continue;
        }
        match limited(all_steps / 2) {
            Outcome::Found(plan) if name == PlannerName::Formicar => {
                assert_eq!(plan.cut_by, Some(Status::BudgetExhausted));
                assert_eq!(plan.n_steps, all_steps / 2);
                assert_eq!(limited(1).status(), Status::BudgetExhausted);
            }
            Outcome::NotFound(failure) => {
                assert_eq!(failure.status, Status::BudgetExhausted, "{name:?}");
                assert_eq!(failure.n_steps, all_steps / 2, "{name:?}");
            }
            Outcome::Found(_) => panic!("{name:?} found a path with half its steps"),
        }
    }
}

/// A colony that runs out of steps still has the best path of its ants so far.
fn assert_colony_stops(outcome: &Outcome, budget: u64) {
    assert_eq!(outcome.n_steps(), budget);
    let run = outcome.stages().colony.as_ref().expect("a colony");
    assert_eq!(run.stop, Stop::Budget);
    assert!(run.best.is_some());
}

/// A population that runs out of steps, one to an individual, keeps its best; without one it says
/// why it ended.
fn assert_population_stops(outcome: &Outcome, budget: u64) {
    assert_eq!(outcome.n_steps(), budget);
    let run = outcome.stages().evolution.as_ref().expect("a population");
    assert_eq!(run.stop, Stop::Budget);
    let n_evaluated = run.history.iterations.iter();
    let n_evaluated: u32 = n_evaluated.map(|record| record.n_ants).sum();
    assert!(u64::from(n_evaluated) >= budget);
    match run.best {
        Some(_) => assert_eq!(outcome.status(), Status::Found),
        None => assert_eq!(outcome.status(), Status::BudgetExhausted),
    }
}

struct Watch {
    ticks: u64,
    cancel: bool,
    n_improved: usize,
}

impl Observer for Watch {
    fn on_event(&mut self, event: &Event) {
        self.n_improved += usize::from(matches!(event, Event::Improved { .. }));
    }

    fn elapsed(&mut self) -> Option<Duration> {
        self.ticks += 1;
        Some(Duration::from_secs(self.ticks))
    }

    fn is_cancelled(&mut self) -> bool {
        self.cancel
    }
}

#[test]
fn a_deadline_and_a_cancel_stop_it_and_are_named() {
    for name in PlannerName::ALL {
        let case = case(name);
        let mut watch = Watch {
            ticks: 0,
            cancel: true,
            n_improved: 0,
        };
        assert_eq!(
            plan_with(name, &case, &case.request, &mut watch).status(),
            Status::Cancelled
        );
        watch.cancel = false;
        let hurried = Request {
            deadline: Some(Duration::from_secs(1)),
            ..case.request.clone()
        };
        assert_eq!(
            plan_with(name, &case, &hurried, &mut watch).status(),
            Status::TimedOut
        );
        assert_eq!(watch.n_improved, 0);
        assert_eq!(
            plan_with(name, &case, &case.request, &mut watch).status(),
            Status::Found
        );
        match name {
            PlannerName::Formicar => assert!(watch.n_improved > 1),
            _ => assert_eq!(watch.n_improved, 1, "{name:?}"),
        }
        let mut planner = Planner::new(&case.map, case.vehicle.clone(), PlannerConfig::of(name))
            .expect("valid parameters");
        let no_clock = planner.plan(&hurried, Seed(1), &mut ());
        assert!(matches!(no_clock, Err(PlanError::DeadlineWithoutClock)));
    }
}

/// Where ants win the race, are improved, and a budget may end it: in any phase the same.
#[test]
fn the_number_of_threads_changes_no_race() {
    for (map, request) in [("li-neighborhood", 0), ("warehouse", 0), ("warehouse", 1)] {
        let builtin = builtin::BuiltinMap::by_name(map).expect("a built-in map");
        let vehicle = Vehicle::preset(builtin.vehicle).expect("a preset");
        let ends = &builtin.requests[request];
        for budget_steps in [None, Some(900), Some(5000)] {
            for motion in [MotionMode::Reverse, MotionMode::Forward] {
                let request = Request {
                    budget_steps,
                    motion,
                    ..Request::new(ends.start, ends.goal)
                };
                let config = PlannerConfig::of(PlannerName::Formicar);
                let plan = |n_threads: usize| {
                    let planner = Planner::new(&builtin.grid(), vehicle.clone(), config.clone());
                    let mut planner = planner.expect("parameters").with_threads(n_threads);
                    let outcome = planner.plan(&request, Seed(3), &mut ()).expect("a request");
                    let path = outcome.judged().map(|(path, _)| path.clone());
                    (outcome.status(), outcome.n_steps(), path)
                };
                let one = plan(1);
                assert_eq!(one, plan(2), "{map} {budget_steps:?}");
                assert_eq!(one, plan(7), "{map} {budget_steps:?}");
            }
        }
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    for name in PlannerName::ALL {
        let case = case(name);
        let plan = |n_threads: usize| {
            let planner = Planner::new(&case.map, case.vehicle.clone(), PlannerConfig::of(name));
            let mut planner = planner.expect("valid parameters").with_threads(n_threads);
            found(
                planner
                    .plan(&case.request, Seed(3), &mut ())
                    .expect("a valid request"),
            )
        };
        let one = plan(1);
        for n_threads in [2, 7] {
            let many = plan(n_threads);
            assert_eq!(one.path, many.path, "{name:?}");
            assert_eq!(one.certificate, many.certificate, "{name:?}");
            assert_eq!(one.metrics, many.metrics, "{name:?}");
            assert_eq!(one.n_steps, many.n_steps, "{name:?}");
        }
    }
}

fn seeded(share: f64) -> InitialPopulation {
    InitialPopulation::AstarSeeded(AstarSeeded {
        share,
        ..AstarSeeded::default()
    })
}

#[test]
fn bad_parameters_are_refused_with_their_range() {
    let map = case(PlannerName::HybridAstar).map;
    let bad: [fn(&mut PlannerConfig); 43] = [
        |c| c.drive.n_ants = 10_001,
        |c| c.drive.beta = f64::NAN,
        |c| c.drive.detour_ratio = 0.5,
        |c| c.drive.repair.toll_per_death = -1.0,
        |c| c.drive.trails.rho = 1.5,
        |c| c.cost.reverse_factor = 0.0,
        |c| c.cost.clearance_wish_m = f64::INFINITY,
        |c| c.improve.n_checked = 0,
        |c| c.colony.n_ants = 0,
        |c| c.layers.expansion = Expansion::Cells(65),
        |c| c.smoothing.n_members = 0,
        |c| c.smoothing.spline_spacing_radii = -1.0,
        |c| c.smoothing.bend_weight = f64::NAN,
        |c| c.chords.n_ants = 0,
        |c| c.chords.reach = 17,
        |c| c.chords.growth_radii.clear(),
        |c| c.chords.growth_radii[0] = -0.1,
        |c| c.chords.safety = Safety::Footprint(FootprintSafety { margin_cells: 65.0 }),
        |c| c.chords.cost.epsilon = -1.0,
        |c| c.chords.evaporation = Evaporation::Constant(Constant { rho: 1.5 }),
        |c| c.chords.deposit.pheromone = 0.0,
        |c| c.chords.initial.factor = f64::INFINITY,
        |c| c.improved_astar.distance_weight = -0.1,
        |c| c.evolution.n_individuals = 1,
        |c| c.evolution.n_generations = 0,
        |c| c.evolution.n_via = 9,
        |c| c.evolution.n_via_min = 4,
        |c| c.evolution.n_via_max = 9,
        |c| c.evolution.tournament_size = 0,
        |c| c.evolution.n_elite = 100,
        |c| c.evolution.crossover = 1.1,
        |c| c.evolution.mutation.smooth = f64::NAN,
        |c| c.evolution.collision_weight = -1.0,
        |c| c.evolution.cost.length_weight = 0.0,
        |c| c.evolution.initial = seeded(1.5),
        |c| c.hybrid_astar.weight = 0.9,
        |c| c.hybrid_astar.weight = f64::NAN,
        |c| c.hybrid_astar.max_iterations = 0,
        |c| c.hybrid_astar.angle_quantization_bins = 7,
        |c| c.hybrid_astar.step_radii = 0.0,
        |c| c.hybrid_astar.reverse_penalty = 0.5,
        |c| c.hybrid_astar.direction_switching_cost = -1.0,
        |c| c.hybrid_astar.clearance_wish_m = f64::INFINITY,
    ];
    for spoil in bad {
        let mut config = PlannerConfig::default();
        spoil(&mut config);
        let error = Planner::new(&map, Vehicle::lei2020(), config).expect_err("out of range");
        assert!(error.to_string().contains("it must be in"), "{error}");
    }
}

#[test]
fn start_equal_to_goal_is_found_with_length_0() {
    for name in PlannerName::ALL {
        let case = case(name);
        let request = Request::new(case.request.start, case.request.start);
        let plan = found(plan_with(name, &case, &request, &mut ()));
        assert!(
            plan.metrics.length_m < 1e-9,
            "{name:?}: {}",
            plan.metrics.length_m
        );
    }
}

#[test]
fn no_grid_planner_beats_another_on_its_own_map() {
    for name in [
        "lei-map1",
        "lei-map2",
        "lei-map3",
        "wang-aisles",
        "wang-open",
        "aco20",
    ] {
        let builtin = builtin::BuiltinMap::by_name(name).expect("a built-in map");
        let ends = &builtin.requests[0];
        let case = Case {
            map: builtin.grid(),
            vehicle: Vehicle::point(),
            request: Request::new(ends.start, ends.goal),
        };
        let lengths = [PlannerName::Astar, PlannerName::Dijkstra].map(|planner| {
            found(plan_with(planner, &case, &case.request, &mut ()))
                .metrics
                .length_m
        });
        assert!(
            (lengths[0] - lengths[1]).abs() < 1e-9,
            "{name}: {lengths:?}"
        );
    }
}

/// The 3 m car of the paper on a built-in map, headings free.
fn driven(map: &str, planner: PlannerName) -> Outcome {
    let builtin = builtin::BuiltinMap::by_name(map).expect("a built-in map");
    let ends = &builtin.requests[0];
    let request = Request {
        start_heading: StartHeading::Any,
        goal_heading: GoalHeading::Any,
        ..Request::new(ends.start, ends.goal)
    };
    let case = Case {
        map: builtin.grid(),
        vehicle: Vehicle::lei2020(),
        request,
    };
    plan_with(planner, &case, &case.request, &mut ())
}

#[test]
fn planners_over_cells_drive_cars_around_rounded_corners() {
    for (map, planner) in [
        ("lei-map3", PlannerName::Dijkstra),
        ("lei-map3", PlannerName::ImprovedAstar),
        ("lei-map3", PlannerName::Aga),
    ] {
        let plan = found(driven(map, planner));
        let stages = &plan.stages;
        assert!(stages.nodes.len() > 2, "{planner:?}");
        assert!(!stages.corners.is_empty(), "{planner:?}");
        let is_rounded = |corner: &CornerRecord| corner.rounding != Rounding::None;
        assert!(stages.corners.iter().all(is_rounded), "{planner:?}");
        assert_eq!(stages.evolution.is_some(), planner == PlannerName::Aga);
    }
}

#[test]
fn what_a_planner_over_cells_cannot_give_a_car_is_named() {
    for (map, planner, status, words) in [
        (
            "lei-map2",
            PlannerName::Astar,
            Status::Infeasible,
            ["astar found a way of 56 cells", "hint: hybrid-astar"],
        ),
        (
            "lei-map3",
            PlannerName::Ga,
            Status::NoPath,
            ["free of collisions", "evolution.n_via_max"],
        ),
    ] {
        let Outcome::NotFound(failure) = driven(map, planner) else {
            panic!("{planner:?} found a path on {map}")
        };
        assert_eq!(failure.status, status, "{planner:?}");
        for word in words {
            assert!(failure.reason.contains(word), "{}", failure.reason);
        }
    }
}

#[test]
fn heading_modes_gears_and_tolerances_hold() {
    let Case {
        map,
        vehicle,
        request,
    } = case(PlannerName::HybridAstar);
    let case = Case {
        map,
        vehicle,
        request,
    };
    let ask = |request: Request| {
        found(plan_with(
            PlannerName::HybridAstar,
            &case,
            &request,
            &mut (),
        ))
    };
    let forward = ask(Request {
        motion: MotionMode::Forward,
        ..case.request.clone()
    });
    assert_eq!(forward.metrics.reverse_length_m, 0.0);
    let exact = ask(case.request.clone()).metrics.length_m;
    let any = Request {
        start_heading: StartHeading::Any,
        goal_heading: GoalHeading::Any,
        ..case.request.clone()
    };
    assert!(ask(any).metrics.length_m < 1.1 * exact);
    let turned = Pose2::at(
        case.request.goal.position(),
        case.request.goal.heading + std::f64::consts::PI,
    );
    let both_ways = Request {
        goal: turned,
        goal_heading: GoalHeading::Bidirectional,
        ..case.request.clone()
    };
    assert!(ask(both_ways).metrics.length_m < 1.1 * exact);
    let wide = GoalTolerance {
        xy_m: 0.5,
        yaw_rad: 0.3,
    };
    let near = ask(Request {
        goal_tolerance: wide,
        ..case.request.clone()
    });
    assert!(near.certificate.goal_error_m <= 0.5 && near.certificate.goal_error_rad <= 0.3);
}

/// Random maps and poses: whatever is found must stand before an independent check of dense
/// poses, as a filled rectangle against cell squares.
#[test]
fn what_is_found_on_random_maps_touches_nothing() {
    let vehicles = [Vehicle::warehouse_amr(), Vehicle::f1tenth()];
    let planners = [
        PlannerName::Formicar,
        PlannerName::HybridAstar,
        PlannerName::Lei2020,
        PlannerName::Wang2019,
        PlannerName::Astar,
        PlannerName::Dijkstra,
        PlannerName::ImprovedAstar,
        PlannerName::Ga,
        PlannerName::Aga,
    ];
    let mut n_found = [0; 9];
    for seed in 0..12 {
        let parameters = ScatterParameters {
            n_cols: 120,
            n_rows: 90,
            resolution_m: 0.1,
            density: 0.01,
            ..ScatterParameters::default()
        };
        let map = scattered_obstacles(&parameters, Seed(seed)).expect("valid parameters");
        let vehicle = &vehicles[seed as usize % 2];
        for (start, goal) in free_pose_pairs(&map, vehicle, 2, Seed(seed)).unwrap_or_default() {
            let request = Request {
                budget_steps: Some(20_000),
                ..Request::new(start, goal)
            };
            let case = Case {
                map: map.clone(),
                vehicle: vehicle.clone(),
                request,
            };
            for (planner, n_found) in planners.into_iter().zip(&mut n_found) {
                if let Outcome::Found(plan) = plan_with(planner, &case, &case.request, &mut ()) {
                    *n_found += 1;
                    assert_untouched(&case, &plan);
                }
            }
        }
    }
    assert!(n_found.iter().all(|&n| n >= 10), "{n_found:?}");
}

fn assert_untouched(case: &Case, plan: &Plan) {
    assert_eq!(case.vehicle.motion(), Motion::Car);
    let limit = case.vehicle.max_curvature_per_m();
    let resolution = case.map.frame().resolution_m();
    for sample in plan.path.sample(0.02) {
        assert!(sample.curvature_per_m.abs() <= limit * (1.0 + 1e-9));
        let body = case.vehicle.footprint().placed(sample.pose);
        let (low, high) = body.bounds();
        for cell in case.map.lethal_cells().iter() {
            let corner = Point2::new(f64::from(cell.col), f64::from(cell.row)) * resolution;
            let far = corner.x > high.x
                || corner.y > high.y
                || corner.x + resolution < low.x
                || corner.y + resolution < low.y;
            if far {
                continue;
            }
            for i in 0..=4 {
                for k in 0..=4 {
                    let p = corner + Point2::new(f64::from(i), f64::from(k)) * (0.25 * resolution);
                    assert!(!body.contains(p), "{:?} covers {p:?}", sample.pose);
                }
            }
        }
    }
    let obstacles = ObstacleMap::new(&case.map);
    let body = Body::new(&case.vehicle);
    assert!(obstacles.is_free(&body, &Drive::at(plan.path.end())));
}

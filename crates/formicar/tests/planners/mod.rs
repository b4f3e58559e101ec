//! The one protocol that every planner passes.

mod cells;
mod driven;
mod own_search;
mod parameters;
mod random_maps;

use formicar::collision::ObstacleMap;
use formicar::geometry::Pose2;
use formicar::map::{Cell, OCCUPIED, OccupancyGrid, builtin};
use formicar::numeric::Seed;
use formicar::planner::{Outcome, Plan, PlanError, Planner, PlannerConfig, PlannerName};
use formicar::progress::{Event, Observer, Status, Stop};
use formicar::scenario::Request;
use formicar::validation::judge;
use formicar::vehicle::Vehicle;
use std::time::Duration;

/// The protocol for each planner, as tests of its own that run side by side.
macro_rules! protocol {
    ($($module:ident: $planner:ident,)*) => {
        $(mod $module {
            const NAME: super::PlannerName = super::PlannerName::$planner;

            #[test]
            fn solves_its_case_and_passes_the_judge() {
                super::solves_its_case_and_passes_the_judge(NAME);
            }

            #[test]
            fn the_same_question_gets_the_same_answer_byte_for_byte() {
                super::the_same_question_gets_the_same_answer_byte_for_byte(NAME);
            }

            #[test]
            fn a_budget_stops_it() {
                super::a_budget_stops_it(NAME);
            }

            #[test]
            fn a_deadline_and_a_cancel_stop_it_and_are_named() {
                super::a_deadline_and_a_cancel_stop_it_and_are_named(NAME);
            }

            #[test]
            fn the_number_of_threads_changes_nothing() {
                super::the_number_of_threads_changes_nothing(NAME);
            }

            #[test]
            fn start_equal_to_goal_is_found_with_length_0() {
                super::start_equal_to_goal_is_found_with_length_0(NAME);
            }
        })*

        #[test]
        fn the_protocol_knows_every_planner() {
            assert_eq!([$(PlannerName::$planner,)*], PlannerName::ALL);
        }
    };
}

protocol! {
    flagship: Formicar,
    hybrid_astar: HybridAstar,
    astar: Astar,
    dijkstra: Dijkstra,
    improved_astar: ImprovedAstar,
    ga: Ga,
    aga: Aga,
    ant_system: AntSystem,
    elitist: Elitist,
    max_min: MaxMin,
    lei2020: Lei2020,
    wang2019: Wang2019,
    zhang2016: Zhang2016,
    joshy2016: Joshy2016,
    faco2024: Faco2024,
    aco: Aco,
    acof: Acof,
}

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

fn solves_its_case_and_passes_the_judge(name: PlannerName) {
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

fn the_same_question_gets_the_same_answer_byte_for_byte(name: PlannerName) {
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

fn a_budget_stops_it(name: PlannerName) {
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
        return;
    }
    if matches!(name, PlannerName::Ga | PlannerName::Aga) {
        assert_population_stops(&limited(all_steps / 2), all_steps / 2);
        assert_population_stops(&limited(1), 1);
        return;
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
    n_steps: u64,
}

impl Observer for Watch {
    fn on_event(&mut self, event: &Event) {
        self.n_improved += usize::from(matches!(event, Event::Improved { .. }));
        if let Event::Progress { n_steps } | Event::Improved { n_steps, .. } = event {
            assert!(*n_steps >= self.n_steps, "{n_steps} after {}", self.n_steps);
            self.n_steps = *n_steps;
        }
    }

    fn elapsed(&mut self) -> Option<Duration> {
        self.ticks += 1;
        Some(Duration::from_secs(self.ticks))
    }

    fn is_cancelled(&mut self) -> bool {
        self.cancel
    }
}

fn a_deadline_and_a_cancel_stop_it_and_are_named(name: PlannerName) {
    let case = case(name);
    let mut watch = Watch {
        ticks: 0,
        cancel: true,
        n_improved: 0,
        n_steps: 0,
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
    watch.n_steps = 0;
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

fn the_number_of_threads_changes_nothing(name: PlannerName) {
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

fn start_equal_to_goal_is_found_with_length_0(name: PlannerName) {
    let case = case(name);
    let request = Request::new(case.request.start, case.request.start);
    let plan = found(plan_with(name, &case, &request, &mut ()));
    assert!(
        plan.metrics.length_m < 1e-9,
        "{name:?}: {}",
        plan.metrics.length_m
    );
}

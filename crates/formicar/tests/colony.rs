//! Colonies: the same on any number of threads, never better than the optimum, stopped when asked.

use formicar::colony::corridor::{Corridor, RatioCorridor};
use formicar::colony::dead_end::{DeadEnd, Retreat};
use formicar::colony::evaporation::{Evaporation, PoissonEvaporation};
use formicar::colony::heuristic::{Advantage, Guidance, StepLength, Visibility};
use formicar::colony::initial::{AstarSeed, InitialPheromone};
use formicar::colony::{ColonyConfig, ColonyProblem, ColonyRun, RunError, Stopping, presets, run};
use formicar::map::{BitGrid, Cell, MoveMasks, STEPS, builtin};
use formicar::numeric::Seed;
use formicar::path::GridPath;
use formicar::progress::{Event, Limits, Observer, Stop};
use formicar::search::GoalField;
use std::f64::consts::SQRT_2;
use std::time::Duration;

fn all_presets() -> [(&'static str, ColonyConfig); 9] {
    [
        ("ant-system", presets::ant_system()),
        ("elitist", presets::elitist()),
        ("max-min", presets::max_min()),
        ("lei2020", presets::lei2020()),
        ("wang2019", presets::wang2019()),
        ("zhang2016", presets::zhang2016()),
        ("joshy2016", presets::joshy2016()),
        ("aco", presets::aco()),
        ("acof", presets::acof()),
    ]
}

/// A smaller colony, for tests.
fn small(config: ColonyConfig) -> ColonyConfig {
    ColonyConfig {
        n_ants: config.n_ants.min(40),
        n_iterations: 30,
        ..config
    }
}

fn builtin_problem(name: &str, config: &ColonyConfig) -> ColonyProblem {
    let map = builtin::BuiltinMap::by_name(name).expect("a built-in map");
    let (grid, ends) = (map.grid(), &map.requests[0]);
    let cell = |pose: formicar::geometry::Pose2| grid.frame().cell_at(pose.position());
    let moves = MoveMasks::new(&grid.lethal_cells(), config.diagonal_rule);
    let [start, goal] = [cell(ends.start), cell(ends.goal)].map(|c| c.expect("on the map"));
    ColonyProblem::new(moves, start, goal)
}

/// Rows from the top; `#` is blocked, `S` and `G` are the ends.
fn drawn(rows: &[&str], config: &ColonyConfig) -> ColonyProblem {
    let mut blocked = BitGrid::new(rows[0].len(), rows.len());
    let mut ends = [Cell::default(); 2];
    for (row, line) in rows.iter().rev().enumerate() {
        for (col, symbol) in line.bytes().enumerate() {
            let cell = Cell::new(col as u32, row as u32);
            match symbol {
                b'#' => blocked.insert(cell),
                b'S' => ends[0] = cell,
                b'G' => ends[1] = cell,
                _ => {}
            }
        }
    }
    let moves = MoveMasks::new(&blocked, config.diagonal_rule);
    ColonyProblem::new(moves, ends[0], ends[1])
}

fn run_on(problem: &ColonyProblem, config: &ColonyConfig, n_threads: usize) -> ColonyRun {
    let mut nobody = ();
    let mut limits = Limits::new(&mut nobody, None, None);
    run(problem, config, Seed(1), n_threads, &mut limits).expect("a valid run")
}

fn length_cells(path: &GridPath) -> f64 {
    let step = |pair: &[Cell]| {
        let is_diagonal = pair[0].col != pair[1].col && pair[0].row != pair[1].row;
        if is_diagonal { SQRT_2 } else { 1.0 }
    };
    path.cells.windows(2).map(step).sum()
}

fn assert_walks_on_moves(problem: &ColonyProblem, path: &GridPath) {
    let moves = problem.moves();
    assert_eq!(path.cells.first(), Some(&problem.start()));
    assert_eq!(path.cells.last(), Some(&problem.goal()));
    for pair in path.cells.windows(2) {
        let step = STEPS.iter().position(|&(dx, dy)| {
            let to = (
                i64::from(pair[0].col) + i64::from(dx),
                i64::from(pair[0].row) + i64::from(dy),
            );
            to == (i64::from(pair[1].col), i64::from(pair[1].row))
        });
        assert!(
            moves.moves(pair[0]) >> step.expect("a neighbor") & 1 == 1,
            "{pair:?}"
        );
    }
}

#[test]
fn a_run_is_the_same_on_any_number_of_threads() {
    for (name, config) in all_presets() {
        let config = small(config);
        let problem = builtin_problem("aco20", &config);
        let one = run_on(&problem, &config, 1);
        for n_threads in [2, 7] {
            let many = run_on(&problem, &config, n_threads);
            assert_eq!(one.best, many.best, "{name}");
            assert_eq!(one.history, many.history, "{name}");
            let bits = |run: &ColonyRun| run.pheromone.iter().map(|tau| tau.to_bits()).collect();
            let (a, b): (Vec<u32>, Vec<u32>) = (bits(&one), bits(&many));
            assert_eq!(a, b, "{name}");
        }
        let mut nobody = ();
        let mut limits = Limits::new(&mut nobody, None, None);
        let other = run(&problem, &config, Seed(2), 1, &mut limits).expect("a valid run");
        assert_ne!(one.history, other.history, "{name}: the seed matters");
    }
}

#[test]
fn no_colony_beats_the_optimum_of_its_own_moves() {
    for map in ["lei-map1", "wang-aisles", "wang-open", "aco20"] {
        for (name, config) in all_presets() {
            let config = small(config);
            let problem = builtin_problem(map, &config);
            let mut nobody = ();
            let mut limits = Limits::new(&mut nobody, None, None);
            let field = GoalField::new(problem.moves(), &[problem.goal()], &mut limits);
            let optimum = field.expect("a goal").distance_cells(problem.start());
            let optimum = optimum.expect("a way");
            let Some(best) = run_on(&problem, &config, 1).best else {
                continue;
            };
            assert_walks_on_moves(&problem, &best);
            let length = length_cells(&best);
            assert!(
                length >= optimum * (1.0 - 1e-6),
                "{name} on {map}: {length} < {optimum}"
            );
        }
    }
}

#[test]
fn wang_finds_the_optimum_of_an_open_map_and_shuns_narrow_aisles() {
    let config = presets::wang2019();
    let problem = builtin_problem("wang-open", &config);
    let mut nobody = ();
    let mut limits = Limits::new(&mut nobody, None, None);
    let field = GoalField::new(problem.moves(), &[problem.goal()], &mut limits).expect("a goal");
    let optimum = field.distance_cells(problem.start()).expect("a way");
    let best = run_on(&problem, &config, 1).best.expect("a path");
    assert!(length_cells(&best) < 1.02 * optimum);

    let squeezes = |config: &ColonyConfig| {
        let problem = builtin_problem("wang-aisles", config);
        let best = run_on(&problem, config, 1).best.expect("a path");
        let blocked = problem.moves().blocked();
        let between = |pair: &[Cell]| {
            let beside = [(pair[0].col, pair[1].row), (pair[1].col, pair[0].row)];
            beside
                .iter()
                .all(|&(col, row)| blocked.get(col as usize, row as usize))
        };
        best.cells.windows(2).filter(|pair| between(pair)).count()
    };
    assert_eq!(squeezes(&config), 0);
    assert!(squeezes(&presets::zhang2016()) > 0);
}

#[test]
fn rules_that_no_preset_uses_find_a_way_too() {
    let rules = ColonyConfig {
        visibility: Visibility::StepLength(StepLength { beta: 1.0 }),
        guidance: Guidance::Advantage(Advantage { beta: 2.0 }),
        ..small(presets::wang2019())
    };
    let problem = builtin_problem("lei-map3", &rules);
    assert!(run_on(&problem, &rules, 1).best.is_some());
}

#[test]
fn a_corridor_as_wide_as_the_map_changes_nothing_and_a_narrow_one_is_kept() {
    let free = ColonyConfig {
        corridor: Corridor::None,
        ..small(presets::acof())
    };
    let within = |ratio: f64, step_loss_cells: f64| ColonyConfig {
        corridor: Corridor::Ratio(RatioCorridor {
            ratio,
            step_loss_cells,
        }),
        ..free.clone()
    };
    let problem = builtin_problem("lei-map3", &free);
    let (all, wide) = (
        run_on(&problem, &free, 1),
        run_on(&problem, &within(10.0, 3.0), 1),
    );
    assert_eq!((&wide.best, &wide.history), (&all.best, &all.history));
    let narrow = run_on(&problem, &within(1.05, 0.5), 1);
    let n_cells = |run: &ColonyRun| run.pheromone.iter().filter(|tau| !tau.is_nan()).count();
    assert!(2 * n_cells(&narrow) < n_cells(&all));
    let mut nobody = ();
    let mut limits = Limits::new(&mut nobody, None, None);
    let field = GoalField::new(problem.moves(), &[problem.goal()], &mut limits).expect("a goal");
    let best = narrow.best.expect("a path");
    let to_go = |cell: &Cell| field.distance_cells(*cell).expect("a way");
    assert!(best.cells.windows(2).all(|w| to_go(&w[1]) < to_go(&w[0])));
    assert!(
        narrow
            .history
            .iterations
            .iter()
            .all(|i| i.n_arrived == i.n_ants)
    );
}

#[test]
fn the_first_ants_follow_a_seed() {
    let seeded = |factor: f64| {
        let config = ColonyConfig {
            initial: InitialPheromone::AstarSeed(AstarSeed {
                factor,
                ..AstarSeed::default()
            }),
            n_iterations: 1,
            ..presets::aco()
        };
        let problem = builtin_problem("lei-map3", &config);
        let length = run_on(&problem, &config, 1).history.iterations[0].mean_length;
        length.expect("ants arrive")
    };
    let (plain, thick) = (seeded(1.0), seeded(100.0));
    assert!(thick < plain, "{thick} {plain}");
}

/// The ants' greed leads into the pocket before the goal, which has no way on.
const TRAP: [&str; 7] = [
    ".........",
    ".#######.",
    ".......#.",
    "S......#G",
    ".......#.",
    ".#######.",
    ".........",
];

#[test]
fn ants_step_back_out_of_dead_ends_where_told() {
    let dying = ColonyConfig {
        n_ants: 20,
        n_iterations: 1,
        visibility: Visibility::None,
        ..presets::lei2020()
    };
    let retreating = ColonyConfig {
        dead_end: DeadEnd::Retreat(Retreat { max_steps: 1000 }),
        ..dying.clone()
    };
    let arrived = |config: &ColonyConfig| {
        let problem = drawn(&TRAP, config);
        run_on(&problem, config, 1).history.iterations[0].n_arrived
    };
    assert_eq!(arrived(&retreating), 20);
    assert!(arrived(&dying) < 20);
}

#[test]
fn stops_by_stall_target_budget_and_iterations() {
    let config = presets::wang2019();
    let problem = builtin_problem("wang-open", &config);
    let with = |stopping: Stopping| ColonyConfig {
        stopping,
        ..config.clone()
    };
    let whole = run_on(&problem, &config, 1);
    assert_eq!(
        (whole.stop, whole.history.iterations.len()),
        (Stop::Iterations, 200)
    );
    let stalled = run_on(
        &problem,
        &with(Stopping {
            stall_iterations: 10,
            least_gain: 0.0,
            target_cost: 0.0,
        }),
        1,
    );
    let (n, converged) = (
        stalled.history.iterations.len(),
        stalled.history.converged_after(),
    );
    assert_eq!(
        (stalled.stop, converged),
        (Stop::Stall, Some(n as u32 - 10))
    );
    let target = run_on(
        &problem,
        &with(Stopping {
            stall_iterations: 0,
            least_gain: 0.0,
            target_cost: 40.0,
        }),
        1,
    );
    assert_eq!(target.stop, Stop::TargetCost);

    let mut nobody = ();
    let mut limits = Limits::new(&mut nobody, Some(5_000), None);
    let cut = run(&problem, &config, Seed(1), 1, &mut limits).expect("a valid run");
    assert_eq!((cut.stop, limits.n_steps()), (Stop::Budget, 5_000));
    let (last, full) = (cut.history.iterations.len() - 1, whole.history.iterations);
    assert_eq!(cut.history.iterations[..last], full[..last]);
    assert!(cut.history.iterations[last].n_ants < 30);
}

/// Counts iterations; its clock shows a second more at every look, and it may cancel.
#[derive(Default)]
struct Watch {
    n_looks: u64,
    n_iterations: u32,
    n_arrived: usize,
    cancels_at: Option<u32>,
}

impl Observer for Watch {
    fn on_event(&mut self, event: &Event) {
        if let Event::Iteration(view) = event {
            assert_eq!(view.record.iteration, self.n_iterations);
            self.n_iterations += 1;
            let arrived = view.ways.arrived.iter().filter(|&&arrived| arrived);
            self.n_arrived = arrived.count();
            assert_eq!(self.n_arrived, view.record.n_arrived as usize);
            assert_eq!(view.ways.n_ants(), view.record.n_ants as usize);
        }
    }

    fn elapsed(&mut self) -> Option<Duration> {
        self.n_looks += 1;
        Some(Duration::from_secs(self.n_looks))
    }

    fn is_cancelled(&mut self) -> bool {
        self.cancels_at.is_some_and(|at| self.n_iterations >= at)
    }
}

#[test]
fn deadline_and_cancel_are_seen_at_once_and_cut_iterations_are_dropped() {
    let config = presets::wang2019();
    let problem = builtin_problem("wang-open", &config);
    let mut watch = Watch::default();
    // The clock ticks at each look: whatever notices the deadline asks once or twice more.
    let mut limits = Limits::new(&mut watch, None, Some(Duration::from_secs(40)));
    let late = run(&problem, &config, Seed(1), 1, &mut limits).expect("a valid run");
    let n_iterations = late.history.iterations.len() as u32;
    assert_eq!(
        (late.stop, watch.n_iterations),
        (Stop::Deadline, n_iterations)
    );
    assert!(n_iterations > 0 && (40..43).contains(&watch.n_looks));
    let mut watch = Watch {
        cancels_at: Some(5),
        ..Watch::default()
    };
    let mut limits = Limits::new(&mut watch, None, None);
    let cancelled = run(&problem, &config, Seed(1), 1, &mut limits).expect("a valid run");
    assert_eq!((cancelled.stop, watch.n_iterations), (Stop::Cancelled, 5));
}

#[test]
fn no_way_and_no_room_are_told() {
    let config = small(presets::lei2020());
    let walled = drawn(&["S.#.G", "..#..", "..#.."], &config);
    let run = run_on(&walled, &config, 1);
    assert_eq!((run.stop, run.best), (Stop::NoWay, None));
    let here = drawn(&["...", ".S.", "..."], &config);
    let here = ColonyProblem::new(here.moves().clone(), Cell::new(1, 1), Cell::new(1, 1));
    let path = run_on(&here, &config, 1).best.expect("a path");
    assert_eq!(path.cells, [Cell::new(1, 1)]);
    let blocked = ColonyProblem::new(walled.moves().clone(), Cell::new(2, 0), Cell::new(0, 0));
    let mut nobody = ();
    let mut limits = Limits::new(&mut nobody, None, None);
    let error = formicar::colony::run(&blocked, &config, Seed(1), 1, &mut limits);
    assert!(matches!(error, Err(RunError::Search(_))));
}

/// Takes a parameter out of its range.
type Spoil = fn(&mut ColonyConfig);

#[test]
fn bad_parameters_are_refused_with_their_range() {
    let bad: [(&str, Spoil); 8] = [
        ("n_ants = 0; it must be in 1", |c| c.n_ants = 0),
        ("n_iterations = 0", |c| c.n_iterations = 0),
        ("alpha = -1", |c| c.alpha = -1.0),
        ("turn_weight = NaN", |c| c.cost.turn_weight = f64::NAN),
        ("target_cost = -2", |c| c.stopping.target_cost = -2.0),
        ("corridor.ratio = 0.9", |c| {
            c.corridor = Corridor::Ratio(RatioCorridor {
                ratio: 0.9,
                ..RatioCorridor::default()
            });
        }),
        ("initial.factor = 0", |c| {
            c.initial = InitialPheromone::AstarSeed(AstarSeed {
                factor: 0.0,
                ..AstarSeed::default()
            });
        }),
        ("rho at iteration 9 = -0.05", |c| {
            c.evaporation = Evaporation::Poisson(PoissonEvaporation {
                offset: 0.575,
                ..PoissonEvaporation::default()
            });
        }),
    ];
    for (named, spoil) in bad {
        let mut config = presets::lei2020();
        spoil(&mut config);
        let message = config.check().expect_err("out of range").to_string();
        assert!(message.contains(named), "{message}");
    }
}

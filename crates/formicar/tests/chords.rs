//! The colony that steps by chords: determinism, safety, and what each rule changes.

use formicar::collision::ObstacleMap;
use formicar::colony::ColonyRun;
use formicar::colony::chord::{ChordConfig, ChordProblem, FootprintSafety, Safety, run_chords};
use formicar::geometry::Pose2;
use formicar::layers::SweptMasks;
use formicar::map::generate::{ScatterParameters, scattered_obstacles};
use formicar::map::{BitGrid, Cell, DiagonalRule, MoveMasks, OCCUPIED, OccupancyGrid};
use formicar::numeric::Seed;
use formicar::planner::{ChordParameters, Outcome, Planner, PlannerConfig};
use formicar::progress::{Event, Limits, Observer, Status, Stop};
use formicar::scenario::{GoalHeading, Request};
use formicar::vehicle::Vehicle;
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_2;

const RESOLUTION_M: f64 = 0.2;

/// An open yard of 30 x 20 m with some posts.
fn yard(seed: u64) -> OccupancyGrid {
    let parameters = ScatterParameters {
        n_cols: 150,
        n_rows: 100,
        resolution_m: RESOLUTION_M,
        density: 0.002,
        ..ScatterParameters::default()
    };
    let mut map = scattered_obstacles(&parameters, Seed(seed)).expect("a map");
    for end in [START, GOAL] {
        let cell = map.frame().cell_at(end.position()).expect("on the map");
        for (col, row) in (cell.col - 10..cell.col + 25)
            .flat_map(|c| (cell.row - 6..cell.row + 7).map(move |r| (c, r)))
        {
            map.set(Cell::new(col, row), 0);
        }
    }
    map
}

const START: Pose2 = Pose2 {
    x: 3.1,
    y: 5.1,
    heading: 0.0,
};
const GOAL: Pose2 = Pose2 {
    x: 24.1,
    y: 15.1,
    heading: 0.0,
};

fn run(map: &OccupancyGrid, config: &ChordConfig, n_threads: usize) -> ColonyRun {
    run_watched(map, config, n_threads, &mut ())
}

fn run_watched(
    map: &OccupancyGrid,
    config: &ChordConfig,
    n_threads: usize,
    observer: &mut dyn Observer,
) -> ColonyRun {
    let obstacles = ObstacleMap::new(map);
    let moves = MoveMasks::new(obstacles.lethal(), DiagonalRule::NoObstacles);
    let problem = ChordProblem {
        obstacles: &obstacles,
        vehicle: &Vehicle::lei2020(),
        moves: &moves,
        start: START,
        start_heading_is_exact: true,
        goal: map.frame().cell_at(GOAL.position()).expect("on the map"),
    };
    let mut limits = Limits::new(observer, None, None);
    run_chords(&problem, config, Seed(5), n_threads, &mut limits).expect("a run")
}

#[test]
fn threads_change_no_bit_of_a_run() {
    let (map, config) = (yard(1), ChordConfig::default());
    let one = run(&map, &config, 1);
    assert!(one.best.is_some());
    for n_threads in [2, 7] {
        let many = run(&map, &config, n_threads);
        assert_eq!(one.best, many.best);
        assert_eq!(one.history, many.history);
        let bits = |run: &ColonyRun| {
            run.pheromone
                .iter()
                .map(|t| t.to_bits())
                .collect::<Vec<_>>()
        };
        assert_eq!(bits(&one), bits(&many));
    }
}

#[test]
fn costs_of_the_best_never_rise_and_earlier_ones_were_dearer() {
    let run = run(&yard(2), &ChordConfig::default(), 1);
    let costs: Vec<f64> = run
        .history
        .iterations
        .iter()
        .filter_map(|r| r.best_so_far_cost)
        .collect();
    assert!(costs.windows(2).all(|w| w[1] <= w[0]), "{costs:?}");
    let mut distinct = costs.clone();
    distinct.dedup();
    assert_eq!(run.earlier.len() + 1, distinct.len());
    assert_eq!(run.stop, Stop::Stall);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(ProptestConfig::default().cases / 50))]

    #[test]
    fn every_step_of_every_ant_is_safe_within_the_steering_limit(seed in 0_u64..1000) {
        let map = yard(seed);
        let config = ChordConfig { n_iterations: 2, ..ChordConfig::default() };
        let margin_m = 0.5 * RESOLUTION_M;
        let mut watch = Watch { vehicle: Vehicle::lei2020(), margin_m, lethal: map.lethal_cells(), n_steps: 0 };
        run_watched(&map, &config, 1, &mut watch);
        prop_assert!(watch.n_steps > 100);
    }
}

/// Looks at every chord of every ant.
struct Watch {
    vehicle: Vehicle,
    margin_m: f64,
    lethal: BitGrid,
    n_steps: usize,
}

impl Observer for Watch {
    fn on_event(&mut self, event: &Event) {
        let Event::Iteration(view) = event else {
            return;
        };
        let masks = SweptMasks::new(&self.vehicle, self.margin_m, view.ways.moves, RESOLUTION_M);
        let [wheelbase_m, max_steer_rad] = self.vehicle.steering_geometry();
        for ant in 0..view.ways.n_ants() {
            let cells = view.ways.way(ant).cells;
            let steps = view.ways.steps(ant);
            let mut heading_rad: Option<f64> = None;
            for (pair, &step) in cells.windows(2).zip(steps) {
                let (dx, dy) = (
                    f64::from(pair[1].col) - f64::from(pair[0].col),
                    f64::from(pair[1].row) - f64::from(pair[0].row),
                );
                if usize::from(step) < view.ways.moves.len() {
                    assert!(
                        masks.is_clear(&self.lethal, pair[0], usize::from(step)),
                        "{pair:?}"
                    );
                }
                if let Some(heading_rad) = heading_rad {
                    let turn_rad = formicar::geometry::angle_difference(dy.atan2(dx), heading_rad);
                    let length_m = RESOLUTION_M * dx.hypot(dy);
                    let needed_rad = (wheelbase_m * turn_rad.abs() / length_m).atan();
                    assert!(needed_rad <= max_steer_rad + 1e-9, "{needed_rad}");
                }
                heading_rad = Some(dy.atan2(dx));
                self.n_steps += 1;
            }
        }
    }
}

/// An alley of 2.2 m between two yards: the 1 m wide vehicle fits, the disc that holds it does not.
fn alley() -> (OccupancyGrid, Request) {
    let mut map =
        OccupancyGrid::from_rows(&[&".".repeat(200)[..]; 60], RESOLUTION_M).expect("rows");
    for row in (0..60).filter(|row| !(25..36).contains(row)) {
        for col in 60..140 {
            map.set(Cell::new(col, row), OCCUPIED);
        }
    }
    let request = Request {
        goal_heading: GoalHeading::Any,
        ..Request::new(Pose2::new(3.1, 3.1, FRAC_PI_2), Pose2::new(36.1, 9.1, 0.0))
    };
    (map, request)
}

#[test]
fn the_footprint_passes_an_alley_that_a_disc_closes() {
    let (map, request) = alley();
    let plan = |safety: Safety| {
        let mut parameters = ChordParameters::default();
        parameters.chords.safety = safety;
        let config = PlannerConfig::Faco2024(parameters);
        let mut planner = Planner::new(&map, Vehicle::lei2020(), config).expect("valid");
        planner.plan(&request, Seed(1), &mut ()).expect("valid")
    };
    let footprint = plan(Safety::Footprint(FootprintSafety::default()));
    assert_eq!(footprint.status(), Status::Found);
    let Outcome::NotFound(disc) = plan(Safety::Disc) else {
        panic!("the disc does not fit");
    };
    assert_eq!(disc.status, Status::BudgetExhausted);
    assert!(disc.reason.contains("none of 50 ants"), "{}", disc.reason);
}

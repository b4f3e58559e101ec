//! The planners over cells on generated neighborhoods: how many of their ways cars can drive.

use crate::quick_or_full;
use formicar::evolution::EvolutionConfig;
use formicar::map::generate::{NeighborhoodParameters, alley_neighborhood, free_pose_pairs};
use formicar::numeric::Seed;
use formicar::planner::{EvolutionParameters, Outcome, Planner, PlannerConfig, PlannerName};
use formicar::scenario::{GoalHeading, Request, StartHeading};
use formicar::vehicle::Vehicle;

const N_WAYS: usize = 8;

/// What became of the requests.
#[derive(Default)]
struct Tally {
    n_asked: usize,
    /// Ways over cells, or polylines that are free of collisions.
    n_ways: usize,
    n_certified: usize,
    length_m: f64,
}

fn tally(vehicle: &Vehicle, config: &PlannerConfig) -> Tally {
    let mut tally = Tally::default();
    for seed in 0..quick_or_full(1, 3) {
        let parameters = NeighborhoodParameters::default();
        let map = alley_neighborhood(&parameters, Seed(seed)).expect("a map");
        let planner = Planner::new(&map, vehicle.clone(), config.clone());
        let mut planner = planner.expect("valid parameters");
        let pairs = free_pose_pairs(&map, vehicle, N_WAYS, Seed(seed)).expect("free poses");
        for (start, goal) in pairs {
            let request = Request {
                start_heading: StartHeading::Any,
                goal_heading: GoalHeading::Any,
                ..Request::new(start, goal)
            };
            let outcome = planner.plan(&request, Seed(1), &mut ());
            let outcome = outcome.expect("a valid request");
            tally.n_asked += 1;
            tally.n_ways += usize::from(!outcome.stages().nodes.is_empty());
            if let Outcome::Found(plan) = outcome {
                tally.n_certified += 1;
                tally.length_m += plan.metrics.length_m;
            }
        }
    }
    tally
}

fn certified(vehicle_name: &str, what: &str, config: &PlannerConfig) -> Tally {
    let vehicle = Vehicle::preset(vehicle_name).expect("a preset");
    let tally = tally(&vehicle, config);
    println!(
        "{vehicle_name:13} {what:22} ways {:2}, certified {:2} of {:2}, mean length {:.1} m",
        tally.n_ways,
        tally.n_certified,
        tally.n_asked,
        tally.length_m / tally.n_certified.max(1) as f64
    );
    tally
}

#[test]
fn cars_can_drive_ways_of_planners_over_cells() {
    for vehicle in ["warehouse_amr", "sedan"] {
        let of =
            |planner: PlannerName| certified(vehicle, planner.name(), &PlannerConfig::of(planner));
        let [astar, improved, ga, aga] = [
            PlannerName::Astar,
            PlannerName::ImprovedAstar,
            PlannerName::Ga,
            PlannerName::Aga,
        ]
        .map(of);
        assert_eq!(astar.n_ways, improved.n_ways, "both find what there is");
        assert!(ga.n_ways <= astar.n_ways && aga.n_ways <= astar.n_ways);
        for tally in [&astar, &improved, &ga, &aga] {
            assert!(3 * tally.n_certified > tally.n_asked);
        }
    }
}

#[test]
fn the_number_of_via_points_limits_what_a_population_can_pass() {
    let config = PlannerConfig::of(PlannerName::Aga);
    let free = certified("warehouse_amr", "aga, 1 to 8 points", &config);
    let mut parameters = EvolutionParameters::of(EvolutionConfig::aga());
    parameters.evolution.n_via_min = 3;
    parameters.evolution.n_via_max = 3;
    let config = PlannerConfig::Aga(parameters);
    let three = certified("warehouse_amr", "aga, 3 points", &config);
    assert!(three.n_ways < free.n_ways);
}

//! Parameters out of range are refused.

use super::case;
use formicar::colony::chord::{FootprintSafety, Safety};
use formicar::colony::evaporation::{Constant, Evaporation};
use formicar::evolution::{AstarSeeded, InitialPopulation};
use formicar::layers::Expansion;
use formicar::planner::{
    AstarParameters, ChordParameters, ColonyParameters, EvolutionParameters, FormicarParameters,
    HybridAstarParameters, ImprovedAstarParameters, Planner, PlannerConfig, PlannerName,
};
use formicar::vehicle::Vehicle;
use std::any::Any;

fn seeded(share: f64) -> InitialPopulation {
    InitialPopulation::AstarSeeded(AstarSeeded {
        share,
        ..AstarSeeded::default()
    })
}

/// Whether a planner refuses each of some changes of its parameters.
fn refused<P: Any>(planner: PlannerName, changes: &[fn(&mut P)]) {
    let map = case(planner).map;
    for spoil in changes {
        let mut config = PlannerConfig::of(planner);
        spoil(config.family_mut().expect("its own parameters"));
        let error = Planner::new(&map, Vehicle::lei2020(), config).expect_err("out of range");
        assert!(error.to_string().contains("it must be in"), "{error}");
    }
}

#[test]
fn bad_parameters_are_refused_with_their_range() {
    refused(
        PlannerName::Formicar,
        &[
            |c: &mut FormicarParameters| c.drive.n_ants = 10_001,
            |c| c.drive.beta = f64::NAN,
            |c| c.drive.detour_ratio = 0.5,
            |c| c.drive.repair.toll_per_death = -1.0,
            |c| c.drive.trails.rho = 1.5,
            |c| c.cost.reverse_factor = 0.0,
            |c| c.cost.clearance_wish_widths = f64::INFINITY,
            |c| c.cost.gear_switch_radii = -1.0,
            |c| c.improve.n_checked = 0,
        ],
    );
}

#[test]
fn bad_parameters_of_colonies_and_planners_over_cells_are_refused() {
    refused(
        PlannerName::AntSystem,
        &[
            |c: &mut ColonyParameters| c.colony.n_ants = 0,
            |c| c.layers.expansion = Expansion::Cells(65),
        ],
    );
    refused(
        PlannerName::Astar,
        &[
            |c: &mut AstarParameters| c.smoothing.n_members = 0,
            |c| c.smoothing.spline_spacing_radii = -1.0,
            |c| c.smoothing.bend_weight = f64::NAN,
        ],
    );
}

#[test]
fn bad_parameters_of_ants_that_steer_are_refused() {
    refused(
        PlannerName::Faco2024,
        &[
            |c: &mut ChordParameters| c.chords.n_ants = 0,
            |c| c.chords.reach = 17,
            |c| c.chords.growth_radii.clear(),
            |c| c.chords.growth_radii[0] = -0.1,
            |c| c.chords.safety = Safety::Footprint(FootprintSafety { margin_cells: 65.0 }),
            |c| c.chords.cost.epsilon = -1.0,
            |c| c.chords.evaporation = Evaporation::Constant(Constant { rho: 1.5 }),
            |c| c.chords.deposit.pheromone = 0.0,
            |c| c.chords.initial.factor = f64::INFINITY,
        ],
    );
}

#[test]
fn bad_parameters_of_populations_are_refused() {
    refused(
        PlannerName::ImprovedAstar,
        &[|c: &mut ImprovedAstarParameters| c.improved_astar.distance_weight = -0.1],
    );
    refused(
        PlannerName::Ga,
        &[
            |c: &mut EvolutionParameters| c.evolution.n_individuals = 1,
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
        ],
    );
}

#[test]
fn bad_parameters_of_hybrid_astar_are_refused() {
    refused(
        PlannerName::HybridAstar,
        &[
            |c: &mut HybridAstarParameters| c.hybrid_astar.weight = 0.9,
            |c| c.hybrid_astar.weight = f64::NAN,
            |c| c.hybrid_astar.max_iterations = 0,
            |c| c.hybrid_astar.angle_quantization_bins = 7,
            |c| c.hybrid_astar.step_radii = 0.0,
            |c| c.hybrid_astar.cost_share = 1.5,
            |c| c.hybrid_astar.change_penalty = -1.0,
            |c| c.cost.reverse_factor = 0.5,
        ],
    );
}

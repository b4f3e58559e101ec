//! The maps, and the improved colony less each of its parts beside those that it is compared with.

use crate::papers::experiment::{Ground, Variant};
use formicar::colony::evaporation::{Constant, Evaporation};
use formicar::colony::initial::{InitialPheromone, PheromoneUnit, Uniform};
use formicar::colony::transition::Transition;
use formicar::layers::UShapes;
use formicar::planner::{ColonyParameters, PlannerName};
use formicar::smoothing::{Corners, RedundantNodes};

/// The colony of the paper, and those of its Table 1.
pub(super) const IMPROVED: &str = "lei2020";
pub(super) const CONVENTIONAL: &str = "ant-system";
pub(super) const ELITE: &str = "elitist";
/// Variants that claims name.
pub(super) const OPEN: &str = "lei2020, U-shapes open";
pub(super) const UNIFORM: &str = "lei2020, uniform pheromone";
pub(super) const CONSTANT: &str = "lei2020, constant evaporation";
pub(super) const FREE_TURNS: &str = "lei2020, turns cost nothing";

/// A map with what the paper's Table 1 gives for one of the same size of its own: conventional,
/// elite, improved; lengths in cells, times in seconds.
pub(super) struct Map {
    pub(super) name: &'static str,
    pub(super) figure: &'static str,
    pub(super) lengths: [f64; 3],
    pub(super) times_s: [f64; 3],
}

pub(super) const MAPS: [Map; 3] = [
    map("lei-map1", "10", [78.2, 50.5, 37.9], [302.0, 269.0, 103.0]),
    map(
        "lei-map2",
        "12",
        [157.3, 87.4, 58.9],
        [2429.0, 1581.0, 964.0],
    ),
    map(
        "lei-map3",
        "13",
        [216.9, 133.7, 98.2],
        [2653.0, 1835.0, 1207.0],
    ),
];

const fn map(
    name: &'static str,
    figure: &'static str,
    lengths: [f64; 3],
    times_s: [f64; 3],
) -> Map {
    Map {
        name,
        figure,
        lengths,
        times_s,
    }
}

/// The three colonies of the paper's Table 1.
pub(super) const COLONIES: [&str; 3] = [CONVENTIONAL, ELITE, IMPROVED];

/// All variants, of the size that the paper uses on a map.
pub(super) fn variants(ground: &Ground) -> Vec<Variant> {
    let improved = |what: &str, change: fn(&mut ColonyParameters)| {
        Variant::changed(PlannerName::Lei2020, what, change)
    };
    let closed = |planner: PlannerName| {
        Variant::changed(planner, "U-shapes closed", |c: &mut ColonyParameters| {
            c.layers.u_shapes = UShapes::Close;
        })
    };
    let mut variants = vec![
        Variant::of(PlannerName::AntSystem),
        closed(PlannerName::AntSystem),
        Variant::of(PlannerName::Elitist),
        closed(PlannerName::Elitist),
        closed(PlannerName::MaxMin),
        Variant::of(PlannerName::Lei2020),
        improved("U-shapes open", |c| c.layers.u_shapes = UShapes::Keep),
        improved("uniform pheromone", |c| {
            c.colony.initial = InitialPheromone::Uniform(Uniform {
                tau: 1.0,
                unit: PheromoneUnit::Deposit,
            });
        }),
        improved("constant evaporation", |c| {
            c.colony.evaporation = Evaporation::Constant(Constant { rho: 0.5 });
        }),
        improved("one class of steps", |c| {
            c.colony.transition = Transition::Roulette;
        }),
        improved("turns cost nothing", |c| c.colony.cost.turn_weight = 0.0),
        improved("redundant nodes kept", |c| {
            c.smoothing.redundant_nodes = RedundantNodes::Collinear;
        }),
        improved("2-turning alone", |c| {
            c.smoothing.corners = Corners::TwoTurning;
        }),
        improved("evaporation stretched to N/20", |c| stretch(c, 20.0)),
        improved("stopped after 5 idle iterations", |c| {
            c.colony.stopping.stall_iterations = 5;
        }),
    ];
    if ground.map != "lei-map1" {
        for variant in &mut variants {
            let Some(parameters) = variant.config.colony_mut() else {
                continue;
            };
            // Sec. IV.B: the size for maps 2 and 3.
            parameters.colony.n_ants = 1000;
            parameters.colony.n_iterations = 200;
            if variant.name.contains("stretched") {
                stretch(parameters, 20.0);
            }
        }
    }
    variants
}

/// Stretches the evaporation so that a run is as long as `k_last` units of k.
fn stretch(config: &mut ColonyParameters, k_last: f64) {
    if let Evaporation::Poisson(poisson) = &mut config.colony.evaporation {
        poisson.stretch = f64::from(config.colony.n_iterations) / k_last;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variants_that_are_named_exist() {
        let variants = variants(&Ground::builtin("lei-map1").unwrap());
        for name in [
            IMPROVED,
            CONVENTIONAL,
            ELITE,
            OPEN,
            UNIFORM,
            CONSTANT,
            FREE_TURNS,
        ] {
            assert!(
                variants.iter().any(|variant| variant.name == name),
                "{name}"
            );
        }
    }
}

//! Portions of pheromone: what ants and remembered paths deposit.

use crate::colony::cost::CellCost;
use crate::colony::{generation, memory};

pub(super) type Generation = generation::Generation<CellCost>;
pub(super) type AntPath = generation::AntPath<CellCost>;
pub(super) type Memory = memory::Memory<CellCost>;

/// The steps of a path, and what is added to the pheromone along it.
pub(super) type Portion<'a> = (&'a [u8], f64);

/// Q / F from every ant that arrived, in the ants' order.
pub(super) fn all(generation: &Generation, q: f64) -> Vec<Portion<'_>> {
    let ants = generation.arrived();
    ants.map(|ant| from_ant(generation, ant, q)).collect()
}

/// Q / F from an ant.
pub(super) fn from_ant(generation: &Generation, ant: usize, q: f64) -> Portion<'_> {
    let cost = generation.cost(ant).cost;
    (generation.steps_of(ant), share_of(q, cost))
}

/// `n` Q / F along a path that is remembered.
pub(super) fn along(path: Option<&AntPath>, n_q: f64) -> Option<Portion<'_>> {
    path.map(|path| (&path.steps[..], share_of(n_q, path.cost.cost)))
}

/// Q / F; a path without steps costs as much as one of a single step.
fn share_of(q: f64, cost: f64) -> f64 {
    q / if cost > 0.0 { cost } else { 1.0 }
}

//! A genetic algorithm over via points: polylines that breed (the rivals GA and AGA of Li 2024).
//!
//! An individual is a polyline over cells: start, via points, goal. Its fitness is
//! [`SteeringCost`](crate::objective::SteeringCost) plus a penalty for its length inside blocked
//! cells. In each generation the elite stays, and tournaments choose the parents of the others,
//! which cross over at one point and mutate. `ga` begins at random, `aga` with a share of its
//! population around the shortest path over cells; all else is the same.

mod config;
mod engine;
mod fitness;
mod initial;
mod mutation;
mod obstruction;
mod problem;
mod reachable;
mod selection;

pub use config::{AstarSeeded, EvolutionConfig, InitialPopulation, Mutations};
pub use engine::{EvolutionRun, run};
pub use problem::EvolutionProblem;

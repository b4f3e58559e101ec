//! Ant colony optimization over cells: one engine with exchangeable rules in its slots.
//!
//! In each iteration the ants walk from start to goal on frozen pheromone, each by random numbers
//! of its own; then pheromone evaporates, ants deposit, and limits are applied. Methods differ by
//! the rules in these slots: [`corridor`], [`heuristic`], [`initial`], [`transition`],
//! [`dead_end`], [`evaporation`], [`deposit`], [`limits`]. A method is a [`ColonyConfig`], and
//! those of papers are in [`presets`].

mod adjacency;
mod ant;
mod cell_colony;
pub mod chord;
mod config;
pub mod corridor;
mod cost;
pub mod dead_end;
pub mod deposit;
mod directions;
pub mod drive;
mod engine;
mod error;
pub mod evaporation;
mod generation;
mod graph;
pub mod heuristic;
pub mod initial;
pub mod limits;
mod memory;
mod node;
pub mod presets;
mod problem;
mod run;
mod stopping;
mod trails;
pub mod transition;
mod visited;
mod worker_pool;

pub use adjacency::{Adjacency, PositionClass};
pub use cell_colony::run;
pub use config::{AdjacentGoal, ColonyConfig, TrailLayout};
pub use directions::Directions;
pub use error::RunError;
pub use problem::ColonyProblem;
pub use run::ColonyRun;
pub use stopping::Stopping;

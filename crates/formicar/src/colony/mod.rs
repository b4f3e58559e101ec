//! Ant colony optimization over cells: one engine, and rules that take turns in its slots.
//!
//! Each iteration the ants walk from start to goal on frozen pheromone, each by random numbers of
//! its own; then pheromone evaporates, ants deposit, limits are kept. What varies between methods
//! is a rule in a slot: [`corridor`], [`heuristic`], [`initial`], [`transition`],
//! [`dead_end`], [`evaporation`], [`deposit`], [`limits`]. A method is a [`ColonyConfig`], and those of papers
//! are in [`presets`].

mod adjacency;
mod ant;
pub mod chord;
mod config;
pub mod corridor;
mod crew;
pub mod dead_end;
pub mod deposit;
pub mod drive;
mod engine;
pub mod evaporation;
mod footmarks;
mod generation;
mod ground;
pub mod heuristic;
mod history;
pub mod initial;
pub mod limits;
mod node;
pub mod presets;
mod problem;
mod trails;
pub mod transition;

pub use adjacency::{Adjacency, PositionClass};
pub use config::{AdjacentGoal, ColonyConfig, ColonyError, Directions, Stopping, TrailLayout};
pub use engine::{RunError, run};
pub use history::{ColonyRun, History, Stop};
pub use problem::ColonyProblem;

//! What moves in the world: scripted bodies, walkers, carts.

mod crowd;
mod document;
mod walker;

pub use crowd::random_walkers;
pub(crate) use crowd::{Crowd, Surroundings};
pub use document::{AGENTS_SCHEMA, Agent, AgentBehavior, AgentsDocument};

//! What moves in the world: scripted bodies, walkers, carts.

mod crowd;
mod document;
mod surroundings;
mod walker;

pub(crate) use crowd::Crowd;
pub use crowd::random_walkers;
pub use document::{AGENTS_SCHEMA, Agent, AgentBehavior, AgentsDocument};
pub(crate) use surroundings::Surroundings;

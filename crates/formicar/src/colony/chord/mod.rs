//! Ants that step by chords, as a car would steer: the colony of Li et al. 2024.
//!
//! A step leads straight to a cell of the ring around an ant, so that directions lie a few degrees
//! apart, and the vehicle may or may not be able to steer a turn. The weight of a step depends on
//! the path so far: the corner before it, the straightness of the last steps, the steering limit of
//! the suspension, and the memory of a fractional derivative. The rules in the slots of a
//! [`ChordConfig`] are those of the paper; each can be switched off.

mod ant;
mod candidates;
mod colony;
mod config;
mod corner;
mod deposit;
mod distance;
mod graph;
mod limit;
mod numbered;
mod problem;
mod ring;
mod safety;
mod shared;
mod transition;

pub use colony::run_chords;
pub use config::ChordConfig;
pub use corner::{CornerRule, CornerTerm, StraightnessUse};
pub use deposit::{Depositor, SpreadDeposit};
pub use distance::{DistanceTerm, KnownLengths};
pub use limit::{DynamicLimit, SteeringLimit};
pub use problem::ChordProblem;
pub use safety::{FootprintSafety, Safety};
pub use transition::{ChordTransition, FractionalTransition};

//! Dead ends: cells from which no step is left.

mod retreat;

pub use retreat::Retreat;

use crate::parameters::rules;

rules! {
    /// The behavior of an ant at a dead end, where every neighbor is blocked or visited.
    #[derive(Default, Eq)]
    pub enum DeadEnd {
        /// It dies.
        #[default]
        Die,
        /// It steps back.
        Retreat(Retreat),
    }
}

impl DeadEnd {
    /// Steps back that an ant may take in all.
    pub(super) fn max_retreats(&self) -> u32 {
        match self {
            Self::Die => 0,
            Self::Retreat(rule) => rule.max_steps,
        }
    }
}

//! Errors of a search for parameters.

use crate::parameters::OutOfRange;
use thiserror::Error;

/// The reason why a search cannot begin or go on.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TuningError {
    /// A parameter of the search, or a bound of its space, outside its range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// Two dimensions of one name.
    #[error("two dimensions are named {name:?}; hint: each parameter once")]
    NamedTwice {
        /// The name.
        name: String,
    },
    /// Not one cost for each candidate.
    #[error("{n_costs} costs were given for {n_candidates} candidates; it must be one for each")]
    Costs {
        /// Candidates that were to be evaluated.
        n_candidates: usize,
        /// Costs that came back.
        n_costs: usize,
    },
    /// A state that no search can have come to.
    #[error("this is no state of a bee colony: {what}")]
    State {
        /// The part that does not fit.
        what: &'static str,
    },
}

//! An artificial bee colony that looks for good parameters.
//!
//! A [`ParameterSpace`] says what can be chosen, a [`BeeColony`] looks for the values of least cost
//! in it. What a cost is, is the caller's: a closure gets the candidates of a phase at once, may
//! evaluate them on as many threads or processes as it likes, and gives their costs in the same
//! order. The colony is deterministic, and its whole state can be written and read between two
//! cycles: a search that is taken up again goes on as if nothing had happened.
//!
//! ```
//! use formicar::numeric::Seed;
//! use formicar::tuning::{BeeColony, BeeColonyConfig, Dimension, Kind, ParameterSpace};
//!
//! let real = |name: &str| Dimension::new(name, Kind::Real { low: -5.0, high: 5.0 });
//! let space = ParameterSpace::new(vec![real("x"), real("y")])?;
//! let config = BeeColonyConfig { max_evaluations: 2000, ..BeeColonyConfig::default() };
//! let mut colony = BeeColony::new(space, config, Seed(1))?;
//! while !colony.is_done() {
//!     colony.cycle(&mut |all| all.iter().map(|v| v.iter().map(|x| x * x).sum()).collect())?;
//! }
//! assert!(colony.best().unwrap().cost < 1e-6);
//! # Ok::<(), formicar::tuning::TuningError>(())
//! ```

mod colony;
mod config;
mod error;
mod rule;
mod source;
mod space;

pub use colony::{BeeColony, CycleRecord};
pub use config::{BeeColonyConfig, BeeVariant};
pub use error::TuningError;
pub use rule::SearchRule;
pub use source::Source;
pub use space::{Dimension, Kind, ParameterSpace};

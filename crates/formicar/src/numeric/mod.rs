//! Random streams, integration, hashes, numbers in words: what everything else is made of.

mod fnv;
mod fractional;
mod gamma;
mod golden_section;
mod random;
mod rounding;
mod runge_kutta;
mod words;

pub use fnv::Fnv;
pub use fractional::{FractionalDerivative, FractionalStream, grunwald_letnikov_weights};
pub use gamma::ln_gamma;
pub use golden_section::golden_section;
pub use random::{RandomStream, Seed};
pub(crate) use rounding::integer_below;
pub use runge_kutta::rk4_step;
pub use words::counted;

//! Random streams and integration: the numbers that everything else is made of.

mod golden_section;
mod random;
mod runge_kutta;

pub use golden_section::golden_section;
pub use random::{RandomStream, Seed};
pub use runge_kutta::rk4_step;

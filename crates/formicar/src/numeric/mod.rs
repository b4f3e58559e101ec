//! Random streams and integration: the numbers that everything else is made of.

mod random;
mod runge_kutta;

pub use random::{RandomStream, Seed};
pub use runge_kutta::rk4_step;

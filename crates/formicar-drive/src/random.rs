//! Random numbers of a simulation, each at a place of its own.

use formicar::Seed;
use formicar::numeric::RandomStream;
use std::f64::consts::TAU;

/// What random numbers are drawn for.
#[derive(Clone, Copy)]
pub(crate) enum Draw {
    Pose = 1,
    Scan = 2,
    Walker = 3,
    Crowd = 4,
}

/// The stream of a purpose at a place.
pub(crate) fn stream(seed: Seed, draw: Draw, place: [u64; 2]) -> RandomStream {
    let [a, b] = place;
    seed.stream([(draw as u64) << 48 | a, b])
}

/// A standard normal variable (Box and Muller 1958).
pub(crate) fn normal(random: &mut RandomStream) -> f64 {
    let radius = (-2.0 * (1.0 - random.unit()).ln()).sqrt();
    radius * (TAU * random.unit()).cos()
}

//! Random numbers of a simulation, each at a place of its own.

use formicar::Seed;
use formicar::numeric::RandomStream;

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

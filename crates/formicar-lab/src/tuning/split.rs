//! The split into scenarios that are tuned on and scenarios that are held back.

use formicar::numeric::Seed;

/// Draws the scenarios of `n` that are held back: a share of them, in ascending order.
/// With two or more, at least one is held back and at least one is not.
pub fn split(n: usize, share: f64, seed: Seed) -> Vec<usize> {
    if n < 2 {
        return Vec::new();
    }
    let n_held = (share * n as f64).round() as usize;
    let mut order: Vec<usize> = (0..n).collect();
    // Fisher-Yates, from a stream that no bee has: the cycle would be the last of all.
    let mut random = seed.stream([u64::MAX, 0]);
    for i in (1..n).rev() {
        order.swap(i, random.below(i + 1));
    }
    order.truncate(n_held.clamp(1, n - 1));
    order.sort_unstable();
    order
}

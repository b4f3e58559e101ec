//! Counter-based random numbers: a draw is a hash of its place, so that threads cannot reorder it.

/// The one source of randomness of a run: same seed, same result.
///
/// ```
/// use formicar::Seed;
///
/// let draw = |place| Seed(7).stream(place).unit();
/// assert_eq!(draw([0, 1]), draw([0, 1]));
/// assert_ne!(draw([0, 1]), draw([0, 2]));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Seed(pub u64);

impl Seed {
    /// The stream of random numbers at a place, for instance `[iteration, ant]`.
    pub fn stream(self, place: [u64; 2]) -> RandomStream {
        let key = place
            .iter()
            .fold(mix(self.0), |key, &part| mix(key ^ mix(part)));
        RandomStream { key, draw: 0 }
    }
}

/// Draws number 0, 1, 2, ... at one place of a run.
#[derive(Clone, Debug)]
pub struct RandomStream {
    key: u64,
    draw: u64,
}

impl RandomStream {
    /// The next 64 random bits.
    pub fn next_u64(&mut self) -> u64 {
        self.draw += 1;
        mix(self.key.wrapping_add(self.draw.wrapping_mul(GOLDEN_GAMMA)))
    }

    /// Uniform in `[0, 1)`, with 53 random bits.
    pub fn unit(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    }

    /// Uniform in `[low, high)`.
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A standard normal variable (Box and Muller 1958).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.unit()).cos()
    }

    /// Uniform in `0..n`; 0 where `n` is 0. The bias is below `n / 2^64`.
    pub fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.next_u64()) * n as u128) >> 64) as usize
    }
}

/// The odd integer nearest to 2^64 / golden ratio: the increment of `SplitMix64`.
const GOLDEN_GAMMA: u64 = 0x9E37_79B9_7F4A_7C15;

/// The finalizer of `SplitMix64` (Steele, Lea & Flood 2014), a bijection with good avalanche.
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_give_independent_repeatable_streams() {
        let mut a = Seed(7).stream([1, 2]);
        let mut b = Seed(7).stream([2, 1]);
        let first = a.next_u64();
        assert_ne!(first, b.next_u64());
        assert_eq!(first, Seed(7).stream([1, 2]).next_u64());
    }

    #[test]
    fn unit_is_uniform() {
        let mut stream = Seed(1).stream([0, 0]);
        let mut bins = [0_u32; 10];
        for _ in 0..100_000 {
            bins[(stream.unit() * 10.0) as usize] += 1;
        }
        assert!(
            bins.iter().all(|&n| (9_500..10_500).contains(&n)),
            "{bins:?}"
        );
    }

    #[test]
    fn normal_variables_have_mean_0_and_variance_1() {
        let mut stream = Seed(3).stream([0, 0]);
        let values: Vec<f64> = (0..20_000).map(|_| stream.normal()).collect();
        let mean = |of: fn(f64) -> f64| values.iter().map(|&v| of(v)).sum::<f64>() / 20_000.0;
        assert!(mean(|v| v).abs() < 0.03, "{}", mean(|v| v));
        assert!((mean(|v| v * v) - 1.0).abs() < 0.05);
        assert!((mean(|v| v.powi(4)) - 3.0).abs() < 0.3);
    }

    #[test]
    fn below_reaches_every_value_and_no_other() {
        let mut stream = Seed(3).stream([0, 0]);
        let mut seen = [false; 7];
        for _ in 0..1_000 {
            seen[stream.below(7)] = true;
        }
        assert_eq!(seen, [true; 7]);
    }
}

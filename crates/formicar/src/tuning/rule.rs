//! The rules by which a bee draws a candidate beside a food source.

use super::source::Source;
use crate::numeric::RandomStream;

/// The rule for one coordinate j of a candidate, drawn at random; the others are those of the
/// source `x_i` that the bee is at. Sources k and r1, r2, r3 are drawn at random and differ from
/// each other and from i, phi is drawn from -1 to 1, y is the best place so far. A coordinate that
/// leaves its range is set to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SearchRule {
    /// `x_i + phi (x_i - x_k)` (Karaboga 2005, "An idea based on honey bee swarm for numerical
    /// optimization", TR06; Karaboga & Basturk 2007, J. Global Optimization 39, (2.2)).
    Neighbor,
    /// `x_i + phi (x_i - x_k) + psi (y - x_i)`, psi from 0 to 1.5 (Zhu & Kwong 2010, Applied
    /// Mathematics and Computation 217, "gbest-guided").
    GuidedByBest,
    /// `y + phi (x_r1 - x_r2)` (Gao & Liu 2012, Computers & Operations Research 39, "ABC/best/1").
    AroundBest,
    /// `x_r1 + phi (x_r2 - x_r3)` (Gao & Liu 2011, Information Processing Letters 111,
    /// "ABC/rand/1").
    AroundAny,
    /// `x_r1 + phi (x_r1 - x_r2)` (Gao, Liu & Huang 2013, IEEE Trans. Cybernetics 43, "CABC").
    BetweenAny,
}

/// C of Zhu & Kwong 2010: the most that psi can be.
const MOST_PULL: f64 = 1.5;

impl SearchRule {
    /// All rules; the basic one first.
    pub const ALL: [Self; 5] = [
        Self::Neighbor,
        Self::GuidedByBest,
        Self::AroundBest,
        Self::AroundAny,
        Self::BetweenAny,
    ];

    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Neighbor => "neighbor",
            Self::GuidedByBest => "guided-by-best",
            Self::AroundBest => "around-best",
            Self::AroundAny => "around-any",
            Self::BetweenAny => "between-any",
        }
    }

    /// A candidate beside source `i`; there are at least four sources.
    pub(super) fn candidate(
        self,
        sources: &[Source],
        i: usize,
        best: &[f64],
        random: &mut RandomStream,
    ) -> Vec<f64> {
        let mut candidate = sources[i].position.clone();
        let j = random.below(candidate.len());
        let [a, b, c] = others(i, sources.len(), random).map(|r| sources[r].position[j]);
        let phi = random.range(-1.0, 1.0);
        let (x, y) = (candidate[j], best[j]);
        let moved = match self {
            Self::Neighbor => x + phi * (x - a),
            Self::GuidedByBest => x + phi * (x - a) + random.range(0.0, MOST_PULL) * (y - x),
            Self::AroundBest => y + phi * (a - b),
            Self::AroundAny => a + phi * (b - c),
            Self::BetweenAny => a + phi * (a - b),
        };
        candidate[j] = moved.clamp(0.0, 1.0);
        candidate
    }
}

/// Three of `0..n` that differ from each other and from `i`.
fn others(i: usize, n: usize, random: &mut RandomStream) -> [usize; 3] {
    // Taken ones in ascending order: a draw skips those that are not above it.
    let mut taken = vec![i];
    [(); 3].map(|()| {
        let mut drawn = random.below(n - taken.len());
        for &place in &taken {
            drawn += usize::from(drawn >= place);
        }
        let at = taken.partition_point(|&place| place < drawn);
        taken.insert(at, drawn);
        drawn
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::Seed;

    #[test]
    fn others_differ_and_are_drawn_alike() {
        let mut counts = [0_u32; 5];
        for i in 0..6000 {
            let drawn = others(2, 5, &mut Seed(1).stream([i, 0]));
            let [a, b, c] = drawn;
            assert!(a != b && b != c && a != c, "{drawn:?}");
            for place in drawn {
                counts[place] += 1;
            }
        }
        assert_eq!(counts[2], 0);
        let alike = [0, 1, 3, 4].map(|place| (4300..4700).contains(&counts[place]));
        assert_eq!(alike, [true; 4], "{counts:?}");
    }

    #[test]
    fn rules_are_their_equations() {
        let at = |place: f64| Source {
            position: vec![place],
            cost: 0.0,
            n_trials: 0,
        };
        let sources = [0.4, 0.5, 0.44, 0.46].map(at);
        let best = [0.45];
        for rule in SearchRule::ALL {
            let mut random = Seed(5).stream([0, 0]);
            let mut same = random.clone();
            let candidate = rule.candidate(&sources, 0, &best, &mut random);
            same.below(1);
            let [a, b, c] = others(0, 4, &mut same).map(|r| sources[r].position[0]);
            let phi = same.range(-1.0, 1.0);
            let expected = match rule {
                SearchRule::Neighbor => 0.4 + phi * (0.4 - a),
                SearchRule::GuidedByBest => {
                    0.4 + phi * (0.4 - a) + 1.5 * same.unit() * (0.45 - 0.4)
                }
                SearchRule::AroundBest => 0.45 + phi * (a - b),
                SearchRule::AroundAny => a + phi * (b - c),
                SearchRule::BetweenAny => a + phi * (a - b),
            };
            assert!((candidate[0] - expected).abs() < 1e-15, "{rule:?}");
        }
    }
}

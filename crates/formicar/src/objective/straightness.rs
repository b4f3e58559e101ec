//! Straightness of the last steps of a path.

/// G of Li 2024 (19): the mean absolute turn of a path's last three corners, each weighted by the
/// two steps that it joins; 1 before there are four steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Straightness {
    /// Lengths of the last three steps, the latest last.
    lengths: [f64; 3],
    /// Absolute turns before the last two of them, radians.
    turns_rad: [f64; 2],
    n_steps: u32,
}

impl Straightness {
    /// G with a further step of a length, in any unit, after an absolute turn.
    #[inline]
    pub fn with(&self, turn_rad: f64, length: f64) -> f64 {
        if self.n_steps < 3 {
            return 1.0;
        }
        let [first, second, third] = self.lengths;
        let weighed = self.turns_rad[0] * (first + second)
            + self.turns_rad[1] * (second + third)
            + turn_rad * (third + length);
        weighed / (2.0 * (first + second + third + length))
    }

    /// Takes the step.
    pub fn push(&mut self, turn_rad: f64, length: f64) {
        self.lengths = [self.lengths[1], self.lengths[2], length];
        self.turns_rad = [self.turns_rad[1], turn_rad];
        self.n_steps = self.n_steps.saturating_add(1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_the_weighted_mean_turn_of_three_corners() {
        let mut straightness = Straightness::default();
        for (turn, length) in [(0.4, 1.0), (0.1, 2.0), (0.2, 3.0)] {
            assert_eq!(straightness.with(0.3, 4.0), 1.0);
            straightness.push(turn, length);
        }
        // Corners of 0.1 between 1 and 2, 0.2 between 2 and 3, 0.3 between 3 and 4.
        let expected = (0.1 * 3.0 + 0.2 * 5.0 + 0.3 * 7.0) / 20.0;
        assert!((straightness.with(0.3, 4.0) - expected).abs() < 1e-15);
        for _ in 0..3 {
            straightness.push(0.0, 1.0);
        }
        assert_eq!(straightness.with(0.0, 1.0), 0.0);
    }
}

//! Clothoids: curves whose curvature changes linearly along their length.
//!
//! From a pose with curvature k and rate c the heading after a signed length s is
//! `heading + k s + c s^2 / 2`; the position is the integral of its unit vector, which has no
//! closed form. It is cut into pieces that turn by at most [`MAX_PIECE_TURN_RAD`], and each is
//! integrated by Gauss-Legendre with eight nodes about its middle.
//!
//! *Error.* Over a piece of half length h, put t = h z with z in [-1, 1]. The integrand
//! `exp(i (a z + b z^2))` is entire; a half turn of at most 1/2 means |a| + 2 |b| <= 1/2, since that is
//! h times the largest curvature of the piece. On the Bernstein ellipse with semi-axes' sum 10, the
//! imaginary part of the phase stays below 1/2 * 10^2 / 8 = 6.25, so |exp| < 519. The error of n
//! nodes is below `64 / 15 * 519 * 10^(-2 n) / (1 - 10^-2)` (Trefethen, SIAM Review 50, 2008, Theorem
//! 4.5): 2.3e-13 times h for n = 8, below rounding of the sum.

use super::{Point2, Pose2};

/// A piece of the integration turns by at most so much, radians.
const MAX_PIECE_TURN_RAD: f64 = 1.0;

/// No more pieces than this, whatever is asked: the judge refuses such turns.
const MAX_PIECES: f64 = 2e4;

/// Positive nodes and weights of Gauss-Legendre with eight nodes on [-1, 1].
const NODES: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_47],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
];

impl Pose2 {
    /// The pose after driving a signed arc length at a curvature (positive left) that changes by
    /// `rate_per_m2` per meter of signed length; at rate 0 that is [`Pose2::advance`], bit for bit.
    ///
    /// The position is within 3e-13 of the driven length, the heading within rounding.
    ///
    /// ```
    /// use formicar::Pose2;
    ///
    /// // The curvature grows from 0 to 0.2 1/m over 4 m: the heading turns by half of 0.2 * 4.
    /// let end = Pose2::default().advance_clothoid(0.0, 0.05, 4.0);
    /// assert!((end.heading - 0.4).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn advance_clothoid(
        self,
        curvature_per_m: f64,
        rate_per_m2: f64,
        signed_length_m: f64,
    ) -> Self {
        if rate_per_m2 == 0.0 {
            return self.advance(curvature_per_m, signed_length_m);
        }
        let last = curvature_per_m + rate_per_m2 * signed_length_m;
        let steepest = curvature_per_m.abs().max(last.abs());
        let n_pieces = (steepest * signed_length_m.abs() / MAX_PIECE_TURN_RAD).ceil();
        let n_pieces = n_pieces.clamp(1.0, MAX_PIECES);
        let half = 0.5 * signed_length_m / n_pieces;
        let mut position = self.position();
        for i in 0..n_pieces as usize {
            let middle = (2.0 * i as f64 + 1.0) * half;
            let curvature = curvature_per_m + rate_per_m2 * middle;
            let heading = self.heading + turn(curvature_per_m, rate_per_m2, middle);
            position = position + chord(heading, [curvature, rate_per_m2], half);
        }
        let turned = turn(curvature_per_m, rate_per_m2, signed_length_m);
        Self::at(position, self.heading + turned)
    }
}

/// The change of the heading over a length.
fn turn(curvature: f64, rate: f64, length: f64) -> f64 {
    length * (curvature + 0.5 * rate * length)
}

/// From the first to the last point of a piece, by the heading and curvature in its middle.
fn chord(heading: f64, [curvature, rate]: [f64; 2], half: f64) -> Point2 {
    let sum = NODES
        .iter()
        .fold(Point2::default(), |sum, &[node, weight]| {
            let (ahead, back) = (node * half, -node * half);
            let both = Point2::unit(heading + turn(curvature, rate, ahead))
                + Point2::unit(heading + turn(curvature, rate, back));
            sum + both * weight
        });
    sum * half
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The composite midpoint rule, extrapolated: another method, with many steps.
    fn integrated(start: Pose2, [curvature, rate, length]: [f64; 3]) -> Point2 {
        let midpoint = |n: usize| {
            let step = length / n as f64;
            (0..n).fold(Point2::default(), |sum, i| {
                let s = (i as f64 + 0.5) * step;
                sum + Point2::unit(start.heading + turn(curvature, rate, s)) * step
            })
        };
        let (coarse, fine) = (midpoint(20_000), midpoint(40_000));
        start.position() + fine + (fine - coarse) * (1.0 / 3.0)
    }

    #[test]
    fn agrees_with_fine_integration() {
        let start = Pose2::new(3.0, -2.0, 0.7);
        for numbers in [
            [0.0, 0.3, 2.0],
            [0.4, -0.3, 3.0],
            [-1.2, 0.9, -4.0],
            [0.1, 5.0, 2.0],
            [0.0, 1e-9, 10.0],
        ] {
            let [curvature, rate, length] = numbers;
            let end = start.advance_clothoid(curvature, rate, length);
            let off = end.position().distance(integrated(start, numbers));
            assert!(off < 2e-12, "{numbers:?}: off by {off}");
        }
    }

    #[test]
    fn a_rate_of_zero_is_an_arc_bit_for_bit() {
        let start = Pose2::new(1.0, 2.0, 3.0);
        let (arc, clothoid) = (
            start.advance(0.4, -2.5),
            start.advance_clothoid(0.4, 0.0, -2.5),
        );
        assert_eq!(arc, clothoid);
        let nearly = start.advance_clothoid(0.4, 1e-13, -2.5);
        assert!(nearly.position().distance(arc.position()) < 1e-12);
    }

    #[test]
    fn driving_back_returns() {
        let start = Pose2::new(1.0, 2.0, 3.0);
        let end = start.advance_clothoid(-0.3, 0.25, 7.0);
        let back = end.advance_clothoid(-0.3 + 0.25 * 7.0, 0.25, -7.0);
        assert!(back.position().distance(start.position()) < 1e-12);
        assert!((back.heading - start.heading).abs() < 1e-12);
    }

    #[test]
    fn the_asymptote_is_that_of_fresnel() {
        // Both Fresnel integrals tend to 1/2, their distance from it falls as 1 / (pi x).
        let x = 40.0;
        let end = Pose2::default().advance_clothoid(0.0, std::f64::consts::PI, x);
        let off = end.position().distance(Point2::new(0.5, 0.5));
        assert!(
            (off - 1.0 / (std::f64::consts::PI * x)).abs() < 1e-6,
            "{off}"
        );
    }
}

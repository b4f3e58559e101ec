//! The exact side of a line on which a point lies.

use crate::geometry::Point2;
use std::cmp::Ordering;

/// The sign of `(b - a) x (v - a)`: greater where `v` lies left of the line from `a` to `b`.
///
/// Exact for finite coordinates whose products neither overflow nor underflow: decided in plain
/// arithmetic where its error bound allows (Shewchuk 1997), else by an exact sum.
pub(super) fn side_of_line(a: Point2, b: Point2, v: Point2) -> Ordering {
    /// A little above Shewchuk's (3 + 16 eps) eps, eps = 2^-53.
    const ERROR_BOUND: f64 = 4e-16;
    let left = (b.x - a.x) * (v.y - a.y);
    let right = (b.y - a.y) * (v.x - a.x);
    let det = left - right;
    if det.abs() > ERROR_BOUND * (left.abs() + right.abs()) {
        return det.total_cmp(&0.0);
    }
    exact_side(a, b, v)
}

/// The same sign from the expanded determinant, summed without rounding.
fn exact_side(a: Point2, b: Point2, v: Point2) -> Ordering {
    let mut sum = Expansion::default();
    sum.add_product(b.x, v.y);
    sum.add_product(-b.x, a.y);
    sum.add_product(-a.x, v.y);
    sum.add_product(-b.y, v.x);
    sum.add_product(b.y, a.x);
    sum.add_product(a.y, v.x);
    sum.sign()
}

/// An exact sum of twelve floats as parts that do not overlap, smallest first (Shewchuk 1997).
#[derive(Default)]
struct Expansion {
    parts: [f64; 12],
    n_parts: usize,
}

impl Expansion {
    /// Adds `a * b` without rounding.
    fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        self.add(a.mul_add(b, -product));
        self.add(product);
    }

    /// Grow-Expansion.
    fn add(&mut self, term: f64) {
        let mut carry = term;
        for part in &mut self.parts[..self.n_parts] {
            (carry, *part) = two_sum(carry, *part);
        }
        self.parts[self.n_parts] = carry;
        self.n_parts += 1;
    }

    fn sign(&self) -> Ordering {
        let leading = self.parts.iter().rev().find(|&&part| part != 0.0);
        leading.map_or(Ordering::Equal, |part| part.total_cmp(&0.0))
    }
}

/// The rounded sum and its error (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn agrees_with_integers_next_to_the_line(
            a in (0_i64..1 << 40, 0_i64..1 << 40),
            b in (0_i64..1 << 40, 0_i64..1 << 40),
            t in 0_i64..1000,
            nudge in (-1_i64..=1, -1_i64..=1),
        ) {
            let between = |a: i64, b: i64| (i128::from(a) + i128::from(b - a) * i128::from(t) / 1000) as i64;
            let v = (between(a.0, b.0) + nudge.0, between(a.1, b.1) + nudge.1);
            let cross = |o: (i64, i64), p: (i64, i64), q: (i64, i64)| {
                i128::from(p.0 - o.0) * i128::from(q.1 - o.1) - i128::from(p.1 - o.1) * i128::from(q.0 - o.0)
            };
            let scale = 1.0 / (1_i64 << 27) as f64;
            let point = |p: (i64, i64)| Point2::new(p.0 as f64 * scale, p.1 as f64 * scale);
            let expected = cross(a, b, v).cmp(&0);
            prop_assert_eq!(side_of_line(point(a), point(b), point(v)), expected);
            prop_assert_eq!(exact_side(point(a), point(b), point(v)), expected);
        }
    }
}

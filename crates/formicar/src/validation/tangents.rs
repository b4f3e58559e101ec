//! Directions of motion at points without headings.

use crate::geometry::{Point2, wrap_angle};
use crate::numeric::golden_section;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// The index of the last point of the run without cusps that begins at `first`.
pub(super) fn run_end(points: &[Point2], first: usize) -> usize {
    let is_cusp = |i: usize| {
        let (before, after) = (points[i] - points[i - 1], points[i + 1] - points[i]);
        before.cross(after).atan2(before.dot(after)).abs() > FRAC_PI_2
    };
    (first + 1..points.len() - 1)
        .find(|&i| is_cusp(i))
        .unwrap_or(points.len() - 1)
}

/// The direction of motion at each point of a run without cusps.
pub(super) fn tangents(run: &[Point2]) -> Vec<f64> {
    let chords: Vec<Point2> = run.windows(2).map(|w| w[1] - w[0]).collect();
    if let [only] = chords[..] {
        return vec![only.angle(); 2];
    }
    let circles = Circles::new(&chords);
    let best: Vec<usize> = (0..run.len()).map(|i| circles.best_at(i)).collect();
    let mut angles: Vec<f64> = best
        .iter()
        .enumerate()
        .map(|(i, &j)| tangent_on_circle(&run[j..j + 3], i - j))
        .collect();
    let unsettled: Vec<usize> = (0..run.len())
        .filter(|&i| !circles.is_settled(best[i]))
        .collect();
    flatten(&mut angles, &chords, &unsettled);
    angles
}

/// The circles through three consecutive points, by their curvature.
struct Circles {
    bends: Vec<f64>,
    largest: f64,
}

impl Circles {
    fn new(chords: &[Point2]) -> Self {
        let bend = |w: &[Point2]| {
            let (a, b) = (w[0], w[1]);
            2.0 * a.cross(b) / (a.norm() * b.norm() * (a + b).norm())
        };
        let bends: Vec<f64> = chords.windows(2).map(bend).collect();
        let largest = bends.iter().fold(0.0, |m: f64, b| m.max(b.abs()));
        Self { bends, largest }
    }

    /// The difference between a circle and the more similar of its neighbors.
    fn roughness(&self, j: usize) -> f64 {
        let to = |other: Option<usize>| {
            let other = other.and_then(|i| self.bends.get(i));
            other.map_or(f64::INFINITY, |other| (other - self.bends[j]).abs())
        };
        to(j.checked_sub(1)).min(to(Some(j + 1)))
    }

    /// The circle with point `i` on it that agrees best; the one around it wins ties.
    fn best_at(&self, i: usize) -> usize {
        let last = self.bends.len() - 1;
        let middle = i.saturating_sub(1).min(last);
        std::iter::once(middle)
            .chain(i.saturating_sub(2)..=i.min(last))
            .min_by(|&a, &b| self.roughness(a).total_cmp(&self.roughness(b)))
            .unwrap_or(middle)
    }

    /// True if a circle and its neighbor are on one arc, as far as numbers tell.
    fn is_settled(&self, j: usize) -> bool {
        self.bends.len() == 1 || self.roughness(j) <= 1e-4 * self.largest
    }
}

/// A chord by direction and length.
#[derive(Clone, Copy)]
struct Polar {
    angle: f64,
    length: f64,
}

/// Rounds over all unsettled points; each is cheap, and most gain comes from the first few.
const N_ROUNDS: u32 = 12;

/// Turns the directions at the unsettled points so that the biarcs around them become flat: the
/// sum of their curvatures' eighth powers, which is convex and close to the largest, falls.
fn flatten(angles: &mut [f64], chords: &[Point2], unsettled: &[usize]) {
    let polar = |chord: &Point2| Polar {
        angle: chord.angle(),
        length: chord.norm(),
    };
    let chords: Vec<Polar> = chords.iter().map(polar).collect();
    for _ in 0..N_ROUNDS {
        for &i in unsettled {
            let bend = |angle: f64| {
                let before = i
                    .checked_sub(1)
                    .map_or(0.0, |h| biarc_bend(chords[h], angles[h], angle));
                let after = chords
                    .get(i)
                    .map_or(0.0, |&chord| biarc_bend(chord, angle, angles[i + 1]));
                before.powi(8) + after.powi(8)
            };
            let around = [angles[i] - FRAC_PI_4, angles[i] + FRAC_PI_4];
            angles[i] = golden_section(bend, around, 24);
        }
    }
}

/// Largest curvature of the flattest biarc over a chord, for small angles.
///
/// With end directions a and b against the chord, sigma = (a + b) / 2 and gamma = b - a, the
/// curve that turns by +k, then by -k, meets both ends where k^2 - 4 |sigma| k - gamma^2 = 0
/// (in units of the chord), and no curve with a smaller largest curvature does.
fn biarc_bend(chord: Polar, from: f64, to: f64) -> f64 {
    let (a, b) = (wrap_angle(from - chord.angle), wrap_angle(to - chord.angle));
    let (sigma, gamma) = (0.5 * (a + b), b - a);
    (2.0 * sigma.abs() + (4.0 * sigma * sigma + gamma * gamma).sqrt()) / chord.length
}

/// The direction of motion at one of three points of a circle.
fn tangent_on_circle(three: &[Point2], i: usize) -> f64 {
    let (a, b) = (three[1] - three[0], three[2] - three[1]);
    let turn = a.cross(b).atan2(a.dot(b));
    // A chord and the tangent at its end enclose half the arc's turn. Both halves add up to the
    // turn from chord to chord, and sin(half a) / |a| = sin(half b) / |b| on one circle.
    let half_a = turn.sin().atan2(b.norm() / a.norm() + turn.cos());
    match i {
        0 => a.angle() - half_a,
        1 => a.angle() + half_a,
        _ => b.angle() + (turn - half_a),
    }
}

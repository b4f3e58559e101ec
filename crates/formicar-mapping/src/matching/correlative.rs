//! Correlative search: the best pose in a window around a prediction, before the alignment.

use crate::matrix::{Sym3, difference};
use crate::sdf::SignedDistances;
use formicar::{Point2, Pose2};
use serde::{Deserialize, Serialize};

/// The window and steps of the search.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Window {
    /// Half the width of the window, meters.
    pub reach_m: f64,
    /// Half the range of headings, radians.
    pub turn_rad: f64,
    /// Step between headings, radians.
    pub turn_step_rad: f64,
}

impl Default for Window {
    fn default() -> Self {
        Self {
            reach_m: 0.3,
            turn_rad: 14_f64.to_radians(),
            turn_step_rad: 1.4_f64.to_radians(),
        }
    }
}

/// A candidate pose and its score.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The pose in the frame of the map.
    pub pose: Pose2,
    /// Mean over the hits of 1 at a surface to 0 at the truncation, less the penalty.
    pub score: f64,
}

/// Most hits that take part.
const MAX_HITS: usize = 90;
/// Hits that look at the whole window first.
const FEW_HITS: usize = 36;
/// Headings that all hits look at then.
const N_HEADINGS: usize = 6;
/// Penalty for a deviation of one standard deviation from the prediction.
const PENALTY: f64 = 0.01;
/// Translations are tried in steps of this many cells, then one by one around the best.
const COARSE_CELLS: i32 = 2;

/// The best poses of a window, best first: at most `n_best`, at least a coarse step or heading
/// apart.
///
/// Every hit counts, also one on ground that was never seen; pass hits whose surroundings are seen
/// ([`supported`]) where the map ends in the middle of the scan.
pub fn search(
    field: &impl SignedDistances,
    hits: &[Point2],
    prediction: Pose2,
    information: &Sym3,
    (window, n_best): (&Window, usize),
) -> Vec<Candidate> {
    let few = every(hits, FEW_HITS);
    let hits = every(hits, MAX_HITS);
    let search = |hits| Search {
        field,
        hits,
        prediction,
        information,
    };
    let cells = (window.reach_m / field.resolution_m()).round() as i32;
    let n_turns = (window.turn_rad / window.turn_step_rad).round() as i32;
    let coarse = search(&few);
    let mut first: Vec<Candidate> = (-n_turns..=n_turns)
        .map(|turn| {
            let heading = prediction.heading + f64::from(turn) * window.turn_step_rad;
            coarse.best_at(heading, (0, 0), cells, COARSE_CELLS)
        })
        .collect();
    first.sort_by(|a, b| b.score.total_cmp(&a.score));
    first.truncate(N_HEADINGS.max(2 * n_best));
    let search = search(&hits);
    let mut found: Vec<Candidate> = first
        .iter()
        .map(|c| {
            search.best_at(
                c.pose.heading,
                search.cells_to(c.pose),
                COARSE_CELLS,
                COARSE_CELLS,
            )
        })
        .collect();
    // The sort is stable: the first of equal scores stays first.
    found.sort_by(|a, b| b.score.total_cmp(&a.score));
    let mut kept: Vec<Candidate> = Vec::new();
    for candidate in found {
        let is_near = |other: &Candidate| {
            let turn = (candidate.pose.heading - other.pose.heading).abs();
            let apart_m = candidate.pose.position().distance(other.pose.position());
            turn < 1.5 * window.turn_step_rad && apart_m < 0.2
        };
        if kept.len() < n_best && !kept.iter().any(is_near) {
            kept.push(candidate);
        }
    }
    for candidate in &mut kept {
        *candidate = search.refined(*candidate, window);
    }
    kept.sort_by(|a, b| b.score.total_cmp(&a.score));
    kept
}

/// At most so many of the hits, evenly spread.
fn every(hits: &[Point2], n: usize) -> Vec<Point2> {
    let stride = hits.len().div_ceil(n).max(1);
    hits.iter().copied().step_by(stride).collect()
}

struct Search<'a, F> {
    field: &'a F,
    hits: &'a [Point2],
    prediction: Pose2,
    information: &'a Sym3,
}

impl<F: SignedDistances> Search<'_, F> {
    /// The best translation at a heading, in steps around a center, in cells.
    fn best_at(&self, heading: f64, center: (i32, i32), reach: i32, step: i32) -> Candidate {
        let resolution = self.field.resolution_m();
        let scale = 1.0 / resolution;
        let pose = Pose2::at(self.prediction.position(), heading);
        let (sin, cos) = heading.sin_cos();
        let places: Vec<(i32, i32)> = self
            .hits
            .iter()
            .map(|hit| {
                let x = pose.x + cos * hit.x - sin * hit.y;
                let y = pose.y + sin * hit.x + cos * hit.y;
                ((x * scale).round() as i32, (y * scale).round() as i32)
            })
            .collect();
        let fade = (1.0 / self.field.truncation_m()) as f32;
        let n = self.hits.len().max(1) as f64;
        let mut best = Candidate {
            pose,
            score: f64::NEG_INFINITY,
        };
        let reach = reach / step * step;
        for dy in (center.1 - reach..=center.1 + reach).step_by(step as usize) {
            for dx in (center.0 - reach..=center.0 + reach).step_by(step as usize) {
                let mut sum = 0.0_f32;
                for &(x, y) in &places {
                    let distance = self.field.distance((x + dx, y + dy));
                    // Unseen ground is NaN, which `max` turns into 0.
                    sum += (1.0 - distance.abs() * fade).max(0.0);
                }
                let shift = Point2::new(f64::from(dx), f64::from(dy)) * resolution;
                let there = Pose2::at(pose.position() + shift, heading);
                let deviation = self.information.form(difference(there, self.prediction));
                let score = f64::from(sum) / n - PENALTY * deviation.min(25.0);
                if score > best.score {
                    best = Candidate { pose: there, score };
                }
            }
        }
        best
    }

    /// The shift from the prediction to a pose, in cells.
    fn cells_to(&self, pose: Pose2) -> (i32, i32) {
        let scale = 1.0 / self.field.resolution_m();
        let shift = (pose.position() - self.prediction.position()) * scale;
        (shift.x.round() as i32, shift.y.round() as i32)
    }

    /// The best pose around a coarse one: half the step of headings, single cells.
    fn refined(&self, coarse: Candidate, window: &Window) -> Candidate {
        let center = self.cells_to(coarse.pose);
        let mut best = coarse;
        for half_turn in -1..=1 {
            let heading = coarse.pose.heading + 0.5 * f64::from(half_turn) * window.turn_step_rad;
            let found = self.best_at(heading, center, COARSE_CELLS - 1, 1);
            if found.score > best.score {
                best = found;
            }
        }
        best
    }
}

/// The hits on ground that is seen at the prediction and `reach_m` to both sides along the surface.
///
/// Where the map ends, as ahead of a robot in a corridor, a score over all hits is best where most
/// of them lie on known walls: a step too short. These hits stay on known ground for every
/// candidate, so that they do not care. With fewer than a third of the hits left, all are taken.
pub fn supported(
    field: &impl SignedDistances,
    hits: &[Point2],
    prediction: Pose2,
    reach_m: f64,
) -> Vec<Point2> {
    let scale = 1.0 / field.resolution_m();
    let is_seen = |point: Point2| {
        let place = (
            (point.x * scale).round() as i32,
            (point.y * scale).round() as i32,
        );
        !field.distance(place).is_nan()
    };
    let along = |i: usize| {
        let (a, b) = (hits[i.saturating_sub(1)], hits[(i + 1).min(hits.len() - 1)]);
        let d = b - a;
        let length = d.norm();
        // Neighbors far apart belong to different surfaces.
        (length > 1e-6 && length < 1.5).then(|| d * (reach_m / length))
    };
    let is_supported = |i: usize| {
        let Some(step) = along(i) else {
            return is_seen(prediction.transform(hits[i]));
        };
        let probes = [hits[i], hits[i] + step, hits[i] - step];
        probes
            .iter()
            .all(|&probe| is_seen(prediction.transform(probe)))
    };
    let kept: Vec<Point2> = (0..hits.len())
        .filter(|&i| is_supported(i))
        .map(|i| hits[i])
        .collect();
    if 3 * kept.len() >= hits.len() {
        kept
    } else {
        hits.to_vec()
    }
}

//! Levenberg-Marquardt: the pose at which the hits of a scan lie on the surfaces of a map.

use super::robust::Robust;
use crate::matrix::{Sym3, difference};
use crate::sdf::SignedDistances;
use formicar::{Point2, Pose2};
use serde::{Deserialize, Serialize};

/// Parameters of the alignment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct AlignRule {
    /// The loss of a hit's distance to the nearest surface.
    pub robust: Robust,
    /// Most steps.
    pub max_iterations: usize,
    /// The search ends when a step is shorter than this, meters and radians.
    pub tolerance: f64,
    /// Variance that the residual of one hit stands for, square meters. Neighboring hits err
    /// together, so that it is larger than the sensor's own.
    pub hit_variance_m2: f64,
    /// Deviations from the predicted motion beyond this many standard deviations lose weight.
    pub prior_scale: f64,
}

impl Default for AlignRule {
    fn default() -> Self {
        Self {
            robust: Robust::Cauchy { scale_m: 0.1 },
            max_iterations: 25,
            tolerance: 1e-5,
            hit_variance_m2: 0.0045,
            prior_scale: 3.0,
        }
    }
}

/// An expected pose and its information (inverse covariance), both in the frame of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// The expected pose.
    pub pose: Pose2,
    /// Its information: 1/m2, 1/(m rad), 1/rad2.
    pub information: Sym3,
}

/// A pose at which a scan fits, and how well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alignment {
    /// The pose in the frame of the map.
    pub pose: Pose2,
    /// The cost: loss of the hits over their variance, and that of the prior.
    pub cost: f64,
    /// Mean over the hits on seen ground of 1 at a surface to 0 at the truncation.
    pub score: f64,
    /// Share of hits on seen ground.
    pub seen_share: f64,
    /// Information of the hits alone about the pose.
    pub information: Sym3,
    /// Least over greatest information on the translation: near 0 in a corridor.
    pub eigen_ratio: f64,
    /// Steps taken.
    pub n_iterations: usize,
}

/// Aligns hits, given in the frame of the sensor, with a map, from a start pose.
///
/// Minimizes `sum rho(D(T p_i)) / v + prior` with D the bilinear distance. A hit on ground that was
/// never seen costs as much as one at the truncation, wherever it is: without that cost, poses that
/// push hits into the unknown would look best.
pub fn align(
    field: &impl SignedDistances,
    hits: &[Point2],
    start: Pose2,
    prior: Option<&Prior>,
    rule: &AlignRule,
) -> Alignment {
    let problem = Problem {
        field,
        hits,
        prior,
        rule,
    };
    let mut pose = start;
    let mut normal = problem.normal(pose);
    let mut damping = 1e-4;
    let mut n_iterations = 0;
    while n_iterations < rule.max_iterations {
        n_iterations += 1;
        let Some(step) = normal.step(damping) else {
            break;
        };
        let moved = moved(pose, step);
        let next = problem.normal(moved);
        let length = step.iter().map(|s| s * s).sum::<f64>().sqrt();
        if next.cost < normal.cost {
            let gain = normal.cost - next.cost;
            pose = moved;
            normal = next;
            damping = (damping * 0.3_f64).max(1e-9);
            if length < rule.tolerance || gain < 1e-6 * normal.cost {
                break;
            }
        } else {
            damping *= 8.0;
            if length < rule.tolerance || damping > 1e6 {
                break;
            }
        }
    }
    let (least, greatest, _) = normal.hits.translation();
    Alignment {
        pose: pose.wrapped(),
        cost: normal.cost,
        score: normal.score,
        seen_share: normal.seen_share,
        information: normal.hits,
        eigen_ratio: if greatest > 0.0 {
            least / greatest
        } else {
            0.0
        },
        n_iterations,
    }
}

fn moved(pose: Pose2, step: [f64; 3]) -> Pose2 {
    // A step beyond the reach of the distances means nothing.
    let clamp = |s: f64| s.clamp(-0.3, 0.3);
    Pose2::new(
        pose.x + clamp(step[0]),
        pose.y + clamp(step[1]),
        pose.heading + clamp(step[2]),
    )
}

struct Problem<'a, F> {
    field: &'a F,
    hits: &'a [Point2],
    prior: Option<&'a Prior>,
    rule: &'a AlignRule,
}

/// The normal equations at a pose.
struct Normal {
    cost: f64,
    score: f64,
    seen_share: f64,
    /// Of the hits alone.
    hits: Sym3,
    all: Sym3,
    slope: [f64; 3],
}

impl Normal {
    fn step(&self, damping: f64) -> Option<[f64; 3]> {
        let mut damped = self.all;
        damped.xx += damping * self.all.xx + 1e-9;
        damped.yy += damping * self.all.yy + 1e-9;
        damped.hh += damping * self.all.hh + 1e-9;
        let step = damped.inverse()?.product(self.slope).map(|s| -s);
        step.iter().all(|s| s.is_finite()).then_some(step)
    }
}

impl<F: SignedDistances> Problem<'_, F> {
    fn normal(&self, pose: Pose2) -> Normal {
        let (sin, cos) = pose.heading.sin_cos();
        let truncation = self.field.truncation_m();
        let scale = 1.0 / self.rule.hit_variance_m2;
        let unseen = self.rule.robust.loss(truncation);
        let (mut loss, mut score, mut n_seen) = (0.0, 0.0, 0_u32);
        let mut h = Sym3::default();
        let mut slope = [0.0; 3];
        for hit in self.hits {
            let arm = Point2::new(cos * hit.x - sin * hit.y, sin * hit.x + cos * hit.y);
            let Some(sample) = self.field.sample(pose.position() + arm) else {
                loss += unseen;
                continue;
            };
            let residual = sample.distance_m;
            n_seen += 1;
            loss += self.rule.robust.loss(residual);
            score += (1.0 - residual.abs() / truncation).max(0.0);
            let weight = self.rule.robust.weight(residual) * scale;
            let (x, y) = (sample.gradient.x, sample.gradient.y);
            let turn = arm.cross(sample.gradient);
            h.xx += weight * x * x;
            h.xy += weight * x * y;
            h.xh += weight * x * turn;
            h.yy += weight * y * y;
            h.yh += weight * y * turn;
            h.hh += weight * turn * turn;
            for (s, j) in slope.iter_mut().zip([x, y, turn]) {
                *s += weight * residual * j;
            }
        }
        let mut all = h;
        let mut cost = loss * scale;
        if let Some(prior) = self.prior {
            let (weight, prior_cost, error) = self.prior_at(prior, pose);
            cost += prior_cost;
            all = all.plus(prior.information, weight);
            for (s, p) in slope.iter_mut().zip(prior.information.product(error)) {
                *s += weight * p;
            }
        }
        Normal {
            cost,
            score: score / f64::from(n_seen.max(1)),
            seen_share: f64::from(n_seen) / self.hits.len().max(1) as f64,
            hits: h,
            all,
            slope,
        }
    }

    /// Weight, cost and deviation of the prior: a Cauchy loss of the deviation.
    fn prior_at(&self, prior: &Prior, pose: Pose2) -> (f64, f64, [f64; 3]) {
        let error = difference(pose, prior.pose);
        let square = prior.information.form(error);
        let scale = self.rule.prior_scale.powi(2);
        let cost = 0.5 * scale * (square / scale).ln_1p();
        (1.0 / (1.0 + square / scale), cost, error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sdf::{SdfMap, Sweep, WedgeRule};
    use std::f64::consts::PI;

    /// A scan inside a room of 6 m x 4 m, from its center.
    fn room() -> Sweep {
        let step = PI / 180.0;
        let range = |beam: usize| {
            let d = Point2::unit(-PI + step * beam as f64);
            (3.0 / d.x.abs()).min(2.0 / d.y.abs()) as f32
        };
        Sweep {
            time_s: 0.0,
            first_angle_rad: -PI,
            angle_step_rad: step,
            ranges_m: (0..360).map(range).collect(),
        }
    }

    fn map() -> SdfMap {
        let mut map = SdfMap::new(0.05, 0.15);
        let rule = WedgeRule::default();
        let sweep = room();
        map.insert(&sweep, &sweep.lines(0.15), Pose2::new(1.0, 2.0, 0.3), &rule);
        map
    }

    #[test]
    fn a_scan_finds_back_to_its_pose() {
        let (map, hits) = (map(), room().points());
        let start = Pose2::new(1.06, 1.95, 0.33);
        let found = align(&map, &hits, start, None, &AlignRule::default());
        let error = difference(found.pose, Pose2::new(1.0, 2.0, 0.3));
        assert!(error.iter().all(|e| e.abs() < 2e-3), "{found:?}");
        assert!(found.score > 0.95 && found.seen_share > 0.9 && found.eigen_ratio > 0.3);
    }

    #[test]
    fn a_strong_prior_holds_and_a_contradicted_one_lets_go() {
        let (map, hits) = (map(), room().points());
        let truth = Pose2::new(1.0, 2.0, 0.3);
        let prior = |x: f64, weight: f64| Prior {
            pose: Pose2::new(x, 2.0, 0.3),
            information: Sym3::diagonal(weight, weight, weight),
        };
        let rule = AlignRule::default();
        let held = align(&map, &hits, truth, Some(&prior(1.03, 1e8)), &rule);
        assert!((held.pose.x - 1.03).abs() < 1e-3, "{held:?}");
        let free = align(&map, &hits, truth, Some(&prior(1.5, 1e4)), &rule);
        assert!((free.pose.x - 1.0).abs() < 0.01, "{free:?}");
    }

    #[test]
    fn hits_on_unseen_ground_change_nothing() {
        let map = SdfMap::new(0.05, 0.15);
        let start = Pose2::new(1.0, 2.0, 0.3);
        let found = align(&map, &room().points(), start, None, &AlignRule::default());
        assert_eq!((found.pose, found.seen_share), (start, 0.0));
        let none = align(&map, &[], start, None, &AlignRule::default());
        assert_eq!(none.pose, start);
    }
}

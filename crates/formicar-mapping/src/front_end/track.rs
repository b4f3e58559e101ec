//! Matching one scan: from the odometry's window to wider ones, until it fits or is lost.

use super::quality::{Quality, ScanMatch};
use crate::config::MappingConfig;
use crate::matching::{
    Alignment, BoundSearch, Prior, ScoreGrids, Window, align, search, supported,
};
use crate::matrix::{Sym3, difference};
use crate::motion::NoiseScale;
use crate::sdf::{SdfMap, SignedDistances, Sweep};
use formicar::{Point2, Pose2};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// The origin of a prediction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Hypothesis {
    /// The odometry.
    Odometry,
    /// The odometry with the other sign ahead: some report driving in reverse as driving forward.
    Reversed,
    /// The motion before goes on.
    ConstantVelocity,
}

/// Where a robot is, how it moves, and how well its odometry does.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Track {
    /// The pose of the last scan.
    pub pose: Pose2,
    /// The motion between the last two scans, for constant velocity.
    velocity: Pose2,
    /// Covariance of the pose in the map: it grows along a corridor, where odometry alone tells, and
    /// shrinks at its end.
    covariance: Sym3,
    /// Mean of the recent scores; 0 before the first.
    typical_score: f64,
    /// The noise of the odometry, as learned.
    pub noise: NoiseScale,
    /// Times that the odometry was contradicted by the scans.
    pub n_contradicted: usize,
}

/// A map to track in, and its grids for searches far and wide.
pub(crate) trait TrackMap: SignedDistances {
    /// Scores for branch and bound.
    fn score_grids(&self) -> Option<Cow<'_, ScoreGrids>>;
}

impl TrackMap for SdfMap {
    fn score_grids(&self) -> Option<Cow<'_, ScoreGrids>> {
        ScoreGrids::new(&self.packed(), self.resolution_m(), FAR_LEVELS).map(Cow::Owned)
    }
}

/// Levels of the search by branch and bound.
const FAR_LEVELS: usize = 5;

/// A match is not doubted where its score is at most this much below those before, and at least
/// `LEAST_GOOD`.
const BELOW_TYPICAL: f64 = 0.1;
const LEAST_GOOD: f64 = 0.6;
/// The score expected of the first matches, and the share of a new one in the mean.
const FIRST_TYPICAL: f64 = 0.8;
const NEW_SHARE: f64 = 0.05;
/// Another hypothesis must be this much better.
const CLEARLY: f64 = 0.06;
/// Share of a scan's information that the pose's covariance believes: hits err together.
const BELIEVED: f64 = 0.3;
/// A pose is never surer than this, square meters and square radians.
const SUREST: Sym3 = Sym3::diagonal(1e-5, 1e-5, 1e-6);
/// A lost scan may be anywhere within this, square meters and square radians.
const LOST: Sym3 = Sym3::diagonal(0.09, 0.09, 0.03);
/// Standard deviations expected of constant velocity, meters and radians.
const VELOCITY_SIGMAS: (f64, f64) = (0.3, 0.25);
/// Weights on the score within which the start that is nearer to the prediction wins.
const NEAR_BEST: f64 = 0.9;

/// True where a scan cannot be matched: too few hits, or all at one range, as of a covered sensor.
pub(crate) fn is_degenerate(sweep: &Sweep, config: &MappingConfig) -> bool {
    let hits = sweep.ranges_m.iter().filter(|range| **range > 0.0);
    let (mut n, mut low, mut high) = (0, f32::INFINITY, 0.0_f32);
    for &range in hits {
        n += 1;
        low = low.min(range);
        high = high.max(range);
    }
    n < config.front_end.min_hits || high - low < 1e-3
}

#[derive(Clone, Copy)]
struct Prediction {
    pose: Pose2,
    /// Information of the motion alone.
    motion: Sym3,
    /// Information of the pose: of the motion, from a pose that is not quite sure.
    information: Sym3,
    hypothesis: Hypothesis,
}

/// A match, and what it is worth beside others.
#[derive(Clone, Copy, PartialEq)]
struct Found {
    alignment: Alignment,
    hypothesis: Hypothesis,
    worth: f64,
}

impl Track {
    /// A track that begins at a pose.
    pub fn at(pose: Pose2) -> Self {
        Self {
            pose,
            ..Self::default()
        }
    }

    /// Goes on from another pose, standing; what was learned about the odometry stays.
    pub fn start_at(&mut self, pose: Pose2) {
        self.pose = pose;
        self.velocity = Pose2::default();
    }

    /// Moves to the pose of a match.
    pub fn go(&mut self, pose: Pose2) {
        self.velocity = self.pose.relative(pose).wrapped();
        self.pose = pose;
    }

    fn typical(&self) -> f64 {
        if self.typical_score > 0.0 {
            self.typical_score
        } else {
            FIRST_TYPICAL
        }
    }

    /// The least score of a match that is not doubted.
    fn good_score(&self) -> f64 {
        (self.typical() - BELOW_TYPICAL).max(LEAST_GOOD)
    }

    /// Covariance of the pose over x, y and heading, in the frame of the map.
    pub fn covariance(&self) -> Sym3 {
        self.covariance.plus(SUREST, 1.0)
    }

    /// Finds the pose of a scan in a map; `motion` is that of the odometry since the last scan.
    pub(crate) fn matched(
        &mut self,
        field: &impl TrackMap,
        sweep: &Sweep,
        motion: Option<Pose2>,
        config: &MappingConfig,
    ) -> ScanMatch {
        let hits = config.hits(sweep);
        let motion = motion.map(|motion| (motion, self.noise.corrected(motion)));
        let expected = self.prediction(motion.map(|(_, corrected)| corrected), config);
        let matcher = Matcher {
            field,
            hits: &hits,
            config,
        };
        let corrected = motion.map(|(_, corrected)| corrected);
        let (found, quality) = self.ladder(&matcher, &expected, corrected);
        let Some(found) = found else {
            let moved = expected.information.inverse().unwrap_or(LOST);
            self.covariance = moved.plus(LOST, 1.0);
            return ScanMatch {
                pose: expected.pose.wrapped(),
                quality: Quality::Lost,
                score: 0.0,
                information: expected.motion.times(0.1),
            };
        };
        let alignment = found.alignment;
        let typical = self.typical();
        self.typical_score = typical + NEW_SHARE * (alignment.score - typical);
        if let Some((raw, _)) = motion {
            self.learn(&found, &expected, raw, config);
        }
        let known = expected.information.plus(alignment.information, BELIEVED);
        self.covariance = known.inverse().unwrap_or(LOST);
        ScanMatch {
            pose: alignment.pose,
            quality,
            score: alignment.score,
            information: alignment.information.plus(expected.motion, 1.0),
        }
    }

    fn prediction(&self, motion: Option<Pose2>, config: &MappingConfig) -> Prediction {
        let (pose, information, hypothesis) = if let Some(motion) = motion {
            let pose = self.pose.compose(motion);
            let information = self
                .noise
                .information(&config.odometry, motion, pose.heading);
            (pose, information, Hypothesis::Odometry)
        } else {
            let velocity = &self.velocity;
            // Robots turn and stop: half of the last motion errs less than all of it.
            let half = Pose2::new(0.5 * velocity.x, 0.5 * velocity.y, 0.5 * velocity.heading);
            let (m, rad) = VELOCITY_SIGMAS;
            let t = (m + 0.5 * velocity.position().norm()).powi(-2);
            let information = Sym3::diagonal(t, t, rad.powi(-2));
            (
                self.pose.compose(half),
                information,
                Hypothesis::ConstantVelocity,
            )
        };
        let covariance = information
            .inverse()
            .map(|q| q.plus(self.covariance(), 1.0));
        Prediction {
            pose,
            motion: information,
            information: covariance.and_then(Sym3::inverse).unwrap_or(information),
            hypothesis,
        }
    }

    /// Wider and wider windows until a match is good enough.
    fn ladder(
        &self,
        matcher: &Matcher<'_, impl TrackMap>,
        expected: &Prediction,
        motion: Option<Pose2>,
    ) -> (Option<Found>, Quality) {
        let rule = &matcher.config.front_end;
        let Some(motion) = motion else {
            let near = matcher.in_window(expected, &rule.wide_window);
            let best = better(near, matcher.far(expected, self.pose));
            return (
                best.filter(|found| matcher.is_good(found)),
                quality(best, near),
            );
        };
        let first = matcher.in_window(expected, &rule.window);
        let is_sure =
            |found: &Found| matcher.is_good(found) && found.alignment.score >= self.good_score();
        if first.as_ref().is_some_and(is_sure) {
            return (first, Quality::Ok);
        }
        // Odometry may lie.
        let other = |pose: Pose2, hypothesis| {
            let other = Prediction {
                pose,
                hypothesis,
                ..*expected
            };
            matcher.in_window(&other, &rule.wide_window)
        };
        let reversed = Pose2::new(-motion.x, motion.y, motion.heading);
        let mut best = better(first, matcher.in_window(expected, &rule.wide_window));
        if motion.x.abs() > MIN_REVERSED_M {
            best = better(
                best,
                other(self.pose.compose(reversed), Hypothesis::Reversed),
            );
        }
        let velocity = self.pose.compose(self.velocity);
        best = better(best, other(velocity, Hypothesis::ConstantVelocity));
        if best.as_ref().is_some_and(|found| matcher.is_good(found)) {
            return (best, quality(best, first));
        }
        let far = matcher.far(expected, self.pose);
        (far.filter(|found| matcher.is_good(found)), Quality::Widened)
    }

    /// Learns the odometry's noise from a match.
    fn learn(
        &mut self,
        found: &Found,
        expected: &Prediction,
        motion: Pose2,
        config: &MappingConfig,
    ) {
        if found.hypothesis != Hypothesis::Odometry {
            self.n_contradicted += 1;
            return;
        }
        let alignment = &found.alignment;
        let deviation = difference(alignment.pose, expected.pose);
        let (_, _, strong) = alignment.information.translation();
        let along = strong.dot(Point2::new(deviation[0], deviation[1]));
        let matched = self.pose.relative(alignment.pose).wrapped();
        self.noise.note_motion(matched, motion);
        let sigmas = config.odometry.sigmas(motion);
        self.noise.note((along, deviation[2]), sigmas);
    }
}

fn quality(best: Option<Found>, first: Option<Found>) -> Quality {
    if best == first {
        Quality::Ok
    } else {
        Quality::Widened
    }
}

/// Loss of score per squared standard deviation from the expected pose, and the most that is lost:
/// in a corridor, many poses along it fit nearly as well.
const DOUBT: f64 = 0.01;
const MAX_DOUBT: f64 = 0.25;
/// The sign of a shorter motion does not matter, meters.
const MIN_REVERSED_M: f64 = 0.05;

/// The better of two matches; the first where the second is not clearly better.
fn better(a: Option<Found>, b: Option<Found>) -> Option<Found> {
    match (a, b) {
        (Some(a), Some(b)) if b.worth > a.worth + CLEARLY => Some(b),
        (None, b) => b,
        (a, _) => a,
    }
}

struct Matcher<'a, F> {
    field: &'a F,
    hits: &'a [Point2],
    config: &'a MappingConfig,
}

impl<F: TrackMap> Matcher<'_, F> {
    fn is_good(&self, found: &Found) -> bool {
        let rule = &self.config.front_end;
        let found = &found.alignment;
        found.score >= rule.min_score && self.seen_share(found.pose) >= rule.min_seen_share
    }

    /// Share of all hits that fall on seen ground.
    fn seen_share(&self, pose: Pose2) -> f64 {
        let seen = self.hits.iter().filter(|hit| {
            let place = pose.transform(**hit) * (1.0 / self.field.resolution_m());
            let place = (place.x.round() as i32, place.y.round() as i32);
            !self.field.distance(place).is_nan()
        });
        seen.count() as f64 / self.hits.len().max(1) as f64
    }

    /// The best match of a window around a prediction.
    fn in_window(&self, expected: &Prediction, window: &Window) -> Option<Found> {
        let hits = supported(self.field, self.hits, expected.pose, window.reach_m);
        let starts = search(
            self.field,
            &hits,
            expected.pose,
            &expected.information,
            (window, 3),
        );
        let best = starts.first()?.score;
        let prior = Prior {
            pose: expected.pose,
            information: expected.information,
        };
        let starts = starts
            .iter()
            .filter(|start| start.score >= NEAR_BEST * best);
        let found = starts.map(|start| {
            align(
                self.field,
                &hits,
                start.pose,
                Some(&prior),
                &self.config.align,
            )
        });
        let found = found.min_by(|a, b| a.cost.total_cmp(&b.cost))?;
        Some(worth(found, expected))
    }

    /// The best match far and wide, by branch and bound.
    fn far(&self, expected: &Prediction, center: Pose2) -> Option<Found> {
        let rule = &self.config.front_end;
        let grids = self.field.score_grids()?;
        let stride = self.hits.len().div_ceil(100).max(1);
        let hits: Vec<Point2> = self.hits.iter().copied().step_by(stride).collect();
        let bounds = BoundSearch {
            center,
            reach_m: rule.far_reach_m,
            turn_rad: rule.far_turn_rad,
            turn_step_rad: rule.wide_window.turn_step_rad,
            min_score: 0.5 * rule.min_score,
        };
        let (pose, _) = bounds.run(&grids, &hits)?;
        let prior = Prior {
            pose: expected.pose,
            information: expected.information,
        };
        let prior = (expected.hypothesis == Hypothesis::ConstantVelocity).then_some(&prior);
        let hits = supported(self.field, self.hits, pose, 0.1);
        let found = align(self.field, &hits, pose, prior, &self.config.align);
        let mut found = worth(found, expected);
        if expected.hypothesis == Hypothesis::Odometry {
            found.hypothesis = Hypothesis::ConstantVelocity;
        }
        Some(found)
    }
}

/// What a match is worth: its score, less the doubt about a pose that was not expected.
fn worth(alignment: Alignment, expected: &Prediction) -> Found {
    let deviation = difference(alignment.pose, expected.pose);
    let doubt = (DOUBT * expected.information.form(deviation)).min(MAX_DOUBT);
    let handicap = match expected.hypothesis {
        Hypothesis::Odometry => 0.0,
        Hypothesis::Reversed => 0.04,
        Hypothesis::ConstantVelocity => 0.08,
    };
    Found {
        worth: alignment.score - doubt - handicap,
        alignment,
        hypothesis: expected.hypothesis,
    }
}

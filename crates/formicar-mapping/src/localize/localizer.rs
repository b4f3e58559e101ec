//! Finding a robot: tracking, global start, and `lost` instead of a guess.

use super::map::LocalizationMap;
use crate::config::MappingConfig;
use crate::error::MappingError;
use crate::front_end::{Quality, ScanMatch, Track, is_degenerate};
use crate::matching::{BoundSearch, Robust, align};
use crate::matrix::Sym3;
use crate::scan::{LaserScan, RangePolicy};
use crate::sdf::{SignedDistances, Sweep};
use formicar::{Point2, Pose2};
use std::collections::{BTreeSet, VecDeque};
use std::f64::consts::PI;

/// A pose in the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Located {
    /// The pose of the sensor; the predicted one where the robot is lost.
    pub pose: Pose2,
    /// Its covariance over x, y (square meters) and heading (square radians), in the map's frame.
    pub covariance: Sym3,
    /// How it was found.
    pub quality: Quality,
    /// Mean score, 0 to 1.
    pub score: f64,
    /// Share of hits within the truncation of a mapped surface.
    pub mapped_share: f64,
}

/// Finds a robot in a map, scan after scan.
#[derive(Clone, Debug)]
pub struct Localizer {
    map: LocalizationMap,
    config: MappingConfig,
    policy: RangePolicy,
    track: Option<Track>,
    /// The newest scans with their poses by dead reckoning, for a global start.
    recent: VecDeque<(Sweep, Pose2)>,
    reckoned: Pose2,
    n_lost: usize,
    /// Way since the last scan that was found, meters.
    lost_m: f64,
}

/// Scans that a global start joins.
const N_START_SCANS: usize = 4;
/// Most joined hits.
const MAX_START_HITS: usize = 160;
/// Lost scans in a row after which the whole map is searched.
const LOST_LIMIT: usize = 5;
/// A search in the whole map is believed within this of the reckoned pose, and this per meter lost.
const NEAR_M: f64 = 1.5;
const DRIFT_PER_M: f64 = 0.1;
/// After this way without a match, anything is believed, meters.
const FORGOTTEN_M: f64 = 60.0;
/// Least share of hits near a mapped surface of a scan that counts as found.
const MIN_MAPPED_SHARE: f64 = 0.55;

impl Localizer {
    /// A localizer in a map. Without a start pose the first scans are searched in the whole map.
    ///
    /// # Errors
    /// A parameter outside its range, or a map without a surface.
    pub fn new(
        map: LocalizationMap,
        config: &MappingConfig,
        start: Option<Pose2>,
    ) -> Result<Self, MappingError> {
        config.check()?;
        if map.far.is_none() {
            return Err(MappingError::Mismatch {
                thing: "the map".to_owned(),
                value: "no occupied cell".to_owned(),
                limit: "a robot is found by surfaces".to_owned(),
                hint: "another map, or thresholds that make walls occupied".to_owned(),
            });
        }
        let mut config = config.clone();
        // What is not in the map pulls at nothing.
        config.align.robust = Robust::GemanMcClure { scale_m: 0.05 };
        Ok(Self {
            map,
            policy: config.ranges.clone(),
            config,
            track: start.map(Track::at),
            recent: VecDeque::new(),
            reckoned: Pose2::default(),
            n_lost: 0,
            lost_m: 0.0,
        })
    }

    /// Sets the ranges that are hits, for instance with the no-return code of a log.
    pub fn set_ranges(&mut self, policy: RangePolicy) {
        self.policy = policy;
    }

    /// Finds the pose of the next scan; `motion` is the odometry since the scan before.
    pub fn add(&mut self, scan: &LaserScan, motion: Option<Pose2>) -> Located {
        let (sweep, _) = Sweep::new(scan, &self.policy);
        self.reckoned = self.reckoned.compose(motion.unwrap_or_default());
        if is_degenerate(&sweep, &self.config) {
            return self.not_seen(motion, Quality::Degenerate);
        }
        if self.track.is_none() {
            self.remember(&sweep);
            return self.started(&sweep);
        }
        self.remember(&sweep);
        let found = self.tracked(&sweep, motion);
        if found.quality != Quality::Lost {
            self.n_lost = 0;
            self.lost_m = 0.0;
            return found;
        }
        self.n_lost += 1;
        self.lost_m += motion.map_or(1.0, |motion| motion.position().norm());
        if self.n_lost >= LOST_LIMIT {
            let again = self.started(&sweep);
            if again.quality != Quality::Lost {
                self.lost_m = 0.0;
                self.n_lost = 0;
                return again;
            }
        }
        found
    }

    /// The pose in the whole map that fits scans best, given in the frame of the newest of them;
    /// none where no pose reaches the least score.
    pub fn global(&self, scans: &[(Sweep, Pose2)]) -> Option<(Pose2, f64)> {
        let hits = joined(scans);
        let (low, high) = self.map.extent()?;
        let center = low.lerp(high, 0.5);
        let extent = high - low;
        let search = BoundSearch {
            center: Pose2::at(center, 0.0),
            reach_m: 0.5 * extent.x.max(extent.y),
            turn_rad: PI,
            turn_step_rad: self.config.loops.turn_step_rad,
            min_score: 0.9 * self.config.loops.min_score,
        };
        let stride = hits.len().div_ceil(MAX_START_HITS).max(1);
        let few: Vec<Point2> = hits.iter().copied().step_by(stride).collect();
        let (start, _) = search.run(self.map.far.as_ref()?, &few)?;
        let found = align(&self.map, &few, start, None, &self.config.align);
        (found.score >= self.config.loops.min_score).then_some((found.pose, found.score))
    }

    fn remember(&mut self, sweep: &Sweep) {
        if self.recent.len() == N_START_SCANS {
            self.recent.pop_front();
        }
        self.recent.push_back((sweep.clone(), self.reckoned));
    }

    /// A start in the whole map by the newest scans.
    fn started(&mut self, sweep: &Sweep) -> Located {
        let lost = |pose| Located {
            pose,
            covariance: Sym3::diagonal(1e4, 1e4, 10.0),
            quality: Quality::Lost,
            score: 0.0,
            mapped_share: 0.0,
        };
        let now = self
            .track
            .as_ref()
            .map_or_else(Pose2::default, |track| track.pose);
        if self.recent.len() < N_START_SCANS {
            return lost(now);
        }
        let recent: Vec<(Sweep, Pose2)> = self.recent.iter().cloned().collect();
        let Some((pose, score)) = self.global(&recent) else {
            return lost(now);
        };
        // Buildings repeat themselves: another place far from the reckoned one is not believed soon.
        let off_m = pose.position().distance(now.position());
        let is_near = off_m <= NEAR_M + DRIFT_PER_M * self.lost_m;
        if self.track.is_some() && !is_near && self.lost_m < FORGOTTEN_M {
            return lost(now);
        }
        self.track = Some(Track::at(pose));
        Located {
            pose,
            covariance: Sym3::diagonal(0.01, 0.01, 0.001),
            quality: Quality::First,
            score,
            mapped_share: self.mapped_share(sweep, pose),
        }
    }

    fn tracked(&mut self, sweep: &Sweep, motion: Option<Pose2>) -> Located {
        let Some(track) = &mut self.track else {
            return Located {
                pose: Pose2::default(),
                covariance: Sym3::diagonal(1e4, 1e4, 10.0),
                quality: Quality::Lost,
                score: 0.0,
                mapped_share: 0.0,
            };
        };
        let before = track.pose;
        let ScanMatch {
            mut pose,
            mut quality,
            score,
            ..
        } = track.matched(&self.map, sweep, motion, &self.config);
        let covariance = track.covariance();
        let mapped_share = self.mapped_share(sweep, pose);
        if mapped_share < MIN_MAPPED_SHARE {
            // In a room that the map does not show, any place fits a little: only odometry counts.
            quality = Quality::Lost;
            pose = before.compose(motion.unwrap_or_default()).wrapped();
        }
        if let Some(track) = &mut self.track {
            track.go(pose);
        }
        // A centimeter and a tenth of a degree for the map's own errors.
        let covariance = covariance.plus(Sym3::diagonal(1e-4, 1e-4, 3e-6), 1.0);
        Located {
            pose,
            covariance,
            quality,
            score,
            mapped_share,
        }
    }

    /// A scan that says nothing.
    fn not_seen(&mut self, motion: Option<Pose2>, quality: Quality) -> Located {
        let pose = self.track.as_mut().map(|track| {
            let pose = track.pose.compose(motion.unwrap_or_default()).wrapped();
            track.go(pose);
            pose
        });
        Located {
            pose: pose.unwrap_or_default(),
            covariance: Sym3::diagonal(1.0, 1.0, 1.0),
            quality,
            score: 0.0,
            mapped_share: 0.0,
        }
    }

    /// Share of hits within the truncation of a mapped surface.
    fn mapped_share(&self, sweep: &Sweep, pose: Pose2) -> f64 {
        let hits = self.config.hits(sweep);
        let limit = 0.99 * self.map.truncation_m();
        let near = hits.iter().filter(|hit| {
            let sample = self.map.sample(pose.transform(**hit));
            sample.is_some_and(|s| s.distance_m.abs() < limit)
        });
        near.count() as f64 / hits.len().max(1) as f64
    }
}

/// The hits of scans in the frame of the last, thinned.
fn joined(scans: &[(Sweep, Pose2)]) -> Vec<Point2> {
    const SPACING_M: f64 = 0.15;
    let Some((_, own)) = scans.last() else {
        return Vec::new();
    };
    let mut taken = BTreeSet::new();
    let mut hits = Vec::new();
    for (sweep, pose) in scans.iter().rev() {
        let pose = own.relative(*pose);
        for hit in sweep.points() {
            let hit = pose.transform(hit);
            let cell = hit * (1.0 / SPACING_M);
            if taken.insert((cell.x.floor() as i32, cell.y.floor() as i32)) {
                hits.push(hit);
            }
        }
    }
    hits
}

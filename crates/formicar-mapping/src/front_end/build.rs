//! Scan after scan: matched, made a key scan, inserted into submaps.

use super::quality::{Quality, ScanMatch};
use super::submap::{GrowingSubmap, Submap};
use super::track::{Track, is_degenerate};
use crate::config::MappingConfig;
use crate::matrix::Sym3;
use crate::sdf::Sweep;
use formicar::Pose2;
use serde::{Deserialize, Serialize};

/// A key scan, a node of the pose graph.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Node {
    /// Index of its scan.
    pub scan: usize,
    /// The scan.
    pub sweep: Sweep,
    /// The pose of the sensor that the front end found.
    pub front_pose: Pose2,
    /// The motion from the node before, in its frame.
    pub motion: Pose2,
    /// Information of that motion, in the frame of the node before.
    pub information: Sym3,
    /// How it was matched.
    pub quality: Quality,
}

/// A scan, seen from the last key scan.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScanPlace {
    /// The node that it hangs on.
    pub node: usize,
    /// Its pose in the frame of that node.
    pub offset: Pose2,
    /// How it was matched.
    pub quality: Quality,
    /// Mean score of the match, 0 to 1.
    pub score: f64,
}

/// Information of a start pose that a user or a search gives: 0.3 m and 5 degrees.
const START_SIGMAS: (f64, f64) = (11.0, 131.0);

/// The state of matching scan after scan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrontEnd {
    /// Key scans.
    pub nodes: Vec<Node>,
    /// Every scan.
    pub places: Vec<ScanPlace>,
    /// Submaps that are complete.
    pub submaps: Vec<Submap>,
    /// Submaps that grow: the older first.
    growing: Vec<GrowingSubmap>,
    /// Where the robot is.
    track: Track,
    /// Motion since the last node that matching did not confirm.
    is_loose: bool,
}

/// A front end without its submaps, which follow from the scans and their poses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SavedFrontEnd {
    pub(crate) nodes: Vec<Node>,
    pub(crate) places: Vec<ScanPlace>,
    /// First and one past the last node of each finished submap.
    pub(crate) submaps: Vec<(usize, usize)>,
    /// The same of the growing ones.
    pub(crate) growing: Vec<(usize, usize)>,
    track: Track,
    is_loose: bool,
}

impl FrontEnd {
    /// All that cannot be computed again.
    pub fn saved(&self) -> SavedFrontEnd {
        let growing = self.growing.iter();
        SavedFrontEnd {
            nodes: self.nodes.clone(),
            places: self.places.clone(),
            submaps: self.submaps.iter().map(|submap| submap.nodes).collect(),
            growing: growing
                .map(|submap| (submap.first_node, submap.first_node + submap.n_nodes))
                .collect(),
            track: self.track.clone(),
            is_loose: self.is_loose,
        }
    }

    /// The front end that was saved; its submaps are built again, to the bit.
    pub fn restored(saved: SavedFrontEnd, config: &MappingConfig) -> Self {
        let built = |&(first, end): &(usize, usize)| {
            let mut submap = GrowingSubmap::new(first, config);
            for node in &saved.nodes[first..end] {
                submap.insert(&node.sweep, node.front_pose, config);
            }
            submap
        };
        Self {
            submaps: saved
                .submaps
                .iter()
                .map(|range| built(range).finished())
                .collect(),
            growing: saved.growing.iter().map(built).collect(),
            nodes: saved.nodes,
            places: saved.places,
            track: saved.track,
            is_loose: saved.is_loose,
        }
    }

    /// The pose of the last scan.
    pub fn pose(&self) -> Pose2 {
        self.track.pose
    }

    /// Times that the odometry was contradicted by the scans.
    pub fn n_contradicted(&self) -> usize {
        self.track.n_contradicted
    }

    /// The angle from the odometry's driving direction to the sensor's, radians, as learned.
    pub fn sideways_rad(&self) -> f64 {
        self.track.noise.sideways_rad()
    }

    /// The scales of the odometry's noise, translation and heading, as learned.
    pub fn noise_scales(&self) -> (f64, f64) {
        self.track.noise.scales()
    }

    /// Memory of the submaps, bytes.
    pub fn memory_bytes(&self) -> usize {
        let finished = self
            .submaps
            .iter()
            .map(|submap| submap.field.memory_bytes());
        let growing = self.growing.iter();
        let growing = growing.map(|submap| submap.field.cells().memory_bytes());
        finished.sum::<usize>() + growing.sum::<usize>()
    }

    /// Matches the next scan; `motion` is that of the odometry since the scan before.
    pub fn add(&mut self, sweep: Sweep, motion: Option<Pose2>, config: &MappingConfig) {
        if is_degenerate(&sweep, config) {
            self.skip(motion);
            return;
        }
        if self.growing.is_empty() && !self.nodes.is_empty() {
            self.begin_part(sweep, config);
            return;
        }
        if self.nodes.is_empty() {
            let start = self.track.pose;
            self.begin(sweep, start, Quality::First);
            self.insert_last(config);
            return;
        }
        let field = &self.growing[0].field;
        let found = self.track.matched(field, &sweep, motion, config);
        let last = self.nodes[self.nodes.len() - 1].front_pose;
        let offset = last.relative(found.pose).wrapped();
        let is_key = offset.position().norm() >= config.front_end.key_distance_m
            || offset.heading.abs() >= config.front_end.key_turn_rad
            || found.quality == Quality::Lost;
        self.track.go(found.pose);
        self.is_loose |= found.quality == Quality::Lost;
        if is_key {
            self.push_key(sweep, &found, config);
        } else {
            self.places.push(ScanPlace {
                node: self.nodes.len() - 1,
                offset,
                quality: found.quality,
                score: found.score,
            });
        }
    }

    /// Sets the pose at which the first scan, or the first scan of another log, is expected.
    pub fn start_at(&mut self, pose: Pose2) {
        self.track.start_at(pose);
    }

    /// Ends the growing submaps, so that loops see all of the log.
    pub fn all_submaps(&self) -> Vec<Submap> {
        let mut all = self.submaps.clone();
        all.extend(self.growing.iter().map(GrowingSubmap::finished));
        all
    }

    /// Ends the growing submaps for good: the next scan begins another part.
    pub fn close(&mut self) {
        let growing = std::mem::take(&mut self.growing);
        self.submaps
            .extend(growing.iter().map(GrowingSubmap::finished));
        self.is_loose = true;
    }

    /// The first scan of another part: its place is known as far as its start pose is.
    fn begin_part(&mut self, sweep: Sweep, config: &MappingConfig) {
        let found = ScanMatch {
            pose: self.track.pose,
            quality: Quality::First,
            score: 1.0,
            information: Sym3::diagonal(START_SIGMAS.0, START_SIGMAS.0, START_SIGMAS.1),
        };
        self.push_key(sweep, &found, config);
    }

    /// A scan that tells nothing: only the odometry moves the robot.
    fn skip(&mut self, motion: Option<Pose2>) {
        if let Some(motion) = motion {
            self.track.go(self.track.pose.compose(motion).wrapped());
        }
        let last = self.nodes.last().map(|node| node.front_pose);
        self.places.push(ScanPlace {
            node: self.nodes.len().saturating_sub(1),
            offset: last.map_or(self.track.pose, |last| {
                last.relative(self.track.pose).wrapped()
            }),
            quality: Quality::Degenerate,
            score: 0.0,
        });
    }

    fn begin(&mut self, sweep: Sweep, pose: Pose2, quality: Quality) {
        self.places.push(ScanPlace {
            node: self.nodes.len(),
            offset: Pose2::default(),
            quality,
            score: 1.0,
        });
        self.nodes.push(Node {
            scan: self.places.len() - 1,
            sweep,
            front_pose: pose,
            motion: Pose2::default(),
            information: Sym3::default(),
            quality,
        });
    }

    fn push_key(&mut self, sweep: Sweep, found: &ScanMatch, config: &MappingConfig) {
        let before = self.nodes[self.nodes.len() - 1].front_pose;
        self.begin(sweep, found.pose, found.quality);
        let quality = if self.is_loose {
            Quality::Lost
        } else {
            found.quality
        };
        if let (Some(place), Some(node)) = (self.places.last_mut(), self.nodes.last_mut()) {
            place.score = found.score;
            node.motion = before.relative(found.pose).wrapped();
            node.information = found.information.turned(-before.heading);
            node.quality = quality;
        }
        if found.quality == Quality::Lost {
            // What the submaps show is elsewhere: others begin here.
            let growing = std::mem::take(&mut self.growing);
            self.submaps
                .extend(growing.iter().map(GrowingSubmap::finished));
        }
        self.is_loose = false;
        self.insert_last(config);
    }

    /// Inserts the newest node into the growing submaps; the older is finished when it is full.
    fn insert_last(&mut self, config: &MappingConfig) {
        let i = self.nodes.len() - 1;
        let half = config.front_end.n_submap_scans.div_ceil(2);
        let begins = self
            .growing
            .last()
            .is_none_or(|newest| newest.n_nodes >= half);
        if begins {
            if self.growing.len() == 2 {
                let oldest = self.growing.remove(0);
                self.submaps.push(oldest.finished());
            }
            self.growing.push(GrowingSubmap::new(i, config));
        }
        let node = &self.nodes[i];
        for submap in &mut self.growing {
            submap.insert(&node.sweep, node.front_pose, config);
        }
    }
}

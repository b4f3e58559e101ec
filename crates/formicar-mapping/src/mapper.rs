//! From scans to a map: front end, loops, graph, refinement, occupancy.

use crate::config::MappingConfig;
use crate::error::MappingError;
use crate::front_end::{FrontEnd, Node, Quality, SavedFrontEnd, ScanPlace, Submap};
use crate::graph::{Edge, EdgeKind, solve};
use crate::log::Log;
use crate::loops::{self, LoopMemory, LoopRecord, LoopScene};
use crate::matrix::Sym3;
use crate::occupancy::{RayCounts, occupancy_grid};
use crate::refine::{refined, whole_map};
use crate::scan::{LaserScan, RangeCounts, RangePolicy};
use crate::sdf::{SdfMap, Sweep};
use formicar::{OccupancyGrid, Pose2};
use serde::{Deserialize, Serialize};

/// Noise of an edge from scan to scan beyond what the scan says, meters and radians.
const SEQUENCE_NOISE: (f64, f64) = (0.01, 0.2 * std::f64::consts::PI / 180.0);

/// A step of mapping, for progress bars.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Progress {
    /// Scans matched so far, of all.
    Scans(usize, usize),
    /// Rounds of loops done, of all.
    Loops(usize, usize),
    /// Rounds of refinement done, of all.
    Refinement(usize, usize),
    /// The occupancy is drawn.
    Occupancy,
}

/// The answer of a progress function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Go {
    /// Continue.
    #[default]
    On,
    /// Stop: what is there is kept.
    Stop,
}

/// The log that a mapper works on, and how far it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LogProgress {
    /// A hash of the log's scans.
    pub fingerprint: u64,
    /// Scans done.
    pub n_done: usize,
    /// Scans of the log.
    pub n_scans: usize,
}

/// Builds a map from scans, one by one.
#[derive(Clone, Debug, PartialEq)]
pub struct Mapper {
    config: MappingConfig,
    /// The ranges that are hits, with the no-return code of the log.
    policy: RangePolicy,
    front: FrontEnd,
    counts: RangeCounts,
    n_beams: Option<usize>,
    log: Option<LogProgress>,
}

/// A mapper on its way to a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SavedMapper {
    pub(crate) config: MappingConfig,
    pub(crate) policy: RangePolicy,
    pub(crate) front: SavedFrontEnd,
    pub(crate) counts: RangeCounts,
    pub(crate) n_beams: Option<usize>,
    pub(crate) log: Option<LogProgress>,
}

/// A finished map.
#[derive(Clone, Debug)]
pub struct BuiltMap {
    /// Free, occupied and unknown cells.
    pub grid: OccupancyGrid,
    /// Signed distances of all scans.
    pub field: SdfMap,
    /// The pose of the sensor at every scan.
    pub trajectory: Vec<Pose2>,
    /// The poses of the key scans.
    pub node_poses: Vec<Pose2>,
    /// Every loop that was looked at.
    pub loops: Vec<LoopRecord>,
    /// Largest memory of maps and scans, bytes.
    pub memory_bytes: usize,
}

impl Mapper {
    /// A mapper without scans.
    ///
    /// # Errors
    /// A parameter outside its range.
    pub fn new(config: MappingConfig) -> Result<Self, MappingError> {
        config.check()?;
        Ok(Self {
            policy: config.ranges.clone(),
            config,
            front: FrontEnd::default(),
            counts: RangeCounts::default(),
            n_beams: None,
            log: None,
        })
    }

    /// All that cannot be computed again.
    pub fn saved(&self) -> SavedMapper {
        SavedMapper {
            config: self.config.clone(),
            policy: self.policy.clone(),
            front: self.front.saved(),
            counts: self.counts,
            n_beams: self.n_beams,
            log: self.log,
        }
    }

    /// The mapper that was saved. Its indices must have been checked.
    pub(crate) fn restored(saved: SavedMapper) -> Self {
        Self {
            front: FrontEnd::restored(saved.front, &saved.config),
            config: saved.config,
            policy: saved.policy,
            counts: saved.counts,
            n_beams: saved.n_beams,
            log: saved.log,
        }
    }

    /// The log that was added last, and how far it is.
    pub fn log_progress(&self) -> Option<LogProgress> {
        self.log
    }

    /// Ends the current drive: the next scan is taken at `start`, a pose in the frame of the first
    /// scan as `built` has it.
    pub fn start_drive(&mut self, start: Pose2, built: &BuiltMap) {
        let last = self.front.nodes.last().map(|node| node.front_pose);
        let front_start = match (last, built.node_poses.last()) {
            (Some(front), Some(pose)) => front.compose(pose.relative(start)),
            _ => start,
        };
        self.front.close();
        self.front.start_at(front_start.wrapped());
        self.log = None;
    }

    /// The parameters.
    pub fn config(&self) -> &MappingConfig {
        &self.config
    }

    /// The ranges that are hits, with the no-return code of the log.
    pub fn policy(&self) -> &RangePolicy {
        &self.policy
    }

    /// Key scans.
    pub fn nodes(&self) -> &[Node] {
        &self.front.nodes
    }

    /// Every scan, on its key scan.
    pub fn places(&self) -> &[ScanPlace] {
        &self.front.places
    }

    /// How many ranges of each kind there were.
    pub fn range_counts(&self) -> &RangeCounts {
        &self.counts
    }

    /// The state of the front end.
    pub fn front_end(&self) -> &FrontEnd {
        &self.front
    }

    /// Finds the no-return code of a log; a mapper has one code.
    pub fn resolve_ranges(&mut self, log: &Log) {
        if self.front.places.is_empty() {
            self.policy = self.config.ranges.resolved(log.scans.iter());
        }
    }

    /// Adds a scan; `motion` is the odometry since the scan before, in the frame of the sensor.
    ///
    /// # Errors
    /// A scan with impossible geometry, or with another number of beams than those before.
    pub fn add(&mut self, scan: &LaserScan, motion: Option<Pose2>) -> Result<(), MappingError> {
        let n_beams = scan.ranges_m.len();
        let expected = *self.n_beams.get_or_insert(n_beams);
        if n_beams != expected {
            return Err(MappingError::BeamsChange {
                scan: self.front.places.len(),
                n_beams,
                expected,
            });
        }
        let (sweep, counts) = Sweep::new(scan, &self.policy);
        self.counts.merge(&counts);
        self.front.add(sweep, motion, &self.config);
        Ok(())
    }

    /// The front end's pose of the last scan.
    pub fn pose(&self) -> Pose2 {
        self.front.pose()
    }

    /// Adds the scans of a log; those that `keeps` refuses are left out.
    ///
    /// The motion over a scan that is left out is kept. Ends early where `progress` says so; the same
    /// log then goes on where it ended.
    ///
    /// # Errors
    /// As [`Self::add`].
    pub fn add_log(
        &mut self,
        log: &Log,
        keeps: impl Fn(usize) -> bool,
        mut progress: impl FnMut(Progress) -> Go,
    ) -> Result<Go, MappingError> {
        let fingerprint = log.fingerprint();
        let n_scans = log.scans.len();
        let same = self.log.filter(|known| known.fingerprint == fingerprint);
        let n_done = same.map_or(0, |known| known.n_done);
        let mut motion = Some(Pose2::default());
        for (i, scan) in log.scans.iter().enumerate().skip(n_done) {
            if i > 0 {
                motion = match (motion, log.motion(i)) {
                    (Some(sum), Some(next)) => Some(sum.compose(next)),
                    _ => None,
                };
            }
            if !keeps(i) {
                continue;
            }
            self.add(scan, motion)?;
            motion = log.odometry.is_some().then(Pose2::default);
            self.log = Some(LogProgress {
                fingerprint,
                n_done: i + 1,
                n_scans,
            });
            if progress(Progress::Scans(i + 1, n_scans)) == Go::Stop {
                return Ok(Go::Stop);
            }
        }
        Ok(Go::On)
    }

    /// The edges from key scan to key scan.
    fn sequence_edges(&self) -> Vec<Edge> {
        let (m, rad) = SEQUENCE_NOISE;
        let noise = Sym3::diagonal(m * m, m * m, rad * rad);
        let nodes = self.front.nodes.iter().enumerate().skip(1);
        nodes
            .map(|(i, node)| Edge {
                from: i - 1,
                to: i,
                motion: node.motion,
                information: loops::widened(node.information, &noise),
                kind: match node.quality {
                    Quality::Lost => EdgeKind::Weak,
                    _ => EdgeKind::Sequence,
                },
            })
            .collect()
    }

    /// Closes loops, refines and draws the map. The mapper stays as it is, so that scans can follow.
    ///
    /// Ends early where `progress` says so: with the poses found so far.
    ///
    /// # Errors
    /// No scan, or a map with too many cells.
    pub fn finish(
        &self,
        mut progress: impl FnMut(Progress) -> Go,
    ) -> Result<BuiltMap, MappingError> {
        if self.front.nodes.is_empty() {
            return Err(MappingError::NoScans {
                n_lines: self.front.places.len(),
            });
        }
        let submaps = self.front.all_submaps();
        let mut poses: Vec<Pose2> = self
            .front
            .nodes
            .iter()
            .map(|node| node.front_pose)
            .collect();
        let loops = self.close_loops(&submaps, &mut poses, &mut progress);
        let submap_bytes: usize = submaps.iter().map(|s| s.field.memory_bytes()).sum();
        drop(submaps);
        let nodes = &self.front.nodes;
        let n_rounds = self.config.n_refinements;
        for round in 0..n_rounds {
            let map = whole_map(nodes, &poses, &self.config);
            poses = refined(&map, nodes, &poses, &self.config);
            if progress(Progress::Refinement(round + 1, n_rounds)) == Go::Stop {
                break;
            }
        }
        progress(Progress::Occupancy);
        let (grid, field, map_bytes) = self.drawn(&poses)?;
        let scan_bytes: usize = nodes.iter().map(|node| 4 * node.sweep.ranges_m.len()).sum();
        Ok(BuiltMap {
            trajectory: self.trajectory(&poses),
            memory_bytes: scan_bytes + self.front.memory_bytes() + submap_bytes.max(map_bytes),
            grid,
            field,
            node_poses: poses,
            loops,
        })
    }

    /// The map of the key scans at poses of any origin, for instance those of another program: a
    /// pose of the sensor for each key scan, in their order.
    ///
    /// # Errors
    /// A map with too many cells.
    pub fn map_at(&self, node_poses: &[Pose2]) -> Result<OccupancyGrid, MappingError> {
        Ok(self.drawn(node_poses)?.0)
    }

    /// Cells and signed distances of the key scans at poses, and their memory in bytes.
    fn drawn(&self, poses: &[Pose2]) -> Result<(OccupancyGrid, SdfMap, usize), MappingError> {
        let nodes = &self.front.nodes;
        let field = whole_map(nodes, poses, &self.config);
        let mut counts = RayCounts::new(self.config.resolution_m);
        for (node, &pose) in nodes.iter().zip(poses) {
            counts.add(&node.sweep, pose, self.config.occupancy.reach_m);
        }
        let grid = occupancy_grid(&counts, &field, &self.config.occupancy)?;
        let n_bytes = field.cells().memory_bytes() + counts.memory_bytes();
        Ok((grid, field, n_bytes))
    }

    /// The pose of the sensor at every scan, given those of the key scans.
    pub fn trajectory(&self, node_poses: &[Pose2]) -> Vec<Pose2> {
        let places = self.front.places.iter();
        places
            .map(|place| match node_poses.get(place.node) {
                Some(node) => node.compose(place.offset).wrapped(),
                None => place.offset,
            })
            .collect()
    }

    /// Two stages of loops and the graph's optimization; the poses are updated.
    fn close_loops(
        &self,
        submaps: &[Submap],
        poses: &mut Vec<Pose2>,
        progress: &mut impl FnMut(Progress) -> Go,
    ) -> Vec<LoopRecord> {
        let rule = &self.config.loops;
        let sequence = self.sequence_edges();
        let n_rounds = rule.reaches_m.len() + 1;
        let mut memory = LoopMemory::default();
        let mut records: Vec<LoopRecord> = Vec::new();
        for (round, &reach_m) in rule.reaches_m.iter().enumerate() {
            let scene = self.scene(submaps, poses, &records);
            let found = loops::topology_round(&scene, reach_m, &mut memory);
            records = found;
            *poses = self.optimized(poses, &sequence, &mut records);
            if progress(Progress::Loops(round + 1, n_rounds)) == Go::Stop {
                return records;
            }
        }
        let dense = loops::densify(&self.scene(submaps, poses, &records));
        records.extend(dense);
        *poses = self.optimized(poses, &sequence, &mut records);
        progress(Progress::Loops(n_rounds, n_rounds));
        records
    }

    fn scene<'a>(
        &'a self,
        submaps: &'a [Submap],
        poses: &'a [Pose2],
        known: &'a [LoopRecord],
    ) -> LoopScene<'a> {
        LoopScene {
            nodes: &self.front.nodes,
            submaps,
            poses,
            known,
            config: &self.config,
        }
    }

    /// The poses under the sequence and the accepted loops; outliers among these are marked.
    fn optimized(
        &self,
        poses: &[Pose2],
        sequence: &[Edge],
        records: &mut [LoopRecord],
    ) -> Vec<Pose2> {
        let rule = &self.config.loops;
        let mut edges = sequence.to_vec();
        edges.extend(loops::edges(records, rule));
        let solution = solve(poses, &edges, &rule.graph);
        loops::mark_outliers(records, &solution.weights[sequence.len()..]);
        solution.poses
    }
}

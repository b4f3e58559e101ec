//! What the robot knows of the ground: a prior map, or nothing, and what scans show.

use crate::error::SetupError;
use crate::limits::plan_error;
use formicar::geometry::ConvexPolygon;
use formicar::map::{Cell, CellRegion, FREE, GridFrame, OCCUPIED, UNKNOWN, touched_cells};
use formicar::{OccupancyGrid, Point2, Pose2};
use formicar_mapping::LaserScan;
use formicar_mapping::scan::{RangeKind, RangePolicy};

/// Evidence that a scan with a hit in a cell adds, and that one whose beams pass it takes away.
const HIT: i8 = 3;
const PASS: i8 = 1;
/// Most evidence for an obstacle and for free ground: a second of scans turns one into the other.
const MOST: i8 = 12;
const LEAST: i8 = -6;

/// A map that scans change: free, occupied and unknown cells.
///
/// Every beam is an exact ray. A scan counts once per cell: a cell that holds the end of a beam has
/// a hit, one that beams only cross is passed. Hits weigh more than passes, so that the rim of an
/// obstacle, which is both hit and passed, stays occupied.
#[derive(Clone, Debug)]
pub struct KnownMap {
    frame: GridFrame,
    values: Vec<i8>,
    evidence: Vec<i8>,
    /// The number of the last scan that hit a cell, and that passed it.
    hit_by: Vec<u32>,
    passed_by: Vec<u32>,
    n_scans: u32,
    /// Hits lie this far behind the measured range, so that one on the face of a square lies in it.
    depth_m: f64,
    changed: Option<CellRegion>,
}

/// Cells of a map that have changed, row by row, lowest row first.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownChange {
    /// The rectangle about them.
    pub region: CellRegion,
    /// Its values: -1 unknown, 0 free, 100 occupied.
    pub values: Vec<i8>,
}

impl KnownChange {
    /// The values with unknown cells as another value.
    pub fn with_unknown_as(&self, value: i8) -> Vec<i8> {
        let known = |&v: &i8| if v == UNKNOWN { value } else { v };
        self.values.iter().map(known).collect()
    }
}

impl KnownMap {
    /// Nothing known.
    pub fn unknown(frame: GridFrame) -> Self {
        let n_cells = frame.n_cells();
        Self {
            frame,
            values: vec![UNKNOWN; n_cells],
            evidence: vec![0; n_cells],
            hit_by: vec![0; n_cells],
            passed_by: vec![0; n_cells],
            n_scans: 0,
            depth_m: 1e-3,
            changed: None,
        }
    }

    /// A map known before: its lethal cells are occupied, its unknown ones stay unknown.
    pub fn prior(map: &OccupancyGrid) -> Self {
        let mut known = Self::unknown(*map.frame());
        for (index, &value) in map.values().iter().enumerate() {
            let (value, evidence) = match value {
                UNKNOWN => continue,
                _ if map.is_lethal(map.frame().cell(index)) => (OCCUPIED, MOST),
                _ => (FREE, LEAST),
            };
            known.values[index] = value;
            known.evidence[index] = evidence;
        }
        known
    }

    /// The same, whose hits lie a length behind the measured range.
    #[must_use]
    pub fn with_hit_depth(self, depth_m: f64) -> Self {
        Self { depth_m, ..self }
    }

    /// Size, resolution and origin.
    pub fn frame(&self) -> &GridFrame {
        &self.frame
    }

    /// -1 unknown, 0 free or 100 occupied, row by row.
    pub fn values(&self) -> &[i8] {
        &self.values
    }

    /// The map as a grid.
    ///
    /// # Errors
    /// None that can occur: the values are those of a grid.
    pub fn grid(&self) -> Result<OccupancyGrid, SetupError> {
        OccupancyGrid::new(self.frame, self.values.clone()).map_err(plan_error)
    }

    /// The share of cells that are known.
    pub fn known_share(&self) -> f64 {
        let n_known = self.values.iter().filter(|&&v| v != UNKNOWN).count();
        n_known as f64 / self.values.len().max(1) as f64
    }

    /// Takes the ground under a body as free: the robot stands there.
    pub fn stand_on(&mut self, body: &ConvexPolygon) {
        let (low, high) = body.bounds();
        let step_m = 0.5 * self.frame.resolution_m();
        let steps =
            |low: f64, high: f64| (0..=((high - low) / step_m).ceil() as u32).map(f64::from);
        for y in steps(low.y, high.y).map(|i| low.y + i * step_m) {
            for x in steps(low.x, high.x).map(|i| low.x + i * step_m) {
                let cell = self.frame.cell_at(Point2::new(x, y));
                let cell = cell.filter(|_| body.contains(Point2::new(x, y)));
                if let Some(cell) = cell.filter(|&c| self.values[self.frame.index(c)] == UNKNOWN) {
                    self.set(cell, FREE);
                }
            }
        }
    }

    /// Adds a scan from a pose of the sensor; `skips` tells beams that ended on something that
    /// moves, whose ends are not mapped.
    pub fn insert(
        &mut self,
        scan: &LaserScan,
        sensor: Pose2,
        policy: &RangePolicy,
        skips: &dyn Fn(usize) -> bool,
    ) {
        self.n_scans += 1;
        let mut seen_to = Vec::with_capacity(scan.ranges_m.len());
        for (beam, &range) in scan.ranges_m.iter().enumerate() {
            let (range_m, angle_rad) = (f64::from(range), scan.angle_rad(beam));
            let along = Point2::unit(sensor.heading + angle_rad);
            let is_clear = range_m == f64::INFINITY;
            match policy.kind(range_m, angle_rad) {
                RangeKind::Hit => {
                    seen_to.push(sensor.position() + along * range_m);
                    if !skips(beam) {
                        self.hit(sensor.position() + along * (range_m + self.depth_m));
                    }
                }
                RangeKind::TooFar | RangeKind::NoReturn => {
                    seen_to.push(sensor.position() + along * policy.max_m);
                }
                RangeKind::Invalid if is_clear => {
                    seen_to.push(sensor.position() + along * policy.max_m);
                }
                _ => {}
            }
        }
        for end in seen_to {
            self.pass(sensor.position(), end);
        }
    }

    /// What has changed since this was asked last.
    pub fn take_change(&mut self) -> Option<KnownChange> {
        let region = self.changed.take()?;
        let values = region.cells().map(|c| self.values[self.frame.index(c)]);
        Some(KnownChange {
            values: values.collect(),
            region,
        })
    }

    fn hit(&mut self, point: Point2) {
        let Some(cell) = self.frame.cell_at(point) else {
            return;
        };
        let index = self.frame.index(cell);
        if self.hit_by[index] == self.n_scans {
            return;
        }
        self.hit_by[index] = self.n_scans;
        self.evidence[index] = (self.evidence[index] + HIT).min(MOST);
        self.decide(cell, index);
    }

    fn pass(&mut self, from: Point2, to: Point2) {
        let cells = |p: Point2| {
            let local = self.frame.to_grid(Pose2::at(p, 0.0)).position();
            local * (1.0 / self.frame.resolution_m())
        };
        let (n_cols, n_rows) = (self.frame.n_cols(), self.frame.n_rows());
        let Some((a, b)) = clipped(cells(from), cells(to), n_cols as f64, n_rows as f64) else {
            return;
        };
        for cell in touched_cells(a, b, n_cols, n_rows) {
            let index = self.frame.index(cell);
            let is_done = self.passed_by[index] == self.n_scans;
            if is_done || self.hit_by[index] == self.n_scans {
                continue;
            }
            self.passed_by[index] = self.n_scans;
            self.evidence[index] = (self.evidence[index] - PASS).max(LEAST);
            self.decide(cell, index);
        }
    }

    fn decide(&mut self, cell: Cell, index: usize) {
        let value = if self.evidence[index] > 0 {
            OCCUPIED
        } else {
            FREE
        };
        if value != self.values[index] {
            self.set(cell, value);
        }
    }

    fn set(&mut self, cell: Cell, value: i8) {
        let index = self.frame.index(cell);
        self.values[index] = value;
        let here = CellRegion::new(cell, 1, 1);
        self.changed = Some(self.changed.as_ref().map_or(here, |all| all.with(&here)));
    }
}

/// The part of a segment on a grid, in cell units; none where it misses it.
fn clipped(a: Point2, b: Point2, n_cols: f64, n_rows: f64) -> Option<(Point2, Point2)> {
    let d = b - a;
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (place, step, most) in [(a.x, d.x, n_cols), (a.y, d.y, n_rows)] {
        if step == 0.0 {
            if !(0.0..=most).contains(&place) {
                return None;
            }
            continue;
        }
        let (enter, leave) = (-place / step, (most - place) / step);
        from = from.max(enter.min(leave));
        to = to.min(enter.max(leave));
    }
    let on_grid = |p: Point2| Point2::new(p.x.clamp(0.0, n_cols), p.y.clamp(0.0, n_rows));
    (from <= to).then(|| (on_grid(a.lerp(b, from)), on_grid(a.lerp(b, to))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lidar::LidarConfig;
    use crate::world::World;
    use formicar::Seed;

    const ROOM: [&str; 8] = [
        "############",
        "#..........#",
        "#..........#",
        "#....##....#",
        "#....##....#",
        "#..........#",
        "#..........#",
        "############",
    ];

    fn seen(pose: Pose2, n_scans: usize) -> (OccupancyGrid, KnownMap) {
        let truth = OccupancyGrid::from_rows(&ROOM, 0.25).unwrap();
        let lidar = LidarConfig {
            sigma_m: 0.0,
            mount: [0.0; 3],
            ..LidarConfig::default()
        };
        let world = World::new(truth.clone(), Vec::new());
        let mut known = KnownMap::unknown(*truth.frame());
        for _ in 0..n_scans {
            let mut random = Seed(1).stream([0, 0]);
            let sweep = lidar.sweep(&world, &[], (pose, 0.0), &mut random);
            known.insert(&sweep.scan, pose, &lidar.policy(), &|_| false);
        }
        (truth, known)
    }

    #[test]
    fn what_is_seen_is_true_and_what_is_behind_stays_unknown() {
        let (truth, known) = seen(Pose2::new(0.6, 1.0, 0.0), 5);
        let (mut n_free, mut n_occupied) = (0, 0);
        for (cell, &value) in known.values().iter().enumerate() {
            let cell = truth.frame().cell(cell);
            match value {
                FREE => {
                    assert!(!truth.is_lethal(cell), "{cell:?}");
                    n_free += 1;
                }
                OCCUPIED => {
                    assert!(truth.is_lethal(cell), "{cell:?}");
                    n_occupied += 1;
                }
                _ => {}
            }
        }
        assert!(n_free > 20 && n_occupied > 10, "{n_free} {n_occupied}");
        // Behind the pillar.
        let hidden = truth.frame().cell_at(Point2::new(2.2, 1.0)).unwrap();
        assert_eq!(known.values()[truth.frame().index(hidden)], UNKNOWN);
    }

    #[test]
    fn ground_that_empties_is_free_within_a_second() {
        let (truth, mut known) = seen(Pose2::new(0.6, 1.0, 0.0), 20);
        let pillar = truth.frame().cell_at(Point2::new(1.3, 1.1)).unwrap();
        let index = truth.frame().index(pillar);
        assert_eq!(known.values()[index], OCCUPIED);
        let change = known.take_change().unwrap();
        assert_eq!(change.values.len(), change.region.cells().count());
        assert!(known.take_change().is_none());
        let scan = LaserScan {
            time_s: 0.0,
            first_angle_rad: -0.1,
            angle_step_rad: 0.01,
            ranges_m: vec![2.2; 21],
        };
        let policy = LidarConfig::default().policy();
        for _ in 0..20 {
            known.insert(&scan, Pose2::new(0.6, 1.1, 0.0), &policy, &|_| true);
        }
        assert_eq!(known.values()[index], FREE);
        let change = known.take_change().unwrap();
        assert!(!change.with_unknown_as(OCCUPIED).contains(&UNKNOWN));
    }

    #[test]
    fn rays_that_leave_the_map_end_at_its_border() {
        let (a, b) = clipped(Point2::new(1.0, 1.0), Point2::new(9.0, 1.0), 4.0, 3.0).unwrap();
        assert_eq!((a, b), (Point2::new(1.0, 1.0), Point2::new(4.0, 1.0)));
        assert!(clipped(Point2::new(-2.0, 5.0), Point2::new(9.0, 5.0), 4.0, 3.0).is_none());
    }
}

//! Beams that the map was not built from: leaks, ghosts, and ends in free ground.

use crate::config::MappingConfig;
use crate::log::Log;
use crate::matching::{Prior, Window, align, search};
use crate::matrix::Sym3;
use crate::scan::RangePolicy;
use crate::sdf::{SignedDistances, Sweep};
use formicar::map::{FREE, OCCUPIED, OccupancyGrid};
use formicar::{Point2, Pose2};
use serde::Serialize;

/// Beams beyond this are not judged, meters.
const MAX_RANGE_M: f64 = 10.0;
/// A first obstacle this far from the measured range is early or late, meters.
const TOLERANCE_M: f64 = 0.25;
/// An end counts as occupied where a cell within this many cells is.
const NEAR_CELLS: i64 = 2;
/// Beams that hit a surface at more than this from its normal are grazing: not judged. 70 degrees.
const MAX_INCIDENCE_RAD: f64 = 1.222;

/// Shares of the beams of held-out scans.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct HeldOut {
    /// Scans that were held out and matched.
    pub n_scans: usize,
    /// Scans that were held out and could not be matched.
    pub n_unmatched: usize,
    /// Beams judged: hits within 10 m, not grazing.
    pub n_beams: usize,
    /// Beams whose first obstacle in the map lies more than 0.25 m behind the measured one.
    pub n_late: usize,
    /// Beams whose first obstacle in the map lies more than 0.25 m before the measured one.
    pub n_early: usize,
    /// Beams that end in free ground, no occupied cell within two cells.
    pub n_free_ends: usize,
}

impl HeldOut {
    /// The counts of two logs together.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            n_scans: self.n_scans + other.n_scans,
            n_unmatched: self.n_unmatched + other.n_unmatched,
            n_beams: self.n_beams + other.n_beams,
            n_late: self.n_late + other.n_late,
            n_early: self.n_early + other.n_early,
            n_free_ends: self.n_free_ends + other.n_free_ends,
        }
    }

    /// Share of leaks: beams that pass the map's surface.
    pub fn leaks(&self) -> f64 {
        self.n_late as f64 / self.n_beams.max(1) as f64
    }

    /// Share of beams that stop early in the map.
    pub fn early(&self) -> f64 {
        self.n_early as f64 / self.n_beams.max(1) as f64
    }

    /// Share of ends in free ground.
    pub fn free_ends(&self) -> f64 {
        self.n_free_ends as f64 / self.n_beams.max(1) as f64
    }
}

/// A map to judge: its cells and its signed distances.
#[derive(Clone, Copy, Debug)]
pub struct JudgedMap<'a, F> {
    /// Free, occupied and unknown cells.
    pub grid: &'a OccupancyGrid,
    /// Signed distances, to match the held-out scans with.
    pub field: &'a F,
    /// The ranges that are hits.
    pub policy: &'a RangePolicy,
    /// The parameters of the map.
    pub config: &'a MappingConfig,
}

/// Judges a map by scans that it was not built from.
///
/// `guess` is the expected pose of a scan; each scan is matched with the map first, so that errors
/// of poses do not count as errors of the map. `counts` says of a scan and a beam whether it is
/// judged: beams that end on a person are not.
pub fn held_out(
    map: &JudgedMap<'_, impl SignedDistances>,
    log: &Log,
    scans: &[(usize, Pose2)],
    counts: impl Fn(usize, usize) -> bool,
) -> HeldOut {
    let mut result = HeldOut::default();
    for &(i, guess) in scans {
        let (sweep, _) = Sweep::new(&log.scans[i], map.policy);
        let Some(pose) = matched(map, &sweep, guess) else {
            result.n_unmatched += 1;
            continue;
        };
        result.n_scans += 1;
        let lines = sweep.lines(0.15);
        for (beam, &range) in sweep.ranges_m.iter().enumerate() {
            let range = f64::from(range);
            let sides = [beam.checked_sub(1), Some(beam)];
            let mut near = sides.into_iter().flatten().filter_map(|w| *lines.get(w)?);
            let direction = sweep.direction(beam);
            let is_grazing = near.any(|line| -line.normal.dot(direction) < MAX_INCIDENCE_RAD.cos());
            if range > 0.0 && range < MAX_RANGE_M && !is_grazing && counts(i, beam) {
                judge_beam(map.grid, pose, direction * range, &mut result);
            }
        }
    }
    result
}

/// The pose of a held-out scan in the map; none where it does not fit.
fn matched(
    map: &JudgedMap<'_, impl SignedDistances>,
    sweep: &Sweep,
    guess: Pose2,
) -> Option<Pose2> {
    let hits = map.config.hits(sweep);
    let information = Sym3::diagonal(0.2_f64.powi(-2), 0.2_f64.powi(-2), 0.1_f64.powi(-2));
    let window = Window::default();
    let starts = search(map.field, &hits, guess, &information, (&window, 1));
    let prior = Prior {
        pose: guess,
        information,
    };
    let start = starts.first()?.pose;
    let found = align(map.field, &hits, start, Some(&prior), &map.config.align);
    (found.score >= map.config.front_end.min_score).then_some(found.pose)
}

/// Follows a beam through the cells up to a bit behind its end.
fn judge_beam(grid: &OccupancyGrid, pose: Pose2, hit: Point2, result: &mut HeldOut) {
    let step_m = 0.2 * grid.frame().resolution_m();
    let end = pose.transform(hit);
    let range = hit.norm();
    let along = (end - pose.position()) * (1.0 / range);
    let n_steps = ((range + TOLERANCE_M) / step_m).ceil() as usize;
    let first = (0..=n_steps).map(|i| i as f64 * step_m).find(|&at| {
        let cell = grid.frame().cell_at(pose.position() + along * at);
        cell.is_some_and(|cell| grid.value(cell) == OCCUPIED)
    });
    result.n_beams += 1;
    match first {
        Some(at) if at < range - TOLERANCE_M => result.n_early += 1,
        Some(at) if at <= range + TOLERANCE_M => {}
        _ => result.n_late += 1,
    }
    result.n_free_ends += usize::from(is_free_end(grid, end));
}

/// True where a point lies in a free cell with no occupied cell within two cells.
fn is_free_end(grid: &OccupancyGrid, end: Point2) -> bool {
    let frame = grid.frame();
    let Some(cell) = frame.cell_at(end) else {
        return false;
    };
    let near = |v: u32, n: usize| {
        let low = (i64::from(v) - NEAR_CELLS).max(0);
        low..=(i64::from(v) + NEAR_CELLS).min(n as i64 - 1)
    };
    let is_occupied = |col: i64, row: i64| {
        grid.value(formicar::map::Cell::new(col as u32, row as u32)) == OCCUPIED
    };
    grid.value(cell) == FREE
        && !near(cell.row, frame.n_rows())
            .any(|row| near(cell.col, frame.n_cols()).any(|col| is_occupied(col, row)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaks_early_obstacles_and_free_ends_are_told_apart() {
        let rows = ["..........#", "..........#", "..........#"];
        let grid = OccupancyGrid::from_rows(&rows, 0.1).unwrap();
        let pose = Pose2::new(0.1, 0.15, 0.0);
        let judged = |range: f64| {
            let mut result = HeldOut::default();
            judge_beam(&grid, pose, Point2::new(range, 0.0), &mut result);
            (result.n_late, result.n_early, result.n_free_ends)
        };
        assert_eq!(judged(0.92), (0, 0, 0));
        assert_eq!(judged(0.5), (1, 0, 1), "the wall lies 0.4 m behind");
        assert_eq!(judged(1.3), (0, 1, 0), "the wall lies 0.4 m before");
    }
}

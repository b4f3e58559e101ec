//! The nearest lethal square to a swept region: bounds first, then a scan of bit rows.

use super::convex::Square;
use super::sweep::Sweep;
use super::{Body, Drive, MIN_CLEARANCE_M, ObstacleMap};
use crate::geometry::{Point2, Pose2};
use crate::map::set_bits;

impl ObstacleMap {
    /// Distance from a standing body to the nearest lethal square or the border, meters; 0 when
    /// touching, overlapping or off the map.
    pub fn clearance_m(&self, body: &Body, pose: Pose2) -> f64 {
        self.drive_clearance_m(body, &Drive::at(pose), f64::INFINITY)
    }

    /// Least clearance of a body along a drive, meters, or `limit_m` where it is at least that:
    /// a low limit makes the answer cheap.
    pub fn drive_clearance_m(&self, body: &Body, drive: &Drive, limit_m: f64) -> f64 {
        let parts = body.convex_parts().iter();
        parts.fold(limit_m, |least, part| {
            self.convex_clearance_m(part, drive, least)
        })
    }

    fn convex_clearance_m(&self, body: &Body, drive: &Drive, limit_m: f64) -> f64 {
        drive
            .pieces(drive.n_pieces(body))
            .fold(limit_m, |least, piece| {
                let sweep = Sweep::new(body, piece);
                if self.at_least(&sweep) >= least {
                    return least;
                }
                let distance = self.shrunk_distance(body, &sweep, least + body.inset);
                (distance - body.inset).clamp(0.0, least)
            })
    }

    /// Whether a body can drive without touching anything: its clearance exceeds
    /// [`MIN_CLEARANCE_M`] all the way. A point may touch, but not enter.
    pub fn is_free(&self, body: &Body, drive: &Drive) -> bool {
        let mut parts = body.convex_parts().iter();
        parts.all(|part| self.is_convex_free(part, drive))
    }

    fn is_convex_free(&self, body: &Body, drive: &Drive) -> bool {
        drive.pieces(drive.n_pieces(body)).all(|piece| {
            let sweep = Sweep::new(body, piece);
            self.at_least(&sweep) > MIN_CLEARANCE_M
                || self.shrunk_distance(body, &sweep, 2.0 * MIN_CLEARANCE_M) > MIN_CLEARANCE_M
        })
    }

    /// A quick lower bound of the clearance along a drive, meters; may be negative.
    pub fn clearance_bound_m(&self, body: &Body, drive: &Drive) -> f64 {
        let parts = body.convex_parts().iter();
        let bounds = parts.flat_map(|part| {
            let pieces = drive.pieces(drive.n_pieces(part));
            pieces.map(|piece| self.at_least(&Sweep::new(part, piece)))
        });
        bounds.fold(f64::INFINITY, f64::min)
    }

    /// A quick lower bound of a single piece's distance, by discs and the distance transform.
    fn at_least(&self, sweep: &Sweep) -> f64 {
        let (discs, radius) = sweep.discs();
        let near = discs
            .map(|p| self.free_radius_m(p))
            .fold(f64::INFINITY, f64::min);
        self.window_gap(sweep).min(near - radius)
    }

    /// Least distance to squares shrunk by the body's inset and a border widened by it, capped at
    /// `limit`.
    fn shrunk_distance(&self, body: &Body, sweep: &Sweep, limit: f64) -> f64 {
        let limit = limit.min(self.border_distance(sweep, limit) + body.inset);
        if limit <= 0.0 || self.covers(sweep.witness(), body.inset) {
            return 0.0;
        }
        // A far limit would mean a wide scan: begin with what the distance transform promises.
        let mut reach = limit
            .min(self.obstacle_within_m(sweep.inner_center()) - body.inner_radius + body.inset);
        loop {
            match self.scan(body, sweep, reach) {
                Some(distance) => return distance,
                None if reach >= limit => return limit,
                None => reach = (2.0 * reach).max(self.frame().resolution_m()).min(limit),
            }
        }
    }

    /// Least distance below `reach` to the shrunk squares, if any is that near. Only squares on
    /// the rim of an obstacle count: what starts outside meets those first.
    fn scan(&self, body: &Body, sweep: &Sweep, reach: f64) -> Option<f64> {
        let (low, high) = sweep.window();
        let resolution = self.frame().resolution_m();
        let half = 0.5 * resolution - body.inset;
        let (cols, rows) = self.cells_between(low, high, reach);
        let near = rows.flat_map(|row| {
            let words = cols.start / 64..cols.end.div_ceil(64);
            let rim = self.rim().row(row);
            words.flat_map({
                let cols = cols.clone();
                move |w| {
                    set_bits(rim[w] & word_mask(w, &cols))
                        .map(move |bit| (w * 64 + bit as usize, row))
                }
            })
        });
        let mut least = reach;
        for (col, row) in near {
            let center = Point2::new(col as f64 + 0.5, row as f64 + 0.5) * resolution;
            let square = Square { center, half };
            if sweep.at_least(&square) < least {
                least = least.min(sweep.distance(&square, least));
                if least == 0.0 {
                    break;
                }
            }
        }
        (least < reach).then_some(least)
    }

    /// Gap between the box around a sweep and the map's border; negative where it reaches out.
    fn window_gap(&self, sweep: &Sweep) -> f64 {
        let (low, high) = sweep.window();
        self.border_gap(low, high)
    }

    /// Exact gap between a sweep and the map's border; `limit` where it is at least that.
    fn border_distance(&self, sweep: &Sweep, limit: f64) -> f64 {
        if self.window_gap(sweep) >= limit {
            return limit;
        }
        let (low, high) = sweep.bounds();
        self.border_gap(low, high)
    }
}

/// The bits of word `w` that stand for columns in a range.
fn word_mask(w: usize, cols: &std::ops::Range<usize>) -> u64 {
    let from = cols.start.saturating_sub(w * 64).min(64);
    let to = (cols.end - w * 64).min(64);
    if from >= to {
        0
    } else {
        (u64::MAX >> (64 - (to - from))) << from
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn word_masks_cut_both_ends() {
        assert_eq!(word_mask(0, &(0..64)), u64::MAX);
        assert_eq!(word_mask(0, &(3..5)), 0b11000);
        assert_eq!(word_mask(1, &(60..66)), 0b11);
        assert_eq!(word_mask(0, &(60..66)), 0b1111 << 60);
    }
}

//! The overlap of a standing body with obstacles, for messages.

use super::convex::{Square, penetration};
use super::sweep::Sweep;
use super::{Body, Drive, ObstacleMap};
use crate::geometry::{Point2, Pose2};
use crate::map::Cell;

/// A body in something that is not free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    /// The lethal cell that is entered deepest; none where the body leaves the map.
    pub cell: Option<Cell>,
    /// Depth, meters: the distance to move out of that square, or back onto the map.
    pub depth_m: f64,
    /// Number of lethal cells touched.
    pub n_cells: usize,
}

impl ObstacleMap {
    /// The overlap of a standing body; `None` where it stands free.
    pub fn overlap(&self, body: &Body, pose: Pose2) -> Option<Overlap> {
        if self.is_free(body, &Drive::at(pose)) {
            return None;
        }
        let sweep = Sweep::new(body, Drive::at(pose));
        let (low, high) = sweep.bounds();
        let outside = -self.border_gap(low, high);
        if outside >= 0.0 {
            return Some(Overlap {
                cell: None,
                depth_m: outside,
                n_cells: 0,
            });
        }
        let parts = placed_parts(body, pose);
        let resolution = self.frame().resolution_m();
        let half = 0.5 * resolution - body.inset;
        let (cols, rows) = self.cells_between(low, high, 0.0);
        let touched = rows
            .flat_map(|row| cols.clone().map(move |col| (col, row)))
            .filter(|&(col, row)| self.lethal().get(col, row))
            .map(|(col, row)| {
                let center = Point2::new(col as f64 + 0.5, row as f64 + 0.5) * resolution;
                let depth_m = deepest_m(&parts, &Square { center, half });
                (Cell::new(col as u32, row as u32), depth_m)
            })
            .filter(|&(_, depth_m)| depth_m > -super::MIN_CLEARANCE_M);
        let nothing = Overlap {
            cell: None,
            depth_m: 0.0,
            n_cells: 0,
        };
        Some(touched.fold(nothing, |deepest, (cell, depth_m)| {
            let n_cells = deepest.n_cells + 1;
            if deepest.cell.is_none() || depth_m > deepest.depth_m {
                Overlap {
                    cell: Some(cell),
                    depth_m: depth_m.max(0.0),
                    n_cells,
                }
            } else {
                Overlap { n_cells, ..deepest }
            }
        }))
    }

    /// The lethal cells that a standing body touches, row by row; none where it stands free.
    pub fn touched_cells(&self, body: &Body, pose: Pose2) -> Vec<Cell> {
        let (low, high) = Sweep::new(body, Drive::at(pose)).bounds();
        let parts = placed_parts(body, pose);
        let resolution = self.frame().resolution_m();
        let half = 0.5 * resolution - body.inset;
        let (cols, rows) = self.cells_between(low, high, 0.0);
        let touches = |&(col, row): &(usize, usize)| {
            let center = Point2::new(col as f64 + 0.5, row as f64 + 0.5) * resolution;
            deepest_m(&parts, &Square { center, half }) > -super::MIN_CLEARANCE_M
        };
        rows.flat_map(|row| cols.clone().map(move |col| (col, row)))
            .filter(|&(col, row)| self.lethal().get(col, row))
            .filter(touches)
            .map(|(col, row)| Cell::new(col as u32, row as u32))
            .collect()
    }

    /// The nearest pose with the same heading where the body stands free, searched by rings of
    /// cells up to `reach_m` away.
    pub fn nearest_free_pose(&self, body: &Body, pose: Pose2, reach_m: f64) -> Option<Pose2> {
        let step = self.frame().resolution_m();
        let n_rings = (reach_m / step).min(200.0) as i32;
        for ring in 0..=n_rings {
            let free = ring_offsets(ring)
                .map(|(dx, dy)| Point2::new(f64::from(dx), f64::from(dy)) * step)
                .filter(|d| {
                    self.is_free(
                        body,
                        &Drive::at(Pose2::at(pose.position() + *d, pose.heading)),
                    )
                })
                .min_by(|a, b| a.norm().total_cmp(&b.norm()));
            if let Some(d) = free {
                return Some(Pose2::at(pose.position() + d, pose.heading));
            }
        }
        None
    }
}

fn ring_offsets(ring: i32) -> impl Iterator<Item = (i32, i32)> {
    (-ring..=ring).flat_map(move |dy| {
        let step = if dy.abs() == ring {
            1
        } else {
            (2 * ring).max(1)
        };
        (-ring..=ring)
            .step_by(step as usize)
            .map(move |dx| (dx, dy))
    })
}
/// Corners of the convex parts of a standing body.
fn placed_parts(body: &Body, pose: Pose2) -> Vec<Vec<Point2>> {
    let placed = |part: &Body| part.corners.iter().map(|&p| pose.transform(p)).collect();
    body.convex_parts().iter().map(placed).collect()
}

/// The depth of the part that enters a square deepest, meters; negative where none does.
fn deepest_m(parts: &[Vec<Point2>], square: &Square) -> f64 {
    let depths = parts.iter().map(|corners| penetration(corners, square));
    depths.fold(f64::NEG_INFINITY, f64::max)
}

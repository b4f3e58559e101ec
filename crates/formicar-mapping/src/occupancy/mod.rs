//! The map for planning: free, occupied or unknown, from ray counts and signed distances.

mod counts;

pub use counts::{RayCount, RayCounts};

use crate::error::MappingError;
use crate::sdf::{SdfCell, SdfMap};
use formicar::Pose2;
use formicar::map::{FREE, GridFrame, MAX_CELLS, OCCUPIED, OccupancyGrid, UNKNOWN};
use serde::{Deserialize, Serialize};

/// Parameters of the map for planning.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OccupancyRule {
    /// Rays longer than this show free ground up to here only, meters.
    pub reach_m: f64,
    /// A cell is occupied from this share of hits among its rays on.
    pub min_hit_share: f64,
    /// And from this number of hits on.
    pub min_hits: u32,
    /// A cell is free from this number of rays through it on.
    pub min_misses: u32,
    /// Rays through a cell that contradict a surface there.
    pub min_contradictions: u32,
    /// Least weight of a signed distance.
    pub min_weight: f64,
    /// Unknown ground around the map, meters.
    pub margin_m: f64,
}

impl Default for OccupancyRule {
    fn default() -> Self {
        Self {
            reach_m: 20.0,
            min_hit_share: 0.25,
            min_hits: 2,
            min_misses: 2,
            min_contradictions: 3,
            min_weight: 1.5,
            margin_m: 1.0,
        }
    }
}

/// The class of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Class {
    Free,
    Occupied,
    Unknown,
}

/// A grid of what counts and distances say.
///
/// A cell is occupied where the counts say so, or where the distances say so and the rays through
/// the cell do not contradict it: counts clear people and leave pinholes in walls seen from afar,
/// distances close walls and keep people. Unknown stays unknown. Cells are centered on the vertices
/// of the signed distances.
///
/// # Errors
/// A map with more cells than a grid may have.
pub fn occupancy_grid(
    counts: &RayCounts,
    field: &SdfMap,
    rule: &OccupancyRule,
) -> Result<OccupancyGrid, MappingError> {
    use crate::sdf::SignedDistances;
    let resolution = field.resolution_m();
    let (low, high) = bounds(counts, field);
    let margin = (rule.margin_m / resolution).ceil() as i32;
    let low = (low.0 - margin, low.1 - margin);
    let (n_cols, n_rows) = (
        (i64::from(high.0) - i64::from(low.0) + i64::from(margin)).max(1) as usize,
        (i64::from(high.1) - i64::from(low.1) + i64::from(margin)).max(1) as usize,
    );
    let corner = |v: i32| (f64::from(v) - 0.5) * resolution;
    let origin = Pose2::new(corner(low.0), corner(low.1), 0.0);
    let frame = GridFrame::new(n_cols, n_rows, resolution, origin).map_err(|_| {
        MappingError::MapTooLarge {
            width_m: n_cols as f64 * resolution,
            height_m: n_rows as f64 * resolution,
            resolution_m: resolution,
            limit: MAX_CELLS,
        }
    })?;
    let mut values = vec![UNKNOWN; n_cols * n_rows];
    for (i, value) in values.iter_mut().enumerate() {
        let place = (low.0 + (i % n_cols) as i32, low.1 + (i / n_cols) as i32);
        let class = class(
            counts.get(place),
            field.cells().get(place),
            resolution,
            rule,
        );
        *value = match class {
            Class::Free => FREE,
            Class::Occupied => OCCUPIED,
            Class::Unknown => UNKNOWN,
        };
    }
    let grid = OccupancyGrid::new(frame, values);
    grid.map_err(|error| MappingError::Session {
        reason: error.to_string(),
    })
}

fn class(count: RayCount, cell: SdfCell, resolution: f64, rule: &OccupancyRule) -> Class {
    let (hits, misses) = (count.hits, count.misses);
    let share = rule.min_hit_share * f64::from(hits + misses);
    let is_hit = hits >= rule.min_hits && f64::from(hits) >= share;
    let is_known = f64::from(cell.weight) >= rule.min_weight;
    let is_surface = is_known && f64::from(cell.distance_m) <= 0.5 * resolution;
    let is_contradicted = misses >= rule.min_contradictions && f64::from(hits) < share;
    if is_hit || (is_surface && !is_contradicted) {
        return Class::Occupied;
    }
    let is_open = is_known && f64::from(cell.distance_m) > 0.5 * resolution && hits == 0;
    if misses >= rule.min_misses || is_open {
        return Class::Free;
    }
    Class::Unknown
}

/// First cell and one past the last of what was seen; tiles are larger than what is in them.
fn bounds(counts: &RayCounts, field: &SdfMap) -> ((i32, i32), (i32, i32)) {
    let seen = counts.seen().chain(
        field
            .cells()
            .iter()
            .filter(|(_, cell)| cell.weight > 0.0)
            .map(|(place, _)| place),
    );
    let start = ((i32::MAX, i32::MAX), (i32::MIN, i32::MIN));
    let (low, high) = seen.fold(start, |(low, high), (x, y)| {
        (
            (low.0.min(x), low.1.min(y)),
            (high.0.max(x + 1), high.1.max(y + 1)),
        )
    });
    if low.0 > high.0 {
        ((0, 0), (1, 1))
    } else {
        (low, high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_and_distances_decide_together() {
        let rule = OccupancyRule::default();
        let cell = |distance_m: f32, weight: f32| SdfCell { distance_m, weight };
        let count = |hits, misses| RayCount { hits, misses };
        let of = |c: RayCount, d: SdfCell| class(c, d, 0.05, &rule);
        let none = cell(0.0, 0.0);
        assert_eq!(of(count(2, 6), none), Class::Occupied);
        assert_eq!(of(count(2, 7), none), Class::Free);
        assert_eq!(of(count(1, 0), none), Class::Unknown);
        assert_eq!(
            of(count(0, 0), cell(0.01, 2.0)),
            Class::Occupied,
            "a closed wall"
        );
        assert_eq!(
            of(count(0, 3), cell(0.01, 2.0)),
            Class::Free,
            "a person who left"
        );
        assert_eq!(of(count(0, 0), cell(0.1, 2.0)), Class::Free);
        assert_eq!(of(count(0, 0), cell(0.1, 1.0)), Class::Unknown);
    }
}

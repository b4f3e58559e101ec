//! Areas with speed limits of their own.

use crate::geometry::Point2;
use crate::map::{Cell, OccupancyGrid};
use crate::parameters::OutOfRange;
use crate::path::CurveSegment;

/// The meaning of a mask's values.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum ZoneUnit {
    /// Percent of the top speed.
    Percent,
    /// Meters per second.
    MetersPerSecond,
}

/// A grid of speed limits, as the masks of Nav2's speed filter are: the limit in a cell is
/// `base + multiplier * value`, where the value is 1 to 100. Cells of value 0, unknown cells and
/// ground off the grid have no limit. A vehicle is where the center of its rear axle is.
///
/// ```
/// use formicar::scenario::{SpeedZones, ZoneUnit};
/// use formicar::{OccupancyGrid, Point2};
///
/// let mask = OccupancyGrid::from_rows(&["..##"], 1.0)?;
/// let zones = SpeedZones::new(mask, ZoneUnit::Percent, 0.0, 0.5)?;
/// assert_eq!(zones.limit_mps(Point2::new(0.5, 0.5), 2.0), f64::INFINITY);
/// // 100 in the mask is half of the top speed.
/// assert_eq!(zones.limit_mps(Point2::new(2.5, 0.5), 2.0), 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedZones {
    mask: OccupancyGrid,
    unit: ZoneUnit,
    base: f64,
    multiplier: f64,
}

impl SpeedZones {
    /// The zones of a mask.
    ///
    /// # Errors
    /// A base or a multiplier with which some value of the mask gives a limit that is not finite
    /// or not above 0.
    pub fn new(
        mask: OccupancyGrid,
        unit: ZoneUnit,
        base: f64,
        multiplier: f64,
    ) -> Result<Self, OutOfRange> {
        let limits = mask.values().iter().filter(|&&value| value > 0);
        let bad = limits
            .map(|&value| base + multiplier * f64::from(value))
            .find(|limit| !(limit.is_finite() && *limit > 0.0));
        match bad {
            Some(value) => Err(OutOfRange {
                key: "speed limit of a zone".to_owned(),
                value,
                range: "finite and above 0; hint: the limit is base + multiplier * value, and a \
                        value of 0 in the mask means no limit"
                    .to_owned(),
            }),
            None => Ok(Self {
                mask,
                unit,
                base,
                multiplier,
            }),
        }
    }

    /// The limit at a place for a vehicle with a top speed, m/s; infinite where there is none.
    pub fn limit_mps(&self, place: Point2, top_speed_mps: f64) -> f64 {
        let cell = self.mask.frame().cell_at(place);
        cell.map_or(f64::INFINITY, |cell| self.limit_in(cell, top_speed_mps))
    }

    /// The least limit on a part of a segment: that of all cells in a box around it.
    pub fn limit_between_mps(
        &self,
        segment: &CurveSegment,
        [from_m, to_m]: [f64; 2],
        top_speed_mps: f64,
    ) -> f64 {
        let frame = self.mask.frame();
        let [a, b] = [from_m, to_m].map(|s_m| frame.to_grid(segment.pose_at(s_m)).position());
        // A curve of bounded curvature leaves its chord by at most k l^2 / 8, and a little more
        // where it turns far.
        let length_m = to_m - from_m;
        let bulge_m = 0.25 * segment.max_abs_curvature_per_m() * length_m * length_m + 1e-9;
        let index = |value: f64| (value / frame.resolution_m()).floor() as i64;
        let range = |low: f64, high: f64, n: usize| {
            index(low - bulge_m).max(0)..=index(high + bulge_m).min(n as i64 - 1)
        };
        let rows = range(a.y.min(b.y), a.y.max(b.y), frame.n_rows());
        let mut least = f64::INFINITY;
        for row in rows {
            for col in range(a.x.min(b.x), a.x.max(b.x), frame.n_cols()) {
                let cell = Cell::new(col as u32, row as u32);
                least = least.min(self.limit_in(cell, top_speed_mps));
            }
        }
        least
    }

    fn limit_in(&self, cell: Cell, top_speed_mps: f64) -> f64 {
        let value = self.mask.value(cell);
        if value <= 0 {
            return f64::INFINITY;
        }
        let limit = self.base + self.multiplier * f64::from(value);
        match self.unit {
            ZoneUnit::Percent => 0.01 * limit * top_speed_mps,
            ZoneUnit::MetersPerSecond => limit,
        }
    }
}

//! The signed distance map, and a packed copy of it for matching.

use super::tiles::{Place, Tiles};
use formicar::Point2;
use serde::{Deserialize, Serialize};

/// A vertex of the map: distance to the nearest surface, positive on the sensor's side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SdfCell {
    /// Signed distance, meters, cut off at the truncation.
    pub distance_m: f32,
    /// Weight of what was seen; 0 where nothing was.
    pub weight: f32,
}

/// Signed distance and its gradient at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Signed distance, meters.
    pub distance_m: f64,
    /// Gradient, meters per meter.
    pub gradient: Point2,
}

/// A field of signed distances that scans are matched against.
pub trait SignedDistances {
    /// Side of a cell, meters.
    fn resolution_m(&self) -> f64;
    /// Distances are cut off here, meters.
    fn truncation_m(&self) -> f64;
    /// The distances at `(x, y)`, `(x + 1, y)`, `(x, y + 1)`, `(x + 1, y + 1)`; NaN where nothing
    /// was seen.
    fn quad(&self, place: Place) -> [f32; 4];
    /// The distance at a vertex; NaN where nothing was seen.
    fn distance(&self, place: Place) -> f32;

    /// Bilinear distance and its exact gradient; none next to a vertex that was never seen.
    #[inline]
    fn sample(&self, point: Point2) -> Option<Sample> {
        let scale = 1.0 / self.resolution_m();
        let (x, y) = (point.x * scale, point.y * scale);
        let (col, row) = (floor(x), floor(y));
        let [a, b, c, d] = self.quad((col, row)).map(f64::from);
        let (u, v) = (x - f64::from(col), y - f64::from(row));
        let (low, high) = (a + (b - a) * u, c + (d - c) * u);
        let distance_m = low + (high - low) * v;
        if distance_m.is_nan() {
            return None;
        }
        let gradient = Point2::new((b - a) + ((d - c) - (b - a)) * v, high - low) * scale;
        Some(Sample {
            distance_m,
            gradient,
        })
    }
}

/// The floor as an integer; the library function is a call on common targets.
#[inline]
pub(super) fn floor(v: f64) -> i32 {
    let whole = v as i32;
    whole - i32::from(f64::from(whole) > v)
}

/// Signed distances with weights, on vertices that are a resolution apart; vertex (0, 0) is the
/// origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SdfMap {
    pub(super) resolution_m: f64,
    pub(super) truncation_m: f64,
    pub(super) cells: Tiles<SdfCell>,
}

impl SdfMap {
    /// An empty map.
    pub fn new(resolution_m: f64, truncation_m: f64) -> Self {
        Self {
            resolution_m,
            truncation_m,
            cells: Tiles::new(SdfCell::default()),
        }
    }

    /// The vertices.
    pub fn cells(&self) -> &Tiles<SdfCell> {
        &self.cells
    }

    /// Sets the distance of a vertex, with weight 1.
    pub fn write(&mut self, place: Place, distance_m: f64) {
        self.cells.update(place, |cell| {
            *cell = SdfCell {
                distance_m: distance_m as f32,
                weight: 1.0,
            };
        });
    }

    /// A copy for matching alone, an eighth of the size: distances in steps of the truncation / 127,
    /// tiles in which no surface was seen left out.
    pub fn packed(&self) -> PackedSdf {
        let mut packed = Tiles::new(UNSEEN);
        let scale = (127.0 / self.truncation_m) as f32;
        for (first, values) in self.cells.tiles() {
            let is_near = |cell: &SdfCell| {
                cell.weight > 0.0 && f64::from(cell.distance_m.abs()) < 0.99 * self.truncation_m
            };
            if !values.iter().any(is_near) {
                continue;
            }
            for (row, values) in values.chunks_exact(super::tiles::TILE as usize).enumerate() {
                let y = first.1 + row as i32;
                let last = first.0 + super::tiles::TILE - 1;
                packed.update_row(y, first.0, last, |x, slot| {
                    *slot = packed_byte(values[(x - first.0) as usize], scale);
                });
            }
        }
        PackedSdf {
            resolution_m: self.resolution_m,
            truncation_m: self.truncation_m,
            unit_m: (self.truncation_m / 127.0) as f32,
            cells: packed,
        }
    }
}

impl SignedDistances for SdfMap {
    fn resolution_m(&self) -> f64 {
        self.resolution_m
    }

    fn truncation_m(&self) -> f64 {
        self.truncation_m
    }

    #[inline]
    fn quad(&self, place: Place) -> [f32; 4] {
        self.cells.quad(place).map(seen)
    }

    #[inline]
    fn distance(&self, place: Place) -> f32 {
        seen(self.cells.get(place))
    }
}

#[inline]
fn seen(cell: SdfCell) -> f32 {
    if cell.weight > 0.0 {
        cell.distance_m
    } else {
        f32::NAN
    }
}

/// A packed distance that stands for "never seen".
const UNSEEN: i8 = i8::MIN;

/// A vertex in a byte.
fn packed_byte(cell: SdfCell, scale: f32) -> i8 {
    if cell.weight > 0.0 {
        (cell.distance_m * scale).round().clamp(-127.0, 127.0) as i8
    } else {
        UNSEEN
    }
}

/// Signed distances in a byte each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PackedSdf {
    resolution_m: f64,
    truncation_m: f64,
    unit_m: f32,
    cells: Tiles<i8>,
}

impl PackedSdf {
    /// Memory in use, bytes.
    pub fn memory_bytes(&self) -> usize {
        self.cells.memory_bytes()
    }

    /// First cell and one past the last, of the tiles in use.
    pub fn bounds(&self) -> Option<(Place, Place)> {
        self.cells.bounds()
    }

    /// Cells nearer to a surface than the truncation, with their distances in meters.
    pub fn near_cells(&self) -> impl Iterator<Item = (Place, f32)> {
        let near = self.cells.iter();
        let near = near.filter(|(_, value)| *value != UNSEEN && value.unsigned_abs() < 127);
        near.map(|(place, value)| (place, f32::from(value) * self.unit_m))
    }

    #[inline]
    fn meters(&self, value: i8) -> f32 {
        if value == UNSEEN {
            f32::NAN
        } else {
            f32::from(value) * self.unit_m
        }
    }
}

impl SignedDistances for PackedSdf {
    fn resolution_m(&self) -> f64 {
        self.resolution_m
    }

    fn truncation_m(&self) -> f64 {
        self.truncation_m
    }

    #[inline]
    fn quad(&self, place: Place) -> [f32; 4] {
        self.cells.quad(place).map(|value| self.meters(value))
    }

    #[inline]
    fn distance(&self, place: Place) -> f32 {
        self.meters(self.cells.get(place))
    }
}

//! The narrow set: tight places of measures that users report, drawn in meters.

use crate::map::OccupancyGrid;
use crate::map::sketch::{Rect, Sketch};

/// Side of a cell, meters.
const RESOLUTION_M: f64 = 0.05;
/// A parked car along x: length and width, meters.
const PARKED_CAR_M: [f64; 2] = [4.5, 1.8];

/// Four aisles of 1.1 m between racks of 1.2 m, joined by cross aisles of 1.2 m at both ends; the
/// third is closed at the bottom.
pub(super) fn aisle() -> OccupancyGrid {
    let mut sketch = Sketch::room([8.2, 7.6], RESOLUTION_M);
    sketch.wall(0.1);
    for x in [1.2, 3.5, 5.8] {
        sketch.fill(Rect::sized(x, 1.3, [1.2, 5.0]));
    }
    sketch.fill(Rect::new(4.7, 1.3, 5.8, 1.4));
    sketch.finish()
}

/// Two corridors of 1.2 m that cross in the middle.
pub(super) fn junction() -> OccupancyGrid {
    let mut sketch = Sketch::solid([6.2, 6.2], RESOLUTION_M);
    sketch.clear(Rect::new(2.5, 0.1, 3.7, 6.1));
    sketch.clear(Rect::new(0.1, 2.5, 6.1, 3.7));
    sketch.finish()
}

/// Two closed streets of 7.5 m, the right one with cars parked along one side.
pub(super) fn u_turn_street() -> OccupancyGrid {
    let mut sketch = Sketch::solid([40.0, 11.5], RESOLUTION_M);
    sketch.clear(Rect::new(0.5, 2.0, 19.0, 9.5));
    sketch.clear(Rect::new(20.0, 2.0, 39.5, 9.5));
    for x in [20.6, 25.8, 31.0] {
        sketch.fill(Rect::sized(x, 2.1, PARKED_CAR_M));
    }
    sketch.fill(Rect::sized(35.0, 2.1, [4.4, 1.8]));
    sketch.finish()
}

/// A row of parked cars with gaps of 6.4 and 5.9 m beside a lane of 5.0 m.
pub(super) fn parallel_parking() -> OccupancyGrid {
    let mut sketch = Sketch::solid([27.0, 9.0], RESOLUTION_M);
    sketch.clear(Rect::new(0.3, 1.0, 26.7, 8.0));
    for x in [0.5, 11.4, 21.8] {
        sketch.fill(Rect::sized(x, 1.2, PARKED_CAR_M));
    }
    sketch.finish()
}

/// Nine bays of 2.4 m along an aisle of 5.5 m, all taken but the middle one; the cars across the
/// aisle are a wall.
pub(super) fn perpendicular_parking() -> OccupancyGrid {
    let [length, width] = PARKED_CAR_M;
    let mut sketch = Sketch::solid([24.0, 12.0], RESOLUTION_M);
    sketch.clear(Rect::new(0.3, 1.0, 23.7, 11.5));
    for bay in (0..9).filter(|&bay| bay != 4) {
        let x = 2.4 + 2.4 * f64::from(bay) - 0.5 * width;
        sketch.fill(Rect::sized(x, 1.5, [width, length]));
    }
    sketch.finish()
}

/// Five gates of three poles each, open 0.85 m at the right and left wall in turn.
pub(super) fn slalom_poles() -> OccupancyGrid {
    let mut sketch = Sketch::room([16.0, 2.6], RESOLUTION_M);
    sketch.wall(0.1);
    for gate in 0..5 {
        let x = 2.6 + 2.5 * f64::from(gate);
        let poles = if gate % 2 == 0 {
            [0.95, 1.45, 1.95]
        } else {
            [0.6, 1.1, 1.6]
        };
        for y in poles {
            sketch.fill(Rect::sized(x, y, [RESOLUTION_M; 2]));
        }
    }
    sketch.finish()
}

//! Places where robots and cars work, drawn in meters.

use crate::map::OccupancyGrid;
use crate::map::generate::{self, NeighborhoodParameters};
use crate::map::sketch::{Rect, Sketch};
use crate::numeric::{RandomStream, Seed};

/// A hall of 40 x 25 m: docks at the bottom, staging, racks on the left, packing and an office on
/// the right.
pub(super) fn warehouse() -> OccupancyGrid {
    let mut hall = Sketch::room([40.0, 25.0], 0.05);
    hall.wall(0.3);
    draw_docks(&mut hall);
    draw_racks(&mut hall);
    draw_packing(&mut hall);
    draw_office(&mut hall);
    hall.finish()
}

/// Dock doors as alcoves in a thick wall, and lanes of pallets before them.
fn draw_docks(hall: &mut Sketch) {
    hall.fill(Rect::new(0.0, 0.0, 40.0, 1.6));
    let mut random = Seed(11).stream([0, 0]);
    for dock in 0..6 {
        let x = 4.0 + 6.0 * f64::from(dock);
        hall.clear(Rect::sized(x, 0.5, [2.6, 1.1]));
        for (lane, place) in (0..3).flat_map(|lane| (0..3).map(move |place| (lane, place))) {
            if random.unit() < 0.7 {
                let [dx, dy] = [random.range(-0.08, 0.08), random.range(-0.08, 0.08)];
                let lane_x = x - 2.9 + f64::from(lane) * 1.0;
                hall.fill(Rect::sized(
                    lane_x + dx,
                    2.8 + 1.4 * f64::from(place) + dy,
                    [0.8, 1.2],
                ));
            }
        }
    }
}

/// Two tiers of back-to-back racks; aisles of 1.5 m for robots, then of 2.4 m for forklifts.
fn draw_racks(hall: &mut Sketch) {
    const DOUBLE_RACK_M: f64 = 2.2;
    let tiers = [[9.0, 6.0], [16.8, 5.6]];
    for [y, length] in tiers {
        hall.fill(Rect::sized(0.3, y, [1.1, length]));
    }
    let mut x = 1.4;
    for aisle in [1.5, 1.5, 1.5, 1.5, 2.4, 2.4] {
        x += aisle;
        for [y, length] in tiers {
            // Uprights stand out of the shelves at both ends.
            hall.fill(Rect::sized(x, y, [DOUBLE_RACK_M, length]));
            hall.fill(Rect::sized(x - 0.05, y - 0.1, [0.15, 0.2]));
            hall.fill(Rect::sized(x + DOUBLE_RACK_M - 0.1, y - 0.1, [0.15, 0.2]));
        }
        x += DOUBLE_RACK_M;
    }
}

/// Packing tables along a conveyor, columns, and charging stations at the right wall.
fn draw_packing(hall: &mut Sketch) {
    hall.fill(Rect::new(29.5, 8.8, 38.0, 9.5));
    for table in 0..3 {
        hall.fill(Rect::sized(30.2 + 2.9 * f64::from(table), 11.9, [1.6, 0.8]));
    }
    for charger in 0..3 {
        hall.fill(Rect::sized(
            39.3,
            11.0 + 1.4 * f64::from(charger),
            [0.4, 0.5],
        ));
    }
    for x in [9.3, 19.3, 29.3, 37.3] {
        hall.fill(Rect::sized(x, 7.4, [0.4, 0.4]));
    }
}

/// A room in the upper right corner with a door, desks and a meeting table.
fn draw_office(hall: &mut Sketch) {
    hall.fill(Rect::new(30.0, 16.0, 40.0, 16.2));
    hall.fill(Rect::new(30.0, 16.0, 30.2, 25.0));
    hall.clear(Rect::new(30.0, 17.2, 30.2, 18.6));
    hall.fill(Rect::new(35.0, 20.0, 35.15, 25.0));
    for desk in 0..3 {
        hall.fill(Rect::sized(38.0, 17.0 + 2.4 * f64::from(desk), [1.6, 0.8]));
    }
    hall.fill(Rect::new(31.6, 21.6, 33.6, 23.0));
}

/// Bays of 2.5 x 5.0 m in a bottom row, a double row and a top row, with aisles of 6.0 m.
pub(super) fn parking_lot() -> OccupancyGrid {
    let mut lot = Sketch::room([60.0, 34.0], 0.1);
    lot.wall(1.0);
    let mut random = Seed(5).stream([0, 0]);
    // Bottom of the row, and the bays that stay free for the requests.
    for (y, free) in [(1.0, 8), (12.0, 3), (17.0, 11), (28.0, 3)] {
        for bay in (0..17).filter(|&bay| bay != free) {
            if random.unit() < 0.85 {
                lot.fill(parked_car(8.5 + 2.5 * f64::from(bay), y, &mut random));
            }
        }
    }
    draw_islands(&mut lot);
    lot.finish()
}

/// A car somewhere in a bay of 2.5 x 5.0 m whose lower left corner is given.
fn parked_car(x: f64, y: f64, random: &mut RandomStream) -> Rect {
    let size = [random.range(1.65, 1.9), random.range(4.0, 4.8)];
    let middle = [
        x + 1.25 + random.range(-0.15, 0.15),
        y + 2.5 + random.range(-0.1, 0.1),
    ];
    Rect::sized(middle[0] - 0.5 * size[0], middle[1] - 0.5 * size[1], size)
}

/// Curbed islands with lamps at the ends of the rows, trees between the back-to-back bays.
fn draw_islands(lot: &mut Sketch) {
    for x in [7.1, 51.2] {
        for [y, height] in [[1.0, 4.6], [12.4, 9.2], [28.4, 4.6]] {
            lot.fill(Rect::sized(x, y, [1.2, height]));
        }
    }
    for tree in 0..5 {
        lot.fill(Rect::sized(13.3 + 7.5 * f64::from(tree), 16.8, [0.4, 0.4]));
    }
}

/// The generator's neighborhood with its default parameters.
pub(super) fn neighborhood() -> OccupancyGrid {
    generate::alley_neighborhood(&NeighborhoodParameters::default(), Seed(6))
        .expect("the default parameters are in range")
}

/// Another of the generator's neighborhoods with its default parameters.
pub(super) fn li_neighborhood() -> OccupancyGrid {
    generate::alley_neighborhood(&NeighborhoodParameters::default(), Seed(15))
        .expect("the default parameters are in range")
}

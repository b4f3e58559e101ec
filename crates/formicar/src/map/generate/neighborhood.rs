//! Neighborhoods of alleys: streets, blocks of houses, dead ends, yards and parked cars.

use super::super::sketch::{Rect, Sketch, frame_at_origin};
use super::super::{FREE, OCCUPIED, OccupancyGrid};
use super::main_component::seal_all_but_main;
use super::{GenerateError, NeighborhoodParameters};
use crate::numeric::{RandomStream, Seed};

/// Least width and height of a neighborhood, metres.
const MIN_SIDE_M: f64 = 20.0;
/// Room that a car parked along a street takes off its width, metres.
const PARKING_LANE_M: f64 = 2.0;
/// Width that stays free beside parked cars, metres.
const DRIVING_LANE_M: f64 = 3.0;
/// Least side of a block that can hold a yard, metres.
const MIN_YARD_BLOCK_M: f64 = 15.0;

/// A neighborhood: streets cut the ground into areas, alleys cut these into blocks of houses; some
/// alleys end blind, some blocks have a yard behind a gateway, cars stand along the streets, and
/// house fronts stand back by up to 0.6 m. All free cells are connected.
///
/// # Errors
/// Parameters out of range, less than 20 m of width or height, or more cells than a map may have.
pub fn alley_neighborhood(
    parameters: &NeighborhoodParameters,
    seed: Seed,
) -> Result<OccupancyGrid, GenerateError> {
    parameters.check()?;
    let frame = frame_at_origin(
        parameters.n_cols,
        parameters.n_rows,
        parameters.resolution_m,
    )?;
    let size = frame.extent_m();
    if size.x.min(size.y) < MIN_SIDE_M {
        return Err(GenerateError::TooSmall {
            width_m: size.x,
            height_m: size.y,
            min_m: MIN_SIDE_M,
        });
    }
    let mut town = Town {
        parameters,
        sketch: Sketch::new(frame, OCCUPIED),
        random: seed.stream([0, 0]),
        streets: Vec::new(),
        blocks: Vec::new(),
    };
    town.split(Rect::new(0.0, 0.0, size.x, size.y));
    town.build_blocks();
    town.park_cars();
    town.set_back_fronts();
    let mut map = town.sketch.finish();
    seal_all_but_main(&mut map);
    Ok(map)
}

struct Town<'a> {
    parameters: &'a NeighborhoodParameters,
    sketch: Sketch,
    random: RandomStream,
    streets: Vec<Rect>,
    blocks: Vec<Rect>,
}

impl Town<'_> {
    /// Cuts an area across its longer side until blocks are left.
    fn split(&mut self, area: Rect) {
        let p = self.parameters;
        let length = area.width().max(area.height());
        let is_whole = self.streets.is_empty();
        if is_whole || length > p.street_spacing_m {
            let width = p.street_width_m * self.random.range(0.8, 1.2);
            let [low, street, high] = self.cut(area, width);
            self.sketch.clear(street);
            self.streets.push(street);
            self.split(low);
            self.split(high);
        } else if length > p.block_m {
            let width = self.random.range(p.min_alley_width_m, p.max_alley_width_m);
            let [low, alley, high] = self.cut(area, width);
            let is_last = low.width().max(low.height()) <= p.block_m
                && high.width().max(high.height()) <= p.block_m;
            let alley = if is_last && self.random.unit() < p.dead_end_share {
                self.dead_end(alley)
            } else {
                alley
            };
            self.sketch.clear(alley);
            self.split(low);
            self.split(high);
        } else {
            self.blocks.push(area);
        }
    }

    /// Two parts of an area and the way of `width` metres between them.
    fn cut(&mut self, area: Rect, width: f64) -> [Rect; 3] {
        let share = self.random.range(0.36, 0.64);
        let along_x = |r: Rect| {
            let at = r.x0 + share * (r.width() - width);
            [
                Rect { x1: at, ..r },
                Rect {
                    x0: at,
                    x1: at + width,
                    ..r
                },
                Rect {
                    x0: at + width,
                    ..r
                },
            ]
        };
        if area.width() >= area.height() {
            along_x(area)
        } else {
            along_x(area.transposed()).map(Rect::transposed)
        }
    }

    /// An alley that stops after half to three quarters of its way from one end.
    fn dead_end(&mut self, alley: Rect) -> Rect {
        let share = self.random.range(0.5, 0.75);
        let from_low_end = self.random.unit() < 0.5;
        let shorten = |r: Rect| {
            let length = share * r.height();
            if from_low_end {
                Rect {
                    y1: r.y0 + length,
                    ..r
                }
            } else {
                Rect {
                    y0: r.y1 - length,
                    ..r
                }
            }
        };
        if alley.height() >= alley.width() {
            shorten(alley)
        } else {
            shorten(alley.transposed()).transposed()
        }
    }

    /// Gives each block a yard, a nook, a passage, or nothing but houses.
    fn build_blocks(&mut self) {
        for i in 0..self.blocks.len() {
            let block = self.blocks[i];
            let is_large = block.width().min(block.height()) >= MIN_YARD_BLOCK_M;
            if is_large && self.random.unit() < self.parameters.yard_share {
                self.lay_out_yard(block);
                continue;
            }
            match self.random.below(3) {
                0 => self.cut_nook(block),
                1 => self.cut_passage(block),
                _ => {}
            }
        }
    }

    /// A yard behind houses of 4.6 to 6 m depth, with a gateway, a shed and trees.
    fn lay_out_yard(&mut self, block: Rect) {
        let yard = block.inset(self.random.range(4.6, 6.0));
        self.sketch.clear(yard);
        let width = self.random.range(2.6, 3.4);
        let gateway = self.across_one_side(block, yard, width);
        self.sketch.clear(gateway);
        let shed = [self.random.range(1.5, 2.5), self.random.range(1.5, 2.0)];
        if yard.width().min(yard.height()) > 6.0 {
            self.sketch.fill(Rect::sized(yard.x0, yard.y0, shed));
        }
        for _ in 0..self.random.below(4) {
            let x = self.random.range(yard.x0, yard.x1);
            let y = self.random.range(yard.y0, yard.y1);
            self.sketch.fill(Rect::sized(x, y, [0.4, 0.4]));
        }
    }

    /// A way of `width` metres from a random side of a block to the yard inside.
    fn across_one_side(&mut self, block: Rect, yard: Rect, width: f64) -> Rect {
        let along_x = self.random.unit() < 0.5;
        let (outer, inner) = if along_x {
            (block, yard)
        } else {
            (block.transposed(), yard.transposed())
        };
        let y = self.random.range(inner.y0, inner.y1 - width);
        let low_side = self.random.unit() < 0.5;
        let (x0, x1) = if low_side {
            (outer.x0, inner.x0)
        } else {
            (inner.x1, outer.x1)
        };
        let way = Rect::new(x0, y, x1, y + width);
        if along_x { way } else { way.transposed() }
    }

    /// A place beside the way, 2.6 m deep and 6 to 9 m long, where a car may stand.
    fn cut_nook(&mut self, block: Rect) {
        let depth = 2.6_f64.min(0.3 * block.width().min(block.height()));
        let length = self.random.range(6.0, 9.0);
        let inner = block.inset(depth);
        if inner.width().min(inner.height()) < length {
            return;
        }
        let nook = self.across_one_side(block, inner, length);
        self.sketch.clear(nook);
        if depth > 2.0 && self.random.unit() < self.parameters.parked_car_share {
            let middle = [0.5 * (nook.x0 + nook.x1), 0.5 * (nook.y0 + nook.y1)];
            let car = if nook.width() > nook.height() {
                [4.4, 1.7]
            } else {
                [1.7, 4.4]
            };
            let (x, y) = (middle[0] - 0.5 * car[0], middle[1] - 0.5 * car[1]);
            self.sketch.fill(Rect::sized(x, y, car));
        }
    }

    /// A footpath of 1.2 to 1.6 m between houses, through the whole block.
    fn cut_passage(&mut self, block: Rect) {
        let width = self.random.range(1.2, 1.6);
        let [_, passage, _] = self.cut(block, width);
        self.sketch.clear(passage);
    }

    /// Cars along one side of each street, along both where it is wide enough.
    fn park_cars(&mut self) {
        for i in 0..self.streets.len() {
            let street = self.streets[i];
            let is_vertical = street.height() >= street.width();
            let along_y = if is_vertical {
                street
            } else {
                street.transposed()
            };
            let room = along_y.width() - DRIVING_LANE_M;
            let low_first = self.random.unit() < 0.5;
            let sides = [low_first, !low_first];
            let n_sides = (room / PARKING_LANE_M).max(0.0) as usize;
            for &is_low in sides.iter().take(n_sides) {
                self.park_along(along_y, [is_low, is_vertical]);
            }
        }
    }

    /// Cars along one side of a street that runs along y (before it is transposed back).
    fn park_along(&mut self, street: Rect, [is_low, is_vertical]: [bool; 2]) {
        let back = |r: Rect| if is_vertical { r } else { r.transposed() };
        let mut y = street.y0 + self.random.range(3.0, 8.0);
        while y + 5.0 < street.y1 {
            let car = [self.random.range(1.7, 1.85), self.random.range(4.1, 4.8)];
            let curb = self.random.range(0.1, 0.15);
            let (x, front_x) = if is_low {
                (street.x0 + curb, street.x0 - 0.5)
            } else {
                (street.x1 - curb - car[0], street.x1 + 0.1)
            };
            let place = Rect::sized(x, y, car);
            // Cars keep 2 m off every mouth: the wall behind them must go on that far.
            let wall = Rect::new(front_x, y - 2.0, front_x + 0.4, y + car[1] + 2.0);
            let is_taken = self.random.unit() < self.parameters.parked_car_share;
            let is_open = self.sketch.is_all(back(place), FREE);
            if is_taken && is_open && self.sketch.is_all(back(wall), OCCUPIED) {
                self.sketch.fill(back(place));
            }
            y += car[1] + self.random.range(0.7, 1.4);
        }
    }

    /// Breaks the fronts of blocks into houses that stand back by different amounts.
    fn set_back_fronts(&mut self) {
        for i in 0..self.blocks.len() {
            let block = self.blocks[i];
            for side in 0..4 {
                let is_vertical = side < 2;
                let along_y = if is_vertical {
                    block
                } else {
                    block.transposed()
                };
                self.set_back_side(along_y, [side % 2 == 0, is_vertical]);
            }
        }
    }

    fn set_back_side(&mut self, block: Rect, [is_low, is_vertical]: [bool; 2]) {
        let mut y = block.y0;
        while y < block.y1 {
            let house = self.random.range(5.0, 10.0);
            let depth = self.random.range(-0.4, 0.6).max(0.0);
            let (x0, x1) = if is_low {
                (block.x0, block.x0 + depth)
            } else {
                (block.x1 - depth, block.x1)
            };
            let strip = Rect::new(x0, y, x1, (y + house).min(block.y1));
            if depth > 0.0 {
                let strip = if is_vertical {
                    strip
                } else {
                    strip.transposed()
                };
                self.sketch.clear(strip);
            }
            y += house;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::main_component::main_component;
    use super::*;

    #[test]
    fn same_seed_same_map_all_connected() {
        let parameters = NeighborhoodParameters::default();
        let map = alley_neighborhood(&parameters, Seed(1)).unwrap();
        assert_eq!(map, alley_neighborhood(&parameters, Seed(1)).unwrap());
        assert_ne!(map, alley_neighborhood(&parameters, Seed(2)).unwrap());
        let n_free = 400_000 - map.lethal_cells().count();
        assert_eq!(main_component(&map).count(), n_free);
        let share = n_free as f64 / 400_000.0;
        assert!((0.25..0.5).contains(&share), "{share}");
    }

    #[test]
    fn any_size_and_parameters_in_range_give_a_map() {
        let extremes = NeighborhoodParameters {
            n_cols: 100,
            n_rows: 100,
            street_width_m: 20.0,
            street_spacing_m: 30.0,
            min_alley_width_m: 6.0,
            max_alley_width_m: 6.0,
            block_m: 16.0,
            ..NeighborhoodParameters::default()
        };
        for (n_cols, n_rows) in [(100, 100), (101, 437), (2000, 100), (513, 511)] {
            let parameters = NeighborhoodParameters {
                n_cols,
                n_rows,
                ..extremes.clone()
            };
            let map = alley_neighborhood(&parameters, Seed(3)).unwrap();
            assert!(map.lethal_cells().count() < n_cols * n_rows);
        }
    }

    #[test]
    fn refuses_bad_parameters() {
        let with = |change: fn(&mut NeighborhoodParameters)| {
            let mut parameters = NeighborhoodParameters::default();
            change(&mut parameters);
            alley_neighborhood(&parameters, Seed(0)).map_err(|e| e.to_string())
        };
        let error = with(|p| p.street_width_m = 3.0).unwrap_err();
        assert_eq!(error, "street_width_m = 3; it must be from 4 to 20");
        assert!(with(|p| p.yard_share = f64::NAN).is_err());
        assert!(with(|p| p.min_alley_width_m = 4.5).is_err());
        assert!(with(|p| p.n_cols = 50).is_err());
        assert!(with(|p| p.n_cols = usize::MAX).is_err());
    }
}

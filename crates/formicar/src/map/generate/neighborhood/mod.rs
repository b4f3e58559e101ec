//! Neighborhoods of alleys: streets, blocks of houses, dead ends, yards and parked cars.

mod blocks;
mod cars;

use super::main_component::seal_all_but_main;
use super::{GenerateError, NeighborhoodParameters};
use crate::map::sketch::{Rect, Sketch, frame_at_origin};
use crate::map::{OCCUPIED, OccupancyGrid};
use crate::numeric::{RandomStream, Seed};

/// Least width and height of a neighborhood, meters.
const MIN_SIDE_M: f64 = 20.0;

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
    parameters.check_alleys()?;
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

/// A side of a rectangle, by the coordinate across its way.
#[derive(Clone, Copy)]
enum Side {
    Low,
    High,
}

/// The axis that a way or a house front runs along.
#[derive(Clone, Copy)]
enum Axis {
    X,
    Y,
}

impl Axis {
    /// The axis of the longer side.
    fn along(rect: Rect) -> Self {
        if rect.height() >= rect.width() {
            Self::Y
        } else {
            Self::X
        }
    }

    /// A rectangle turned so that this axis becomes y; the same turn leads back.
    fn turned(self, rect: Rect) -> Rect {
        match self {
            Self::X => rect.transposed(),
            Self::Y => rect,
        }
    }
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

    /// Two parts of an area and the way of `width` meters between them.
    fn cut(&mut self, area: Rect, width: f64) -> [Rect; 3] {
        let share = self.random.range(0.36, 0.64);
        let axis = Axis::along(area);
        let r = axis.turned(area);
        let y0 = r.y0 + share * (r.height() - width);
        let y1 = y0 + width;
        [
            Rect { y1: y0, ..r },
            Rect { y0, y1, ..r },
            Rect { y0: y1, ..r },
        ]
        .map(|part| axis.turned(part))
    }

    /// An alley that stops after half to three quarters of its way from one end.
    fn dead_end(&mut self, alley: Rect) -> Rect {
        let share = self.random.range(0.5, 0.75);
        let axis = Axis::along(alley);
        let r = axis.turned(alley);
        let length = share * r.height();
        axis.turned(match self.side() {
            Side::Low => Rect {
                y1: r.y0 + length,
                ..r
            },
            Side::High => Rect {
                y0: r.y1 - length,
                ..r
            },
        })
    }

    /// A side at random.
    fn side(&mut self) -> Side {
        if self.random.unit() < 0.5 {
            Side::Low
        } else {
            Side::High
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::generate::main_component::main_component;

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
        assert_eq!(error, "street_width_m = 3; it must be in 4 to 20");
        assert!(with(|p| p.yard_share = f64::NAN).is_err());
        assert!(with(|p| p.min_alley_width_m = 4.5).is_err());
        assert!(with(|p| p.n_cols = 50).is_err());
        assert!(with(|p| p.n_cols = usize::MAX).is_err());
    }
}

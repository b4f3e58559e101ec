//! The cells that a vehicle's body sweeps on its motion primitives, as masks of bits.

use super::bit_mask::{ROUNDING, RowSpans};
use crate::geometry::{ConvexPolygon, Point2, Pose2};
use crate::map::PaddedGrid;
use crate::numeric::integer_below;
use crate::vehicle::{Primitive, PrimitiveSet, Vehicle};
use std::sync::OnceLock;

/// Positions inside a cell that are distinguished, along each axis.
const SUB_CELLS: usize = 4;
/// Turns longer than this are swept in pieces, radians. A piece leaves the convex hull of its ends
/// by a thousandth of the corner's radius at most; the hull stands out of the piece, where it fills
/// the notch between two poses, by a quarter of this times the body's diameter at most.
const PIECE_RAD: f64 = std::f64::consts::PI / 36.0;

/// Masks of the cells that a body may touch on each motion primitive from each heading of a
/// lattice, for sixteen places of the rear axle inside its cell.
///
/// If a mask is clear, the motion is free from every position in that sixteenth of a cell. The
/// reverse does not hold: masks are too large by up to a quarter of a cell each way, and by the
/// excess of the hulls of their pieces. Sampling poses along an arc instead would miss the area
/// that the swinging front corner sweeps between them. The masks of a motion are made when they
/// are first asked for. Width and number of rows are not limited.
#[derive(Clone, Debug)]
pub struct DriveMasks {
    lattice: PrimitiveSet,
    /// Corners of the body's convex parts around the rear axle, in meters.
    parts: Vec<Vec<Point2>>,
    resolution_m: f64,
    /// Heading after heading, primitive after primitive.
    by_motion: Vec<OnceLock<Box<MotionMasks>>>,
}

/// The masks of a primitive from one heading, for all places in a cell.
#[derive(Clone, Debug)]
struct MotionMasks {
    masks: [Mask; SUB_CELLS * SUB_CELLS],
    /// The words of all masks, one after the other, so that they lie close together.
    words: Vec<u64>,
}

/// A mask whose words are a range of those of its motion.
#[derive(Clone, Copy, Debug, Default)]
struct Mask {
    low: (i32, i32),
    words_per_row: u32,
    first: u32,
    end: u32,
}

impl DriveMasks {
    /// Masks of a vehicle's body on the motions of a lattice, on cells of a size.
    pub fn new(vehicle: &Vehicle, lattice: PrimitiveSet, resolution_m: f64) -> Self {
        Self {
            parts: (vehicle.parts().iter())
                .map(|part| part.corners().to_vec())
                .collect(),
            by_motion: vec![OnceLock::new(); lattice.n_headings() * lattice.primitives().len()],
            lattice,
            resolution_m,
        }
    }

    /// The motions and headings.
    pub fn lattice(&self) -> &PrimitiveSet {
        &self.lattice
    }

    /// Farthest that a mask reaches from its cell, in cells.
    pub fn reach_cells(&self) -> usize {
        let corners = self.parts.iter().flatten();
        let body = corners.fold(0.0, |r, p| p.norm().max(r));
        let primitives = self.lattice.primitives().iter();
        let step = primitives.fold(0.0, |r, p| p.length_m.max(r));
        ((body + step) / self.resolution_m).ceil() as usize + 3
    }

    /// Whether the body stays clear of obstacles on a motion from a position on the map, meters in
    /// the map's frame, and a heading of the lattice.
    ///
    /// `obstacles` must be padded by [`Self::reach_cells`].
    #[inline]
    pub fn is_clear(
        &self,
        obstacles: &PaddedGrid,
        position: Point2,
        heading_index: usize,
        primitive: usize,
    ) -> bool {
        let (x, y) = (
            position.x / self.resolution_m,
            position.y / self.resolution_m,
        );
        let (col, row) = (integer_below(x), integer_below(y));
        let sub = |fraction: f64| ((fraction * SUB_CELLS as f64) as usize).min(SUB_CELLS - 1);
        let place = sub(y - row as f64) * SUB_CELLS + sub(x - col as f64);
        let of_motion = self.of_motion(heading_index, primitive);
        let mask = &of_motion.masks[place];
        let corner = (col + i64::from(mask.low.0), row + i64::from(mask.low.1));
        let words = &of_motion.words[mask.first as usize..mask.end as usize];
        obstacles.is_clear(corner, words, mask.words_per_row as usize)
    }

    fn of_motion(&self, heading_index: usize, primitive: usize) -> &MotionMasks {
        let primitives = self.lattice.primitives();
        self.by_motion[heading_index * primitives.len() + primitive].get_or_init(|| {
            let heading_rad = self.lattice.heading_rad(heading_index);
            Box::new(MotionMasks::of(
                &self.swept(&primitives[primitive], heading_rad),
            ))
        })
    }

    /// The region that the body sweeps from the origin, in cells.
    fn swept(&self, primitive: &Primitive, heading_rad: f64) -> Swept {
        let start = Pose2::new(0.0, 0.0, heading_rad);
        let arc = primitive.arc();
        let turn = (primitive.curvature_per_m * primitive.length_m).abs();
        let n_pieces = (turn / PIECE_RAD - ROUNDING).ceil().max(1.0);
        let farthest = if primitive.curvature_per_m == 0.0 {
            0.0
        } else {
            let center = Point2::new(0.0, 1.0 / primitive.curvature_per_m);
            let corners = self.parts.iter().flatten();
            corners.fold(0.0, |r, p| p.distance(center).max(r))
        };
        let scale = 1.0 / self.resolution_m;
        let pose_after = |piece: usize| {
            let driven = piece as f64 / n_pieces;
            start.advance(arc.curvature_per_m, arc.signed_length_m * driven)
        };
        let hull = |part: &[Point2], piece: usize| {
            let ends = [piece, piece + 1].map(pose_after);
            let corners = ends
                .iter()
                .flat_map(|pose| part.iter().map(|&p| pose.transform(p) * scale));
            let corners: Vec<_> = corners.collect();
            ConvexPolygon::hull(&corners).expect("a moved body has an area")
        };
        let pieces = 0..n_pieces as usize;
        Swept {
            hulls: (self.parts.iter())
                .flat_map(|part| pieces.clone().map(|piece| hull(part, piece)))
                .collect(),
            // A corner runs on a circle: between two places it leaves their chord by the sagitta.
            sagitta: scale * farthest * (1.0 - (0.5 * turn / n_pieces).cos()),
        }
    }
}

/// Convex pieces, and the distance by which the swept region may exceed them; in cells.
struct Swept {
    hulls: Vec<ConvexPolygon>,
    sagitta: f64,
}

impl MotionMasks {
    /// The masks of what is swept from places in the cell (0, 0), corner at the origin.
    fn of(swept: &Swept) -> Self {
        // The least distance of a free cell: a place stands for a square of positions.
        let reach = 0.5 / SUB_CELLS as f64 + swept.sagitta + ROUNDING;
        let middle = |i: usize| (i as f64 + 0.5) / SUB_CELLS as f64;
        let mut masks = [Mask::default(); SUB_CELLS * SUB_CELLS];
        let mut words = Vec::new();
        for (i, masks) in masks.chunks_exact_mut(SUB_CELLS).enumerate() {
            let spans = RowSpans::of(&swept.hulls, middle(i), reach);
            for (j, mask) in masks.iter_mut().enumerate() {
                let cols = spans.cols(middle(j));
                let first = words.len() as u32;
                spans.add_bits(middle(j), &mut words);
                *mask = Mask {
                    low: (*cols.start(), spans.first_row),
                    words_per_row: cols.count().div_ceil(64) as u32,
                    first,
                    end: words.len() as u32,
                };
            }
        }
        words.shrink_to_fit();
        Self { masks, words }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::{Body, Drive, ObstacleMap};
    use crate::map::{Cell, OccupancyGrid};
    use crate::vehicle::Gears;
    use proptest::prelude::*;

    fn masks(vehicle: &Vehicle, resolution_m: f64) -> DriveMasks {
        let step_m = (0.25 * vehicle.min_turning_radius_m()).max(1.5 * resolution_m);
        let lattice = PrimitiveSet::new(vehicle, 72, step_m, Gears::Both).unwrap();
        DriveMasks::new(vehicle, lattice, resolution_m)
    }

    /// Two arms and their back, with room for a cell between the arms.
    fn fork() -> Vehicle {
        let parts = "[[[-0.2, 0.9], [2.2, 0.9], [2.2, 1.2], [-0.2, 1.2]], [[-0.2, -1.2], [2.2, -1.2], [2.2, -0.9], [-0.2, -0.9]], [[-0.5, -1.2], [-0.2, -1.2], [-0.2, 1.2], [-0.5, 1.2]]]";
        let json = format!(r#"{{"parts": {parts}, "min_turning_radius_m": 2.4}}"#);
        Vehicle::new(serde_json::from_str(&json).unwrap()).unwrap()
    }

    #[test]
    fn a_cell_between_the_arms_of_a_fork_leaves_its_mask_clear() {
        let masks = masks(&fork(), 0.2);
        let mut cells = crate::map::BitGrid::new(60, 60);
        cells.insert(Cell::new(35, 30));
        let at = Point2::new(6.1, 6.1);
        let padded = PaddedGrid::new(&cells, masks.reach_cells());
        // Straight back: the arms pass the cell on both sides.
        let back = masks.lattice().primitives().iter().position(|primitive| {
            primitive.curvature_per_m == 0.0 && primitive.arc().signed_length_m < 0.0
        });
        assert!(masks.is_clear(&padded, at, 0, back.unwrap()));
        cells.insert(Cell::new(35, 35));
        let padded = PaddedGrid::new(&cells, masks.reach_cells());
        assert!(!masks.is_clear(&padded, at, 0, back.unwrap()));
    }

    proptest! {
        #[test]
        fn a_clear_mask_means_a_free_motion(
            obstacles in prop::collection::vec((0_u32..90, 0_u32..60), 0..25),
            place in (0.0..90.0, 0.0..60.0),
            heading in 0_usize..72,
            primitive in 0_usize..10,
            size in 0_usize..3,
            is_fork in any::<bool>(),
        ) {
            let resolution_m = [0.1, 0.2, 0.7][size];
            let mut map = OccupancyGrid::from_rows(&[&".".repeat(90)[..]; 60], resolution_m).unwrap();
            for (col, row) in obstacles {
                map.set(Cell::new(col, row), crate::map::OCCUPIED);
            }
            let map = ObstacleMap::new(&map);
            let vehicle = if is_fork { fork() } else { Vehicle::lei2020() };
            let masks = masks(&vehicle, resolution_m);
            let padded = PaddedGrid::new(map.lethal(), masks.reach_cells());
            let position = Point2::new(place.0, place.1) * resolution_m;
            let arc = masks.lattice().primitives()[primitive].arc();
            let drive = Drive {
                start: Pose2::at(position, masks.lattice().heading_rad(heading)),
                curvature_per_m: arc.curvature_per_m,
                signed_length_m: arc.signed_length_m,
            };
            let is_clear = masks.is_clear(&padded, position, heading, primitive);
            prop_assert!(!is_clear || map.is_free(&Body::new(&vehicle), &drive));
            // A quarter of a cell along each axis; a point of a hull lies between one of the body
            // at its piece's beginning and one at its end; and sagittas.
            let (low, high) = vehicle.footprint().bounds();
            let hulls_m = 0.25 * PIECE_RAD * low.distance(high) + 0.01;
            let margin_m = 0.25 * std::f64::consts::SQRT_2 * resolution_m + hulls_m;
            let wider = Body::new(&vehicle.with_safety_margin(margin_m).unwrap());
            prop_assert!(is_clear || !map.is_free(&wider, &drive));
        }
    }

    #[test]
    fn masks_wider_than_a_word_are_read_across_words() {
        let vehicle = Vehicle::sedan();
        let masks = masks(&vehicle, 0.05);
        let clear = crate::map::BitGrid::new(400, 300);
        let middle = Point2::new(10.0, 7.5);
        let is_clear = |cells: &crate::map::BitGrid| {
            masks.is_clear(&PaddedGrid::new(cells, masks.reach_cells()), middle, 0, 0)
        };
        assert!(is_clear(&clear));
        // From the rear bumper to the front one after a step of a quarter radius.
        let step_m = masks.lattice().primitives()[0].length_m;
        let (rear, front) = (10.0 - 1.0, 10.0 + 2.8 + 0.9 + step_m);
        for (x, expected) in [
            (rear - 0.1, true),
            (rear + 0.1, false),
            (front - 0.1, false),
            (front + 0.1, true),
        ] {
            let mut cells = clear.clone();
            cells.insert(Cell::new((x / 0.05) as u32, 150));
            assert_eq!(is_clear(&cells), expected, "{x}");
        }
    }
}

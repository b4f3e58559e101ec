//! Cars parked along streets.

use super::{Axis, Rect, Side, Town};
use crate::map::{FREE, OCCUPIED};

/// Room that a car parked along a street takes off its width, meters.
const PARKING_LANE_M: f64 = 2.0;
/// Width that stays free beside parked cars, meters.
const DRIVING_LANE_M: f64 = 3.0;
impl Town<'_> {
    /// Cars along one side of each street, along both where it is wide enough.
    pub(super) fn park_cars(&mut self) {
        for i in 0..self.streets.len() {
            let axis = Axis::along(self.streets[i]);
            let street = axis.turned(self.streets[i]);
            let sides = match self.side() {
                Side::Low => [Side::Low, Side::High],
                Side::High => [Side::High, Side::Low],
            };
            let room = street.width() - DRIVING_LANE_M;
            let n_sides = (room / PARKING_LANE_M).max(0.0) as usize;
            for &side in sides.iter().take(n_sides) {
                self.park_along(street, axis, side);
            }
        }
    }

    /// Cars along one side of a street that has been turned to y.
    fn park_along(&mut self, street: Rect, axis: Axis, side: Side) {
        let mut y = street.y0 + self.random.range(3.0, 8.0);
        while y + 5.0 < street.y1 {
            let car = [self.random.range(1.7, 1.85), self.random.range(4.1, 4.8)];
            let curb = self.random.range(0.1, 0.15);
            let (x, wall_x) = match side {
                Side::Low => (street.x0 + curb, street.x0 - 0.5),
                Side::High => (street.x1 - curb - car[0], street.x1 + 0.1),
            };
            let place = axis.turned(Rect::sized(x, y, car));
            // Cars keep 2 m off every mouth: the wall behind them must go on that far.
            let wall = axis.turned(Rect::sized(wall_x, y - 2.0, [0.4, car[1] + 4.0]));
            let is_taken = self.random.unit() < self.parameters.parked_car_share;
            let is_place = self.sketch.is_all(place, FREE) && self.sketch.is_all(wall, OCCUPIED);
            if is_taken && is_place {
                self.sketch.fill(place);
            }
            y += car[1] + self.random.range(0.7, 1.4);
        }
    }
}

//! The cost of driving a chain of arcs, for one vehicle: in meters.

use crate::geometry::Arc;

/// A [`DriveCost`](super::DriveCost) for one vehicle, in meters of straight forward driving on
/// open ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VehicleCost {
    /// The least turning radius R, meters.
    pub radius_m: f64,
    /// Factor on the length driven in reverse.
    pub reverse_factor: f64,
    /// The same factor beyond the first stretch in reverse.
    pub long_reverse_factor: f64,
    /// Length of that stretch, meters.
    pub long_reverse_from_m: f64,
    /// Cost of a change of gear, meters.
    pub gear_switch_m: f64,
    /// Cost of a jump of curvature from straight to the tightest turn, in turning radii.
    pub curvature_change_weight: f64,
    /// Added to the factor on the length driven in the tightest turn.
    pub bend_weight: f64,
    /// Added to the factor on the length driven at contact.
    pub clearance_weight: f64,
    /// The wish: clearance from which on obstacles no longer count, meters.
    pub clearance_wish_m: f64,
    /// The share of the cost on open ground that a least clearance of half the wish adds; it
    /// grows with the square of the number of halvings.
    pub least_clearance_share: f64,
    /// What a least clearance of half the wish adds besides, meters.
    pub least_clearance_m: f64,
    /// Factor on the length driven with the wheels turned: a term of searches over motions.
    pub turn_factor: f64,
    /// Added to that factor on an arc that steers the other way than the motion before.
    pub swing_factor: f64,
}

/// Least clearances below this share of the wish are not told apart: those of a vehicle that
/// starts in contact are all the same.
const LEAST_SHARE_OF_WISH: f64 = 1.0 / 64.0;

impl VehicleCost {
    /// The factor on a length driven in the gear of a sign.
    pub fn gear_factor(&self, sign: f64) -> f64 {
        if sign < 0.0 { self.reverse_factor } else { 1.0 }
    }

    /// The cost of the change between the gears of two signs, meters; 0 stands for neither gear.
    pub fn gear_change_m(&self, before: f64, after: f64) -> f64 {
        if before * after < 0.0 {
            self.gear_switch_m
        } else {
            0.0
        }
    }

    /// The cost of a meter of an arc on open ground.
    pub fn rate(&self, arc: Arc) -> f64 {
        self.rate_after(arc, arc)
    }

    /// The same where the motion before the arc counts.
    pub fn rate_after(&self, before: Arc, arc: Arc) -> f64 {
        let turn = if arc.curvature_per_m == 0.0 {
            1.0
        } else {
            self.turn_factor
        };
        let swing = if before.curvature_per_m * arc.curvature_per_m < 0.0 {
            self.swing_factor
        } else {
            0.0
        };
        let bend = arc.curvature_per_m * self.radius_m;
        self.gear_factor(arc.signed_length_m) * (turn + swing) + self.bend_weight * bend * bend
    }

    /// The cost of an arc on open ground.
    pub fn open_ground_m(&self, arc: Arc) -> f64 {
        arc.length_m() * self.rate(arc)
    }

    /// The cost of arcs one after the other on open ground.
    pub fn open_path_m(&self, arcs: &[Arc]) -> f64 {
        let ground = arcs.iter().map(|&arc| self.open_ground_m(arc));
        let joints = arcs.windows(2).map(|w| self.joint_m(w[0], w[1]));
        let reversed_m = arcs.iter().map(|&arc| Self::reversed_m(arc)).sum();
        ground.sum::<f64>() + joints.sum::<f64>() + self.long_reverse_m(reversed_m)
    }

    /// The length of an arc where it is driven in reverse, otherwise 0.
    pub fn reversed_m(arc: Arc) -> f64 {
        (-arc.signed_length_m).max(0.0)
    }

    /// What a length driven in reverse adds to the cost of a path beyond the factor on each meter.
    pub fn long_reverse_m(&self, reversed_m: f64) -> f64 {
        let more = (self.long_reverse_factor - self.reverse_factor).max(0.0);
        more * (reversed_m - self.long_reverse_from_m).max(0.0)
    }

    /// The cost of going over from an arc to the next.
    pub fn joint_m(&self, before: Arc, after: Arc) -> f64 {
        if before.signed_length_m * after.signed_length_m < 0.0 {
            return self.gear_switch_m;
        }
        let jump = (after.curvature_per_m - before.curvature_per_m).abs();
        // w R |jump|, in turning radii: R once more makes meters of it.
        self.curvature_change_weight * self.radius_m * (self.radius_m * jump)
    }

    /// n(c): the surcharge on a meter at a clearance. It goes on growing where estimates of the
    /// clearance are below 0.
    pub fn nearness(&self, clearance_m: f64) -> f64 {
        if clearance_m >= self.clearance_wish_m || self.clearance_wish_m == 0.0 {
            return 0.0;
        }
        let lack = 1.0 - clearance_m / self.clearance_wish_m;
        self.clearance_weight * lack * lack
    }

    /// What the least clearance of a path adds to its cost, given that on open ground.
    pub fn least_clearance_price_m(&self, open_path_m: f64, least_clearance_m: f64) -> f64 {
        let halvings = self.halvings(least_clearance_m);
        self.first_halving_m(open_path_m) * halvings * halvings
    }

    /// The price of a least clearance of half the wish, meters.
    fn first_halving_m(&self, open_path_m: f64) -> f64 {
        self.least_clearance_share * open_path_m + self.least_clearance_m
    }

    /// The least clearance at which its price is that much, meters: at less it is dearer. Below 0
    /// where no clearance costs that much.
    pub fn least_clearance_for_m(&self, open_path_m: f64, price_m: f64) -> f64 {
        let halvings = (price_m / self.first_halving_m(open_path_m))
            .max(0.0)
            .sqrt();
        if !self.counts_least_clearance() || halvings >= self.halvings(0.0) {
            return -1.0;
        }
        self.clearance_wish_m * (-halvings).exp2()
    }

    /// The same without a price of the least clearance.
    #[must_use]
    pub fn without_least_clearance(&self) -> Self {
        Self {
            least_clearance_share: 0.0,
            least_clearance_m: 0.0,
            ..*self
        }
    }

    /// How often the wish is halved down to a least clearance.
    fn halvings(&self, least_clearance_m: f64) -> f64 {
        if !self.counts_least_clearance() {
            return 0.0;
        }
        let share = least_clearance_m / self.clearance_wish_m;
        -share.clamp(LEAST_SHARE_OF_WISH, 1.0).log2()
    }

    /// True where obstacles count along the way.
    pub fn sees_obstacles(&self) -> bool {
        self.clearance_weight > 0.0 && self.clearance_wish_m > 0.0
    }

    /// True where the least clearance counts.
    pub fn counts_least_clearance(&self) -> bool {
        let is_priced = self.least_clearance_share > 0.0 || self.least_clearance_m > 0.0;
        is_priced && self.clearance_wish_m > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::objective::DriveCost;

    #[test]
    fn weighs_gears_bends_and_jumps() {
        let cost = VehicleCost {
            reverse_factor: 3.0,
            gear_switch_m: 5.0,
            curvature_change_weight: 0.5,
            bend_weight: 0.1,
            ..DriveCost::default().in_meters(2.0, 1.0)
        };
        let (ahead, back) = (Arc::new(0.25, 2.0), Arc::new(0.0, -2.0));
        assert!((cost.open_ground_m(ahead) - 2.0 * 1.025).abs() < 1e-12);
        assert_eq!(cost.open_ground_m(back), 6.0);
        assert_eq!(cost.joint_m(ahead, back), 5.0);
        // Half of the tightest curvature at half a turning radius of 2 m.
        assert_eq!(cost.joint_m(ahead, Arc::new(0.0, 1.0)), 0.5);
        assert_eq!(cost.joint_m(ahead, ahead), 0.0);
    }

    #[test]
    fn obstacles_count_below_the_wish() {
        let cost = VehicleCost {
            clearance_weight: 2.0,
            clearance_wish_m: 0.4,
            ..DriveCost::default().in_meters(2.0, 1.0)
        };
        assert_eq!(cost.nearness(0.4), 0.0);
        assert!((cost.nearness(0.2) - 0.5).abs() < 1e-12);
        assert_eq!(cost.nearness(0.0), 2.0);
        assert!(cost.nearness(-0.1) > 3.0);
        let blind = DriveCost::length_alone().in_meters(2.0, 1.0);
        assert_eq!(blind.nearness(0.0), 0.0);
        assert_eq!(blind.least_clearance_price_m(7.0, 0.0), 0.0);
        assert!(!blind.sees_obstacles() && !blind.counts_least_clearance());
    }

    #[test]
    fn each_halving_of_the_least_clearance_costs_more_than_the_one_before() {
        let cost = VehicleCost {
            clearance_wish_m: 0.4,
            least_clearance_share: 0.5,
            least_clearance_m: 3.0,
            ..DriveCost::default().in_meters(2.0, 1.0)
        };
        let price_m = |clearance_m| cost.least_clearance_price_m(10.0, clearance_m);
        assert_eq!(price_m(0.5), 0.0);
        assert_eq!(price_m(0.4), 0.0);
        assert!((price_m(0.2) - 8.0).abs() < 1e-12);
        assert!((price_m(0.1) - 32.0).abs() < 1e-12);
        assert_eq!(price_m(0.0), price_m(0.4 / 64.0));
        assert!((cost.least_clearance_for_m(10.0, price_m(0.07)) - 0.07).abs() < 1e-12);
        assert!(cost.least_clearance_for_m(10.0, price_m(0.0)) < 0.0);
    }

    #[test]
    fn a_long_way_in_reverse_costs_more_than_a_short_one() {
        let cost = VehicleCost {
            reverse_factor: 1.25,
            long_reverse_factor: 3.0,
            long_reverse_from_m: 8.0,
            ..DriveCost::length_alone().in_meters(2.0, 1.0)
        };
        let back = |length_m: f64| cost.open_path_m(&[Arc::new(0.0, -length_m)]);
        assert_eq!(back(8.0), 10.0);
        assert_eq!(back(10.0), 10.0 + 6.0);
        assert_eq!(cost.open_path_m(&[Arc::new(0.0, 10.0)]), 10.0);
    }

    #[test]
    fn a_search_counts_turned_wheels() {
        let cost = VehicleCost {
            reverse_factor: 2.0,
            turn_factor: 1.5,
            swing_factor: 0.25,
            ..DriveCost::length_alone().in_meters(2.0, 1.0)
        };
        let (left, right) = (Arc::new(0.5, 1.0), Arc::new(-0.5, -1.0));
        assert_eq!(cost.rate(left), 1.5);
        assert_eq!(cost.rate_after(left, right), 3.5);
        assert_eq!(cost.rate_after(left, Arc::new(0.0, 1.0)), 1.0);
    }
}

//! The cost of driving a chain of arcs: its weights, in the sizes of a vehicle.

use super::VehicleCost;
use crate::parameters::parameters;
use crate::vehicle::Vehicle;

parameters! {
    /// The cost of a driven path, in the sizes of the vehicle: R is its least turning radius, a
    /// width that of its body.
    ///
    /// J = S + N + (share S + radii R) h^2, with h the halvings from the wish down to the least
    /// clearance, N = integral of n(c) ds, and
    ///
    /// S = integral of (g + b (R kappa)^2) ds + sum of w R |jump of kappa| + s (changes of gear),
    /// the cost on open ground, where g is 1 forward and `reverse_factor` in reverse
    /// (`long_reverse_factor` beyond the first `long_reverse_radii` of the path in reverse), b is `bend_weight`, c the
    /// clearance, n(c) = `clearance_weight` (1 - c / wish)^2 below the wish of
    /// `clearance_wish_widths` and 0 above it, w is `curvature_change_weight` and s
    /// `gear_switch_radii`. The share is `least_clearance_share`, the radii are
    /// `least_clearance_radii`.
    ///
    /// [`DriveCost::of_vehicle`] makes meters of it, once per vehicle. Search, improvement and
    /// transitions share one value, the section `cost` of configurations.
    pub struct DriveCost {
        /// Factor on the length driven in reverse.
        #[range(1.0..=100.0)]
        pub reverse_factor: f64 = 1.25,
        /// The same factor beyond the first `long_reverse_radii` that a path drives in reverse.
        #[range(1.0..=100.0)]
        pub long_reverse_factor: f64 = 3.0,
        /// Length in reverse from which `long_reverse_factor` holds, turning radii.
        #[range(0.0..=1000.0)]
        pub long_reverse_radii: f64 = 4.0,
        /// Cost of a change of gear, turning radii.
        #[range(0.0..=1000.0)]
        pub gear_switch_radii: f64 = 2.5,
        /// Cost of a jump of curvature from straight to the tightest turn, in turning radii; in
        /// proportion for other jumps. While the gear changes, the wheels turn at rest and nothing
        /// is counted.
        #[range(0.0..=100.0)]
        pub curvature_change_weight: f64 = 0.05,
        /// Added to the factor on the length driven in the tightest turn; in proportion to the
        /// square of the curvature in others.
        #[range(0.0..=100.0)]
        pub bend_weight: f64 = 0.05,
        /// Added to the factor on the length driven at contact; it falls with the square to 0 at
        /// the wish.
        #[range(0.0..=100.0)]
        pub clearance_weight: f64 = 3.0,
        /// The wish: clearance from which on obstacles no longer count, in widths of the body.
        #[range(0.0..=100.0)]
        pub clearance_wish_widths: f64 = 0.5,
        /// The share of the cost on open ground that a least clearance of half the wish adds; it
        /// grows with the square of the number of halvings.
        #[range(0.0..=100.0)]
        pub least_clearance_share: f64 = 0.15,
        /// What a least clearance of half the wish adds besides, turning radii.
        #[range(0.0..=1000.0)]
        pub least_clearance_radii: f64 = 2.5,
    }
}

impl DriveCost {
    /// Whether these are the defaults.
    #[cfg(feature = "serde")]
    pub(crate) fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// The length alone: any gear, any bend, any clearance.
    pub fn length_alone() -> Self {
        Self {
            reverse_factor: 1.0,
            long_reverse_factor: 1.0,
            long_reverse_radii: 0.0,
            gear_switch_radii: 0.0,
            curvature_change_weight: 0.0,
            bend_weight: 0.0,
            clearance_weight: 0.0,
            clearance_wish_widths: 0.0,
            least_clearance_share: 0.0,
            least_clearance_radii: 0.0,
        }
    }

    /// The cost for a vehicle, in meters. A safety margin is no part of its width.
    ///
    /// ```
    /// use formicar::Vehicle;
    /// use formicar::objective::DriveCost;
    ///
    /// let cost = DriveCost::default().of_vehicle(&Vehicle::sedan());
    /// assert_eq!(format!("{:.1}", cost.gear_switch_m), "10.0");
    /// assert_eq!(format!("{:.1}", cost.clearance_wish_m), "0.9");
    /// ```
    pub fn of_vehicle(&self, vehicle: &Vehicle) -> VehicleCost {
        let margin_m = vehicle.parameters().safety_margin_m.unwrap_or(0.0);
        let width_m = vehicle.width_m() - 2.0 * margin_m;
        self.in_meters(vehicle.min_turning_radius_m(), width_m)
    }

    /// The cost for a least turning radius and a width of the body, in meters.
    pub fn in_meters(&self, radius_m: f64, width_m: f64) -> VehicleCost {
        VehicleCost {
            radius_m,
            reverse_factor: self.reverse_factor,
            long_reverse_factor: self.long_reverse_factor,
            long_reverse_from_m: self.long_reverse_radii * radius_m,
            gear_switch_m: self.gear_switch_radii * radius_m,
            curvature_change_weight: self.curvature_change_weight,
            bend_weight: self.bend_weight,
            clearance_weight: self.clearance_weight,
            clearance_wish_m: self.clearance_wish_widths * width_m,
            least_clearance_share: self.least_clearance_share,
            least_clearance_m: self.least_clearance_radii * radius_m,
            turn_factor: 1.0,
            swing_factor: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_become_meters() {
        let sizes = DriveCost {
            least_clearance_share: 0.8,
            least_clearance_radii: 8.0,
            ..DriveCost::default()
        };
        let cost = sizes.in_meters(4.0, 1.8);
        assert_eq!((cost.gear_switch_m, cost.radius_m), (10.0, 4.0));
        assert!((cost.clearance_wish_m - 0.9).abs() < 1e-12);
        let small = sizes.in_meters(0.4, 0.18);
        let (little, much) = (
            small.least_clearance_price_m(1.0, 0.03),
            cost.least_clearance_price_m(10.0, 0.3),
        );
        assert!((little - 0.1 * much).abs() < 1e-9);
    }

    #[test]
    fn bad_weights_are_refused() {
        assert_eq!(DriveCost::default().check(), Ok(()));
        assert_eq!(DriveCost::length_alone().check(), Ok(()));
        let bad = DriveCost {
            reverse_factor: 0.5,
            ..DriveCost::default()
        };
        let message = bad.check().unwrap_err().to_string();
        assert!(message.contains("reverse_factor = 0.5"), "{message}");
    }
}

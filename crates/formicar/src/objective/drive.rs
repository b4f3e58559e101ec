//! The cost of driving a chain of arcs: its weights.

use crate::geometry::Arc;
use crate::parameters::{Parameters, parameters};

parameters! {
    /// The cost of a driven path, in meters of straight forward driving on open ground.
    ///
    /// J = integral of (g + b (R kappa)^2 + n(c)) ds + sum of w R |jump of kappa| + s (changes of
    /// gear), where g is 1 forward and `reverse_factor` in reverse, b is `bend_weight`, R the
    /// turning radius, c the clearance, n(c) = `clearance_weight` (1 - c / `clearance_wish_m`)^2
    /// below the wish and 0 above it, w is `curvature_change_weight` and s `gear_switch_m`.
    /// Curvature is dimensionless in R, so that the weights serve vehicles of any size.
    ///
    /// Search, smoothing and improvement share this type, each with a value of its own:
    /// [`HybridAstarConfig::cost`], [`SmoothingConfig::cost`] and the section `cost` of
    /// configurations. The terms that only a search over motions uses are no keys of that section.
    ///
    /// [`HybridAstarConfig::cost`]: ../search/struct.HybridAstarConfig.html#method.cost
    /// [`SmoothingConfig::cost`]: ../smoothing/struct.SmoothingConfig.html#method.cost
    pub struct DriveCost {
        /// Factor on the length driven in reverse.
        #[range(1.0..=100.0)]
        pub reverse_factor: f64 = 3.0,
        /// Cost of a change of gear, meters.
        #[range(0.0..=1000.0)]
        pub gear_switch_m: f64 = 10.0,
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
        /// `clearance_wish_m`.
        #[range(0.0..=100.0)]
        pub clearance_weight: f64 = 3.0,
        /// Clearance from which on obstacles no longer count, meters.
        #[range(0.0..=100.0)]
        pub clearance_wish_m: f64 = 0.4,
        /// Factor on the length driven with the wheels turned.
        #[range(1.0..=100.0)]
        #[serde(skip)]
        pub turn_factor: f64 = 1.0,
        /// Added to that factor on an arc that steers the other way than the motion before.
        #[range(0.0..=100.0)]
        #[serde(skip)]
        pub swing_factor: f64 = 0.0,
        /// The shape of n(c).
        #[serde(skip)]
        pub falloff: Falloff = Falloff::Squared,
    }
}

/// The shape of the cost of nearness between contact and the desired clearance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Falloff {
    /// With the square of the lack of clearance; it goes on growing where estimates of the
    /// clearance are below 0.
    #[default]
    Squared,
    /// With the lack of clearance.
    Linear,
}

impl Parameters for Falloff {}

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
            gear_switch_m: 0.0,
            curvature_change_weight: 0.0,
            bend_weight: 0.0,
            clearance_weight: 0.0,
            clearance_wish_m: 0.0,
            ..Self::default()
        }
    }

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

    /// The cost of a meter of an arc on open ground, for a turning radius in meters.
    pub fn rate(&self, arc: Arc, radius_m: f64) -> f64 {
        self.rate_after(arc, arc, radius_m)
    }

    /// The same where the motion before the arc counts.
    pub fn rate_after(&self, before: Arc, arc: Arc, radius_m: f64) -> f64 {
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
        let bend = arc.curvature_per_m * radius_m;
        self.gear_factor(arc.signed_length_m) * (turn + swing) + self.bend_weight * bend * bend
    }

    /// The cost of an arc on open ground, for a turning radius in meters.
    pub fn open_ground_m(&self, arc: Arc, radius_m: f64) -> f64 {
        arc.length_m() * self.rate(arc, radius_m)
    }

    /// The cost of going over from an arc to the next, for a turning radius in meters.
    pub fn joint_m(&self, before: Arc, after: Arc, radius_m: f64) -> f64 {
        if before.signed_length_m * after.signed_length_m < 0.0 {
            return self.gear_switch_m;
        }
        let jump = (after.curvature_per_m - before.curvature_per_m).abs();
        // w R |jump|, in turning radii: R once more makes meters of it.
        self.curvature_change_weight * radius_m * (radius_m * jump)
    }

    /// n(c): the surcharge on a meter at a clearance.
    pub fn nearness(&self, clearance_m: f64) -> f64 {
        if clearance_m >= self.clearance_wish_m || self.clearance_wish_m == 0.0 {
            return 0.0;
        }
        let lack = 1.0 - clearance_m / self.clearance_wish_m;
        match self.falloff {
            Falloff::Squared => self.clearance_weight * lack * lack,
            Falloff::Linear => self.clearance_weight * lack.min(1.0),
        }
    }

    /// Whether obstacles count at all.
    pub fn sees_obstacles(&self) -> bool {
        self.clearance_weight > 0.0 && self.clearance_wish_m > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weighs_gears_bends_and_jumps() {
        let cost = DriveCost {
            reverse_factor: 3.0,
            gear_switch_m: 5.0,
            curvature_change_weight: 0.5,
            bend_weight: 0.1,
            ..DriveCost::default()
        };
        let (ahead, back) = (Arc::new(0.25, 2.0), Arc::new(0.0, -2.0));
        assert!((cost.open_ground_m(ahead, 2.0) - 2.0 * 1.025).abs() < 1e-12);
        assert_eq!(cost.open_ground_m(back, 2.0), 6.0);
        assert_eq!(cost.joint_m(ahead, back, 2.0), 5.0);
        // Half of the tightest curvature at half a turning radius of 2 m.
        assert_eq!(cost.joint_m(ahead, Arc::new(0.0, 1.0), 2.0), 0.5);
        assert_eq!(cost.joint_m(ahead, ahead, 2.0), 0.0);
    }

    #[test]
    fn obstacles_count_below_the_wish() {
        let cost = DriveCost {
            clearance_weight: 2.0,
            clearance_wish_m: 0.4,
            ..DriveCost::default()
        };
        assert_eq!(cost.nearness(0.4), 0.0);
        assert!((cost.nearness(0.2) - 0.5).abs() < 1e-12);
        assert_eq!(cost.nearness(0.0), 2.0);
        assert!(cost.nearness(-0.1) > 3.0);
        assert_eq!(DriveCost::length_alone().nearness(0.0), 0.0);
        assert!(!DriveCost::length_alone().sees_obstacles());
    }

    #[test]
    fn a_search_counts_turned_wheels_and_falls_in_a_line() {
        let cost = DriveCost {
            reverse_factor: 2.0,
            turn_factor: 1.5,
            swing_factor: 0.25,
            clearance_weight: 2.0,
            clearance_wish_m: 0.4,
            falloff: Falloff::Linear,
            ..DriveCost::length_alone()
        };
        let (left, right) = (Arc::new(0.5, 1.0), Arc::new(-0.5, -1.0));
        assert_eq!(cost.rate(left, 2.0), 1.5);
        assert_eq!(cost.rate_after(left, right, 2.0), 3.5);
        assert_eq!(cost.rate_after(left, Arc::new(0.0, 1.0), 2.0), 1.0);
        assert_eq!(cost.nearness(0.2), 1.0);
        assert_eq!(cost.nearness(-0.2), 2.0);
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

//! The cost of driving a chain of arcs: its weights.

use crate::geometry::Arc;
use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The cost of a driven path, in metres of straight forward driving far from obstacles.
///
/// J = integral of (g + b (R kappa)^2 + n(c)) ds + sum of w R |jump of kappa| + s (changes of
/// gear), where g is 1 forward and `reverse_factor` in reverse, b is `bend_weight`, R the turning
/// radius, c the clearance, n(c) = `clearance_weight` (1 - c / `clearance_wish_m`)^2 below the
/// wish and 0 above it, w is `curvature_change_weight` and s `gear_switch_m`. Curvature is
/// dimensionless in R, so that the weights serve vehicles of any size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DriveCost {
    /// Factor on the length driven in reverse, 1 to 100.
    #[schemars(range(min = 1.0, max = 100.0))]
    pub reverse_factor: f64,
    /// Cost of a change of gear, metres, 0 to 1000.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub gear_switch_m: f64,
    /// Cost of a jump of curvature from straight to the tightest turn, in turning radii, 0 to
    /// 100; in proportion for other jumps. While the gear changes, the wheels turn at rest and
    /// nothing is counted.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub curvature_change_weight: f64,
    /// Added to the factor on the length driven in the tightest turn, 0 to 100; in proportion to
    /// the square of the curvature in others.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub bend_weight: f64,
    /// Added to the factor on the length driven at contact, 0 to 100; it falls with the square to
    /// 0 at `clearance_wish_m`.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub clearance_weight: f64,
    /// Clearance from which on obstacles no longer count, metres, 0 to 100.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub clearance_wish_m: f64,
}

impl Default for DriveCost {
    fn default() -> Self {
        Self {
            reverse_factor: 3.0,
            gear_switch_m: 10.0,
            curvature_change_weight: 0.05,
            bend_weight: 0.05,
            clearance_weight: 3.0,
            clearance_wish_m: 0.4,
        }
    }
}

impl DriveCost {
    /// The length alone: any gear, any bend, any clearance.
    pub fn length_alone() -> Self {
        Self {
            reverse_factor: 1.0,
            gear_switch_m: 0.0,
            curvature_change_weight: 0.0,
            bend_weight: 0.0,
            clearance_weight: 0.0,
            clearance_wish_m: 0.0,
        }
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// The first parameter outside its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        check_range("cost.reverse_factor", self.reverse_factor, 1.0..=100.0)?;
        check_range("cost.gear_switch_m", self.gear_switch_m, 0.0..=1000.0)?;
        let change = self.curvature_change_weight;
        check_range("cost.curvature_change_weight", change, 0.0..=100.0)?;
        check_range("cost.bend_weight", self.bend_weight, 0.0..=100.0)?;
        check_range("cost.clearance_weight", self.clearance_weight, 0.0..=100.0)?;
        check_range("cost.clearance_wish_m", self.clearance_wish_m, 0.0..=100.0)
    }

    /// Cost of an arc far from obstacles, for a turning radius in metres.
    pub fn open_ground_m(&self, arc: Arc, radius_m: f64) -> f64 {
        let gear = if arc.signed_length_m < 0.0 {
            self.reverse_factor
        } else {
            1.0
        };
        let bend = arc.curvature_per_m * radius_m;
        arc.length_m() * (gear + self.bend_weight * bend * bend)
    }

    /// Cost of the joint from an arc to the next, for a turning radius in metres.
    pub fn joint_m(&self, before: Arc, after: Arc, radius_m: f64) -> f64 {
        if before.signed_length_m * after.signed_length_m < 0.0 {
            return self.gear_switch_m;
        }
        let jump = (after.curvature_per_m - before.curvature_per_m).abs();
        // w R |jump|, in turning radii: R once more makes metres of it.
        self.curvature_change_weight * radius_m * (radius_m * jump)
    }

    /// n(c): additional cost of a metre at a clearance; it keeps growing for estimates below 0.
    pub fn nearness(&self, clearance_m: f64) -> f64 {
        if clearance_m >= self.clearance_wish_m || self.clearance_wish_m == 0.0 {
            return 0.0;
        }
        let lack = 1.0 - clearance_m / self.clearance_wish_m;
        self.clearance_weight * lack * lack
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
    fn bad_weights_are_refused() {
        assert_eq!(DriveCost::default().check(), Ok(()));
        assert_eq!(DriveCost::length_alone().check(), Ok(()));
        let bad = DriveCost {
            reverse_factor: 0.5,
            ..DriveCost::default()
        };
        let message = bad.check().unwrap_err().to_string();
        assert!(message.contains("cost.reverse_factor = 0.5"), "{message}");
    }
}

//! What a polyline costs that a car shall steer along (Li 2024, equation 15).

use super::Straightness;
use crate::geometry::{Point2, angle_difference};
use crate::numeric::{OutOfRange, check_range};
use crate::vehicle::{SuspendedSteering, SuspensionParameters};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// J = lambda1 mean(epsilon G |phi| / `phi_c`) + lambda2 L / `L_ref`, over the steps of a
/// polyline: Li 2024 (15), (18) and (19) for a whole path, without the factor of the generation,
/// which would let any path seem to improve.
///
/// phi is the steering that a step needs for its turn, atan(wheelbase turn / length), `phi_c` the
/// steering that the suspended vehicle can give there, L the length and `L_ref` that of a shortest
/// path over cells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SteeringCost {
    /// lambda1: weight of steering, from 0 to 1e6.
    pub steering_weight: f64,
    /// lambda2: weight of the length, from 1e-6 to 1e6.
    pub length_weight: f64,
    /// epsilon: factor on a corner, from 0 to 1e6.
    pub epsilon: f64,
}

impl Default for SteeringCost {
    /// The values of Li 2024, sec. 5.2.
    fn default() -> Self {
        Self {
            steering_weight: 0.6,
            length_weight: 0.2,
            epsilon: 0.1,
        }
    }
}

/// A polyline with what its cost depends on.
#[derive(Clone, Copy, Debug)]
pub struct SteeredLine<'a> {
    /// Its points, metres.
    pub points: &'a [Point2],
    /// The heading that the first step turns from; none where it is free.
    pub start_heading_rad: Option<f64>,
    /// Wheelbase in metres and largest steering in radians.
    pub steering: [f64; 2],
    /// How the steering gives way.
    pub suspension: &'a SuspensionParameters,
    /// `L_ref`, metres, above 0.
    pub reference_m: f64,
}

/// What a polyline comes to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PolylineCost {
    /// J.
    pub cost: f64,
    /// Length, metres.
    pub length_m: f64,
    /// W: mean squared deviation of the turns from their mean, radians squared.
    pub turn_variance_rad2: f64,
    /// Largest steering that a step needs, over the steering it can have.
    pub max_steering_ratio: f64,
}

impl SteeringCost {
    /// Checks the ranges.
    ///
    /// # Errors
    /// The first parameter outside its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let steering = self.steering_weight;
        check_range("cost.steering_weight", steering, 0.0..=1e6)?;
        check_range("cost.length_weight", self.length_weight, 1e-6..=1e6)?;
        check_range("cost.epsilon", self.epsilon, 0.0..=1e6)
    }

    /// What a polyline costs; nothing where it does not move.
    ///
    /// # Errors
    /// Parameters of the suspension outside their ranges.
    pub fn of(&self, line: &SteeredLine) -> Result<PolylineCost, OutOfRange> {
        let steps: Vec<Point2> = line.points.windows(2).map(|w| w[1] - w[0]).collect();
        let steps: Vec<(f64, f64)> = steps
            .iter()
            .filter(|step| step.norm() > 0.0)
            .map(|step| (step.angle(), step.norm()))
            .collect();
        let Some(&(first_rad, _)) = steps.first() else {
            return Ok(PolylineCost::default());
        };
        let (n_steps, length_m) = (steps.len() as f64, steps.iter().map(|step| step.1).sum());
        let mean_step_m: f64 = length_m / n_steps;
        let suspension = line.suspension.clone();
        let mut suspended = SuspendedSteering::new(line.steering, suspension, mean_step_m)?;
        let mut straightness = Straightness::default();
        let mut heading_rad = line.start_heading_rad.unwrap_or(first_rad);
        let (mut steering, mut max_ratio) = (0.0, 0.0_f64);
        let (mut sum_turns, mut sum_squares) = (0.0, 0.0);
        for (direction_rad, step_m) in steps {
            let turn_rad = angle_difference(direction_rad, heading_rad);
            let needed_rad = (line.steering[0] * turn_rad.abs() / step_m).atan();
            let ratio = needed_rad / suspended.advance(turn_rad, step_m).limit_rad;
            // Li 2024 (18) without the factor of the generation.
            steering += self.epsilon * straightness.with(turn_rad.abs(), step_m) * ratio;
            straightness.push(turn_rad.abs(), step_m);
            max_ratio = max_ratio.max(ratio);
            sum_turns += turn_rad;
            sum_squares += turn_rad * turn_rad;
            heading_rad = direction_rad;
        }
        let mean_turn = sum_turns / n_steps;
        Ok(PolylineCost {
            cost: self.steering_weight * steering / n_steps
                + self.length_weight * length_m / line.reference_m,
            length_m,
            turn_variance_rad2: (sum_squares / n_steps - mean_turn * mean_turn).max(0.0),
            max_steering_ratio: max_ratio,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RIGID: [f64; 2] = [2.0, 0.7];

    fn cost(points: &[(f64, f64)], start_heading_rad: Option<f64>) -> PolylineCost {
        let points: Vec<Point2> = points.iter().map(|&(x, y)| Point2::new(x, y)).collect();
        let line = SteeredLine {
            points: &points,
            start_heading_rad,
            steering: RIGID,
            suspension: &SuspensionParameters::rigid(),
            reference_m: 10.0,
        };
        SteeringCost::default().of(&line).unwrap()
    }

    #[test]
    fn a_straight_line_costs_its_length() {
        let straight = cost(&[(0.0, 0.0), (4.0, 0.0), (10.0, 0.0)], None);
        assert!((straight.cost - 0.2).abs() < 1e-12);
        assert_eq!(straight.max_steering_ratio, 0.0);
        assert_eq!(
            cost(&[(1.0, 1.0), (1.0, 1.0)], None),
            PolylineCost::default()
        );
    }

    #[test]
    fn turns_cost_what_they_ask_of_the_steering() {
        let corner = cost(&[(0.0, 0.0), (5.0, 0.0), (5.0, 5.0)], Some(0.0));
        let ratio = (2.0 * std::f64::consts::FRAC_PI_2 / 5.0).atan() / 0.7;
        assert!((corner.max_steering_ratio - ratio).abs() < 1e-12);
        // Two steps, of which the second turns; G is 1 before the fourth.
        let expected = 0.6 * 0.1 * ratio / 2.0 + 0.2;
        assert!((corner.cost - expected).abs() < 1e-12);
        let variance = (std::f64::consts::FRAC_PI_2 / 2.0).powi(2);
        assert!((corner.turn_variance_rad2 - variance).abs() < 1e-12);
        let sideways = cost(&[(0.0, 0.0), (10.0, 0.0)], Some(0.5));
        assert!(sideways.cost > 0.2);
    }

    #[test]
    fn bad_weights_are_refused() {
        let bad = SteeringCost {
            epsilon: f64::NAN,
            ..SteeringCost::default()
        };
        assert!(
            bad.check()
                .unwrap_err()
                .to_string()
                .contains("cost.epsilon")
        );
    }
}

//! The cost of a polyline that a car steers along (Li 2024, equation 15).

use super::Straightness;
use crate::geometry::{Point2, angle_difference};
use crate::parameters::{OutOfRange, parameters};
use crate::vehicle::{SuspendedSteering, SuspensionParameters};

parameters! {
    /// J = lambda1 mean(epsilon G |phi| / `phi_c`) + lambda2 L / `L_ref`, over the steps of a
    /// polyline: Li 2024 (15), (18) and (19) for a whole path, without the factor of the
    /// generation, which would let any path seem to improve.
    ///
    /// phi is the steering that a step needs for its turn, atan(wheelbase turn / length), `phi_c`
    /// the steering that the suspended vehicle can give there, L the length and `L_ref` that of a
    /// shortest path over cells.
    pub struct SteeringCost {
        /// λ₁: weight of steering.
        #[range(0.0..=1e6)]
        pub steering_weight: f64 = 0.6,
        /// λ₂: weight of the length.
        #[range(1e-6..=1e6)]
        pub length_weight: f64 = 0.2,
        /// ε: factor on a corner.
        #[range(0.0..=1e6)]
        pub epsilon: f64 = 0.1,
    }
}

/// A polyline with all that its cost depends on.
#[derive(Clone, Copy, Debug)]
pub struct SteeredLine<'a> {
    /// Its points, meters.
    pub points: &'a [Point2],
    /// The heading that the first step turns from; none where it is free.
    pub start_heading_rad: Option<f64>,
    /// Wheelbase in meters and largest steering in radians.
    pub steering: [f64; 2],
    /// The suspension, which limits the steering.
    pub suspension: &'a SuspensionParameters,
    /// `L_ref`, meters, above 0.
    pub reference_m: f64,
}

/// The cost of a polyline and its parts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PolylineCost {
    /// J.
    pub cost: f64,
    /// Length, meters.
    pub length_m: f64,
    /// W: mean squared deviation of the turns from their mean, radians squared.
    pub turn_variance_rad2: f64,
    /// Largest steering that a step needs, over the steering it can have.
    pub max_steering_ratio: f64,
}

impl SteeringCost {
    /// The cost of a polyline; 0 if it does not move.
    ///
    /// # Errors
    /// Parameters of the suspension outside their ranges.
    pub fn of(&self, line: &SteeredLine) -> Result<PolylineCost, OutOfRange> {
        let steps = line.points.windows(2).map(|w| w[1] - w[0]);
        let steps: Vec<(f64, f64)> = steps
            .filter(|step| step.norm() > 0.0)
            .map(|step| (step.angle(), step.norm()))
            .collect();
        let Some(&(first_rad, _)) = steps.first() else {
            return Ok(PolylineCost::default());
        };
        let length_m: f64 = steps.iter().map(|step| step.1).sum();
        let mean_step_m = length_m / steps.len() as f64;
        let suspended =
            SuspendedSteering::new(line.steering, line.suspension.clone(), mean_step_m)?;
        let mut meter = SteeringMeter::new(line.steering, suspended);
        let mut heading_rad = line.start_heading_rad.unwrap_or(first_rad);
        for (direction_rad, step_m) in steps {
            meter.take(angle_difference(direction_rad, heading_rad), step_m);
            heading_rad = direction_rad;
        }
        Ok(meter.total(self, line.reference_m))
    }
}

/// Adds up the cost of the steps of a polyline while they are taken.
#[derive(Clone, Debug)]
pub struct SteeringMeter {
    wheelbase_m: f64,
    suspended: SuspendedSteering,
    straightness: Straightness,
    /// `phi_c`, where the next step begins.
    limit_rad: f64,
    n_steps: u32,
    length_m: f64,
    /// Sum of G |phi| / `phi_c`.
    steering: f64,
    max_ratio: f64,
    sum_turns_rad: f64,
    sum_squares_rad2: f64,
}

impl SteeringMeter {
    /// For a vehicle at rest with a wheelbase in meters and a largest steering in radians.
    pub fn new([wheelbase_m, max_steer_rad]: [f64; 2], suspended: SuspendedSteering) -> Self {
        Self {
            wheelbase_m,
            suspended,
            straightness: Straightness::default(),
            limit_rad: max_steer_rad,
            n_steps: 0,
            length_m: 0.0,
            steering: 0.0,
            max_ratio: 0.0,
            sum_turns_rad: 0.0,
            sum_squares_rad2: 0.0,
        }
    }

    /// `phi_c`: the steering that the vehicle can give where it is, radians.
    pub fn limit_rad(&self) -> f64 {
        self.limit_rad
    }

    /// The straightness of the last steps.
    pub fn straightness(&self) -> &Straightness {
        &self.straightness
    }

    /// Takes a step of a positive length after a turn.
    pub fn take(&mut self, turn_rad: f64, length_m: f64) {
        let needed_rad = (self.wheelbase_m * turn_rad.abs() / length_m).atan();
        self.take_needing(needed_rad, turn_rad, length_m);
    }

    /// The same where the steering that the turn needs is known.
    pub fn take_needing(&mut self, needed_rad: f64, turn_rad: f64, length_m: f64) {
        let ratio = needed_rad / self.limit_rad;
        // Li 2024 (18) without epsilon and the factor of the generation.
        self.steering += self.straightness.with(turn_rad.abs(), length_m) * ratio;
        self.straightness.push(turn_rad.abs(), length_m);
        self.limit_rad = self.suspended.advance_limit_rad(turn_rad, length_m);
        self.n_steps += 1;
        self.length_m += length_m;
        self.max_ratio = self.max_ratio.max(ratio);
        self.sum_turns_rad += turn_rad;
        self.sum_squares_rad2 += turn_rad * turn_rad;
    }

    /// The cost of all steps so far, given the reference length.
    pub fn total(&self, weights: &SteeringCost, reference_m: f64) -> PolylineCost {
        let n_steps = f64::from(self.n_steps.max(1));
        let mean_turn = self.sum_turns_rad / n_steps;
        PolylineCost {
            cost: weights.steering_weight * weights.epsilon * self.steering / n_steps
                + weights.length_weight * self.length_m / reference_m,
            length_m: self.length_m,
            turn_variance_rad2: (self.sum_squares_rad2 / n_steps - mean_turn * mean_turn).max(0.0),
            max_steering_ratio: self.max_ratio,
        }
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
        assert!(bad.check().unwrap_err().to_string().contains("epsilon"));
    }
}

//! Steering of a car whose suspension gives way in turns (Li 2024, sections 2 and 3).
//!
//! The wheel that steers stands at (x, y) in the body frame, (wheelbase, 0) while nothing moves.
//! In a turn the suspension deflects, the wheel moves towards the inside of the turn, and the
//! vehicle reaches less curvature with the same steering limit. How the deflection follows the
//! lateral force, and how curvature is felt, is of fractional order: both remember.

use crate::numeric::{FractionalDerivative, FractionalStream, grunwald_letnikov_weights};
use crate::parameters::{OutOfRange, parameters};
use std::collections::VecDeque;

parameters! {
    /// Parameters of suspension and memory. The default is that of a small loaded car at 2 m/s.
    pub struct SuspensionParameters {
        /// Mass carried by the suspension, kg.
        #[range(0.0..=1e6)]
        pub mass_kg: f64 = 300.0,
        /// Deflection per lateral force, m/N, the inverse of the stiffness k; 0 is rigid.
        #[range(0.0..=1.0)]
        pub compliance_m_per_n: f64 = 5e-5,
        /// Damping over stiffness, c / k, in s^γ.
        #[range(0.0..=1e3)]
        pub relaxation: f64 = 0.2,
        /// γ: order of the damping; 1 is viscous.
        #[range(1e-6..=1.0)]
        pub damping_order: f64 = 0.5,
        /// How far the wheel moves inward per deflection.
        #[range(0.0..=100.0)]
        pub inward_gain: f64 = 1.0,
        /// How far the wheel moves forward per deflection.
        #[range(-100.0..=100.0)]
        pub forward_gain: f64 = 0.0,
        /// Speed, m/s.
        #[range(0.0..=100.0)]
        pub speed_mps: f64 = 2.0,
        /// ρ: order of the heading's derivative; 1 has no memory.
        #[range(1e-6..=1.0)]
        pub heading_order: f64 = 0.9,
        /// Order of the arc length's derivative; 1 has no memory.
        #[range(1e-6..=1.0)]
        pub arc_order: f64 = 0.9,
        /// Samples that are remembered.
        #[range(1..=10_000)]
        pub window: u32 = 8,
    }
}

impl SuspensionParameters {
    /// Nothing gives way, nothing is remembered: a rigid bicycle.
    pub fn rigid() -> Self {
        Self {
            compliance_m_per_n: 0.0,
            heading_order: 1.0,
            arc_order: 1.0,
            ..Self::default()
        }
    }
}

/// The steering that a step along a path needs, and the steering that is possible there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteeringDemand {
    /// K: curvature as it is felt, 1/m, positive left.
    pub curvature_per_m: f64,
    /// Deflection of the suspension, meters, positive left.
    pub deflection_m: f64,
    /// Place of the steering wheel in the body frame, meters.
    pub wheel_m: (f64, f64),
    /// Steering that the step needs, radians, positive left.
    pub needed_rad: f64,
    /// Largest steering of a rigid bicycle whose curvature the wheel still reaches here, radians.
    pub limit_rad: f64,
}

/// A suspended vehicle on its way: feed it the steps of a path.
#[derive(Clone, Debug)]
pub struct SuspendedSteering {
    parameters: SuspensionParameters,
    wheelbase_m: f64,
    /// Tangent of the largest steering.
    max_tangent: f64,
    /// c / k h^-gamma.
    damping: f64,
    deflections: FractionalStream,
    headings: FadingMean,
    arcs: FadingMean,
}

impl SuspendedSteering {
    /// A vehicle with a wheelbase in meters and a largest steering in radians, at rest; it will
    /// take steps of about `step_m`, which must be positive.
    ///
    /// # Errors
    /// A parameter outside its range.
    pub fn new(
        [wheelbase_m, max_steer_rad]: [f64; 2],
        parameters: SuspensionParameters,
        step_m: f64,
    ) -> Result<Self, OutOfRange> {
        parameters.check()?;
        let window = parameters.window as usize;
        let time_step_s = step_m / parameters.speed_mps.max(f64::MIN_POSITIVE);
        let order = parameters.damping_order;
        let derivative = FractionalDerivative::new(order, time_step_s).with_window(window);
        Ok(Self {
            wheelbase_m,
            max_tangent: max_steer_rad.tan(),
            damping: parameters.relaxation * time_step_s.powf(-order),
            deflections: derivative.stream(),
            headings: FadingMean::new(parameters.heading_order, window),
            arcs: FadingMean::new(parameters.arc_order, window),
            parameters,
        })
    }

    /// Takes a step that turns the heading and covers some arc length, which must be positive.
    pub fn advance(&mut self, turn_rad: f64, length_m: f64) -> SteeringDemand {
        let (curvature, deflection) = self.feel(turn_rad, length_m);
        let (x, y) = self.wheel_m(deflection);
        SteeringDemand {
            curvature_per_m: curvature,
            deflection_m: deflection,
            wheel_m: (x, y),
            // (12): the wheel at (x, y) moves along (1 - y K, x K).
            needed_rad: (x * curvature).atan2(1.0 - y * curvature),
            limit_rad: self.limit_rad((x, y)),
        }
    }

    /// Takes a step as [`Self::advance`] does, and tells the limit alone.
    pub fn advance_limit_rad(&mut self, turn_rad: f64, length_m: f64) -> f64 {
        let (_, deflection) = self.feel(turn_rad, length_m);
        self.limit_rad(self.wheel_m(deflection))
    }

    /// Curvature as it is felt on a step, and the deflection after it.
    fn feel(&mut self, turn_rad: f64, length_m: f64) -> (f64, f64) {
        // Li 2024 (10-11) as read: fading means of the increments, so that K is the curvature at
        // order 1, and on any circle.
        let curvature = self.headings.push(turn_rad) / self.arcs.push(length_m);
        (curvature, self.deflect(curvature))
    }

    /// Position of the steering wheel's contact in the body frame.
    fn wheel_m(&self, deflection_m: f64) -> (f64, f64) {
        let p = &self.parameters;
        let x = self.wheelbase_m + p.forward_gain * deflection_m.abs();
        (x, p.inward_gain * deflection_m)
    }

    /// (13-14): the curvature that the displaced wheel reaches at the steering limit, as the
    /// steering of a rigid bicycle.
    fn limit_rad(&self, (x, y): (f64, f64)) -> f64 {
        let reached = self.max_tangent / (x + y.abs() * self.max_tangent);
        (self.wheelbase_m * reached).atan()
    }

    /// The deflection after a step: the fractional Kelvin-Voigt body
    /// d + (c / k) D^gamma d = F / k, solved for the new d.
    fn deflect(&mut self, curvature: f64) -> f64 {
        let p = &self.parameters;
        let force = p.mass_kg * p.speed_mps * p.speed_mps * curvature;
        let remembered = p.relaxation * self.deflections.memory();
        let deflection = (p.compliance_m_per_n * force - remembered) / (1.0 + self.damping);
        self.deflections.push(deflection);
        deflection
    }
}

/// The mean of the last values, weighted by how long ago they were: the Caputo derivative of the
/// sum of the values, divided by that of the sum of ones.
#[derive(Clone, Debug)]
struct FadingMean {
    weights: Vec<f64>,
    values: VecDeque<f64>,
}

impl FadingMean {
    fn new(order: f64, window: usize) -> Self {
        Self {
            // c(0) = 1, c(k) = c(k - 1) (1 - order / k): those of the order one less.
            weights: grunwald_letnikov_weights(order - 1.0, window),
            values: VecDeque::with_capacity(window),
        }
    }

    fn push(&mut self, value: f64) -> f64 {
        self.values.truncate(self.weights.len() - 1);
        self.values.push_front(value);
        let weighed = self.values.iter().zip(&self.weights);
        let (sum, total) = weighed.fold((0.0, 0.0), |(sum, total), (value, weight)| {
            (sum + value * weight, total + weight)
        });
        sum / total
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Wheelbase and largest steering of a sedan.
    const SEDAN: [f64; 2] = [2.8, 0.61];

    fn steering(parameters: SuspensionParameters) -> SuspendedSteering {
        SuspendedSteering::new(SEDAN, parameters, 0.2).unwrap()
    }

    proptest! {
        #[test]
        fn rigid_and_without_memory_it_is_the_bicycle(
            curvatures in prop::collection::vec(-0.25_f64..0.25, 1..30),
        ) {
            let mut rigid = steering(SuspensionParameters::rigid());
            for curvature in curvatures {
                let demand = rigid.advance(0.2 * curvature, 0.2);
                let bicycle = (SEDAN[0] * curvature).atan();
                prop_assert!((demand.needed_rad - bicycle).abs() < 1e-12);
                prop_assert!((demand.limit_rad - SEDAN[1]).abs() < 1e-12);
                prop_assert_eq!(demand.deflection_m, 0.0);
            }
        }

        #[test]
        fn mirrored_turns_ask_for_mirrored_steering(
            curvatures in prop::collection::vec(-0.2_f64..0.2, 1..30),
        ) {
            let [mut left, mut right] = [0; 2].map(|_| steering(SuspensionParameters::default()));
            for curvature in curvatures {
                let (a, b) = (left.advance(curvature, 0.2), right.advance(-curvature, 0.2));
                prop_assert!((a.needed_rad + b.needed_rad).abs() < 1e-12);
                prop_assert!((a.limit_rad - b.limit_rad).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn on_a_circle_curvature_is_felt_as_it_is() {
        let mut suspended = steering(SuspensionParameters::default());
        for _ in 0..50 {
            let demand = suspended.advance(0.02, 0.2);
            assert!((demand.curvature_per_m - 0.1).abs() < 1e-12);
        }
    }

    #[test]
    fn the_deflection_settles_at_compliance_times_force_and_lowers_the_limit() {
        let parameters = SuspensionParameters {
            damping_order: 1.0,
            window: 2,
            ..SuspensionParameters::default()
        };
        let settled = parameters.compliance_m_per_n * parameters.mass_kg * 4.0 * 0.1;
        let mut suspended = steering(parameters);
        let first = suspended.advance(0.02, 0.2);
        let last = (0..500)
            .map(|_| suspended.advance(0.02, 0.2))
            .last()
            .unwrap();
        assert!(first.deflection_m > 0.0 && first.deflection_m < last.deflection_m);
        assert!((last.deflection_m / settled - 1.0).abs() < 1e-6, "{last:?}");
        assert!(last.limit_rad < SEDAN[1]);
        let softer = SuspensionParameters {
            compliance_m_per_n: 1e-3,
            ..SuspensionParameters::default()
        };
        let mut softer = steering(softer);
        let softest = (0..500).map(|_| softer.advance(0.02, 0.2)).last().unwrap();
        assert!(softest.limit_rad < last.limit_rad);
    }

    #[test]
    fn bad_parameters_are_refused() {
        let bad = SuspensionParameters {
            damping_order: 1.5,
            ..SuspensionParameters::default()
        };
        let error = SuspendedSteering::new(SEDAN, bad, 0.2).unwrap_err();
        assert!(error.to_string().contains("damping_order = 1.5"), "{error}");
    }
}

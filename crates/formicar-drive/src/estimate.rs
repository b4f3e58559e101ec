//! The robot's own pose, out of measured poses and wheel odometry.

use formicar::Pose2;
use formicar::geometry::angle_difference;
use formicar::tracking::DriveLimits;
use formicar::vehicle::BicycleState;

/// Error that rolling adds, as variance per meter driven: 1 cm and 0.5 degrees after a meter.
const DRIFT_M2_PER_M: f64 = 1e-4;
const DRIFT_RAD2_PER_M: f64 = 7.6e-5;

/// A Kalman filter of position and heading, each with one variance: odometry predicts, measured
/// poses correct.
#[derive(Clone, Debug)]
pub struct PoseFilter {
    pose: Option<Pose2>,
    /// Variances of the pose.
    position_m2: f64,
    heading_rad2: f64,
    /// Variances of a measurement.
    noise_m2: f64,
    noise_rad2: f64,
}

impl PoseFilter {
    /// A filter of measurements with standard deviations per axis and of the heading.
    pub fn new(sigma_m: f64, sigma_rad: f64) -> Self {
        Self {
            pose: None,
            position_m2: 0.0,
            heading_rad2: 0.0,
            noise_m2: sigma_m * sigma_m,
            noise_rad2: sigma_rad * sigma_rad,
        }
    }

    /// The pose after rolling for a time and a measurement; the state tells speed and steering angle
    /// as encoders have them.
    pub fn update(
        &mut self,
        measured: Pose2,
        wheels: BicycleState,
        limits: &DriveLimits,
        elapsed_s: f64,
    ) -> Pose2 {
        let Some(before) = self.pose else {
            self.position_m2 = self.noise_m2;
            self.heading_rad2 = self.noise_rad2;
            self.pose = Some(measured);
            return measured;
        };
        let rolled_m = wheels.speed_mps * elapsed_s;
        let curvature_per_m = wheels.steer_rad.tan() / limits.wheelbase_m;
        let predicted = before.advance(curvature_per_m, rolled_m);
        self.position_m2 += DRIFT_M2_PER_M * rolled_m.abs();
        self.heading_rad2 += DRIFT_RAD2_PER_M * rolled_m.abs();
        let gain = gain(&mut self.position_m2, self.noise_m2);
        let turn_gain = self::gain(&mut self.heading_rad2, self.noise_rad2);
        let way = measured.position() - predicted.position();
        let turn_rad = angle_difference(measured.heading, predicted.heading);
        let pose = Pose2::at(
            predicted.position() + way * gain,
            predicted.heading + turn_gain * turn_rad,
        );
        self.pose = Some(pose.wrapped());
        pose.wrapped()
    }
}

/// The share of an innovation that is taken; the variance falls by as much.
fn gain(variance: &mut f64, noise: f64) -> f64 {
    if noise == 0.0 {
        *variance = 0.0;
        return 1.0;
    }
    let gain = *variance / (*variance + noise);
    *variance *= 1.0 - gain;
    gain
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::Seed;
    use formicar::tracking::{ActuatedVehicle, DriveCommand};

    fn limits() -> DriveLimits {
        DriveLimits {
            wheelbase_m: 0.33,
            max_steer_rad: 0.4,
            steer_rate_rad_per_s: 3.0,
            acceleration_mps2: 1.5,
            braking_mps2: 1.5,
            delay_s: 0.0,
            control_period_s: 0.02,
        }
    }

    #[test]
    fn noise_of_two_centimeters_becomes_a_fraction() {
        let mut vehicle = ActuatedVehicle::new(limits(), BicycleState::default());
        let mut filter = PoseFilter::new(0.02, 0.017);
        let mut random = Seed(5).stream([0, 0]);
        let (mut square_m2, mut square_rad2, mut n) = (0.0, 0.0, 0.0);
        for step in 0..500 {
            let steer_rad = 0.3 * (0.02 * f64::from(step)).sin();
            vehicle.give(DriveCommand {
                speed_mps: 1.0,
                steer_rad,
            });
            for _ in 0..4 {
                vehicle.step(0.005);
            }
            let truth = vehicle.state();
            let measured = Pose2::new(
                truth.pose.x + 0.02 * random.normal(),
                truth.pose.y + 0.02 * random.normal(),
                truth.pose.heading + 0.017 * random.normal(),
            );
            let pose = filter.update(measured, truth, &limits(), 0.02);
            if step > 50 {
                square_m2 += (pose.x - truth.pose.x).powi(2) + (pose.y - truth.pose.y).powi(2);
                square_rad2 += angle_difference(pose.heading, truth.pose.heading).powi(2);
                n += 2.0;
            }
        }
        assert!((square_m2 / n).sqrt() < 0.008, "{}", (square_m2 / n).sqrt());
        assert!((2.0 * square_rad2 / n).sqrt() < 0.008);
    }

    #[test]
    fn exact_measurements_are_taken_as_they_are() {
        let mut filter = PoseFilter::new(0.0, 0.0);
        let pose = Pose2::new(1.0, 2.0, 0.3);
        filter.update(Pose2::default(), BicycleState::default(), &limits(), 0.02);
        assert_eq!(
            filter.update(pose, BicycleState::default(), &limits(), 0.02),
            pose
        );
    }
}

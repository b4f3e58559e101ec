//! The kinematics of a car: the bicycle, and the four wheels of the Ackermann chassis around it.

use super::Vehicle;
use crate::geometry::{Point2, Pose2};
use crate::numeric::rk4_step;

/// Pose, speed and steering angle of a kinematic bicycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BicycleState {
    /// Center of the rear axle.
    pub pose: Pose2,
    /// Speed of the rear axle, m/s; negative in reverse.
    pub speed_mps: f64,
    /// Angle of the virtual middle front wheel, radians, positive to the left.
    pub steer_rad: f64,
}

/// The driver's input, held over a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BicycleInput {
    /// Change of the speed, m/s^2.
    pub acceleration_mps2: f64,
    /// Change of the steering angle, rad/s.
    pub steer_rate_rad_per_s: f64,
}

impl BicycleState {
    /// The state after `duration_s` seconds, by one Runge-Kutta step of fourth order.
    ///
    /// The wheels roll without slip: x' = v cos(heading), y' = v sin(heading),
    /// heading' = v tan(steer) / wheelbase. Limits of speed and steering are the caller's.
    #[must_use]
    pub fn step(self, wheelbase_m: f64, input: BicycleInput, duration_s: f64) -> Self {
        let Pose2 { x, y, heading } = self.pose;
        let state = [x, y, heading, self.speed_mps, self.steer_rad];
        let rates = |[_, _, heading, speed, steer]: [f64; 5]| {
            let (sin, cos) = heading.sin_cos();
            [
                speed * cos,
                speed * sin,
                speed * steer.tan() / wheelbase_m,
                input.acceleration_mps2,
                input.steer_rate_rad_per_s,
            ]
        };
        let [x, y, heading, speed_mps, steer_rad] = rk4_step(state, duration_s, rates);
        Self {
            pose: Pose2::new(x, y, heading),
            speed_mps,
            steer_rad,
        }
    }
}

/// The two axles of an Ackermann chassis, whose wheels all roll about one point on the line of
/// the rear axle (Lei & Zheng 2020, sec. I and II.A).
///
/// ```
/// use formicar::Vehicle;
/// use formicar::vehicle::AckermannAxles;
///
/// let axles = AckermannAxles::of(&Vehicle::sedan()).unwrap();
/// let (left_rad, right_rad) = axles.front_wheel_angles(0.3);
/// assert!(left_rad > 0.3 && right_rad < 0.3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AckermannAxles {
    /// Distance between the axles, meters.
    pub wheelbase_m: f64,
    /// Distance between the wheels of an axle, meters.
    pub track_width_m: f64,
}

/// One number per wheel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wheels<T> {
    /// Front left.
    pub front_left: T,
    /// Front right.
    pub front_right: T,
    /// Rear left.
    pub rear_left: T,
    /// Rear right.
    pub rear_right: T,
}

impl AckermannAxles {
    /// The axles of a vehicle, where its wheelbase is known.
    pub fn of(vehicle: &Vehicle) -> Option<Self> {
        Some(Self {
            wheelbase_m: vehicle.wheelbase_m()?,
            track_width_m: vehicle.track_width_m(),
        })
    }

    /// Angles of the left and the right front wheel, radians, for a steering angle of the virtual
    /// middle wheel: cot(outer) - cot(inner) = track width / wheelbase.
    ///
    /// An inner angle above pi/2 means that the center of rotation lies between the rear wheels.
    pub fn front_wheel_angles(self, steer_rad: f64) -> (f64, f64) {
        let tan = steer_rad.tan();
        let half_track = 0.5 * self.track_width_m / self.wheelbase_m;
        let at = |lateral: f64| tan.atan2(1.0 - lateral * tan);
        (at(half_track), at(-half_track))
    }

    /// The difference between the paths of the front and the rear inner wheel: the
    /// difference of their radii in meters (German *Innenraddifferenz*), 0 straight ahead.
    pub fn inner_wheel_path_difference_m(self, steer_rad: f64) -> f64 {
        let tan = steer_rad.tan().abs();
        // Both radii times tan(steer) / wheelbase, so that a straight line is no special case.
        let rear = (1.0 - 0.5 * self.track_width_m / self.wheelbase_m * tan).abs();
        self.wheelbase_m * tan / (rear.hypot(tan) + rear)
    }

    /// Positions of the wheels.
    pub fn wheel_positions(self, pose: Pose2) -> Wheels<Point2> {
        let (front, left) = (self.wheelbase_m, 0.5 * self.track_width_m);
        let at = |x, y| pose.transform(Point2::new(x, y));
        Wheels {
            front_left: at(front, left),
            front_right: at(front, -left),
            rear_left: at(0.0, left),
            rear_right: at(0.0, -left),
        }
    }

    /// Radii of the wheels' paths, meters; infinite straight ahead.
    pub fn wheel_path_radii_m(self, steer_rad: f64) -> Wheels<f64> {
        let radius = self.wheelbase_m / steer_rad.tan();
        let (left, right) = (
            radius - 0.5 * self.track_width_m,
            radius + 0.5 * self.track_width_m,
        );
        Wheels {
            front_left: left.hypot(self.wheelbase_m),
            front_right: right.hypot(self.wheelbase_m),
            rear_left: left.abs(),
            rear_right: right.abs(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lei_axles() -> AckermannAxles {
        AckermannAxles::of(&Vehicle::lei2020()).unwrap()
    }

    fn drive(start: BicycleState, input: BicycleInput, n_steps: u32) -> BicycleState {
        let step_s = 4.0 / f64::from(n_steps);
        (0..n_steps).fold(start, |state, _| state.step(2.0, input, step_s))
    }

    #[test]
    fn constant_steering_follows_the_exact_arc() {
        for (speed_mps, steer_rad) in [(1.5, 0.6), (-1.0, 0.3), (2.0, -0.5), (1.0, 0.0)] {
            let start = BicycleState {
                pose: Pose2::new(1.0, -2.0, 0.7),
                speed_mps,
                steer_rad,
            };
            let end = drive(start, BicycleInput::default(), 400).pose;
            let exact = start.pose.advance(steer_rad.tan() / 2.0, 4.0 * speed_mps);
            assert!(end.position().distance(exact.position()) < 1e-8);
            assert!((end.heading - exact.heading).abs() < 1e-10);
        }
    }

    #[test]
    fn error_of_a_changing_drive_falls_with_the_fourth_power() {
        let input = BicycleInput {
            acceleration_mps2: 0.3,
            steer_rate_rad_per_s: 0.2,
        };
        let end = |n| drive(BicycleState::default(), input, n).pose.position();
        let ratio = end(10).distance(end(640)) / end(20).distance(end(640));
        assert!((12.0..20.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn wheels_obey_the_ackermann_condition() {
        let axles = lei_axles();
        for degrees in [-40.0_f64, -10.0, 1.0, 25.0, 40.0] {
            let (left, right) = axles.front_wheel_angles(degrees.to_radians());
            let (inner, outer) = if degrees > 0.0 {
                (left, right)
            } else {
                (-right, -left)
            };
            let difference = 1.0 / outer.tan() - 1.0 / inner.tan();
            assert!((difference - 0.4).abs() < 1e-12, "{difference}");
        }
        assert_eq!(axles.front_wheel_angles(0.0), (0.0, 0.0));
        // Lei & Zheng 2020: about 45 degrees at the limit.
        let (inner, _) = axles.front_wheel_angles(40_f64.to_radians());
        assert!((inner.to_degrees() - 45.2).abs() < 0.1);
    }

    #[test]
    fn the_rear_inner_wheel_cuts_the_corner() {
        let axles = lei_axles();
        for steer in [0.01, 0.3, 0.69, -0.4] {
            let radii = axles.wheel_path_radii_m(steer);
            let (front, rear) = if steer > 0.0 {
                (radii.front_left, radii.rear_left)
            } else {
                (radii.front_right, radii.rear_right)
            };
            let difference = axles.inner_wheel_path_difference_m(steer);
            assert!((difference - (front - rear)).abs() < 1e-12);
        }
        assert_eq!(axles.inner_wheel_path_difference_m(0.0), 0.0);
    }

    #[test]
    fn wheels_keep_their_distance_to_the_center_of_rotation() {
        let axles = lei_axles();
        let steer = 0.5_f64;
        let center = Point2::new(0.0, 2.0 / steer.tan());
        let radii = axles.wheel_path_radii_m(steer);
        let at = axles.wheel_positions(Pose2::default());
        assert!((at.front_left.distance(center) - radii.front_left).abs() < 1e-12);
        assert!((at.rear_right.distance(center) - radii.rear_right).abs() < 1e-12);
    }
}

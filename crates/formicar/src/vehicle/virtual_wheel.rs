//! The wheel that a suspended car seems to steer with: velocity, acceleration and direction of a
//! point of the body (Li 2024, section 2).

use crate::geometry::{Point2, Pose2, angle_difference};

/// Motion of a body at an instant, of its reference point unless said otherwise; world frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyMotion {
    /// Position of the reference point, and the heading theta.
    pub pose: Pose2,
    /// Velocity (`v_ox`, `v_oy`), m/s.
    pub velocity_mps: Point2,
    /// Acceleration, m/s².
    pub acceleration_mps2: Point2,
    /// Yaw rate omega, rad/s, positive left.
    pub yaw_rate_rad_per_s: f64,
    /// Its derivative, rad/s².
    pub yaw_acceleration_rad_per_s2: f64,
}

impl BodyMotion {
    /// Velocity of the wheel at (x, y) in the body frame, meters: in m/s in the world frame.
    pub fn wheel_velocity_mps(&self, wheel_m: Point2) -> Point2 {
        // Li 2024 (6): v_xp = v_ox - (x sin theta + y cos theta) omega,
        // v_yp = v_oy + (x cos theta - y sin theta) omega.
        let arm = self.arm(wheel_m);
        self.velocity_mps + arm.perpendicular() * self.yaw_rate_rad_per_s
    }

    /// Acceleration of the wheel at (x, y) in the body frame, meters: in m/s² in the world frame.
    pub fn wheel_acceleration_mps2(&self, wheel_m: Point2) -> Point2 {
        // Li 2024 (7): (6) by time, where the arm turns with the body.
        let arm = self.arm(wheel_m);
        let swing = arm.perpendicular() * self.yaw_acceleration_rad_per_s2;
        let inward = arm * -self.yaw_rate_rad_per_s.powi(2);
        self.acceleration_mps2 + swing + inward
    }

    /// Steering `phi_c` of that wheel: its direction against the heading, radians, in (-pi, pi].
    pub fn wheel_steering_rad(&self, wheel_m: Point2) -> f64 {
        // Li 2024 (8): phi_m = atan2(v_yp, v_xp), phi_c = phi_m - theta.
        let direction = self.wheel_velocity_mps(wheel_m).angle();
        angle_difference(direction, self.pose.heading)
    }

    /// Speed of that wheel, m/s.
    pub fn wheel_speed_mps(&self, wheel_m: Point2) -> f64 {
        // Li 2024 (9): v^2 = v_xp^2 + v_yp^2.
        self.wheel_velocity_mps(wheel_m).norm()
    }

    /// From the reference point to the wheel, world frame.
    fn arm(&self, wheel_m: Point2) -> Point2 {
        self.pose.transform(wheel_m) - self.pose.position()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHEEL: Point2 = Point2::new(2.8, -0.3);

    /// A body on an ellipse that swings its heading, at a time.
    fn motion(t: f64) -> BodyMotion {
        let heading = 0.4 + 0.9 * t - 0.2 * t * t;
        BodyMotion {
            pose: Pose2::new(3.0 * t.cos(), 2.0 * t.sin(), heading),
            velocity_mps: Point2::new(-3.0 * t.sin(), 2.0 * t.cos()),
            acceleration_mps2: Point2::new(-3.0 * t.cos(), -2.0 * t.sin()),
            yaw_rate_rad_per_s: 0.9 - 0.4 * t,
            yaw_acceleration_rad_per_s2: -0.4,
        }
    }

    #[test]
    fn velocity_and_acceleration_are_those_of_the_moving_wheel() {
        let h = 1e-4;
        for t in [0.0, 0.7, 1.9, 3.3] {
            let place = |t: f64| motion(t).pose.transform(WHEEL);
            let velocity = (place(t + h) - place(t - h)) * (0.5 / h);
            assert!(motion(t).wheel_velocity_mps(WHEEL).distance(velocity) < 1e-6);
            let speed = |t: f64| motion(t).wheel_velocity_mps(WHEEL);
            let acceleration = (speed(t + h) - speed(t - h)) * (0.5 / h);
            let ours = motion(t).wheel_acceleration_mps2(WHEEL);
            assert!(ours.distance(acceleration) < 1e-6);
            assert!((motion(t).wheel_speed_mps(WHEEL) - velocity.norm()).abs() < 1e-6);
        }
    }

    #[test]
    fn a_wheel_on_the_axis_of_a_rolling_car_steers_as_the_bicycle_does() {
        // The rear axle rolls along its heading on a circle of curvature 0.2.
        let (speed, curvature, heading) = (1.5, 0.2, 2.0);
        let rolling = BodyMotion {
            pose: Pose2::new(1.0, -4.0, heading),
            velocity_mps: Point2::unit(heading) * speed,
            yaw_rate_rad_per_s: speed * curvature,
            ..BodyMotion::default()
        };
        let steering = rolling.wheel_steering_rad(Point2::new(2.8, 0.0));
        assert!((steering - (2.8 * curvature).atan()).abs() < 1e-12);
        // Off the axis it is what a step along a path needs: atan2(x K, 1 - y K).
        let inside = rolling.wheel_steering_rad(Point2::new(2.8, 0.4));
        assert!((inside - (2.8 * curvature).atan2(1.0 - 0.4 * curvature)).abs() < 1e-12);
    }
}

//! The fastest drive along a path that nothing crosses.

use super::steps::Steps;
use crate::metrics::PathMetrics;
use crate::path::{CurvePath, Spacing, SpeedLimits, TimedPath, TimedState};
use crate::vehicle::Vehicle;

/// The fastest drive along a path, from standing to standing, within limits that have been checked.
///
/// Over each step between two samples the square of the speed is bounded by the top speed, by
/// lateral acceleration (`v^2 |k|`), and by the steering rate: the wheels turn at
/// `v |dk/ds| L / (1 + (L k)^2)`. A pass forward and one back bound its slope by twice the
/// acceleration; both together give the fastest profile within the limits (for bounds that do not
/// depend on the profile). The vehicle stands at both ends, where the gear changes, and (where the
/// steering rate is known) where the curvature jumps; there its wheels turn first. The jerk is not
/// bounded here.
///
/// ```
/// use formicar::motion::fastest;
/// use formicar::path::{Direction, SpeedLimits};
/// use formicar::{CurvePath, Pose2, Vehicle};
///
/// let mut path = CurvePath::new(Pose2::default());
/// path.push(0.0, 100.0, Direction::Forward);
/// let limits = SpeedLimits { max_speed_mps: 10.0, ..SpeedLimits::default() };
/// let timed = fastest(&path, &Vehicle::sedan(), &limits, 0.5);
/// assert!(timed.duration_s() > 10.0);
/// assert!(timed.timed_poses(0.5).iter().all(|pose| pose.speed_mps <= 10.0));
/// ```
pub fn fastest(
    path: &CurvePath,
    vehicle: &Vehicle,
    limits: &SpeedLimits,
    spacing: impl Into<Spacing>,
) -> TimedPath {
    let steps = Steps::new(path, vehicle, limits, None, &spacing.into());
    let phases = steps.fastest(TimedState::default(), steps.length_m());
    TimedPath::new(path.clone(), phases.unwrap_or_default())
}

/// Most that two samples of the speed profile lie apart, as in answers.
const SPEED_SPACING_M: f64 = 0.1;

/// The time of the fastest drive along a path within the vehicle's speed, the default accelerations
/// of [`SpeedLimits`] and the steering rate, seconds; where the vehicle says how fast it drives.
pub fn travel_time_s(path: &CurvePath, vehicle: &Vehicle) -> Option<f64> {
    let limits = SpeedLimits::of(vehicle)?;
    Some(fastest(path, vehicle, &limits, SPEED_SPACING_M).duration_s())
}

impl PathMetrics {
    /// The metrics of a path with its travel time, which speed planning knows.
    #[must_use]
    pub fn with_travel_time(self, path: &CurvePath, vehicle: &Vehicle) -> Self {
        Self {
            travel_time_s: travel_time_s(path, vehicle),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose2;
    use crate::path::Direction::{Forward, Reverse};
    use crate::path::TimedPose;
    use crate::vehicle::VehicleParameters;

    fn car(steer_rate: Option<f64>) -> Vehicle {
        Vehicle::new(VehicleParameters {
            speed_mps: Some(2.0),
            max_steer_rate_rad_per_s: steer_rate,
            max_acceleration_mps2: None,
            ..Vehicle::lei2020().parameters().clone()
        })
        .unwrap()
    }

    struct Profile {
        poses: Vec<TimedPose>,
        travel_time_s: f64,
    }

    fn profile(path: &CurvePath, vehicle: &Vehicle) -> Profile {
        let limits = SpeedLimits::of(vehicle).unwrap();
        limits.check().unwrap();
        let timed = fastest(path, vehicle, &limits, 0.1);
        Profile {
            poses: timed.timed_poses(0.1),
            travel_time_s: timed.duration_s(),
        }
    }

    #[test]
    fn a_straight_drive_is_a_trapezoid() {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.0, 10.0, Forward);
        let profile = profile(&path, &car(None));
        // 2 s and 2 m to reach 2 m/s, the same to stop, 6 m at 2 m/s.
        assert!((profile.travel_time_s - 7.0).abs() < 1e-9);
        let fastest = profile
            .poses
            .iter()
            .map(|p| p.speed_mps)
            .fold(0.0, f64::max);
        assert!((fastest - 2.0).abs() < 1e-12);
        assert_eq!(profile.poses.len(), path.sample(0.1).len());
        assert!(profile.poses.windows(2).all(|w| w[1].time_s > w[0].time_s));
    }

    #[test]
    fn a_vehicle_accelerates_as_fast_as_it_says() {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.0, 10.0, Forward);
        let sedate = Vehicle::new(VehicleParameters {
            max_acceleration_mps2: Some(0.5),
            ..car(None).parameters().clone()
        });
        // 4 s and 4 m to reach 2 m/s, the same to stop, 2 m at 2 m/s.
        let profile = profile(&path, &sedate.unwrap());
        assert!((profile.travel_time_s - 9.0).abs() < 1e-9);
    }

    #[test]
    fn a_short_hop_is_a_triangle() {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.0, 0.04, Forward);
        path.push(0.0, 0.04, Reverse);
        let profile = profile(&path, &car(None));
        assert!((profile.travel_time_s - 4.0 * 0.04_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn bends_and_steering_bound_the_speed() {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.0, 10.0, Forward);
        path.push_clothoid([0.0, 0.4], 1.0, Forward);
        path.push(0.4, 3.0, Forward);
        path.push_clothoid([0.4, 0.0], 1.0, Forward);
        path.push(0.0, 10.0, Forward);
        let vehicle = car(Some(0.5));
        let profile = profile(&path, &vehicle);
        for (sample, timed) in path.sample(0.1).iter().zip(&profile.poses) {
            let lateral = timed.speed_mps.powi(2) * sample.curvature_per_m.abs();
            assert!(lateral <= 2.0 + 1e-9);
        }
        let steer = |k: f64| (2.0 * k).atan();
        let pairs = path.sample(0.1);
        for (w, t) in pairs.windows(2).zip(profile.poses.windows(2)) {
            let turn = (steer(w[1].curvature_per_m) - steer(w[0].curvature_per_m)).abs();
            assert!(turn <= 0.5 * (t[1].time_s - t[0].time_s) * (1.0 + 1e-9));
        }
    }

    #[test]
    fn wheels_turn_while_the_vehicle_stands() {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.4, 2.0, Forward);
        path.push(-0.4, 2.0, Reverse);
        let (still, turning) = (profile(&path, &car(None)), profile(&path, &car(Some(0.5))));
        let extra_s = 2.0 * 0.8_f64.atan() / 0.5;
        assert!((turning.travel_time_s - still.travel_time_s - extra_s).abs() < 1e-9);
    }

    #[test]
    fn limits_out_of_range_are_refused() {
        let bad = SpeedLimits {
            max_lateral_mps2: 0.0,
            ..SpeedLimits::default()
        };
        assert!(
            bad.check()
                .unwrap_err()
                .to_string()
                .contains("max_lateral_mps2")
        );
    }
}

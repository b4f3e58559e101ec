//! Speed along a path, and the time that it takes.
//!
//! Over each step between two samples the square of the speed is bounded by the top speed, by
//! lateral acceleration (`v^2 |k|`), and by the steering rate: the wheels turn at
//! `v |dk/ds| L / (1 + (L k)^2)`. A pass forward and one back bound its slope by twice the
//! acceleration; both together give the fastest profile within the limits (for bounds that do not
//! depend on the profile). The vehicle stands at both ends, where the gear changes, and (where the
//! steering rate is known) where the curvature jumps; there its wheels turn first.

use super::{CurvePath, CurveSegment, Spacing};
use crate::parameters::parameters;
use crate::vehicle::Vehicle;

parameters! {
    /// Limits of speed and acceleration.
    pub struct SpeedLimits {
        /// Top speed in both gears, meters per second.
        #[range(0.001..=100.0)]
        pub max_speed_mps: f64 = 1.0,
        /// Largest lateral acceleration, m/s^2; default 2, as in a calmly driven car.
        #[range(0.01..=100.0)]
        pub max_lateral_mps2: f64 = 2.0,
        /// Largest acceleration and deceleration, m/s^2; default 1.
        #[range(0.01..=100.0)]
        pub max_acceleration_mps2: f64 = 1.0,
        /// Fastest change of the steering angle, radians per second; unbounded where left out.
        #[range(0.001..=100.0)]
        pub max_steer_rate_rad_per_s: Option<f64> = None,
    }
}

impl SpeedLimits {
    /// The limits of a vehicle that says how fast it drives; none of the others.
    pub fn of(vehicle: &Vehicle) -> Option<Self> {
        let parameters = vehicle.parameters();
        let usual = Self::default();
        Some(Self {
            max_speed_mps: parameters.speed_mps?,
            max_acceleration_mps2: parameters
                .max_acceleration_mps2
                .unwrap_or(usual.max_acceleration_mps2),
            max_steer_rate_rad_per_s: parameters.max_steer_rate_rad_per_s,
            ..usual
        })
    }
}

/// Speed and time at one pose of a sampled path.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TimedPose {
    /// Speed when the pose is reached, meters per second, at least 0.
    pub speed_mps: f64,
    /// Time when it is reached, seconds from the beginning.
    pub time_s: f64,
    /// Time that the vehicle then stands there, while its wheels turn, seconds; 0 at most poses.
    pub stands_s: f64,
}

/// Speeds and times along a path.
///
/// ```
/// use formicar::path::{Direction, SpeedLimits, SpeedProfile};
/// use formicar::{CurvePath, Pose2, Vehicle};
///
/// let mut path = CurvePath::new(Pose2::default());
/// path.push(0.0, 100.0, Direction::Forward);
/// let limits = SpeedLimits { max_speed_mps: 10.0, ..SpeedLimits::default() };
/// let profile = SpeedProfile::new(&path, &Vehicle::sedan(), &limits, 0.5);
/// assert!(profile.travel_time_s > 10.0);
/// assert!(profile.poses.iter().all(|pose| pose.speed_mps <= 10.0));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SpeedProfile {
    /// One for each pose of [`CurvePath::sample`] at the same spacing.
    pub poses: Vec<TimedPose>,
    /// From standing at the first pose to standing at the last, seconds.
    pub travel_time_s: f64,
}

/// A stretch between two samples.
struct Step {
    length_m: f64,
    /// Bound of the speed on it.
    cap_mps: f64,
    /// The time that the vehicle stands before it, if it does.
    stands_s: Option<f64>,
}

impl SpeedProfile {
    /// The fastest drive along a path within limits that have been checked. The wheels turn about
    /// the vehicle's own axles; where its wheelbase is unknown they do not bound the speed.
    pub fn new(
        path: &CurvePath,
        vehicle: &Vehicle,
        limits: &SpeedLimits,
        spacing: impl Into<Spacing>,
    ) -> Self {
        let wheels = Wheels {
            wheelbase_m: vehicle.wheelbase_m().unwrap_or(0.0),
            rate_rad_per_s: limits
                .max_steer_rate_rad_per_s
                .filter(|_| vehicle.wheelbase_m().is_some()),
        };
        let steps = steps(path, limits, &wheels, &spacing.into());
        let speeds = speeds(&steps, limits.max_acceleration_mps2);
        let mut time_s = 0.0;
        let standing_s = |i: usize| steps.get(i).and_then(|step| step.stands_s).unwrap_or(0.0);
        let mut poses = vec![TimedPose {
            speed_mps: 0.0,
            time_s,
            stands_s: standing_s(0),
        }];
        for (i, (step, pair)) in steps.iter().zip(speeds.windows(2)).enumerate() {
            time_s += standing_s(i);
            time_s += step.duration_s([pair[0], pair[1]], limits.max_acceleration_mps2);
            poses.push(TimedPose {
                speed_mps: pair[1],
                time_s,
                stands_s: standing_s(i + 1),
            });
        }
        Self {
            poses,
            travel_time_s: time_s,
        }
    }
}

/// The steered wheels.
struct Wheels {
    wheelbase_m: f64,
    rate_rad_per_s: Option<f64>,
}

impl Wheels {
    /// The speed at which the wheels just keep up with a change of curvature.
    fn cap_mps(&self, curvatures: [f64; 2], rate_per_m2: f64) -> f64 {
        let Some(rate) = self.rate_rad_per_s else {
            return f64::INFINITY;
        };
        // The wheels turn fastest where they point ahead most.
        let [a, b] = curvatures;
        let least = if a * b <= 0.0 {
            0.0
        } else {
            a.abs().min(b.abs())
        };
        let steer = self.wheelbase_m * least;
        rate * (1.0 + steer * steer) / (self.wheelbase_m * rate_per_m2.abs())
    }

    /// The time in which the wheels of a standing vehicle turn from one curvature to another.
    fn turning_s(&self, from: f64, to: f64) -> f64 {
        let steer = |curvature: f64| (self.wheelbase_m * curvature).atan();
        let turn = (steer(to) - steer(from)).abs();
        self.rate_rad_per_s.map_or(0.0, |rate| turn / rate)
    }
}

fn steps(path: &CurvePath, limits: &SpeedLimits, wheels: &Wheels, spacing: &Spacing) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut before: Option<&CurveSegment> = None;
    for segment in path.segments() {
        let n_steps = segment.n_steps(spacing);
        let length_m = segment.length_m / n_steps as f64;
        for i in 0..n_steps {
            let curvatures = [i, i + 1].map(|i| segment.curvature_at(i as f64 * length_m));
            let steepest = curvatures[0].abs().max(curvatures[1].abs());
            let lateral = (limits.max_lateral_mps2 / steepest).sqrt();
            let steering = wheels.cap_mps(curvatures, segment.curvature_rate_per_m2);
            steps.push(Step {
                length_m,
                cap_mps: limits.max_speed_mps.min(lateral).min(steering),
                stands_s: (i == 0)
                    .then(|| standing_s(before, segment, wheels))
                    .flatten(),
            });
        }
        before = Some(segment);
    }
    steps
}

/// The time that the vehicle stands before a segment; none where it drives on. The wheels are
/// straight at first or turned already: what they did before the path is not known.
fn standing_s(before: Option<&CurveSegment>, next: &CurveSegment, wheels: &Wheels) -> Option<f64> {
    const SAME_CURVATURE_PER_M: f64 = 1e-9;
    let Some(before) = before else {
        return Some(0.0);
    };
    let (from, to) = (before.end_curvature_per_m(), next.curvature_per_m);
    let jumps = wheels.rate_rad_per_s.is_some() && (to - from).abs() > SAME_CURVATURE_PER_M;
    (jumps || before.direction != next.direction).then(|| wheels.turning_s(from, to))
}

/// Speeds at the ends of the steps: forward from standing, and back from standing.
fn speeds(steps: &[Step], acceleration_mps2: f64) -> Vec<f64> {
    let n = steps.len();
    let mut squares = vec![0.0; n + 1];
    for i in 1..n {
        let cap = match steps[i].stands_s {
            Some(_) => 0.0,
            None => steps[i - 1].cap_mps.min(steps[i].cap_mps),
        };
        let reached = squares[i - 1] + 2.0 * acceleration_mps2 * steps[i - 1].length_m;
        squares[i] = reached.min(cap * cap);
    }
    for i in (0..n).rev() {
        let stops = squares[i + 1] + 2.0 * acceleration_mps2 * steps[i].length_m;
        squares[i] = squares[i].min(stops);
    }
    squares.into_iter().map(f64::sqrt).collect()
}

impl Step {
    /// Accelerate, drive at the bound where there is room, brake.
    fn duration_s(&self, [first, last]: [f64; 2], acceleration_mps2: f64) -> f64 {
        let peak = (0.5 * (first * first + last * last) + acceleration_mps2 * self.length_m).sqrt();
        let top = peak.min(self.cap_mps).max(first).max(last);
        let changing_s = (2.0 * top - first - last) / acceleration_mps2;
        let changing_m =
            (2.0 * top * top - first * first - last * last) / (2.0 * acceleration_mps2);
        let left_m = (self.length_m - changing_m).max(0.0);
        changing_s + if left_m > 0.0 { left_m / top } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose2;
    use crate::path::Direction::{Forward, Reverse};
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

    fn profile(path: &CurvePath, vehicle: &Vehicle) -> SpeedProfile {
        let limits = SpeedLimits::of(vehicle).unwrap();
        limits.check().unwrap();
        SpeedProfile::new(path, vehicle, &limits, 0.1)
    }

    #[test]
    fn a_straight_drive_is_a_trapezoid() {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.0, 10.0, Forward);
        let profile = profile(&path, &car(None));
        // 2 s and 2 m to reach 2 m/s, the same to stop, 6 m at 2 m/s.
        assert!((profile.travel_time_s - 7.0).abs() < 1e-9, "{profile:?}");
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
        assert!((profile.travel_time_s - 9.0).abs() < 1e-9, "{profile:?}");
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

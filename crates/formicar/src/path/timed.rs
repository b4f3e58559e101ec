//! A path with the time at which each of its places is reached.

use super::{CurvePath, CurveSegment, Spacing};
use crate::geometry::Pose2;

/// A part of a drive with constant jerk; mostly the jerk is 0, and the acceleration constant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Phase {
    /// Time at its beginning, seconds.
    pub t_s: f64,
    /// Arc length at its beginning, meters.
    pub s_m: f64,
    /// Speed at its beginning, meters per second, at least 0 in both gears.
    pub speed_mps: f64,
    /// Acceleration along the path at its beginning, m/s^2.
    pub acceleration_mps2: f64,
    /// Change of the acceleration, m/s^3.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_zero"))]
    pub jerk_mps3: f64,
    /// Duration, seconds.
    pub duration_s: f64,
}

#[cfg(feature = "serde")]
#[allow(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde hands over a reference"
)]
fn is_zero(number: &f64) -> bool {
    *number == 0.0
}

impl Phase {
    /// The state some time after its beginning.
    pub fn after(&self, elapsed_s: f64) -> TimedState {
        let (d, a, j) = (elapsed_s, self.acceleration_mps2, self.jerk_mps3);
        TimedState {
            t_s: self.t_s + d,
            s_m: self.s_m + d * (self.speed_mps + d * (0.5 * a + d * j / 6.0)),
            speed_mps: (self.speed_mps + d * (a + 0.5 * d * j)).max(0.0),
            acceleration_mps2: a + d * j,
        }
    }

    /// The state at its end.
    pub fn end(&self) -> TimedState {
        self.after(self.duration_s)
    }

    /// True while the vehicle stands.
    pub fn is_standing(&self) -> bool {
        self.speed_mps == 0.0 && self.acceleration_mps2 == 0.0 && self.jerk_mps3 == 0.0
    }

    /// The time from its beginning until a place is reached, at most its duration.
    fn time_to_s(&self, s_m: f64) -> f64 {
        let (mut low, mut high) = (0.0, self.duration_s);
        if self.jerk_mps3 == 0.0 {
            // s = v t + a t^2 / 2, solved without a difference of nearly equal numbers.
            let (v, a, ahead_m) = (self.speed_mps, self.acceleration_mps2, s_m - self.s_m);
            let speed = (v * v + 2.0 * a * ahead_m).max(0.0).sqrt();
            let sum = v + speed;
            return if sum > 0.0 {
                (2.0 * ahead_m / sum).clamp(0.0, high)
            } else {
                high
            };
        }
        // The length driven never falls.
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.after(middle).s_m < s_m {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }
}

/// The motion along a path at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TimedState {
    /// Time, seconds.
    pub t_s: f64,
    /// Arc length, meters.
    pub s_m: f64,
    /// Speed, meters per second, at least 0 in both gears.
    pub speed_mps: f64,
    /// Acceleration along the path, m/s^2.
    pub acceleration_mps2: f64,
}

/// Speed and time at one pose of a sampled path.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TimedPose {
    /// Speed when the pose is reached, meters per second, at least 0.
    pub speed_mps: f64,
    /// Time when it is reached, seconds from the beginning; infinite where the drive ends before.
    pub time_s: f64,
    /// Time that the vehicle then stands there, while its wheels turn or others pass, seconds; 0 at
    /// most poses.
    pub stands_s: f64,
    /// Acceleration with which the pose is reached, m/s^2.
    pub acceleration_mps2: f64,
}

/// A place where the vehicle stands for a while.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Stop {
    /// Arc length, meters.
    pub s_m: f64,
    /// Time when it is reached, seconds.
    pub t_s: f64,
    /// Time that the vehicle stands there, seconds.
    pub duration_s: f64,
}

/// A path and the profile of arc length over time with which it is driven.
///
/// The profile is a chain of [phases](Phase) of constant acceleration, or of constant jerk; its last
/// may be one without duration, which holds the end to the last bit. Before
/// its beginning the vehicle is at the first place, after its end it stands at the last one. Nobody
/// has checked the numbers of a profile made by [`TimedPath::new`]:
/// `judge_in_time` does.
///
/// ```
/// use formicar::path::{Direction, Phase, TimedPath};
/// use formicar::{CurvePath, Pose2};
///
/// let mut path = CurvePath::new(Pose2::default());
/// path.push(0.0, 2.0, Direction::Forward);
/// let speed_up = Phase { acceleration_mps2: 1.0, duration_s: 1.0, ..Phase::default() };
/// let roll = Phase { t_s: 1.0, s_m: 0.5, speed_mps: 1.0, duration_s: 1.5, ..Phase::default() };
/// let timed = TimedPath::new(path, vec![speed_up, roll]);
/// assert_eq!(timed.duration_s(), 2.5);
/// assert_eq!(timed.pose_at(2.0), Pose2::new(1.5, 0.0, 0.0));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TimedPath {
    path: CurvePath,
    phases: Vec<Phase>,
}

impl TimedPath {
    /// A path with given phases, in order.
    pub fn new(path: CurvePath, phases: Vec<Phase>) -> Self {
        Self { path, phases }
    }

    /// The path.
    pub fn path(&self) -> &CurvePath {
        &self.path
    }

    /// The phases, in order of time.
    pub fn phases(&self) -> &[Phase] {
        &self.phases
    }

    /// The last state.
    pub fn end(&self) -> TimedState {
        self.phases
            .last()
            .map_or_else(TimedState::default, Phase::end)
    }

    /// The time of the whole drive, seconds.
    pub fn duration_s(&self) -> f64 {
        self.phases
            .last()
            .map_or(0.0, |last| last.t_s + last.duration_s)
    }

    /// True if the drive ends at the end of the path.
    pub fn arrives(&self) -> bool {
        self.path.length_m() - self.end().s_m < END_M
    }

    /// The state at a time: before the beginning the first, after the end the last, standing.
    pub fn at(&self, t_s: f64) -> TimedState {
        let begun = self.phases.partition_point(|phase| phase.t_s <= t_s);
        let Some(phase) = begun.checked_sub(1).map(|i| &self.phases[i]) else {
            return TimedState {
                t_s,
                ..TimedState::default()
            };
        };
        let elapsed_s = t_s - phase.t_s;
        if begun == self.phases.len() && elapsed_s > phase.duration_s {
            return TimedState {
                t_s,
                speed_mps: 0.0,
                acceleration_mps2: 0.0,
                ..self.end()
            };
        }
        let state = phase.after(elapsed_s.min(phase.duration_s));
        TimedState { t_s, ..state }
    }

    /// The pose at a time.
    pub fn pose_at(&self, t_s: f64) -> Pose2 {
        self.path.pose_at(self.at(t_s).s_m)
    }

    /// Speed and time at a place of the path.
    pub fn reached(&self, s_m: f64) -> TimedPose {
        let next = self.phases.partition_point(|phase| phase.s_m < s_m);
        let before = next.checked_sub(1).map(|i| &self.phases[i]);
        let acceleration =
            |elapsed_s: f64| before.map_or(0.0, |before| before.after(elapsed_s).acceleration_mps2);
        let exact = self.phases.get(next).filter(|phase| phase.s_m == s_m);
        if let Some(phase) = exact {
            let standing = self.phases[next..].iter();
            let standing = standing.take_while(|p| p.s_m == s_m && p.is_standing());
            return TimedPose {
                speed_mps: phase.speed_mps,
                time_s: phase.t_s,
                stands_s: standing.fold(0.0, |sum, p| sum + p.duration_s),
                acceleration_mps2: acceleration(
                    f64::INFINITY.min(before.map_or(0.0, |before| before.duration_s)),
                ),
            };
        }
        let Some(before) = before else {
            return TimedPose {
                speed_mps: 0.0,
                time_s: 0.0,
                stands_s: 0.0,
                acceleration_mps2: 0.0,
            };
        };
        let end = self.end();
        if next == self.phases.len() && s_m >= end.s_m {
            let is_there = s_m - end.s_m < END_M;
            return TimedPose {
                speed_mps: end.speed_mps,
                time_s: if is_there { end.t_s } else { f64::INFINITY },
                stands_s: 0.0,
                acceleration_mps2: end.acceleration_mps2,
            };
        }
        let state = before.after(before.time_to_s(s_m));
        TimedPose {
            speed_mps: state.speed_mps,
            time_s: state.t_s,
            stands_s: 0.0,
            acceleration_mps2: state.acceleration_mps2,
        }
    }

    /// Speed and time at each pose of [`CurvePath::sample`].
    pub fn timed_poses(&self, spacing: impl Into<Spacing>) -> Vec<TimedPose> {
        let poses = self.path.sample(spacing);
        poses.iter().map(|pose| self.reached(pose.s_m)).collect()
    }

    /// The places where the vehicle stands, in order, without its beginning and end.
    pub fn stops(&self) -> Vec<Stop> {
        let mut stops: Vec<Stop> = Vec::new();
        let stands = |phase: &&Phase| phase.is_standing() && phase.duration_s > 0.0;
        for phase in self.phases.iter().filter(stands) {
            match stops.last_mut() {
                Some(last) if last.s_m == phase.s_m => last.duration_s += phase.duration_s,
                _ => stops.push(Stop {
                    s_m: phase.s_m,
                    t_s: phase.t_s,
                    duration_s: phase.duration_s,
                }),
            }
        }
        stops
    }
}

/// Lengths that differ by less are the same place.
const END_M: f64 = 1e-6;

impl CurvePath {
    /// The segment on which a place lies, and the length driven on it; places beyond an end lie at
    /// the end. None of a path without length.
    pub fn segment_at(&self, s_m: f64) -> Option<(&CurveSegment, f64)> {
        let mut begin_m = 0.0;
        for segment in &self.segments {
            if s_m < begin_m + segment.length_m {
                return Some((segment, (s_m - begin_m).max(0.0)));
            }
            begin_m += segment.length_m;
        }
        self.segments.last().map(|last| (last, last.length_m))
    }
}

/// A change of the steering angle, rad/s, at a speed: `v k' L / (1 + (L k)^2)`.
pub fn steer_rate_rad_per_s(
    wheelbase_m: f64,
    speed_mps: f64,
    curvature_per_m: f64,
    rate_per_m2: f64,
) -> f64 {
    let tangent = wheelbase_m * curvature_per_m;
    speed_mps * rate_per_m2 * wheelbase_m / (1.0 + tangent * tangent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::Direction;

    fn stop_and_go() -> TimedPath {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.0, 3.0, Direction::Forward);
        let phases = [
            (0.0, 0.0, 0.0, 1.0, 1.0),
            (1.0, 0.5, 1.0, -1.0, 1.0),
            (2.0, 1.0, 0.0, 0.0, 4.0),
            (6.0, 1.0, 0.0, 1.0, 2.0),
        ];
        let phases = phases.map(
            |(t_s, s_m, speed_mps, acceleration_mps2, duration_s)| Phase {
                t_s,
                s_m,
                speed_mps,
                acceleration_mps2,
                jerk_mps3: 0.0,
                duration_s,
            },
        );
        TimedPath::new(path, phases.to_vec())
    }

    #[test]
    fn places_and_times_belong_together() {
        let timed = stop_and_go();
        assert_eq!(timed.duration_s(), 8.0);
        assert!(timed.arrives());
        for t_s in [0.3, 1.0, 1.7, 6.5, 7.9] {
            let state = timed.at(t_s);
            let pose = timed.reached(state.s_m);
            assert!((pose.time_s - t_s).abs() < 1e-9, "{t_s} {pose:?}");
            assert!((pose.speed_mps - state.speed_mps).abs() < 1e-9);
        }
        let stop = timed.reached(1.0);
        assert_eq!(
            (stop.time_s, stop.stands_s, stop.speed_mps),
            (2.0, 4.0, 0.0)
        );
        assert_eq!(timed.stops().len(), 1);
        assert_eq!(timed.at(4.0).s_m, 1.0);
        assert_eq!(timed.at(99.0).s_m, 3.0);
        assert_eq!(timed.at(99.0).speed_mps, 0.0);
    }

    #[test]
    fn a_drive_that_ends_early_never_reaches_the_rest() {
        let mut timed = stop_and_go();
        timed.phases.truncate(3);
        assert!(!timed.arrives());
        assert_eq!(timed.reached(2.0).time_s, f64::INFINITY);
        assert_eq!(timed.reached(1.0).time_s, 2.0);
    }

    #[test]
    fn phases_with_jerk_are_inverted_too() {
        let phase = Phase {
            speed_mps: 0.5,
            jerk_mps3: 0.4,
            duration_s: 3.0,
            ..Phase::default()
        };
        let state = phase.after(1.3);
        assert!((phase.time_to_s(state.s_m) - 1.3).abs() < 1e-9);
    }
}

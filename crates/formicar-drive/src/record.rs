//! What happened in a drive.

use crate::agents::Agent;
use crate::contact::Contact;
use crate::driver::DriverCounts;
use formicar::{Pose2, Seed};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Name and version of the document of a drive.
pub const DRIVE_SCHEMA: &str = "formicar/drive/1";

/// The ending of a drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum DriveStatus {
    /// The robot is at its goal, and drove into nothing.
    Arrived,
    /// The robot drove into something.
    Collided,
    /// The time is over.
    TimedOut,
}

impl DriveStatus {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Arrived => "arrived",
            Self::Collided => "collided",
            Self::TimedOut => "timed_out",
        }
    }
}

/// A drive, as a document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct DriveRecord {
    /// Name and version of this document: `formicar/drive/1`.
    pub schema: String,
    /// The ending.
    pub status: DriveStatus,
    /// The seed of noise and agents.
    pub seed: Seed,
    /// Where the robot began.
    pub start: Pose2,
    /// Where it was to go.
    pub goal: Pose2,
    /// Time of the drive, seconds.
    pub duration_s: f64,
    /// Length driven, meters.
    pub driven_m: f64,
    /// Distance from the goal at the end, meters.
    pub goal_error_m: f64,
    /// Highest speed, m/s.
    pub max_speed_mps: f64,
    /// Least distance from what stands, meters: exact from squares and border.
    pub min_static_distance_m: f64,
    /// Least distance from an agent; missing where none came near.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_agent_distance_m: Option<f64>,
    /// Least time to a collision with an agent while the robot drove, seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_time_to_collision_s: Option<f64>,
    /// Times at which the robot came to a stand on its way.
    pub n_stops: usize,
    /// Share of the map that the robot knew at the end.
    pub known_share: f64,
    /// What the driver did.
    pub driver: DriverCounts,
    /// Contacts, those that others caused included.
    pub contacts: Vec<Contact>,
    /// Times that planner and controller took, by the clock that was handed in; missing without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub latencies: Option<Latencies>,
    /// The agents, in the order of [`DrivePoint::agents`].
    pub agents: Vec<Agent>,
    /// The drive, point by point.
    pub trace: Vec<DrivePoint>,
}

impl DriveRecord {
    /// True if the robot arrived and drove into nothing.
    pub fn succeeds(&self) -> bool {
        self.status == DriveStatus::Arrived
    }
}

/// A moment of a drive.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DrivePoint {
    /// Time, seconds.
    pub t_s: f64,
    /// The robot.
    pub pose: Pose2,
    /// Its speed, m/s, negative in reverse.
    pub speed_mps: f64,
    /// Its steering angle, radians.
    pub steer_rad: f64,
    /// How far the robot's own pose is off, meters.
    pub pose_error_m: f64,
    /// The agents.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub agents: Vec<AgentPose>,
}

/// The pose of an agent, `[x, y, heading]`.
pub type AgentPose = [f64; 3];

/// Times that planner and controller took.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Latencies {
    /// Of a plan: maps updated, path planned, speed planned and judged.
    pub planner: Latency,
    /// Of a command.
    pub controller: Latency,
}

/// Order statistics of times, milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Latency {
    /// How often it was measured.
    pub n: usize,
    /// The median.
    pub median_ms: f64,
    /// Of a hundred, the second longest.
    pub p99_ms: f64,
    /// The longest.
    pub worst_ms: f64,
}

impl Latency {
    /// The statistics of some times; none of no times.
    pub fn of(times: &[Duration]) -> Option<Self> {
        let mut ms: Vec<f64> = times.iter().map(|t| 1e3 * t.as_secs_f64()).collect();
        ms.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let rank = (share * ms.len() as f64).ceil().max(1.0) as usize;
            ms.get(rank - 1).copied()
        };
        Some(Self {
            n: ms.len(),
            median_ms: at(0.5)?,
            p99_ms: at(0.99)?,
            worst_ms: at(1.0)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn latencies_are_order_statistics() {
        let times: Vec<_> = (1..=200).rev().map(Duration::from_millis).collect();
        let latency = Latency::of(&times).unwrap();
        assert_eq!(latency.n, 200);
        assert_eq!(
            (latency.median_ms, latency.p99_ms, latency.worst_ms),
            (100.0, 198.0, 200.0)
        );
        assert!(Latency::of(&[]).is_none());
    }
}

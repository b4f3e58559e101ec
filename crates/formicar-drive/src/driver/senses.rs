//! What the robot makes of its observations: pose, map, what moves.

use super::config::DriverConfig;
use crate::estimate::PoseFilter;
use crate::known_map::{KnownChange, KnownMap};
use crate::lidar::Sweep;
use crate::simulation::{Observation, Track};
use formicar::Vehicle;
use formicar::scenario::{MovingObstacle, ObstacleMotion};
use formicar::tracking::DriveLimits;
use formicar::vehicle::BicycleState;
use formicar_mapping::scan::RangePolicy;
use std::collections::BTreeMap;

/// Slower than this, an agent stands, m/s.
const AGENT_STANDS_MPS: f64 = 0.1;
/// One that stands for so long is an obstacle like any other, seconds.
const STANDS_FOR_S: f64 = 1.0;
/// Ground around the robot that is taken as free where it begins, meters.
const OWN_GROUND_M: f64 = 0.1;

/// Sensor data, and what follows from it.
pub(super) struct Senses {
    known: KnownMap,
    policy: RangePolicy,
    config: DriverConfig,
    vehicle: Vehicle,
    limits: DriveLimits,
    filter: PoseFilter,
    state: BicycleState,
    t_s: Option<f64>,
    tracks: Vec<Track>,
    /// Since when each agent in sight stands.
    stands_since_s: BTreeMap<usize, f64>,
}

impl Senses {
    pub(super) fn new(
        known: KnownMap,
        vehicle: &Vehicle,
        config: &DriverConfig,
        limits: DriveLimits,
    ) -> Self {
        Self {
            known: known.with_hit_depth(config.lidar.sigma_m + 1e-3),
            policy: config.lidar.policy(),
            filter: PoseFilter::new(config.position_noise_m, config.heading_noise_rad),
            config: config.clone(),
            vehicle: vehicle.clone(),
            limits,
            state: BicycleState::default(),
            t_s: None,
            tracks: Vec::new(),
            stands_since_s: BTreeMap::new(),
        }
    }

    pub(super) fn observe(&mut self, seen: &Observation) {
        let wheels = BicycleState {
            pose: seen.pose,
            speed_mps: 0.5 * (self.state.speed_mps + seen.speed_mps),
            steer_rad: seen.steer_rad,
        };
        let elapsed_s = self.t_s.map_or(0.0, |before_s| seen.t_s - before_s);
        let pose = self
            .filter
            .update(seen.pose, wheels, &self.limits, elapsed_s);
        self.state = BicycleState {
            pose,
            speed_mps: seen.speed_mps,
            steer_rad: seen.steer_rad,
        };
        if self.t_s.is_none() {
            let body = self.vehicle.footprint().placed(pose);
            self.known.stand_on(&body.grown(OWN_GROUND_M));
        }
        self.t_s = Some(seen.t_s);
        if let Some(sweep) = &seen.sweep {
            self.tracks.clone_from(&seen.tracks);
            self.note_standing();
            self.map(sweep);
        }
    }

    fn map(&mut self, sweep: &Sweep) {
        let sensor = self.config.lidar.sensor(self.state.pose);
        let moves = |beam: usize| {
            let agent = sweep.on_agent.get(beam).copied().flatten();
            agent.is_some_and(|agent| !self.is_mapped(agent))
        };
        let skipped: Vec<bool> = (0..sweep.scan.ranges_m.len()).map(moves).collect();
        self.known
            .insert(&sweep.scan, sensor, &self.policy, &|beam| skipped[beam]);
    }

    fn note_standing(&mut self) {
        let t_s = self.t_s();
        for track in &self.tracks {
            if track.velocity_mps.norm() < AGENT_STANDS_MPS {
                self.stands_since_s.entry(track.agent).or_insert(t_s);
            } else {
                self.stands_since_s.remove(&track.agent);
            }
        }
    }

    /// True for an agent that has stood for a while.
    fn is_mapped(&self, agent: usize) -> bool {
        let since_s = self.stands_since_s.get(&agent);
        since_s.is_some_and(|since_s| self.t_s() - since_s >= STANDS_FOR_S)
    }

    pub(super) fn t_s(&self) -> f64 {
        self.t_s.unwrap_or(0.0)
    }

    pub(super) fn state(&self) -> BicycleState {
        self.state
    }

    pub(super) fn known(&self) -> &KnownMap {
        &self.known
    }

    pub(super) fn take_change(&mut self) -> Option<KnownChange> {
        self.known.take_change()
    }

    /// True if something that moves is within a distance.
    pub(super) fn has_company(&self, within_m: f64) -> bool {
        let here = self.state.pose.position();
        let apart = |track: &Track| track.pose.position().distance(here);
        self.tracks.iter().any(|track| apart(track) < within_m)
    }

    /// What moves and may come into the way within the horizon, as obstacles that keep their
    /// velocity.
    pub(super) fn predicted(&self) -> Vec<MovingObstacle> {
        let horizon_s = self.config.horizon_s;
        let own_m = self.config.limits.max_speed_mps * horizon_s;
        let here = self.state.pose.position();
        let is_felt = |track: &&Track| {
            let reach_m = own_m + track.velocity_mps.norm() * horizon_s + 1.0;
            let is_on_map = self.known.frame().cell_at(track.pose.position()).is_some();
            let apart_m = track.pose.position().distance(here);
            is_on_map && apart_m < reach_m && !self.is_mapped(track.agent)
        };
        let felt = self.tracks.iter().filter(is_felt);
        let obstacles = felt.map(|track| MovingObstacle {
            name: Some(track.name.clone()),
            shape: track.shape.clone(),
            motion: ObstacleMotion::Velocity {
                pose: [track.pose.x, track.pose.y, track.pose.heading],
                velocity_mps: [track.velocity_mps.x, track.velocity_mps.y],
            },
            growth_mps: self.config.growth_mps,
        });
        obstacles.collect()
    }
}

//! A planar lidar: exact ranges, then noise, dropouts and the robot's own body.

use crate::error::{SetupError, in_range};
use crate::solid::Solid;
use crate::world::World;
use formicar::numeric::RandomStream;
use formicar::{Point2, Pose2};
use formicar_mapping::LaserScan;
use formicar_mapping::scan::{RangePolicy, SelfMask};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// A planar lidar on a vehicle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LidarConfig {
    /// Beams of a scan, 2 to 10000.
    pub n_beams: u32,
    /// Angle from the first beam to the last, radians, above 0, at most a full turn; the middle
    /// points ahead.
    pub field_of_view_rad: f64,
    /// Shorter ranges are not reported, meters.
    pub min_m: f64,
    /// Longer ranges are not seen, meters.
    pub max_m: f64,
    /// Scans per second.
    pub rate_hz: f64,
    /// Standard deviation of ranges, meters.
    pub sigma_m: f64,
    /// Share of beams that return nothing although they hit something, 0 to 1.
    pub dropout: f64,
    /// Place of the sensor on the vehicle: ahead and left of the rear axle, meters, and its
    /// heading, radians.
    pub mount: [f64; 3],
    /// Sectors in which it sees the robot's own body.
    pub self_masks: Vec<SelfMask>,
}

impl Default for LidarConfig {
    fn default() -> Self {
        Self {
            n_beams: 720,
            field_of_view_rad: 1.5 * std::f64::consts::PI,
            min_m: 0.02,
            max_m: 30.0,
            rate_hz: 20.0,
            sigma_m: 0.01,
            dropout: 0.0,
            mount: [0.27, 0.0, 0.0],
            self_masks: Vec::new(),
        }
    }
}

/// A scan, and what its beams ended on.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The scan; infinite where nothing is in range, NaN where a beam was lost.
    pub scan: LaserScan,
    /// For each beam the agent that it ended on, if any: a stand-in for a detector.
    pub on_agent: Vec<Option<usize>>,
}

impl LidarConfig {
    /// Checks every parameter.
    ///
    /// # Errors
    /// The first out of its range.
    pub fn check(&self) -> Result<(), SetupError> {
        let beams = f64::from(self.n_beams);
        in_range("lidar n_beams", beams, 2.0..=10_000.0, "2 to 10000")?;
        let field = self.field_of_view_rad;
        in_range("lidar field_of_view_rad", field, 1e-3..=TAU, "0.001 to 2π")?;
        in_range("lidar min_m", self.min_m, 0.0..=10.0, "0 to 10 m")?;
        in_range("lidar max_m", self.max_m, 0.1..=1000.0, "0.1 to 1000 m")?;
        in_range(
            "lidar rate_hz",
            self.rate_hz,
            0.1..=1000.0,
            "0.1 to 1000 Hz",
        )?;
        in_range("lidar sigma_m", self.sigma_m, 0.0..=1.0, "0 to 1 m")?;
        in_range("lidar dropout", self.dropout, 0.0..=1.0, "0 to 1")?;
        for value in self.mount {
            in_range("lidar mount", value, -100.0..=100.0, "within 100")?;
        }
        if self.max_m > self.min_m {
            return Ok(());
        }
        Err(SetupError::Contradiction {
            what: "lidar min_m and max_m",
            problem: format!("{} m is not below {} m", self.min_m, self.max_m),
            hint: "min_m is the shortest range that is reported",
        })
    }

    /// The rule that tells its hits from everything else.
    pub fn policy(&self) -> RangePolicy {
        RangePolicy {
            min_m: self.min_m,
            max_m: self.max_m,
            no_return_m: None,
            self_masks: self.self_masks.clone(),
        }
    }

    /// The pose of the sensor of a vehicle.
    pub fn sensor(&self, vehicle: Pose2) -> Pose2 {
        let [x, y, heading] = self.mount;
        vehicle.compose(Pose2::new(x, y, heading))
    }

    fn angles(&self) -> (f64, f64) {
        let step_rad = self.field_of_view_rad / f64::from(self.n_beams - 1);
        (-0.5 * self.field_of_view_rad, step_rad)
    }

    /// A scan from the pose of a vehicle.
    pub fn sweep(
        &self,
        world: &World,
        agents: &[Solid],
        (vehicle, t_s): (Pose2, f64),
        random: &mut RandomStream,
    ) -> Sweep {
        let sensor = self.sensor(vehicle);
        let (first_angle_rad, angle_step_rad) = self.angles();
        let (mut ranges, on_agent) = self.exact(world, agents, sensor);
        for (beam, range) in ranges.iter_mut().enumerate() {
            let (noise, luck) = (random.normal(), random.unit());
            let angle_rad = first_angle_rad + angle_step_rad * beam as f64;
            *range = self.reported_m(*range, angle_rad, (noise, luck));
        }
        Sweep {
            scan: LaserScan {
                time_s: t_s,
                first_angle_rad,
                angle_step_rad,
                ranges_m: ranges.into_iter().map(|range| range as f32).collect(),
            },
            on_agent,
        }
    }

    fn reported_m(&self, exact_m: f64, angle_rad: f64, (noise, luck): (f64, f64)) -> f64 {
        let mask = self
            .self_masks
            .iter()
            .find(|mask| (mask.from_rad..=mask.to_rad).contains(&angle_rad));
        if let Some(mask) = mask.filter(|mask| exact_m > mask.up_to_m) {
            return mask.up_to_m;
        }
        if exact_m.is_infinite() {
            return exact_m;
        }
        if luck < self.dropout {
            return f64::NAN;
        }
        (exact_m + noise * self.sigma_m).max(0.0)
    }

    /// Ranges without noise, infinite where there is none, and the agents that beams end on.
    fn exact(
        &self,
        world: &World,
        agents: &[Solid],
        sensor: Pose2,
    ) -> (Vec<f64>, Vec<Option<usize>>) {
        let (first_rad, step_rad) = self.angles();
        let from = sensor.position();
        let along = |beam: usize| Point2::unit(sensor.heading + first_rad + step_rad * beam as f64);
        let n_beams = self.n_beams as usize;
        let squares = (0..n_beams).map(|beam| world.square_range_m(from, along(beam), self.max_m));
        let mut ranges: Vec<f64> = squares.map(|r| r.unwrap_or(f64::INFINITY)).collect();
        let mut on_agent = vec![None; n_beams];
        let standing = world.solids().iter().map(|solid| (None, solid));
        let moving = agents.iter().enumerate().map(|(i, solid)| (Some(i), solid));
        for (agent, solid) in standing.chain(moving) {
            for beam in self.beams_toward(solid, sensor) {
                let range_m = solid.range_m(from, along(beam));
                let range_m = range_m.filter(|&r| r < ranges[beam] && r <= self.max_m);
                if let Some(range_m) = range_m {
                    ranges[beam] = range_m;
                    on_agent[beam] = agent;
                }
            }
        }
        (ranges, on_agent)
    }

    /// The beams that may end on a solid.
    fn beams_toward(&self, solid: &Solid, sensor: Pose2) -> Vec<usize> {
        let (first_rad, step_rad) = self.angles();
        let to = solid.center() - sensor.position();
        let distance_m = to.norm();
        let n_beams = self.n_beams as usize;
        if distance_m > self.max_m + solid.reach_m() {
            return Vec::new();
        }
        if distance_m <= solid.reach_m() {
            return (0..n_beams).collect();
        }
        let half_rad = (solid.reach_m() / distance_m).asin() + 1e-9;
        let middle_rad = formicar::geometry::wrap_angle(to.angle() - sensor.heading);
        let mut beams = Vec::new();
        for turn_rad in [-TAU, 0.0, TAU] {
            let place = |rad: f64| (middle_rad + turn_rad + rad - first_rad) / step_rad;
            let low = place(-half_rad).ceil().max(0.0);
            let high = place(half_rad).floor().min(n_beams as f64 - 1.0);
            if low <= high {
                beams.extend(low as usize..=high as usize);
            }
        }
        beams
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::scenario::ObstacleShape;
    use formicar::{OccupancyGrid, Seed};

    fn hall() -> World {
        let map = OccupancyGrid::from_rows(
            &["##########", "#........#", "#........#", "##########"],
            1.0,
        );
        let post = Solid::placed(
            &ObstacleShape::Disc { radius_m: 0.2 },
            Pose2::new(3.0, 2.5, 0.0),
        );
        World::new(map.unwrap(), vec![post])
    }

    #[test]
    fn every_beam_is_the_ray_of_the_world() {
        let lidar = LidarConfig {
            sigma_m: 0.0,
            mount: [0.0; 3],
            ..LidarConfig::default()
        };
        let walker = Solid::placed(
            &ObstacleShape::Disc { radius_m: 0.3 },
            Pose2::new(6.0, 2.0, 0.0),
        );
        let (world, pose) = (hall(), Pose2::new(4.5, 1.7, 0.9));
        let mut random = Seed(1).stream([0, 0]);
        let sweep = lidar.sweep(
            &world,
            std::slice::from_ref(&walker),
            (pose, 0.0),
            &mut random,
        );
        let mut n_on_agent = 0;
        for (beam, range) in sweep.scan.ranges_m.iter().enumerate() {
            let along = Point2::unit(pose.heading + sweep.scan.angle_rad(beam));
            let standing = world.range_m(pose.position(), along, 30.0).unwrap();
            let moving = walker
                .range_m(pose.position(), along)
                .unwrap_or(f64::INFINITY);
            assert!(
                (f64::from(*range) - standing.min(moving)).abs() < 1e-5,
                "{beam}"
            );
            assert_eq!(sweep.on_agent[beam].is_some(), moving < standing, "{beam}");
            n_on_agent += usize::from(sweep.on_agent[beam].is_some());
        }
        assert!(n_on_agent > 20);
    }

    #[test]
    fn noise_dropouts_and_the_own_body_are_as_stated() {
        let mask = SelfMask {
            from_rad: -0.2,
            to_rad: 0.2,
            up_to_m: 0.1,
        };
        let lidar = LidarConfig {
            sigma_m: 0.05,
            dropout: 0.2,
            self_masks: vec![mask],
            ..LidarConfig::default()
        };
        let exact = LidarConfig {
            sigma_m: 0.0,
            dropout: 0.0,
            self_masks: Vec::new(),
            ..lidar.clone()
        };
        let pose = (Pose2::new(4.5, 1.7, 0.0), 0.0);
        let (mut squares, mut n, mut n_lost) = (0.0, 0, 0);
        for scan in 0..20 {
            let mut random = Seed(3).stream([1, scan]);
            let seen = lidar.sweep(&hall(), &[], pose, &mut random).scan;
            let truth = exact.sweep(&hall(), &[], pose, &mut random).scan;
            for (beam, (seen, truth)) in seen.ranges_m.iter().zip(&truth.ranges_m).enumerate() {
                let own = (-0.2..=0.2).contains(&truth_angle(&exact, beam));
                if own {
                    assert_eq!(*seen, 0.1);
                } else if seen.is_nan() {
                    n_lost += 1;
                } else {
                    squares += f64::from(seen - truth).powi(2);
                    n += 1;
                }
            }
        }
        let sigma_m = (squares / f64::from(n)).sqrt();
        assert!((sigma_m - 0.05).abs() < 0.002, "{sigma_m}");
        let share = f64::from(n_lost) / f64::from(n + n_lost);
        assert!((share - 0.2).abs() < 0.02, "{share}");
    }

    fn truth_angle(lidar: &LidarConfig, beam: usize) -> f64 {
        let (first, step) = lidar.angles();
        first + step * beam as f64
    }

    #[test]
    fn parameters_out_of_range_are_named() {
        let bad = LidarConfig {
            max_m: 0.0,
            ..LidarConfig::default()
        };
        assert!(
            bad.check()
                .unwrap_err()
                .to_string()
                .contains("lidar max_m = 0")
        );
        let bad = LidarConfig {
            sigma_m: f64::NAN,
            ..LidarConfig::default()
        };
        assert!(
            bad.check()
                .unwrap_err()
                .to_string()
                .contains("lidar sigma_m = NaN")
        );
    }
}

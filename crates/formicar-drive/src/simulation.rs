//! The simulation: a command in, an observation out.

use crate::agents::{Agent, Crowd, Surroundings};
use crate::contact::{Contact, Contacted, Other, closing_mps, contact, encounter, nearness};
use crate::error::{SetupError, in_range};
use crate::lidar::{LidarConfig, Sweep};
use crate::limits::drive_limits;
use crate::random::{Draw, stream};
use crate::solid::{Nearness, Solid};
use crate::world::World;
use formicar::collision::{Body, Drive};
use formicar::scenario::ObstacleShape;
use formicar::tracking::{ActuatedVehicle, Actuators, DriveCommand, DriveLimits};
use formicar::vehicle::BicycleState;
use formicar::{Point2, Pose2, Seed, Vehicle};
use serde::{Deserialize, Serialize};

/// Steps of the vehicle in a control period.
const N_SUBSTEPS: u32 = 4;
/// Scans and control periods are matched to this, seconds.
const SAME_S: f64 = 1e-9;

/// Sensors, actuators and seed of a simulation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SimulationConfig {
    /// Seed of noise and agents.
    pub seed: Seed,
    /// The lidar.
    pub lidar: LidarConfig,
    /// Standard deviation of a measured position, per axis, meters; drawn anew per reading.
    pub position_noise_m: f64,
    /// Standard deviation of a measured heading, radians.
    pub heading_noise_rad: f64,
    /// Delay, acceleration and control period; brakes are as strong as the motor where left out.
    pub actuators: Actuators,
    /// Fastest change of the steering angle, rad/s; that of the vehicle where left out.
    pub max_steer_rate_rad_per_s: Option<f64>,
}

impl Default for SimulationConfig {
    fn default() -> Self {
        Self {
            seed: Seed(1),
            lidar: LidarConfig::default(),
            position_noise_m: 0.0,
            heading_noise_rad: 0.0,
            actuators: Actuators::default(),
            max_steer_rate_rad_per_s: None,
        }
    }
}

impl SimulationConfig {
    /// Checks every parameter but those of the actuators, which need a vehicle.
    ///
    /// # Errors
    /// The first out of its range.
    pub fn check(&self) -> Result<(), SetupError> {
        self.lidar.check()?;
        in_range(
            "position_noise_m",
            self.position_noise_m,
            0.0..=10.0,
            "0 to 10 m",
        )?;
        in_range(
            "heading_noise_rad",
            self.heading_noise_rad,
            0.0..=1.0,
            "0 to 1 rad",
        )?;
        if let Some(rate) = self.max_steer_rate_rad_per_s {
            in_range(
                "max_steer_rate_rad_per_s",
                rate,
                1e-3..=100.0,
                "0.001 to 100 rad/s",
            )?;
        }
        Ok(())
    }
}

/// What the robot gets to know in a control period.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Observation {
    /// Time, seconds.
    pub t_s: f64,
    /// The measured pose.
    pub pose: Pose2,
    /// Speed by the wheels, m/s, negative in reverse.
    pub speed_mps: f64,
    /// Steering angle of the virtual middle wheel, radians.
    pub steer_rad: f64,
    /// A scan, where one is due.
    pub sweep: Option<Sweep>,
    /// Agents on which at least two beams of the last scan ended.
    pub tracks: Vec<Track>,
}

/// An agent in sight, as a tracker would report it. Tracking itself is not simulated: shape, pose and
/// velocity are true.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Its number, as in [`Sweep::on_agent`].
    pub agent: usize,
    /// Its name, or its number counted from 1.
    pub name: String,
    /// Its body.
    pub shape: ObstacleShape,
    /// Its pose.
    pub pose: Pose2,
    /// Its velocity along the axes of the map, m/s.
    pub velocity_mps: Point2,
}

/// A simulated world with a robot in it.
#[derive(Clone, Debug)]
pub struct Simulation {
    config: SimulationConfig,
    world: World,
    crowd: Crowd,
    vehicle: Vehicle,
    body: Body,
    robot: ActuatedVehicle,
    n_steps: u64,
    next_scan_s: f64,
    tracks: Vec<Track>,
    contacts: Vec<Contact>,
    /// For each agent, true while it touches the robot.
    touching: Vec<bool>,
    driven_m: f64,
    min_static_distance_m: f64,
    min_agent_distance_m: Option<f64>,
    min_time_to_collision_s: Option<f64>,
}

impl Simulation {
    /// A robot that stands in a world without agents.
    ///
    /// # Errors
    /// Parameters out of range, a vehicle that is not a car, or a start off the map or in contact.
    pub fn new(
        world: World,
        vehicle: &Vehicle,
        start: Pose2,
        config: &SimulationConfig,
    ) -> Result<Self, SetupError> {
        config.check()?;
        let limits = drive_limits(vehicle, &config.actuators, config.max_steer_rate_rad_per_s)?;
        let vehicle = crate::limits::with_margin(vehicle, 0.0)?;
        check_start(&world, &vehicle, start)?;
        let state = BicycleState {
            pose: start,
            ..BicycleState::default()
        };
        Ok(Self {
            crowd: Crowd::new(Vec::new(), config.seed)?,
            body: Body::new(&vehicle),
            robot: ActuatedVehicle::new(limits, state),
            config: config.clone(),
            world,
            vehicle,
            n_steps: 0,
            next_scan_s: 0.0,
            tracks: Vec::new(),
            contacts: Vec::new(),
            touching: Vec::new(),
            driven_m: 0.0,
            min_static_distance_m: f64::INFINITY,
            min_agent_distance_m: None,
            min_time_to_collision_s: None,
        })
    }

    /// The same with agents.
    ///
    /// # Errors
    /// An agent that makes no sense, or that begins off the map, in an obstacle or inside the robot.
    pub fn with_agents(self, agents: Vec<Agent>) -> Result<Self, SetupError> {
        let crowd = Crowd::new(agents, self.config.seed)?;
        crowd.check_at(&Surroundings {
            world: &self.world,
            robot: &self.robot_parts(),
        })?;
        Ok(Self {
            touching: vec![false; crowd.len()],
            crowd,
            ..self
        })
    }

    /// The robot's first observation, before anything has moved.
    pub fn observe(&mut self) -> Observation {
        let state = self.robot.state();
        let t_s = self.t_s();
        let sweep = (t_s >= self.next_scan_s - SAME_S).then(|| self.sweep());
        let mut random = stream(self.config.seed, Draw::Pose, [0, self.n_steps]);
        let mut noise = || self.config.position_noise_m * random.normal();
        let (x, y) = (state.pose.x + noise(), state.pose.y + noise());
        let turn_rad = self.config.heading_noise_rad * random.normal();
        Observation {
            t_s,
            pose: Pose2::new(x, y, state.pose.heading + turn_rad).wrapped(),
            speed_mps: state.speed_mps,
            steer_rad: state.steer_rad,
            sweep,
            tracks: self.tracks.clone(),
        }
    }

    /// Gives the robot a command, moves everything for a control period, and observes.
    pub fn step(&mut self, command: DriveCommand) -> Observation {
        self.robot.give(command);
        let period_s = self.limits().control_period_s;
        let before = self.crowd.poses();
        let t_s = self.t_s();
        self.move_agents((t_s, period_s));
        let after = self.crowd.poses();
        for substep in 0..N_SUBSTEPS {
            let share = |i: u32| f64::from(i) / f64::from(N_SUBSTEPS);
            let drive = self.robot.step(period_s / f64::from(N_SUBSTEPS));
            self.driven_m += drive.signed_length_m.abs();
            self.meet_standing(&drive);
            let part = [share(substep), share(substep + 1)];
            for agent in 0..self.crowd.len() {
                let [from, to] = part.map(|share| between(before[agent], after[agent], share));
                self.meet_agent(&drive, agent, [from, to]);
            }
        }
        self.n_steps += 1;
        self.observe()
    }

    fn move_agents(&mut self, span: (f64, f64)) {
        let robot = self.robot_parts();
        let around = Surroundings {
            world: &self.world,
            robot: &robot,
        };
        self.crowd.step(&around, span);
    }

    fn robot_parts(&self) -> Vec<Solid> {
        let pose = self.robot.state().pose;
        let parts = self.vehicle.parts().iter();
        parts.map(|part| Solid::part(part, pose)).collect()
    }

    fn sweep(&mut self) -> Sweep {
        let scan = (self.t_s() * self.config.lidar.rate_hz).round() as u64;
        let mut random = stream(self.config.seed, Draw::Scan, [0, scan]);
        let at = (self.robot.state().pose, self.t_s());
        let agents = self.crowd.solids();
        let sweep = self
            .config
            .lidar
            .sweep(&self.world, &agents, at, &mut random);
        self.next_scan_s += 1.0 / self.config.lidar.rate_hz;
        let poses = self.crowd.poses();
        let seen = (0..self.crowd.len()).filter(|&agent| {
            let on = sweep.on_agent.iter().filter(|&&on| on == Some(agent));
            on.count() >= 2
        });
        self.tracks = seen
            .map(|agent| Track {
                agent,
                name: self.crowd.name(agent).to_owned(),
                shape: self.crowd.agent(agent).shape.clone(),
                pose: poses[agent],
                velocity_mps: self.crowd.velocity_mps(agent),
            })
            .collect();
        sweep
    }

    /// Looks at squares and solids along a short drive.
    fn meet_standing(&mut self, drive: &Drive) {
        let obstacles = self.world.obstacles();
        let in_grid = Drive {
            start: obstacles.frame().to_grid(drive.start),
            ..*drive
        };
        let limit_m = self.min_static_distance_m;
        let clearance_m = obstacles.drive_clearance_m(&self.body, &in_grid, limit_m);
        self.min_static_distance_m = self.min_static_distance_m.min(clearance_m);
        if clearance_m <= formicar::collision::MIN_CLEARANCE_M
            && !obstacles.is_free(&self.body, &in_grid)
        {
            let place = obstacles.contact(&self.vehicle, self.robot.state().pose);
            let way = place - self.robot.state().pose.position();
            let near = Nearness {
                gap_m: 0.0,
                from: place,
                to: place,
                along: way * (1.0 / way.norm().max(f64::MIN_POSITIVE)),
            };
            self.touch(Contacted::Square, &near, Point2::default());
        }
        let reach_m = self.vehicle.footprint().circumradius() + drive.signed_length_m.abs();
        let mut found = None;
        for solid in self.world.solids() {
            let apart_m = solid.center().distance(drive.start.position());
            let bound_m = apart_m - solid.reach_m() - reach_m;
            if bound_m >= self.min_static_distance_m && bound_m > 0.0 {
                continue;
            }
            let meeting = encounter(&self.vehicle, drive, &Other::Standing(solid));
            let gap_m = meeting.nearness.gap_m;
            self.min_static_distance_m = self.min_static_distance_m.min(gap_m);
            if meeting.touches_at.is_some() {
                found = Some(meeting.nearness);
            }
        }
        if let Some(near) = found {
            self.touch(Contacted::Solid, &near, Point2::default());
        }
    }

    /// Looks at an agent along a short drive.
    fn meet_agent(&mut self, drive: &Drive, agent: usize, [from, to]: [Pose2; 2]) {
        /// Agents farther away than this are not looked at closely, meters.
        const NEAR_M: f64 = 5.0;
        let reach_m = self.vehicle.footprint().circumradius();
        let shape = self.crowd.agent(agent).shape.clone();
        let apart_m = from.position().distance(drive.start.position());
        let solid = Solid::placed(&shape, to);
        if apart_m - reach_m - solid.reach_m() > NEAR_M {
            return;
        }
        let shape = &shape;
        let meeting = encounter(&self.vehicle, drive, &Other::Moving { shape, from, to });
        let gap_m = meeting.nearness.gap_m;
        let least_m = self.min_agent_distance_m.unwrap_or(f64::INFINITY);
        self.min_agent_distance_m = Some(least_m.min(gap_m));
        let velocity = self.crowd.velocity_mps(agent);
        self.note_time_to_collision(&solid, velocity);
        let touches = meeting.touches_at.is_some();
        if touches && !self.touching[agent] {
            let name = self.crowd.name(agent).to_owned();
            self.touch(Contacted::Agent(name), &meeting.nearness, velocity);
        }
        self.touching[agent] = touches;
    }

    fn note_time_to_collision(&mut self, solid: &Solid, velocity: Point2) {
        let state = self.robot.state();
        let near = nearness(&self.vehicle, state.pose, solid);
        let [own, other] = closing_mps(state, self.limits().wheelbase_m, &near, velocity);
        if own + other > 0.0 && state.speed_mps != 0.0 {
            let time_s = near.gap_m / (own + other);
            let least_s = self.min_time_to_collision_s.unwrap_or(f64::INFINITY);
            self.min_time_to_collision_s = Some(least_s.min(time_s));
        }
    }

    fn touch(&mut self, with: Contacted, near: &Nearness, velocity: Point2) {
        let robot = (self.robot.state(), self.limits().wheelbase_m);
        let touch = contact(robot, with, near, (velocity, self.t_s()));
        self.contacts.push(touch);
    }

    /// What the vehicle can do.
    pub fn limits(&self) -> &DriveLimits {
        self.robot.limits()
    }

    /// Time, seconds.
    pub fn t_s(&self) -> f64 {
        self.n_steps as f64 * self.limits().control_period_s
    }

    /// The robot's true state.
    pub fn state(&self) -> BicycleState {
        self.robot.state()
    }

    /// The vehicle, without a margin.
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// What stands.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The agents and their names.
    pub fn agents(&self) -> impl Iterator<Item = (&str, &Agent)> {
        (0..self.crowd.len()).map(|i| (self.crowd.name(i), self.crowd.agent(i)))
    }

    /// The poses of the agents.
    pub fn agent_poses(&self) -> Vec<Pose2> {
        self.crowd.poses()
    }

    /// All contacts so far; that of an agent once for as long as it lasts.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// The length driven, meters.
    pub fn driven_m(&self) -> f64 {
        self.driven_m
    }

    /// Least distance from what stands, meters: exact from squares and border.
    pub fn min_static_distance_m(&self) -> f64 {
        self.min_static_distance_m
    }

    /// Least distance from an agent, meters; none where none came near.
    pub fn min_agent_distance_m(&self) -> Option<f64> {
        self.min_agent_distance_m
    }

    /// Least time to a collision with an agent, seconds: the gap over the speed with which it
    /// closed, while the robot drove.
    pub fn min_time_to_collision_s(&self) -> Option<f64> {
        self.min_time_to_collision_s
    }
}

fn between(from: Pose2, to: Pose2, share: f64) -> Pose2 {
    let turn_rad = formicar::geometry::angle_difference(to.heading, from.heading);
    Pose2::at(
        from.position().lerp(to.position(), share),
        from.heading + share * turn_rad,
    )
}

fn check_start(world: &World, vehicle: &Vehicle, start: Pose2) -> Result<(), SetupError> {
    let fault = |problem: String, hint: &str| SetupError::Pose {
        which: "start",
        x: start.x,
        y: start.y,
        problem,
        hint: hint.to_owned(),
    };
    if !start.is_finite() {
        return Err(fault(
            "is not finite".to_owned(),
            "give x, y, heading as numbers",
        ));
    }
    let obstacles = world.obstacles();
    if obstacles.frame().cell_at(start.position()).is_none() {
        return Err(fault(
            "lies outside the map".to_owned(),
            "check frame and units",
        ));
    }
    let at = Drive::at(obstacles.frame().to_grid(start));
    let in_solid = |solid: &Solid| nearness(vehicle, start, solid).gap_m == 0.0;
    if !obstacles.is_free(&Body::new(vehicle), &at) || world.solids().iter().any(in_solid) {
        let problem = "touches an obstacle".to_owned();
        return Err(fault(problem, "start where the vehicle stands free"));
    }
    Ok(())
}

//! All agents of a world, moved together.

use super::document::{Agent, AgentBehavior, pose_of};
use super::surroundings::Surroundings;
use super::walker::Walk;
use crate::error::SetupError;
use crate::random::{Draw, stream};
use crate::solid::Solid;
use crate::world::World;
use formicar::map::{DiagonalRule, line_of_sight};
use formicar::numeric::RandomStream;
use formicar::scenario::Predicted;
use formicar::{OccupancyGrid, Point2, Pose2, Seed, Vehicle};

/// Where walkers go next, meters from where they are.
const STROLL_M: [f64; 2] = [1.5, 8.0];
/// A walker so near to the target has arrived, meters.
const THERE_M: f64 = 0.3;
/// Draws for a place before a walker waits for better luck.
const N_DRAWS: usize = 30;
/// A cart that yields stops so far before the robot, meters.
const CART_GAP_M: f64 = 0.8;

/// The agents of a world.
#[derive(Clone, Debug)]
pub(crate) struct Crowd {
    members: Vec<Member>,
    seed: Seed,
    n_steps: u64,
}

/// An agent with its state.
#[derive(Clone, Debug)]
struct Member {
    agent: Agent,
    name: String,
    /// The motion of one that is scripted; of others, where they begin.
    script: Predicted,
    pose: Pose2,
    velocity_mps: Point2,
    target: Point2,
    /// The way point that a cart drives to, and whether it is on its way back.
    leg: (usize, bool),
}

impl Crowd {
    pub(crate) fn new(agents: Vec<Agent>, seed: Seed) -> Result<Self, SetupError> {
        let members = agents.into_iter().enumerate().map(|(i, agent)| {
            let number = (i + 1).to_string();
            agent.check(&number)?;
            let script = agent.predicted(&number)?;
            let pose = script.pose_at(0.0);
            Ok(Member {
                name: agent.name.clone().unwrap_or(number),
                target: pose.position(),
                velocity_mps: Point2::default(),
                leg: (1, false),
                agent,
                script,
                pose,
            })
        });
        Ok(Self {
            members: members.collect::<Result<_, SetupError>>()?,
            seed,
            n_steps: 0,
        })
    }

    pub(crate) fn len(&self) -> usize {
        self.members.len()
    }

    pub(crate) fn name(&self, i: usize) -> &str {
        &self.members[i].name
    }

    pub(crate) fn agent(&self, i: usize) -> &Agent {
        &self.members[i].agent
    }

    pub(crate) fn poses(&self) -> Vec<Pose2> {
        self.members.iter().map(|member| member.pose).collect()
    }

    pub(crate) fn velocity_mps(&self, i: usize) -> Point2 {
        self.members[i].velocity_mps
    }

    pub(crate) fn solids(&self) -> Vec<Solid> {
        self.members.iter().map(Member::solid).collect()
    }

    /// Checks that every agent begins on the map, outside of obstacles and of the robot.
    pub(crate) fn check_at(&self, around: &Surroundings) -> Result<(), SetupError> {
        for member in &self.members {
            let place = member.pose.position();
            let fault = |problem, hint| SetupError::Agent {
                agent: member.name.clone(),
                x: place.x,
                y: place.y,
                problem,
                hint,
            };
            let map = around.world.map();
            let Some(cell) = map.frame().cell_at(place) else {
                return Err(fault("begins off the map", "check frame and units"));
            };
            let walks = matches!(member.agent.behavior, AgentBehavior::Walker { .. });
            if walks && map.is_lethal(cell) {
                return Err(fault(
                    "begins in an obstacle",
                    "walkers keep to free ground",
                ));
            }
            let body = member.solid();
            if around
                .robot
                .iter()
                .any(|part| part.nearness(&body).gap_m == 0.0)
            {
                return Err(fault(
                    "begins inside the robot",
                    "put it elsewhere, or start the robot elsewhere",
                ));
            }
        }
        Ok(())
    }

    /// Moves everyone for a time, each by what the others did before.
    pub(crate) fn step(&mut self, around: &Surroundings, (t_s, duration_s): (f64, f64)) {
        let before = self.solids();
        for (i, member) in self.members.iter_mut().enumerate() {
            let random = stream(self.seed, Draw::Walker, [i as u64, self.n_steps]);
            let others = before.iter().enumerate().filter(|(j, _)| *j != i);
            let others: Vec<&Solid> = others.map(|(_, solid)| solid).collect();
            member.step(&others, around, (t_s, duration_s), random);
        }
        self.n_steps += 1;
    }
}

impl Member {
    fn solid(&self) -> Solid {
        Solid::placed(&self.agent.shape, self.pose)
    }

    fn step(
        &mut self,
        others: &[&Solid],
        around: &Surroundings,
        (t_s, duration_s): (f64, f64),
        random: RandomStream,
    ) {
        let before = self.pose;
        match self.agent.behavior.clone() {
            AgentBehavior::Scripted(_) | AgentBehavior::Velocity { .. } => {
                self.pose = self.script.pose_at(t_s + duration_s);
            }
            AgentBehavior::Walker {
                speed_mps, yields, ..
            } => {
                self.walk(others, around, (speed_mps, yields, duration_s), random);
            }
            AgentBehavior::Cart {
                waypoints,
                speed_mps,
                yields,
            } => self.roll(&waypoints, around, (speed_mps * duration_s, yields)),
        }
        self.velocity_mps = (self.pose.position() - before.position()) * (1.0 / duration_s);
    }

    fn walk(
        &mut self,
        others: &[&Solid],
        around: &Surroundings,
        (speed_mps, yields, duration_s): (f64, bool, f64),
        mut random: RandomStream,
    ) {
        let body = self.solid();
        if self.pose.position().distance(self.target) < THERE_M {
            let next = next_target(around.world, &body, &mut random);
            self.target = next.unwrap_or(self.target);
        }
        let walk = Walk {
            body: &body,
            velocity_mps: self.velocity_mps,
            target: self.target,
            speed_mps,
            yields,
        };
        let velocity = walk.next_velocity_mps(others.iter().copied(), around, duration_s);
        let place = self.pose.position() + velocity * duration_s;
        let heading = if velocity.norm() > 0.05 {
            velocity.angle()
        } else {
            self.pose.heading
        };
        let pose = pose_of(place, heading);
        if is_open(around, &Solid::placed(&self.agent.shape, pose), &body) {
            self.pose = pose;
        } else {
            // Up against something: another way from here.
            self.target = self.pose.position();
        }
    }

    fn roll(&mut self, line: &[[f64; 2]], around: &Surroundings, (way_m, yields): (f64, bool)) {
        let body = self.solid();
        let ahead = Point2::unit(self.pose.heading);
        let is_in_way = |part: &Solid| {
            let near = body.nearness(part);
            near.gap_m < CART_GAP_M && ahead.dot(part.center() - body.center()) > 0.0
        };
        let stops = yields && around.robot.iter().any(is_in_way);
        let touches = around
            .robot
            .iter()
            .any(|part| body.nearness(part).gap_m == 0.0);
        if stops || touches {
            return;
        }
        let mut left_m = way_m;
        for _ in 0..line.len() {
            let (next, is_back) = self.leg;
            let [x, y] = line[next.min(line.len() - 1)];
            let way = Point2::new(x, y) - self.pose.position();
            if way.norm() > left_m {
                let along = way * (1.0 / way.norm());
                self.pose = pose_of(self.pose.position() + along * left_m, along.angle());
                return;
            }
            left_m -= way.norm();
            self.pose = pose_of(Point2::new(x, y), self.pose.heading);
            self.leg = match (next, is_back) {
                (0, true) => (1, false),
                (i, false) if i + 1 < line.len() => (i + 1, false),
                (i, _) => (i - 1, true),
            };
        }
    }
}

/// True where a walker may step: on the map, off obstacles, and not farther into the robot.
fn is_open(around: &Surroundings, next: &Solid, now: &Solid) -> bool {
    let world = around.world;
    let is_robot_clear = around.robot.iter().all(|part| {
        let gap_m = next.nearness(part).gap_m;
        gap_m > 0.0 || gap_m > now.nearness(part).gap_m
    });
    is_robot_clear && is_ground(world, next)
}

/// True where a body stands on free ground: off squares, by the distance transform, and off solids.
fn is_ground(world: &World, body: &Solid) -> bool {
    let frame = world.map().frame();
    let Some(cell) = frame.cell_at(body.center()) else {
        return false;
    };
    let distance_m = world.obstacles().distance().distance_cells(cell) * frame.resolution_m();
    let is_off_squares = distance_m > body.reach_m() + frame.resolution_m();
    let is_off = |solid: &Solid| solid.gap_bound_m(body) > 0.0 || solid.nearness(body).gap_m > 0.0;
    is_off_squares && world.solids().iter().all(is_off)
}

/// A random place in sight that a walker can stand at.
fn next_target(world: &World, body: &Solid, random: &mut RandomStream) -> Option<Point2> {
    let frame = world.map().frame();
    let cells = |p: Point2| {
        let local = frame.to_grid(Pose2::at(p, 0.0)).position();
        local * (1.0 / frame.resolution_m())
    };
    let lethal = world.obstacles().lethal();
    (0..N_DRAWS).find_map(|_| {
        let [low, high] = STROLL_M;
        let way = Point2::unit(random.range(-std::f64::consts::PI, std::f64::consts::PI));
        let place = body.center() + way * random.range(low, high);
        let there = Solid::placed(
            &formicar::scenario::ObstacleShape::Disc {
                radius_m: body.reach_m(),
            },
            Pose2::at(place, 0.0),
        );
        let sees = || {
            let rule = DiagonalRule::NoObstacles;
            line_of_sight(lethal, rule, cells(body.center()), cells(place))
        };
        (is_ground(world, &there) && sees()).then_some(place)
    })
}

/// Walkers at random free places, at least a distance from a pose; every other one yields.
///
/// Fewer than asked for where the map has no room for them.
pub fn random_walkers(
    map: &OccupancyGrid,
    vehicle: &Vehicle,
    start: Pose2,
    (n, seed): (usize, Seed),
) -> Vec<Agent> {
    /// Nobody begins nearer to the robot, meters beyond its reach.
    const ROOM_M: f64 = 1.5;
    let world = World::new(map.clone(), Vec::new());
    let room_m = ROOM_M + vehicle.footprint().circumradius();
    let (frame, extent) = (map.frame(), map.frame().extent_m());
    let mut agents: Vec<Agent> = Vec::new();
    let mut bodies: Vec<Solid> = Vec::new();
    for draw in 0..1000 * n {
        if agents.len() == n {
            break;
        }
        let mut random = stream(seed, Draw::Crowd, [0, draw as u64]);
        let local = Point2::new(random.range(0.0, extent.x), random.range(0.0, extent.y));
        let place = frame.to_world(Pose2::at(local, 0.0)).position();
        let speed_mps = random.range(0.6, 1.4);
        let agent = Agent::walker(place, speed_mps, agents.len().is_multiple_of(2));
        let body = Solid::placed(&agent.shape, Pose2::at(place, 0.0));
        let is_far = place.distance(start.position()) > room_m;
        let is_alone = bodies.iter().all(|other| other.gap_bound_m(&body) > 0.1);
        if is_far && is_alone && is_ground(&world, &body) {
            agents.push(agent);
            bodies.push(body);
        }
    }
    agents
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::scenario::ObstacleShape;

    fn hall() -> World {
        World::new(
            OccupancyGrid::from_rows(&[".................................."; 24], 0.25).unwrap(),
            Vec::new(),
        )
    }

    fn robot(at: Pose2) -> Vec<Solid> {
        let vehicle = Vehicle::warehouse_amr();
        vehicle
            .parts()
            .iter()
            .map(|part| Solid::part(part, at))
            .collect()
    }

    fn walked(seed: u64, yields: bool) -> (Vec<Pose2>, f64) {
        let (world, at) = (hall(), Pose2::new(4.0, 3.0, 0.0));
        let parts = robot(at);
        let around = Surroundings {
            world: &world,
            robot: &parts,
        };
        let agents = random_walkers(world.map(), &Vehicle::warehouse_amr(), at, (12, Seed(seed)));
        let agents = agents.into_iter().map(|agent| {
            let AgentBehavior::Walker {
                position: [x, y],
                speed_mps,
                ..
            } = agent.behavior
            else {
                unreachable!("walkers alone")
            };
            Agent::walker(Point2::new(x, y), speed_mps, yields)
        });
        let mut crowd = Crowd::new(agents.collect(), Seed(seed)).unwrap();
        assert_eq!(crowd.len(), 12);
        crowd.check_at(&around).unwrap();
        let mut least_m = f64::INFINITY;
        for step in 0..1500 {
            crowd.step(&around, (0.02 * f64::from(step), 0.02));
            for body in crowd.solids() {
                assert!(
                    is_ground(&world, &body),
                    "a walker in a wall or off the map"
                );
                let gaps = parts.iter().map(|part| part.nearness(&body).gap_m);
                least_m = gaps.fold(least_m, f64::min);
            }
        }
        (crowd.poses(), least_m)
    }

    #[test]
    fn walkers_stay_on_free_ground_and_go_somewhere() {
        let (poses, _) = walked(4, true);
        let again = walked(4, true).0;
        assert_eq!(poses, again);
        assert_ne!(poses, walked(5, true).0);
    }

    #[test]
    fn those_who_yield_keep_more_distance() {
        let least = |yields| {
            (1..4)
                .map(|seed| walked(seed, yields).1)
                .fold(f64::INFINITY, f64::min)
        };
        let (polite_m, rude_m) = (least(true), least(false));
        assert!(polite_m > 0.1 && polite_m > rude_m, "{polite_m} {rude_m}");
    }

    #[test]
    fn a_cart_drives_its_line_to_and_fro_and_may_stop() {
        let cart = |yields| Agent {
            name: Some("cart".to_owned()),
            shape: ObstacleShape::Polygon(vec![[-0.4, -0.3], [0.4, -0.3], [0.4, 0.3], [-0.4, 0.3]]),
            behavior: AgentBehavior::Cart {
                waypoints: vec![[1.0, 3.0], [7.0, 3.0]],
                speed_mps: 1.0,
                yields,
            },
        };
        let world = hall();
        let far = robot(Pose2::new(4.0, 1.0, 0.0));
        let mut crowd = Crowd::new(vec![cart(true)], Seed(1)).unwrap();
        let around = Surroundings {
            world: &world,
            robot: &far,
        };
        for step in 0..400 {
            crowd.step(&around, (0.02 * f64::from(step), 0.02));
        }
        // 8 m: there, and 2 m back.
        assert!(
            (crowd.poses()[0].x - 5.0).abs() < 1e-6,
            "{:?}",
            crowd.poses()
        );
        let near = robot(Pose2::new(4.0, 3.0, 0.0));
        let around = Surroundings {
            world: &world,
            robot: &near,
        };
        let mut crowd = Crowd::new(vec![cart(true)], Seed(1)).unwrap();
        for step in 0..400 {
            crowd.step(&around, (0.02 * f64::from(step), 0.02));
        }
        assert!(crowd.poses()[0].x < 3.0);
        assert_eq!(crowd.velocity_mps(0), Point2::default());
    }

    #[test]
    fn agents_off_the_map_or_in_the_robot_are_refused() {
        let (world, parts) = (hall(), robot(Pose2::new(4.0, 3.0, 0.0)));
        let around = Surroundings {
            world: &world,
            robot: &parts,
        };
        let fault = |x: f64, y: f64| {
            let crowd = Crowd::new(vec![Agent::walker(Point2::new(x, y), 1.0, true)], Seed(1));
            crowd.unwrap().check_at(&around).unwrap_err().to_string()
        };
        assert!(fault(-3.0, 1.0).contains("off the map"));
        assert!(fault(4.3, 3.1).contains("inside the robot"));
    }
}

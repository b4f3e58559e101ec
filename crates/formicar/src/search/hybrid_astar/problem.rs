//! One query of hybrid A*: what moves are there, what they cost, which are free.

use super::HybridAstarConfig;
use super::tree::Node;
use crate::collision::{Body, Drive, MIN_CLEARANCE_M, ObstacleMap};
use crate::geometry::{Arc, Pose2, angle_difference};
use crate::layers::SoftCosts;
use crate::map::Cell;
use crate::scenario::{GoalTolerance, MotionMode, Request};
use crate::vehicle::{Gears, PrimitiveSet, Vehicle, VehicleError};

/// A step leads out of its state: it is longer than the state's diagonal.
const STATES_PER_STEP: f64 = 1.5;

fn gears(request: &Request) -> Gears {
    match request.motion {
        MotionMode::Forward => Gears::Forward,
        MotionMode::Reverse => Gears::Both,
    }
}

/// A request on a map for a vehicle, in grid coordinates.
#[derive(Clone)]
pub struct HybridProblem<'a> {
    obstacles: &'a ObstacleMap,
    vehicle: &'a Vehicle,
    body: Body,
    config: &'a HybridAstarConfig,
    lattice: PrimitiveSet,
    state_m: f64,
    radius_m: f64,
    axle_inradius_m: f64,
    request: &'a Request,
    /// +1, or -1 where the search runs from the goal and every motion will be driven backwards.
    sense: f64,
    starts: Vec<Pose2>,
    goals: Vec<Pose2>,
    soft_costs: Option<&'a SoftCosts>,
}

impl<'a> HybridProblem<'a> {
    /// Prepares a query: the lattice, and the poses that the heading modes allow.
    ///
    /// # Errors
    /// A vehicle that does not steer.
    pub fn new(
        obstacles: &'a ObstacleMap,
        vehicle: &'a Vehicle,
        config: &'a HybridAstarConfig,
        request: &'a Request,
    ) -> Result<Self, VehicleError> {
        let resolution_m = obstacles.frame().resolution_m();
        let radius_m = vehicle.min_turning_radius_m();
        // A cell of the map may be larger than the turning circle: half of that is the longest.
        let step_m = (config.step_radii * radius_m)
            .max(1.5 * resolution_m)
            .min(3.0 * radius_m);
        let n_headings = config.angle_quantization_bins as usize;
        let mut problem = Self {
            obstacles,
            vehicle,
            body: Body::new(vehicle),
            config,
            lattice: PrimitiveSet::new(vehicle, n_headings, step_m, gears(request))?,
            state_m: step_m / STATES_PER_STEP,
            radius_m,
            axle_inradius_m: vehicle.footprint().inradius().max(0.0),
            request,
            sense: 1.0,
            starts: Vec::new(),
            goals: Vec::new(),
            soft_costs: None,
        };
        let to_grid = |poses: Vec<Pose2>| poses.into_iter().map(|p| obstacles.frame().to_grid(p));
        let stands_free = |pose: &Pose2| obstacles.is_free(&problem.body, &Drive::at(*pose));
        let starts = to_grid(request.start_poses()).filter(stands_free).collect();
        let goals = to_grid(request.goal_poses()).filter(stands_free).collect();
        (problem.starts, problem.goals) = (starts, goals);
        Ok(problem)
    }

    /// The same query with a preference for some ground over other, on the frame of the map.
    #[must_use]
    pub fn with_soft_costs(self, soft_costs: Option<&'a SoftCosts>) -> Self {
        Self { soft_costs, ..self }
    }

    /// The same query on a lattice of steps a quarter as long and headings four times as dense,
    /// for places where a vehicle must shunt.
    pub(super) fn refined(&self) -> Self {
        let n_headings = (4 * self.lattice.n_headings()).min(360);
        let step_m =
            (0.25 * self.state_m * STATES_PER_STEP).max(self.obstacles.frame().resolution_m());
        let lattice = PrimitiveSet::new(self.vehicle, n_headings, step_m, gears(self.request));
        match lattice {
            Ok(lattice) => Self {
                lattice,
                state_m: step_m / STATES_PER_STEP,
                ..self.clone()
            },
            Err(_) => self.clone(),
        }
    }

    /// The same query from the goal: where only the goal is tight, its surroundings are searched
    /// from within. None where reverse is not allowed.
    pub(super) fn swapped(&self) -> Option<Self> {
        let swapped = |problem: Self| Self {
            sense: -problem.sense,
            starts: problem.goals,
            goals: problem.starts,
            ..problem
        };
        (self.request.motion == MotionMode::Reverse).then(|| swapped(self.clone()))
    }

    /// A path found by this search, from the request's start on.
    pub(super) fn in_driving_order(
        &self,
        (start, mut arcs): (Pose2, Vec<Arc>),
    ) -> (Pose2, Vec<Arc>) {
        if self.sense > 0.0 {
            return (start, arcs);
        }
        let end = arcs.iter().fold(start, |pose, arc| arc.end_from(pose));
        arcs.reverse();
        for arc in &mut arcs {
            arc.signed_length_m = -arc.signed_length_m;
        }
        (end, arcs)
    }

    /// Radii by which to grow obstacles for the goal field, most first: halfway to what the body
    /// sweeps in its tightest turn, which leads through gaps that can mostly be driven; the
    /// body's inner disc, which leads through gaps that are wide enough to go straight; and what
    /// the rear axle can never get nearer than, which keeps nothing out wrongly.
    pub(super) fn inflations_m(&self) -> [f64; 3] {
        let (wide, sure) = (self.body.inner_radius_m(), self.axle_inradius_m);
        let turning = 0.5 * self.body.swept_width_m(self.radius_m);
        let wide = wide.max(sure);
        [0.5 * (wide + turning.max(wide)), wide, sure]
    }

    pub(super) fn obstacles(&self) -> &ObstacleMap {
        self.obstacles
    }

    pub(super) fn config(&self) -> &HybridAstarConfig {
        self.config
    }

    pub(super) fn radius_m(&self) -> f64 {
        self.radius_m
    }

    pub(super) fn starts(&self) -> impl Iterator<Item = Pose2> + '_ {
        self.starts.iter().copied()
    }

    pub(super) fn goals(&self) -> &[Pose2] {
        &self.goals
    }

    /// Number of goals; where the search runs from them, it has one.
    pub(super) fn n_goals(&self) -> usize {
        if self.sense > 0.0 {
            1 + self.request.other_goals.len()
        } else {
            1
        }
    }

    pub(super) fn motion(&self) -> MotionMode {
        self.request.motion
    }

    /// The map cell under a pose, if it is on the map.
    pub(super) fn cell(&self, pose: Pose2) -> Option<Cell> {
        let frame = self.obstacles.frame();
        let (col, row) = (pose.x / frame.resolution_m(), pose.y / frame.resolution_m());
        let inside = (0.0..frame.n_cols() as f64).contains(&col)
            && (0.0..frame.n_rows() as f64).contains(&row);
        inside.then(|| Cell::new(col as u32, row as u32))
    }

    /// The lattice state of a node, as one number.
    pub(super) fn key(&self, node: &Node) -> u64 {
        let cell = |v: f64| (v / self.state_m).max(0.0) as u64 & 0x00FF_FFFF;
        cell(node.pose.x) << 40 | cell(node.pose.y) << 16 | node.heading_index as u64
    }

    /// Number of motions from a node: primitives, or from a start the arcs onto the lattice.
    pub(super) fn n_moves(&self, node: &Node) -> u16 {
        match node.parent {
            Some(_) => self.lattice.primitives().len() as u16,
            None => self.lattice.alignment_arcs(node.pose.heading).len() as u16,
        }
    }

    /// The node that a motion leads to. Headings are put exactly on the lattice, so that rounding
    /// does not add up.
    pub(super) fn arrive(&self, parent_id: u32, parent: &Node, step: u16) -> Node {
        let step = step as usize;
        let (arc, heading_index, position) = if parent.parent.is_some() {
            let primitive = &self.lattice.primitives()[step];
            let moved = self.lattice.displacements(parent.heading_index)[step];
            let heading_index = self.lattice.heading_after(parent.heading_index, primitive);
            (
                primitive.arc(),
                heading_index,
                parent.pose.position() + moved,
            )
        } else {
            let alignment = self.lattice.alignment_arcs(parent.pose.heading)[step];
            (
                alignment.arc,
                alignment.heading_index,
                alignment.arc.end_from(parent.pose).position(),
            )
        };
        let pose = Pose2::at(position, self.lattice.heading_rad(heading_index));
        let cost = parent.cost + self.least_cost(parent, arc, pose);
        Node {
            pose,
            arc,
            heading_index,
            cost,
            parent: Some(parent_id),
        }
    }

    /// Whether the body's inner disc certainly hits something: a look at one cell.
    pub(super) fn hits(&self, pose: Pose2) -> bool {
        self.obstacles.clearance_ceiling_m(&self.body, pose) < 0.0
    }

    /// Cost of a motion after a node, at least: its clearance is estimated from its end alone.
    fn least_cost(&self, parent: &Node, arc: Arc, end: Pose2) -> f64 {
        let clearance_m = self.obstacles.clearance_ceiling_m(&self.body, end);
        self.cost(parent, (parent.pose, arc), clearance_m)
    }

    /// Cost of a motion from a pose, after a node's motion; none where the body touches anything.
    pub(super) fn true_cost(&self, before: &Node, from: Pose2, arc: Arc) -> Option<f64> {
        let drive = Drive {
            start: from,
            curvature_per_m: arc.curvature_per_m,
            signed_length_m: arc.signed_length_m,
        };
        let wish_m = self.config.clearance_wish_m.max(2.0 * MIN_CLEARANCE_M);
        let clearance_m = self.obstacles.drive_clearance_m(&self.body, &drive, wish_m);
        (clearance_m > MIN_CLEARANCE_M).then(|| self.cost(before, (from, arc), clearance_m))
    }

    fn cost(&self, before: &Node, (from, arc): (Pose2, Arc), clearance_m: f64) -> f64 {
        let config = self.config;
        let near = if clearance_m < config.clearance_wish_m {
            1.0 - clearance_m.max(0.0) / config.clearance_wish_m
        } else {
            0.0
        };
        let switches = before.arc.signed_length_m * arc.signed_length_m < 0.0;
        let switching = if switches {
            config.direction_switching_cost
        } else {
            0.0
        };
        let factor =
            self.gear_factor(arc) * self.steering_factor(before.arc, arc) * self.soft(from, arc);
        switching + arc.length_m() * factor * (1.0 + config.cost_penalty * near)
    }

    /// Factor of the ground along a motion; the same for its bound and for its true cost.
    fn soft(&self, from: Pose2, arc: Arc) -> f64 {
        const SPACING_CELLS: f64 = 2.0;
        let Some(costs) = self.soft_costs else {
            return 1.0;
        };
        let spacing_m = SPACING_CELLS * self.obstacles.frame().resolution_m();
        let n = (arc.length_m() / spacing_m).ceil().max(1.0);
        let step_m = arc.signed_length_m / n;
        let place = |i| from.advance(arc.curvature_per_m, step_m * (i as f64 + 1.0));
        costs.factor((0..n as usize).map(place))
    }

    fn gear_factor(&self, arc: Arc) -> f64 {
        let is_reverse = self.sense * arc.signed_length_m < 0.0;
        if is_reverse {
            self.config.reverse_penalty
        } else {
            1.0
        }
    }

    fn steering_factor(&self, before: Arc, arc: Arc) -> f64 {
        if arc.curvature_per_m == 0.0 {
            return 1.0;
        }
        let swings_over = before.curvature_per_m * arc.curvature_per_m < 0.0;
        let change = if swings_over {
            self.config.change_penalty
        } else {
            0.0
        };
        self.config.non_straight_penalty + change
    }

    /// Whether a pose is a goal pose within the tolerance; a start must be met by a curve.
    pub(super) fn at_goal(&self, pose: Pose2) -> bool {
        if self.sense < 0.0 {
            return false;
        }
        let GoalTolerance { xy_m, yaw_rad } = self.request.goal_tolerance;
        self.goals.iter().any(|goal| {
            pose.position().distance(goal.position()) <= xy_m
                && angle_difference(pose.heading, goal.heading).abs() <= yaw_rad
        })
    }
}

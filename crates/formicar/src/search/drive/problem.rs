//! One query from pose to pose: what moves are there, what they cost, which are free.

use super::ground::Lattice;
use super::{DriveGround, Guide, HybridAstarConfig};
use crate::collision::{Drive, MIN_CLEARANCE_M};
use crate::geometry::{Arc, Point2, Pose2, angle_difference};
use crate::layers::SoftCosts;
use crate::map::Cell;
use crate::scenario::{GoalTolerance, MotionMode, Request};
use crate::vehicle::{Alignment, Gears, PrimitiveSet};

/// By how much obstacles are grown for the goal field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inflation {
    /// Halfway to what the body sweeps in its tightest turn.
    Turning,
    /// The body's inner disc.
    Wide,
    /// What the rear axle can never be nearer than.
    Sure,
}

impl Inflation {
    /// All of them, most growth first.
    pub const ALL: [Self; 3] = [Self::Turning, Self::Wide, Self::Sure];
}

/// From which end a search goes out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From the start.
    Start,
    /// From the goal, so that every motion will be driven backwards.
    Goal,
}

/// Where a vehicle is on the lattice, and how it came.
#[derive(Clone, Copy, Debug)]
pub struct State {
    /// The pose.
    pub pose: Pose2,
    /// The lattice's heading; only a start's heading need not be on the lattice.
    pub heading_index: usize,
    /// The motion that led here; of length 0 at a start.
    pub arc: Arc,
    /// Cost of all motions so far.
    pub cost: f64,
    /// Whether it is a start.
    pub is_start: bool,
}

impl State {
    /// Where a vehicle stands that came by an arc, whatever its heading.
    pub fn start(pose: Pose2, arc: Arc) -> Self {
        Self {
            pose,
            heading_index: 0,
            arc,
            cost: 0.0,
            is_start: true,
        }
    }
}

/// A request on a ground, in grid coordinates.
#[derive(Clone)]
pub struct DriveProblem<'a> {
    ground: &'a DriveGround,
    lattice: &'a Lattice,
    config: &'a HybridAstarConfig,
    motion: MotionMode,
    /// Gears of primitives.
    gears: Gears,
    tolerance: GoalTolerance,
    side: Side,
    starts: Vec<Pose2>,
    goals: Vec<Pose2>,
    /// Number of places among the goals.
    n_goals: usize,
    soft_costs: Option<&'a SoftCosts>,
    /// Whether motions that the masks cannot clear are looked at exactly.
    is_exact: bool,
}

impl<'a> DriveProblem<'a> {
    /// Prepares a query: the poses that the heading modes allow.
    pub fn new(ground: &'a DriveGround, config: &'a HybridAstarConfig, request: &Request) -> Self {
        let obstacles = ground.obstacles();
        let stands_free = |pose: &Pose2| obstacles.is_free(ground.body(), &Drive::at(*pose));
        let free = |poses: Vec<Pose2>| {
            let in_grid = poses.into_iter().map(|p| obstacles.frame().to_grid(p));
            in_grid.filter(stands_free).collect()
        };
        Self {
            ground,
            lattice: ground.coarse(),
            config,
            motion: request.motion,
            gears: match request.motion {
                MotionMode::Forward => Gears::Forward,
                MotionMode::Reverse => Gears::Both,
            },
            tolerance: request.goal_tolerance,
            side: Side::Start,
            starts: free(request.start_poses()),
            goals: free(request.goal_poses()),
            n_goals: 1 + request.other_goals.len(),
            soft_costs: None,
            is_exact: false,
        }
    }

    /// The same query with a preference for some ground over other, on the frame of the map.
    #[must_use]
    pub fn with_soft_costs(self, soft_costs: Option<&'a SoftCosts>) -> Self {
        Self { soft_costs, ..self }
    }

    /// The same query on a lattice of steps a quarter as long and headings four times as dense,
    /// with every motion looked at exactly, for places where a vehicle must shunt.
    #[must_use]
    pub fn refined(&self) -> Self {
        Self {
            lattice: self.ground.fine(),
            ..self.exact()
        }
    }

    /// The same query with every motion looked at exactly that the masks cannot clear.
    #[must_use]
    pub fn exact(&self) -> Self {
        Self {
            is_exact: true,
            ..self.clone()
        }
    }

    /// The same query from the other end: where only one end is tight, its surroundings are best
    /// searched from within. None where reverse is not allowed.
    pub fn swapped(&self) -> Option<Self> {
        let swapped = |problem: Self| Self {
            side: match problem.side {
                Side::Start => Side::Goal,
                Side::Goal => Side::Start,
            },
            starts: problem.goals,
            goals: problem.starts,
            ..problem
        };
        (self.motion == MotionMode::Reverse).then(|| swapped(self.clone()))
    }

    /// The same query with forward motions alone, but for the last curve.
    #[must_use]
    pub fn forward_on_the_way(&self) -> Self {
        Self {
            gears: Gears::Forward,
            ..self.clone()
        }
    }

    /// A path found by this search, from the request's start on.
    pub fn in_driving_order(&self, (start, mut arcs): (Pose2, Vec<Arc>)) -> (Pose2, Vec<Arc>) {
        if self.side == Side::Start {
            return (start, arcs);
        }
        let end = arcs.iter().fold(start, |pose, arc| arc.end_from(pose));
        arcs.reverse();
        for arc in &mut arcs {
            arc.signed_length_m = -arc.signed_length_m;
        }
        (end, arcs)
    }

    /// The prepared map and vehicle.
    pub fn ground(&self) -> &'a DriveGround {
        self.ground
    }

    /// What motions cost.
    pub fn config(&self) -> &'a HybridAstarConfig {
        self.config
    }

    /// The motions.
    pub fn primitives(&self) -> &'a PrimitiveSet {
        self.lattice.masks.lattice()
    }

    /// Where to begin.
    pub fn starts(&self) -> &[Pose2] {
        &self.starts
    }

    /// Where to end.
    pub fn goals(&self) -> &[Pose2] {
        &self.goals
    }

    /// Number of goals, whatever headings they allow; of a search from them, one.
    pub(super) fn n_goals(&self) -> usize {
        match self.side {
            Side::Start => self.n_goals,
            Side::Goal => 1,
        }
    }

    /// The end that the search goes out from.
    pub fn side(&self) -> Side {
        self.side
    }

    /// Which gears may be used.
    pub fn motion(&self) -> MotionMode {
        self.motion
    }

    /// The map cell under a position, if it is on the map.
    pub fn cell(&self, position: Point2) -> Option<Cell> {
        let frame = self.ground.obstacles().frame();
        let (col, row) = (
            position.x / frame.resolution_m(),
            position.y / frame.resolution_m(),
        );
        let inside = (0.0..frame.n_cols() as f64).contains(&col)
            && (0.0..frame.n_rows() as f64).contains(&row);
        inside.then(|| Cell::new(col as u32, row as u32))
    }

    /// The cell and heading of the lattice that a state falls into, as one number.
    pub fn key(&self, state: &State) -> u64 {
        let cell = |v: f64| (v / self.lattice.state_m).max(0.0) as u64 & 0x00FF_FFFF;
        cell(state.pose.x) << 40 | cell(state.pose.y) << 16 | state.heading_index as u64
    }

    /// The first states.
    pub fn start_states(&self) -> impl Iterator<Item = State> + '_ {
        let starts = self.starts.iter();
        starts.map(|&pose| State::start(pose, Arc::default()))
    }

    /// The states that motions lead to and that do not certainly hit anything: by a primitive
    /// each, or from a start by the arcs onto the lattice.
    pub fn successors(&self, from: &State, mut then: impl FnMut(usize, State)) {
        if !from.is_start {
            for step in 0..self.n_primitives() {
                if let Some(state) = self.arrive(from, step) {
                    then(step, state);
                }
            }
            return;
        }
        let arcs = self.primitives().alignment_arcs(from.pose.heading);
        for (step, Alignment { arc, heading_index }) in arcs.into_iter().enumerate() {
            let position = arc.end_from(from.pose).position();
            let is_allowed = self.gears == Gears::Both || arc.signed_length_m >= 0.0;
            if let Some(state) = self.after(from, arc, position, heading_index)
                && is_allowed
            {
                then(step, state);
            }
        }
    }

    /// What is to go at least from the best place one motion farther on in the same gear, with
    /// that motion; none where every such place certainly hits something or leads nowhere.
    pub fn look_ahead(&self, guide: &Guide, state: &State) -> Option<f64> {
        let primitives = self.primitives();
        let half = primitives.primitives().len() / 2;
        let of_gear = if state.arc.signed_length_m < 0.0 {
            half..2 * half
        } else {
            0..half
        };
        let moved = &primitives.displacements(state.heading_index)[of_gear.clone()];
        let moves = primitives.primitives()[of_gear].iter().zip(moved);
        let mut least = None::<f64>;
        for (primitive, &moved) in moves {
            let position = state.pose.position() + moved;
            let heading_index = primitives.heading_after(state.heading_index, primitive);
            if self.hits(position, primitives.unit(heading_index)) {
                continue;
            }
            if let Some(to_go) = guide.estimate_m(self, position) {
                let ahead = primitive.length_m + to_go;
                least = Some(least.map_or(ahead, |least| least.min(ahead)));
            }
        }
        least
    }

    /// Length of a motion, about, metres.
    pub fn step_m(&self) -> f64 {
        self.primitives().primitives()[0].length_m
    }

    /// Number of motions from a state on the lattice.
    pub fn n_primitives(&self) -> usize {
        let n_primitives = self.primitives().primitives().len();
        match self.gears {
            Gears::Forward => n_primitives / 2,
            Gears::Both => n_primitives,
        }
    }

    /// The state that a primitive leads to; none where it certainly hits something. Headings are
    /// put exactly on the lattice, so that rounding does not add up.
    pub fn arrive(&self, from: &State, step: usize) -> Option<State> {
        let lattice = self.primitives();
        let primitive = &lattice.primitives()[step];
        let moved = lattice.displacements(from.heading_index)[step];
        let heading_index = lattice.heading_after(from.heading_index, primitive);
        let position = from.pose.position() + moved;
        self.after(from, primitive.arc(), position, heading_index)
    }

    fn after(
        &self,
        from: &State,
        arc: Arc,
        position: Point2,
        heading_index: usize,
    ) -> Option<State> {
        let along = self.primitives().unit(heading_index);
        if self.hits(position, along) {
            return None;
        }
        let dearness = self.dearness(position, along);
        Some(State {
            pose: Pose2::at(position, self.primitives().heading_rad(heading_index)),
            heading_index,
            arc,
            cost: from.cost + self.cost(from.arc, arc, dearness),
            is_start: false,
        })
    }

    /// Whether the body's inner disc certainly hits something: a look at one cell.
    pub(super) fn hits(&self, position: Point2, along: Point2) -> bool {
        let (obstacles, body) = (self.ground.obstacles(), self.ground.body());
        obstacles.ceiling_at_m(body, position, along) < 0.0
    }

    /// Whether a motion from a state is free, by its mask or exactly.
    pub fn is_free(&self, from: &State, step: usize, arc: Arc) -> bool {
        if from.is_start {
            return arc.signed_length_m == 0.0 || self.is_arc_free(from.pose, arc);
        }
        let (padded, position) = (self.ground.padded(), from.pose.position());
        let masks = &self.lattice.masks;
        masks.is_clear(padded, position, from.heading_index, step)
            || self.is_exact && self.is_arc_free(from.pose, arc)
    }

    /// Whether the body keeps off everything along an arc, exactly.
    pub fn is_arc_free(&self, start: Pose2, arc: Arc) -> bool {
        let drive = Drive {
            start,
            curvature_per_m: arc.curvature_per_m,
            signed_length_m: arc.signed_length_m,
        };
        self.ground.obstacles().is_free(self.ground.body(), &drive)
    }

    /// Cost of a motion after another, given the factor of the ground at its end.
    pub(super) fn cost(&self, before: Arc, arc: Arc, dearness: f64) -> f64 {
        let switches = before.signed_length_m * arc.signed_length_m < 0.0;
        let switching = if switches {
            self.config.direction_switching_cost
        } else {
            0.0
        };
        let factor = self.gear_factor(arc) * self.steering_factor(before, arc);
        switching + arc.length_m() * factor * dearness
    }

    /// Factor of the ground on lengths: by how near obstacles are, and by the soft costs.
    pub(super) fn dearness(&self, position: Point2, along: Point2) -> f64 {
        let wish_m = self.config.clearance_wish_m.max(2.0 * MIN_CLEARANCE_M);
        let (obstacles, body) = (self.ground.obstacles(), self.ground.body());
        let clearance_m = obstacles.estimate_at(body, position, along, wish_m);
        let nearness = (1.0 - clearance_m / wish_m).clamp(0.0, 1.0);
        let soft = self
            .soft_costs
            .map_or(0.0, |costs| costs.price_at(position));
        (1.0 + soft) * (1.0 + self.config.cost_penalty * nearness)
    }

    fn gear_factor(&self, arc: Arc) -> f64 {
        let sense = match self.side {
            Side::Start => 1.0,
            Side::Goal => -1.0,
        };
        if sense * arc.signed_length_m < 0.0 {
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

    /// Length of the pieces in which long arcs are priced, metres.
    pub(super) fn piece_m(&self) -> f64 {
        self.lattice.state_m
    }

    /// Whether a pose is a goal pose within the tolerance; a start must be met by a curve.
    pub fn at_goal(&self, pose: Pose2) -> bool {
        if self.side == Side::Goal {
            return false;
        }
        let GoalTolerance { xy_m, yaw_rad } = self.tolerance;
        self.goals.iter().any(|goal| {
            pose.position().distance(goal.position()) <= xy_m
                && angle_difference(pose.heading, goal.heading).abs() <= yaw_rad
        })
    }
}

//! One query from pose to pose: its ends and its lattice.

use super::drivable_map::Lattice;
use super::{DrivableMap, Driven, HybridAstarConfig, Side, State};
use crate::collision::Drive;
use crate::geometry::{Arc, Point2, Pose2};
use crate::layers::SoftCosts;
use crate::map::Cell;
use crate::objective::VehicleCost;
use crate::scenario::{GoalRegion, Request};
use crate::vehicle::{Gears, PrimitiveSet};

/// The weight of the heuristic on the refined lattice, a multiple of the configured one: what lies
/// between two poses is short, and any way is good news.
const REFINED_WEIGHT: f64 = 2.0;

/// The shares of the surcharges for reverse, changes of gear and nearness that a search counts, on
/// the lattice of the map and on the refined one.
#[derive(Clone, Copy)]
struct CostShares {
    coarse: f64,
    refined: f64,
}

/// A request on a prepared map, in grid coordinates.
#[derive(Clone)]
pub struct DriveProblem<'a> {
    pub(super) map: &'a DrivableMap,
    pub(super) lattice: &'a Lattice,
    pub(super) config: &'a HybridAstarConfig,
    /// Of motions.
    pub(super) cost: VehicleCost,
    /// Of driving.
    whole_cost: VehicleCost,
    shares: CostShares,
    is_refined: bool,
    gears: Gears,
    /// Gears of the steps on the way; the last curve may use all of the request's.
    pub(super) step_gears: Gears,
    region: GoalRegion,
    pub(super) side: Side,
    starts: Vec<Pose2>,
    goals: Vec<Pose2>,
    /// Number of places among the goals.
    n_goals: usize,
    pub(super) soft_costs: Option<&'a SoftCosts>,
    /// Whether motions that the masks cannot clear are looked at exactly.
    pub(super) is_exact: bool,
    /// The clearance that the ends of motions keep, meters; 0 where free is enough.
    pub(super) kept_clearance_m: f64,
}

impl<'a> DriveProblem<'a> {
    /// Prepares a query: the poses that the heading modes allow.
    pub fn new(
        map: &'a DrivableMap,
        config: &'a HybridAstarConfig,
        cost: &VehicleCost,
        request: &Request,
    ) -> Self {
        let obstacles = map.obstacles();
        let to_grid = |pose: Pose2| obstacles.frame().to_grid(pose);
        let stands_free = |pose| obstacles.is_free(map.body(), &Drive::at(to_grid(pose)));
        let starts = request.start_poses().into_iter();
        let goals = request.goals();
        let goals = goals.flat_map(|goal| request.free_poses_at_goal(goal, stands_free));
        Self {
            map,
            lattice: map.coarse(),
            config,
            cost: config.cost_of_motions(cost, config.cost_share),
            whole_cost: *cost,
            shares: CostShares {
                coarse: config.cost_share,
                refined: 0.0,
            },
            is_refined: false,
            gears: request.gears,
            step_gears: request.gears,
            region: GoalRegion::of(request).map_poses(|pose| obstacles.frame().to_grid(pose)),
            side: Side::Start,
            starts: starts
                .filter(|&pose| stands_free(pose))
                .map(to_grid)
                .collect(),
            goals: goals.map(to_grid).collect(),
            n_goals: 1 + request.other_goals.len(),
            soft_costs: None,
            is_exact: false,
            kept_clearance_m: 0.0,
        }
    }

    /// The same query with soft costs on the frame of the map.
    #[must_use]
    pub fn with_soft_costs(self, soft_costs: Option<&'a SoftCosts>) -> Self {
        Self { soft_costs, ..self }
    }

    /// The same query for a cheaper path instead of the soonest: with every surcharge counted in
    /// full, on the refined lattice with the share that a first search counts on the other.
    #[must_use]
    pub fn at_higher_cost(&self) -> Self {
        let shares = CostShares {
            coarse: 1.0,
            refined: self.config.cost_share,
        };
        Self {
            shares,
            ..self.clone()
        }
        .priced()
    }

    /// The same query on a lattice of steps a quarter as long and headings four times as dense,
    /// with every motion looked at exactly and at first without surcharges, for places where a
    /// vehicle must shunt: the way is found sooner where a change of gear costs nothing.
    #[must_use]
    pub fn refined(&self) -> Self {
        Self {
            lattice: self.map.fine(),
            is_refined: true,
            ..self.exact()
        }
        .priced()
    }

    fn priced(mut self) -> Self {
        let share = if self.is_refined {
            self.shares.refined
        } else {
            self.shares.coarse
        };
        self.cost = self.config.cost_of_motions(&self.whole_cost, share);
        self
    }

    /// True where the cheapest path is sought and not the soonest: by the whole cost, or by soft
    /// costs.
    pub fn seeks_cheapest(&self) -> bool {
        self.shares.coarse >= 1.0 || self.soft_costs.is_some()
    }

    /// True on the refined lattice.
    pub fn is_refined(&self) -> bool {
        self.is_refined
    }

    /// The weight of the heuristic.
    pub fn weight(&self) -> f64 {
        if self.is_refined {
            REFINED_WEIGHT * self.config.weight
        } else {
            self.config.weight
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

    /// The same query for paths whose motions end at a clearance, meters; none where no start or
    /// no goal has that.
    #[must_use]
    pub fn keeping(&self, clearance_m: f64) -> Option<Self> {
        let (obstacles, body) = (self.map.obstacles(), self.map.body());
        let has_room = |&pose: &Pose2| obstacles.clearance_m(body, pose) >= clearance_m;
        let with_room = |poses: &[Pose2]| poses.iter().copied().filter(has_room).collect();
        let problem = Self {
            starts: with_room(&self.starts),
            goals: with_room(&self.goals),
            kept_clearance_m: clearance_m,
            ..self.clone()
        };
        (!problem.starts.is_empty() && !problem.goals.is_empty()).then_some(problem)
    }

    /// True for a query of paths whose motions end at some clearance.
    pub fn keeps_clearance(&self) -> bool {
        self.kept_clearance_m > 0.0
    }

    /// The same query from the other end: the surroundings of a tight end are best searched from
    /// within. None where reverse is not allowed.
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
        (self.gears == Gears::Both).then(|| swapped(self.clone()))
    }

    /// The same query with forward motions alone, but for the last curve.
    #[must_use]
    pub fn forward_on_the_way(&self) -> Self {
        Self {
            step_gears: Gears::Forward,
            ..self.clone()
        }
    }

    /// A path found by this search, from the request's start on.
    pub fn in_driving_order(&self, (start, mut arcs): Driven) -> Driven {
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
    pub fn map(&self) -> &'a DrivableMap {
        self.map
    }

    /// Parameters, costs of motions among them.
    pub fn config(&self) -> &'a HybridAstarConfig {
        self.config
    }

    /// The motions.
    pub fn primitives(&self) -> &'a PrimitiveSet {
        self.lattice.masks.lattice()
    }

    /// The start poses.
    pub fn starts(&self) -> &[Pose2] {
        &self.starts
    }

    /// The poses at which a path may end.
    pub fn region(&self) -> &GoalRegion {
        &self.region
    }

    /// Goal poses at which the vehicle can stand.
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

    /// The end from which the search starts.
    pub fn side(&self) -> Side {
        self.side
    }

    /// The gears that may be used.
    pub fn gears(&self) -> Gears {
        self.gears
    }

    /// The map cell under a position, if it is on the map.
    pub fn cell(&self, position: Point2) -> Option<Cell> {
        let frame = self.map.obstacles().frame();
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

    /// Whether a path may end at a pose; a start must be met by a curve.
    pub fn at_goal(&self, pose: Pose2) -> bool {
        if self.side == Side::Goal {
            return false;
        }
        self.region.contains(pose)
    }
}

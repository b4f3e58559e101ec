//! What is still to be driven, estimated from two sides; the larger counts.

use super::HybridProblem;
use crate::geometry::{Pose2, dubins, reeds_shepp};
use crate::map::{Cell, DiagonalRule, MoveMasks};
use crate::progress::{Limits, Status};
use crate::scenario::MotionMode;
use crate::search::GoalField;

/// The goal field, which sees obstacles but no headings, and the shortest curve, which sees
/// headings but no obstacles.
pub(super) struct Guide<'a> {
    problem: &'a HybridProblem<'a>,
    field: GoalField,
}

impl<'a> Guide<'a> {
    /// Eight directions are up to 8.2 % longer than the straight way: cos(pi / 8).
    const OCTILE_SHRINK: f64 = 0.923_879_532_511_286_7;
    /// Up to how many goal poses curves are measured to; beyond, the goal field alone guides.
    const MAX_CURVE_GOALS: usize = 4;
    /// Curves count within this many turning radii of the goal; farther off the field says more.
    const CURVE_REACH_RADII: f64 = 12.0;

    /// The guide on obstacles grown by a radius; none where that covers all goals or the start.
    pub(super) fn new(
        problem: &'a HybridProblem<'a>,
        inflation_m: f64,
        limits: &mut Limits,
    ) -> Result<Option<Self>, Status> {
        let obstacles = problem.obstacles();
        // Only what blocks a position wherever it lies in its cell: from the cell's center to the
        // position half a diagonal, from the obstacle's center to its side half a cell.
        let radius = inflation_m / obstacles.frame().resolution_m()
            - (std::f64::consts::FRAC_1_SQRT_2 - 0.5);
        let truncation = f64::from(obstacles.distance().truncation_cells());
        let blocked = obstacles
            .distance()
            .within(radius.clamp(0.0, truncation - 0.5));
        let blocked = blocked.unwrap_or_else(|| obstacles.lethal().clone());
        let free = |cell: &Cell| !blocked.get(cell.col as usize, cell.row as usize);
        let cells = |poses: &[Pose2]| -> Vec<Cell> {
            let mut cells: Vec<Cell> = poses.iter().filter_map(|&p| problem.cell(p)).collect();
            // The headings of a place lie behind each other.
            cells.dedup();
            cells.into_iter().filter(free).collect()
        };
        let starts: Vec<Pose2> = problem.starts().collect();
        let (goals, starts) = (cells(problem.goals()), cells(&starts));
        if goals.is_empty() || starts.is_empty() {
            return Ok(None);
        }
        let moves = MoveMasks::new(&blocked, DiagonalRule::AtMostOneObstacle);
        match GoalField::new(&moves, &goals, &mut limits.without_budget()) {
            Ok(field) => Ok(Some(Self { problem, field })),
            Err(error) => error.status().map_or(Ok(None), Err),
        }
    }

    /// Estimated cost from a pose to the goal; none where the goal cannot be reached.
    pub(super) fn cost_to_go(&self, pose: Pose2) -> Option<f64> {
        let along_field = self.field_m(pose)?;
        let goals = self.problem.goals();
        let radius_m = self.problem.radius_m();
        if goals.len() > Self::MAX_CURVE_GOALS || along_field > Self::CURVE_REACH_RADII * radius_m {
            return Some(along_field);
        }
        let curve = |&goal: &Pose2| match self.problem.motion() {
            MotionMode::Forward => dubins::distance(pose, goal, radius_m),
            MotionMode::Reverse => reeds_shepp::distance(pose, goal, radius_m),
        };
        let along_curve = goals.iter().filter_map(curve).fold(f64::INFINITY, f64::min);
        Some(if along_curve.is_finite() {
            along_field.max(along_curve)
        } else {
            along_field
        })
    }

    /// Whether it is time to try a curve from a pose: always near the goal, seldom far from it.
    pub(super) fn wants_shot(&self, pose: Pose2, n_nodes: u32) -> bool {
        let Some(to_go) = self.field_m(pose) else {
            return false;
        };
        let every = (to_go / (3.0 * self.problem.radius_m())) as u32 + 1;
        n_nodes.is_multiple_of(every.min(32))
    }

    /// The way along the goal field, interpolated between the centers of the four cells around,
    /// since a field of steps would reward weaving from one cell's edge to the next.
    fn field_m(&self, pose: Pose2) -> Option<f64> {
        let frame = self.problem.obstacles().frame();
        let here = self.field.distance_cells(self.problem.cell(pose)?)?;
        let (x, y) = (
            pose.x / frame.resolution_m() - 0.5,
            pose.y / frame.resolution_m() - 0.5,
        );
        let at = |dx: f64, dy: f64| {
            let (col, row) = (x.floor() + dx, y.floor() + dy);
            let inside = (0.0..frame.n_cols() as f64).contains(&col)
                && (0.0..frame.n_rows() as f64).contains(&row);
            let cell = inside.then(|| Cell::new(col as u32, row as u32));
            cell.and_then(|cell| self.field.distance_cells(cell))
                .unwrap_or(here)
        };
        let (u, v) = (x - x.floor(), y - y.floor());
        let below = (1.0 - u) * at(0.0, 0.0) + u * at(1.0, 0.0);
        let above = (1.0 - u) * at(0.0, 1.0) + u * at(1.0, 1.0);
        Some(Self::OCTILE_SHRINK * ((1.0 - v) * below + v * above) * frame.resolution_m())
    }
}

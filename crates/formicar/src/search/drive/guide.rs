//! The heuristic of searches that drive: the larger of two estimates.

use super::{DriveProblem, FieldGrid, Inflation, one_way};
use crate::geometry::{Point2, Pose2, dubins, reeds_shepp};
use crate::map::Cell;
use crate::numeric::integer_below;
use crate::progress::{Limits, Status};
use crate::search::{GuideField, STRAIGHT_COST, SearchError};
use crate::vehicle::Gears;

/// The goal field, which sees obstacles but no headings, and the shortest curve, which sees
/// headings but no obstacles.
pub struct Guide<'a> {
    field: GuideField<'a>,
    /// Cells of the map that a cell of the field is wide.
    stride: u32,
    /// Size of a cell of the field.
    resolution_m: f64,
}

/// Eight directions are up to 8.2 % longer than the straight way: cos(pi / 8).
const OCTILE_SHRINK: f64 = 0.923_879_532_511_286_7;
/// Most goal poses to which curves are measured; with more, the goal field alone guides.
const MAX_CURVE_GOALS: usize = 4;
/// Curves count within this many turning radii of the goal; farther off the field says more.
const CURVE_REACH_RADII: f64 = 12.0;

impl<'a> Guide<'a> {
    /// The guide on inflated obstacles; none where these cover the start or all goals, or separate
    /// them.
    ///
    /// # Errors
    /// Deadline or cancel.
    pub fn new(
        problem: &DriveProblem<'a>,
        inflation: Inflation,
        limits: &mut Limits,
    ) -> Result<Option<Self>, Status> {
        let (moves, stride) = problem.map().moves(inflation);
        limits.look()?;
        let free = |cell: &Cell| !moves.blocked().get(cell.col as usize, cell.row as usize);
        let cells = |poses: &[Pose2]| {
            let cells = poses
                .iter()
                .filter_map(|pose| problem.cell(pose.position()));
            let cells = cells.map(|cell| Cell::new(cell.col / stride, cell.row / stride));
            let mut cells: Vec<Cell> = cells.filter(free).collect();
            cells.dedup();
            cells
        };
        let (starts, goals) = (cells(problem.starts()), cells(problem.goals()));
        let (Some(&start), false) = (starts.first(), goals.is_empty()) else {
            return Ok(None);
        };
        let Ok(field) = GuideField::new(moves, &goals) else {
            return Ok(None);
        };
        let map_m = problem.map().obstacles().frame().resolution_m();
        let mut guide = Self {
            field,
            stride,
            resolution_m: f64::from(stride) * map_m,
        };
        guide.charge(&one_way::tolls(problem, guide.grid()), limits)?;
        let reaches = guide.measure(start, limits)?.is_some();
        Ok(reaches.then_some(guide))
    }

    /// Estimated cost from a pose to the goal; none where the goal cannot be reached.
    ///
    /// # Errors
    /// Deadline or cancel.
    pub fn cost_to_go(
        &mut self,
        problem: &DriveProblem,
        pose: Pose2,
        limits: &mut Limits,
    ) -> Result<Option<f64>, Status> {
        let Some(along_field) = self.along_field_m(problem, pose, limits)? else {
            return Ok(None);
        };
        Ok(Some(along_field.max(self.along_curve_m(
            problem,
            pose,
            along_field,
        ))))
    }

    /// Length of the shortest curve to a goal; 0 where the distance along the field is too long for
    /// it to matter.
    pub fn along_curve_m(&self, problem: &DriveProblem, pose: Pose2, along_field_m: f64) -> f64 {
        let goals = problem.goals();
        let radius_m = problem.map().radius_m();
        if goals.len() > MAX_CURVE_GOALS || along_field_m > CURVE_REACH_RADII * radius_m {
            return 0.0;
        }
        let curve = |&goal: &Pose2| match problem.gears() {
            Gears::Forward => dubins::distance(pose, goal, radius_m),
            Gears::Both => reeds_shepp::distance(pose, goal, radius_m),
        };
        let shortest = goals.iter().filter_map(curve).fold(f64::INFINITY, f64::min);
        if shortest.is_finite() { shortest } else { 0.0 }
    }

    /// The distance along the goal field, interpolated between the centers of the four cells around:
    /// a field of steps would reward weaving from one cell's edge to the next.
    ///
    /// # Errors
    /// Deadline or cancel.
    pub fn along_field_m(
        &mut self,
        problem: &DriveProblem,
        pose: Pose2,
        limits: &mut Limits,
    ) -> Result<Option<f64>, Status> {
        let Some(cell) = self.cell(problem, pose.position()) else {
            return Ok(None);
        };
        let Some(here) = self.measure(cell, limits)? else {
            return Ok(None);
        };
        Ok(Some(self.interpolated_m(pose.position(), here)))
    }

    /// The distance along the field where it is settled, otherwise a lower bound; none where no goal
    /// is reached.
    pub fn estimate_m(&self, problem: &DriveProblem, position: Point2) -> Option<f64> {
        let cell = self.cell(problem, position)?;
        match self.field.cost(cell) {
            Some(here) => Some(self.interpolated_m(position, here)),
            None => self
                .field
                .horizon()
                .map(|cost| self.length_m(f64::from(cost))),
        }
    }

    /// Adds tolls to cells of the field.
    ///
    /// # Errors
    /// Deadline or cancel.
    pub fn repair(
        &mut self,
        tolls: impl FnOnce(FieldGrid) -> Vec<(Cell, u32)>,
        limits: &mut Limits,
    ) -> Result<(), Status> {
        let tolls = tolls(self.grid());
        self.charge(&tolls, limits)
    }

    fn grid(&self) -> FieldGrid {
        let moves = self.field.moves();
        FieldGrid {
            resolution_m: self.resolution_m,
            n_cols: moves.n_cols(),
            n_rows: moves.n_rows(),
        }
    }

    fn charge(&mut self, tolls: &[(Cell, u32)], limits: &mut Limits) -> Result<(), Status> {
        if tolls.is_empty() {
            return Ok(());
        }
        match self.field.add_tolls(tolls, &mut limits.aside()) {
            Err(SearchError::Ended { status }) => Err(status),
            _ => Ok(()),
        }
    }

    fn measure(&mut self, cell: Cell, limits: &mut Limits) -> Result<Option<u32>, Status> {
        if let Some(cost) = self.field.cost(cell) {
            return Ok(Some(cost));
        }
        match self.field.measure(cell, &mut limits.aside()) {
            Ok(cost) => Ok(cost),
            Err(SearchError::Ended { status }) => Err(status),
            Err(_) => Ok(None),
        }
    }

    /// Interpolates between the four cell centers around a position; `here` replaces costs that are
    /// not settled.
    fn interpolated_m(&self, position: Point2, here: u32) -> f64 {
        let (x, y) = (
            position.x / self.resolution_m - 0.5,
            position.y / self.resolution_m - 0.5,
        );
        let moves = self.field.moves();
        let (col, row) = (integer_below(x), integer_below(y));
        let at = |dx: i64, dy: i64| {
            let (col, row) = (col + dx, row + dy);
            let inside = (0..moves.n_cols() as i64).contains(&col)
                && (0..moves.n_rows() as i64).contains(&row);
            let cell = inside.then(|| Cell::new(col as u32, row as u32));
            f64::from(cell.and_then(|cell| self.field.cost(cell)).unwrap_or(here))
        };
        let (u, v) = (x - col as f64, y - row as f64);
        let below = (1.0 - u) * at(0, 0) + u * at(1, 0);
        let above = (1.0 - u) * at(0, 1) + u * at(1, 1);
        self.length_m((1.0 - v) * below + v * above)
    }

    fn length_m(&self, cost: f64) -> f64 {
        OCTILE_SHRINK * self.resolution_m / f64::from(STRAIGHT_COST) * cost
    }

    /// The field's cell under a pose.
    fn cell(&self, problem: &DriveProblem, position: Point2) -> Option<Cell> {
        problem
            .cell(position)
            .map(|cell| Cell::new(cell.col / self.stride, cell.row / self.stride))
    }
}

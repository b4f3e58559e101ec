//! A problem prepared for a configuration: everything that stays the same over all generations.

use super::config::ChordConfig;
use super::numbered::Numbered;
use super::problem::ChordProblem;
use super::ring::{Ring, moved};
use super::safety::Guard;
use crate::colony::corridor::Corridor;
use crate::colony::error::RunError;
use crate::colony::generation::StepSpace;
use crate::geometry::{Point2, angle_difference};
use crate::map::Cell;
use crate::objective::{PolylineCost, SteeringMeter};
use crate::path::GridPath;
use crate::progress::Limits;
use crate::search::{GoalField, check_end};
use crate::vehicle::SuspendedSteering;

/// The cells, steps and limits that ants choose from, made ready for a configuration.
pub(super) struct ChordGraph<'a> {
    pub(super) problem: &'a ChordProblem<'a>,
    pub(super) config: &'a ChordConfig,
    pub(super) start: Cell,
    pub(super) goal: Cell,
    pub(super) resolution_m: f64,
    pub(super) wheelbase_m: f64,
    pub(super) ring: Ring,
    /// The turn between every two steps; see [`Self::turn`].
    turns: Vec<Turn>,
    /// By step the next steps that the rigid vehicle can steer into.
    pub(super) followers: Vec<Vec<u8>>,
    pub(super) guard: Guard,
    pub(super) cells: Numbered,
    /// By number the shortest distance to the goal, cells.
    pub(super) to_go: Vec<f32>,
    /// The largest detour of a step, cells.
    pub(super) step_loss: f64,
    /// The shortest path over cells.
    pub(super) shortest: GridPath,
    /// Its cost when walked by chords.
    pub(super) reference: PolylineCost,
    /// Adds up the cost of an ant's steps; here before the first step.
    pub(super) meter: SteeringMeter,
    /// The most steps of an ant.
    pub(super) max_steps: usize,
}

/// The turn from one step to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    /// Radians, positive left.
    pub(super) turn_rad: f64,
    /// phi: the steering needed, radians.
    pub(super) needed_rad: f64,
}

impl<'a> ChordGraph<'a> {
    /// Prepares two goal fields, the corridor, the ring and the swept masks; none if the grid has no
    /// path.
    pub(super) fn new(
        problem: &'a ChordProblem<'a>,
        config: &'a ChordConfig,
        limits: &mut Limits,
    ) -> Result<Option<Self>, RunError> {
        let (start, goal) = (problem.start_cell(), problem.goal);
        check_end(problem.moves, "start", start)?;
        check_end(problem.moves, "goal", goal)?;
        let moves = problem.moves;
        let mut limits = limits.without_budget();
        let to_goal = GoalField::new(moves, &[goal], &mut limits)?;
        let Some(shortest_cells) = to_goal.distance_cells(start) else {
            return Ok(None);
        };
        let cells = Numbered::of(&config.corridor, moves, &to_goal, start, &mut limits)?;
        let to_go = cells.iter().map(|cell| to_goal.distance_cells(cell));
        let to_go = to_go
            .map(|cells| cells.unwrap_or(f64::INFINITY) as f32)
            .collect();
        let resolution_m = problem.obstacles.frame().resolution_m();
        let ring = Ring::new(config.reach);
        let steering = problem.vehicle.steering_geometry();
        let step_m = mean(&ring.lengths) * resolution_m;
        let suspended = SuspendedSteering::new(steering, config.limit.suspension(), step_m)?;
        let mut graph = Self {
            problem,
            config,
            start,
            goal,
            resolution_m,
            wheelbase_m: steering[0],
            turns: Vec::new(),
            followers: Vec::new(),
            guard: Guard::new(
                &config.safety,
                problem.obstacles,
                problem.vehicle,
                &ring.moves,
            )?,
            cells,
            to_go,
            step_loss: match &config.corridor {
                Corridor::Ratio(rule) => rule.step_loss_cells,
                Corridor::None => f64::INFINITY,
            },
            shortest: to_goal.path(problem.moves, start)?.path,
            reference: PolylineCost::default(),
            meter: SteeringMeter::new(steering, suspended),
            max_steps: 64 + (4.0 * shortest_cells / f64::from(config.reach)) as usize,
            ring,
        };
        graph.relate_steps(steering[1]);
        graph.reference = graph.measure_shortest();
        Ok(Some(graph))
    }

    /// Computes the turn between every two steps.
    fn relate_steps(&mut self, max_steer_rad: f64) {
        let n = self.ring.len();
        for from in 0..n {
            for to in 0..n {
                let turn = self.asked(self.ring.turn_rad(from, to), self.length_m(to));
                self.turns.push(turn);
            }
            let can_follow = |&to: &usize| self.turn(from, to).needed_rad <= max_steer_rad;
            let followers = (0..n).filter(can_follow).map(|to| to as u8);
            self.followers.push(followers.collect());
        }
    }

    /// The shortest path, walked by chords.
    fn measure_shortest(&self) -> PolylineCost {
        let cells = &self.shortest.cells;
        let last = cells.len().saturating_sub(1);
        let nodes = (0..last).step_by(self.config.reach as usize).chain([last]);
        let points: Vec<Point2> = nodes.map(|i| self.center_m(cells[i])).collect();
        let mut meter = self.meter.clone();
        let mut heading_rad = None;
        for pair in points.windows(2) {
            let step = pair[1] - pair[0];
            let turn = angle_difference(step.angle(), heading_rad.unwrap_or(step.angle()));
            meter.take(turn, step.norm());
            heading_rad = Some(step.angle());
        }
        let total = meter.total(&self.config.cost, 1.0);
        PolylineCost {
            length_m: total.length_m.max(self.resolution_m),
            ..total
        }
    }

    /// The steering needed for a turn before a step of a length.
    pub(super) fn asked(&self, turn_rad: f64, length_m: f64) -> Turn {
        Turn {
            turn_rad,
            needed_rad: (self.wheelbase_m * turn_rad.abs() / length_m).atan(),
        }
    }

    #[inline]
    pub(super) fn turn(&self, from: usize, to: usize) -> Turn {
        self.turns[from * self.ring.len() + to]
    }

    pub(super) fn length_m(&self, step: usize) -> f64 {
        self.ring.lengths[step] * self.resolution_m
    }

    /// The center of a cell, grid coordinates.
    pub(super) fn center_m(&self, cell: Cell) -> Point2 {
        Point2::new(f64::from(cell.col) + 0.5, f64::from(cell.row) + 0.5) * self.resolution_m
    }

    /// The straight distance of a cell from the goal, cells.
    #[inline]
    pub(super) fn distance(&self, cell: Cell) -> f64 {
        let (dx, dy) = (
            f64::from(self.goal.col) - f64::from(cell.col),
            f64::from(self.goal.row) - f64::from(cell.row),
        );
        (dx * dx + dy * dy).sqrt()
    }

    /// The grid, the ends of all paths, and the steps of the ring.
    pub(super) fn space(&self) -> StepSpace<'_> {
        StepSpace {
            start: self.start,
            goal: self.goal,
            moves: &self.ring.moves,
            n_cols: self.problem.moves.n_cols(),
            n_rows: self.problem.moves.n_rows(),
        }
    }

    /// The cell that a step leads to, with its number; none if ants may not go there.
    #[inline]
    pub(super) fn step_to(&self, from: Cell, step: usize) -> Option<(Cell, usize)> {
        let to = moved(from, self.ring.moves[step]);
        Some((to, self.cells.number(to)?))
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

//! `faco2024`, the colony that steps by chords: guide, ants, arcs at every corner.

use super::family::{Family, sections};
use super::{Abilities, Ended, Found, Halt, Stages, Task, Vehicles};
use crate::colony::chord::{ChordConfig, ChordProblem, Safety, run_chords};
use crate::colony::dead_end::DeadEnd;
use crate::geometry::Pose2;
use crate::map::{BitGrid, Cell, DiagonalRule, MoveMasks, ring};
use crate::objective::DriveCost;
use crate::path::GridPath;
use crate::progress::{Event, Limits, Status, Stop};
use crate::scenario::StartHeading;
use crate::smoothing::{
    Corners, RedundantNodes, SmoothingConfig, SmoothingError, SmoothingProblem, smooth_while,
};
use std::cell::RefCell;

/// Factor on the steps back that are allowed once ants have failed.
const PATIENT_RETREAT: u32 = 20;

sections! {
    /// Parameters of `faco2024`.
    ChordParameters {
        /// The colony that steps by chords, `faco2024`.
        chords: ChordConfig,
        /// Smoothing: from a path over cells to one that a car can drive.
        smoothing: SmoothingConfig,
        /// Weights of transitions, where a request asks for continuous curvature.
        #[cfg_attr(feature = "serde", serde(skip_serializing_if = "DriveCost::is_default"))]
        cost: DriveCost,
    }
}

impl Default for ChordParameters {
    fn default() -> Self {
        Self {
            chords: ChordConfig::default(),
            smoothing: SmoothingConfig {
                redundant_nodes: RedundantNodes::Keep,
                corners: Corners::WideArcs,
                direction_switching_cost: 10.0,
                ..SmoothingConfig::default()
            },
            cost: DriveCost::default(),
        }
    }
}

/// One way of sending the colony.
#[derive(Clone)]
struct Attempt {
    /// By how many turning radii obstacles are grown beyond half the vehicle's width for the
    /// guiding path.
    growth_radii: f64,
    config: ChordConfig,
    start_heading_is_exact: bool,
}

impl Family for ChordParameters {
    /// Sends the colony, each time less careful, until one of its ways can be driven.
    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt> {
        limits.tell(&Event::SearchStarted);
        let mut last = Ended::from(Status::NoPath);
        for attempt in self.attempts(task.request().start_heading) {
            last = match self.run(task, &attempt, limits) {
                Ok(found) => return Ok(found),
                Err(halt) => halt.ended()?,
            };
            let goes_on = match last.status {
                Status::NoPath | Status::Infeasible => true,
                // Of the ants; the request's own budget has no reason of theirs.
                Status::BudgetExhausted => last.reason.is_some(),
                Status::Found | Status::TimedOut | Status::Cancelled => false,
            };
            if !goes_on {
                break;
            }
        }
        Err(last.into())
    }

    fn abilities(&self) -> Abilities {
        Abilities {
            vehicles: Vehicles::Cars,
            sends_ants: true,
            ..Abilities::default()
        }
    }

    fn cost(&self) -> &DriveCost {
        &self.cost
    }
}

impl ChordParameters {
    /// The attempts in their order: ever less growth, more patience in dead ends, no margin, and a
    /// start where the vehicle changes gear.
    fn attempts(&self, start_heading: StartHeading) -> Vec<Attempt> {
        let config = &self.chords;
        let exact = start_heading == StartHeading::Exact;
        let attempt = |&growth_radii: &f64| Attempt {
            growth_radii,
            config: config.clone(),
            start_heading_is_exact: exact,
        };
        let mut attempts: Vec<Attempt> = config.growth_radii.iter().map(attempt).collect();
        let last_growth = config.growth_radii[config.growth_radii.len() - 1];
        let mut last = attempt(&last_growth);
        if let DeadEnd::Retreat(rule) = &mut last.config.dead_end {
            rule.max_steps = rule.max_steps.saturating_mul(PATIENT_RETREAT);
        }
        attempts.push(last.clone());
        if let Safety::Footprint(rule) = &mut last.config.safety
            && rule.margin_cells > 0.0
        {
            rule.margin_cells = 0.0;
            attempts.push(last.clone());
        }
        if exact {
            last.start_heading_is_exact = false;
            attempts.push(last);
        }
        attempts
    }

    /// One run of the colony, and the first of its ways that can be driven.
    fn run(&self, task: &Task, attempt: &Attempt, limits: &mut Limits) -> Result<Found, Halt> {
        let (request, frame) = (task.request(), task.obstacles().frame());
        let cell = |pose: Pose2| frame.cell_at(pose.position()).unwrap_or_default();
        let ends = [request.start, request.goal].map(cell);
        let grown = grown_for_guide(task, attempt.growth_radii, ends);
        let problem = ChordProblem {
            obstacles: task.obstacles(),
            vehicle: task.vehicle(),
            moves: &MoveMasks::new(&grown, DiagonalRule::NoObstacles),
            start: frame.to_grid(request.start),
            start_heading_is_exact: attempt.start_heading_is_exact,
            goal: ends[1],
        };
        let (seed, n_threads) = (task.seed(), task.n_threads());
        let run = run_chords(&problem, &attempt.config, seed, n_threads, limits)?;
        let mut stages = Stages::default();
        let ways: Vec<GridPath> = run.best.iter().chain(&run.earlier).cloned().collect();
        let stop = run.stop;
        let reason = self.reason(stop, run.history.iterations.len());
        stages.colony = Some(run);
        if ways.is_empty() || stop == Stop::Cancelled {
            return Err(Halt::Ended(Ended {
                reason,
                ..Ended::new(stop.status(), stages)
            }));
        }
        Ok(self.first_drivable(task, &ways, stages, &mut stop.limits_after(limits))?)
    }

    /// The first of some ways whose corners can all be rounded.
    fn first_drivable(
        &self,
        task: &Task,
        ways: &[GridPath],
        mut stages: Stages,
        limits: &mut Limits,
    ) -> Result<Found, Ended> {
        let problem = SmoothingProblem {
            obstacles: task.obstacles(),
            vehicle: task.vehicle(),
            blocked: task.obstacles().lethal(),
            rule: DiagonalRule::NoObstacles,
        };
        let config = &self.smoothing;
        let mut first_error: Option<SmoothingError> = None;
        let shared = RefCell::new(&mut *limits);
        let goes_on = || shared.borrow_mut().look().is_ok();
        for way in ways {
            let nodes = config
                .redundant_nodes
                .apply(problem.blocked, problem.rule, way);
            match smooth_while(&problem, (config, task.request()), &nodes, &goes_on) {
                Ok(smoothed) => {
                    stages.grid_path = Some(way.clone());
                    stages.nodes = nodes;
                    stages.corners = smoothed.corners;
                    return Ok(Found::new(smoothed.path, stages));
                }
                Err(error) => {
                    first_error.get_or_insert(error);
                    stages.grid_path.get_or_insert_with(|| way.clone());
                }
            }
        }
        if let Err(status) = limits.look() {
            return Err(Ended::new(status, stages));
        }
        let error = first_error.map_or(String::new(), |error| {
            format!(", the best of them: {error}")
        });
        let reason = format!(
            "the ants found {} ways that cannot be made drivable{error}; hint: more chords.n_ants, or a larger first one of chords.growth_radii",
            ways.len()
        );
        Err(Ended::because(Status::Infeasible, reason, stages))
    }

    /// Why the colony has no path, where that is its own fault.
    fn reason(&self, stop: Stop, n_iterations: usize) -> Option<String> {
        let config = &self.chords;
        match stop {
            Stop::Iterations | Stop::Stall => Some(format!(
                "none of {} ants reached the goal in {n_iterations} generations; hint: more ants (chords.n_ants), a wider corridor (chords.corridor.ratio), or hybrid-astar",
                config.n_ants
            )),
            Stop::TargetCost | Stop::Budget | Stop::Deadline | Stop::Cancelled | Stop::NoWay => {
                None
            }
        }
    }
}

/// Obstacles grown by half the vehicle's width and some turning radii, but not around the
/// ends, where the body is known to be free.
fn grown_for_guide(task: &Task, growth_radii: f64, ends: [Cell; 2]) -> BitGrid {
    let (obstacles, vehicle) = (task.obstacles(), task.vehicle());
    let growth_m = 0.5 * vehicle.width_m() + growth_radii * vehicle.min_turning_radius_m();
    let limit = f64::from(obstacles.distance().truncation_cells()) - 0.5;
    let growth = (growth_m / obstacles.frame().resolution_m()).min(limit);
    let lethal = obstacles.lethal();
    let mut grown = obstacles
        .distance()
        .within(growth)
        .unwrap_or_else(|| lethal.clone());
    let (n_cols, n_rows) = (grown.n_cols(), grown.n_rows());
    for end in ends {
        for radius in 0..=growth.ceil() as u32 + 1 {
            let cells = ring(end, radius, n_cols, n_rows);
            let free = cells.filter(|cell| !lethal.get(cell.col as usize, cell.row as usize));
            grown.remove_all(free);
        }
    }
    grown
}

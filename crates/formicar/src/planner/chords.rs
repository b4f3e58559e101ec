//! Planning by a colony that steps by chords: guide, ants, arcs at every corner.

use super::run::{Ended, Found};
use super::{PlanError, Planner, PlannerName, Stages};
use crate::colony::RunError;
use crate::colony::chord::{ChordConfig, ChordProblem, Safety, run_chords};
use crate::colony::dead_end::DeadEnd;
use crate::geometry::Pose2;
use crate::map::{BitGrid, Cell, DiagonalRule, MoveMasks, ring};
use crate::numeric::Seed;
use crate::path::GridPath;
use crate::progress::{Event, Limits, Status, Stop};
use crate::scenario::{Request, StartHeading};
use crate::search::SearchError;
use crate::smoothing::{SmoothingError, SmoothingProblem, smooth};
use crate::vehicle::Motion;

/// How many times as many steps back are allowed when ants have failed.
const PATIENT_RETREAT: u32 = 20;

/// One way of sending the colony.
#[derive(Clone)]
struct Attempt {
    /// By how many turning radii obstacles are grown beyond half the vehicle's width for the
    /// guiding path.
    growth_radii: f64,
    config: ChordConfig,
    start_heading_is_exact: bool,
}

impl Planner {
    /// Sends the colony, each time less careful, until one of its ways can be driven.
    pub(super) fn send_steering_ants(
        &self,
        request: &Request,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        if self.vehicle.motion() == Motion::Point {
            return Err(PlanError::NeedsACar {
                planner: PlannerName::Faco2024,
            });
        }
        limits.tell(&Event::SearchStarted);
        let mut last = Ended::from(Status::NoPath);
        for attempt in self.attempts(request) {
            match self.steer(request, &attempt, seed, limits)? {
                Ok(found) => return Ok(Ok(found)),
                Err(ended) => last = ended,
            }
            let goes_on = match last.status {
                Status::NoPath | Status::Infeasible => true,
                // Of the ants; the request's own budget has no reason of theirs.
                Status::BudgetExhausted => last.reason.is_some(),
                _ => false,
            };
            if !goes_on {
                break;
            }
        }
        Ok(Err(last))
    }

    /// What is tried in turn: ever less growth, more patience in dead ends, no margin, and a start
    /// where the vehicle changes gear.
    fn attempts(&self, request: &Request) -> Vec<Attempt> {
        let config = &self.config.chords;
        let exact = request.start_heading == StartHeading::Exact;
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
    fn steer(
        &self,
        request: &Request,
        attempt: &Attempt,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        let frame = self.obstacles.frame();
        let cell = |pose: Pose2| frame.cell_at(pose.position()).unwrap_or_default();
        let ends = [request.start, request.goal].map(cell);
        let grown = self.grown_for_guide(attempt.growth_radii, ends);
        let problem = ChordProblem {
            obstacles: &self.obstacles,
            vehicle: &self.vehicle,
            moves: &MoveMasks::new(&grown, DiagonalRule::NoObstacles),
            start: frame.to_grid(request.start),
            start_heading_is_exact: attempt.start_heading_is_exact,
            goal: ends[1],
        };
        let mut stages = Stages::default();
        let run = match run_chords(&problem, &attempt.config, seed, self.n_threads, limits) {
            Ok(run) => run,
            Err(RunError::Search(SearchError::Ended { status })) => {
                return Ok(Err(Ended::new(status, stages)));
            }
            Err(error) => return Err(PlanError::Colony(error)),
        };
        let ways: Vec<GridPath> = run.best.iter().chain(&run.earlier).cloned().collect();
        let stop = run.stop;
        let reason = self.explain_chords(stop, run.history.iterations.len());
        stages.colony = Some(run);
        if ways.is_empty() || stop == Stop::Cancelled {
            return Ok(Err(Ended {
                reason,
                ..Ended::new(stop.status(), stages)
            }));
        }
        Ok(self.first_drivable(request, &ways, stages))
    }

    /// The first of some ways whose corners can all be rounded.
    fn first_drivable(
        &self,
        request: &Request,
        ways: &[GridPath],
        mut stages: Stages,
    ) -> Result<Found, Ended> {
        let problem = SmoothingProblem {
            obstacles: &self.obstacles,
            vehicle: &self.vehicle,
            blocked: self.obstacles.lethal(),
            rule: DiagonalRule::NoObstacles,
        };
        let config = &self.config.smoothing;
        let mut first_error: Option<SmoothingError> = None;
        for way in ways {
            let nodes = config
                .redundant_nodes
                .apply(problem.blocked, problem.rule, way);
            match smooth(&problem, config, request, &nodes) {
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
        let error = first_error.map_or(String::new(), |error| {
            format!(", the best of them: {error}")
        });
        let reason = format!(
            "the ants found {} ways that cannot be made drivable{error}; hint: more chords.n_ants, or a larger first one of chords.growth_radii",
            ways.len()
        );
        Err(Ended::because(Status::Infeasible, reason, stages))
    }

    /// Obstacles grown by half the vehicle's width and some turning radii, but not around the
    /// ends, where the body is known to be free.
    fn grown_for_guide(&self, growth_radii: f64, ends: [Cell; 2]) -> BitGrid {
        let (obstacles, vehicle) = (&self.obstacles, &self.vehicle);
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

    /// Why the colony has no path, where that is its own fault.
    fn explain_chords(&self, stop: Stop, n_iterations: usize) -> Option<String> {
        let config = &self.config.chords;
        match stop {
            Stop::Iterations | Stop::Stall => Some(format!(
                "none of {} ants reached the goal in {n_iterations} generations; hint: more ants (chords.n_ants), a wider corridor (chords.corridor.ratio), or hybrid-astar",
                config.n_ants
            )),
            _ => None,
        }
    }
}

//! Planning by a population of polylines: A* for the measure, generations, a curve.

use super::cells::PreparedCells;
use super::run::{Ended, Found};
use super::{ConfigError, PlanError, Planner, PlannerName, Stages};
use crate::evolution::{EvolutionProblem, EvolutionRun, run};
use crate::map::Cell;
use crate::numeric::Seed;
use crate::parameters::OutOfRange;
use crate::path::GridPath;
use crate::progress::{Event, Limits, Status, Stop};
use crate::scenario::{Request, StartHeading};
use crate::search::{GridSearch, SearchError, astar};

impl Planner {
    /// Breeds polylines, and makes the best of them drivable.
    pub(super) fn evolve(
        &mut self,
        request: &Request,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        self.with_cells(|planner, cells| {
            let ends = match planner.open_ends(request, cells.moves.blocked()) {
                Ok(ends) => ends,
                Err(ended) => return Ok(Err(ended)),
            };
            limits.tell(&Event::SearchStarted);
            let shortest = match shortest(cells, ends, limits) {
                Ok(shortest) => shortest,
                Err(SearchError::Ended { status }) => return Ok(Err(status.into())),
                Err(error) => return Err(PlanError::Search(error)),
            };
            let mut stages = Stages::default();
            let mut way = shortest.path.clone();
            if ends[0] != ends[1] {
                let run = planner.breed(request, seed, (cells, &shortest), limits)?;
                let stop = run.stop;
                let best = run.best.clone();
                let reason = planner.explain_evolution(&run);
                stages.evolution = Some(run);
                let (Some(cells), false) = (best, stop == Stop::Cancelled) else {
                    return Ok(Err(Ended {
                        reason,
                        ..Ended::new(status(stop), stages)
                    }));
                };
                way = GridPath { cells };
            }
            let origin = planner.origin(cells.moves.blocked(), way.cells.len(), "points");
            Ok(planner.curve_of(request, stages, &way, &origin))
        })
    }

    fn breed(
        &self,
        request: &Request,
        seed: Seed,
        (cells, shortest): (&PreparedCells, &GridSearch),
        limits: &mut Limits,
    ) -> Result<EvolutionRun, PlanError> {
        let frame = self.obstacles.frame();
        let steering = self.vehicle.steering_geometry();
        let start_heading_rad = match request.start_heading {
            StartHeading::Exact => Some(frame.to_grid(request.start).heading),
            StartHeading::Any => None,
        };
        let problem = EvolutionProblem::new(&cells.moves, shortest, frame.resolution_m(), steering)
            .map_err(PlanError::Search)?
            .with_start_heading(start_heading_rad);
        let out_of_range = |error: OutOfRange| PlanError::Config(ConfigError::OutOfRange(error));
        run(&problem, &self.config.evolution, seed, limits).map_err(out_of_range)
    }

    /// Why a population has no path, where that is its own fault.
    fn explain_evolution(&self, run: &EvolutionRun) -> Option<String> {
        if !matches!(run.stop, Stop::Iterations | Stop::Stall) {
            return None;
        }
        let config = &self.config.evolution;
        let seeded = match self.config.planner {
            PlannerName::Aga => "",
            _ => ", or aga, which begins about a shortest path",
        };
        Some(format!(
            "none of {} polylines with {} to {} via points is free of collisions after {} generations, the best runs through {:.1} m of grown obstacles; hint: more via points (evolution.n_via, evolution.n_via_max), more individuals (evolution.n_individuals){seeded}",
            config.n_individuals,
            config.n_via_min,
            config.n_via_max,
            run.history.iterations.len(),
            run.least_obstructed_m,
        ))
    }
}

/// The shortest path over cells, by which polylines are measured; its steps are not counted.
fn shortest(
    cells: &mut PreparedCells,
    [start, goal]: [Cell; 2],
    limits: &mut Limits,
) -> Result<GridSearch, SearchError> {
    let PreparedCells { moves, workspace } = cells;
    let mut limits = limits.without_budget();
    astar(moves, start, goal, workspace, &mut limits)
}

/// How a run without a path ended: what it has not found, further generations may.
fn status(stop: Stop) -> Status {
    match stop {
        Stop::Iterations | Stop::Stall => Status::NoPath,
        stop => stop.status(),
    }
}

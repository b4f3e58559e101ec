//! Planning by a colony: layers, ants over cells, nodes, a curve.

use super::curve::Origin;
use super::run::{Ended, Found};
use super::{PlanError, Planner, Stages};
use crate::colony::{ColonyProblem, ColonyRun, RunError, run};
use crate::layers::Layers;
use crate::map::{Cell, MoveMasks};
use crate::numeric::Seed;
use crate::progress::{Event, Limits, Status, Stop};
use crate::scenario::Request;
use crate::search::SearchError;

impl Planner {
    /// Sends the configured colony, and makes its best path drivable.
    pub(super) fn send_ants(
        &self,
        request: &Request,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        let mut stages = Stages::default();
        let ends = self.lay(request, &mut stages);
        let ends = match ends {
            Ok(ends) => ends,
            Err(reason) => return Ok(Err(Ended::because(Status::NoPath, reason, stages))),
        };
        limits.tell(&Event::SearchStarted);
        let run = match self.run_colony(ends, seed, &stages, limits) {
            Ok(run) => run,
            Err(RunError::Search(SearchError::Ended { status })) => {
                return Ok(Err(Ended::new(status, stages)));
            }
            Err(error) => return Err(PlanError::Colony(error)),
        };
        let (best, stop) = (run.best.clone(), run.stop);
        let ended = self.explain_colony(&run);
        stages.colony = Some(run);
        stages.grid_path = best;
        if stages.grid_path.is_none() || stop == Stop::Cancelled {
            return Ok(Err(Ended {
                reason: ended,
                ..Ended::new(stop.status(), stages)
            }));
        }
        Ok(self.drive_the_way(request, stages))
    }

    /// Lays the layers, and finds the cells between which ants walk: those of start and goal or,
    /// where these are covered, the nearest that are not.
    fn lay(&self, request: &Request, stages: &mut Stages) -> Result<[Cell; 2], String> {
        let frame = self.obstacles.frame();
        let cell = |pose: crate::geometry::Pose2| frame.cell_at(pose.position());
        let ends = [request.start, request.goal].map(|pose| cell(pose).unwrap_or_default());
        let width_cells = self.width_cells();
        let config = &self.config.layers;
        let rule = self.config.colony.diagonal_rule;
        let layers = Layers::new(self.obstacles.lethal(), config, &ends, rule, width_cells);
        // The body is free at both ends, so its middle is no farther than this from open ground.
        let radius = 2 * config.expansion.n_cells(width_cells) + 1;
        let open = |end: &str, cell: Cell| {
            layers.nearest_open(cell, radius).ok_or_else(|| {
                format!(
                    "no cell within {radius} cells of the {end} is open after obstacle expansion; hint: a smaller layers.expansion"
                )
            })
        };
        let ends = [open("start", ends[0])?, open("goal", ends[1])?];
        stages.layers = Some(layers);
        Ok(ends)
    }

    fn run_colony(
        &self,
        [start, goal]: [Cell; 2],
        seed: Seed,
        stages: &Stages,
        limits: &mut Limits,
    ) -> Result<ColonyRun, RunError> {
        let config = &self.config.colony;
        let blocked = stages.layers.as_ref().map(|layers| &layers.blocked);
        let blocked = blocked.unwrap_or(self.obstacles.lethal());
        let moves = MoveMasks::new(blocked, config.diagonal_rule);
        let problem = ColonyProblem::new(moves, start, goal);
        run(&problem, config, seed, self.n_threads, limits)
    }

    /// Makes the best path of the colony drivable.
    fn drive_the_way(&self, request: &Request, stages: Stages) -> Result<Found, Ended> {
        let layers = stages.layers.as_ref();
        let blocked = layers.map_or(self.obstacles.lethal(), |layers| &layers.blocked);
        let blocked = blocked.clone();
        let way = stages.grid_path.clone().unwrap_or_default();
        let origin = Origin {
            blocked: &blocked,
            rule: self.config.colony.diagonal_rule,
            found: format!("the ants found a way of {} cells", way.cells.len()),
            hint: "a larger layers.expansion keeps them off corners",
        };
        self.curve_of(request, stages, &way, &origin)
    }

    /// Why a colony has no path, where that is its own fault.
    fn explain_colony(&self, run: &ColonyRun) -> Option<String> {
        let config = &self.config;
        let n_expanded = config.layers.expansion.n_cells(self.width_cells());
        match run.stop {
            Stop::Iterations | Stop::Stall => Some(format!(
                "none of {} ants reached the goal in {} iterations; hint: more ants (colony.n_ants), colony.guidance.rule=\"advantage\" or colony.dead_end.rule=\"retreat\"",
                config.colony.n_ants,
                run.history.iterations.len()
            )),
            Stop::NoWay if n_expanded > 0 => Some(format!(
                "no steps lead from start to goal among obstacles grown by {n_expanded} cells; hint: a smaller layers.expansion, or hybrid-astar, which uses the true footprint"
            )),
            _ => None,
        }
    }

    fn width_cells(&self) -> f64 {
        self.vehicle.width_m() / self.obstacles.frame().resolution_m()
    }
}

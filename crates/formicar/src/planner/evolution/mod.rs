//! `ga` and `aga`, populations of polylines: A* for the measure, generations, a curve.

use super::cells::{GridSearchConfig, one_goal, taut};
use super::family::{Family, sections};
use super::polyline::CellPath;
use super::prepared::PreparedCells;
use super::{Abilities, ConfigError, Ended, Found, Halt, PlanError, Stages, Task};
use crate::evolution::{EvolutionConfig, EvolutionProblem, EvolutionRun, InitialPopulation, run};
use crate::map::Cell;
use crate::objective::DriveCost;
use crate::path::GridPath;
use crate::progress::{Event, Limits, Status, Stop};
use crate::scenario::StartHeading;
use crate::search::{GridSearch, SearchError, astar};
use crate::smoothing::SmoothingConfig;

sections! {
    /// Parameters of `ga` and `aga`.
    EvolutionParameters {
        /// Steps of the planners over cells: `astar`, `dijkstra`, `improved-astar`, and `ga`
        /// and `aga`, which measure themselves by the shortest path over cells.
        grid_search: GridSearchConfig,
        /// The population.
        evolution: EvolutionConfig,
        /// Smoothing: from a path over cells to one that a car can drive.
        smoothing: SmoothingConfig,
        /// Weights of transitions, where a request asks for continuous curvature.
        #[cfg_attr(feature = "serde", serde(skip_serializing_if = "DriveCost::is_default"))]
        cost: DriveCost,
    }
}

impl Default for EvolutionParameters {
    fn default() -> Self {
        Self::of(EvolutionConfig::default())
    }
}

impl EvolutionParameters {
    /// A population on obstacles grown by half the vehicle's width, corners rounded.
    pub fn of(evolution: EvolutionConfig) -> Self {
        Self {
            grid_search: GridSearchConfig::default(),
            evolution,
            smoothing: taut(),
            cost: DriveCost::default(),
        }
    }
}

impl Family for EvolutionParameters {
    /// Breeds polylines, and makes the best of them drivable.
    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt> {
        task.with_cells(self.grid_search.diagonal_rule, |task, cells| {
            limits.look()?;
            let ends = task.open_ends(cells.moves.blocked())?;
            limits.tell(&Event::SearchStarted);
            let shortest = shortest(cells, ends, limits)?;
            let mut stages = Stages::default();
            let mut path = shortest.path.clone();
            let mut stop = Stop::Stall;
            if ends[0] != ends[1] {
                let run = self.breed(task, cells, &shortest, limits)?;
                let (best, reason) = (run.best.clone(), self.reason(&run));
                stop = run.stop;
                stages.evolution = Some(run);
                let Some(best) = best.filter(|_| stop != Stop::Cancelled) else {
                    return Err(Halt::Ended(Ended {
                        reason,
                        ..Ended::new(status(stop), stages)
                    }));
                };
                path = GridPath { cells: best };
            }
            let way = CellPath::of_search(task, &cells.moves, &path, "points");
            Ok(way.made_drivable(
                task,
                &self.smoothing,
                stages,
                &mut stop.limits_after(limits),
            )?)
        })
    }

    fn abilities(&self) -> Abilities {
        one_goal(self.grid_search.diagonal_rule)
    }

    fn cost(&self) -> &DriveCost {
        &self.cost
    }
}

impl EvolutionParameters {
    fn breed(
        &self,
        task: &Task,
        cells: &PreparedCells,
        shortest: &GridSearch,
        limits: &mut Limits,
    ) -> Result<EvolutionRun, PlanError> {
        let frame = task.obstacles().frame();
        let steering = task.vehicle().steering_geometry();
        let start_heading_rad = match task.request().start_heading {
            StartHeading::Exact => Some(frame.to_grid(task.request().start).heading),
            StartHeading::Any => None,
        };
        let problem = EvolutionProblem::new(&cells.moves, shortest, frame.resolution_m(), steering)
            .map_err(PlanError::Search)?
            .with_start_heading(start_heading_rad);
        let run = run(&problem, &self.evolution, task.seed(), limits);
        Ok(run.map_err(ConfigError::OutOfRange)?)
    }

    /// Why the population has no path, where that is its own fault.
    fn reason(&self, run: &EvolutionRun) -> Option<String> {
        if !matches!(run.stop, Stop::Iterations | Stop::Stall) {
            return None;
        }
        let config = &self.evolution;
        let seeded = match config.initial {
            InitialPopulation::AstarSeeded(_) => "",
            InitialPopulation::Random => ", or aga, which begins about a shortest path",
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

/// The status of a run without a path: further generations may find one.
fn status(stop: Stop) -> Status {
    match stop {
        Stop::Iterations | Stop::Stall => Status::NoPath,
        Stop::TargetCost | Stop::Budget | Stop::Deadline | Stop::Cancelled | Stop::NoWay => {
            stop.status()
        }
    }
}

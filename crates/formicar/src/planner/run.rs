//! From a request to a certified path: search, curve, judge, metrics.

use super::{NotFound, Outcome, Plan, PlanError, Planner, PlannerName, Stages};
use crate::collision::ObstacleMap;
use crate::geometry::{Arc, Point2, Pose2};
use crate::map::{BitGrid, Cell, MoveMasks};
use crate::metrics::{ClearanceSummary, PathMetrics};
use crate::numeric::Seed;
use crate::path::{CurvePath, Direction, GridPath};
use crate::progress::{Event, Limits, Status};
use crate::scenario::{Request, StartHeading};
use crate::search::{
    AstarWorkspace, GoalField, GridSearch, HybridProblem, SearchError, astar, hybrid_astar,
};
use crate::validation::judge;
use crate::vehicle::{Motion, Vehicle};

/// What a search found, before it is judged.
pub(super) struct Found {
    pub(super) path: CurvePath,
    pub(super) stages: Stages,
}

/// A search that ended by itself without a path.
pub(super) struct Ended {
    pub(super) status: Status,
    /// Why, where the status does not say it all.
    pub(super) reason: Option<String>,
    pub(super) stages: Box<Stages>,
}

impl Ended {
    pub(super) fn new(status: Status, stages: Stages) -> Self {
        Self {
            status,
            reason: None,
            stages: Box::new(stages),
        }
    }

    pub(super) fn because(status: Status, reason: String, stages: Stages) -> Self {
        Self {
            reason: Some(reason),
            ..Self::new(status, stages)
        }
    }
}

impl From<Status> for Ended {
    fn from(status: Status) -> Self {
        Self::new(status, Stages::default())
    }
}

impl Planner {
    /// Runs the configured search.
    pub(super) fn search(
        &mut self,
        request: &Request,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        let result = match self.config.planner {
            PlannerName::HybridAstar if self.vehicle.motion() == Motion::Car => {
                return self.drive(request, limits);
            }
            PlannerName::HybridAstar => {
                return Err(PlanError::NeedsACar {
                    planner: PlannerName::HybridAstar,
                });
            }
            PlannerName::Astar => self.walk(request, limits, astar_path),
            PlannerName::Dijkstra => self.walk(request, limits, field_path),
            PlannerName::Faco2024 => return self.send_steering_ants(request, seed, limits),
            _ => return self.send_ants(request, seed, limits),
        };
        match result {
            Ok(found) => Ok(Ok(found)),
            Err(SearchError::Ended { status }) => Ok(Err(status.into())),
            // The vehicle fits, but the disc that stands for it on the grid does not.
            Err(SearchError::Blocked { .. }) => Ok(Err(Status::NoPath.into())),
            Err(error) => Err(PlanError::Search(error)),
        }
    }

    fn drive(
        &self,
        request: &Request,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        let problem = HybridProblem::new(
            &self.obstacles,
            &self.vehicle,
            &self.config.hybrid_astar,
            request,
        )?;
        limits.tell(&Event::SearchStarted);
        let driven = hybrid_astar(&problem, limits).map_err(Ended::from);
        Ok(driven.map(|(start, arcs)| {
            let start = match request.start_heading {
                StartHeading::Exact => request.start,
                StartHeading::Any => self.obstacles.frame().to_world(start).wrapped(),
            };
            Found {
                path: curve(start, &arcs),
                stages: Stages::default(),
            }
        }))
    }

    /// A search over cells, on obstacles grown by half the vehicle's width.
    fn walk(
        &mut self,
        request: &Request,
        limits: &mut Limits,
        search: impl FnOnce(
            &MoveMasks,
            [Cell; 2],
            &mut AstarWorkspace,
            &mut Limits,
        ) -> Result<GridSearch, SearchError>,
    ) -> Result<Found, SearchError> {
        let Self {
            obstacles,
            vehicle,
            config,
            grid,
            ..
        } = self;
        let (moves, workspace) = grid.get_or_insert_with(|| {
            let moves = MoveMasks::new(
                &blocked(obstacles, vehicle),
                config.grid_search.diagonal_rule,
            );
            (moves, AstarWorkspace::new())
        });
        limits.tell(&Event::SearchStarted);
        let frame = obstacles.frame();
        let cell = |pose: Pose2| frame.cell_at(pose.position()).unwrap_or_default();
        let found = search(
            moves,
            [cell(request.start), cell(request.goal)],
            workspace,
            limits,
        )?;
        let points = waypoints(&found.path, request, |cell| frame.center(cell));
        Ok(Found {
            path: CurvePath::from_polyline(&points),
            stages: Stages {
                grid_path: Some(found.path),
                ..Stages::default()
            },
        })
    }

    /// Lets the judge decide, and says why where there is no path.
    pub(super) fn conclude(
        &self,
        request: &Request,
        seed: Seed,
        found: Result<Found, Ended>,
        limits: &mut Limits,
    ) -> Outcome {
        let n_steps = limits.n_steps();
        let found = match found {
            Ok(found) => found,
            Err(ended) => {
                let explained = || self.explain(request, ended.status, n_steps);
                return Outcome::NotFound(Box::new(NotFound {
                    status: ended.status,
                    reason: ended.reason.unwrap_or_else(explained),
                    refused: None,
                    stages: *ended.stages,
                    n_steps,
                }));
            }
        };
        match judge(&self.obstacles, &self.vehicle, request, &found.path).certify() {
            Ok(certificate) => {
                limits.tell(&Event::Improved {
                    length_m: found.path.length_m(),
                    n_steps,
                });
                let min_m = certificate.min_clearance_m;
                let clearance =
                    ClearanceSummary::new(&self.obstacles, &self.vehicle, &found.path, min_m);
                let metrics = PathMetrics::new(&found.path, &self.vehicle, request.goal, clearance);
                let planner = self.config.planner;
                Outcome::Found(Box::new(Plan {
                    planner,
                    seed,
                    path: found.path,
                    stages: found.stages,
                    certificate,
                    metrics,
                    n_steps,
                }))
            }
            Err(report) => {
                let n = report.violations.len();
                let first = report
                    .violations
                    .first()
                    .map_or(String::new(), |v| format!(": {}", v.message));
                let reason = format!(
                    "the judge refused the path that {} found, {n} violation{}{first}",
                    self.config.planner.name(),
                    if n == 1 { "" } else { "s, first" }
                );
                let refused = Some((found.path, *report));
                Outcome::NotFound(Box::new(NotFound {
                    status: Status::Infeasible,
                    reason,
                    refused,
                    stages: found.stages,
                    n_steps,
                }))
            }
        }
    }
}

/// Cells on which the vehicle's middle may not be: within half its width of an obstacle.
fn blocked(obstacles: &ObstacleMap, vehicle: &Vehicle) -> BitGrid {
    let half_width_cells = 0.5 * vehicle.width_m() / obstacles.frame().resolution_m();
    let limit = f64::from(obstacles.distance().truncation_cells()) - 0.5;
    let grown = obstacles.distance().within(half_width_cells.min(limit));
    grown.unwrap_or_else(|| obstacles.lethal().clone())
}

fn astar_path(
    moves: &MoveMasks,
    [start, goal]: [Cell; 2],
    workspace: &mut AstarWorkspace,
    limits: &mut Limits,
) -> Result<GridSearch, SearchError> {
    astar(moves, start, goal, workspace, limits)
}

fn field_path(
    moves: &MoveMasks,
    [start, goal]: [Cell; 2],
    _: &mut AstarWorkspace,
    limits: &mut Limits,
) -> Result<GridSearch, SearchError> {
    GoalField::new(moves, &[goal], limits)?.path(moves, start)
}

fn curve(start: Pose2, arcs: &[Arc]) -> CurvePath {
    let mut path = CurvePath::new(start);
    for arc in arcs {
        let direction = if arc.signed_length_m < 0.0 {
            Direction::Reverse
        } else {
            Direction::Forward
        };
        path.push(arc.curvature_per_m, arc.length_m(), direction);
    }
    path
}

/// Start, the cells where the direction changes, goal; within the end cells straight lines join
/// the poses to the centers.
fn waypoints(path: &GridPath, request: &Request, center: impl Fn(Cell) -> Point2) -> Vec<Point2> {
    let cells = &path.cells;
    let step = |a: Cell, b: Cell| {
        (
            i64::from(b.col) - i64::from(a.col),
            i64::from(b.row) - i64::from(a.row),
        )
    };
    let corner = |i: usize| {
        i == 0
            || i + 1 == cells.len()
            || step(cells[i - 1], cells[i]) != step(cells[i], cells[i + 1])
    };
    let mut points = vec![request.start.position()];
    points.extend(
        (0..cells.len())
            .filter(|&i| corner(i))
            .map(|i| center(cells[i])),
    );
    points.push(request.goal.position());
    points.dedup_by(|a, b| a.distance(*b) < 1e-9);
    points
}

//! From a request to a certified path: search, curve, judge, metrics.

use super::{NotFound, Outcome, Plan, PlanError, Planner, PlannerName, Stages};
use crate::metrics::{ClearanceSummary, PathMetrics};
use crate::numeric::Seed;
use crate::path::CurvePath;
use crate::progress::{Event, Limits, Status};
use crate::scenario::{Request, StartHeading};
use crate::search::{DriveGround, DriveProblem, hybrid_astar};
use crate::validation::judge;
use crate::vehicle::Motion;
use std::sync::Arc;

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
        match self.config.planner {
            PlannerName::Formicar if self.vehicle.motion() == Motion::Car => {
                self.race(request, seed, limits)
            }
            PlannerName::HybridAstar if self.vehicle.motion() == Motion::Car => {
                self.drive(request, limits)
            }
            planner @ (PlannerName::Formicar | PlannerName::HybridAstar) => {
                Err(PlanError::NeedsACar { planner })
            }
            PlannerName::Astar | PlannerName::Dijkstra | PlannerName::ImprovedAstar => {
                self.walk(request, limits)
            }
            PlannerName::Ga | PlannerName::Aga => self.evolve(request, seed, limits),
            PlannerName::Faco2024 => self.send_steering_ants(request, seed, limits),
            _ => self.send_ants(request, seed, limits),
        }
    }

    /// The map prepared for the vehicle's motions, once.
    pub(super) fn drive_ground(&mut self) -> Result<Arc<DriveGround>, PlanError> {
        if let Some(ground) = &self.drive_ground {
            return Ok(ground.clone());
        }
        let (obstacles, config) = (self.obstacles.clone(), &self.config.hybrid_astar);
        let ground = Arc::new(DriveGround::new(obstacles, &self.vehicle, config)?);
        Ok(self.drive_ground.insert(ground).clone())
    }

    fn drive(
        &mut self,
        request: &Request,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        let ground = self.drive_ground()?;
        let problem = DriveProblem::new(&ground, &self.config.hybrid_astar, request);
        limits.tell(&Event::SearchStarted);
        let driven = hybrid_astar(&problem, limits).map_err(Ended::from);
        Ok(driven.map(|(start, arcs)| {
            let start = match request.start_heading {
                StartHeading::Exact => request.start,
                StartHeading::Any => self.obstacles.frame().to_world(start).wrapped(),
            };
            Found {
                path: CurvePath::from_arcs(start, &arcs),
                stages: Stages::default(),
            }
        }))
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

//! From a request to a certified path: search, curve, judge, metrics.

use super::{Explanation, NotFound, Outcome, Plan, PlanError, Planner, PlannerName, Stages};
use crate::geometry::{self, Pose2};
use crate::layers::SoftCosts;
use crate::metrics::{ClearanceSummary, PathMetrics};
use crate::numeric::Seed;
use crate::path::CurvePath;
use crate::progress::{Event, Limits, Status};
use crate::scenario::{Request, StartHeading};
use crate::search::{DrivableMap, DriveProblem, hybrid_astar};
use crate::validation::judge;
use crate::vehicle::Motion;
use std::sync::Arc;

/// What a search found, before it is judged.
pub(super) struct Found {
    pub(super) path: CurvePath,
    pub(super) stages: Stages,
    /// What ended its improvement early.
    pub(super) cut_by: Option<Status>,
}

impl Found {
    pub(super) fn new(path: CurvePath, stages: Stages) -> Self {
        Self {
            path,
            stages,
            cut_by: None,
        }
    }
}

/// A search that ended by itself without a path.
pub(super) struct Ended {
    pub(super) status: Status,
    /// Why, where the status does not say it all.
    pub(super) reason: Option<String>,
    /// The same in places and measures, where it is known already.
    pub(super) explanation: Option<Box<Explanation>>,
    pub(super) stages: Box<Stages>,
}

impl Ended {
    pub(super) fn new(status: Status, stages: Stages) -> Self {
        Self {
            status,
            reason: None,
            explanation: None,
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
    /// Finds a path of lines and arcs to any of the goals, past all via points.
    pub(super) fn find(
        &mut self,
        request: &Request,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        if request.via.is_empty() {
            self.reach(request, seed, limits)
        } else {
            limits.in_parts(|limits| self.search_legs(request, seed, limits))
        }
    }

    /// Runs the configured search for a request without via points; planners that do not drive
    /// plan to its first goal alone.
    pub(super) fn search(
        &mut self,
        request: &Request,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        match self.config.planner {
            PlannerName::Formicar if self.vehicle.motion() == Motion::Car => {
                self.drive_and_improve(request, seed, limits)
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
    pub(super) fn drive_ground(&mut self) -> Result<Arc<DrivableMap>, PlanError> {
        if let Some(ground) = &self.drive_ground {
            return Ok(ground.clone());
        }
        let (obstacles, config) = (self.obstacles.clone(), &self.config.hybrid_astar);
        let ground = Arc::new(DrivableMap::new(obstacles, &self.vehicle, config)?);
        Ok(self.drive_ground.insert(ground).clone())
    }

    /// Searches by hybrid A*; where soft costs are given, again with these. A preference fails no
    /// search: without a path that heeds them, the first one stays.
    fn drive(
        &mut self,
        request: &Request,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        limits.tell(&Event::SearchStarted);
        let plain = self.drive_with(None, request, limits)?;
        let (Some(costs), Ok(_)) = (self.soft_costs.clone(), &plain) else {
            return Ok(plain);
        };
        match self.drive_with(Some(&costs), request, limits)? {
            Err(ended) if ended.status != Status::Cancelled => Ok(plain),
            preferred => Ok(preferred),
        }
    }

    fn drive_with(
        &mut self,
        costs: Option<&SoftCosts>,
        request: &Request,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        let ground = self.drive_ground()?;
        let problem =
            DriveProblem::new(&ground, &self.config.hybrid_astar, request).with_soft_costs(costs);
        let driven = hybrid_astar(&problem, limits).map_err(Ended::from);
        Ok(driven.map(|(start, arcs)| self.driven(request, start, &arcs)))
    }

    /// What was found by a search that drives from a start pose in grid coordinates.
    pub(super) fn driven(&self, request: &Request, start: Pose2, arcs: &[geometry::Arc]) -> Found {
        let start = match request.start_heading {
            StartHeading::Exact => request.start,
            StartHeading::Any => self.obstacles.frame().to_world(start).wrapped(),
        };
        Found::new(CurvePath::from_arcs(start, arcs), Stages::default())
    }

    /// A search that ended without a path, explained.
    fn give_up(&self, request: &Request, ended: Ended, n_steps: u64) -> NotFound {
        let (reason, explanation) = match (ended.reason, ended.explanation) {
            (Some(reason), Some(explanation)) => (reason, *explanation),
            (reason, explanation) => {
                let (sentence, measured) = self.explain(request, ended.status, n_steps);
                let explanation = explanation.map_or(measured, |told| *told);
                (reason.unwrap_or(sentence), explanation)
            }
        };
        NotFound {
            status: ended.status,
            reason,
            explanation,
            refused: None,
            stages: *ended.stages,
            n_steps,
        }
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
                return Outcome::NotFound(Box::new(self.give_up(request, ended, n_steps)));
            }
        };
        match judge(&self.obstacles, &self.vehicle, request, &found.path).certify() {
            Ok(certificate) => {
                limits.tell_improved(&found.path);
                let min_m = certificate.min_clearance_m;
                let clearance =
                    ClearanceSummary::new(&self.obstacles, &self.vehicle, &found.path, min_m);
                let goal = request
                    .reached_goal(self.vehicle.motion(), found.path.end())
                    .goal;
                let metrics = PathMetrics::new(&found.path, &self.vehicle, goal, clearance);
                let planner = self.config.planner;
                Outcome::Found(Box::new(Plan {
                    planner,
                    seed,
                    path: found.path,
                    stages: found.stages,
                    certificate,
                    metrics,
                    n_steps,
                    cut_by: found.cut_by,
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
                    explanation: Explanation::default(),
                    refused,
                    stages: found.stages,
                    n_steps,
                }))
            }
        }
    }
}

//! The race for a first path: ants that drive against hybrid A*, in turns of so many steps, so
//! that who wins does not depend on a clock.

use super::Planner;
use super::run::{Ended, Found};
use super::{PlanError, Stages};
use crate::colony::drive::DriveColony;
use crate::geometry::{Arc, Pose2};
use crate::numeric::Seed;
use crate::path::CurvePath;
use crate::progress::{Event, Limits, Status};
use crate::scenario::{Request, StartHeading};
use crate::search::{DriveProblem, Guide, HybridSearch, Stage};

/// Steps of hybrid A* in the first turn.
const FIRST_TURN_STEPS: u64 = 500;

impl Planner {
    /// Lets both run until one has a path.
    pub(super) fn race(
        &mut self,
        request: &Request,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        let ground = self.drive_ground()?;
        let problem = DriveProblem::new(&ground, &self.config.hybrid_astar, request);
        limits.tell(&Event::SearchStarted);
        let driven = self.first_path(&problem, seed, limits).map_err(Ended::from);
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

    fn first_path(
        &self,
        problem: &DriveProblem,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<(Pose2, Vec<Arc>), Status> {
        if let Some(path) = straight_shot(problem) {
            return Ok(path);
        }
        for (place, stage) in Stage::ladder(problem).enumerate() {
            if let Some(path) = self.run_stage(&stage, seed, place, limits)? {
                return Ok(path);
            }
        }
        Err(Status::NoPath)
    }

    fn run_stage(
        &self,
        stage: &Stage,
        seed: Seed,
        place: usize,
        limits: &mut Limits,
    ) -> Result<Option<(Pose2, Vec<Arc>)>, Status> {
        let problem = &stage.problem;
        let Some(mut guide) = Guide::new(problem, stage.inflation, limits)? else {
            return Ok(None);
        };
        let mut hybrid = HybridSearch::new(problem, &mut guide, limits)?;
        let seed = Seed(seed.stream([place as u64, 0]).next_u64());
        let mut ants = DriveColony::new(problem, &self.config.drive, seed);
        let (mut n_left, mut turn) = (stage.patience_steps, FIRST_TURN_STEPS);
        let mut n_generations = 0;
        while n_left > 0 {
            if n_generations < 60 && place < 3 && self.config.drive.n_ants > 0 {
                n_generations += 1;
                if let Some(path) = ants.send(&mut guide, limits)? {
                    return Ok(Some(path));
                }
            }
            let n_steps = turn.min(n_left);
            match hybrid.run(&mut guide, n_steps, limits) {
                Ok(Some(path)) => return Ok(Some(path)),
                Ok(None) => {}
                Err(Status::NoPath) => return Ok(None),
                Err(status) => return Err(status),
            }
            n_left -= n_steps;
            turn = turn.saturating_mul(5) / 4;
        }
        Ok(None)
    }
}

/// A curve from a start to a goal that meets nothing.
fn straight_shot(problem: &DriveProblem) -> Option<(Pose2, Vec<Arc>)> {
    let shots = problem.start_states().filter_map(|start| {
        let (arcs, cost) = problem.shot(&start)?;
        Some((cost, (start.pose, arcs)))
    });
    shots
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, path)| path)
}

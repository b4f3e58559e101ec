//! Generations of ants that drive: from the start until one arrives, or from a known path.

use super::shared::DriveShared;
use super::trails::Trails;
use super::walk::{DriveWorker, Ways};
use super::{DriveConfig, repair};
use crate::colony::worker_pool::{WorkerPool, with_workers};
use crate::geometry::{Arc, Pose2};
use crate::numeric::Seed;
use crate::progress::{DriveView, DriveWay, Event, Limits, Status};
use crate::search::{DriveProblem, Driven, Guide, State};
use std::sync::Arc as SharedArc;

/// Width of a bin of pheromone, map cells.
const BIN_CELLS: f64 = 4.0;

/// Ants that drive, a generation at a time.
pub struct DriveColony<'a, 'c> {
    problem: DriveProblem<'a>,
    config: DriveConfig,
    pool: &'c mut WorkerPool<DriveWorker<'a>>,
    shared: SharedArc<DriveShared<'a>>,
    ways: Ways,
    generation: u32,
}

impl<'a> DriveColony<'a, '_> {
    /// Runs `body` with a colony on at most `n_threads` threads, and returns the guide.
    pub fn with<R>(
        problem: &DriveProblem<'a>,
        config: &DriveConfig,
        (seed, n_threads): (Seed, usize),
        guide: Guide<'a>,
        body: impl FnOnce(&mut DriveColony<'a, '_>) -> R,
    ) -> (R, Guide<'a>) {
        let bin_m = BIN_CELLS * problem.map().obstacles().frame().resolution_m();
        let shared = SharedArc::new(DriveShared {
            guide,
            trails: Trails::new(bin_m),
            starts: problem.start_states().collect(),
            first_wins: true,
        });
        let worker = || DriveWorker::new(problem, config, seed);
        let (result, shared) = with_workers(worker, config.n_ants.max(1), n_threads, |pool| {
            let mut colony = DriveColony {
                problem: problem.clone(),
                config: config.clone(),
                pool,
                shared,
                ways: Ways::default(),
                generation: 0,
            };
            (body(&mut colony), colony.shared)
        });
        let shared = SharedArc::into_inner(shared).expect("the threads have ended");
        (result, shared.guide)
    }

    /// The guide, between generations.
    pub fn guide(&mut self) -> &mut Guide<'a> {
        &mut self.shared_mut().guide
    }

    fn shared_mut(&mut self) -> &mut DriveShared<'a> {
        SharedArc::get_mut(&mut self.shared).expect("threads drop what they have read")
    }

    /// Sends a generation to look for a first path: that of the first ant that arrives. If none
    /// arrives, the guide is repaired where ants died. A step of the limits is a decision of an ant.
    ///
    /// # Errors
    /// Budget, deadline or cancel.
    pub fn look_for_a_way(&mut self, limits: &mut Limits) -> Result<Option<Driven>, Status> {
        let ways = self.walk(limits)?;
        let n_told = ways.iter().position(|way| way.died_at.is_none());
        self.tell(
            &ways[..n_told.map_or(ways.len(), |place| place + 1)],
            limits,
        );
        let mut deaths = Vec::new();
        for way in ways {
            if limits.take(way.n_steps) < way.n_steps {
                return Err(Status::BudgetExhausted);
            }
            match way.died_at {
                None => return Ok(Some((way.start, way.arcs))),
                Some(place) => deaths.push(place),
            }
        }
        let (radius_m, repair) = (self.problem.map().radius_m(), self.config.repair.clone());
        self.guide().repair(
            |grid| repair::tolls(&repair, &deaths, radius_m, grid),
            limits,
        )?;
        Ok(None)
    }

    /// Sends a generation of focused ants: each leaves a known path at a random position and drives
    /// to the goal on its own, attracted by pheromone. Returns all paths that arrived, from the
    /// start on, in the ants' order.
    ///
    /// # Errors
    /// Budget, deadline or cancel.
    pub fn focus(
        &mut self,
        (start, arcs): (Pose2, &[Arc]),
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Vec<Vec<Arc>>, Status> {
        let length_m: f64 = arcs.iter().map(|arc| arc.length_m()).sum();
        let mut draw = seed.stream([u64::from(self.generation), 0]);
        let n_branches = self.config.n_ants.div_ceil(2);
        let branches: Vec<_> = (0..n_branches)
            .map(|_| cut(start, arcs, length_m * draw.unit()))
            .collect();
        let (rho, deposit) = (self.config.trails.rho, self.config.trails.deposit);
        let shared = self.shared_mut();
        shared.trails.renew(rho, deposit, start, arcs);
        shared.first_wins = false;
        shared.starts = branches.iter().map(|branch| branch.1).collect();
        let ways = self.walk(limits)?;
        self.tell(&ways, limits);
        let mut whole = Vec::new();
        for (index, way) in ways.into_iter().enumerate() {
            if limits.take(way.n_steps) < way.n_steps {
                return Err(Status::BudgetExhausted);
            }
            if way.died_at.is_none() {
                let (before, _) = &branches[index / 2 % branches.len()];
                whole.push(before.iter().copied().chain(way.arcs).collect());
            }
        }
        Ok(whole)
    }

    /// The paths of a generation.
    fn walk(&mut self, limits: &mut Limits) -> Result<Vec<DriveWay>, Status> {
        limits.look()?;
        let (shared, ways) = (&self.shared, &mut self.ways);
        self.pool
            .walk_while(shared, self.generation, ways, &mut || limits.look().is_ok());
        limits.look()?;
        self.generation += 1;
        Ok(std::mem::take(&mut self.ways.0))
    }

    /// Reports the last generation to the observer.
    fn tell(&self, ways: &[DriveWay], limits: &mut Limits) {
        limits.tell(&Event::Drive(DriveView {
            generation: self.generation - 1,
            n_steps: limits.n_steps(),
            ways,
        }));
    }
}

/// A path cut off after a driven length: the arcs until there, and the state there.
fn cut(start: Pose2, arcs: &[Arc], driven_m: f64) -> (Vec<Arc>, State) {
    let (mut before, mut pose, mut left_m) = (Vec::new(), start, driven_m);
    for &arc in arcs {
        let length_m = left_m.min(arc.length_m());
        let part = Arc::new(arc.curvature_per_m, length_m.copysign(arc.signed_length_m));
        before.push(part);
        pose = part.end_from(pose);
        left_m -= length_m;
        if left_m <= 0.0 {
            break;
        }
    }
    let arc = before.last().copied().unwrap_or_default();
    (before, State::start(pose, arc))
}

//! Generations of ants that drive, until one arrives.

use super::ant::{Ant, Way};
use super::{DriveConfig, repair};
use crate::geometry::{Arc, Pose2};
use crate::numeric::Seed;
use crate::progress::{Limits, Status};
use crate::search::{DriveProblem, Guide};

/// Ants that look for a first way, a generation at a time.
pub struct DriveColony<'a> {
    problem: DriveProblem<'a>,
    config: DriveConfig,
    /// One that drives forward until its last curve, and one that uses both gears.
    ants: [Ant<'a>; 2],
    seed: Seed,
    generation: u64,
}

impl<'a> DriveColony<'a> {
    /// A colony about to begin.
    pub fn new(problem: &DriveProblem<'a>, config: &DriveConfig, seed: Seed) -> Self {
        Self {
            ants: [
                Ant::new(&problem.forward_on_the_way(), config),
                Ant::new(problem, config),
            ],
            problem: problem.clone(),
            config: config.clone(),
            seed,
            generation: 0,
        }
    }

    /// Sends a generation. The cheapest way that arrived, from the request's start, or none; then
    /// the guide has learned where ants died. A step of the limits is a decision of an ant.
    ///
    /// # Errors
    /// Budget, deadline or cancel.
    pub fn send(
        &mut self,
        guide: &mut Guide,
        limits: &mut Limits,
    ) -> Result<Option<(Pose2, Vec<Arc>)>, Status> {
        let starts: Vec<_> = self.problem.start_states().collect();
        let mut deaths = Vec::new();
        for index in 0..self.config.n_ants {
            let mut draw = self.seed.stream([self.generation, u64::from(index)]);
            let start = starts[index as usize / 2 % starts.len()];
            let is_greedy = index < 2;
            let way: Way = self.ants[index as usize % 2].drive(guide, start, &mut draw, is_greedy);
            limits.look()?;
            if limits.take(way.n_steps) < way.n_steps {
                return Err(Status::BudgetExhausted);
            }
            match way.died_at {
                None => {
                    let path = (way.start, way.arcs);
                    return Ok(Some(self.problem.in_driving_order(path)));
                }
                Some(place) => deaths.push(place),
            }
        }
        self.generation += 1;
        guide.repair(
            |resolution_m, size| {
                let radius_m = self.problem.ground().radius_m();
                repair::tolls(&self.config.repair, &deaths, radius_m, resolution_m, size)
            },
            limits,
        )?;
        Ok(None)
    }
}

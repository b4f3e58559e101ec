//! The race for a first path: ants that drive against hybrid A*, in turns of so many steps, so
//! that who wins does not depend on a clock.

use crate::colony::drive::{DriveColony, DriveConfig, Racers};
use crate::geometry::{Arc, Pose2};
use crate::numeric::Seed;
use crate::progress::{Limits, Status};
use crate::search::{DriveProblem, Guide, HybridSearch, Stage};

/// Steps of hybrid A* in the first turn; each turn is a quarter longer than the one before.
const FIRST_TURN_STEPS: u64 = 500;
/// Stages of the ladder in which ants take part.
const N_ANT_STAGES: usize = 3;
/// Generations that ants are sent in a stage.
const N_GENERATIONS: u32 = 60;

/// A start pose and the arcs from there, in grid coordinates.
pub(super) type Driven = (Pose2, Vec<Arc>);

/// Lets both run, stage by stage, until one has a path.
///
/// # Errors
/// No path on any lattice; budget, deadline or cancel.
pub(super) fn first_path(
    problem: &DriveProblem,
    config: &DriveConfig,
    seed: Seed,
    limits: &mut Limits,
) -> Result<Driven, Status> {
    if let Some(path) = straight_shot(problem) {
        return Ok(path);
    }
    let n_before = limits.n_steps();
    for (place, stage) in Stage::ladder(problem).enumerate() {
        let most_steps = problem.config().max_iterations;
        let n_left = most_steps.saturating_sub(limits.n_steps() - n_before);
        if n_left == 0 {
            return Err(Status::BudgetExhausted);
        }
        let stage = Stage {
            patience_steps: stage.patience_steps.min(n_left),
            ..stage
        };
        let seed = Seed(seed.stream([place as u64, 0]).next_u64());
        let has_ants = config.n_ants > 0 && config.race != Racers::HybridAstar;
        let ants = (place < N_ANT_STAGES && has_ants)
            .then(|| DriveColony::new(&stage.problem, config, seed));
        let path = match config.race {
            Racers::Ants => run_ants(&stage, ants, limits)?,
            Racers::Both | Racers::HybridAstar => run(&stage, ants, limits)?,
        };
        if let Some(path) = path {
            return Ok(path);
        }
    }
    match config.race {
        // Ants do not look everywhere.
        Racers::Ants => Err(Status::BudgetExhausted),
        Racers::Both | Racers::HybridAstar => Err(Status::NoPath),
    }
}

/// A curve from a start to a goal that meets nothing.
fn straight_shot(problem: &DriveProblem) -> Option<Driven> {
    let shots = problem.start_states().filter_map(|start| {
        let (arcs, cost) = problem.shot(&start)?;
        Some((cost, (start.pose, arcs)))
    });
    shots
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, path)| path)
}

/// One stage without hybrid A*.
fn run_ants(
    stage: &Stage,
    ants: Option<DriveColony>,
    limits: &mut Limits,
) -> Result<Option<Driven>, Status> {
    let Some(mut ants) = ants else {
        return Ok(None);
    };
    let Some(mut guide) = Guide::new(&stage.problem, stage.inflation, limits)? else {
        return Ok(None);
    };
    for _ in 0..N_GENERATIONS {
        if let Some(path) = ants.send(&mut guide, limits)? {
            return Ok(Some(path));
        }
    }
    Ok(None)
}

/// One stage of the race.
fn run(
    stage: &Stage,
    mut ants: Option<DriveColony>,
    limits: &mut Limits,
) -> Result<Option<Driven>, Status> {
    let Some(mut guide) = Guide::new(&stage.problem, stage.inflation, limits)? else {
        return Ok(None);
    };
    let mut hybrid = HybridSearch::new(&stage.problem, &mut guide, limits)?;
    let (mut n_left, mut turn) = (stage.patience_steps, FIRST_TURN_STEPS);
    let mut n_generations = 0;
    while n_left > 0 {
        if let Some(ants) = ants.as_mut()
            && n_generations < N_GENERATIONS
        {
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

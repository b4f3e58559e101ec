//! The race for a first path: ants that drive against hybrid A*, in turns of so many steps, so
//! that who wins does not depend on a clock.

use crate::colony::drive::{DriveColony, DriveConfig, Racers};
use crate::numeric::Seed;
use crate::progress::{Limits, Status};
use crate::search::{DriveProblem, Driven, Guide, HybridSearch, Stage};

/// Steps of hybrid A* in the first turn; each turn is a quarter longer than the one before.
const FIRST_TURN_STEPS: u64 = 500;
/// Stages of the ladder in which ants take part.
const N_ANT_STAGES: usize = 3;
/// Generations that ants are sent in a stage.
const N_GENERATIONS: u32 = 60;

/// How a race is run.
pub(super) struct Rules<'a> {
    pub(super) config: &'a DriveConfig,
    pub(super) seed: Seed,
    pub(super) n_threads: usize,
}

/// A race that has been won.
pub(super) struct Won<'a> {
    /// The first path.
    pub(super) path: Driven,
    /// Where it was won; nowhere where a single curve was free.
    pub(super) stage: Option<WonStage<'a>>,
}

/// A stage as it stands when the race is won.
pub(super) struct WonStage<'a> {
    pub(super) problem: DriveProblem<'a>,
    pub(super) guide: Guide<'a>,
    /// Hybrid A*, where ants were faster.
    pub(super) hybrid: Option<HybridSearch<'a>>,
}

/// Lets both run, stage by stage, until one has a path.
///
/// # Errors
/// No path on any lattice; budget, deadline or cancel.
pub(super) fn race<'a>(
    problem: &DriveProblem<'a>,
    rules: &Rules,
    limits: &mut Limits,
) -> Result<Won<'a>, Status> {
    if let Some(path) = straight_shot(problem) {
        return Ok(Won { path, stage: None });
    }
    let n_before = limits.n_steps();
    for (place, stage) in Stage::ladder(problem).enumerate() {
        let most_steps = problem.config().max_iterations;
        let n_left = most_steps.saturating_sub(limits.n_steps() - n_before);
        if n_left == 0 {
            return Err(Status::BudgetExhausted);
        }
        let rules = Rules {
            seed: Seed(rules.seed.stream([place as u64, 0]).next_u64()),
            ..*rules
        };
        let stage = Stage {
            patience_steps: stage.patience_steps.min(n_left),
            ..stage
        };
        let has_ants = rules.config.n_ants > 0 && rules.config.race != Racers::HybridAstar;
        let n_generations = if place < N_ANT_STAGES && has_ants {
            N_GENERATIONS
        } else {
            0
        };
        if let Some(won) = run(stage, n_generations, &rules, limits)? {
            return Ok(won);
        }
    }
    // Ants do not look everywhere.
    let is_cut = limits.n_steps() - n_before >= problem.config().max_iterations;
    if is_cut || rules.config.race == Racers::Ants {
        return Err(Status::BudgetExhausted);
    }
    Err(Status::NoPath)
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

/// One stage of the race.
fn run<'a>(
    stage: Stage<'a>,
    n_generations: u32,
    rules: &Rules,
    limits: &mut Limits,
) -> Result<Option<Won<'a>>, Status> {
    let problem = stage.problem;
    let Some(mut guide) = Guide::new(&problem, stage.inflation, limits)? else {
        return Ok(None);
    };
    let mut hybrid = HybridSearch::new(&problem, &mut guide, limits)?;
    let threads = if n_generations == 0 {
        1
    } else {
        rules.n_threads
    };
    let ants = (rules.seed, threads);
    let (winner, guide) = DriveColony::with(&problem, rules.config, ants, guide, |colony| {
        let (mut n_left, mut turn) = (stage.patience_steps, FIRST_TURN_STEPS);
        for generation in 0.. {
            if generation < n_generations
                && let Some(path) = colony.look_for_a_way(limits)?
            {
                return Ok(Some((path, true)));
            }
            if rules.config.race == Racers::Ants {
                if generation < n_generations {
                    continue;
                }
                break;
            }
            let n_steps = turn.min(n_left);
            if let Some(path) = hybrid.run(colony.guide(), n_steps, limits)? {
                return Ok(Some((path, false)));
            }
            n_left -= n_steps;
            turn = turn.saturating_mul(5) / 4;
            if n_left == 0 {
                break;
            }
        }
        Ok(None)
    });
    let (path, is_by_ants) = match winner {
        Ok(Some(winner)) => winner,
        Ok(None) | Err(Status::NoPath) => return Ok(None),
        Err(status) => return Err(status),
    };
    // Hybrid A* turns its own paths; those of ants run as their search does.
    let path = if is_by_ants {
        problem.in_driving_order(path)
    } else {
        path
    };
    Ok(Some(Won {
        path,
        stage: Some(WonStage {
            problem,
            guide,
            hybrid: is_by_ants.then_some(hybrid),
        }),
    }))
}

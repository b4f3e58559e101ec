//! The race for a first path: ants that drive against hybrid A*, in turns of so many steps, so
//! that who wins does not depend on a clock.

use crate::colony::drive::{DriveColony, DriveConfig, Racers};
use crate::numeric::Seed;
use crate::objective::VehicleCost;
use crate::progress::{Limits, Status};
use crate::search::{DriveProblem, Driven, Guide, HybridSearch, Stage};

/// Steps of hybrid A* in the first turn; each turn is a quarter longer than the one before.
const FIRST_TURN_STEPS: u64 = 500;
/// Stages of the ladder in which ants take part: the first, on the lattice of the map.
const N_ANT_STAGES: usize = 3;
/// Generations that ants are sent in a stage.
const N_GENERATIONS: u32 = 60;

/// The rules of a race.
pub(super) struct Rules<'a> {
    pub(super) config: &'a DriveConfig,
    /// What driving costs the vehicle.
    pub(super) cost: VehicleCost,
    pub(super) seed: Seed,
    pub(super) n_threads: usize,
}

/// The first path of a race.
pub(super) struct FirstPath<'a> {
    pub(super) path: Driven,
    pub(super) origin: Origin<'a>,
}

/// The origin of a first path.
pub(super) enum Origin<'a> {
    /// A single curve that was free.
    Curve,
    /// The stage that found it.
    Stage(Box<RaceStage<'a>>),
    /// A previous path made whole: no other takes its place.
    Mended,
}

/// A stage as it stands when the first path is found.
pub(super) struct RaceStage<'a> {
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
) -> Result<FirstPath<'a>, Status> {
    if let Some(path) = problem.cheapest_curve(&rules.cost) {
        return Ok(FirstPath {
            path,
            origin: Origin::Curve,
        });
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
        if let Some(first) = run(stage, n_generations, &rules, limits)? {
            return Ok(first);
        }
    }
    // Ants do not look everywhere.
    let is_cut = limits.n_steps() - n_before >= problem.config().max_iterations;
    if is_cut || rules.config.race == Racers::Ants {
        return Err(Status::BudgetExhausted);
    }
    Err(Status::NoPath)
}

/// The turns of one stage.
struct Turns {
    /// Generations of ants, one per turn.
    n_generations: u32,
    /// Steps of hybrid A*, shared by all turns.
    patience_steps: u64,
    race: Racers,
}

/// A path, by whom it was found.
enum Winner {
    Ants(Driven),
    HybridAstar(Driven),
}

/// One stage of the race.
fn run<'a>(
    stage: Stage<'a>,
    n_generations: u32,
    rules: &Rules,
    limits: &mut Limits,
) -> Result<Option<FirstPath<'a>>, Status> {
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
    let turns = Turns {
        n_generations,
        patience_steps: stage.patience_steps,
        race: rules.config.race,
    };
    let ants = (rules.seed, threads);
    let (winner, guide) = DriveColony::with(&problem, rules.config, ants, guide, |colony| {
        take_turns(colony, &mut hybrid, &turns, limits)
    });
    let (path, hybrid) = match winner {
        // Hybrid A* turns its own paths; those of ants run in the direction of their search.
        Ok(Some(Winner::Ants(path))) => (problem.in_driving_order(path), Some(hybrid)),
        Ok(Some(Winner::HybridAstar(path))) => (path, None),
        Ok(None) | Err(Status::NoPath) => return Ok(None),
        Err(status) => return Err(status),
    };
    Ok(Some(FirstPath {
        path,
        origin: Origin::Stage(Box::new(RaceStage {
            problem,
            guide,
            hybrid,
        })),
    }))
}

/// Lets ants and hybrid A* run in turns until one has a path, or both have used up theirs.
fn take_turns(
    colony: &mut DriveColony,
    hybrid: &mut HybridSearch,
    turns: &Turns,
    limits: &mut Limits,
) -> Result<Option<Winner>, Status> {
    let (mut n_left, mut turn_steps) = (turns.patience_steps, FIRST_TURN_STEPS);
    for generation in 0.. {
        let ants_run = generation < turns.n_generations;
        if ants_run && let Some(path) = colony.look_for_a_way(limits)? {
            return Ok(Some(Winner::Ants(path)));
        }
        if turns.race == Racers::Ants {
            if ants_run {
                continue;
            }
            break;
        }
        let n_steps = turn_steps.min(n_left);
        if let Some(path) = hybrid.run(colony.guide(), n_steps, limits)? {
            return Ok(Some(Winner::HybridAstar(path)));
        }
        n_left -= n_steps;
        turn_steps = turn_steps.saturating_mul(5) / 4;
        if n_left == 0 {
            break;
        }
    }
    Ok(None)
}

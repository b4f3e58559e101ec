//! A search for parameters on scenarios.

use super::objective::{Objective, Reference};
use super::runs::{Asked, TunedRun, run_all};
use super::space::TuningSpace;
use super::state::{Subject, TuningState};
use crate::analysis::statistics::quantile;
use anyhow::{Context, Result, bail};
use formicar::numeric::Seed;
use formicar::planner::PlannerConfig;
use formicar::tuning::{BeeColony, BeeColonyConfig};

/// A tuning: parameters, scenarios, objective and search.
#[derive(Clone, Debug)]
pub struct Tuning {
    /// The parameters.
    pub space: TuningSpace,
    /// Scenarios that are tuned on.
    pub scenarios: Vec<Asked>,
    /// Scenarios that are held back.
    pub held_back: Vec<Asked>,
    /// The objective, which is minimized.
    pub objective: Objective,
    /// Runs of each candidate on each scenario, with the seeds 0 to `n_seeds` - 1.
    pub n_seeds: u64,
    /// Runs on each scenario that was held back, with as many seeds from `n_seeds` on.
    pub n_check_seeds: u64,
    /// The bee colony.
    pub bees: BeeColonyConfig,
    /// Its seed.
    pub seed: Seed,
    /// Runs at once; the result never depends on it.
    pub n_jobs: usize,
}

impl Tuning {
    /// The beginning of a search: the default is its first candidate. References are taken by
    /// [`Tuning::cycle`].
    ///
    /// # Errors
    /// Parameters of the colony out of range, a default outside its range, or a scenario that it
    /// cannot even be asked.
    pub fn begin(&self) -> Result<TuningState> {
        let colony = BeeColony::new(self.space.space.clone(), self.bees.clone(), self.seed)?;
        let own = self.space.own_values()?;
        let hint = "the default must be in its range; hint: --range around it, or another --set";
        let colony = colony.with_known(&own).context(hint)?;
        self.check_scenarios()?;
        let subject = Subject {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            space: self.space.clone(),
            objective: self.objective,
            n_seeds: self.n_seeds,
            scenarios: self.scenarios.iter().map(described).collect(),
        };
        Ok(TuningState {
            subject,
            references: Vec::new(),
            solved: Vec::new(),
            n_invalid: 0,
            colony,
        })
    }

    /// The next cycle.
    ///
    /// # Errors
    /// No failure is known: candidates whose values do not go together count as the worst.
    pub fn cycle(&self, state: &mut TuningState) -> Result<()> {
        if state.references.is_empty() {
            state.references = self.references()?;
            // The default is the first candidate: what its runs solve is told below.
            state.solved = vec![false; self.scenarios.len()];
        }
        let (references, n_invalid) = (&state.references, &mut state.n_invalid);
        let solved = &mut state.solved;
        let mut evaluate = |all: &[Vec<f64>]| {
            let (scores, found) = self.scores(all, references);
            let pairs = solved.iter_mut().zip(found);
            pairs.for_each(|(solved, found)| *solved |= found);
            *n_invalid += scores.iter().filter(|score| score.is_infinite()).count() as u64;
            scores
        };
        state.colony.cycle(&mut evaluate)?;
        Ok(())
    }

    /// Refuses scenarios that the default cannot even be asked: all their runs would fail alike.
    fn check_scenarios(&self) -> Result<()> {
        let default = self.default_config()?;
        for asked in self.scenarios.iter().chain(&self.held_back) {
            if let Some(reason) = asked.refusal(&default) {
                bail!(
                    "{}: {} cannot be asked this: {reason}; hint: leave the scenario out, or take \
                     another --planner",
                    asked.ground.map,
                    default.planner().name()
                );
            }
        }
        Ok(())
    }

    /// The default's medians on each scenario.
    fn references(&self) -> Result<Vec<Reference>> {
        let default = self.default_config()?;
        let seeds = 0..self.n_seeds;
        let runs = run_all(
            &[("default", default)],
            &self.scenarios,
            &seeds,
            self.n_jobs,
        );
        let pairs = self.scenarios.iter().zip(runs.iter().flatten());
        Ok(pairs.map(|(asked, runs)| reference(asked, runs)).collect())
    }

    /// The configuration that is tuned, as it is.
    pub(super) fn default_config(&self) -> Result<PlannerConfig> {
        let own = self.space.own_values()?;
        let config = self.space.config(&own);
        config.context("the default is no valid configuration")
    }

    /// The score of each candidate, infinite where its values do not go together; and per scenario
    /// whether any of them found a path.
    fn scores(&self, all: &[Vec<f64>], references: &[Reference]) -> (Vec<f64>, Vec<bool>) {
        let configs: Vec<_> = all.iter().map(|values| self.space.config(values)).collect();
        let valid: Vec<_> = configs.iter().flatten().cloned().map(|c| ("", c)).collect();
        let runs = run_all(&valid, &self.scenarios, &(0..self.n_seeds), self.n_jobs);
        let is_solved = |i: usize| {
            let mut here = runs.iter().flat_map(|runs| &runs[i]);
            here.any(|run| run.cost_m.is_some())
        };
        let solved = (0..self.scenarios.len()).map(is_solved).collect();
        let mut scores = runs.iter().map(|runs| self.score(runs, references));
        let score = |config: &Option<PlannerConfig>| {
            let found = config.as_ref().and_then(|_| scores.next());
            found.unwrap_or(f64::INFINITY)
        };
        (configs.iter().map(score).collect(), solved)
    }

    /// The geometric mean over runs, of all scenarios alike.
    fn score(&self, runs: &[Vec<TunedRun>], references: &[Reference]) -> f64 {
        let pairs = runs.iter().zip(references);
        let logs: Vec<f64> = pairs
            .flat_map(|(runs, reference)| {
                let log = |run| self.objective.log_ratio(run, reference);
                runs.iter().map(log)
            })
            .collect();
        (logs.iter().sum::<f64>() / logs.len() as f64).exp()
    }
}

/// Medians of the runs that found a path; where none did, twice the straight way and the budget.
fn reference(asked: &Asked, runs: &[TunedRun]) -> Reference {
    let median = |of: fn(&TunedRun) -> Option<f64>| {
        let values: Vec<f64> = runs.iter().filter_map(of).collect();
        quantile(&values, 0.5)
    };
    let request = &asked.ground.request;
    let straight_m = request.start.position().distance(request.goal.position());
    let cost_m = median(|run| run.cost_m).unwrap_or(2.0 * straight_m);
    let n_most = request.budget_steps.unwrap_or_default() as f64;
    Reference {
        // A start that is the goal costs nothing, and no ratio is taken to nothing.
        cost_m: cost_m.max(1e-3),
        first_steps: median(|run| run.first_steps.map(|n| n as f64)).unwrap_or(n_most),
    }
}

fn described(asked: &Asked) -> String {
    let ground = &asked.ground;
    format!(
        "{}: map {:032x}, vehicle {:032x}, {:?}",
        ground.map,
        asked.map_hash(),
        ground.vehicle.hash(),
        ground.request
    )
}

//! Runs of a configuration on a scenario.

use crate::papers::experiment::Ground;
use crate::run::{Evaluation, Improvement, measure, pool};
use formicar::collision::ObstacleMap;
use formicar::numeric::Seed;
use formicar::planner::{Outcome, Plan, Planner, PlannerConfig};
use formicar::scenario::Request;
use serde::Serialize;
use std::convert::Infallible;
use std::ops::Range;

/// A scenario that is asked: its ground, prepared once.
#[derive(Clone, Debug)]
pub struct Asked {
    /// Name, map, vehicle and request; the request has a budget of steps and no deadline.
    pub ground: Ground,
    obstacles: std::sync::Arc<ObstacleMap>,
}

/// The result of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TunedRun {
    /// The scenario.
    pub scenario: String,
    /// The configuration: `default` or `tuned`.
    pub variant: &'static str,
    /// The seed.
    pub seed: u64,
    /// Its ending; the fault where the request or the configuration was refused.
    pub status: String,
    /// Cost of driving its certified path by the usual weights, meters; of a point its length.
    pub cost_m: Option<f64>,
    /// Length of its path, meters.
    pub length_m: Option<f64>,
    /// Steps to the first certified path.
    pub first_steps: Option<u64>,
    /// Steps in all.
    pub steps: Option<u64>,
}

impl Asked {
    /// Prepares a ground.
    pub fn new(ground: Ground) -> Self {
        Self {
            obstacles: std::sync::Arc::new(ObstacleMap::new(&ground.grid)),
            ground,
        }
    }

    /// The hash of the map, for provenance.
    pub(super) fn map_hash(&self) -> u128 {
        self.obstacles.hash()
    }

    /// The reason why a configuration cannot be asked this; none where it can.
    pub(super) fn refusal(&self, config: &PlannerConfig) -> Option<String> {
        let request = Request {
            budget_steps: Some(0),
            ..self.ground.request.clone()
        };
        let vehicle = self.ground.vehicle.clone();
        let asked = Planner::on(self.obstacles.clone(), vehicle, config.clone());
        let asked = asked.and_then(|mut planner| planner.plan(&request, Seed(0), &mut ()));
        asked.err().map(|error| error.to_string())
    }

    /// Runs a configuration with each seed.
    fn run(
        &self,
        config: &PlannerConfig,
        variant: &'static str,
        seeds: Range<u64>,
    ) -> Vec<TunedRun> {
        let vehicle = self.ground.vehicle.clone();
        let mut planner = Planner::on(self.obstacles.clone(), vehicle, config.clone());
        let run = |seed: u64| {
            let blank = TunedRun {
                scenario: self.ground.map.clone(),
                variant,
                seed,
                status: String::new(),
                cost_m: None,
                length_m: None,
                first_steps: None,
                steps: None,
            };
            let planner = match &mut planner {
                Ok(planner) => planner,
                Err(error) => {
                    let status = error.to_string();
                    return TunedRun { status, ..blank };
                }
            };
            let request = &self.ground.request;
            let measured = measure(&mut (), |watch| planner.plan(request, Seed(seed), watch));
            match &measured.answer {
                Ok(outcome) => self.measured(blank, outcome, &measured.improvements),
                Err(error) => TunedRun {
                    status: error.to_string(),
                    ..blank
                },
            }
        };
        seeds.map(run).collect()
    }

    fn measured(
        &self,
        blank: TunedRun,
        outcome: &Outcome,
        improvements: &[Improvement],
    ) -> TunedRun {
        let n_steps = outcome.n_steps();
        let run = TunedRun {
            status: outcome.status().name().to_owned(),
            steps: Some(n_steps),
            ..blank
        };
        match outcome {
            Outcome::Found(plan) => TunedRun {
                cost_m: Some(self.cost_m(plan)),
                length_m: Some(plan.metrics.length_m),
                first_steps: Some(improvements.first().map_or(n_steps, |first| first.steps)),
                ..run
            },
            Outcome::NotFound(_) => run,
        }
    }

    /// The cost of driving a path by the usual weights; its length where a point moves along it.
    fn cost_m(&self, plan: &Plan) -> f64 {
        let evaluation = Evaluation {
            obstacles: &self.obstacles,
            vehicle: &self.ground.vehicle,
        };
        evaluation
            .cost_m(&plan.path)
            .unwrap_or(plan.metrics.length_m)
    }
}

/// The runs of each configuration on all scenarios with all seeds, on some threads; the result does not
/// depend on their number.
pub(super) fn run_all(
    configs: &[(&'static str, PlannerConfig)],
    scenarios: &[Asked],
    seeds: &Range<u64>,
    n_jobs: usize,
) -> Vec<Vec<Vec<TunedRun>>> {
    let n_scenarios = scenarios.len();
    let run = |i: usize| -> Result<_, Infallible> {
        let (name, config) = &configs[i / n_scenarios];
        Ok(scenarios[i % n_scenarios].run(config, name, seeds.clone()))
    };
    let Ok(runs) = pool::map(n_jobs, configs.len() * n_scenarios, run);
    let mut runs = runs.into_iter();
    let of_config = |_| runs.by_ref().take(n_scenarios).collect();
    configs.iter().map(of_config).collect()
}

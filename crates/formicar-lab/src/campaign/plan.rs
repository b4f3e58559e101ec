//! The runs of a campaign, in their order, each with a key that tells it from all others.

use crate::report::config_hash as hash;
use crate::run::Job;
use anyhow::{Result, bail};
use formicar::geometry::Pose2;
use formicar::planner::PlannerConfig;
use serde_json::json;
use std::collections::BTreeMap;

/// Runs in a fixed order.
#[derive(Clone, Debug, Default)]
pub struct Campaign {
    /// Its name.
    pub name: String,
    /// The campaign file, or the flags that stand for one.
    pub text: String,
    /// The runs.
    pub runs: Vec<PlannedRun>,
    /// The configurations of its planners, each once.
    pub configs: Vec<ConfigRecord>,
}

/// The parameters of a planner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConfigRecord {
    /// The name that the planner goes by.
    pub name: String,
    /// The hash of all its parameters.
    pub hash: String,
    /// All its parameters, as JSON.
    pub json: String,
    /// Keys of those that a tuning has found.
    pub tuned: Vec<String>,
}

/// A run with what it depends on, as hashes.
#[derive(Clone, Debug)]
pub struct PlannedRun {
    /// The run.
    pub job: Job,
    /// A hash of all that decides its result.
    pub key: String,
    /// Hash of the planner's parameters.
    pub config_hash: String,
    /// Hash of the map as the judge sees it.
    pub map_hash: String,
    /// Hash of the vehicle as the judge sees it.
    pub vehicle_hash: String,
}

/// The scenario of a run, as far as it decides the result.
#[derive(Clone, Copy, Debug)]
pub struct Fingerprint {
    /// The hash of the map.
    pub map_hash: u128,
    /// The hash of the vehicle.
    pub vehicle_hash: u128,
    /// Start and goal.
    pub ends: [Pose2; 2],
}

impl ConfigRecord {
    /// The record of a planner's parameters under a name.
    ///
    /// # Errors
    /// Parameters that cannot be written as JSON.
    pub fn new(name: &str, config: &PlannerConfig) -> Result<Self> {
        Ok(Self::of_json(name, serde_json::to_string(config)?))
    }

    /// The record of anything else that decides on a planner's answers.
    pub fn of_json(name: &str, json: String) -> Self {
        Self {
            name: name.to_owned(),
            hash: hash(&json),
            json,
            tuned: Vec::new(),
        }
    }
}

impl PlannedRun {
    /// A run under a key of scenario, map, ends, vehicle, planner, seed and limits.
    pub fn new(job: Job, scenario: &Fingerprint, config: &ConfigRecord) -> Self {
        let [map_hash, vehicle_hash] =
            [scenario.map_hash, scenario.vehicle_hash].map(|hash| format!("{hash:032x}"));
        let ends = scenario.ends.map(|pose| [pose.x, pose.y, pose.heading]);
        let whole = json!([
            job.task.scenario,
            map_hash,
            ends,
            job.vehicle_name(),
            vehicle_hash,
            job.contender.name,
            config.hash,
            job.seed,
            job.limits,
        ]);
        Self {
            key: hash(&whole.to_string()),
            config_hash: config.hash.clone(),
            map_hash,
            vehicle_hash,
            job,
        }
    }
}

impl Campaign {
    /// A hash of all runs in their order.
    pub fn hash(&self) -> String {
        let keys: Vec<&str> = self.runs.iter().map(|run| run.key.as_str()).collect();
        hash(&keys.join(" "))
    }

    /// Refuses a campaign with a run that stands there twice, or with none.
    ///
    /// # Errors
    /// The run that stands there twice.
    pub fn check(&self) -> Result<()> {
        if self.runs.is_empty() {
            bail!("the campaign has no runs");
        }
        let mut seen = BTreeMap::new();
        for (place, run) in self.runs.iter().enumerate() {
            if seen.insert(&run.key, place).is_some() {
                let (scenario, planner, seed) = run.job.key();
                bail!(
                    "the run of {planner} on {scenario} with seed {seed} and vehicle {} stands in \
                     the campaign twice",
                    run.job.vehicle_name()
                );
            }
        }
        Ok(())
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::run::{Contender, Limits, Place, Task};
    use formicar::planner::PlannerName;

    /// A job on a scenario with a seed.
    pub(in super::super) fn job(scenario: &str, seed: u64) -> Job {
        Job {
            task: Task {
                scenario: scenario.to_owned(),
                source: "m".to_owned(),
                place: Place::Builtin {
                    map: "m".to_owned(),
                    request: "r".to_owned(),
                },
            },
            vehicle: None,
            contender: Contender::built_in(PlannerName::Astar),
            seed,
            limits: Limits::default(),
            answer: None,
        }
    }

    /// A campaign of one planner over seeds.
    pub(in super::super) fn campaign(n_seeds: u64) -> Campaign {
        let config = ConfigRecord::new("astar", &PlannerConfig::of(PlannerName::Astar)).unwrap();
        let ground = Fingerprint {
            map_hash: 1,
            vehicle_hash: 2,
            ends: [Pose2::default(); 2],
        };
        let run = |seed| PlannedRun::new(job("a", seed), &ground, &config);
        Campaign {
            name: "c".to_owned(),
            text: "seeds".to_owned(),
            runs: (0..n_seeds).map(run).collect(),
            configs: vec![config],
        }
    }

    #[test]
    fn keys_depend_on_all_that_decides_a_result() {
        let config = ConfigRecord::new("astar", &PlannerConfig::of(PlannerName::Astar)).unwrap();
        let other = ConfigRecord::new("astar", &PlannerConfig::of(PlannerName::Dijkstra)).unwrap();
        let ground = Fingerprint {
            map_hash: 1,
            vehicle_hash: 2,
            ends: [Pose2::default(); 2],
        };
        let key = |job: Job, ground: Fingerprint, config| PlannedRun::new(job, &ground, config).key;
        let mut keys = vec![
            key(job("a", 0), ground, &config),
            key(job("b", 0), ground, &config),
            key(job("a", 1), ground, &config),
            key(job("a", 0), ground, &other),
            key(
                job("a", 0),
                Fingerprint {
                    map_hash: 3,
                    ..ground
                },
                &config,
            ),
            key(
                job("a", 0),
                Fingerprint {
                    vehicle_hash: 3,
                    ..ground
                },
                &config,
            ),
        ];
        let mut limited = job("a", 0);
        limited.limits.budget_steps = Some(9);
        keys.push(key(limited, ground, &config));
        assert_eq!(keys[0], key(job("a", 0), ground, &config));
        keys.sort();
        keys.dedup();
        assert_eq!(keys.len(), 7);
    }

    #[test]
    fn a_run_may_not_stand_there_twice() {
        let mut twice = campaign(2);
        twice.check().unwrap();
        twice.runs.push(twice.runs[0].clone());
        assert!(twice.check().unwrap_err().to_string().contains("seed 0"));
        assert!(Campaign::default().check().is_err());
    }
}

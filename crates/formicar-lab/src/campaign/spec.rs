//! The specification of a campaign, and the runs that it comes to. Everything wrong with them is
//! found here, before anything is started.

use super::plan::{Campaign, ConfigRecord, Fingerprint, PlannedRun};
use crate::rival::Question;
use crate::run::{
    Contender, Job, Limits, LoadedScenario, Place, RivalCommand, Sources, Task, VehicleChoice, ask,
};
use anyhow::{Context, Result, anyhow, bail};
use formicar::collision::ObstacleMap;
use serde_json::{Map, json};
use std::collections::BTreeMap;
use std::fs;
use std::time::Duration;
use xxhash_rust::xxh3::xxh3_128;

/// Scenarios x vehicles x limits x planners x seeds.
#[derive(Clone, Debug, Default)]
pub struct CampaignSpec {
    /// The campaign's name.
    pub name: String,
    /// The campaign file, or the flags that stand for one.
    pub text: String,
    /// The scenarios.
    pub tasks: Vec<Task>,
    /// The vehicles; none stands for each scenario's own.
    pub vehicles: Vec<Option<VehicleChoice>>,
    /// The limits.
    pub limits: Vec<Limits>,
    /// The planners.
    pub contenders: Vec<Contender>,
    /// The seeds.
    pub seeds: Vec<u64>,
}

impl CampaignSpec {
    /// Every run, in order.
    pub fn jobs(&self) -> Vec<Job> {
        let mut jobs = Vec::new();
        for task in &self.tasks {
            for vehicle in &self.vehicles {
                for limits in &self.limits {
                    jobs.extend(self.jobs_of_planners(task, vehicle.as_ref(), *limits));
                }
            }
        }
        jobs
    }

    fn jobs_of_planners(
        &self,
        task: &Task,
        vehicle: Option<&VehicleChoice>,
        limits: Limits,
    ) -> impl Iterator<Item = Job> {
        let job = move |contender: &Contender, seed: u64| Job {
            task: task.clone(),
            vehicle: vehicle.cloned(),
            contender: contender.clone(),
            seed,
            limits,
            answer: None,
        };
        let contenders = self.contenders.iter();
        contenders.flat_map(move |c| self.seeds.iter().map(move |&seed| job(c, seed)))
    }

    /// Every run with everything that it depends on.
    ///
    /// # Errors
    /// Scenarios, vehicles, parameters or programs that cannot be read, and runs that stand in the
    /// campaign twice.
    pub fn campaign(&self, sources: &dyn Sources) -> Result<Campaign> {
        let configs = self.configs(sources)?;
        let (mut fingerprints, mut runs) = (Fingerprints::default(), Vec::new());
        for job in self.jobs() {
            let fingerprint = fingerprints.of(&job, sources)?;
            let config = configs.iter().find(|c| c.name == job.contender.name);
            let config = config.ok_or_else(|| anyhow!("a planner without parameters"))?;
            runs.push(PlannedRun::new(job, &fingerprint, config));
        }
        let campaign = Campaign {
            name: self.name.clone(),
            text: self.text.clone(),
            runs,
            configs,
        };
        campaign.check()?;
        Ok(campaign)
    }

    /// The parameters of all planners.
    fn configs(&self, sources: &dyn Sources) -> Result<Vec<ConfigRecord>> {
        let config = |contender: &Contender| {
            if let Some(command) = &contender.rival {
                return program(&contender.name, command);
            }
            if contender.is_in_process {
                let json = json!({ "in_process": contender.name });
                return Ok(ConfigRecord::of_json(&contender.name, json.to_string()));
            }
            let record = ConfigRecord::new(&contender.name, &sources.config(contender)?)?;
            Ok(ConfigRecord {
                tuned: contender.tuned.clone(),
                ..record
            })
        };
        self.contenders.iter().map(config).collect()
    }
}

/// Fingerprints of scenarios; maps that many scenarios share are read once.
#[derive(Default)]
struct Fingerprints {
    of_scenarios: BTreeMap<[String; 2], Fingerprint>,
    /// By map and vehicle.
    of_maps: BTreeMap<[String; 2], Hashed>,
}

/// A scenario with the hash of its map.
struct Hashed {
    scenario: LoadedScenario,
    map_hash: u128,
}

impl Hashed {
    fn load(job: &Job, sources: &dyn Sources) -> Result<Self> {
        let scenario = sources.load(&job.task, job.vehicle_source())?;
        Ok(Self {
            map_hash: ObstacleMap::new(&scenario.map).hash(),
            scenario,
        })
    }

    fn fingerprint(&self, task: &Task) -> Result<Fingerprint> {
        Ok(Fingerprint {
            map_hash: self.map_hash,
            vehicle_hash: self.scenario.vehicle.hash(),
            ends: self.scenario.ends(task)?,
        })
    }
}

impl Fingerprints {
    fn of(&mut self, job: &Job, sources: &dyn Sources) -> Result<Fingerprint> {
        let vehicle = job.vehicle_name().to_owned();
        let key = [job.task.scenario.clone(), vehicle.clone()];
        if let Some(known) = self.of_scenarios.get(&key) {
            return Ok(*known);
        }
        let fingerprint = match &job.task.place {
            Place::Cells { map, .. } => {
                let map = [map.display().to_string(), vehicle];
                if !self.of_maps.contains_key(&map) {
                    let hashed = Hashed::load(job, sources)?;
                    self.of_maps.insert(map.clone(), hashed);
                }
                self.of_maps[&map].fingerprint(&job.task)?
            }
            Place::Barn { .. } | Place::File { .. } | Place::Builtin { .. } => {
                Hashed::load(job, sources)?.fingerprint(&job.task)?
            }
        };
        self.of_scenarios.insert(key, fingerprint);
        Ok(fingerprint)
    }
}

/// Time for a program to state its version.
const WITHIN_VERSION: Duration = Duration::from_mins(1);

/// Everything that decides on the answers of a program: its command, its version, and the contents
/// of the files that the command names.
fn program(name: &str, command: &RivalCommand) -> Result<ConfigRecord> {
    let within = || format!("planner {name:?}: {}", command.words.join(" "));
    let (_, answer) = ask(command, &Question::version(), WITHIN_VERSION).with_context(within)?;
    if !matches!(answer.status.as_str(), "ready" | "unavailable") {
        let what = "status: expected ready or unavailable, the version was asked for";
        bail!("{}: {what}", within());
    }
    let is_file = |word: &&String| command.folder.join(word).is_file();
    let hash = |word: &String| {
        let bytes = fs::read(command.folder.join(word)).unwrap_or_default();
        (word.clone(), json!(format!("{:032x}", xxh3_128(&bytes))))
    };
    let arguments = command.words.iter().skip(1);
    let files: Map<_, _> = arguments.filter(is_file).map(hash).collect();
    let json = json!({
        "command": command.words,
        "version": answer.version,
        "unavailable": (answer.status == "unavailable").then_some(answer.reason),
        "files": files,
    });
    Ok(ConfigRecord::of_json(name, json.to_string()))
}

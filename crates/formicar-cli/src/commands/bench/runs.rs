//! The runs of a campaign, from flags or from a file; everything wrong with them is found here,
//! before anything is started.

use super::{BenchArgs, place, rival, suite, variant};
use crate::{scene, settings};
use anyhow::{Result, anyhow};
use formicar::collision::ObstacleMap;
use formicar::planner::PlannerName;
use formicar_lab::campaign::{
    Campaign, ConfigRecord, Contender, Ground, Job, Limits, Place, PlannedRun, Task, VehicleChoice,
};
use std::collections::BTreeMap;
use std::path::Path;

/// Scenarios x vehicles x limits x planners x seeds.
#[derive(Debug)]
pub(crate) struct Runs {
    pub(super) name: String,
    /// The campaign file, or what the flags say.
    pub(super) text: String,
    pub(super) tasks: Vec<Task>,
    /// None stands for each scenario's own.
    pub(super) vehicles: Vec<Option<VehicleChoice>>,
    pub(super) limits: Vec<Limits>,
    pub(super) contenders: Vec<Contender>,
    pub(super) seeds: Vec<u64>,
}

impl Runs {
    /// As the flags say.
    pub(super) fn of_flags(args: &BenchArgs) -> Result<Self> {
        let contenders = variant::all(args)?;
        let planners = planners(&contenders);
        Ok(Self {
            name: "bench".to_owned(),
            text: format!("{} {}\n", args.scenarios.join(" "), args.conditions()),
            tasks: suite::tasks(&args.scenarios, args.limit, &planners)?,
            vehicles: vec![None],
            limits: vec![args.limits()],
            contenders,
            seeds: (0..args.n_seeds()).collect(),
        })
    }

    /// Every run, in order.
    pub(super) fn jobs(&self) -> Vec<Job> {
        let mut jobs = Vec::new();
        for task in &self.tasks {
            for vehicle in &self.vehicles {
                for limits in &self.limits {
                    jobs.extend(self.of_planners(task, vehicle.as_ref(), *limits));
                }
            }
        }
        jobs
    }

    /// The runs of all planners with all seeds.
    fn of_planners(
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

    /// Every run with what it depends on.
    pub(crate) fn campaign(&self) -> Result<Campaign> {
        let configs = self.contenders.iter().map(config);
        let configs = configs.collect::<Result<Vec<_>>>()?;
        let (mut grounds, mut runs) = (Grounds::default(), Vec::new());
        for job in self.jobs() {
            let ground = grounds.of(&job)?;
            let config = configs.iter().find(|c| c.name == job.contender.name);
            let config = config.ok_or_else(|| anyhow!("a planner without parameters"))?;
            runs.push(PlannedRun::new(job, &ground, config));
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
}

/// The planners of ours.
pub(super) fn planners(contenders: &[Contender]) -> Vec<PlannerName> {
    let ours = contenders.iter().filter(|c| c.rival.is_none());
    ours.map(|c| c.planner).collect()
}

pub(super) fn config(contender: &Contender) -> Result<ConfigRecord> {
    if let Some(command) = &contender.rival {
        return rival::config(&contender.name, command);
    }
    let record = ConfigRecord::new(&contender.name, &settings::typed(&contender.config)?)?;
    Ok(ConfigRecord {
        tuned: contender.tuned.clone(),
        ..record
    })
}

/// What runs stand on, each read once.
#[derive(Default)]
struct Grounds {
    of_scenarios: BTreeMap<[String; 2], Ground>,
    /// Hashes of maps that many scenarios share, by vehicle, with their frame.
    of_maps: BTreeMap<[String; 2], scene::Scene>,
}

impl Grounds {
    fn of(&mut self, job: &Job) -> Result<Ground> {
        let key = [job.task.scenario.clone(), job.vehicle_name().to_owned()];
        if let Some(known) = self.of_scenarios.get(&key) {
            return Ok(*known);
        }
        let args = place::ground_args(&job.task, job.vehicle_source());
        let found = if let Place::Cells { map, .. } = &job.task.place {
            let key = [map.display().to_string(), job.vehicle_name().to_owned()];
            let known = self.of_maps.remove(&key);
            let loaded = known.map_or_else(|| scene::load(&args), Ok)?;
            let found = of_ground(&job.task, &loaded);
            self.of_maps.insert(key, loaded);
            found?
        } else {
            of_ground(&job.task, &scene::load(&args)?)?
        };
        self.of_scenarios.insert(key, found);
        Ok(found)
    }
}

fn of_ground(task: &Task, ground: &scene::Scene) -> Result<Ground> {
    Ok(Ground {
        map_hash: ObstacleMap::new(&ground.map).hash(),
        vehicle_hash: ground.vehicle.vehicle.hash(),
        ends: place::ends(task, ground)?,
    })
}

/// A vehicle by the word for it: `own`, a preset, or a file of a folder.
pub(super) fn vehicle(word: &str, folder: &Path) -> Result<Option<VehicleChoice>> {
    if word == formicar_lab::campaign::OWN_VEHICLE {
        return Ok(None);
    }
    let is_file = [".toml", ".json"].iter().any(|end| word.ends_with(end));
    let source = if is_file {
        folder.join(word).display().to_string()
    } else {
        word.to_owned()
    };
    scene::vehicle(&source)?;
    Ok(Some(VehicleChoice {
        name: word.to_owned(),
        source,
    }))
}

//! From flags to a campaign: planners, or one planner with parts of it left out.

use super::{BenchArgs, Files};
use crate::{scene, settings};
use anyhow::Result;
use formicar::planner::PlannerName;
use formicar_lab::campaign::{CampaignSpec, TaskSource, check_names, tasks_of};
use formicar_lab::run::{Contender, Task, VehicleChoice};
use toml::Table;

/// Formicar with parts left out.
const ABLATIONS: [(&str, &[&str]); 9] = [
    ("formicar", &[]),
    ("formicar-without-ants", &["drive.race=\"hybrid_astar\""]),
    ("formicar-without-hybrid-astar", &["drive.race=\"ants\""]),
    (
        "formicar-without-repair",
        &["drive.repair.toll_per_death=0"],
    ),
    ("formicar-without-shortcuts", &["improve.shortcut_share=0"]),
    ("formicar-without-shifts", &["improve.shift_share=0"]),
    ("formicar-without-cusps", &["improve.cusp_share=0"]),
    ("formicar-without-passes", &["improve.polish_passes=0"]),
    (
        "formicar-without-improvement",
        &["improve.max_tries=0", "improve.polish_passes=0"],
    ),
];

/// The campaign that the flags name.
pub(super) fn spec(args: &BenchArgs) -> Result<CampaignSpec> {
    let contenders = contenders(args)?;
    Ok(CampaignSpec {
        name: "bench".to_owned(),
        text: format!("{} {}\n", args.scenarios.join(" "), args.conditions()),
        tasks: tasks(args, &contenders)?,
        vehicles: vec![vehicle(args)?],
        limits: vec![args.limits()],
        contenders,
        seeds: (0..args.n_seeds()).collect(),
    })
}

/// The vehicle that the flags name; a misspelled one is found now.
fn vehicle(args: &BenchArgs) -> Result<Option<VehicleChoice>> {
    let Some(name) = &args.vehicle else {
        return Ok(None);
    };
    scene::vehicle(name)?;
    Ok(Some(VehicleChoice {
        name: name.clone(),
        source: name.clone(),
    }))
}

/// All scenarios that the words name.
fn tasks(args: &BenchArgs, contenders: &[Contender]) -> Result<Vec<Task>> {
    let planners: Vec<PlannerName> = contenders.iter().map(|c| c.planner).collect();
    let mut tasks = Vec::new();
    for word in &args.scenarios {
        let source = TaskSource {
            limit: args.limit,
            ..TaskSource::of(word)
        };
        tasks.extend(tasks_of(&source, &planners, &Files)?);
    }
    check_names(&tasks)?;
    Ok(tasks)
}

/// All planners that the flags name, each once; flags that set parameters hold for all of them.
fn contenders(args: &BenchArgs) -> Result<Vec<Contender>> {
    if args.ablations {
        let ablations = ABLATIONS.iter();
        return ablations
            .map(|(name, set)| {
                let own = set.iter().map(|&key| key.to_owned());
                let sets: Vec<String> = args.set.iter().cloned().chain(own).collect();
                contender(name, PlannerName::Formicar, &sets)
            })
            .collect();
    }
    let mut contenders: Vec<Contender> = Vec::new();
    for planner in args.planners() {
        if contenders.iter().all(|other| other.planner != planner) {
            contenders.push(contender(planner.name(), planner, &args.set)?);
        }
    }
    Ok(contenders)
}

fn contender(name: &str, planner: PlannerName, sets: &[String]) -> Result<Contender> {
    Ok(Contender {
        name: name.to_owned(),
        config: settings::merge(
            Table::new(),
            "the planner's parameters",
            sets,
            Some(planner),
        )?,
        ..Contender::built_in(planner)
    })
}

//! What the flags compare: planners, or one planner with parts of it left out.

use super::BenchArgs;
use crate::settings;
use anyhow::Result;
use formicar::planner::PlannerName;
use formicar_lab::campaign::Contender;
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

/// All contenders that the flags name, each once; flags that set parameters hold for all of them.
pub(super) fn all(args: &BenchArgs) -> Result<Vec<Contender>> {
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
        planner,
        config: settings::merge(
            Table::new(),
            "the planner's parameters",
            sets,
            Some(planner),
        )?,
        rival: None,
        tuned: Vec::new(),
    })
}

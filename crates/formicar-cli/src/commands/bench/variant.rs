//! What is compared: planners, or one planner with parts of it left out.

use super::BenchArgs;
use formicar::planner::PlannerName;

/// A planner with parameters of its own, and the name that it goes by.
#[derive(Clone, Debug)]
pub(super) struct Variant {
    pub(super) name: String,
    pub(super) planner: PlannerName,
    /// Parameters as `--set` takes them.
    pub(super) set: Vec<String>,
}

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

/// All variants that the flags name, each once; flags that set parameters hold for all of them.
pub(super) fn all(args: &BenchArgs) -> Vec<Variant> {
    if args.ablations {
        return ABLATIONS
            .iter()
            .map(|&(name, set)| ablation(args, name, set))
            .collect();
    }
    let mut variants: Vec<Variant> = Vec::new();
    for &planner in &args.planners {
        if variants.iter().all(|variant| variant.planner != planner) {
            variants.push(Variant {
                name: planner.name().to_owned(),
                planner,
                set: args.set.clone(),
            });
        }
    }
    variants
}

fn ablation(args: &BenchArgs, name: &str, set: &[&str]) -> Variant {
    let own = set.iter().map(|&key| key.to_owned());
    Variant {
        name: name.to_owned(),
        planner: PlannerName::Formicar,
        set: args.set.iter().cloned().chain(own).collect(),
    }
}

//! Flags of `tune`.
#![allow(clippy::doc_markdown, reason = "clap prints these words as they stand")]

use crate::mode_args::ModeArgs;
use crate::values;
use clap::{Args, ValueHint};
use formicar::planner::PlannerName;
use formicar::tuning::BeeVariant;
use formicar_lab::tuning::{Measure, OwnRange};
use std::path::PathBuf;

/// Flags of `tune`.
#[derive(Args, Debug)]
#[command(after_help = "\
The folder takes tuned.toml (what was tuned, for plan --config), convergence.svg, index.html and \
summary.md (default against tuned on the scenarios held back, with a paired test), cycles.csv, \
runs.csv, MACHINE.md and state.json. After a kill the same command goes on where it stopped and \
comes to the same result. Steps and costs decide, never time.")]
pub(crate) struct TuneArgs {
    /// Car scenarios (.json), TPCAP cases (.csv), or names of built-in maps (all their requests).
    #[arg(required = true, value_hint = ValueHint::FilePath)]
    pub(crate) scenarios: Vec<String>,

    /// Planner (see `list planners`).
    #[arg(long, value_name = "NAME", default_value = "formicar")]
    pub(crate) planner: PlannerName,

    /// Parameters around those that are tuned, as TOML; they are the default to be beaten.
    #[arg(long, value_name = "F.toml", value_hint = ValueHint::FilePath)]
    pub(crate) config: Option<PathBuf>,

    /// One such parameter, for instance drive.n_ants=16; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,

    /// A parameter to be tuned, for instance drive.beta; may be repeated.
    #[arg(long, value_name = "KEY")]
    pub(crate) parameter: Vec<String>,

    /// A group of parameters to be tuned, for instance drive or drive.trails; may be repeated.
    /// Without --parameter and --group all that the planner uses.
    #[arg(long, value_name = "SECTION")]
    pub(crate) group: Vec<String>,

    /// Range of a parameter, within that of the schema; needed where the schema has none. With
    /// :log equal ratios are equally far. May be repeated.
    #[arg(long, value_name = "KEY=LOW..HIGH[:log]", value_parser = own_range)]
    pub(crate) range: Vec<OwnRange>,

    /// What is made small: cost of the path, steps to the first path, or runs without a path; the
    /// last counts in all of them.
    #[arg(long, value_name = "WHAT", default_value = "cost",
          value_parser = values::word::<Measure>(&["cost", "steps", "success"]))]
    pub(crate) objective: Measure,

    /// With the objective cost: exponent of the steps to the first path.
    #[arg(long, value_name = "W", default_value_t = 0.05, value_parser = values::not_negative,
          allow_hyphen_values = true)]
    pub(crate) steps_weight: f64,

    /// Candidates in all, each of which is run on all scenarios with all seeds.
    #[arg(long, value_name = "N", default_value_t = 300)]
    pub(crate) evaluations: u64,

    /// Food sources, and as many employed bees and onlookers.
    #[arg(long, value_name = "N", default_value_t = 10)]
    pub(crate) sources: u32,

    /// Trials in a row without gain after which a source is abandoned; sources times parameters by
    /// default.
    #[arg(long, value_name = "N")]
    pub(crate) limit: Option<u32>,

    /// Search rules of the bees: the basic one, or five chosen by their gains.
    #[arg(long, value_name = "WORD", default_value = "variable-strategy",
          value_parser = values::word::<BeeVariant>(&["basic", "variable-strategy"]))]
    pub(crate) variant: BeeVariant,

    /// Seed of the bees, and of what is held back.
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    pub(crate) seed: u64,

    /// Runs of each candidate on each scenario, with the seeds 0 to N - 1.
    #[arg(long, value_name = "N", default_value_t = 3,
          value_parser = clap::value_parser!(u64).range(1..=10_000))]
    pub(crate) seeds: u64,

    /// Runs on each scenario that was held back, with the N seeds after these.
    #[arg(long, value_name = "N", default_value_t = 5,
          value_parser = clap::value_parser!(u64).range(1..=10_000))]
    pub(crate) check_seeds: u64,

    /// Share of the scenarios that is held back, drawn by the seed.
    #[arg(long, value_name = "SHARE", default_value_t = 0.3, value_parser = values::number,
          allow_hyphen_values = true)]
    pub(crate) hold_back: f64,

    /// Scenarios to be held back, named like the others, instead of a share; may be repeated.
    #[arg(long, value_name = "F|NAME", conflicts_with = "hold_back", value_hint = ValueHint::FilePath)]
    pub(crate) held_back: Vec<String>,

    /// Search steps after which a run gives up.
    #[arg(long, value_name = "STEPS", default_value_t = 200_000,
          value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) budget: u64,

    #[command(flatten)]
    pub(crate) modes: ModeArgs,

    /// Runs at once; the result never depends on it.
    #[arg(long, value_name = "N", default_value_t = 1,
          value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) jobs: u32,

    /// Folder of the results, made where it does not exist.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(crate) out: PathBuf,

    /// The state of the search, written after each cycle; DIR/state.json by default.
    #[arg(long, value_name = "F.json", value_hint = ValueHint::FilePath)]
    pub(crate) state: Option<PathBuf>,
}

/// `KEY=LOW..HIGH`, with `:log` behind it or not.
fn own_range(text: &str) -> Result<OwnRange, String> {
    let fault = || {
        "expected KEY=LOW..HIGH, for instance drive.beta=1..20 or \
                    drive.second_steps=100..100000:log"
            .to_owned()
    };
    let (key, range) = text.split_once('=').ok_or_else(fault)?;
    let (range, is_log) = match range.strip_suffix(":log") {
        Some(range) => (range, true),
        None => (range, false),
    };
    let (low, high) = range.split_once("..").ok_or_else(fault)?;
    Ok(OwnRange {
        key: key.trim().to_owned(),
        low: values::number(low)?,
        high: values::number(high)?,
        is_log,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_read() {
        let range = own_range("drive.beta=0.5..1e2:log").unwrap();
        let expected = OwnRange {
            key: "drive.beta".to_owned(),
            low: 0.5,
            high: 100.0,
            is_log: true,
        };
        assert_eq!(range, expected);
        assert!(!own_range("a=-1..2").unwrap().is_log);
        for bad in ["a", "a=1", "a=1..", "a=1..x", "a=1..2:lin"] {
            assert!(own_range(bad).is_err(), "{bad}");
        }
    }
}

//! Flags of `bench`.
#![allow(clippy::doc_markdown, reason = "clap prints these words as they stand")]

use crate::commands::machine;
use crate::values;
use anyhow::{Result, bail};
use clap::{Args, ValueHint};
use formicar::planner::PlannerName;
use formicar::vehicle::Gears;
use formicar_lab::run::Limits;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Flags of `bench`.
#[derive(Args, Debug)]
#[command(after_help = "\
The folder takes results.csv (one row per run), results.sqlite (the same with history and path of \
every run), summary.md, standing.md and index.html (goals, peers of a peers.csv beside the \
scenarios, every run), MACHINE.md and settings.json. After a kill the same command goes on where it \
stopped. `valid` is the word of the judge in the process of \
the run; `check` repeats it on the answers that --paths keeps. Length at 0.1 s and 1 s is that of \
the best path found by then, counted from the beginning of the query; its clearance and cusps are \
known where it is the last.")]
pub(crate) struct BenchArgs {
    /// Car scenarios or worlds of BARN (.json), TPCAP cases (.csv), MovingAI scenarios (.scen, for astar and dijkstra
    /// with the point vehicle, the .map beside them), names of built-in maps (all their requests),
    /// `narrow` (the narrow set) or `builtin` (all built-in maps); or one campaign file (.toml).
    #[arg(required = true, value_hint = ValueHint::FilePath)]
    pub(crate) scenarios: Vec<String>,

    /// Planners, separated by commas (see `list planners`); `formicar` by default.
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    planners: Vec<PlannerName>,

    /// Formicar beside itself with parts left out: without ants, hybrid A* or repair in the race,
    /// and without each operator of improvement.
    #[arg(long, conflicts_with = "planners")]
    pub(crate) ablations: bool,

    /// Runs per scenario and planner, with the seeds 0 to N - 1; 1 by default.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    seeds: Option<u64>,

    /// Folder for the results; made if need be.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath,
          required_unless_present = "store")]
    pub(crate) out: Option<PathBuf>,

    /// SQLite file for the results, with history and path of every run; a .csv of the same name
    /// takes the rows in the end.
    #[arg(long, value_name = "F.sqlite", value_hint = ValueHint::FilePath,
          conflicts_with_all = ["out", "paths"])]
    pub(crate) store: Option<PathBuf>,

    /// Which gears may be used; `reverse` allows both and penalizes reverse.
    #[arg(long, value_name = "MODE",
          value_parser = values::word::<Gears>(&["forward", "reverse"]))]
    pub(crate) motion: Option<Gears>,

    /// Measure the first query of a planner; otherwise every query is asked twice in its process,
    /// and the second asking counts: that of a warm planner, which keeps nothing but what it knows
    /// of map and vehicle.
    #[arg(long)]
    pub(crate) cold: bool,

    /// Keep every answer as DIR/paths/SCENARIO.PLANNER.SEED.json.
    #[arg(long)]
    pub(crate) paths: bool,

    /// Runs at once; more than one disturb each other's times.
    #[arg(long, value_name = "N", default_value_t = 1,
          value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) jobs: u32,

    /// The vehicle instead of each scenario's own: a preset or a vehicle file.
    #[arg(long, value_name = "V", value_hint = ValueHint::FilePath)]
    pub(crate) vehicle: Option<String>,

    /// Take N lines of every .scen file, or worlds of BARN, evenly spread from first to last.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) limit: Option<u32>,

    /// Search steps after which a run gives up.
    #[arg(long, value_name = "STEPS")]
    pub(crate) budget: Option<u64>,

    /// Time after which a run gives up, for instance 5s or 800ms; a bare number is milliseconds.
    #[arg(long, value_name = "TIME", value_parser = values::milliseconds, allow_hyphen_values = true)]
    pub(crate) deadline: Option<f64>,

    /// One planner parameter, for instance hybrid_astar.weight=1.2; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
}

impl BenchArgs {
    /// The planners, the default one where none is named.
    pub(crate) fn planners(&self) -> Vec<PlannerName> {
        if self.planners.is_empty() {
            vec![PlannerName::default()]
        } else {
            self.planners.clone()
        }
    }

    /// How many seeds.
    pub(crate) fn n_seeds(&self) -> u64 {
        self.seeds.unwrap_or(1)
    }

    /// The campaign file, where that is what is named; what it says itself no flag may say.
    pub(crate) fn campaign_file(&self) -> Result<Option<&Path>> {
        let is_toml = |word: &&String| word.to_ascii_lowercase().ends_with(".toml");
        let Some(file) = self.scenarios.iter().find(is_toml) else {
            return Ok(None);
        };
        let said = [
            ("other scenarios", self.scenarios.len() > 1),
            ("--planners", !self.planners.is_empty()),
            ("--ablations", self.ablations),
            ("--seeds", self.seeds.is_some()),
            ("--motion", self.motion.is_some()),
            ("--cold", self.cold),
            ("--vehicle", self.vehicle.is_some()),
            ("--limit", self.limit.is_some()),
            ("--budget", self.budget.is_some()),
            ("--deadline", self.deadline.is_some()),
            ("--set", !self.set.is_empty()),
        ];
        if let Some((flag, _)) = said.iter().find(|(_, is_said)| *is_said) {
            bail!("{flag}: the campaign file {file} says that itself; hint: write it there");
        }
        if self.store.is_none() {
            bail!("--out: a campaign goes into a store; hint: --store F.sqlite");
        }
        Ok(Some(Path::new(file)))
    }

    /// The limits of all runs.
    pub(crate) fn limits(&self) -> Limits {
        Limits {
            motion: self.motion,
            budget_steps: self.budget,
            deadline_ms: self.deadline,
            is_cold: self.cold,
        }
    }

    /// What all rows of a table share: runs under other conditions do not belong in it.
    pub(crate) fn conditions(&self) -> Value {
        let mut conditions = json!({
            "schema": "formicar/bench/2",
            "version": env!("CARGO_PKG_VERSION"),
            "processor": machine::processor(),
            "cold": self.cold,
            "motion": self.motion.unwrap_or_default(),
            "budget_steps": self.budget,
            "deadline_ms": self.deadline,
            "set": self.set,
        });
        // Folders of before know no vehicle.
        if let Some(vehicle) = &self.vehicle {
            conditions["vehicle"] = json!(vehicle);
        }
        conditions
    }
}

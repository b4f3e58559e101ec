//! The result of an experiment: rows, a report, and their provenance.

use crate::papers::experiment::{Ground, Setup, Variant};
use crate::papers::trial::{Run, Trial};
use crate::papers::trial_log::ompl_logs;
use crate::report::{Fact, OmplLog, Page, Report, json, latex, markdown, numbers_csv, page};
use anyhow::Result;
use formicar::collision::ObstacleMap;
use serde::Serialize;

/// All rows of an experiment, and the report on them.
#[derive(Clone, Debug, Default)]
pub struct Reproduction {
    /// Tables and figures.
    pub report: Report,
    /// Every run, as CSV.
    pub csv: String,
    /// The iterations of the runs that are drawn by iteration, as CSV; may be empty.
    pub courses_csv: String,
    /// The runs as logs of OMPL, one per map.
    pub ompl_logs: Vec<OmplLog>,
    /// Number of runs.
    pub n_runs: usize,
    /// Maps, vehicles and seeds.
    pub facts: Vec<Fact>,
    /// Every configuration, as JSON.
    pub configs: Vec<Fact>,
}

impl Reproduction {
    /// The result of runs of all variants on all grounds.
    pub(crate) fn of_runs(
        report: Report,
        runs: &[Run],
        grounds: &[Ground],
        variants: impl Fn(&Ground) -> Vec<Variant>,
        setup: &Setup,
    ) -> Result<Self> {
        let mut facts = facts_of(grounds);
        facts.push(Fact::new("Seeds", seeds(setup.scale.n_seeds)));
        facts.push(at_a_time(setup.n_jobs));
        let trials: Vec<&Trial> = runs.iter().map(|run| &run.trial).collect();
        let all: Vec<_> = grounds
            .iter()
            .map(|ground| (ground, variants(ground)))
            .collect();
        let pairs = all.iter().flat_map(|(ground, variants)| {
            let ground: &Ground = ground;
            variants.iter().map(move |variant| (ground, variant))
        });
        Ok(Self {
            report,
            csv: csv(&trials)?,
            courses_csv: courses_csv(runs)?,
            ompl_logs: ompl_logs(runs),
            n_runs: trials.len(),
            facts,
            configs: configs_of(pairs)?,
        })
    }

    /// The files of its folder: names and contents. `machine` tells version, machine and command.
    ///
    /// # Errors
    /// No error is expected: everything is written to memory.
    pub fn files(&self, machine: &[Fact]) -> Result<Vec<(String, String)>> {
        let facts = [machine, &self.facts].concat();
        let whole = Page {
            report: &self.report,
            facts: &facts,
            configs: &self.configs,
        };
        let mut files = vec![
            ("index.html", page(&whole)),
            ("report.json", json(&whole)),
            ("results.csv", self.csv.clone()),
            ("numbers.csv", numbers_csv(&self.report)?),
            ("tables.tex", latex(&self.report)),
            ("summary.md", markdown(&self.report)),
        ];
        if !self.courses_csv.is_empty() {
            files.push(("courses.csv", self.courses_csv.clone()));
        }
        let named = files
            .into_iter()
            .map(|(name, text)| (name.to_owned(), text));
        let known = |name: &str| {
            let of_machine = machine.iter().find(|fact| fact.name == name);
            of_machine.map_or(String::new(), |fact| fact.value.clone())
        };
        let logs = self.ompl_logs.iter().map(|log| {
            let log = OmplLog {
                version: known("formicar"),
                host: known("System"),
                cpu: known("Processor"),
                ..log.clone()
            };
            (format!("ompl-{}.log", log.name), log.to_text())
        });
        Ok(named.chain(logs).collect())
    }
}

/// A row per iteration of a run.
#[derive(Serialize)]
struct CourseRow<'a> {
    map: &'a str,
    variant: &'a str,
    seed: u64,
    iteration: u32,
    n_ants: u64,
    ms: f64,
    best_so_far_length: Option<f64>,
    best_length: Option<f64>,
    mean_length: Option<f64>,
    rho: f64,
}

/// The courses of the variants that are planners as they are, without changes.
fn courses_csv(runs: &[Run]) -> Result<String> {
    let plain = runs.iter().filter(|run| !run.trial.variant.contains(','));
    let rows = plain.flat_map(|run| {
        let trial = &run.trial;
        run.moments.iter().map(|moment| CourseRow {
            map: &trial.map,
            variant: &trial.variant,
            seed: trial.seed,
            iteration: moment.iteration,
            n_ants: moment.n_ants,
            ms: moment.ms,
            best_so_far_length: moment.best_so_far_length,
            best_length: moment.best_length,
            mean_length: moment.mean_length,
            rho: moment.rho,
        })
    });
    csv(&rows.collect::<Vec<_>>())
}

/// The number of runs that were timed side by side.
pub(crate) fn at_a_time(n_jobs: usize) -> Fact {
    let words = match n_jobs {
        0 | 1 => "1: no run was slowed by another".to_owned(),
        n => format!("{n}: times are those of runs side by side"),
    };
    Fact::new("Runs at a time", words)
}

/// Rows as CSV.
pub(crate) fn csv(rows: &[impl Serialize]) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Maps with their hashes, vehicles and ends.
pub(crate) fn facts_of(grounds: &[Ground]) -> Vec<Fact> {
    let fact = |ground: &Ground| {
        let (frame, request) = (ground.grid.frame(), &ground.request);
        let hash = ObstacleMap::new(&ground.grid).hash();
        let ends = [request.start, request.goal]
            .map(|pose| format!("({:.3}, {:.3}, {:.4})", pose.x, pose.y, pose.heading));
        Fact::new(
            &format!("Map `{}`", ground.map),
            format!(
                "{} x {} cells of {} m, hash `{hash:032x}`, vehicle hash `{:032x}`, from {} to {}",
                frame.n_cols(),
                frame.n_rows(),
                frame.resolution_m(),
                ground.vehicle.hash(),
                ends[0],
                ends[1]
            ),
        )
    };
    grounds.iter().map(fact).collect()
}

/// The configurations that variants have on grounds, each once.
pub(crate) fn configs_of<'a>(
    variants: impl IntoIterator<Item = (&'a Ground, &'a Variant)>,
) -> Result<Vec<Fact>> {
    let mut configs: Vec<Fact> = Vec::new();
    for (ground, variant) in variants {
        let json = serde_json::to_string_pretty(&variant.config)?;
        let known = |config: &Fact| config.value == json && config.name.starts_with(&variant.name);
        if configs.iter().any(known) {
            continue;
        }
        let is_taken = configs.iter().any(|config| config.name == variant.name);
        let name = if is_taken {
            format!("{} ({})", variant.name, ground.map)
        } else {
            variant.name.clone()
        };
        configs.push(Fact::new(&name, json));
    }
    Ok(configs)
}

/// Seeds from 0 on, in words.
pub(crate) fn seeds(n_seeds: u64) -> String {
    match n_seeds {
        0 | 1 => "0".to_owned(),
        n => format!("0 to {}", n - 1),
    }
}

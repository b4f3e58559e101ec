//! `report`: stores as one page with tables, charts and paths, and as CSV, JSON and LaTeX.

mod pictures;

use super::results;
use crate::failure::{Ending, Failure};
use anyhow::{Result, bail};
use clap::{Args, ValueHint};
use formicar::numeric::counted;
use formicar_lab::analysis::{ompl_logs, parameter_section, report};
use formicar_lab::campaign::{ConfigRecord, Stored, check_once, name_of_file, read_results};
use formicar_lab::report::{Fact, latex, markdown, numbers_csv};
use formicar_lab::run::{Origin, Run, to_csv};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::path::PathBuf;

/// Flags of `report`.
#[derive(Args, Debug)]
pub(crate) struct ReportArgs {
    /// Stores or results.csv files of `bench`. Planners of one name in several are told apart by
    /// the names of the files.
    #[arg(required = true, value_hint = ValueHint::FilePath)]
    pub(crate) stores: Vec<PathBuf>,

    /// Folder for the page, made where it does not exist: index.html, and the same as summary.md,
    /// report.json, tables.tex, numbers.csv; results.csv; a log of OMPL per scenario.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(crate) out: PathBuf,
}

/// Carries out `report`.
pub(crate) fn run(args: &ReportArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    check_once(&args.stores)?;
    let mut stores = Vec::new();
    for path in &args.stores {
        let is_it = |other: &&PathBuf| name_of_file(other) == name_of_file(path);
        let name = match args.stores.iter().filter(is_it).count() {
            1 => name_of_file(path),
            _ => path.display().to_string(),
        };
        stores.push((name, read_results(path)?));
    }
    check_records(&stores)?;
    tell_apart(&mut stores);
    let facts = facts(&stores);
    let configs: Vec<ConfigRecord> = stores.iter().flat_map(|(_, s)| s.configs.clone()).collect();
    let parameters = parameter_section(&configs);
    let configs = results::config_facts(&configs);
    let title: Vec<&str> = stores
        .iter()
        .map(|(_, store)| store.name.as_str())
        .collect();
    let title = title.join(", ");
    let paths = pictures::section(&stores);
    let runs: Vec<Run> = stores.into_iter().flat_map(|(_, s)| s.runs).collect();
    let mut report = report(&title, &runs)?;
    report.sections.extend(paths);
    // Parameters are too long for a terminal.
    let summary = markdown(&report);
    report.sections.extend(parameters);
    let mut files = results::report_files(&report, &facts, &configs);
    files.push(("tables.tex".to_owned(), latex(&report)));
    files.push(("numbers.csv".to_owned(), numbers_csv(&report)?));
    files.push(("results.csv".to_owned(), to_csv(&runs)?));
    let logs = ompl_logs(&runs).into_iter();
    files.extend(logs.map(|log| (log_name(&log.name), log.to_text())));
    results::write_all(&args.out, &files)?;
    write!(out, "{summary}")?;
    let page = args.out.join("index.html");
    let n_runs = counted(runs.len(), "run");
    writeln!(out, "\n{n_runs}: see {}", page.display())?;
    Ok(Ending::Done)
}

/// Refuses files that hold the same run, measured to the same digit: a store and its own table.
fn check_records(stores: &[(String, Stored)]) -> Result<()> {
    let mut known: BTreeMap<(&str, [u64; 2]), &str> = BTreeMap::new();
    for (file, store) in stores {
        for run in &store.runs {
            let record = &run.record;
            let (Some(total_s), Some(query_s)) = (record.total_s, record.query_s) else {
                continue;
            };
            if run.origin.run.is_empty() {
                continue;
            }
            let measured = (
                run.origin.run.as_str(),
                [total_s, query_s].map(f64::to_bits),
            );
            let other = *known.entry(measured).or_insert(file);
            if other != file {
                bail!(
                    "{file} and {other} hold the same run of {} on {} with seed {}, which would \
                     count twice; hint: name one of them",
                    record.planner,
                    record.scenario,
                    record.seed
                );
            }
        }
    }
    Ok(())
}

/// A file name of a log's name, which may hold what file names may not.
fn log_name(name: &str) -> String {
    let is_kept = |c: char| c.is_alphanumeric() || "-_.".contains(c);
    let kept = name.replace(|c| !is_kept(c), "_");
    format!("ompl-{kept}.log")
}

/// Adds the name of its file to a planner that several files name.
fn tell_apart(stores: &mut [(String, Stored)]) {
    let planners = |store: &Stored| -> BTreeSet<String> {
        let names = store.runs.iter().map(|run| run.record.planner.clone());
        names.collect()
    };
    let of_stores: Vec<_> = stores.iter().map(|(_, store)| planners(store)).collect();
    let is_shared = |name: &str| of_stores.iter().filter(|of| of.contains(name)).count() > 1;
    for (file, store) in stores.iter_mut() {
        for run in &mut store.runs {
            let planner = &mut run.record.planner;
            if is_shared(planner) {
                *planner = format!("{planner} ({file})");
            }
        }
        for config in &mut store.configs {
            if is_shared(&config.name) {
                config.name = format!("{} ({file})", config.name);
            }
        }
    }
}

/// The provenance of the runs.
fn facts(stores: &[(String, Stored)]) -> Vec<Fact> {
    let mut facts = Vec::new();
    for (file, store) in stores {
        let n_done = store.runs.len();
        let about = format!("`{file}`: {n_done} of {} runs are done", store.n_planned);
        facts.push(Fact::new("Store", about));
        let origins: [(&str, Of<String>); 5] = [
            ("Machine", |origin| origin.machine.clone()),
            ("formicar", |origin| origin.version.clone()),
            ("Build", |origin| origin.build.clone()),
            ("Budget, steps", |origin| number(origin.budget_steps)),
            ("Deadline, ms", |origin| number(origin.deadline_ms)),
        ];
        for (name, text) in origins {
            let values: BTreeSet<String> = store.runs.iter().map(|run| text(&run.origin)).collect();
            let values: Vec<String> = values.into_iter().filter(|v| !v.is_empty()).collect();
            if !values.is_empty() {
                facts.push(Fact::new(name, values.join("; ")));
            }
        }
        let at_once: Vec<String> = store.n_at_once.iter().map(u32::to_string).collect();
        if !at_once.is_empty() {
            facts.push(Fact::new("Runs at once", at_once.join("; ")));
        }
        facts.extend(hashes(&store.runs));
        if !store.text.is_empty() {
            facts.push(Fact::new("Campaign", store.text.clone()));
        }
    }
    facts
}

/// A value of an origin.
type Of<T> = fn(&Origin) -> T;

/// A hash of an origin.
type HashOf = fn(&Origin) -> &str;

fn number(value: Option<impl Serialize>) -> String {
    value.map_or_else(String::new, |value| serde_json::json!(value).to_string())
}

/// The maps and vehicles of all scenarios, by hash.
fn hashes(runs: &[Run]) -> Vec<Fact> {
    let mut facts = Vec::new();
    let of_origins: [(&str, HashOf); 2] = [
        ("Map", |origin| &origin.map_hash),
        ("Vehicle", |origin| &origin.vehicle_hash),
    ];
    for (name, of) in of_origins {
        let hashes: BTreeSet<&str> = runs.iter().map(|run| of(&run.origin)).collect();
        for hash in hashes.into_iter().filter(|hash| !hash.is_empty()) {
            let of_hash = runs.iter().filter(|run| of(&run.origin) == hash);
            let sources: BTreeSet<&str> = of_hash.map(|run| run.record.source.as_str()).collect();
            let sources: Vec<&str> = sources.into_iter().collect();
            let about = format!("hash `{hash}`, in scenarios of {}", sources.join(", "));
            facts.push(Fact::new(name, about));
        }
    }
    facts
}

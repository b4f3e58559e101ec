//! `report`: stores as one page with tables, charts and paths, and as CSV, JSON and LaTeX.

mod pictures;

use super::results;
use crate::failure::{Ending, Failure};
use anyhow::{Result, bail};
use clap::{Args, ValueHint};
use formicar::numeric::counted;
use formicar_lab::analysis::{ompl_logs, parameter_section, report};
use formicar_lab::campaign::{ConfigRecord, Record, Stored, to_csv};
use formicar_lab::report::{Fact, latex, markdown, numbers_csv};
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
    results::check_once(&args.stores)?;
    let mut stores = Vec::new();
    for path in &args.stores {
        let is_it = |other: &&PathBuf| results::name(other) == results::name(path);
        let name = match args.stores.iter().filter(is_it).count() {
            1 => results::name(path),
            _ => path.display().to_string(),
        };
        stores.push((name, results::read(path)?));
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
    let records: Vec<Record> = stores.into_iter().flat_map(|(_, s)| s.records).collect();
    let mut report = report(&title, &records)?;
    report.sections.extend(paths);
    // Parameters are too long for a terminal.
    let told = markdown(&report);
    report.sections.extend(parameters);
    let mut files = results::report_files(&report, &facts, &configs);
    files.push(("tables.tex".to_owned(), latex(&report)));
    files.push(("numbers.csv".to_owned(), numbers_csv(&report)?));
    files.push(("results.csv".to_owned(), to_csv(&records)?));
    let logs = ompl_logs(&records).into_iter();
    files.extend(logs.map(|log| (log_name(&log.name), log.to_text())));
    results::write_all(&args.out, &files)?;
    write!(out, "{told}")?;
    let page = args.out.join("index.html");
    let n_runs = counted(records.len(), "run");
    writeln!(out, "\n{n_runs}: see {}", page.display())?;
    Ok(Ending::Done)
}

/// Refuses files that hold the same run, measured to the same digit: a store and its own table.
fn check_records(stores: &[(String, Stored)]) -> Result<()> {
    let mut known: BTreeMap<[&str; 3], &str> = BTreeMap::new();
    for (file, store) in stores {
        for record in &store.records {
            let measured = ["run", "total_s", "query_s"].map(|column| record.get(column));
            if measured.iter().any(|value| value.is_empty()) {
                continue;
            }
            let other = *known.entry(measured).or_insert(file);
            if other != file {
                bail!(
                    "{file} and {other} hold the same run of {} on {} with seed {}, which would \
                     count twice; hint: name one of them",
                    record.get("planner"),
                    record.get("scenario"),
                    record.get("seed")
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
        let names = store.records.iter().map(|r| r.get("planner").to_owned());
        names.collect()
    };
    let of_stores: Vec<_> = stores.iter().map(|(_, store)| planners(store)).collect();
    let is_shared = |name: &str| of_stores.iter().filter(|of| of.contains(name)).count() > 1;
    for (file, store) in stores.iter_mut() {
        for record in &mut store.records {
            let planner = record.get("planner").to_owned();
            if is_shared(&planner) {
                let told = format!("{planner} ({file})");
                record.row.set("planner", &told.into());
            }
        }
        for config in &mut store.configs {
            if is_shared(&config.name) {
                config.name = format!("{} ({file})", config.name);
            }
        }
    }
}

/// Where the runs come from.
fn facts(stores: &[(String, Stored)]) -> Vec<Fact> {
    let mut facts = Vec::new();
    for (file, store) in stores {
        let n_done = store.records.len();
        let about = format!("`{file}`: {n_done} of {} runs are done", store.n_planned);
        facts.push(Fact::new("Store", about));
        for (column, name) in [
            ("machine", "Machine"),
            ("version", "formicar"),
            ("build", "Build"),
            ("budget_steps", "Budget, steps"),
            ("deadline_ms", "Deadline, ms"),
        ] {
            let values: BTreeSet<&str> = store.records.iter().map(|r| r.get(column)).collect();
            let values: Vec<&str> = values.into_iter().filter(|v| !v.is_empty()).collect();
            if !values.is_empty() {
                facts.push(Fact::new(name, values.join("; ")));
            }
        }
        let at_once: Vec<String> = store.n_at_once.iter().map(u32::to_string).collect();
        if !at_once.is_empty() {
            facts.push(Fact::new("Runs at once", at_once.join("; ")));
        }
        facts.extend(hashes(&store.records));
        if !store.text.is_empty() {
            facts.push(Fact::new("Campaign", store.text.clone()));
        }
    }
    facts
}

/// The maps and vehicles of all scenarios, by hash.
fn hashes(records: &[Record]) -> Vec<Fact> {
    let mut facts = Vec::new();
    for (column, name) in [("map_hash", "Map"), ("vehicle_hash", "Vehicle")] {
        let hashes: BTreeSet<&str> = records.iter().map(|r| r.get(column)).collect();
        for hash in hashes.into_iter().filter(|hash| !hash.is_empty()) {
            let of_hash = records.iter().filter(|r| r.get(column) == hash);
            let sources: BTreeSet<&str> = of_hash.map(|r| r.get("source")).collect();
            let sources: Vec<&str> = sources.into_iter().collect();
            let about = format!("hash `{hash}`, in scenarios of {}", sources.join(", "));
            facts.push(Fact::new(name, about));
        }
    }
    facts
}

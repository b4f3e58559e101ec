//! Results beside goals and peers, as a page and as Markdown.

use super::results::Results;
use super::{BenchArgs, machine, runs, variant};
use crate::commands::results::config_facts;
use crate::files;
use anyhow::{Context, Result};
use formicar::scenario::MotionMode;
use formicar_lab::analysis::parameter_section;
use formicar_lab::analysis::standing::{Peer, Standing};
use formicar_lab::campaign::{ConfigRecord, Job, Place};
use formicar_lab::report::{Fact, Page, markdown, page};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// The file of peers beside scenario files.
const PEERS: &str = "peers.csv";

/// Names and contents.
pub(super) fn files(
    args: &BenchArgs,
    peers: Vec<Peer>,
    results: &Results,
) -> Result<[(&'static str, String); 2]> {
    let forward_only = args.motion == Some(MotionMode::Forward);
    let mut standing = Standing::read(&results.text()?, peers, forward_only)?;
    // Variants in the order of the flags, the plain planner first.
    let names: Vec<String> = variant::all(args)?.into_iter().map(|v| v.name).collect();
    let place = |planner: &str| names.iter().position(|name| name == planner);
    standing
        .runs
        .sort_by_key(|run| place(&run.planner).unwrap_or(names.len()));
    let mut report = standing.report();
    let text = markdown(&report);
    let configs = variant::all(args)?;
    let configs: Vec<ConfigRecord> = configs.iter().map(runs::config).collect::<Result<_>>()?;
    report.sections.extend(parameter_section(&configs));
    let facts = machine::facts();
    let facts: Vec<_> = facts
        .iter()
        .map(|(name, value)| Fact::new(name, value))
        .collect();
    let whole = Page {
        report: &report,
        facts: &facts,
        configs: &config_facts(&configs),
    };
    Ok([("standing.md", text), ("index.html", page(&whole))])
}

/// The peers of all tables beside the scenarios; none without any.
pub(super) fn peers(jobs: &[Job]) -> Result<Vec<Peer>> {
    let mut paths: BTreeSet<PathBuf> = BTreeSet::new();
    for job in jobs {
        if let Place::File { path, .. } = &job.task.place {
            paths.insert(path.with_file_name(PEERS));
        }
    }
    let mut peers = Vec::new();
    for path in paths.iter().filter(|path| path.exists()) {
        let text = files::read_text(path)?;
        peers.extend(Peer::read(&text).with_context(|| path.display().to_string())?);
    }
    Ok(peers)
}

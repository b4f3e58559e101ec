//! Results beside goals and peers, as a page and as Markdown.

use super::job::Job;
use super::results::Results;
use super::suite::Place;
use super::{BenchArgs, machine, variant};
use crate::files;
use anyhow::{Context, Result};
use formicar::scenario::MotionMode;
use formicar_lab::report::{Fact, Page, markdown, page};
use formicar_lab::standing::Standing;
use std::collections::BTreeSet;
use std::path::PathBuf;

/// The file of peers beside scenario files.
const PEERS: &str = "peers.csv";

/// Names and contents.
pub(super) fn files(
    args: &BenchArgs,
    jobs: &[Job],
    results: &Results,
) -> Result<[(&'static str, String); 2]> {
    let forward_only = args.motion == Some(MotionMode::Forward);
    let peers = peers(jobs)?;
    let mut standing = Standing::read(&results.text()?, peers.as_deref(), forward_only)?;
    // Variants in the order of the flags, the plain planner first.
    let names: Vec<String> = variant::all(args).into_iter().map(|v| v.name).collect();
    standing
        .runs
        .sort_by_key(|run| names.iter().position(|name| *name == run.planner));
    let report = standing.report();
    let facts = machine::facts();
    let facts: Vec<_> = facts
        .iter()
        .map(|(name, value)| Fact::new(name, value))
        .collect();
    let whole = Page {
        report: &report,
        facts: &facts,
        configs: &[],
    };
    Ok([
        ("standing.md", markdown(&report)),
        ("index.html", page(&whole)),
    ])
}

/// The text of all tables of peers beside the scenarios, with one heading; none without any.
fn peers(jobs: &[Job]) -> Result<Option<String>> {
    let mut paths: BTreeSet<PathBuf> = BTreeSet::new();
    for job in jobs {
        if let Place::File { path, .. } = &job.task.place {
            paths.insert(path.with_file_name(PEERS));
        }
    }
    let mut all: Option<String> = None;
    for path in paths.iter().filter(|path| path.exists()) {
        let text = files::read_text(path)?;
        let (heading, rows) = text
            .split_once('\n')
            .with_context(|| format!("{}: it has no rows", path.display()))?;
        let all = all.get_or_insert_with(|| format!("{heading}\n"));
        all.push_str(rows);
        if !rows.ends_with('\n') {
            all.push('\n');
        }
    }
    Ok(all)
}

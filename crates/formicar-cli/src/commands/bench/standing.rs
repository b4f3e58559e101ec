//! Results beside goals and peers, as a page and as Markdown.

use super::{BenchArgs, machine};
use crate::commands::results::config_facts;
use crate::files;
use anyhow::{Context, Result};
use formicar::vehicle::Gears;
use formicar_lab::analysis::parameter_section;
use formicar_lab::analysis::standing::{Peer, Standing};
use formicar_lab::campaign::Campaign;
use formicar_lab::report::{Page, markdown, page};
use formicar_lab::run::{RunRecord, Task};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// The file of peers beside scenario files.
const PEERS: &str = "peers.csv";

/// Names and contents.
pub(super) fn files(
    args: &BenchArgs,
    campaign: &Campaign,
    peers: Vec<Peer>,
    records: Vec<RunRecord>,
) -> [(&'static str, String); 2] {
    let mut standing = Standing {
        runs: records,
        peers,
        forward_only: args.motion == Some(Gears::Forward),
    };
    // Variants in the order of the flags, the plain planner first.
    let configs = &campaign.configs;
    let place = |planner: &str| configs.iter().position(|config| config.name == planner);
    standing
        .runs
        .sort_by_key(|run| place(&run.planner).unwrap_or(configs.len()));
    let mut report = standing.report();
    let text = markdown(&report);
    report.sections.extend(parameter_section(configs));
    let whole = Page {
        report: &report,
        facts: &machine::facts(),
        configs: &config_facts(configs),
    };
    [("standing.md", text), ("index.html", page(&whole))]
}

/// The peers of all tables beside the scenarios.
pub(super) fn peers(tasks: &[Task]) -> Result<Vec<Peer>> {
    let files = tasks.iter().filter_map(Task::file);
    let paths: BTreeSet<PathBuf> = files.map(|path| path.with_file_name(PEERS)).collect();
    let mut peers = Vec::new();
    for path in paths.iter().filter(|path| path.exists()) {
        let text = files::read_text(path)?;
        peers.extend(Peer::read(&text).with_context(|| path.display().to_string())?);
    }
    Ok(peers)
}

//! A campaign into its store.

use super::runs::Runs;
use super::{execute, machine, summary};
use crate::failure::{Ending, Failure};
use anyhow::{Context, Result};
use formicar::map::format::write_atomically;
use formicar::numeric::counted;
use formicar_lab::campaign::{Campaign, Job, Origin, PlannedRun, Record, Store, csv_beside};
use std::io::Write;
use std::path::Path;

/// Carries out what is missing of a campaign.
pub(super) fn run(
    runs: &Runs,
    path: &Path,
    n_at_once: u32,
    out: &mut impl Write,
) -> Result<Ending, Failure> {
    let csv = csv_beside(path)?;
    let campaign = runs.campaign()?;
    let mut store = Store::open(path, &campaign, env!("CARGO_PKG_VERSION"))?;
    store.note_runs_at_once(n_at_once)?;
    let missing = store.missing()?;
    fill(&mut store, &campaign, &missing, n_at_once)?;
    let stored = store.stored()?;
    store.finish()?;
    write_atomically(&csv, stored.csv()?.as_bytes())
        .with_context(|| format!("{} cannot be written", csv.display()))?;
    let rows: Vec<_> = stored
        .records
        .into_iter()
        .map(|record| record.row)
        .collect();
    summary::Summary::new(&rows).write_plain(out)?;
    let kept = match campaign.runs.len() - missing.len() {
        0 => String::new(),
        n => format!(", {n} kept from before"),
    };
    let (n_runs, path, csv) = (counted(missing.len(), "run"), path.display(), csv.display());
    writeln!(out, "{n_runs}{kept}: see {path} and {csv}")?;
    Ok(Ending::Done)
}

fn fill(store: &mut Store, campaign: &Campaign, missing: &[usize], n_at_once: u32) -> Result<()> {
    let machine = machine::name();
    let jobs: Vec<&Job> = missing.iter().map(|&i| &campaign.runs[i].job).collect();
    execute::all(&jobs, n_at_once, |i, over| {
        let place = missing[i];
        store.add(place, &record(&campaign.runs[place], over, &machine))
    })
}

/// What is kept of a run that is over.
pub(crate) fn record(run: &PlannedRun, (row, told): execute::Over, machine: &str) -> Record {
    let program = [env!("CARGO_PKG_VERSION"), machine::profile(), machine];
    Record {
        row,
        origin: Origin::new(run, program),
        history: told.history,
        path: told.path,
    }
}

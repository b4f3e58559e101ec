//! `bench`: planners on scenarios, one process per run, into a store that survives a kill.

mod args;
mod campaign;
mod sources;
mod standing;
mod variant;

pub(crate) use args::BenchArgs;
pub(crate) use sources::Files;

use super::machine;
use crate::failure::{Ending, Failure};
use crate::files;
use crate::output::print_json;
use anyhow::{Context, Result};
use formicar::numeric::counted;
use formicar_lab::analysis::Summary;
use formicar_lab::campaign::{
    Campaign, CampaignSpec, Execution, Folder, MeasuredBy, Sink, Store, csv_beside, run_into,
};
use formicar_lab::run::{Begun, Program, RunRecord, carry_out, usage};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::Write;
use std::path::Path;

/// Carries out `bench`.
pub(crate) fn run(args: &BenchArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let spec = match args.campaign_file()? {
        Some(path) => campaign::read(path)?,
        None => variant::spec(args)?,
    };
    match (&args.store, &args.out) {
        (Some(path), _) => into_store(&spec, path, args.jobs, out),
        (None, Some(folder)) => into_folder(args, &spec, folder, out),
        // One of the two is required.
        (None, None) => Ok(Ending::Refused),
    }
}

/// The campaign of a file.
pub(crate) fn read_campaign(path: &Path) -> Result<Campaign> {
    campaign::read(path)?.campaign(&Files)
}

/// The process of one run: its row, history and path go to stdout as a JSON object.
pub(crate) fn run_one(job: &str, out: &mut impl Write) -> Result<Ending, Failure> {
    let begun = Begun::with_process();
    usage::end_with_parent();
    let job = serde_json::from_str(job).context("the run")?;
    let run = carry_out(&job, &Files, begun)?;
    print_json(out, &run)?;
    Ok(Ending::Done)
}

/// Carries out what is missing of a campaign.
fn into_store(
    spec: &CampaignSpec,
    path: &Path,
    n_at_once: u32,
    out: &mut impl Write,
) -> Result<Ending, Failure> {
    let csv = csv_beside(path)?;
    let campaign = spec.campaign(&Files)?;
    let mut store = Store::open(path, &campaign, env!("CARGO_PKG_VERSION"))?;
    store.note_runs_at_once(n_at_once)?;
    let n_runs = carry_out_in_processes(&campaign, &mut store, n_at_once)?;
    let stored = store.stored()?;
    store.finish()?;
    files::write(&csv, &stored.csv()?)?;
    let records: Vec<RunRecord> = stored.runs.into_iter().map(|run| run.record).collect();
    Summary::new(&records).write_plain(out)?;
    let files = format!("{} and {}", path.display(), csv.display());
    write_end([n_runs, campaign.runs.len()], &files, out)
}

/// Carries out what is missing of the runs that the flags name.
fn into_folder(
    args: &BenchArgs,
    spec: &CampaignSpec,
    folder: &Path,
    out: &mut impl Write,
) -> Result<Ending, Failure> {
    let mut campaign = spec.campaign(&Files)?;
    let peers = standing::peers(&spec.tasks)?;
    if args.paths {
        let paths = folder.join("paths");
        files::make_folder(&paths)?;
        for run in &mut campaign.runs {
            let (scenario, planner, seed) = run.job.key();
            run.job.answer = Some(paths.join(format!("{scenario}.{planner}.{seed}.json")));
        }
    }
    let mut results = Folder::open(folder, &campaign, &args.conditions())?;
    files::write(&folder.join("MACHINE.md"), machine::description())?;
    results.note_runs_at_once(args.jobs)?;
    let n_runs = carry_out_in_processes(&campaign, &mut results, args.jobs)?;
    let records = results.finish()?;
    let summary = Summary::new(&records);
    files::write(&folder.join("summary.md"), summary.markdown())?;
    for (name, text) in standing::files(args, &campaign, peers, records) {
        files::write(&folder.join(name), &text)?;
    }
    summary.write_plain(out)?;
    let files = folder.display().to_string();
    write_end([n_runs, campaign.runs.len()], &files, out)
}

fn carry_out_in_processes(
    campaign: &Campaign,
    sink: &mut dyn Sink,
    n_at_once: u32,
) -> Result<usize> {
    let program = Program::this()?;
    let execution = Execution {
        carry_out: &|job| program.run(job),
        n_at_once,
        measured_by: MeasuredBy::this_build(&machine::name()),
    };
    let bar = progress_bar(sink.missing()?.len());
    let done = run_into(campaign, sink, &execution, &mut || bar.inc(1));
    bar.finish_and_clear();
    done
}

/// A bar on stderr with the time left; none where that is no terminal.
pub(super) fn progress_bar(n_jobs: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos} of {len} runs, {elapsed}, {eta} left");
    let bar = ProgressBar::new(n_jobs as u64);
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn write_end(
    [n_runs, n_all]: [usize; 2],
    files: &str,
    out: &mut impl Write,
) -> Result<Ending, Failure> {
    let kept = match n_all - n_runs {
        0 => String::new(),
        n_kept => format!(", {n_kept} kept from before"),
    };
    writeln!(out, "{}{kept}: see {files}", counted(n_runs, "run"))?;
    Ok(Ending::Done)
}

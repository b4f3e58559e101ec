//! `bench`: planners on scenarios, one process per run, into a store or a table that survives a
//! kill.

mod args;
pub(super) mod campaign;
mod child;
pub(super) mod execute;
pub(super) mod measure;
mod place;
mod results;
mod rival;
mod runs;
mod standing;
pub(super) mod store;
mod suite;
mod summary;
mod variant;

pub(crate) use args::BenchArgs;
pub(crate) use child::run_one;
pub(super) use place::ground_args;

use super::machine;
use crate::failure::{Ending, Failure};
use anyhow::{Context, Result};
use formicar::map::format::write_atomically;
use formicar::numeric::counted;
use formicar_lab::campaign::{Job, Row};
use results::Results;
use runs::Runs;
use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::path::Path;

/// Carries out `bench`.
pub(crate) fn run(args: &BenchArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let runs = match args.campaign_file()? {
        Some(path) => campaign::read(path)?,
        None => Runs::of_flags(args)?,
    };
    match (&args.store, &args.out) {
        (Some(path), _) => store::run(&runs, path, args.jobs, out),
        (None, Some(folder)) => into_folder(args, &runs, folder, out),
        // One of the two is required.
        (None, None) => Ok(Ending::Refused),
    }
}

/// Carries out what is missing of the table of a folder.
fn into_folder(
    args: &BenchArgs,
    runs: &Runs,
    folder: &Path,
    out: &mut impl Write,
) -> Result<Ending, Failure> {
    let mut jobs = runs.jobs();
    for job in jobs.iter_mut().filter(|_| args.paths) {
        let (scenario, planner, seed) = job.row_key();
        let file = format!("{scenario}.{planner}.{seed}.json");
        job.answer = Some(folder.join("paths").join(file));
    }
    let peers = standing::peers(&jobs)?;
    let (mut results, missing) = open(args, folder, &jobs)?;
    let n_kept = jobs.len() - missing.len();
    execute::all(&missing, args.jobs, |_, (row, _)| results.append(row))?;
    results.finish()?;
    let table = summary::Summary::new(results.rows());
    let write = |name: &str, text: String| -> Result<()> {
        let path = folder.join(name);
        write_atomically(&path, text.as_bytes())
            .with_context(|| format!("{} cannot be written", path.display()))
    };
    write("summary.md", table.markdown())?;
    for (name, text) in standing::files(args, peers, &results)? {
        write(name, text)?;
    }
    table.write_plain(out)?;
    let kept = if n_kept > 0 {
        format!(", {n_kept} kept from before")
    } else {
        String::new()
    };
    let folder = folder.display();
    let n_runs = counted(missing.len(), "run");
    writeln!(out, "{n_runs}{kept}: see {folder}")?;
    Ok(Ending::Done)
}

/// The folder of results, with what stands in it from before, and the runs that are missing.
fn open<'a>(args: &BenchArgs, out: &Path, jobs: &'a [Job]) -> Result<(Results, Vec<&'a Job>)> {
    let folder = if args.paths {
        out.join("paths")
    } else {
        out.to_owned()
    };
    fs::create_dir_all(&folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    // A row whose answer is asked for, and is not there, is not complete.
    let incomplete: BTreeSet<_> = jobs
        .iter()
        .filter(|job| job.answer.as_ref().is_some_and(|path| !path.exists()))
        .map(Job::row_key)
        .collect();
    let results = Results::open(out, &args.conditions(), &incomplete)?;
    let path = out.join("MACHINE.md");
    write_atomically(&path, machine::description().as_bytes())
        .with_context(|| format!("{} cannot be written", path.display()))?;
    let done: BTreeSet<_> = results.rows().iter().map(Row::key).collect();
    let missing = jobs.iter().filter(|job| !done.contains(&job.row_key()));
    let missing = missing.collect();
    Ok((results, missing))
}

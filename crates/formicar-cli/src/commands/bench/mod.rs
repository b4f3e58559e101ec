//! `bench`: planners on scenarios, one process per run, into a table that survives a kill.

mod args;
mod child;
mod execute;
mod job;
mod measure;
mod results;
mod row;
mod standing;
mod suite;
mod summary;
mod usage;
mod variant;

pub(crate) use args::BenchArgs;
pub(crate) use child::run_one;

use super::machine;
use crate::failure::{Ending, Failure};
use crate::settings;
use anyhow::{Context, Result};
use formicar::map::format::write_atomically;
use job::Job;
use results::Results;
use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use suite::Task;
use variant::Variant;

/// Carries out `bench`.
pub(crate) fn run(args: &BenchArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let jobs = jobs(args)?;
    let peers = standing::peers(&jobs)?;
    let (mut results, missing) = open(args, &jobs)?;
    let n_kept = jobs.len() - missing.len();
    execute::all(&missing, args.jobs, |row| results.append(row))?;
    results.finish()?;
    let table = summary::Summary::new(results.rows());
    let write = |name: &str, text: String| -> Result<()> {
        let path = args.out.join(name);
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
    let folder = args.out.display();
    writeln!(out, "{} runs{kept}: see {folder}", missing.len())?;
    Ok(Ending::Done)
}

/// Every run, in order; refused as a whole where something is wrong with one.
fn jobs(args: &BenchArgs) -> Result<Vec<Job>> {
    let variants = variant::all(args);
    for variant in &variants {
        settings::load(None, &variant.set, Some(variant.planner))?;
    }
    let planners: Vec<_> = variants.iter().map(|variant| variant.planner).collect();
    let tasks = suite::tasks(&args.scenarios, args.limit, &planners)?;
    let of = |task: &Task, variant: &Variant| {
        let seeds = 0..args.seeds;
        seeds
            .map(|seed| Job::new(args, task.clone(), variant, seed))
            .collect::<Vec<_>>()
    };
    let jobs = tasks
        .iter()
        .flat_map(|task| variants.iter().flat_map(move |variant| of(task, variant)));
    Ok(jobs.collect())
}

/// The folder of results, with what stands in it from before, and the runs that are missing.
fn open<'a>(args: &BenchArgs, jobs: &'a [Job]) -> Result<(Results, Vec<&'a Job>)> {
    let folder = if args.paths {
        args.out.join("paths")
    } else {
        args.out.clone()
    };
    fs::create_dir_all(&folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    // A row whose answer is asked for, and is not there, is not complete.
    let incomplete: BTreeSet<_> = jobs
        .iter()
        .filter(|job| job.answer.as_ref().is_some_and(|path| !path.exists()))
        .map(Job::key)
        .collect();
    let results = Results::open(&args.out, &args.conditions(), &incomplete)?;
    let path = args.out.join("MACHINE.md");
    write_atomically(&path, machine::description().as_bytes())
        .with_context(|| format!("{} cannot be written", path.display()))?;
    let done: BTreeSet<_> = results.rows().iter().map(row::Row::key).collect();
    let missing = jobs.iter().filter(|job| !done.contains(&job.key()));
    let missing = missing.collect();
    Ok((results, missing))
}

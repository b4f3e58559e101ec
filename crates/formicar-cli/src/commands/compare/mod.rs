//! `compare`: two stores of the same scenarios, or two builds on them, with a verdict per metric.

mod args;

pub(crate) use args::CompareArgs;

use super::{bench, machine, results};
use crate::failure::{Ending, Failure};
use crate::output::print_json;
use anyhow::Result;
use formicar_lab::analysis::compare::{Comparison, Scope, Side};
use formicar_lab::campaign::{check_once, name_of_file, read_results, run_in_turns};
use formicar_lab::report::{latex, markdown};
use formicar_lab::run::{Program, to_csv};
use std::io::Write;
use std::path::Path;

/// Carries out `compare`.
pub(crate) fn run(args: &CompareArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let sides = match (&args.with, &args.b) {
        (Some(other), _) => sides_in_turns(&args.a, other)?,
        (None, Some(b)) => named_sides(&args.a, b)?,
        // One of the two is required.
        (None, None) => return Ok(Ending::Refused),
    };
    let scope = if args.results_only {
        Scope::Results
    } else {
        Scope::All
    };
    let comparison = Comparison::new(&sides[0], &sides[1], scope)?;
    if let Some(folder) = &args.out {
        write(folder, &comparison, &sides, args.with.is_some())?;
    }
    if args.json {
        print_json(out, &comparison)?;
    } else {
        write!(out, "{}", markdown(&comparison.report()))?;
    }
    let is_refused =
        args.fail_on_worse && comparison.is_worse() || args.fail_on_lost && comparison.has_lost();
    Ok(if is_refused {
        Ending::Worse
    } else {
        Ending::Done
    })
}

/// The runs of another build and those of this one.
fn sides_in_turns(campaign: &Path, other: &Path) -> Result<[Side; 2]> {
    let campaign = bench::read_campaign(campaign)?;
    let (other, this) = (Program::at(other), Program::this()?);
    let bar = bench::progress_bar(2 * campaign.runs.len());
    let machine = machine::name();
    let sides = run_in_turns(&campaign, [&other, &this], &machine, &mut || bar.inc(1));
    bar.finish_and_clear();
    let [of_other, of_this] = sides?;
    let side = |name: &str, runs| Side {
        name: name.to_owned(),
        runs,
    };
    Ok([side("other build", of_other), side("this build", of_this)])
}

/// The runs of two files, under their names or, where these are the same, their paths.
fn named_sides(a: &Path, b: &Path) -> Result<[Side; 2]> {
    check_once(&[a, b])?;
    let is_same = name_of_file(a) == name_of_file(b);
    let side = |path: &Path| -> Result<Side> {
        let name = if is_same {
            path.display().to_string()
        } else {
            name_of_file(path)
        };
        Ok(Side {
            name,
            runs: read_results(path)?.runs,
        })
    };
    Ok([side(a)?, side(b)?])
}

fn write(
    folder: &Path,
    comparison: &Comparison,
    sides: &[Side; 2],
    with_tables: bool,
) -> Result<()> {
    let report = comparison.report();
    let mut files = results::report_files(&report, &machine::facts(), &[]);
    files.push(("tables.tex".to_owned(), latex(&report)));
    if with_tables {
        for (side, name) in sides.iter().zip(["a.csv", "b.csv"]) {
            files.push((name.to_owned(), to_csv(&side.runs)?));
        }
    }
    results::write_all(folder, &files)
}

//! `compare`: two stores of the same scenarios, or two builds on them, with a verdict per metric.

mod args;
mod interleaved;

pub(crate) use args::CompareArgs;

use super::{machine, results};
use crate::failure::{Ending, Failure};
use anyhow::Result;
use formicar_lab::analysis::compare::{Comparison, Scope, Side};
use formicar_lab::report::{Fact, latex, markdown};
use std::io::Write;
use std::path::Path;

/// Carries out `compare`.
pub(crate) fn run(args: &CompareArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let sides = match (&args.with, &args.b) {
        (Some(other), _) => interleaved::sides(&args.a, other)?,
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
        serde_json::to_writer(&mut *out, &comparison).map_err(std::io::Error::from)?;
        writeln!(out)?;
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

/// The runs of two files, under their names or, where these are the same, their paths.
fn named_sides(a: &Path, b: &Path) -> Result<[Side; 2]> {
    results::check_once(&[a, b])?;
    let is_same = results::name(a) == results::name(b);
    let side = |path: &Path| -> Result<Side> {
        let name = if is_same {
            path.display().to_string()
        } else {
            results::name(path)
        };
        Ok(Side {
            name,
            records: results::read(path)?.records,
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
    let facts = machine::facts();
    let facts: Vec<Fact> = facts.iter().map(|(n, v)| Fact::new(n, v)).collect();
    let mut files = results::report_files(&report, &facts, &[]);
    files.push(("tables.tex".to_owned(), latex(&report)));
    if with_tables {
        for (side, name) in sides.iter().zip(["a.csv", "b.csv"]) {
            files.push((
                name.to_owned(),
                formicar_lab::campaign::to_csv(&side.records)?,
            ));
        }
    }
    results::write_all(folder, &files)
}

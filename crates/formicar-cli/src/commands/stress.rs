//! `stress`: random scenarios through a planner and an independent look at what comes out.
#![allow(clippy::doc_markdown, reason = "clap prints these words as they stand")]

use crate::failure::{Ending, Failure};
use crate::settings;
use clap::Args;
use formicar::planner::PlannerName;
use formicar_lab::stress::{Stress, StressReport};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::Write;

/// Flags of `stress`.
#[derive(Args, Debug)]
#[command(after_help = "\
Maps have at most 200 x 200 cells: open, strewn, corridors, rooms, mazes, some goals walled in; \
vehicles are presets, random rectangles and polygons. Nothing may panic, every path is judged again \
and sampled pose by pose, every failure gives its reason. Scenario i has the seed SEED + i, so that \
`--n 1 --seed K` repeats the one of seed K. Exit code 1 where anything is violated.")]
pub(crate) struct StressArgs {
    /// Number of scenarios.
    #[arg(long, value_name = "N", default_value_t = 1000,
          value_parser = clap::value_parser!(u64).range(1..=100_000_000))]
    pub(crate) n: u64,

    /// Seed of the first scenario.
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    pub(crate) seed: u64,

    /// Scenarios at once; the results never depend on it.
    #[arg(long, value_name = "N", default_value_t = 1,
          value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) jobs: u32,

    /// Search steps after which a scenario gives up.
    #[arg(long, value_name = "STEPS", default_value_t = 20_000)]
    pub(crate) budget: u64,

    /// Planner; `formicar` by default. Those over cells are no match for every vehicle.
    #[arg(long, value_name = "NAME", default_value = "formicar")]
    pub(crate) planner: PlannerName,

    /// One planner parameter, for instance hybrid_astar.weight=1.2; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,

    /// Tell of every scenario rather than of violations alone.
    #[arg(long)]
    pub(crate) verbose: bool,
}

/// Carries out `stress`.
pub(crate) fn run(args: &StressArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let config = settings::load(None, &args.set, Some(args.planner))?;
    let stress = Stress {
        n_scenarios: args.n,
        seed: args.seed,
        budget_steps: args.budget,
        n_jobs: args.jobs as usize,
        config: config.for_motion(formicar::vehicle::Motion::Car),
    };
    let bar = progress_bar(args.n);
    let report = stress.run(&mut |n_done| bar.set_position(n_done as u64));
    bar.finish_and_clear();
    write_report(args, &report, out)?;
    Ok(match report.n_violations() {
        0 => Ending::Done,
        _ => Ending::Broken,
    })
}

fn progress_bar(n_scenarios: u64) -> ProgressBar {
    let style =
        ProgressStyle::with_template("{bar:30} {pos} of {len} scenarios, {elapsed} of {duration}");
    let bar = ProgressBar::new(n_scenarios);
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn write_report(
    args: &StressArgs,
    report: &StressReport,
    out: &mut impl Write,
) -> Result<(), Failure> {
    if args.verbose {
        for case in &report.cases {
            let (seed, status, about) = (case.seed, &case.status, &case.about);
            writeln!(
                out,
                "seed {seed}: {status} after {} steps; {about}",
                case.n_steps
            )?;
        }
    }
    for case in report.violations() {
        for violation in &case.violations {
            writeln!(out, "seed {}: {violation}; {}", case.seed, case.about)?;
        }
    }
    let counts = report.counts();
    let counts = counts.iter().map(|(status, n)| format!("{n} {status}"));
    let counts: Vec<_> = counts.collect();
    writeln!(
        out,
        "{} scenarios from seed {}: {}; {} steps, digest {:016x}",
        args.n,
        args.seed,
        counts.join(", "),
        report.n_steps(),
        report.digest()
    )?;
    let n = report.n_violations();
    let verdict = match n {
        0 => "no violation".to_owned(),
        n => format!(
            "{n} scenarios with violations; hint: formicar stress --n 1 --seed K repeats one"
        ),
    };
    writeln!(out, "{verdict}")?;
    Ok(())
}

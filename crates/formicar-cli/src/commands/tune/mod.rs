//! `tune`: a bee colony looks for a planner's parameters.

mod args;
mod grounds;

pub(crate) use args::TuneArgs;

use super::machine;
use crate::failure::{Ending, Failure, note};
use crate::{files, settings};
use anyhow::{Context, Result, bail};
use formicar::numeric::Seed;
use formicar::tuning::BeeColonyConfig;
use formicar::vehicle::Motion;
use formicar_lab::report::{Page, markdown, page};
use formicar_lab::tuning::{
    Asked, Objective, Tuning, TuningSpace, TuningState, Verdict, split, tuned_text,
};
use indicatif::ProgressBar;
use std::io::Write;
use std::path::Path;

/// Carries out `tune`.
pub(crate) fn run(args: &TuneArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let tuning = tuning(args)?;
    let begun = tuning.begin()?;
    files::make_folder(&args.out)?;
    let file = match &args.state {
        Some(file) => file.clone(),
        None => args.out.join("state.json"),
    };
    let state = search(&tuning, begun, &file)?;
    let verdict = tuning.verdict(&state)?;
    write_all(&args.out, &verdict)?;
    write!(out, "{}", markdown(&verdict.report))?;
    let [config, page] = ["tuned.toml", "index.html"].map(|name| args.out.join(name));
    writeln!(
        out,
        "\n{}: for plan --config; see {}",
        config.display(),
        page.display()
    )?;
    Ok(Ending::Done)
}

/// What the flags ask for; everything wrong with them is found here.
fn tuning(args: &TuneArgs) -> Result<Tuning> {
    if !(0.0..1.0).contains(&args.hold_back) {
        let share = args.hold_back;
        bail!("--hold-back {share}: a share is at least 0 and below 1");
    }
    let settings = settings::load(args.config.as_deref(), &args.set, Some(args.planner))?;
    let base = settings.for_motion(Motion::Car);
    let (space, left_out) = TuningSpace::new(&base, &args.parameter, &args.group, &args.range)?;
    if !left_out.is_empty() {
        let keys = left_out.join(", ");
        note(&format!(
            "not tuned, for want of a range: {keys}; hint: --range"
        ));
    }
    let (scenarios, held_back) = scenarios(args)?;
    Ok(Tuning {
        space,
        scenarios,
        held_back,
        objective: Objective {
            measure: args.objective,
            steps_weight: args.steps_weight,
        },
        n_seeds: args.seeds,
        n_check_seeds: args.check_seeds,
        bees: BeeColonyConfig {
            n_sources: args.sources,
            limit: args.limit,
            max_evaluations: args.evaluations,
            variant: args.variant,
        },
        seed: Seed(args.seed),
        n_jobs: args.jobs as usize,
    })
}

/// Scenarios to tune on and scenarios held back.
fn scenarios(args: &TuneArgs) -> Result<(Vec<Asked>, Vec<Asked>)> {
    let all = grounds::asked(args, &args.scenarios)?;
    if !args.held_back.is_empty() {
        let held_back = grounds::asked(args, &args.held_back)?;
        let twice = all.iter().find(|asked| {
            let name = &asked.ground.map;
            held_back.iter().any(|held| held.ground.map == *name)
        });
        return match twice {
            Some(asked) => bail!("{} cannot be tuned on and held back", asked.ground.map),
            None => Ok((all, held_back)),
        };
    }
    if args.hold_back == 0.0 {
        return Ok((all, Vec::new()));
    }
    let held = split(all.len(), args.hold_back, Seed(args.seed));
    let numbered = all.into_iter().enumerate();
    let (held, rest): (Vec<_>, Vec<_>) = numbered.partition(|(i, _)| held.contains(i));
    let bare = |all: Vec<(usize, Asked)>| all.into_iter().map(|(_, asked)| asked).collect();
    Ok((bare(rest), bare(held)))
}

/// Goes on from the state in a file, or begins; the file is written after each cycle.
fn search(tuning: &Tuning, begun: TuningState, file: &Path) -> Result<TuningState> {
    let mut state = if file.exists() {
        let text = files::read_text(file)?;
        let state = TuningState::read(&text).with_context(|| file.display().to_string())?;
        let hint = || format!("{}; hint: another --out, or remove it", file.display());
        state.follows(&begun).with_context(hint)?;
        state
    } else {
        begun
    };
    let bar = ProgressBar::new(state.colony().config().max_evaluations);
    while !state.colony().is_done() {
        bar.set_position(state.colony().n_evaluations());
        tuning.cycle(&mut state)?;
        files::write(file, state.text()?)?;
    }
    bar.finish_and_clear();
    Ok(state)
}

fn write_all(folder: &Path, verdict: &Verdict) -> Result<()> {
    let facts = [machine::facts(), verdict.facts.clone()].concat();
    let page = page(&Page {
        report: &verdict.report,
        facts: &facts,
        configs: &verdict.configs,
    });
    for (name, text) in [
        ("tuned.toml", tuned_text(&verdict.document)?),
        ("convergence.svg", verdict.convergence_svg.clone()),
        ("index.html", page),
        ("summary.md", markdown(&verdict.report)),
        ("cycles.csv", verdict.cycles_csv.clone()),
        ("runs.csv", verdict.runs_csv.clone()),
        ("MACHINE.md", machine::description()),
    ] {
        files::write(&folder.join(name), text)?;
    }
    Ok(())
}

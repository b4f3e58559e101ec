//! `reproduce`: what a paper claims, repeated on our maps.

use super::machine;
use crate::failure::{Ending, Failure};
use anyhow::{Context, Result};
use clap::{Args, ValueEnum, ValueHint};
use formicar::map::format::write_atomically;
use formicar_lab::{Reproduction, Scale};
use indicatif::ProgressBar;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Flags of `reproduce`.
#[derive(Args, Debug)]
pub(crate) struct ReproduceArgs {
    /// The paper.
    pub(crate) paper: Paper,

    /// Folder of the results, made where it does not exist; a folder per paper stands in it.
    #[arg(long, value_name = "DIR", default_value = "./reproductions", value_hint = ValueHint::DirPath)]
    pub(crate) out: PathBuf,

    /// Few seeds, to see that it works: numbers mean little.
    #[arg(long)]
    pub(crate) quick: bool,
}

/// The papers that can be repeated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Paper {
    /// Lei & Zheng 2020: ablation on three maps, beside Table 1.
    Lei2020,
    /// Wang et al. 2019: narrow aisles, convergence, adjacency.
    Wang2019,
    /// All of them.
    All,
}

/// Runs the experiment of a paper.
type Experiment = fn(Scale, &mut dyn FnMut(&str)) -> Result<Reproduction>;

impl Paper {
    fn experiments(self) -> Vec<(&'static str, Experiment)> {
        match self {
            Self::Lei2020 => vec![("lei2020", formicar_lab::lei2020)],
            Self::Wang2019 => vec![("wang2019", formicar_lab::wang2019)],
            Self::All => [Self::Lei2020, Self::Wang2019]
                .into_iter()
                .flat_map(Self::experiments)
                .collect(),
        }
    }
}

/// Carries out `reproduce`.
pub(crate) fn run(args: &ReproduceArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let scale = if args.quick {
        Scale::QUICK
    } else {
        Scale::FULL
    };
    for (name, experiment) in args.paper.experiments() {
        let bar = ProgressBar::new_spinner();
        let reproduction = experiment(scale, &mut |what| bar.set_message(what.to_owned()));
        bar.finish_and_clear();
        let folder = args.out.join(name);
        let reproduction = reproduction?;
        write_all(&folder, &reproduction)?;
        write!(out, "{}", reproduction.summary)?;
        writeln!(
            out,
            "\n{} runs: see {}\n",
            reproduction.trials.len(),
            folder.display()
        )?;
    }
    Ok(Ending::Done)
}

fn write_all(folder: &Path, reproduction: &Reproduction) -> Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    for (name, text) in [
        ("results.csv", reproduction.csv()?),
        ("summary.md", reproduction.summary.clone()),
        ("MACHINE.md", machine::description()),
    ] {
        let path = folder.join(name);
        write_atomically(&path, text.as_bytes())
            .with_context(|| format!("{} cannot be written", path.display()))?;
    }
    Ok(())
}

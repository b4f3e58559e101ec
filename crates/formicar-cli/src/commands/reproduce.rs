//! `reproduce`: the experiments of papers, repeated on our maps.

use super::{machine, results};
use crate::failure::{Ending, Failure};
use anyhow::Result;
use clap::{Args, ValueEnum, ValueHint};
use formicar_lab::papers::{Reproduction, Scale, Setup};
use formicar_lab::report::markdown;
use indicatif::ProgressBar;
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

    /// Runs at a time. Results are the same; times are those of runs side by side.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = jobs)]
    pub(crate) jobs: usize,

    /// Folder of data sets, of which `li2024` uses `car/hood_800x500.json` where it is there.
    #[arg(long, value_name = "DIR", default_value = "../shared/data", value_hint = ValueHint::DirPath)]
    pub(crate) data: PathBuf,
}

/// More runs at a time than this are a slip.
const MAX_JOBS: usize = 256;

fn jobs(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n @ 1..=MAX_JOBS) => Ok(n),
        _ => Err(format!("{text} is not a whole number from 1 to {MAX_JOBS}")),
    }
}

/// The papers that can be repeated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Paper {
    /// Lei & Zheng 2020: ablation on three maps, beside Table 1.
    Lei2020,
    /// Wang et al. 2019: narrow aisles, convergence, adjacency.
    Wang2019,
    /// Li et al. 2024: FACO and six rivals on a neighborhood, beside Tables 1 and 2.
    Li2024,
    /// No paper: replanning against planning anew on changing maps.
    Replanning,
    /// No paper: how cost grows with cells, density, vehicle, ants and threads.
    Scaling,
    /// All but scaling, which takes long and tells of the machine.
    All,
}

/// Runs the experiment of a paper.
type Experiment = fn(&Setup, &mut dyn FnMut(&str)) -> Result<Reproduction>;

impl Paper {
    fn experiments(self) -> Vec<(&'static str, Experiment)> {
        match self {
            Self::Lei2020 => vec![("lei2020", formicar_lab::papers::lei2020)],
            Self::Wang2019 => vec![("wang2019", formicar_lab::papers::wang2019)],
            Self::Li2024 => vec![("li2024", formicar_lab::papers::li2024)],
            Self::Replanning => vec![("replanning", formicar_lab::papers::replanning)],
            Self::Scaling => vec![("scaling", formicar_lab::papers::scaling)],
            Self::All => [
                Self::Lei2020,
                Self::Wang2019,
                Self::Li2024,
                Self::Replanning,
            ]
            .into_iter()
            .flat_map(Self::experiments)
            .collect(),
        }
    }
}

/// Carries out `reproduce`.
pub(crate) fn run(args: &ReproduceArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let setup = Setup {
        scale: if args.quick {
            Scale::QUICK
        } else {
            Scale::FULL
        },
        data: args.data.clone(),
        n_jobs: args.jobs,
    };
    for (name, experiment) in args.paper.experiments() {
        let bar = ProgressBar::new_spinner();
        let reproduction = experiment(&setup, &mut |what| bar.set_message(what.to_owned()));
        bar.finish_and_clear();
        let folder = args.out.join(name);
        let reproduction = reproduction?;
        write_all(&folder, &reproduction)?;
        write!(out, "{}", markdown(&reproduction.report))?;
        writeln!(
            out,
            "\n{} runs: see {}\n",
            reproduction.n_runs,
            folder.join("index.html").display()
        )?;
    }
    Ok(Ending::Done)
}

fn write_all(folder: &Path, reproduction: &Reproduction) -> Result<()> {
    let mut files = reproduction.files(&machine::facts())?;
    files.push(("MACHINE.md".to_owned(), machine::description()));
    results::write_all(folder, &files)
}

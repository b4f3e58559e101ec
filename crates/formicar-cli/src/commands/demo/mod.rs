//! `demo`: the built-in maps planned, as a table, pictures and a page.

mod case;
mod catalog;
mod page;
mod run;
mod table;

use crate::failure::{Ending, Failure};
use crate::files;
use crate::output::Target;
use anyhow::{Context, Result, bail};
use case::Case;
use clap::{Args, ValueHint};
use formicar_lab::run::pool;
use run::{Done, RUNS_FOLDER};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Flags of `demo`.
#[derive(Args, Debug)]
pub(crate) struct DemoArgs {
    /// Folder of the page; created if needed, and files of an earlier demo are replaced.
    #[arg(long, value_name = "DIR", default_value = "./formicar-demo", value_hint = ValueHint::DirPath)]
    out: PathBuf,

    /// Only runs whose name holds this word; may be repeated.
    #[arg(long, value_name = "WORD", hide = true)]
    only: Vec<String>,
}

/// Runs at a time.
const N_WORKERS: usize = 2;

/// Carries out `demo`.
pub(crate) fn run(args: &DemoArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let begun = Instant::now();
    let cases = select(&args.only)?;
    let page = prepare(&args.out)?;
    let mut table = table::Table::new(&cases);
    table.write_head(out)?;
    let done = carry_out(&cases, |done| {
        write_files(&args.out, done)?;
        table.write_row(done, out)?;
        Ok(out.flush()?)
    })?;
    let total_s = begun.elapsed().as_secs_f64();
    page.write(page::html(&done, total_s).as_bytes())?;
    table::write_end(&done, total_s, page.path(), out)?;
    Ok(Ending::Done)
}

/// The cases whose name holds one of the words; all of them without words.
fn select(words: &[String]) -> Result<Vec<Case>> {
    let mut cases = catalog::cases()?;
    if !words.is_empty() {
        cases.retain(|case| words.iter().any(|word| case.id().contains(word.as_str())));
    }
    if cases.is_empty() {
        bail!("--only: no run of the demo has {words:?} in its name");
    }
    Ok(cases)
}

/// Makes the folders, and sees that the page can be written.
fn prepare(folder: &Path) -> Result<Target<()>> {
    let runs = folder.join(RUNS_FOLDER);
    fs::create_dir_all(&runs).with_context(|| {
        let runs = runs.display();
        format!(
            "--out: the folder {runs} cannot be made; hint: name one where files may be written"
        )
    })?;
    Target::new(&folder.join("index.html"), &[("html", ())])
}

/// Plans all cases on two threads and hands each on in the order of the catalog. Cases share
/// nothing, so that the number of threads changes times alone.
fn carry_out<'a>(
    cases: &'a [Case],
    mut hand_on: impl FnMut(&Done<'a>) -> Result<(), Failure>,
) -> Result<Vec<Done<'a>>, Failure> {
    let mut done = Vec::new();
    let run = |i: usize| run::run(&cases[i]);
    pool::in_order(N_WORKERS, cases.len(), run, |finished| {
        let finished = finished?;
        hand_on(&finished)?;
        done.push(finished);
        Ok::<_, Failure>(())
    })?;
    Ok(done)
}

fn write_files(folder: &Path, done: &Done) -> Result<()> {
    for (extension, bytes) in done.files()? {
        let name = format!("{}.{extension}", done.case.id());
        let path = folder.join(RUNS_FOLDER).join(name);
        files::write(&path, bytes)?;
    }
    Ok(())
}

//! `map build`: lidar logs to a map.

mod args;
mod drives;
mod judged;
mod report;

pub(crate) use args::BuildArgs;

use super::files::{self as map_files, Frame};
use crate::failure::{Ending, Failure, note};
use crate::files;
use crate::lidar::{Interrupt, ScanBar, Trajectory, read_log};
use crate::output::print_json;
use anyhow::{Context, Result, bail};
use args::Preset;
use drives::Drives;
use formicar_mapping::{BuiltMap, MapReport, Mapper, MappingConfig};
use report::ReportFolder;
use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

/// The files to write, checked before any work.
struct Outputs {
    trajectory: Option<Trajectory>,
    folder: Option<ReportFolder>,
}

/// Carries out `map build`.
pub(crate) fn run(args: &BuildArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    check_out(args)?;
    let outputs = Outputs {
        trajectory: Trajectory::of(args.trajectory.as_deref())?,
        folder: ReportFolder::of(args.report.as_deref())?,
    };
    let Some((report, built)) = built(args, &outputs)? else {
        return Ok(interrupted(args));
    };
    if args.json {
        print_json(out, &report)?;
        return Ok(Ending::Done);
    }
    let frame = built.grid.frame();
    let (extent, cell_m) = (frame.extent_m(), frame.resolution_m());
    let (name, width, height) = (args.out.display(), extent.x, extent.y);
    writeln!(
        out,
        "{name}: {width:.1} x {height:.1} m, cells of {cell_m} m"
    )?;
    for (name, value) in report.facts() {
        writeln!(out, "{name:16} {value}")?;
    }
    Ok(Ending::Done)
}

/// Builds the map and writes all files; nothing but the session where Ctrl-C was pressed.
fn built(args: &BuildArgs, outputs: &Outputs) -> Result<Option<(MapReport, BuiltMap)>> {
    let mut mapper = mapper(args)?;
    let mut times_s: Vec<(String, f64)> = Vec::new();
    let mut begin = Instant::now();
    let mut lap = |name: &str| {
        times_s.push((name.to_owned(), begin.elapsed().as_secs_f64()));
        begin = Instant::now();
    };
    let logs = args.logs.iter().map(|path| read_log(path, &args.how));
    let logs = logs.collect::<Result<Vec<_>>>()?;
    lap("reading");
    let interrupt = Interrupt::watch();
    let drives = Drives::add(&mut mapper, logs, args, &interrupt)?;
    lap("matching scans");
    if let Some(path) = &args.session {
        files::write(path, mapper.to_session().context("--session")?)?;
    }
    if interrupt.is_pressed() {
        return Ok(None);
    }
    let bar = ScanBar::new(&interrupt);
    let built = mapper.finish(|step| bar.show(step))?;
    drop(bar);
    if interrupt.is_pressed() {
        return Ok(None);
    }
    lap("loops to map");
    let poses = drives.trajectory(&built);
    let mut report = judged::report(&mapper, &built, &drives, &poses);
    let name = |path: &PathBuf| {
        let name = path.file_name().unwrap_or(path.as_os_str());
        name.to_string_lossy().into_owned()
    };
    report.logs = args.logs.iter().map(name).collect();
    report.times_s = times_s;
    map_files::write(&args.out, &built.grid, Frame::Keep)?;
    if let Some(trajectory) = &outputs.trajectory {
        trajectory.write(&drives.scans, &poses)?;
    }
    if let Some(folder) = &outputs.folder {
        folder.write(&report, &built)?;
    }
    Ok(Some((report, built)))
}

/// A mapper with the flags' parameters, or the one of the session.
fn mapper(args: &BuildArgs) -> Result<Mapper> {
    if let Some(path) = args.session.as_deref().filter(|path| path.exists()) {
        let mapper = Mapper::from_session(&files::read_bytes(path)?)
            .with_context(|| path.display().to_string())?;
        if let Some(resolution) = args.resolution
            && resolution != mapper.config().resolution_m
        {
            bail!(
                "--resolution {resolution}: the session {} has {} m; hint: leave the flag out, or \
                 name another session",
                path.display(),
                mapper.config().resolution_m
            );
        }
        return Ok(mapper);
    }
    let mut config = match args.preset {
        Preset::Formicar => MappingConfig::default(),
        Preset::Fossel2015 => MappingConfig::fossel2015(),
    };
    if let Some(resolution) = args.resolution {
        config.resolution_m = resolution;
    }
    if let Some(max_m) = args.max_range {
        config.ranges.max_m = max_m;
    }
    Ok(Mapper::new(config)?)
}

/// Refuses a name that cannot be written before hours of work.
fn check_out(args: &BuildArgs) -> Result<()> {
    let kinds = [("yaml", ()), ("yml", ()), ("pgm", ()), ("png", ())];
    crate::output::Target::new(&args.out, &kinds)?;
    if let Some(session) = &args.session {
        crate::output::Target::new(session, &[("session", ())]).context("--session")?;
    }
    Ok(())
}

fn interrupted(args: &BuildArgs) -> Ending {
    match &args.session {
        Some(path) => note(&format!(
            "interrupted; {} holds the scans so far, and the same command goes on with it",
            path.display()
        )),
        None => note("interrupted; nothing was written; hint: --session keeps the scans so far"),
    }
    Ending::NoPath
}

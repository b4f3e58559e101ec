//! `locate`: a robot found in a map, scan after scan.
#![allow(clippy::doc_markdown, reason = "clap prints these words as they stand")]

use crate::failure::{Ending, Failure, note};
use crate::lidar::{Interrupt, LogArgs, MapToSearch, ScanBar, Trajectory, read_log};
use crate::values;
use anyhow::{Result, anyhow};
use clap::{Args, ValueHint};
use formicar::Pose2;
use formicar_mapping::front_end::Quality;
use formicar_mapping::localize::Located;
use formicar_mapping::{Go, Localizer, Log, Progress};
use std::io::Write;
use std::path::PathBuf;

/// Flags of `locate`.
#[derive(Args, Debug)]
#[command(after_help = "\
The poses are those of the laser, in the frame of the map. A scan that fits nowhere is lost: its \
row holds the expected pose and says so. Exit code 3 where more than half of the scans are lost.")]
pub(crate) struct LocateArgs {
    /// The lidar log: a bag of ROS 2 (.mcap, or its folder), or CARMEN, plain or .gz.
    #[arg(value_name = "LOG", value_hint = ValueHint::FilePath)]
    pub(super) log: PathBuf,

    /// The map: a map file, or the session of `map build`, which knows surfaces to millimeters.
    #[arg(long, value_name = "M", value_hint = ValueHint::FilePath)]
    pub(super) map: PathBuf,

    /// Pose of the laser at the first scan.
    #[arg(long, value_name = "X,Y,H", value_parser = values::pose, allow_hyphen_values = true)]
    pub(super) start: Option<Pose2>,

    /// Search the first scans in the whole map, as without --start.
    #[arg(long, conflicts_with = "start")]
    pub(super) global: bool,

    #[command(flatten)]
    pub(super) how: LogArgs,

    /// Write the pose at every scan: .csv with quality and standard deviations, or .tum.
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) trajectory: Option<PathBuf>,
}

/// Carries out `locate`.
pub(crate) fn run(args: &LocateArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let trajectory = Trajectory::of(args.trajectory.as_deref())?;
    let log = read_log(&args.log, &args.how)?;
    let map = MapToSearch::read(&args.map)?;
    let interrupt = Interrupt::watch();
    let found = located(&map, &log, args.start, &interrupt)?;
    if interrupt.is_pressed() {
        note("interrupted; nothing was written");
        return Ok(Ending::NoPath);
    }
    if let Some(trajectory) = trajectory {
        trajectory.write_located(&log.scans, &found)?;
    }
    let count = |quality: Quality| found.iter().filter(|l| l.quality == quality).count();
    let n_lost = count(Quality::Lost);
    writeln!(out, "scans       {}", found.len())?;
    writeln!(
        out,
        "found       {} ({} of them in a wider window, {} by a search in the whole map)",
        found.len() - n_lost - count(Quality::Degenerate),
        count(Quality::Widened),
        count(Quality::First)
    )?;
    writeln!(out, "lost        {n_lost}")?;
    writeln!(out, "degenerate  {}", count(Quality::Degenerate))?;
    if let Some(last) = found.iter().rev().find(|l| l.quality != Quality::Lost) {
        let Pose2 { x, y, heading } = last.pose;
        writeln!(
            out,
            "last        ({x:.3}, {y:.3}) m, {:.2} deg",
            heading.to_degrees()
        )?;
    }
    if 2 * n_lost > found.len() {
        note(&format!(
            "{}: {n_lost} of {} scans are lost in {}; at most half may be; hint: the log may belong \
             to another map, or --start is wrong",
            args.log.display(),
            found.len(),
            args.map.display()
        ));
        return Ok(Ending::NoPath);
    }
    Ok(Ending::Done)
}

/// The pose at every scan of a log.
pub(crate) fn located(
    map: &MapToSearch,
    log: &Log,
    start: Option<Pose2>,
    interrupt: &Interrupt,
) -> Result<Vec<Located>> {
    let mut localizer =
        Localizer::new(map.to_localize(), &map.config, start).map_err(|error| anyhow!(error))?;
    localizer.set_ranges(map.config.ranges.resolved(log.scans.iter()));
    let bar = ScanBar::new(interrupt);
    let mut found = Vec::with_capacity(log.scans.len());
    for (i, scan) in log.scans.iter().enumerate() {
        found.push(localizer.add(scan, log.motion(i)));
        if bar.show(Progress::Scans(i + 1, log.scans.len())) == Go::Stop {
            break;
        }
    }
    Ok(found)
}

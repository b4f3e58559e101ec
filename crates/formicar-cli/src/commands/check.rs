//! `check`: the judge on a path of any origin.
#![allow(clippy::doc_markdown, reason = "clap prints these words as they stand")]

use crate::failure::{Ending, Failure};
use crate::motion_files;
use crate::output::print_json;
use crate::path_file::{self, PathFile, Source};
use crate::scene::{self, Scene, SceneArgs};
use crate::summary::{clearance, curvature, write_distance};
use anyhow::{Context, Result, bail};
use clap::{Args, ValueHint};
use formicar::collision::ObstacleMap;
use formicar::numeric::counted;
use formicar::path::{CurvePath, Direction};
use formicar::planner::{CertificateNumbers, DriveQuestion, are_samples_of};
use formicar::validation::{Report, TimedReport, Violation, judge_in_time, path_hash_with_signs};
use formicar::vehicle::Vehicle;
use serde::Serialize;
use std::io::{self, Write};
use std::path::PathBuf;

/// Flags of `check`.
#[derive(Args, Debug)]
pub(crate) struct CheckArgs {
    /// The path: an answer of `plan` (.json), a CSV of x, y[, heading] in meters and radians or
    /// with named columns, or a nav_msgs/Path as JSON or YAML; `-` reads it from stdin.
    #[arg(value_name = "PATH", value_hint = ValueHint::FilePath)]
    path: PathBuf,

    #[command(flatten)]
    scene: SceneArgs,

    /// Judge the drive of an answer against these moving obstacles instead of the recorded ones
    /// (JSON, see `schema moving`).
    #[arg(long, value_name = "F.json", value_hint = ValueHint::FilePath)]
    moving: Option<PathBuf>,

    /// Print the report as one JSON object.
    #[arg(long)]
    json: bool,

    /// Print every violation instead of the first and the worst of each kind.
    #[arg(long)]
    all: bool,
}

/// The document that `check --json` prints.
#[derive(Debug, Serialize)]
struct Checked {
    schema: &'static str,
    valid: bool,
    /// The kind of the path file.
    source: Source,
    /// What of the file was read, in words.
    reading: String,
    #[serde(skip)]
    hint: Option<&'static str>,
    /// Share by which the curvature may exceed the vehicle's limit.
    curvature_slack: f64,
    /// Largest distance between the judged path and the samples, which are rounded.
    sample_deviation_m: f64,
    /// The gear in which the path begins: 1 forward, -1 in reverse.
    first_gear: Direction,
    length_m: f64,
    n_segments: usize,
    certificate: Report,
    /// Whether the sampled poses of an answer lie on its segments; null for other paths.
    poses_on_segments: Option<bool>,
    /// The findings on the drive out of contact before the path, to which the cells touched where
    /// it begins do not count; null where there is none.
    escape: Option<Report>,
    /// The findings on the drive in time; null where the file has none.
    in_time: Option<TimedReport>,
    /// Whether the recorded certificate is for this map, vehicle and path.
    matches_record: Option<Matches>,
}

#[allow(clippy::struct_excessive_bools, reason = "one flag per recorded hash")]
#[derive(Clone, Copy, Debug, Serialize)]
struct Matches {
    map: bool,
    vehicle: bool,
    path: bool,
    /// Whether the recorded numbers are those that the judge finds.
    numbers: bool,
}

/// Carries out `check`.
pub(crate) fn run(args: &CheckArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let scene = scene::load(&args.scene)?;
    let vehicle = &scene.vehicle.vehicle;
    let file = path_file::read(&args.path, vehicle)?;
    let checked = check(&file, &scene, in_time(args, &file, vehicle)?);
    if args.json {
        print_json(out, &checked)?;
    } else {
        explain(&checked, vehicle, args, out)?;
    }
    Ok(if checked.valid {
        Ending::Done
    } else {
        Ending::NoPath
    })
}

/// The judge's findings on the drive of an answer.
fn in_time(args: &CheckArgs, file: &PathFile, vehicle: &Vehicle) -> Result<Option<TimedReport>> {
    let drive = file.motion.as_ref().zip(file.recorded_path());
    let drive = drive.and_then(|(motion, path)| Some((motion, motion.timed(path)?)));
    let Some((motion, timed)) = drive else {
        return match &args.moving {
            None => Ok(None),
            Some(_) => bail!(
                "--moving: {} holds no drive in time; hint: plan one with --moving or --speed",
                args.path.display()
            ),
        };
    };
    let predictions = match &args.moving {
        Some(path) => motion_files::moving(path, None)?,
        None => motion.moving.predictions()?,
    };
    motion.config.check().context("the recorded drive")?;
    let zones = motion.speed_zones.as_deref();
    let zones = zones.map(motion_files::speed_zones).transpose()?;
    let question = DriveQuestion {
        predictions: &predictions,
        zones: zones.as_ref(),
        config: &motion.config,
    };
    Ok(Some(judge_in_time(&question.rules(vehicle), &timed)))
}

fn check(file: &PathFile, scene: &Scene, in_time: Option<TimedReport>) -> Checked {
    let vehicle = &scene.vehicle.vehicle;
    let obstacles = ObstacleMap::new(&scene.map);
    let (path, report) = file.judged(&obstacles, vehicle);
    let escape = file.escape.as_ref();
    let escape = escape.map(|escape| escape.report(&obstacles, vehicle));
    let report = report.assuming(&scene.record.assumptions());
    let matches_record = file.hashes.as_ref().map(|record| Matches {
        map: record.map_hash == report.map_hash,
        vehicle: record.vehicle_hash == report.vehicle_hash,
        path: record.path_hash == report.path_hash
            || record.path_hash == path_hash_with_signs(path),
        numbers: file.numbers.is_some_and(|n| are_numbers_of(n, &report)),
    });
    let poses_on_segments = file.poses.as_ref().map(|poses| are_samples_of(poses, path));
    Checked {
        schema: "formicar/check/1",
        valid: report.valid
            && poses_on_segments != Some(false)
            && escape.as_ref().is_none_or(|escape| escape.valid)
            && in_time.as_ref().is_none_or(|in_time| in_time.valid),
        source: file.source,
        reading: file.reading.clone(),
        hint: file.hint,
        curvature_slack: file.curvature_slack(),
        sample_deviation_m: file.sample_deviation_m,
        first_gear: first_gear(path),
        length_m: path.length_m(),
        n_segments: path.segments().len(),
        certificate: report,
        poses_on_segments,
        escape,
        in_time,
        matches_record,
    }
}

/// Tolerance between recorded numbers and those found now, in their units: machines round
/// differently.
const RECORD_TOLERANCE: f64 = 1e-6;

fn are_numbers_of(record: CertificateNumbers, report: &Report) -> bool {
    let pairs = [
        (record.min_clearance_m, report.min_clearance_m),
        (record.max_curvature_per_m, report.max_curvature_per_m),
        (record.goal_error_m, report.goal_error_m),
        (record.goal_error_rad, report.goal_error_rad),
    ];
    let is_near = |(was, is): &(f64, f64)| (was - is).abs() <= RECORD_TOLERANCE;
    record.valid == report.valid && pairs.iter().all(is_near)
}

fn first_gear(path: &CurvePath) -> Direction {
    path.segments()
        .first()
        .map_or_else(Direction::default, |s| s.direction)
}

fn explain(
    checked: &Checked,
    vehicle: &Vehicle,
    args: &CheckArgs,
    out: &mut impl Write,
) -> io::Result<()> {
    let report = &checked.certificate;
    writeln!(
        out,
        "{:<9}  {:.2} m  clearance {} at {:.2} m{}",
        if checked.valid { "valid" } else { "invalid" },
        checked.length_m,
        clearance(report.min_clearance_m),
        report.tightest_s_m,
        curvature(report.max_curvature_per_m, vehicle),
    )?;
    writeln!(out, "read       {}", reading(checked))?;
    if let Some(matches) = checked.matches_record {
        writeln!(out, "record     {}", matches.words())?;
    }
    if let Some(escape) = &checked.escape {
        match escape.violations.first() {
            None => writeln!(
                out,
                "escape     touches nothing but the cells in which it begins"
            )?,
            Some(first) => writeln!(
                out,
                "violation  on the way out of contact: {}",
                first.message
            )?,
        }
    }
    if checked.poses_on_segments == Some(false) {
        writeln!(
            out,
            "violation  the poses on record are not those of the segments; hint: plan again"
        )?;
    }
    if let Some(in_time) = &checked.in_time {
        explain_drive(in_time, out)?;
    }
    if args.all {
        for violation in &report.violations {
            writeln!(out, "violation  {}", violation.message)?;
        }
    } else {
        summarize(&report.violations, out)?;
    }
    if !checked.valid
        && let Some(hint) = checked.hint.or_else(|| coarse_hint(checked))
    {
        writeln!(out, "hint       {hint}")?;
    }
    Ok(())
}

/// The findings on a drive in time.
fn explain_drive(report: &TimedReport, out: &mut impl Write) -> io::Result<()> {
    writeln!(
        out,
        "in time    {} of {:.1} s at up to {:.2} m/s: {}",
        if report.arrives {
            "a drive"
        } else {
            "a drive that waits"
        },
        report.duration_s,
        report.max_speed_mps,
        if report.valid {
            "certified"
        } else {
            "not valid"
        },
    )?;
    write_distance(report, out)?;
    for violation in &report.violations {
        writeln!(out, "violation  {}", violation.message)?;
    }
    Ok(())
}

/// What was read, and how the curve between samples was made.
fn reading(checked: &Checked) -> String {
    let n_segments = counted(checked.n_segments, "segment");
    let what = match checked.source {
        Source::Segments => return format!("{n_segments}, as written"),
        Source::Poses => "arcs and gears reconstructed".to_owned(),
        Source::Points => {
            let gear = match checked.first_gear {
                Direction::Forward => "forward",
                Direction::Reverse => "in reverse",
            };
            format!("headings and arcs reconstructed, first {gear}")
        }
    };
    let reading = &checked.reading;
    let slack_percent = checked.curvature_slack * 100.0;
    let off_mm = checked.sample_deviation_m * 1e3;
    format!(
        "{reading}; {n_segments}, {what}, within {off_mm:.1} mm; the curvature limit has {slack_percent:.0} % of slack"
    )
}

/// Most violations of a kind that are printed without `--all`.
const MAX_OF_A_KIND: usize = 3;

/// The violations by kind, in the order of the first of each: all where they are few, otherwise
/// the first, the worst and their number.
fn summarize(violations: &[Violation], out: &mut impl Write) -> io::Result<()> {
    let mut kinds = Vec::new();
    for violation in violations {
        if !kinds.contains(&violation.kind) {
            kinds.push(violation.kind);
        }
    }
    let mut is_cut = false;
    for kind in kinds {
        let of_kind = violations.iter().filter(|violation| violation.kind == kind);
        let of_kind: Vec<_> = of_kind.collect();
        if of_kind.len() <= MAX_OF_A_KIND {
            for violation in of_kind {
                writeln!(out, "violation  {}", violation.message)?;
            }
            continue;
        }
        is_cut = true;
        let by_excess = |a: &&&Violation, b: &&&Violation| a.excess().total_cmp(&b.excess());
        let (n, name) = (of_kind.len(), kind.in_words());
        writeln!(
            out,
            "violation  {name}, {n} times; first: {}",
            of_kind[0].message
        )?;
        if let Some(worst) = of_kind.iter().max_by(by_excess) {
            writeln!(out, "           worst: {}", worst.message)?;
        }
    }
    if is_cut {
        writeln!(out, "           --all prints all {}", violations.len())?;
    }
    Ok(())
}

/// Advice on points that do not determine a curvature.
fn coarse_hint(checked: &Checked) -> Option<&'static str> {
    let is_coarse = checked.source == Source::Points && checked.sample_deviation_m > COARSE_M;
    is_coarse.then_some(
        "points this coarse do not determine the curvature; write headings or more decimals",
    )
}

/// Deviation above which bare points zigzag too much to determine the curvature, meters.
const COARSE_M: f64 = 1e-4;

impl Matches {
    fn words(self) -> String {
        let parts = [
            ("map", self.map),
            ("vehicle", self.vehicle),
            ("path", self.path),
        ];
        let other: Vec<_> = parts
            .iter()
            .filter(|(_, same)| !same)
            .map(|p| p.0)
            .collect();
        if other.is_empty() && !self.numbers {
            "the certificate's numbers are not those of this map, vehicle and path".to_owned()
        } else if other.is_empty() {
            "the certificate is for this map, vehicle and path".to_owned()
        } else {
            format!("the certificate is for another {}", other.join(" and "))
        }
    }
}

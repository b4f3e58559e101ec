//! `check`: the judge on any path, ours or foreign.

use super::subject::{self, Source, Subject};
use crate::args::CheckArgs;
use crate::failure::{Ending, Failure};
use crate::ground;
use crate::summary::{clearance, curvature};
use formicar::collision::ObstacleMap;
use formicar::geometry::wrap_angle;
use formicar::numeric::counted;
use formicar::path::{CurvePath, Direction, PathPose};
use formicar::planner::{CertificateNumbers, POSE_SPACING_M, PoseRecord};
use formicar::validation::Report;
use formicar::vehicle::Vehicle;
use serde::Serialize;
use std::io::{self, Write};

/// What `check --json` prints.
#[derive(Debug, Serialize)]
struct Checked {
    schema: &'static str,
    valid: bool,
    /// How the path was read.
    source: Source,
    /// Share by which the curvature may exceed the vehicle's limit.
    curvature_slack: f64,
    /// How far the path that was judged may pass by the samples: they are rounded.
    sample_deviation_m: f64,
    /// The gear in which the path begins: 1 forward, -1 in reverse.
    first_gear: Direction,
    length_m: f64,
    n_segments: usize,
    certificate: Report,
    /// Whether the sampled poses of an answer lie on its segments; null of other paths.
    poses_on_segments: Option<bool>,
    /// Whether the certificate on record was for this map, vehicle and path.
    matches_record: Option<Matches>,
}

#[allow(
    clippy::struct_excessive_bools,
    reason = "one word per thing on record"
)]
#[derive(Clone, Copy, Debug, Serialize)]
struct Matches {
    map: bool,
    vehicle: bool,
    path: bool,
    /// Whether the certificate's numbers are those the judge finds.
    numbers: bool,
}

/// Carries out `check`.
pub(crate) fn run(args: &CheckArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let ground = ground::load(&args.ground)?;
    let vehicle = &ground.vehicle.vehicle;
    let subject = subject::read(&args.path, vehicle)?;
    let checked = check(&subject, &ObstacleMap::new(&ground.map), vehicle);
    if args.json {
        serde_json::to_writer(&mut *out, &checked).map_err(io::Error::from)?;
        writeln!(out)?;
    } else {
        explain(&checked, vehicle, out)?;
    }
    Ok(if checked.valid {
        Ending::Done
    } else {
        Ending::NoPath
    })
}

fn check(subject: &Subject, obstacles: &ObstacleMap, vehicle: &Vehicle) -> Checked {
    let (path, report) = subject.judged(obstacles, vehicle);
    let matches_record = subject.hashes.as_ref().map(|record| Matches {
        map: record.map_hash == report.map_hash,
        vehicle: record.vehicle_hash == report.vehicle_hash,
        path: record.path_hash == report.path_hash,
        numbers: subject.numbers.is_some_and(|n| are_numbers_of(n, &report)),
    });
    // Only a valid path is short enough to be sampled.
    let poses_on_segments = match &subject.poses {
        Some(poses) if report.valid => Some(are_on(poses, path)),
        _ => None,
    };
    Checked {
        schema: "formicar/check/1",
        valid: report.valid && poses_on_segments != Some(false),
        source: subject.source,
        curvature_slack: subject.curvature_slack(),
        sample_deviation_m: subject.sample_deviation_m,
        first_gear: first_gear(path),
        length_m: path.length_m(),
        n_segments: path.segments().len(),
        certificate: report,
        poses_on_segments,
        matches_record,
    }
}

/// How far numbers on record may be from those found now, in their units: machines round
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

/// Whether poses are the samples of a path.
fn are_on(poses: &[PoseRecord], path: &CurvePath) -> bool {
    let samples = path.sample(POSE_SPACING_M);
    let is_at = |(pose, sample): (&PoseRecord, &PathPose)| {
        let at = sample.pose;
        (pose.x - at.x).hypot(pose.y - at.y) <= RECORD_TOLERANCE
            && wrap_angle(pose.heading - at.heading).abs() <= RECORD_TOLERANCE
            && pose.direction == sample.direction
    };
    poses.len() == samples.len() && poses.iter().zip(&samples).all(is_at)
}

fn first_gear(path: &CurvePath) -> Direction {
    path.segments()
        .first()
        .map_or_else(Direction::default, |s| s.direction)
}

fn explain(checked: &Checked, vehicle: &Vehicle, out: &mut impl Write) -> io::Result<()> {
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
    let read_as = match checked.source {
        Source::Segments => "as written".to_owned(),
        Source::Poses => reconstructed("arcs and gears from poses", checked),
        Source::Points => {
            let gear = match checked.first_gear {
                Direction::Forward => "forward",
                Direction::Reverse => "in reverse",
            };
            let what = format!("headings and arcs from points, first {gear}");
            reconstructed(&what, checked)
        }
    };
    writeln!(
        out,
        "read       {}, {read_as}",
        counted(checked.n_segments, "segment")
    )?;
    if let Some(matches) = checked.matches_record {
        writeln!(out, "record     {}", matches.words())?;
    }
    if checked.poses_on_segments == Some(false) {
        writeln!(
            out,
            "violation  the poses on record are not those of the segments; hint: plan again"
        )?;
    }
    for violation in &report.violations {
        writeln!(out, "violation  {}", violation.message)?;
    }
    let is_coarse = checked.source == Source::Points && checked.sample_deviation_m > COARSE_M;
    if !checked.valid && is_coarse {
        writeln!(
            out,
            "hint       points this coarse hardly tell the curvature; write headings or more decimals"
        )?;
    }
    Ok(())
}

/// Deviation above which bare points zigzag too much to tell the curvature, metres.
const COARSE_M: f64 = 1e-4;

fn reconstructed(what: &str, checked: &Checked) -> String {
    let slack_percent = checked.curvature_slack * 100.0;
    let off_mm = checked.sample_deviation_m * 1e3;
    format!("{what}, within {off_mm:.1} mm; the curvature limit has {slack_percent:.0} % of slack")
}

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

//! `check`: the judge on any path, ours or foreign.

use crate::args::CheckArgs;
use crate::failure::{Ending, Failure};
use crate::summary::counted;
use crate::{files, ground};
use anyhow::{Context, Result, anyhow};
use formicar::collision::ObstacleMap;
use formicar::path::CurvePath;
use formicar::planner::{CertificateHashes, StoredPath};
use formicar::scenario::Request;
use formicar::validation::{
    CURVATURE_TOLERANCE, FOREIGN_CURVATURE_SLACK, Report, Samples, judge, judge_path,
};
use formicar::vehicle::{Motion, Vehicle};
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;

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
    length_m: f64,
    n_segments: usize,
    certificate: Report,
    /// Whether the certificate on record was for this map, vehicle and path.
    matches_record: Option<Matches>,
}

/// Where a path comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
enum Source {
    /// The segments of an answer.
    Segments,
    /// Poses with headings: arcs and gears reconstructed.
    Poses,
    /// Points without headings: headings, arcs and gears reconstructed.
    Points,
}

#[derive(Clone, Copy, Debug, Serialize)]
struct Matches {
    map: bool,
    vehicle: bool,
    path: bool,
}

/// A path to be judged.
struct Subject {
    path: CurvePath,
    source: Source,
    sample_deviation_m: f64,
    request: Option<Request>,
    hashes: Option<CertificateHashes>,
}

/// Carries out `check`.
pub(crate) fn run(args: &CheckArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let ground = ground::load(&args.ground)?;
    let vehicle = &ground.vehicle.vehicle;
    let subject = read(&args.path, vehicle)?;
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

fn read(path: &Path, vehicle: &Vehicle) -> Result<Subject> {
    let text = files::read_text(path)?;
    let name = || path.display().to_string();
    if text.trim_start().starts_with('{') {
        let stored = StoredPath::from_json(&text).with_context(name)?;
        return Ok(Subject {
            path: stored.path,
            source: Source::Segments,
            sample_deviation_m: 0.0,
            request: stored.request,
            hashes: stored.hashes,
        });
    }
    let samples = Samples::from_csv(&text).with_context(name)?;
    let path = match vehicle.motion() {
        Motion::Point => Some(CurvePath::from_polyline(&samples.points)),
        Motion::Car => samples.path(),
    };
    Ok(Subject {
        path: path.ok_or_else(|| anyhow!("no poses")).with_context(name)?,
        source: match samples.headings {
            Some(_) => Source::Poses,
            None => Source::Points,
        },
        sample_deviation_m: samples.deviation_m(),
        request: None,
        hashes: None,
    })
}

fn check(subject: &Subject, obstacles: &ObstacleMap, vehicle: &Vehicle) -> Checked {
    let curvature_slack = match subject.source {
        Source::Segments => CURVATURE_TOLERANCE,
        Source::Poses | Source::Points => FOREIGN_CURVATURE_SLACK,
    };
    let report = match &subject.request {
        Some(request) => judge(obstacles, vehicle, request, &subject.path),
        None => judge_path(obstacles, vehicle, &subject.path, curvature_slack),
    };
    let matches_record = subject.hashes.as_ref().map(|record| Matches {
        map: record.map_hash == report.map_hash,
        vehicle: record.vehicle_hash == report.vehicle_hash,
        path: record.path_hash == report.path_hash,
    });
    Checked {
        schema: "formicar/check/1",
        valid: report.valid,
        source: subject.source,
        curvature_slack,
        sample_deviation_m: subject.sample_deviation_m,
        length_m: subject.path.length_m(),
        n_segments: subject.path.segments().len(),
        certificate: report,
        matches_record,
    }
}

fn explain(checked: &Checked, vehicle: &Vehicle, out: &mut impl Write) -> io::Result<()> {
    let report = &checked.certificate;
    writeln!(
        out,
        "{:<9}  {:.2} m  clearance {:.2} m at {:.2} m  curvature {:.2} of {:.2} 1/m",
        if checked.valid { "valid" } else { "invalid" },
        checked.length_m,
        report.min_clearance_m,
        report.tightest_s_m,
        report.max_curvature_per_m,
        vehicle.max_curvature_per_m(),
    )?;
    let read_as = match checked.source {
        Source::Segments => "as written".to_owned(),
        Source::Poses => reconstructed("arcs and gears from poses", checked),
        Source::Points => reconstructed("headings, arcs and gears from points", checked),
    };
    writeln!(
        out,
        "read       {}, {read_as}",
        counted(checked.n_segments, "segment")
    )?;
    if let Some(matches) = checked.matches_record {
        writeln!(out, "record     {}", matches.words())?;
    }
    for violation in &report.violations {
        writeln!(out, "violation  {}", violation.message)?;
    }
    Ok(())
}

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
        if other.is_empty() {
            "the certificate is for this map, vehicle and path".to_owned()
        } else {
            format!("the certificate is for another {}", other.join(" and "))
        }
    }
}

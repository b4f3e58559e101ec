//! `map evaluate`: a map judged by a lidar log.
#![allow(clippy::doc_markdown, reason = "clap prints these words as they stand")]

use crate::commands::locate;
use crate::failure::{Ending, Failure};
use crate::files;
use crate::lidar::{Interrupt, LogArgs, MapToSearch, read_log};
use crate::output::print_json;
use anyhow::{Context, Result};
use clap::{Args, ValueHint};
use formicar::Pose2;
use formicar_mapping::evaluate::{
    HeldOut, JudgedMap, RelationErrors, TrajectoryError, held_out, loop_pairs, neighbor_pairs,
    relation_errors, relation_file_errors, trajectory_error,
};
use formicar_mapping::front_end::Quality;
use formicar_mapping::log::parse_relations;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;

/// Flags of `map evaluate`.
#[derive(Args, Debug)]
#[command(after_help = "\
The log's scans are found in the map first. Then their beams are compared with its cells, and their \
poses with the reference poses of the log (those of GMapping in corrected logs) or with a file of \
relations (time1 time2 x y z roll pitch yaw). Held-out figures are honest only where the map was \
built without these scans: with the same --hold-out.")]
pub(crate) struct EvaluateArgs {
    /// Map file, or the session of `map build`.
    #[arg(value_name = "MAP", value_hint = ValueHint::FilePath)]
    map: PathBuf,

    /// The lidar log: a bag of ROS 2 (.mcap, or its folder), or CARMEN, plain or .gz.
    #[arg(value_name = "LOG", value_hint = ValueHint::FilePath)]
    log: PathBuf,

    /// Judge the beams of every N-th scan, those that `map build --hold-out N` leaves out; of all
    /// scans by default.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..))]
    hold_out: Option<u32>,

    /// True motions between times of the log.
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    relations: Option<PathBuf>,

    /// Pose of the laser at the first scan; it is searched otherwise.
    #[arg(long, value_name = "X,Y,H", value_parser = crate::values::pose, allow_hyphen_values = true)]
    start: Option<Pose2>,

    #[command(flatten)]
    how: LogArgs,

    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Times of relations are matched with those of scans to this, seconds.
const TIME_TOLERANCE_S: f64 = 0.05;

#[derive(Serialize)]
struct Evaluation {
    schema: &'static str,
    n_scans: usize,
    n_lost: usize,
    beams: HeldOut,
    relations: Vec<(String, RelationErrors)>,
    n_relations_without_scan: usize,
    trajectory_error: Option<TrajectoryError>,
}

/// Carries out `map evaluate`.
pub(super) fn run(args: &EvaluateArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let evaluation = evaluate(args)?;
    if args.json {
        print_json(out, &evaluation)?;
        return Ok(Ending::Done);
    }
    let beams = &evaluation.beams;
    writeln!(
        out,
        "scans       {}, {} lost",
        evaluation.n_scans, evaluation.n_lost
    )?;
    writeln!(
        out,
        "beams       {} of {} scans: leaks {:.2} %, early {:.2} %, ends in free ground {:.2} %",
        beams.n_beams,
        beams.n_scans,
        100.0 * beams.leaks(),
        100.0 * beams.early(),
        100.0 * beams.free_ends()
    )?;
    for (name, e) in &evaluation.relations {
        writeln!(
            out,
            "{name:11} {:.4} +- {:.4} m, {:.3} +- {:.3} deg, at most {:.2} m ({})",
            e.mean_m, e.std_m, e.mean_deg, e.std_deg, e.max_m, e.n
        )?;
    }
    if evaluation.n_relations_without_scan > 0 {
        let n = evaluation.n_relations_without_scan;
        writeln!(out, "left out    {n} relations whose times no scan has")?;
    }
    if let Some(e) = &evaluation.trajectory_error {
        writeln!(
            out,
            "trajectory  {:.3} m rms, at most {:.2} m",
            e.rmse_m, e.max_m
        )?;
    }
    Ok(Ending::Done)
}

fn evaluate(args: &EvaluateArgs) -> Result<Evaluation> {
    let relations = args.relations.as_deref().map(|path| {
        let text = files::read_text(path)?;
        parse_relations(&text).with_context(|| path.display().to_string())
    });
    let relations = relations.transpose()?;
    let log = read_log(&args.log, &args.how)?;
    let map = MapToSearch::read(&args.map)?;
    let found = locate::located(&map, &log, args.start, &Interrupt::watch())?;
    let poses: Vec<Pose2> = found.iter().map(|located| located.pose).collect();
    let is_judged = |i: usize| {
        args.hold_out
            .is_none_or(|n| i % n as usize == n as usize - 1)
    };
    let is_found = |i: usize| !matches!(found[i].quality, Quality::Lost | Quality::Degenerate);
    let scans: Vec<(usize, Pose2)> = (0..found.len())
        .filter(|&i| is_judged(i) && is_found(i))
        .map(|i| (i, poses[i]))
        .collect();
    let policy = map.config.ranges.resolved(log.scans.iter());
    let judged = JudgedMap {
        grid: &map.grid,
        field: &map.field,
        policy: &policy,
        config: &map.config,
    };
    let mut evaluation = Evaluation {
        schema: "formicar/map-evaluation/1",
        n_scans: found.len(),
        n_lost: found.iter().filter(|l| l.quality == Quality::Lost).count(),
        beams: held_out(&judged, &log, &scans, |_, _| true),
        relations: Vec::new(),
        n_relations_without_scan: 0,
        trajectory_error: None,
    };
    if let Some(relations) = relations {
        let (errors, n_missing) =
            relation_file_errors(&poses, &log.scans, &relations, TIME_TOLERANCE_S);
        evaluation.relations.push(("relations".to_owned(), errors));
        evaluation.n_relations_without_scan = n_missing;
    }
    if let Some(reference) = &log.reference {
        let mut errors = |name: &str, pairs: &[(usize, usize)]| {
            let found = relation_errors(&poses, reference, pairs);
            evaluation.relations.push((name.to_owned(), found));
        };
        errors("neighbors", &neighbor_pairs(poses.len()));
        errors("loops", &loop_pairs(&reference[..poses.len()], 2.0, 20));
        evaluation.trajectory_error = Some(trajectory_error(&poses, reference));
    }
    Ok(evaluation)
}

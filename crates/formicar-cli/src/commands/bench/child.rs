//! The process of one run: plans, measures itself, and prints its row.

use super::{measure, place, rival};
use crate::failure::{Ending, Failure};
use crate::session::{Answered, Session};
use crate::{scene, settings};
use anyhow::{Context, Result};
use formicar::map::format::write_atomically;
use formicar::metrics::CompatibleMetrics;
use formicar::numeric::Seed;
use formicar::path::{CurvePath, GridPath};
use formicar::planner::{Outcome, PathDocument, Plan, RequestDocument};
use formicar_lab::campaign::{History, Improvement, Job, KNOWN_BY, Place, Row, Told};
use formicar_lab::run::usage;
use serde_json::{Map, Value, json};
use std::f64::consts::SQRT_2;
use std::io::Write;
use std::time::Instant;

/// Carries out one run; its row, history and path go to stdout as a JSON object.
pub(crate) fn run_one(job: &str, out: &mut impl Write) -> Result<Ending, Failure> {
    let begun = Instant::now();
    usage::end_with_parent();
    let job: Job = serde_json::from_str(job).context("the run")?;
    let told = match &job.contender.rival {
        Some(command) => rival::run_one(&job, command)?,
        None => ours(&job, begun)?,
    };
    serde_json::to_writer(&mut *out, &told).map_err(std::io::Error::from)?;
    writeln!(out)?;
    Ok(Ending::Done)
}

/// A run of a planner of ours.
fn ours(job: &Job, begun: Instant) -> Result<Told> {
    let contender = &job.contender;
    let table = contender.config.clone();
    let table = settings::merge(table, &contender.name, &[], Some(contender.planner))?;
    let config = settings::typed(&table)?;
    let ground = scene::load(&place::ground_args(&job.task, job.vehicle_source()))?;
    let request = place::request(job, &ground)?;
    let mut session = Session::new(ground, config, begun)?;
    let (answered, used, is_same) = ask(&mut session, &request, job);
    if let Some(path) = &job.answer {
        let mut answer = serde_json::to_vec(&answered.answer).map_err(std::io::Error::from)?;
        answer.push(b'\n');
        write_atomically(path, &answer)
            .with_context(|| format!("{} cannot be written", path.display()))?;
    }
    let mut row = Row::begin(job);
    row.fill(&used);
    fill(&mut row, &answered);
    let planner = &session.planner;
    let asked = request.onto(&RequestDocument::default()).ok();
    if let Some(asked) = &asked {
        let place = (&**planner.obstacles(), planner.vehicle());
        measure::ground(&mut row, place, [asked.start, asked.goal]);
    }
    if let Ok(Outcome::Found(plan)) = &answered.result {
        if let Some(asked) = &asked {
            measure::path(&mut row, planner, asked, plan);
        }
        let compatible = CompatibleMetrics::new(&plan.path, planner.vehicle(), planner.obstacles());
        row.fill(&to_value(&compatible));
    }
    if !is_same && request.deadline_ms.is_none() {
        row.set("valid", &json!(false));
        row.set(
            "reason",
            &json!("asked again, the warm planner answers otherwise"),
        );
    }
    if let Place::Cells {
        optimal_length_cells,
        ..
    } = job.task.place
    {
        row.set("optimal_length_cells", &json!(optimal_length_cells));
    }
    Ok(Told {
        row: row.values(),
        history: history(&answered),
        path: path(&answered),
    })
}

/// Asks as often as the run says: the answer that counts, what was used for it, and whether all
/// answers have the same path.
fn ask(session: &mut Session, request: &RequestDocument, job: &Job) -> (Answered, Value, bool) {
    let mut ask = || session.ask(request, &RequestDocument::default(), Seed(job.seed));
    let (used_before_s, cold) = (usage::cpu_s(), ask());
    let (used_cold_s, warm) = (usage::cpu_s(), (!job.limits.is_cold).then(ask));
    // Before anything else uses up more. What the first asking took is not counted twice.
    let warmed_up_s = warm.is_some().then(|| Some(used_cold_s? - used_before_s?));
    let cpu_s = usage::cpu_s().map(|all_s| all_s - warmed_up_s.flatten().unwrap_or(0.0));
    let used = json!({
        "cpu_s": cpu_s,
        "peak_rss_bytes": usage::peak_rss_bytes(),
        "cold_first_s": cold.answer.timing.first_feasible_s,
    });
    let is_same = warm
        .as_ref()
        .is_none_or(|warm| path_of(warm) == path_of(&cold));
    (warm.unwrap_or(cold), used, is_same)
}

/// How the query went.
fn history(answered: &Answered) -> History {
    let improvements = answered.paths.iter().map(|told| Improvement {
        at_s: told.at.as_secs_f64(),
        steps: told.n_steps,
        length_m: told.length_m,
    });
    let colony = answered.answer.colony.as_ref();
    History::new(
        improvements.collect(),
        colony.map_or(&[], |colony| &colony.iterations),
    )
}

/// The path found: its segments say all of it, unless it stands still at a pose.
fn path(answered: &Answered) -> Option<PathDocument> {
    let path = answered.answer.path.as_ref()?;
    let n_poses = usize::from(path.segments.is_empty());
    Some(PathDocument {
        poses: path.poses.iter().take(n_poses).cloned().collect(),
        segments: path.segments.clone(),
    })
}

/// The path of an answer, if there is one.
fn path_of(answered: &Answered) -> Option<&CurvePath> {
    match &answered.result {
        Ok(Outcome::Found(plan)) => Some(&plan.path),
        _ => None,
    }
}

/// What the answer says.
fn fill(row: &mut Row, answered: &Answered) {
    let answer = &answered.answer;
    row.set("status", &json!(answer.status));
    row.set("reason", &json!(answer.reason));
    row.set(
        "valid",
        &json!(answer.certificate.as_ref().map(|c| c.valid)),
    );
    row.fill(&to_value(&answer.timing));
    row.set(
        "steps",
        &match &answered.result {
            Ok(Outcome::Found(plan)) => json!(plan.n_steps),
            Ok(Outcome::NotFound(failure)) => json!(failure.n_steps),
            Err(_) => Value::Null,
        },
    );
    if let Ok(Outcome::Found(plan)) = &answered.result {
        fill_found(row, plan, answered);
    }
}

fn fill_found(row: &mut Row, plan: &Plan, answered: &Answered) {
    row.fill(&to_value(&plan.metrics));
    if let Some(grid_path) = &plan.stages.grid_path {
        row.set("length_cells", &json!(length_cells(grid_path)));
    }
    if let Some(first) = answered.paths.first() {
        row.set("first_length_m", &json!(first.length_m));
        row.set("first_steps", &json!(first.n_steps));
    }
    for (limit_s, columns) in KNOWN_BY {
        let mut by_then = answered.paths.iter().rev();
        let known = by_then.find(|told| told.at.as_secs_f64() <= limit_s);
        let Some(known) = known else {
            continue;
        };
        let [length, clearance, cusps] = columns;
        row.set(length, &json!(known.length_m));
        // Of a path that was replaced nothing but its length is known.
        if known.length_m == plan.metrics.length_m {
            row.set(clearance, &json!(plan.metrics.min_clearance_m));
            row.set(cusps, &json!(plan.metrics.n_cusps));
        }
    }
}

/// Length between cell centers: straight steps count 1, diagonal ones the square root of 2.
fn length_cells(path: &GridPath) -> f64 {
    let is_diagonal = |w: &[formicar::map::Cell]| w[0].col != w[1].col && w[0].row != w[1].row;
    let n_steps = path.cells.len().saturating_sub(1);
    let n_diagonal = path.cells.windows(2).filter(|w| is_diagonal(w)).count();
    (n_steps - n_diagonal) as f64 + SQRT_2 * n_diagonal as f64
}

/// Numbers as JSON; nothing where they are not finite.
fn to_value(numbers: &impl serde::Serialize) -> Value {
    serde_json::to_value(numbers).unwrap_or_else(|_| Value::Object(Map::new()))
}

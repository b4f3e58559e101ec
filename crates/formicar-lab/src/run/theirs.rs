//! A run of a program of others: the program plans, our judge decides.

use super::evaluate::Evaluation;
use super::job::{Job, Place, RivalCommand};
use super::measure::Improvement;
use super::record::{History, Run, RunRecord, finite};
use super::scenario::Sources;
use super::status::RunStatus;
use crate::rival::{Ended, Question, RivalAnswer, run as run_program};
use anyhow::{Context, Result};
use formicar::collision::ObstacleMap;
use formicar::numeric::Seed;
use formicar::path::CurvePath;
use formicar::planner::{PathDocument, RequestDocument};
use std::path::Path;
use std::process::Command;
use std::time::Duration;

/// Time for a run without a deadline.
const WITHIN: Duration = Duration::from_mins(10);
/// Time beyond a deadline for starting, reading the map and printing the path.
const GRACE: Duration = Duration::from_secs(30);

/// The word for the program that runs the campaign.
const OURSELVES: &str = "formicar";

/// Carries out a run of a program.
pub(super) fn run(job: &Job, command: &RivalCommand, sources: &dyn Sources) -> Result<Run> {
    let scenario = sources.load(&job.task, job.vehicle_source())?;
    let obstacles = ObstacleMap::new(&scenario.map);
    let evaluation = Evaluation {
        obstacles: &obstacles,
        vehicle: &scenario.vehicle,
    };
    let request = scenario.request(job)?.onto(&RequestDocument::default())?;
    let question = Question::plan(&obstacles, &scenario.vehicle, &request, Seed(job.seed));
    let within = request.deadline.map_or(WITHIN, |deadline| deadline + GRACE);
    let mut record = RunRecord::of_job(job);
    evaluation.ends(&mut record, [request.start, request.goal]);
    let (mut improvements, mut path) = (Vec::new(), None);
    match ask(command, &question, within) {
        Ok((ended, answer)) => {
            fill(&mut record, &ended, &answer);
            improvements = improvements_of(&answer);
            if answer.status == "found" {
                path = evaluation.foreign_path(&mut record, &request, &answer.samples());
                note_judged_path(&mut record, &improvements);
            }
        }
        Err(error) => record.fail(RunStatus::Crashed, &format!("{error:#}")),
    }
    if let (Place::Cells { .. }, Some(length_m)) = (&job.task.place, record.length_m) {
        record.length_cells = finite(length_m / obstacles.frame().resolution_m());
    }
    Ok(Run {
        record,
        history: History::new(improvements, &[]),
        path: path.as_ref().map(stored),
        ..Run::default()
    })
}

/// Asks a program, which runs in the folder of the campaign.
pub(crate) fn ask(
    command: &RivalCommand,
    question: &Question,
    within: Duration,
) -> Result<(Ended, RivalAnswer)> {
    let text = format!("{}\n", serde_json::to_string(question)?);
    let ended = run_program(&mut process(command)?, text, within)?;
    let answer = RivalAnswer::read(&ended.stdout).context("its answer")?;
    Ok((ended, answer))
}

/// The process of a program; on Unix it ends with this one.
fn process(command: &RivalCommand) -> Result<Command> {
    let (program, arguments) = command.words.split_first().context("a program")?;
    let this = super::process::this_program()?;
    let is_ourselves = program == OURSELVES;
    let mut process = if is_ourselves || cfg!(unix) {
        Command::new(&this)
    } else {
        Command::new(program)
    };
    if cfg!(unix) {
        process.args(["rival-run", "--"]);
        if is_ourselves {
            process.arg(&this);
        } else {
            process.arg(program);
        }
    }
    process.args(arguments);
    if command.folder != Path::new("") {
        process.current_dir(&command.folder);
    }
    Ok(process)
}

/// Notes the answer, and what was seen of its process.
fn fill(record: &mut RunRecord, ended: &Ended, answer: &RivalAnswer) {
    record.total_s = Some(ended.total_s);
    let status = match answer.status.as_str() {
        "found" => RunStatus::Found,
        "not_found" => RunStatus::NotFound,
        "refused" => RunStatus::Refused,
        "unavailable" => RunStatus::Unavailable,
        status => {
            let reason = format!("status: {status}; a path was asked for");
            record.fail(RunStatus::Crashed, &reason);
            return;
        }
    };
    record.fail(status, answer.reason.as_deref().unwrap_or_default());
    record.map_setup_s = answer.map_setup_s;
    record.cpu_s = answer.cpu_s;
    record.peak_rss_bytes = answer.peak_rss_bytes;
    if !matches!(status, RunStatus::Found | RunStatus::NotFound) {
        return;
    }
    // A program that does not tell took as long as its process; none took longer.
    let within = |time_s: f64| time_s.min(ended.total_s);
    let query_s = within(answer.query_s.unwrap_or(ended.total_s));
    record.query_s = Some(query_s);
    if status == RunStatus::Found {
        record.first_feasible_s = Some(answer.first_feasible_s.map_or(query_s, within));
    }
}

fn improvements_of(answer: &RivalAnswer) -> Vec<Improvement> {
    let improvement = |&[at_s, length_m]: &[f64; 2]| Improvement {
        at_s,
        steps: 0,
        length_m,
    };
    answer.improvements.iter().map(improvement).collect()
}

/// Notes the path that was judged, which is the last, where it was known by then. Nobody judged
/// those before it.
fn note_judged_path(record: &mut RunRecord, improvements: &[Improvement]) {
    let at_s = improvements.last().map(|last| last.at_s).or(record.query_s);
    if at_s.is_some_and(|at_s| at_s <= 0.1) {
        record.length_by_tenth_m = record.length_m;
        record.min_clearance_by_tenth_m = record.min_clearance_m;
        record.n_cusps_by_tenth = record.n_cusps;
    }
    if at_s.is_some_and(|at_s| at_s <= 1.0) {
        record.length_by_second_m = record.length_m;
        record.min_clearance_by_second_m = record.min_clearance_m;
        record.n_cusps_by_second = record.n_cusps;
    }
}

fn stored(path: &CurvePath) -> PathDocument {
    PathDocument {
        poses: Vec::new(),
        segments: path.segments().iter().map(Into::into).collect(),
    }
}

//! A run of a program of others: the program plans, our judge decides.

use super::evaluate::Evaluation;
use super::job::{Job, Place, RivalCommand};
use super::measure::Improvement;
use super::record::{History, Run, RunRecord, finite};
use super::scenario::Sources;
use super::status::RunStatus;
use crate::rival::{Ended, Question, RivalAnswer, Verdict, run as run_program};
use anyhow::{Context, Result};
use formicar::collision::ObstacleMap;
use formicar::numeric::Seed;
use formicar::path::CurvePath;
use formicar::planner::{PathDocument, RequestDocument};
use formicar::scenario::Request;
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
                let valid = judge_course(&evaluation, &request, &answer, &mut improvements);
                note_course(&mut record, &answer, &valid);
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
    record.map_setup_cpu_s = answer.map_setup_cpu_s;
    record.cpu_s = answer.cpu_s;
    record.peak_rss_bytes = answer.peak_rss_bytes;
    if !matches!(status, RunStatus::Found | RunStatus::NotFound) {
        return;
    }
    // A program that does not tell took as long as its process; none took longer.
    let within = |time_s: f64| time_s.min(ended.total_s);
    let query_s = within(answer.query_s.unwrap_or(ended.total_s));
    record.query_s = Some(query_s);
    record.query_cpu_s = answer.query_cpu_s;
    if status == RunStatus::Found {
        record.first_feasible_s = Some(answer.first_feasible_s.map_or(query_s, within));
        record.first_feasible_cpu_s = answer.first_feasible_cpu_s;
    }
}

/// The paths that a program tells of; one that tells of none has found its path in the end.
fn improvements_of(answer: &RivalAnswer) -> Vec<Improvement> {
    let improvement = |(i, &[at_s, length_m]): (usize, &[f64; 2])| Improvement {
        at_s,
        steps: 0,
        length_m,
        cpu_s: answer.improvements_cpu_s.get(i).copied(),
        cost_m: None,
    };
    let improvements = answer.improvements.iter().enumerate();
    improvements.map(improvement).collect()
}

/// Judges the paths of a course as far as their poses are told, notes length and cost of the valid
/// ones, and returns these.
fn judge_course(
    evaluation: &Evaluation,
    request: &Request,
    answer: &RivalAnswer,
    improvements: &mut [Improvement],
) -> Vec<Improvement> {
    let mut valid = Vec::new();
    for (i, improvement) in improvements.iter_mut().enumerate() {
        let samples = answer.samples_of(i);
        let verdict = samples.and_then(|samples| {
            Verdict::new(evaluation.obstacles, evaluation.vehicle, request, &samples)
        });
        if let Some(verdict) = verdict.filter(|verdict| verdict.report.valid) {
            improvement.length_m = verdict.path.length_m();
            improvement.cost_m = evaluation.cost_m(&verdict.path);
            valid.push(*improvement);
        }
    }
    valid
}

/// Notes when valid paths were known. A program that tells of no course has found its path in the
/// end; where it shows every path, the first that can be driven counts as its first.
fn note_course(record: &mut RunRecord, answer: &RivalAnswer, valid: &[Improvement]) {
    if answer.improvements.is_empty() {
        let only = record.query_s.zip(record.length_m);
        let only = only.map(|(at_s, length_m)| Improvement {
            at_s,
            length_m,
            ..Improvement::default()
        });
        record.note_known_paths(only.as_slice());
        return;
    }
    record.note_known_paths(valid);
    if let Some(first) = valid.first().filter(|_| !answer.earlier_poses.is_empty()) {
        record.first_feasible_s = Some(first.at_s);
        record.first_feasible_cpu_s = first.cpu_s;
        record.first_length_m = Some(first.length_m);
    }
}

fn stored(path: &CurvePath) -> PathDocument {
    PathDocument {
        poses: Vec::new(),
        segments: path.segments().iter().map(Into::into).collect(),
    }
}

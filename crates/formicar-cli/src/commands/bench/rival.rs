//! Programs of others in a campaign: who they are, and one run of theirs.

use super::{execute, measure, place};
use crate::scene;
use anyhow::{Context, Result, bail};
use formicar::collision::ObstacleMap;
use formicar::numeric::Seed;
use formicar::planner::{PathDocument, RequestDocument};
use formicar_lab::campaign::{
    ConfigRecord, History, Improvement, Job, KNOWN_BY, Place, RivalCommand, Row, Told,
};
use formicar_lab::rival::{Ended, Question, RivalAnswer, run};
use serde_json::{Map, json};
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;
use xxhash_rust::xxh3::xxh3_128;

/// Time for a program to say who it is.
const WITHIN_VERSION: Duration = Duration::from_mins(1);
/// Time for a run without a deadline.
const WITHIN: Duration = Duration::from_mins(10);
/// Time beyond a deadline for starting, reading the map and printing the path.
const GRACE: Duration = Duration::from_secs(30);

/// The word for the program that runs the campaign.
const OURSELVES: &str = "formicar";

/// What decides on the answers of a program: its command, what it says it is, and the contents of
/// the files that the command names.
pub(super) fn config(name: &str, command: &RivalCommand) -> Result<ConfigRecord> {
    let within = || format!("planner {name:?}: {}", command.words.join(" "));
    let answer = ask(command, &Question::version(), WITHIN_VERSION).with_context(within)?;
    if !matches!(answer.1.status.as_str(), "ready" | "unavailable") {
        let what = "status: expected ready or unavailable, the version was asked for";
        bail!("{}: {what}", within());
    }
    let is_file = |word: &&String| command.folder.join(word).is_file();
    let hash = |word: &String| {
        let bytes = fs::read(command.folder.join(word)).unwrap_or_default();
        (word.clone(), json!(format!("{:032x}", xxh3_128(&bytes))))
    };
    let arguments = command.words.iter().skip(1);
    let files: Map<_, _> = arguments.filter(is_file).map(hash).collect();
    let json = json!({
        "command": command.words,
        "version": answer.1.version,
        "unavailable": (answer.1.status == "unavailable").then_some(answer.1.reason),
        "files": files,
    });
    Ok(ConfigRecord::of_json(name, json.to_string()))
}

/// One run: the program plans, our judge rules.
pub(super) fn run_one(job: &Job, command: &RivalCommand) -> Result<Told> {
    let ground = scene::load(&place::ground_args(&job.task, job.vehicle_source()))?;
    let obstacles = ObstacleMap::new(&ground.map);
    let on = (&obstacles, &ground.vehicle.vehicle);
    let document = place::request(job, &ground)?;
    let request = document.onto(&RequestDocument::default())?;
    let question = Question::plan(&obstacles, on.1, &request, Seed(job.seed));
    let within = request.deadline.map_or(WITHIN, |deadline| deadline + GRACE);
    let mut row = Row::begin(job);
    measure::ground(&mut row, on, [request.start, request.goal]);
    if let Place::Cells {
        optimal_length_cells,
        ..
    } = job.task.place
    {
        row.set("optimal_length_cells", &json!(optimal_length_cells));
    }
    let (mut history, mut path) = (History::default(), None);
    match ask(command, &question, within) {
        Ok((ended, answer)) => {
            fill(&mut row, &ended, &answer);
            history = told_of(&answer);
            if answer.status == "found" {
                let samples = answer.samples();
                path = measure::verdict(&mut row, on, &request, &samples);
                known_by(&mut row, &answer);
            }
        }
        Err(error) => {
            row.set("status", &json!("crashed"));
            row.set("reason", &json!(format!("{error:#}")));
        }
    }
    if let (Place::Cells { .. }, Some(length_m)) = (&job.task.place, row.number("length_m")) {
        let length_cells = length_m / obstacles.frame().resolution_m();
        row.set("length_cells", &json!(length_cells));
    }
    Ok(Told {
        row: row.values(),
        history,
        path: path.map(|path| PathDocument {
            poses: Vec::new(),
            segments: path.segments().iter().map(Into::into).collect(),
        }),
    })
}

/// Asks a program, which runs in the folder of the campaign.
fn ask(
    command: &RivalCommand,
    question: &Question,
    within: Duration,
) -> Result<(Ended, RivalAnswer)> {
    let ended = run(&mut process(command)?, question_text(question)?, within)?;
    let answer = RivalAnswer::read(&ended.stdout).context("its answer")?;
    Ok((ended, answer))
}

fn question_text(question: &Question) -> Result<String> {
    Ok(format!("{}\n", serde_json::to_string(question)?))
}

/// The process of a program; on Unix it ends with this one.
fn process(command: &RivalCommand) -> Result<Command> {
    let (program, arguments) = command.words.split_first().context("a program")?;
    let this = execute::this_program()?;
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

/// What the answer says, and what was seen of its process.
fn fill(row: &mut Row, ended: &Ended, answer: &RivalAnswer) {
    row.set("total_s", &json!(ended.total_s));
    if answer.status == "ready" {
        row.set("status", &json!("crashed"));
        row.set("reason", &json!("status: ready; a path was asked for"));
        return;
    }
    row.set("status", &json!(answer.status));
    row.set("reason", &json!(answer.reason));
    row.set("map_setup_s", &json!(answer.map_setup_s));
    row.set("cpu_s", &json!(answer.cpu_s));
    row.set("peak_rss_bytes", &json!(answer.peak_rss_bytes));
    if !matches!(answer.status.as_str(), "found" | "not_found") {
        return;
    }
    // A program that does not tell took as long as its process; none took longer.
    let within = |time_s: f64| time_s.min(ended.total_s);
    let query_s = within(answer.query_s.unwrap_or(ended.total_s));
    row.set("query_s", &json!(query_s));
    if answer.status == "found" {
        let first_s = answer.first_feasible_s.map_or(query_s, within);
        row.set("first_feasible_s", &json!(first_s));
    }
}

/// The paths that it has told of.
fn told_of(answer: &RivalAnswer) -> History {
    let improvements = answer.improvements.iter();
    let improvements = improvements.map(|&[at_s, length_m]| Improvement {
        at_s,
        steps: 0,
        length_m,
    });
    History::new(improvements.collect(), &[])
}

/// What was known by then: of the path that was judged, which is the last. Others nobody judged.
fn known_by(row: &mut Row, answer: &RivalAnswer) {
    let last_s = answer.improvements.last().map(|told| told[0]);
    let Some(at_s) = last_s.or_else(|| row.number("query_s")) else {
        return;
    };
    for (limit_s, columns) in KNOWN_BY {
        if at_s <= limit_s {
            for (to, from) in columns
                .iter()
                .zip(["length_m", "min_clearance_m", "n_cusps"])
            {
                let value = row.get(from).to_owned();
                row.set(to, &json!(value));
            }
        }
    }
}

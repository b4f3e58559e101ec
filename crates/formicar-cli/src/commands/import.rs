//! `import`: files of other planners as rows of results, judged where they hold a path.
#![allow(clippy::doc_markdown, reason = "clap prints these words as they stand")]

use crate::failure::{Ending, Failure};
use crate::scene::SceneArgs;
use crate::{files, scene, values};
use anyhow::{Context, Result, anyhow, bail};
use clap::{Args, ValueHint};
use formicar::collision::ObstacleMap;
use formicar::map::builtin::BuiltinMap;
use formicar::map::format::write_atomically;
use formicar::numeric::counted;
use formicar::scenario::{GoalTolerance, Request};
use formicar::vehicle::Gears;
use formicar_lab::rival::import::{Imported, read};
use formicar_lab::run::{
    Evaluation, OWN_VEHICLE, Origin, Run, RunRecord, RunStatus, read_csv, to_csv,
};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Flags of `import`.
#[derive(Args, Debug)]
#[command(after_help = "\
Every file is a run, with the seeds from --seed on; every run of an OMPL log is one. The scenario \
goes by the name that it has in a campaign, so that `report` and `compare` table the rows beside \
ours. Rows of the same scenario, vehicle, motion mode, planner and seed are replaced.")]
pub(crate) struct ImportArgs {
    /// Paths as CSV of x, y[, heading] or as nav_msgs/Path in JSON, or benchmark logs of OMPL.
    #[arg(required = true, value_hint = ValueHint::FilePath)]
    files: Vec<PathBuf>,

    /// Name of the planner; an OMPL log names its own.
    #[arg(long, value_name = "NAME")]
    planner: Option<String>,

    /// Name of the scenario; the id of the scenario or request by default.
    #[arg(long, value_name = "NAME")]
    name: Option<String>,

    /// Seed of the first run.
    #[arg(long, value_name = "N", default_value_t = 0,
          value_parser = clap::value_parser!(u64).range(..=1_000_000_000))]
    seed: u64,

    /// Time of the query that has found the path, seconds.
    #[arg(long, value_name = "S", value_parser = values::positive, allow_hyphen_values = true)]
    query: Option<f64>,

    /// Time to the first path, seconds.
    #[arg(long, value_name = "S", value_parser = values::positive, allow_hyphen_values = true)]
    first: Option<f64>,

    /// Gears that the planner could use.
    #[arg(long, value_name = "MODE", default_value = "reverse",
          value_parser = values::word::<Gears>(&["forward", "reverse"]))]
    motion: Gears,

    /// Tolerance at the goal, meters and radians: planners over grids of poses seldom end nearer
    /// than a cell.
    #[arg(long, value_name = "M,RAD", value_parser = values::goal_tolerance)]
    goal_tolerance: Option<GoalTolerance>,

    /// Take the word of a log for paths that it does not hold: they count as solved, and their
    /// planner is called NAME (own word).
    #[arg(long)]
    trust: bool,

    #[command(flatten)]
    ground: SceneArgs,

    /// Table that takes the rows; made where it does not exist.
    #[arg(long, value_name = "F.csv", value_hint = ValueHint::FilePath)]
    out: PathBuf,
}

/// The scene and request that all runs share.
struct Place {
    scenario: String,
    source: String,
    obstacles: ObstacleMap,
    vehicle: formicar::vehicle::Vehicle,
    request: Request,
}

/// Carries out `import`.
pub(crate) fn run(args: &ImportArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    check(args)?;
    let place = Place::of(args)?;
    let mut runs = Vec::new();
    for (path, seed) in args.files.iter().zip(args.seed..) {
        let name = || path.display().to_string();
        for imported in &read(&files::read_document(path)?).with_context(name)? {
            runs.push(run_of(args, &place, imported, seed).with_context(name)?);
        }
    }
    let rows = merged(&args.out, &runs)?;
    write_atomically(&args.out, to_csv(&rows)?.as_bytes())
        .with_context(|| format!("{} cannot be written", args.out.display()))?;
    for run in &runs {
        writeln!(out, "{}", line(&run.record))?;
    }
    let (file, n_runs) = (args.out.display(), counted(runs.len(), "run"));
    writeln!(out, "{n_runs} imported, {} in all: see {file}", rows.len())?;
    Ok(Ending::Done)
}

/// Refuses a table that could not be read back, and a first path after the end of its query.
fn check(args: &ImportArgs) -> Result<()> {
    let is_table = args
        .out
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("csv"));
    if !is_table {
        let hint = args.out.with_extension("csv");
        let (out, hint) = (args.out.display(), hint.display());
        bail!("--out {out}: expected a table as CSV, not a store; hint: --out {hint}");
    }
    match (args.first, args.query) {
        (Some(first_s), Some(query_s)) if first_s > query_s => bail!(
            "--first {first_s}: the query took {query_s} s in all; hint: at most --query {query_s}"
        ),
        _ => Ok(()),
    }
}

impl Place {
    fn of(args: &ImportArgs) -> Result<Self> {
        let ground = scene::load(&args.ground)?;
        let (scenario, source) = names(args)?;
        let hint = "the map has no start and goal; hint: --scenario F, or a built-in map";
        let [start, goal] = ground.ends.context(hint)?;
        let request = Request {
            gears: args.motion,
            goal_tolerance: args.goal_tolerance.unwrap_or_default(),
            ..Request::new(start, goal)
        };
        Ok(Self {
            scenario,
            source,
            obstacles: ObstacleMap::new(&ground.map),
            vehicle: ground.vehicle.vehicle,
            request,
        })
    }
}

/// The names of scenario and source that `bench` gives them.
fn names(args: &ImportArgs) -> Result<(String, String)> {
    let stem = |path: &Path| -> Result<String> {
        let stem = path.file_stem().and_then(|stem| stem.to_str());
        Ok(stem
            .with_context(|| format!("{}: a name in UTF-8 is needed", path.display()))?
            .to_owned())
    };
    let ground = &args.ground;
    let (by_default, source) = match (&ground.scenario, &ground.map) {
        (Some(path), _) => (
            ground.id.clone().map_or_else(|| first_id(path), Ok)?,
            stem(path)?,
        ),
        (None, Some(map)) => match BuiltinMap::by_name(map) {
            Ok(builtin) => {
                let first = builtin.requests.first().map_or("", |request| request.id);
                let id = ground.request.as_deref().unwrap_or(first);
                (format!("{map}-{id}"), map.clone())
            }
            Err(_) => (stem(Path::new(map))?, stem(Path::new(map))?),
        },
        (None, None) => bail!("a scenario is needed; hint: --scenario F --id ID, or --map NAME"),
    };
    Ok((args.name.clone().unwrap_or(by_default), source))
}

/// The id of the only scenario of a file.
fn first_id(path: &Path) -> Result<String> {
    let id = match scene::ScenarioFile::read(path)? {
        scene::ScenarioFile::Cars(cars) => cars.rows().into_iter().next().map(|(id, _)| id),
        scene::ScenarioFile::Tpcap(case) => Some(case.row().0),
    };
    id.with_context(|| format!("{}: it holds no scenarios", path.display()))
}

/// A run with its origin.
fn run_of(args: &ImportArgs, place: &Place, imported: &Imported, seed: u64) -> Result<Run> {
    let planner = args.planner.as_ref().or(imported.planner.as_ref());
    let planner =
        planner.ok_or_else(|| anyhow!("the file names no planner; hint: --planner NAME"))?;
    let is_trusted = args.trust && imported.samples.is_none();
    let mut record = RunRecord {
        scenario: place.scenario.clone(),
        planner: if is_trusted {
            format!("{planner} (own word)")
        } else {
            planner.clone()
        },
        seed: seed + imported.run,
        source: place.source.clone(),
        status: if imported.is_found {
            RunStatus::Found
        } else {
            RunStatus::NotFound
        },
        query_s: imported.query_s.or(args.query),
        first_feasible_s: args.first,
        length_m: imported.length_m,
        ..RunRecord::default()
    };
    let evaluation = Evaluation {
        obstacles: &place.obstacles,
        vehicle: &place.vehicle,
    };
    evaluation.ends(&mut record, [place.request.start, place.request.goal]);
    match &imported.samples {
        Some(samples) => drop(evaluation.foreign_path(&mut record, &place.request, samples)),
        None if imported.is_found => {
            record.valid = is_trusted.then_some(true);
            "its log holds no path: not judged".clone_into(&mut record.reason);
        }
        None => {}
    }
    Ok(Run {
        record,
        origin: origin(args, place),
        ..Run::default()
    })
}

fn origin(args: &ImportArgs, place: &Place) -> Origin {
    let motion = args.motion.name();
    let vehicle = args.ground.vehicle.as_deref().unwrap_or(OWN_VEHICLE);
    Origin {
        vehicle: vehicle.to_owned(),
        motion: motion.to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        map_hash: format!("{:032x}", place.obstacles.hash()),
        vehicle_hash: format!("{:032x}", place.vehicle.hash()),
        ..Origin::default()
    }
}

/// The rows of a table with new ones in the place of those that they replace, or behind all.
fn merged(path: &Path, new: &[Run]) -> Result<Vec<Run>> {
    let mut rows = if path.exists() {
        read_csv(&files::read_text(path)?).with_context(|| path.display().to_string())?
    } else {
        Vec::new()
    };
    let key = |run: &Run| (run.record.key(), run.place().map(str::to_owned));
    for run in new {
        match rows.iter_mut().find(|row| key(row) == key(run)) {
            Some(row) => row.clone_from(run),
            None => rows.push(run.clone()),
        }
    }
    Ok(rows)
}

fn line(record: &RunRecord) -> String {
    let verdict = match (record.status, record.valid) {
        (RunStatus::Found, Some(true)) if record.reason.is_empty() => "valid",
        (RunStatus::Found, Some(false)) => "invalid",
        (status, _) => status.name(),
    };
    let reason = match record.reason.as_str() {
        "" => String::new(),
        reason => format!(": {reason}"),
    };
    let (scenario, planner, seed) = (&record.scenario, &record.planner, record.seed);
    format!("{scenario}  {planner}  seed {seed}  {verdict}{reason}")
}

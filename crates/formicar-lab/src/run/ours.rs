//! A run of one of our planners in this process.

use super::evaluate::Evaluation;
use super::job::Job;
use super::measure::{Improvement, Measured, measure};
use super::record::{History, Run, RunRecord, one_line};
use super::scenario::{LoadedScenario, Sources};
use super::status::RunStatus;
use super::usage;
use anyhow::{Context, Result};
use formicar::map::Cell;
use formicar::map::format::write_atomically;
use formicar::numeric::Seed;
use formicar::path::{CurvePath, GridPath, Spacing};
use formicar::planner::{
    AnswerContext, ColonyRecord, Outcome, PathDocument, Plan, PlanError, Planner, RequestDocument,
    Timing,
};
use std::f64::consts::SQRT_2;
use std::path::Path;
use std::time::Instant;

type Answer = Measured<Result<Outcome, PlanError>>;

/// The beginning of a run, by clock and processor.
#[derive(Clone, Copy, Debug)]
pub struct Begun {
    at: Instant,
    cpu_s: Option<f64>,
}

impl Begun {
    /// The beginning of a run with its process, which it has for itself.
    pub fn with_process() -> Self {
        Self {
            at: Instant::now(),
            cpu_s: Some(0.0),
        }
    }

    /// The beginning of a run now, in a process that has done other work before.
    pub fn now() -> Self {
        Self {
            at: Instant::now(),
            cpu_s: usage::cpu_s(),
        }
    }

    fn so_far(&self) -> Spent {
        let cpu_s = usage::cpu_s().zip(self.cpu_s);
        Spent {
            wall_s: self.at.elapsed().as_secs_f64(),
            cpu_s: cpu_s.map(|(now_s, begun_s)| now_s - begun_s),
        }
    }
}

/// Time spent on something.
#[derive(Clone, Copy, Debug)]
struct Spent {
    wall_s: f64,
    cpu_s: Option<f64>,
}

/// Carries out a run of a planner of ours.
pub(super) fn run(job: &Job, sources: &dyn Sources, begun: Begun) -> Result<Run> {
    let config = sources.config(&job.contender)?;
    let scenario = sources.load(&job.task, job.vehicle_source())?;
    let make =
        |scenario: &LoadedScenario| Planner::new(&scenario.map, scenario.vehicle.clone(), config);
    run_planner(job, scenario, begun, make)
}

/// Carries out a run of a planner that is made for its scenario.
pub(super) fn run_planner(
    job: &Job,
    scenario: LoadedScenario,
    begun: Begun,
    make: impl FnOnce(&LoadedScenario) -> Result<Planner, PlanError>,
) -> Result<Run> {
    let setup = Begun::now();
    let planner = make(&scenario)?;
    let run = OurRun {
        job,
        request: scenario.request(job)?,
        setup: setup.so_far(),
        planner,
        scenario,
        begun,
    };
    run.carry_out()
}

struct OurRun<'a> {
    job: &'a Job,
    request: RequestDocument,
    setup: Spent,
    planner: Planner,
    scenario: LoadedScenario,
    begun: Begun,
}

/// The answer that counts, with what was used for it.
struct Counted {
    answer: Answer,
    total_s: f64,
    cpu_s: Option<f64>,
    peak_rss_bytes: Option<u64>,
    /// The query before the one that counts.
    cold: Option<Answer>,
    /// True if the cold and the warm planner return the same path.
    is_same: bool,
}

impl OurRun<'_> {
    fn carry_out(mut self) -> Result<Run> {
        let counted = self.ask();
        let answer = &counted.answer;
        if let Some(path) = &self.job.answer {
            self.write_answer(path, &counted)?;
        }
        let mut record = RunRecord::of_job(self.job);
        self.note_times(&mut record, &counted);
        self.fill(&mut record, answer);
        if !counted.is_same && self.request.deadline_ms.is_none() {
            record.valid = Some(false);
            "asked again, the warm planner answers otherwise".clone_into(&mut record.reason);
        }
        Ok(Run {
            record,
            history: self.history(&counted),
            path: found(answer).map(|plan| self.stored(&plan.path)),
            ..Run::default()
        })
    }

    /// Asks as often as the job says.
    fn ask(&mut self) -> Counted {
        let (cold, cold_total_s) = self.ask_once();
        let warm = (!self.job.limits.is_cold).then(|| self.ask_once());
        // Before anything else uses up more. The time of a query that warms up does not count.
        let cpu_s = usage::cpu_s().zip(self.begun.cpu_s);
        let warm_up_s = warm.as_ref().and(cold.cpu_s).unwrap_or(0.0);
        let peak_rss_bytes = usage::peak_rss_bytes();
        let is_same = match &warm {
            Some((warm, _)) => path_of(warm) == path_of(&cold),
            None => true,
        };
        let (answer, total_s, cold) = match warm {
            Some((warm, total_s)) => (warm, total_s, Some(cold)),
            None => (cold, cold_total_s, None),
        };
        Counted {
            answer,
            total_s,
            cold,
            cpu_s: cpu_s.map(|(now_s, begun_s)| now_s - begun_s - warm_up_s),
            peak_rss_bytes,
            is_same,
        }
    }

    fn note_times(&self, record: &mut RunRecord, counted: &Counted) {
        let answer = &counted.answer;
        let cold = counted.cold.as_ref().unwrap_or(answer);
        record.map_setup_s = Some(self.setup.wall_s);
        record.map_setup_cpu_s = self.setup.cpu_s;
        record.first_feasible_s = answer.first_feasible_s();
        record.first_feasible_cpu_s = answer.first_feasible_cpu_s();
        record.cold_first_s = cold.first_feasible_s();
        record.cold_first_cpu_s = cold.first_feasible_cpu_s();
        record.query_s = Some(answer.query_s);
        record.query_cpu_s = answer.cpu_s;
        record.total_s = Some(counted.total_s);
        record.cpu_s = counted.cpu_s;
        record.peak_rss_bytes = counted.peak_rss_bytes;
    }

    /// The course of the query that counts, and of the one before it; paths with their costs.
    fn history(&self, counted: &Counted) -> History {
        let stages = counted.answer.answer.as_ref().ok().map(Outcome::stages);
        let colony = stages.and_then(ColonyRecord::new);
        let iterations = colony.map_or(Vec::new(), |colony| colony.iterations);
        let mut history = History::new(self.priced(&counted.answer), &iterations);
        history.cold = counted
            .cold
            .as_ref()
            .map_or(Vec::new(), |cold| self.priced(cold));
        history
    }

    /// Improvements with the costs of their paths.
    fn priced(&self, answer: &Answer) -> Vec<Improvement> {
        let evaluation = self.evaluation();
        let improvements = answer.improvements.iter().zip(&answer.paths);
        let priced = |(improvement, path): (&Improvement, &CurvePath)| Improvement {
            cost_m: evaluation.cost_m(path),
            ..*improvement
        };
        improvements.map(priced).collect()
    }

    fn evaluation(&self) -> Evaluation<'_> {
        Evaluation {
            obstacles: self.planner.obstacles(),
            vehicle: self.planner.vehicle(),
        }
    }

    /// An answer, and the time from the beginning of the run to its end.
    fn ask_once(&mut self) -> (Answer, f64) {
        let (document, planner) = (&self.request, &mut self.planner);
        let answer = measure(&mut (), |observer| {
            let request = document.onto(&RequestDocument::default())?;
            planner.plan(&request, Seed(self.job.seed), observer)
        });
        (answer, self.begun.at.elapsed().as_secs_f64())
    }

    fn write_answer(&self, path: &Path, counted: &Counted) -> Result<()> {
        let context = AnswerContext {
            planner: &self.planner,
            map: self.scenario.map_record.clone(),
            vehicle_name: &self.scenario.vehicle_name,
            spacing: Spacing::default(),
        };
        let measured = &counted.answer;
        let timing = Timing {
            map_setup_s: self.setup.wall_s,
            first_feasible_s: measured.first_feasible_s(),
            query_s: measured.query_s,
            total_s: counted.total_s,
        };
        let request = self.request.onto(&RequestDocument::default()).ok();
        let seed = Seed(self.job.seed);
        let answer = context.answer(request.as_ref(), seed, &measured.answer, timing);
        let mut json = serde_json::to_vec(&answer)?;
        json.push(b'\n');
        write_atomically(path, &json)
            .with_context(|| format!("{} cannot be written", path.display()))
    }

    /// The path as it is kept: its segments say all of it, unless it stands still at a pose.
    fn stored(&self, path: &CurvePath) -> PathDocument {
        let mut poses = Vec::new();
        if path.segments().is_empty() {
            let (obstacles, vehicle) = (self.planner.obstacles(), self.planner.vehicle());
            poses = PathDocument::new(path, obstacles, vehicle, 1.0).poses;
            poses.truncate(1);
        }
        PathDocument {
            poses,
            segments: path.segments().iter().map(Into::into).collect(),
        }
    }

    /// Notes the ending and, of a path, everything that is measured of it.
    fn fill(&self, record: &mut RunRecord, answer: &Answer) {
        match &answer.answer {
            Ok(outcome) => {
                record.status = outcome.status().into();
                record.steps = Some(outcome.n_steps());
                record.valid = outcome.judged().map(|(_, report)| report.valid);
                if let Outcome::NotFound(failure) = outcome {
                    record.reason = one_line(&failure.reason);
                }
            }
            Err(error) => record.fail(RunStatus::InvalidRequest, &error.to_string()),
        }
        let Ok(request) = self.request.onto(&RequestDocument::default()) else {
            return;
        };
        let evaluation = self.evaluation();
        evaluation.ends(record, [request.start, request.goal]);
        if let Some(plan) = found(answer) {
            evaluation.plan(record, &request, plan);
            record.length_cells = plan.stages.grid_path.as_ref().map(length_cells);
            let first = answer.improvements.first();
            record.first_length_m = first.map(|first| first.length_m);
            record.first_steps = first.map(|first| first.steps);
            record.note_known_paths(&answer.improvements);
        }
    }
}

fn found(answer: &Answer) -> Option<&Plan> {
    match &answer.answer {
        Ok(Outcome::Found(plan)) => Some(plan),
        _ => None,
    }
}

fn path_of(answer: &Answer) -> Option<&CurvePath> {
    found(answer).map(|plan| &plan.path)
}

/// Length between cell centers: straight steps count 1, diagonal ones the square root of 2.
pub(crate) fn length_cells(path: &GridPath) -> f64 {
    let is_diagonal = |pair: &&[Cell]| pair[0].col != pair[1].col && pair[0].row != pair[1].row;
    let n_steps = path.cells.len().saturating_sub(1);
    let n_diagonal = path.cells.windows(2).filter(is_diagonal).count();
    (n_steps - n_diagonal) as f64 + SQRT_2 * n_diagonal as f64
}

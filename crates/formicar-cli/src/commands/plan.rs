//! `plan`: from a map and two poses to a certified path.

use super::stdin;
use crate::ants::{self, AntsKind};
use crate::args::PlanArgs;
use crate::clock::{Clock, PathTold, Watch};
use crate::failure::{Ending, Failure, note};
use crate::ground::{self, Ground};
use crate::output::Target;
use crate::picture::{self, PictureKind};
use crate::{settings, soft_costs, summary};
use anyhow::Result;
use formicar::collision::ObstacleMap;
use formicar::numeric::Seed;
use formicar::planner::{
    Answer, AnswerContext, Outcome, PlanError, Planner, PlannerConfig, RequestDocument, Timing,
    ViaRecord,
};
use formicar::progress::AntFrames;
use formicar::render::Layout;
use formicar::scenario::{CurvatureMode, CurvatureRate, ViaPoint};
use std::io::Write;
use std::sync::Arc;
use std::time::Instant;

/// What `--out` writes.
#[derive(Clone, Copy, Debug)]
enum OutKind {
    Answer,
    Poses,
}

/// What is to be written.
struct Targets {
    out: Option<Target<OutKind>>,
    picture: Option<Target<PictureKind>>,
    ants: Option<Target<AntsKind>>,
}

/// Everything that stands before the first request, warm.
pub(super) struct Session {
    pub(super) planner: Planner,
    ground: Ground,
    obstacles: Arc<ObstacleMap>,
    config: PlannerConfig,
    /// The ants of the last query, where they are wanted.
    ants: Option<AntFrames>,
    map_setup_s: f64,
    begun: Instant,
}

/// One answered query.
pub(super) struct Answered {
    pub(super) answer: Answer,
    pub(super) result: Result<Outcome, PlanError>,
    pub(super) n_improvements: u32,
    /// The certified paths that it told of, the best last.
    pub(super) paths: Vec<PathTold>,
}

/// Carries out `plan`.
pub(crate) fn run(args: &PlanArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let begun = Instant::now();
    let targets = Targets::of(args)?;
    let settings = settings::load(args.config.as_deref(), &args.set, args.planner)?;
    let mut ground = ground::load(&args.ground)?;
    let config = settings.for_motion(ground.vehicle.vehicle.motion());
    if targets.ants.is_some() {
        ants::check(config.planner)?;
    }
    let soft_costs = soft_costs::load(args, &mut ground, config.planner)?;
    let defaults = request(args, &ground);
    let n_threads = args.threads.map_or(1, |n| n as usize);
    let mut session = Session::new(ground, config, begun)?.with_threads(n_threads);
    if let Some(costs) = soft_costs {
        session.planner = session.planner.with_soft_costs(&costs);
    }
    if targets.ants.is_some() {
        session.keep_ants();
    }
    if args.stdin {
        return stdin::run(&mut session, &defaults, Seed(args.seed), out);
    }
    let answered = session.ask(&defaults, &RequestDocument::default(), Seed(args.seed));
    if answered.ending() != Ending::Refused {
        write_files(&session, &answered, &targets)?;
    }
    if args.json {
        serde_json::to_writer(&mut *out, &answered.answer).map_err(std::io::Error::from)?;
        writeln!(out)?;
    } else if let Err(error) = answered.result {
        return Err(Failure::Input(error.into()));
    } else {
        let vehicle = &session.ground.vehicle.vehicle;
        summary::write(&answered.answer, vehicle, answered.n_improvements, out)?;
    }
    Ok(answered.ending())
}

impl Targets {
    fn of(args: &PlanArgs) -> Result<Self> {
        let out_kinds = [("json", OutKind::Answer), ("csv", OutKind::Poses)];
        Ok(Self {
            out: target(args.out.as_deref(), &out_kinds)?,
            picture: target(args.picture.as_deref(), &picture::KINDS)?,
            ants: target(args.ants.as_deref(), &ants::KINDS)?,
        })
    }
}

fn target<Kind: Copy>(
    path: Option<&std::path::Path>,
    kinds: &[(&str, Kind)],
) -> Result<Option<Target<Kind>>> {
    path.map(|path| Target::new(path, kinds)).transpose()
}

/// The request of the flags, over that of the scenario or built-in map.
fn request(args: &PlanArgs, ground: &Ground) -> RequestDocument {
    let [start, goal] = match ground.ends {
        Some([start, goal]) => [Some(start), Some(goal)],
        None => [None, None],
    };
    let list = |pose: formicar::geometry::Pose2| [pose.x, pose.y, pose.heading];
    let own = &args.goal;
    let (goal, goals) = match own[..] {
        [] => (goal.map(list), None),
        [only] => (Some(list(only)), None),
        _ => (None, Some(own.iter().copied().map(list).collect())),
    };
    let via: Vec<_> = args.via.iter().map(|via| via_record(args, via)).collect();
    RequestDocument {
        id: None,
        start: args.start.or(start).map(list),
        goal,
        goals,
        via: (!via.is_empty()).then_some(via),
        goal_tolerance: args.goal_tolerance,
        motion: args.modes.motion,
        curvature: args
            .continuous_curvature
            .map(|max_rate_per_m2| CurvatureMode::Continuous(CurvatureRate { max_rate_per_m2 })),
        start_heading: args.modes.start_heading,
        goal_heading: args.modes.goal_heading,
        deadline_ms: args.deadline,
        budget_steps: args.budget,
        seed: Some(args.seed),
    }
}

fn via_record(args: &PlanArgs, via: &ViaPoint) -> ViaRecord {
    ViaRecord::from(&ViaPoint {
        tolerance: args.via_tolerance.unwrap_or(via.tolerance),
        ..*via
    })
}

impl Session {
    pub(super) fn new(ground: Ground, config: PlannerConfig, begun: Instant) -> Result<Self> {
        let setup = Instant::now();
        let planner = Planner::new(&ground.map, ground.vehicle.vehicle.clone(), config.clone())?;
        Ok(Self {
            obstacles: planner.obstacles().clone(),
            planner,
            ground,
            config,
            ants: None,
            map_setup_s: setup.elapsed().as_secs_f64(),
            begun,
        })
    }

    fn with_threads(self, n_threads: usize) -> Self {
        Self {
            planner: self.planner.with_threads(n_threads),
            ..self
        }
    }

    /// From now on keeps the ants of a query until the next.
    fn keep_ants(&mut self) {
        let frame = self.obstacles.frame();
        self.ants = Some(AntFrames::new(frame.n_cols(), frame.n_rows()));
    }

    /// Plans one request; what it leaves out comes from `defaults`.
    pub(super) fn ask(
        &mut self,
        request: &RequestDocument,
        defaults: &RequestDocument,
        seed: Seed,
    ) -> Answered {
        let mut watch = Watch {
            clock: Clock::begin(),
            ants: self.ants.as_mut(),
        };
        let planned = request.onto(defaults).map_err(PlanError::from);
        let request = planned.as_ref().ok().cloned();
        let result = planned.and_then(|request| self.planner.plan(&request, seed, &mut watch));
        let clock = watch.clock;
        let timing = Timing {
            map_setup_s: self.map_setup_s,
            first_feasible_s: clock.first_feasible_s(),
            query_s: clock.query_s(),
            total_s: self.begun.elapsed().as_secs_f64(),
        };
        Answered {
            answer: self
                .context()
                .answer(request.as_ref(), seed, &result, timing),
            result,
            n_improvements: clock.n_improvements(),
            paths: clock.into_paths(),
        }
    }

    /// What all answers of this session share.
    pub(super) fn context(&self) -> AnswerContext<'_> {
        AnswerContext {
            obstacles: &self.obstacles,
            map: self.ground.record.clone(),
            vehicle: &self.ground.vehicle.vehicle,
            vehicle_name: &self.ground.vehicle.name,
            config: &self.config,
        }
    }
}

impl Answered {
    fn ending(&self) -> Ending {
        match &self.result {
            Ok(Outcome::Found(_)) => Ending::Done,
            Ok(Outcome::NotFound(_)) => Ending::NoPath,
            Err(_) => Ending::Refused,
        }
    }
}

fn write_files(session: &Session, answered: &Answered, targets: &Targets) -> Result<()> {
    if let Some(target) = &targets.out {
        match (target.kind, &answered.answer.path) {
            (OutKind::Answer, _) => {
                let mut json = serde_json::to_vec(&answered.answer)?;
                json.push(b'\n');
                target.write(&json)?;
            }
            (OutKind::Poses, Some(path)) => target.write(path.poses_csv().as_bytes())?,
            (OutKind::Poses, None) => not_written("no path", target),
        }
    }
    let Ok(outcome) = &answered.result else {
        return Ok(());
    };
    if let Some(target) = &targets.picture {
        let place = (&session.ground, &*session.obstacles);
        let image = picture::of(place, &answered.answer, outcome, Layout::Page);
        target.write(&picture::encode(&image, target.kind)?)?;
    }
    if let (Some(target), Some(kept)) = (&targets.ants, &session.ants) {
        if kept.frames().is_empty() {
            not_written("no ants walked", target);
        } else {
            let frames = kept.frames();
            let file = ants::encode(
                &session.ground,
                (&answered.answer, outcome),
                frames,
                target.kind,
            )?;
            target.write(&file)?;
        }
    }
    Ok(())
}

fn not_written<Kind: Copy>(reason: &str, target: &Target<Kind>) {
    note(&format!(
        "{reason}: {} is not written",
        target.path().display()
    ));
}

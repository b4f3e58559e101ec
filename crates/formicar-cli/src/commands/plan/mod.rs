//! `plan`: from a map and two poses to a certified path.

mod args;
mod motion;
#[cfg(feature = "record")]
mod record;
mod soft_costs;
mod stdin;

pub(crate) use args::PlanArgs;

use crate::ants::{self, AntsKind};
use crate::failure::{Ending, Failure, note};
use crate::output::{Target, print_json};
use crate::picture::{self, PictureKind};
use crate::scene::{self, Scene};
use crate::session::{Answered, Session};
use crate::values::Budget;
use crate::{settings, summary};
use anyhow::{Result, anyhow};
use formicar::geometry::Pose2;
use formicar::numeric::Seed;
use formicar::planner::{Outcome, PlannerName, RequestDocument, ViaRecord};
use formicar::render::Layout;
use formicar::scenario::{CurvatureMode, CurvatureRate, StartContact, ViaPoint};
use motion::{Driven, Motion};
use std::io::Write;
use std::time::Instant;

/// The contents of `--out`.
#[derive(Clone, Copy, Debug)]
enum OutKind {
    Answer,
    Poses,
}

/// The files to write.
struct Targets {
    out: Vec<Target<OutKind>>,
    picture: Option<Target<PictureKind>>,
    ants: Option<Target<AntsKind>>,
    #[cfg(feature = "record")]
    record: Option<record::RecordTarget>,
}

/// Carries out `plan`.
pub(crate) fn run(args: &PlanArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    let begun = Instant::now();
    let targets = Targets::of(args)?;
    let settings = settings::load(args.config.as_deref(), &args.set, args.planner)?;
    let mut scene = scene::load(&args.scene)?;
    let config = settings.for_motion(scene.vehicle.vehicle.motion());
    if targets.ants.is_some() {
        ants::check(config.planner())?;
    }
    let motion = args.motion.load(&scene.vehicle.vehicle)?;
    if motion.is_some() && args.stdin {
        return Err(Failure::Input(anyhow!(
            "--stdin: no speed is planned for requests from stdin; hint: plan them one by one"
        )));
    }
    let soft_costs = soft_costs::load(args, &mut scene, config.planner())?;
    let defaults = RequestDocument {
        budget_steps: budget_steps(args.budget, config.planner()),
        ..request(args, &scene)
    };
    let n_threads = args.threads.map_or(1, |n| n as usize);
    let mut session = Session::new(scene, config, begun)?.with_threads(n_threads);
    session.spacing = args.spacing.unwrap_or_default();
    if let Some(costs) = soft_costs {
        session.planner = session.planner.with_soft_costs(&costs);
    }
    if targets.ants.is_some() {
        session.keep_ants();
    }
    if args.stdin {
        return stdin::run(&mut session, &defaults, Seed(args.seed), out);
    }
    let mut answered = session.ask(&defaults, &RequestDocument::default(), Seed(args.seed));
    let driven = match motion {
        Some(motion) => drive(&session, &mut answered, motion)?,
        None => None,
    };
    if answered.ending() != Ending::Refused {
        write_files(&session, &answered, driven.as_ref(), &targets)?;
    }
    if args.json {
        print_json(out, &answered.answer)?;
    } else if let Err(error) = answered.result {
        return Err(Failure::Input(error.into()));
    } else {
        let vehicle = &session.scene.vehicle.vehicle;
        summary::write(&answered.answer, vehicle, answered.n_improvements, out)?;
    }
    Ok(match driven {
        // A path that cannot be driven now is none.
        Some((_, Driven { plan: None, .. })) => Ending::NoPath,
        _ => answered.ending(),
    })
}

/// The note of a path that was chosen for its time.
const AROUND: &str = "the path leads around moving obstacles: to wait for them would take longer";

/// Plans the speed along the path found; the answer gets the drive.
fn drive(
    session: &Session,
    answered: &mut Answered,
    motion: Motion,
) -> Result<Option<(Motion, Driven)>> {
    let Ok(Outcome::Found(plan)) = &answered.result else {
        return Ok(None);
    };
    let (obstacles, vehicle) = (&session.obstacles, &session.scene.vehicle.vehicle);
    let mut driven = motion.drive(obstacles, vehicle, &plan.path)?;
    let asked = answered.answer.provenance.request.as_ref();
    let request = asked.and_then(|r| r.onto(&RequestDocument::default()).ok());
    if let Some(request) = request {
        let seed = Seed(answered.answer.seed);
        if let Some(way) = motion.around(session, (&request, seed), &driven)? {
            driven = motion.driven(way.drive);
            let notes = [AROUND.to_owned()].into_iter();
            let result = Ok(Outcome::Found(Box::new(way.plan)));
            let timing = answered.answer.timing;
            let answer = session
                .context()
                .answer(Some(&request), seed, &result, timing);
            let notes = notes.chain(answer.notes.clone()).collect();
            answered.answer = answer.with_notes(notes);
            answered.result = result;
        }
    }
    let record = driven.record.clone();
    answered.answer = answered
        .answer
        .clone()
        .with_motion(record, obstacles, vehicle);
    Ok(Some((motion, driven)))
}

impl Targets {
    fn of(args: &PlanArgs) -> Result<Self> {
        let out_kinds = [("json", OutKind::Answer), ("csv", OutKind::Poses)];
        let out = args.out.iter().map(|path| Target::new(path, &out_kinds));
        Ok(Self {
            out: out.collect::<Result<_>>()?,
            picture: Target::of(args.picture.as_deref(), &picture::KINDS)?,
            ants: Target::of(args.ants.as_deref(), &ants::KINDS)?,
            #[cfg(feature = "record")]
            record: record::target(args.record.as_deref())?,
        })
    }
}

/// The request of the flags; the scenario or built-in map supplies missing ends.
fn request(args: &PlanArgs, scene: &Scene) -> RequestDocument {
    let [start, goal] = match scene.ends {
        Some([start, goal]) => [Some(start), Some(goal)],
        None => [None, None],
    };
    let list = |pose: Pose2| [pose.x, pose.y, pose.heading];
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
        start_contact: args.escape.then_some(StartContact::Escape),
        goal_heading: args.modes.goal_heading,
        deadline_ms: args.deadline,
        budget_steps: None,
        seed: Some(args.seed),
    }
}

/// Steps by default: no query that is known of takes over 5 s of processor time to get there.
const DEFAULT_BUDGET_STEPS: u64 = 200_000;

/// The budget asked for; of searches whose steps are motions of a vehicle, one by default.
fn budget_steps(asked: Option<Budget>, planner: PlannerName) -> Option<u64> {
    let drives = matches!(planner, PlannerName::Formicar | PlannerName::HybridAstar);
    match asked {
        Some(Budget::Steps(n_steps)) => Some(n_steps),
        Some(Budget::None) => None,
        None => drives.then_some(DEFAULT_BUDGET_STEPS),
    }
}

fn via_record(args: &PlanArgs, via: &ViaPoint) -> ViaRecord {
    ViaRecord::from(&ViaPoint {
        tolerance: args.via_tolerance.unwrap_or(via.tolerance),
        ..*via
    })
}

/// The picture of a plan, with its drive in time if there is one.
fn drawn(
    session: &Session,
    answered: &Answered,
    (outcome, driven): (&Outcome, Option<&(Motion, Driven)>),
    kind: PictureKind,
) -> Result<Vec<u8>> {
    let scene = &session.scene;
    let image = picture::of(
        scene,
        &session.obstacles,
        &answered.answer,
        outcome,
        Layout::Page,
    );
    let drive = driven.and_then(|(motion, driven)| Some((motion, driven.plan.as_ref()?)));
    let image = match drive {
        Some((motion, plan)) => image.with_motion(
            &plan.motion,
            motion.predictions(),
            &scene.vehicle.vehicle,
            motion.max_speed_mps(),
        ),
        None => image,
    };
    picture::encode(&image, kind)
}

fn write_files(
    session: &Session,
    answered: &Answered,
    driven: Option<&(Motion, Driven)>,
    targets: &Targets,
) -> Result<()> {
    for target in &targets.out {
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
        target.write(&drawn(session, answered, (outcome, driven), target.kind)?)?;
    }
    #[cfg(feature = "record")]
    if let Some(target) = &targets.record {
        match outcome {
            Outcome::Found(plan) => record::write(&session.scene, &plan.path, target)?,
            Outcome::NotFound(_) => not_written("no path", target),
        }
    }
    if let (Some(target), Some(kept)) = (&targets.ants, &session.ants) {
        if kept.frames().is_empty() {
            not_written("no ants walked", target);
        } else {
            let frames = kept.frames();
            let file = ants::encode(
                &session.scene,
                &answered.answer,
                outcome,
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

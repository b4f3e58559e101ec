//! A planner with the scene it was prepared for, and its answers to requests.

use crate::failure::Ending;
use crate::scene::Scene;
use anyhow::Result;
use formicar::collision::ObstacleMap;
use formicar::geometry::Pose2;
use formicar::numeric::Seed;
use formicar::path::Spacing;
use formicar::planner::{
    Answer, AnswerContext, NotFound, Outcome, PlanError, Planner, PlannerConfig, RequestDocument,
    Timing,
};
use formicar::progress::{AntFrames, Status, StdClock};
use formicar::scenario::Request;
use std::sync::Arc;
use std::time::Instant;

/// A prepared planner and the scene it plans in.
pub(crate) struct Session {
    pub(crate) planner: Planner,
    pub(crate) scene: Scene,
    pub(crate) obstacles: Arc<ObstacleMap>,
    /// The ants of the last query, if they are kept.
    pub(crate) ants: Option<AntFrames>,
    /// How close the poses of its paths lie.
    pub(crate) spacing: Spacing,
    map_setup_s: f64,
    begun: Instant,
}

/// One answered query.
pub(crate) struct Answered {
    pub(crate) answer: Answer,
    pub(crate) result: Result<Outcome, PlanError>,
    pub(crate) n_improvements: u32,
}

impl Session {
    /// Prepares a planner; `begun` is when the command began.
    pub(crate) fn new(scene: Scene, config: PlannerConfig, begun: Instant) -> Result<Self> {
        let setup = Instant::now();
        let planner = Planner::new(&scene.map, scene.vehicle.vehicle.clone(), config)?;
        Ok(Self {
            obstacles: planner.obstacles().clone(),
            planner,
            scene,
            ants: None,
            spacing: Spacing::default(),
            map_setup_s: setup.elapsed().as_secs_f64(),
            begun,
        })
    }

    pub(crate) fn with_threads(self, n_threads: usize) -> Self {
        Self {
            planner: self.planner.with_threads(n_threads),
            ..self
        }
    }

    /// Keeps the ants of every query from now on, until the next query.
    pub(crate) fn keep_ants(&mut self) {
        let frame = self.obstacles.frame();
        self.ants = Some(AntFrames::new(frame.n_cols(), frame.n_rows()));
    }

    /// Plans one request; what it leaves out comes from `defaults`.
    pub(crate) fn ask(
        &mut self,
        request: &RequestDocument,
        defaults: &RequestDocument,
        seed: Seed,
    ) -> Answered {
        let request = request.onto(defaults).map_err(PlanError::from);
        self.plan(request, seed)
    }

    /// Plans a request, or answers one that cannot be asked.
    pub(crate) fn plan(&mut self, request: Result<Request, PlanError>, seed: Seed) -> Answered {
        let mut watch = (StdClock::start(), self.ants.as_mut());
        let asked = request.as_ref().ok().cloned();
        let result = request.and_then(|request| self.planner.plan(&request, seed, &mut watch));
        let clock = watch.0;
        let blocked = &self.scene.blocked;
        let contact = asked.as_ref().map(|request| request.start_contact);
        let contact = contact.unwrap_or_default();
        let result = result.map_err(|error| match error {
            PlanError::Scenario(error) => PlanError::Scenario(blocked.named(error, contact)),
            error => error,
        });
        let result = result.map(|outcome| match (outcome, &asked) {
            (Outcome::NotFound(failure), Some(request)) => {
                Outcome::NotFound(Box::new(self.with_advice(*failure, request)))
            }
            (outcome, _) => outcome,
        });
        let timing = Timing {
            map_setup_s: self.map_setup_s,
            first_feasible_s: clock.first_path().map(|time| time.as_secs_f64()),
            query_s: clock.now().as_secs_f64(),
            total_s: self.begun.elapsed().as_secs_f64(),
        };
        Answered {
            answer: self.context().answer(asked.as_ref(), seed, &result, timing),
            result,
            n_improvements: clock.n_paths().saturating_sub(1),
        }
    }

    /// A failure with advice on unknown ground, where that is what separates.
    fn with_advice(&self, mut failure: NotFound, request: &Request) -> NotFound {
        let frame = self.obstacles.frame();
        let cell = |pose: Pose2| frame.cell_at(pose.position());
        if let (Status::NoPath, Some(from), Some(to)) =
            (failure.status, cell(request.start), cell(request.goal))
        {
            let vehicle = &self.scene.vehicle.vehicle;
            let blocked = &self.scene.blocked;
            if let Some(hint) = blocked.hint(&failure.explanation, vehicle, [from, to]) {
                failure.reason = format!("{}; hint: {hint}", failure.reason);
            }
        }
        failure
    }

    /// The part that all answers of this session share.
    pub(crate) fn context(&self) -> AnswerContext<'_> {
        AnswerContext {
            planner: &self.planner,
            map: self.scene.record.clone(),
            vehicle_name: &self.scene.vehicle.name,
            spacing: self.spacing,
        }
    }
}

impl Answered {
    /// How a command ends that gives this answer.
    pub(crate) fn ending(&self) -> Ending {
        match &self.result {
            Ok(Outcome::Found(_)) => Ending::Done,
            Ok(Outcome::NotFound(_)) => Ending::NoPath,
            Err(_) => Ending::Refused,
        }
    }
}

//! A client: its scene and two slots of plans; it carries out orders one after another.

use crate::command_line;
use crate::outbox::Outbox;
use crate::plan_observer::{PlanObserver, PlanTicket};
use crate::plan_slot::{FinishedPlan, SlotState};
use crate::protocol::{
    ClientMessage, DriveLaw, PictureFormat, PlanOrder, ServerMessage, Slot, StagesRecord,
};
use crate::scene::Scene;
use crate::state::Studio;
use crate::wanted::WantedPlans;
use formicar::numeric::Seed;
use formicar::path::{CurvePath, Spacing};
use formicar::planner::{AnswerContext, PlanError, RequestDocument, Timing};
use formicar::render::{AnswerPicture, Layout, answer_picture};
use formicar::scenario::Request;
use formicar::tracking::{Controller, PurePursuit, Stanley, TrackingConfig, track};
use serde_json::json;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::runtime::Handle;
use tokio::sync::mpsc::Receiver;

/// Width of a PNG, pixels.
const PNG_WIDTH_PX: u32 = 1600;

/// A client.
pub(crate) struct Session {
    studio: Arc<Studio>,
    outbox: Arc<Outbox>,
    wanted: Arc<WantedPlans>,
    scene: Option<Scene>,
    slots: [SlotState; 2],
}

/// The reason for refusing an order; the page shows it.
type Refusal = String;

/// The refusal of an order that needs a map.
const NO_MAP: &str = "no map is open; hint: open one first";
/// The refusal of an order that needs a path.
const NO_PLAN: &str = "there is no path yet; hint: plan one first";

impl Session {
    pub(crate) fn new(studio: Arc<Studio>, outbox: Arc<Outbox>, wanted: Arc<WantedPlans>) -> Self {
        Self {
            studio,
            outbox,
            wanted,
            scene: None,
            slots: Default::default(),
        }
    }

    /// Carries out orders until the client leaves. Blocks; the thread must belong to a runtime.
    pub(crate) fn run(mut self, orders: &mut Receiver<Result<ClientMessage, Refusal>>) {
        let version = env!("CARGO_PKG_VERSION");
        self.outbox.put(ServerMessage::Hello { version }.text());
        while let Some(order) = orders.blocking_recv() {
            if self.outbox.is_closed() {
                return;
            }
            let ((about, plan), done) = match order {
                Ok(order) => (subject(&order), self.carry_out(order)),
                Err(refusal) => (("message", None), Err(refusal)),
            };
            if let Err(message) = done {
                let error = ServerMessage::Error {
                    about,
                    message,
                    plan,
                };
                self.outbox.put(error.text());
            }
        }
    }

    fn carry_out(&mut self, order: ClientMessage) -> Result<(), Refusal> {
        match order {
            ClientMessage::OpenMap { map } => {
                let opened = self.studio.maps.open(&map)?;
                let scene = Scene::new(opened, self.scene.take());
                self.outbox.put(scene.map_message());
                self.outbox.put(scene.vehicle_message());
                self.scene = Some(scene);
                self.slots = Default::default();
                Ok(())
            }
            ClientMessage::SetVehicle { vehicle } => {
                let scene = self.scene.as_mut().ok_or(NO_MAP)?;
                scene.set_vehicle(&vehicle)?;
                self.outbox.put(scene.vehicle_message());
                self.slots = Default::default();
                Ok(())
            }
            ClientMessage::Paint { region, values } => {
                let scene = self.scene.as_mut().ok_or(NO_MAP)?;
                let planners = self.slots.iter_mut();
                let planners = planners.filter_map(|slot| slot.planner.as_mut());
                scene.paint(region, &values, planners)
            }
            ClientMessage::Plan(order) => self.plan(&order),
            // The task that reads messages has cancelled the plan already.
            ClientMessage::Cancel { .. } => Ok(()),
            ClientMessage::Drive {
                slot,
                law,
                speed_mps,
            } => self.drive(slot, law, speed_mps),
            ClientMessage::Picture { slot, format } => self.picture(slot, format),
            ClientMessage::KeepMap => {
                let scene = self.scene.as_ref().ok_or(NO_MAP)?;
                let grid = scene.grid.clone();
                let kept = self.studio.maps.keep(&scene.opened.name, grid)?;
                let hash = kept.hash.as_deref().unwrap_or_default();
                self.outbox.put(ServerMessage::Kept { hash }.text());
                Ok(())
            }
        }
    }

    fn plan(&mut self, order: &PlanOrder) -> Result<(), Refusal> {
        let PlanOrder { plan, slot, .. } = *order;
        let (wanted, outbox) = (self.wanted.clone(), self.outbox.clone());
        let ticket = PlanTicket {
            plan,
            slot,
            with_frames: order.watch,
            wanted: &wanted,
            outbox: &outbox,
        };
        let studio = self.studio.clone();
        let permit = wanted.permit(&studio.plans, || ticket.is_wanted());
        let Some(_permit) = Handle::current().block_on(permit) else {
            outbox.put(ServerMessage::Dropped { plan, slot }.text());
            return Ok(());
        };
        let done = self.make(order, ticket)?;
        self.send_answer(&done, order);
        self.slots[slot.index()].last = Some(done);
        Ok(())
    }

    /// Makes a plan.
    fn make(&mut self, order: &PlanOrder, ticket: PlanTicket) -> Result<FinishedPlan, Refusal> {
        let setup = Instant::now();
        let config = serde_json::from_value(order.config.clone())
            .map_err(|error| format!("the planner's parameters: {error}"))?;
        let scene = self.scene.as_ref().ok_or(NO_MAP)?;
        let state = &mut self.slots[order.slot.index()];
        let previous = order.previous.map(|plan| state.path(plan)).transpose()?;
        let planner = state.prepare(scene, config, &self.studio.planners)?;
        let map_setup_s = setup.elapsed().as_secs_f64();

        let mut observer = PlanObserver::new(ticket, *scene.obstacles.frame());
        let longest = self.studio.options.limits.max_plan;
        let seed = Seed(order.seed);
        let (request, result) = match within(&order.request, longest) {
            Err(error) => (None, Err(error)),
            Ok(request) => {
                let result = match &previous {
                    Some(path) => planner.replan(&request, path, seed, &mut observer),
                    None => planner.plan(&request, seed, &mut observer),
                };
                (Some(request), result)
            }
        };
        let (first_feasible_s, query_s) = observer.times_s();
        let timing = Timing {
            map_setup_s,
            first_feasible_s,
            query_s,
            total_s: setup.elapsed().as_secs_f64(),
        };
        let context = AnswerContext {
            planner,
            map: scene.record(),
            vehicle_name: &scene.vehicle_name,
            spacing: Spacing::default(),
        };
        let answer = context.answer(request.as_ref(), seed, &result, timing);
        self.studio.planners.keep(scene, planner);
        Ok(FinishedPlan {
            plan: order.plan,
            answer,
            outcome: result.ok(),
        })
    }

    /// Sends the answer of a plan that has ended.
    fn send_answer(&self, done: &FinishedPlan, order: &PlanOrder) {
        let Some(scene) = &self.scene else {
            return;
        };
        let config = done
            .answer
            .provenance
            .config
            .as_ref()
            .and_then(|config| config.known());
        let answer = ServerMessage::Answer {
            plan: done.plan,
            slot: order.slot,
            answer: &done.answer,
            history: done.history(),
            stages: if order.watch {
                done.stages_record()
            } else {
                StagesRecord::default()
            },
            tightest: done.tightest(scene),
            cli: command_line::line(&done.answer, &order.request, scene.file(), order.seed),
            toml: config.map_or_else(String::new, command_line::toml),
        };
        self.outbox.put(answer.text());
    }

    fn drive(&self, slot: Slot, law: DriveLaw, speed_mps: Option<f64>) -> Result<(), Refusal> {
        let scene = self.scene.as_ref().ok_or(NO_MAP)?;
        let (done, path) = self.found(slot)?;
        let config = TrackingConfig {
            controller: match law {
                DriveLaw::OpenLoop => Controller::OpenLoop,
                DriveLaw::PurePursuit => Controller::PurePursuit(PurePursuit::default()),
                DriveLaw::Stanley => Controller::Stanley(Stanley::default()),
            },
            speed_mps,
            ..TrackingConfig::default()
        };
        let driven = track(path, &scene.vehicle, &config).map_err(|error| error.to_string())?;
        let clearance = driven.clearance(&scene.obstacles, &scene.vehicle);
        let document = driven.document(&clearance);
        let contact = clearance.contact.map(|contact| {
            let point = scene.obstacles.contact(&scene.vehicle, contact.pose);
            json!({ "x": point.x, "y": point.y, "t_s": contact.t_s })
        });
        let message = ServerMessage::Driven {
            slot,
            plan: done.plan,
            law,
            tracked: document.tracked,
            status: document.status.name(),
            summary: json!(document.summary),
            min_clearance_m: Some(clearance.min_clearance_m).filter(|m| m.is_finite()),
            contact,
            trace: json!(document.trace),
        };
        self.outbox.put(message.text());
        Ok(())
    }

    fn picture(&self, slot: Slot, format: PictureFormat) -> Result<(), Refusal> {
        let scene = self.scene.as_ref().ok_or(NO_MAP)?;
        let done = self.slots[slot.index()].last.as_ref().ok_or(NO_PLAN)?;
        let outcome = done.outcome.as_ref().ok_or(NO_PLAN)?;
        let report = outcome.judged().map(|(_, report)| report);
        let picture = AnswerPicture {
            map: &scene.grid,
            vehicle: &scene.vehicle,
            answer: &done.answer,
            outcome,
            contact: report.map(|r| scene.obstacles.contact(&scene.vehicle, r.tightest)),
        };
        let picture = answer_picture(&picture, Layout::Page);
        let file = match format {
            PictureFormat::Svg => picture.to_svg().into_bytes(),
            PictureFormat::Png => picture
                .to_png(PNG_WIDTH_PX)
                .map_err(|error| error.to_string())?,
        };
        let message = ServerMessage::Picture { slot, format };
        self.outbox.put(message.with_payload(&file));
        Ok(())
    }

    /// The last plan of a slot and its path.
    fn found(&self, slot: Slot) -> Result<(&FinishedPlan, &CurvePath), Refusal> {
        let done = self.slots[slot.index()].last.as_ref().ok_or(NO_PLAN)?;
        let path = done.path().ok_or(NO_PLAN)?;
        Ok((done, path))
    }
}

/// The request of a document, with a time limit of at most `longest`.
fn within(document: &RequestDocument, longest: Duration) -> Result<Request, PlanError> {
    let request = document.onto(&RequestDocument::default())?;
    let deadline = request.deadline.map_or(longest, |own| own.min(longest));
    Ok(Request {
        deadline: Some(deadline),
        ..request
    })
}

/// The subject of an order and its plan, for the message that refuses it.
fn subject(order: &ClientMessage) -> (&'static str, Option<u64>) {
    match order {
        ClientMessage::OpenMap { .. } | ClientMessage::KeepMap => ("map", None),
        ClientMessage::SetVehicle { .. } => ("vehicle", None),
        ClientMessage::Paint { .. } => ("paint", None),
        ClientMessage::Plan(order) => ("plan", Some(order.plan)),
        ClientMessage::Cancel { .. } => ("cancel", None),
        ClientMessage::Drive { .. } => ("drive", None),
        ClientMessage::Picture { .. } => ("picture", None),
    }
}

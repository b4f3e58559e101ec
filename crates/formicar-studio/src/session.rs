//! One visitor: a map, a vehicle, two slots with warm planners; requests in their order.

use crate::Studio;
use crate::command;
use crate::ground::Ground;
use crate::maps::list;
use crate::outbox::Outbox;
use crate::protocol::{
    ClientMessage, DriveLaw, PictureFormat, PlanOrder, ServerMessage, Slot, StagesRecord, Tightest,
};
use crate::warm::WarmShelf;
use crate::watcher::{Watched, Watcher, cells};
use formicar::map::BitGrid;
use formicar::numeric::Seed;
use formicar::path::CurvePath;
use formicar::planner::{
    Answer, AnswerContext, Outcome, PlanError, Planner, PlannerConfig, RequestDocument, Stages,
    Timing,
};
use formicar::progress::IterationRecord;
use formicar::render::{AnswerPicture, Layout, answer_picture};
use formicar::scenario::Request;
use formicar::tracking::{Controller, PurePursuit, Stanley, TrackingConfig, track};
use serde_json::json;
use std::sync::Arc;
use std::sync::atomic::AtomicU64;
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

/// Width of a PNG, pixels.
const PNG_WIDTH_PX: u32 = 1600;

/// The newest plan that a visitor has asked for in each slot; whoever plans an older one stops.
pub(crate) type Newest = [AtomicU64; 2];

/// One visitor.
pub(crate) struct Session {
    studio: Arc<Studio>,
    outbox: Arc<Outbox>,
    newest: Arc<Newest>,
    ground: Option<Ground>,
    slots: [SlotState; 2],
}

/// What is kept of a slot.
#[derive(Default)]
struct SlotState {
    planner: Option<Planner>,
    last: Option<Done>,
}

/// A plan that has ended.
struct Done {
    plan: u64,
    answer: Answer,
    outcome: Option<Outcome>,
}

/// Why something was not done; the page shows it.
type Refusal = String;

/// Where a map is needed.
const NO_MAP: &str = "no map is open; hint: open one first";
/// Where a path is needed.
const NO_PLAN: &str = "there is no path yet; hint: plan one first";

impl Session {
    pub(crate) fn new(studio: Arc<Studio>, outbox: Arc<Outbox>, newest: Arc<Newest>) -> Self {
        Self {
            studio,
            outbox,
            newest,
            ground: None,
            slots: Default::default(),
        }
    }

    /// Does what is asked for until the visitor leaves.
    pub(crate) fn run(mut self, orders: &Receiver<Result<ClientMessage, Refusal>>) {
        let version = env!("CARGO_PKG_VERSION");
        self.outbox.put(ServerMessage::Hello { version }.text());
        while let Ok(order) = orders.recv() {
            if self.outbox.is_closed() {
                return;
            }
            let ((about, plan), done) = match order {
                Ok(order) => (subject(&order), self.obey(order)),
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

    fn obey(&mut self, order: ClientMessage) -> Result<(), Refusal> {
        match order {
            ClientMessage::OpenMap { map } => {
                let opened = self.studio.maps.open(&map)?;
                let ground = Ground::new(opened, self.ground.take());
                self.outbox.put(ground.map_message());
                self.outbox.put(ground.vehicle_message());
                self.ground = Some(ground);
                self.slots = Default::default();
                Ok(())
            }
            ClientMessage::SetVehicle { vehicle } => {
                let ground = self.ground.as_mut().ok_or(NO_MAP)?;
                ground.set_vehicle(&vehicle)?;
                self.outbox.put(ground.vehicle_message());
                self.slots = Default::default();
                Ok(())
            }
            ClientMessage::Paint { region, values } => {
                let ground = self.ground.as_mut().ok_or(NO_MAP)?;
                let planners = self.slots.iter_mut();
                let planners = planners.filter_map(|slot| slot.planner.as_mut());
                ground.paint(region, &values, planners)
            }
            ClientMessage::Plan(order) => self.plan(&order),
            // Whoever reads the messages has told the plan already.
            ClientMessage::Cancel { .. } => Ok(()),
            ClientMessage::Drive {
                slot,
                law,
                speed_mps,
            } => self.drive(slot, law, speed_mps),
            ClientMessage::Picture { slot, format } => self.picture(slot, format),
            ClientMessage::KeepMap => {
                let ground = self.ground.as_ref().ok_or(NO_MAP)?;
                let grid = ground.grid.clone();
                let kept = self.studio.maps.keep(&ground.opened.name, grid)?;
                let hash = kept.hash.as_deref().unwrap_or_default();
                self.outbox.put(ServerMessage::Kept { hash }.text());
                Ok(())
            }
        }
    }

    fn plan(&mut self, order: &PlanOrder) -> Result<(), Refusal> {
        let PlanOrder { plan, slot, .. } = *order;
        let (newest, outbox) = (self.newest.clone(), self.outbox.clone());
        let watched = Watched {
            plan,
            slot,
            with_frames: order.watch,
            newest: &newest[slot.index()],
            outbox: &outbox,
        };
        let studio = self.studio.clone();
        let desk = studio.desks.sit_down(|| watched.is_wanted());
        let Some(_desk) = desk.filter(|_| watched.is_wanted()) else {
            outbox.put(ServerMessage::Dropped { plan, slot }.text());
            return Ok(());
        };
        let done = self.make(order, watched)?;
        self.tell(&done, order);
        self.slots[slot.index()].last = Some(done);
        Ok(())
    }

    /// Makes a plan.
    fn make(&mut self, order: &PlanOrder, watched: Watched) -> Result<Done, Refusal> {
        let setup = Instant::now();
        let config = serde_json::from_value(order.config.clone())
            .map_err(|error| format!("the planner's parameters: {error}"))?;
        let ground = self.ground.as_ref().ok_or(NO_MAP)?;
        let state = &mut self.slots[order.slot.index()];
        let previous = order.previous.map(|plan| state.path(plan)).transpose()?;
        let planner = state.warm(ground, config, &self.studio.warm)?;
        let map_setup_s = setup.elapsed().as_secs_f64();

        let mut watcher = Watcher::new(watched, *ground.obstacles.frame());
        let longest = self.studio.options.limits.max_plan;
        let seed = Seed(order.seed);
        let (request, result) = match within(&order.request, longest) {
            Err(error) => (None, Err(error)),
            Ok(request) => {
                let result = match &previous {
                    Some(path) => planner.replan(&request, path, seed, &mut watcher),
                    None => planner.plan(&request, seed, &mut watcher),
                };
                (Some(request), result)
            }
        };
        let (first_feasible_s, query_s) = watcher.times_s();
        let timing = Timing {
            map_setup_s,
            first_feasible_s,
            query_s,
            total_s: setup.elapsed().as_secs_f64(),
        };
        let config = planner.config();
        let context = AnswerContext {
            obstacles: &ground.obstacles,
            map: ground.record(),
            vehicle: &ground.vehicle,
            vehicle_name: &ground.vehicle_name,
            config,
        };
        let answer = context.answer(request.as_ref(), seed, &result, timing);
        self.studio.warm.keep(ground, planner);
        Ok(Done {
            plan: order.plan,
            answer,
            outcome: result.ok(),
        })
    }

    /// Tells how a plan has ended.
    fn tell(&self, done: &Done, order: &PlanOrder) {
        let Some(ground) = &self.ground else {
            return;
        };
        let stages = done.outcome.as_ref().map(Outcome::stages);
        let answer = ServerMessage::Answer {
            plan: done.plan,
            slot: order.slot,
            answer: &done.answer,
            history: stages.map_or(&[][..], history),
            stages: stages
                .filter(|_| order.watch)
                .map_or_else(StagesRecord::default, stages_record),
            tightest: done.tightest(ground),
            cli: command::line(&done.answer, &order.request, ground.file(), order.seed),
            toml: command::toml(&done.answer.provenance.config),
        };
        self.outbox.put(answer.text());
    }

    fn drive(&self, slot: Slot, law: DriveLaw, speed_mps: Option<f64>) -> Result<(), Refusal> {
        let ground = self.ground.as_ref().ok_or(NO_MAP)?;
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
        let driven = track(path, &ground.vehicle, &config).map_err(|error| error.to_string())?;
        let clearance = driven.clearance(&ground.obstacles, &ground.vehicle);
        let document = driven.document(&clearance);
        let contact = clearance.contact.map(|contact| {
            let place = ground.obstacles.contact(&ground.vehicle, contact.pose);
            json!({ "x": place.x, "y": place.y, "t_s": contact.t_s })
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
        let ground = self.ground.as_ref().ok_or(NO_MAP)?;
        let done = self.slots[slot.index()].last.as_ref().ok_or(NO_PLAN)?;
        let outcome = done.outcome.as_ref().ok_or(NO_PLAN)?;
        let report = outcome.judged().map(|(_, report)| report);
        let picture = AnswerPicture {
            map: &ground.grid,
            vehicle: &ground.vehicle,
            answer: &done.answer,
            outcome,
            contact: report.map(|r| ground.obstacles.contact(&ground.vehicle, r.tightest)),
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
    fn found(&self, slot: Slot) -> Result<(&Done, &CurvePath), Refusal> {
        let done = self.slots[slot.index()].last.as_ref().ok_or(NO_PLAN)?;
        let path = done.path().ok_or(NO_PLAN)?;
        Ok((done, path))
    }
}

impl SlotState {
    /// The path of a plan.
    fn path(&self, plan: u64) -> Result<CurvePath, Refusal> {
        let done = self.last.as_ref().filter(|done| done.plan == plan);
        let path = done.and_then(Done::path).cloned();
        path.ok_or_else(|| {
            format!("previous: {plan} is not the last plan of its slot that has a path")
        })
    }

    /// The planner of this slot, made anew where it has other parameters.
    fn warm(
        &mut self,
        ground: &Ground,
        config: PlannerConfig,
        shelf: &WarmShelf,
    ) -> Result<&mut Planner, Refusal> {
        let fits = |planner: &Planner| *planner.config() == config;
        let kept = self.planner.take().filter(fits);
        let planner = kept.map_or_else(|| shelf.planner(ground, config), Ok);
        Ok(self
            .planner
            .insert(planner.map_err(|error| error.to_string())?))
    }
}

impl Done {
    fn path(&self) -> Option<&CurvePath> {
        match self.outcome.as_ref()? {
            Outcome::Found(plan) => Some(&plan.path),
            Outcome::NotFound(_) => None,
        }
    }

    fn tightest(&self, ground: &Ground) -> Option<Tightest> {
        let (_, report) = self.outcome.as_ref()?.judged()?;
        let place = ground.obstacles.contact(&ground.vehicle, report.tightest);
        Some(Tightest {
            x: place.x,
            y: place.y,
            clearance_m: report.min_clearance_m,
            pose: list(report.tightest),
        })
    }
}

/// A request that ends after some time, if not by itself.
fn within(document: &RequestDocument, longest: Duration) -> Result<Request, PlanError> {
    let request = document.onto(&RequestDocument::default())?;
    let deadline = request.deadline.map_or(longest, |own| own.min(longest));
    Ok(Request {
        deadline: Some(deadline),
        ..request
    })
}

/// What an order is about, where it cannot be done.
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

fn history(stages: &Stages) -> &[IterationRecord] {
    let colony = stages.colony.as_ref().map(|run| &run.history);
    let history = colony.or(stages.evolution.as_ref().map(|run| &run.history));
    history.map_or(&[], |history| &history.iterations)
}

fn stages_record(stages: &Stages) -> StagesRecord {
    let set = |set: &BitGrid| set.iter().flat_map(|cell| [cell.col, cell.row]).collect();
    let layers = stages.layers.as_ref();
    StagesRecord {
        expanded: layers.map(|layers| set(&layers.expanded)),
        closed: layers.map(|layers| set(&layers.closed)),
        grid_path: stages.grid_path.as_ref().map(|path| cells(&path.cells)),
        nodes: (!stages.nodes.is_empty()).then(|| cells(&stages.nodes)),
    }
}

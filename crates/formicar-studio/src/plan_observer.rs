//! The observer of a plan: it sends what happens to the page as frames while the plan goes on.

use crate::outbox::Outbox;
use crate::protocol::{ServerMessage, Slot};
use crate::wanted::WantedPlans;
use formicar::geometry::{Arc, Point2, Pose2};
use formicar::map::{Cell, GridFrame};
use formicar::path::{CurvePath, Direction};
use formicar::progress::{
    AntFrame, ColonyView, DriveView, DriveWay, Event, Observer, PopulationView, ReachedView,
    Traffic,
};
use std::time::{Duration, Instant};

/// Distance between points of a path or way that is sent, meters.
const SPACING_M: f64 = 0.25;
/// The most motions of hybrid A* that are sent.
const MAX_MOTIONS: usize = 60_000;
/// Bytes of pheromone after which only every second of the iterations sent so far is sent.
const STRIDE_BYTES: usize = 8 << 20;

/// A plan that a client waits for.
#[derive(Clone, Copy)]
pub(crate) struct PlanTicket<'a> {
    pub(crate) plan: u64,
    pub(crate) slot: Slot,
    /// Whether the client wants frames of the search.
    pub(crate) with_frames: bool,
    pub(crate) wanted: &'a WantedPlans,
    pub(crate) outbox: &'a Outbox,
}

impl PlanTicket<'_> {
    /// Whether the client still waits for it.
    pub(crate) fn is_wanted(&self) -> bool {
        self.wanted.is_newest(self.slot, self.plan) && !self.outbox.is_closed()
    }
}

/// The observer of a plan.
pub(crate) struct PlanObserver<'a> {
    ticket: PlanTicket<'a>,
    frame: GridFrame,
    begun: Instant,
    first: Option<Duration>,
    n_motions: usize,
    /// Every `stride`-th iteration is sent.
    stride: u32,
    /// Iterations sent with this stride.
    n_sent: usize,
}

impl<'a> PlanObserver<'a> {
    /// An observer of a plan that begins now.
    pub(crate) fn new(ticket: PlanTicket<'a>, frame: GridFrame) -> Self {
        Self {
            ticket,
            frame,
            begun: Instant::now(),
            first: None,
            n_motions: 0,
            stride: 1,
            n_sent: 0,
        }
    }

    /// Times since the plan began: to the first certified path, if there was one, and to now, seconds.
    pub(crate) fn times_s(&self) -> (Option<f64>, f64) {
        let first_s = self.first.map(|first| first.as_secs_f64());
        (first_s, self.begun.elapsed().as_secs_f64())
    }

    fn improved(&mut self, path: &CurvePath, n_steps: u64) {
        let at = self.begun.elapsed();
        self.first.get_or_insert(at);
        let poses = path.sample(SPACING_M).into_iter().flat_map(|at| {
            let gear = match at.direction {
                Direction::Forward => 1.0,
                Direction::Reverse => -1.0,
            };
            [
                rounded(at.pose.x),
                rounded(at.pose.y),
                rounded(at.pose.heading),
                gear,
            ]
        });
        let message = ServerMessage::Improved {
            plan: self.ticket.plan,
            slot: self.ticket.slot,
            length_m: path.length_m(),
            n_steps,
            at_ms: at.as_secs_f64() * 1e3,
            poses: poses.collect(),
        };
        self.ticket.outbox.put(message.text());
    }

    /// Sends the fewer of a colony's iterations, the more there are.
    fn iteration(&mut self, view: &ColonyView) {
        if view.record.iteration == 0 {
            (self.stride, self.n_sent) = (1, 0);
        }
        if !view.record.iteration.is_multiple_of(self.stride) {
            return;
        }
        let n_cells = self.frame.n_cells();
        self.n_sent += 1;
        if self.n_sent >= (STRIDE_BYTES / n_cells.max(1)).clamp(4, 64) {
            self.stride = self.stride.saturating_mul(2);
            self.n_sent = 0;
        }
        let (plan, size) = (self.ticket.plan, (self.frame.n_cols(), self.frame.n_rows()));
        self.ticket.outbox.put_frame(|| {
            let frame = AntFrame::of(view, size);
            let best = frame.best.as_ref();
            let message = ServerMessage::Iteration {
                plan,
                record: view.record,
                arrived: passages(&frame.arrived),
                lost: passages(&frame.lost),
                best: best.map_or_else(Vec::new, |path| cells(&path.cells)),
            };
            message.with_payload(&shades(&frame.pheromone))
        });
    }

    fn generation(&self, view: &PopulationView) {
        let lines = |is_free: bool| {
            let lines = view.lines.iter().zip(view.is_free);
            let lines = lines.filter(move |&(_, &free)| free == is_free);
            lines.map(|(line, _)| cells(line)).collect()
        };
        let best = view.best.and_then(|best| view.lines.get(best));
        self.ticket.outbox.put_frame(|| {
            let message = ServerMessage::Generation {
                plan: self.ticket.plan,
                record: view.record,
                free: lines(true),
                colliding: lines(false),
                best: best.map_or_else(Vec::new, cells),
            };
            message.text()
        });
    }

    fn drive(&self, view: &DriveView) {
        let ways = |has_arrived: bool| {
            let ways = view.ways.iter();
            let ways = ways.filter(move |way| way.died_at.is_none() == has_arrived);
            ways.map(|way| self.polyline(way)).collect()
        };
        self.ticket.outbox.put_frame(|| {
            let message = ServerMessage::Drive {
                plan: self.ticket.plan,
                generation: view.generation,
                n_steps: view.n_steps,
                arrived: ways(true),
                died: ways(false),
            };
            message.text()
        });
    }

    fn reached(&mut self, view: &ReachedView) {
        if self.n_motions >= MAX_MOTIONS {
            return;
        }
        self.n_motions += view.motions.len();
        let motion = |&(from, arc): &(Pose2, Arc)| {
            let ends = [from.position(), arc.end_from(from).position()];
            ends.map(|end| self.world(end)).concat()
        };
        self.ticket.outbox.put_frame(|| {
            let message = ServerMessage::Expanded {
                plan: self.ticket.plan,
                n_steps: view.n_steps,
                motions: view.motions.iter().flat_map(motion).collect(),
            };
            message.text()
        });
    }

    fn polyline(&self, way: &DriveWay) -> Vec<f64> {
        let path = CurvePath::from_arcs(way.start, &way.arcs);
        let poses = path.sample(SPACING_M);
        let points = poses.iter().map(|at| self.world(at.pose.position()));
        points.flatten().collect()
    }

    /// The world coordinates of a point in grid coordinates.
    fn world(&self, point: Point2) -> [f64; 2] {
        let world = self.frame.to_world(Pose2::at(point, 0.0));
        [rounded(world.x), rounded(world.y)]
    }
}

impl Observer for PlanObserver<'_> {
    fn on_event(&mut self, event: &Event) {
        if let Event::Improved { path, n_steps, .. } = event {
            return self.improved(path, *n_steps);
        }
        if !self.ticket.with_frames {
            return;
        }
        match event {
            Event::Iteration(view) => self.iteration(view),
            Event::Generation(view) => self.generation(view),
            Event::Drive(view) => self.drive(view),
            Event::Reached(view) => self.reached(view),
            _ => {}
        }
    }

    fn elapsed(&mut self) -> Option<Duration> {
        Some(self.begun.elapsed())
    }

    fn is_cancelled(&mut self) -> bool {
        !self.ticket.is_wanted()
    }

    fn watches_search(&self) -> bool {
        self.ticket.with_frames
    }
}

/// Rounds to a tenth of a millimeter, which is enough to draw and shortens messages.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

/// Columns and rows, alternating.
pub(crate) fn cells<'a>(cells: impl IntoIterator<Item = &'a Cell>) -> Vec<u32> {
    let pairs = cells.into_iter().flat_map(|cell| [cell.col, cell.row]);
    pairs.collect()
}

fn passages(traffic: &[Traffic]) -> Vec<u32> {
    let passages = traffic.iter().flat_map(|traffic| {
        let [a, b] = traffic.cells;
        [a.col, a.row, b.col, b.row, traffic.n_passed]
    });
    passages.collect()
}

/// Pheromone as shades from 1 to 255, logarithmic between its extremes; 0 where no ant can go.
fn shades(pheromone: &[f32]) -> Vec<u8> {
    let known = pheromone
        .iter()
        .filter(|tau| tau.is_finite() && **tau > 0.0);
    let (least, most) = known.fold((f32::INFINITY, 0.0_f32), |(least, most), &tau| {
        (least.min(tau), most.max(tau))
    });
    let span = (most / least).ln().max(f32::MIN_POSITIVE);
    let shade = |&tau: &f32| {
        if tau.is_nan() {
            0
        } else if tau > least {
            1 + (254.0 * (tau / least).ln() / span).round() as u8
        } else {
            1
        }
    };
    pheromone.iter().map(shade).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shades_are_logarithmic() {
        assert_eq!(
            shades(&[f32::NAN, 0.01, 0.1, 1.0, 0.0]),
            [0, 1, 128, 255, 1]
        );
        assert_eq!(shades(&[0.5, 0.5]), [1, 1]);
        assert_eq!(shades(&[]), [0_u8; 0]);
    }
}

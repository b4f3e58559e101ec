//! The path of an ant by chords from start to goal.

use super::candidates::{Candidate, Candidates, Standing};
use super::graph::{ChordGraph, Turn};
use super::shared::ChordShared;
use super::transition::Memory;
use crate::colony::generation::Generation;
use crate::colony::worker_pool::{AntWorker, Pace};
use crate::geometry::{Point2, angle_difference};
use crate::map::Cell;
use crate::numeric::{RandomStream, Seed};
use crate::objective::{PolylineCost, SteeringMeter};
use std::ops::Range;

/// The last step of a path, which leads to the goal from anywhere.
pub(super) const TO_GOAL: u8 = u8::MAX;

/// From within this many reaches of the goal, an ant tries to step straight to it.
const GOAL_REACHES: f64 = 2.0;

/// Walks ants, one after the other.
pub(super) struct ChordWorker<'a> {
    graph: &'a ChordGraph<'a>,
    seed: Seed,
    memories: [Memory; 2],
    candidates: Candidates,
    /// The steps of the present ant, except a last one straight to the goal.
    taken: Vec<Candidate>,
    goes_to_goal: bool,
}

/// A cell, and the step that led there; none at the start.
#[derive(Clone, Copy)]
struct Position {
    at: Cell,
    last: Option<usize>,
}

/// Everything besides its memories that an ant's next step depends on.
struct Situation<'a> {
    shared: &'a ChordShared,
    meter: &'a SteeringMeter,
    position: Position,
}

/// Adds a step to the cost so far and to the memories.
fn take(step: &Candidate, meter: &mut SteeringMeter, memories: &mut [Memory; 2]) {
    let Turn {
        needed_rad,
        turn_rad,
    } = step.turn;
    meter.take_needing(needed_rad, turn_rad, step.length_m);
    memories[0].push(step.corner);
    memories[1].push(step.quality);
}

impl<'a> ChordWorker<'a> {
    pub(super) fn new(graph: &'a ChordGraph<'a>, seed: Seed) -> Self {
        Self {
            graph,
            seed,
            memories: graph.config.transition.memories(),
            candidates: Candidates::default(),
            taken: Vec::new(),
            goes_to_goal: false,
        }
    }

    /// Walks until the goal, or until no step is left; returns whether the ant arrived, and the
    /// cost of its steps.
    fn walk(
        &mut self,
        shared: &ChordShared,
        stream: &mut RandomStream,
        pace: &mut Pace,
    ) -> (bool, SteeringMeter) {
        let graph = self.graph;
        let (mut meter, mut n_retreats) = (self.go_back(usize::MAX), 0);
        let mut n_left = graph.config.dead_end.max_retreats() as usize;
        while self.taken.len() < graph.max_steps && pace.step() {
            let position = self.position();
            if position.at == graph.goal {
                return (true, meter);
            }
            if let Some((turn_rad, length_m)) = self.goal_step(position, &meter) {
                meter.take(turn_rad, length_m);
                self.goes_to_goal = true;
                return (true, meter);
            }
            let situation = Situation {
                shared,
                meter: &meter,
                position,
            };
            if let Some(chosen) = self.choose(&situation, stream) {
                take(&chosen, &mut meter, &mut self.memories);
                self.taken.push(chosen);
            } else if n_left > 0 && position.last.is_some() {
                // Repeated failures call for longer retreats.
                n_retreats += 1;
                let n_back = (1 + stream.below(2 * n_retreats)).min(n_left);
                n_left -= n_back;
                meter = self.go_back(n_back);
            } else {
                return (false, meter);
            }
        }
        (false, meter)
    }

    /// The ant's position.
    fn position(&self) -> Position {
        let last = self.taken.last();
        Position {
            at: last.map_or(self.graph.start, |last| last.to),
            last: last.map(|last| usize::from(last.step)),
        }
    }

    /// Forgets the last steps, and adds up the cost of those that remain.
    fn go_back(&mut self, n_steps: usize) -> SteeringMeter {
        let n_kept = self.taken.len().saturating_sub(n_steps);
        self.taken.truncate(n_kept);
        self.goes_to_goal = false;
        self.memories.iter_mut().for_each(Memory::forget);
        let mut meter = self.graph.meter.clone();
        for taken in &self.taken {
            take(taken, &mut meter, &mut self.memories);
        }
        meter
    }

    /// The turn and the length of a last step to the goal, where it is near, within the steering
    /// limit, and safe.
    fn goal_step(&self, position: Position, meter: &SteeringMeter) -> Option<(f64, f64)> {
        let graph = self.graph;
        if graph.distance(position.at) > GOAL_REACHES * f64::from(graph.config.reach) {
            return None;
        }
        let (from, to) = (self.point_m(position), graph.center_m(graph.goal));
        let step = to - from;
        let length_m = step.norm();
        let turn_rad = match self.heading_rad(position) {
            Some(heading_rad) => angle_difference(step.angle(), heading_rad),
            None => 0.0,
        };
        let can_turn = graph.asked(turn_rad, length_m).needed_rad <= meter.limit_rad();
        let is_safe = || graph.guard.is_free(graph.problem.obstacles, [from, to]);
        (can_turn && is_safe()).then_some((turn_rad, length_m))
    }

    /// Draws a safe step, if there is one.
    fn choose(&mut self, situation: &Situation, stream: &mut RandomStream) -> Option<Candidate> {
        let chosen = self.draw(situation, stream);
        let position = situation.position;
        if chosen.is_some() || position.last.is_some() || self.heading_rad(position).is_none() {
            return chosen;
        }
        // No safe step begins with the start's heading: the vehicle will have to change gear there.
        let free = (0..self.graph.ring.len()).map(|step| {
            let length_m = self.graph.length_m(step);
            (step, self.graph.asked(0.0, length_m), length_m)
        });
        self.draw_among(situation, stream, free)
    }

    fn draw(&mut self, situation: &Situation, stream: &mut RandomStream) -> Option<Candidate> {
        let (graph, position) = (self.graph, situation.position);
        if let Some(last) = position.last {
            let followers = graph.followers[last].iter().map(|&step| {
                let step = usize::from(step);
                (step, graph.turn(last, step), graph.length_m(step))
            });
            return self.draw_among(situation, stream, followers);
        }
        let heading_rad = self.heading_rad(position);
        let from = self.point_m(position);
        let first = (0..graph.ring.len()).map(|step| {
            let to = super::ring::moved(position.at, graph.ring.moves[step]);
            let chord = graph.center_m(to) - from;
            let turn_rad = heading_rad.map_or(0.0, |h| angle_difference(chord.angle(), h));
            (step, graph.asked(turn_rad, chord.norm()), chord.norm())
        });
        self.draw_among(situation, stream, first)
    }

    fn draw_among(
        &mut self,
        situation: &Situation,
        stream: &mut RandomStream,
        steps: impl Iterator<Item = (usize, Turn, f64)>,
    ) -> Option<Candidate> {
        let (graph, at) = (self.graph, situation.position.at);
        let standing = Standing {
            at,
            number: graph.cells.number(at)?,
            meter: situation.meter,
            memories: &self.memories,
        };
        self.candidates.gather(graph, &standing, steps);
        self.candidates.weigh(graph, &standing, situation.shared);
        let obstacles = graph.problem.obstacles.lethal();
        loop {
            let drawn = self.candidates.draw(stream.unit())?;
            let candidate = *self.candidates.get(drawn);
            let step = usize::from(candidate.step);
            if graph.guard.is_clear(obstacles, at, step, candidate.to) {
                return Some(candidate);
            }
            self.candidates.refuse(drawn);
        }
    }

    /// The ant's position, grid coordinates: the exact start, then cell centers.
    fn point_m(&self, position: Position) -> Point2 {
        match position.last {
            Some(_) => self.graph.center_m(position.at),
            None => self.graph.problem.start.position(),
        }
    }

    /// The heading that the next step turns from; none where it is free.
    fn heading_rad(&self, position: Position) -> Option<f64> {
        let problem = self.graph.problem;
        match position.last {
            Some(last) => Some(self.graph.ring.directions_rad[last]),
            None => problem
                .start_heading_is_exact
                .then_some(problem.start.heading),
        }
    }
}

impl AntWorker for ChordWorker<'_> {
    type Shared = ChordShared;
    type Batch = Generation<PolylineCost>;

    const STEPS_PER_LOOK: u32 = 64;

    fn walk_ants(
        &mut self,
        shared: &ChordShared,
        (iteration, ants): (u32, Range<u32>),
        generation: &mut Generation<PolylineCost>,
        pace: &mut Pace,
    ) {
        let graph = self.graph;
        for ant in ants {
            if pace.is_over() {
                return;
            }
            let mut stream = self.seed.stream([u64::from(iteration), u64::from(ant)]);
            let (arrived, meter) = self.walk(shared, &mut stream, pace);
            let steps = self.taken.iter().map(|taken| taken.step);
            generation.steps.extend(steps);
            generation
                .steps
                .extend(self.goes_to_goal.then_some(TO_GOAL));
            let cost = meter.total(&graph.config.cost, graph.reference.length_m);
            generation.end_ant(arrived, cost);
        }
    }
}

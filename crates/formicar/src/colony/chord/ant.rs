//! An ant's way by chords from start to goal.

use super::candidates::{Candidate, Candidates, Standing};
use super::generation::ChordGeneration;
use super::ground::{Ground, Turn};
use super::transition::Memory;
use crate::colony::crew::Walk;
use crate::geometry::angle_difference;
use crate::map::Cell;
use crate::numeric::{RandomStream, Seed};
use crate::objective::SteeringMeter;
use std::ops::Range;

/// The last step of a way, which leads to the goal wherever it lies.
pub(super) const TO_GOAL: u8 = u8::MAX;

/// The goal is gone for from this many reaches away.
const GOAL_REACHES: f64 = 2.0;

/// What all ants of a generation read and none writes.
#[derive(Clone, Debug)]
pub(super) struct Shared {
    /// Pheromone by number.
    pub(super) tau: Vec<f32>,
    /// Longest and shortest way to the goal found so far by number, cells; 0 and infinite for
    /// none.
    pub(super) known: Vec<[f32; 2]>,
    /// (N - k) / k of generation k of N.
    pub(super) factor: f64,
}

impl Shared {
    /// Longest and shortest known way to the goal from a cell.
    pub(super) fn ways(&self, number: usize) -> Option<[f64; 2]> {
        let ways = self.known[number].map(f64::from);
        (ways[1] <= ways[0]).then_some(ways)
    }
}

/// Sends ants out, one after the other.
pub(super) struct ChordWalker<'a> {
    ground: &'a Ground<'a>,
    seed: Seed,
    memories: [Memory; 2],
    candidates: Candidates,
    /// The steps of the present ant, a last one to the goal aside.
    taken: Vec<Candidate>,
    goes_to_goal: bool,
}

/// Adds a step to what the steps before came to, and to what is remembered of them.
fn take(step: &Candidate, meter: &mut SteeringMeter, memories: &mut [Memory; 2]) {
    let Turn {
        needed_rad,
        turn_rad,
    } = step.turn;
    meter.take_needing(needed_rad, turn_rad, step.length_m);
    memories[0].push(step.corner);
    memories[1].push(step.quality);
}

impl<'a> ChordWalker<'a> {
    pub(super) fn new(ground: &'a Ground<'a>, seed: Seed) -> Self {
        Self {
            ground,
            seed,
            memories: ground.config.transition.memories(),
            candidates: Candidates::default(),
            taken: Vec::new(),
            goes_to_goal: false,
        }
    }

    /// Walks until the goal or until no step is left; whether it is the goal, and how the steps
    /// add up.
    fn walk(&mut self, shared: &Shared, stream: &mut RandomStream) -> (bool, SteeringMeter) {
        let ground = self.ground;
        let (mut meter, mut n_retreats) = (self.go_back(usize::MAX), 0);
        let mut n_left = ground.config.dead_end.max_retreats() as usize;
        while self.taken.len() < ground.max_steps {
            let (at, last) = self.standing();
            if at == ground.goal {
                return (true, meter);
            }
            if let Some((turn_rad, length_m)) = self.goal_step(at, last, &meter) {
                meter.take(turn_rad, length_m);
                self.goes_to_goal = true;
                return (true, meter);
            }
            if let Some(chosen) = self.choose(shared, stream, (at, last), &meter) {
                take(&chosen, &mut meter, &mut self.memories);
                self.taken.push(chosen);
            } else if n_left > 0 && last.is_some() {
                // The farther, the oftener it failed.
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

    /// Where the ant stands, and the step that led there.
    fn standing(&self) -> (Cell, Option<usize>) {
        let last = self.taken.last();
        last.map_or((self.ground.start, None), |last| {
            (last.to, Some(usize::from(last.step)))
        })
    }

    /// Forgets the last steps, and goes through those before again: what they add up to.
    fn go_back(&mut self, n_steps: usize) -> SteeringMeter {
        let n_kept = self.taken.len().saturating_sub(n_steps);
        self.taken.truncate(n_kept);
        self.goes_to_goal = false;
        self.memories.iter_mut().for_each(Memory::forget);
        let mut meter = self.ground.meter.clone();
        for taken in &self.taken {
            take(taken, &mut meter, &mut self.memories);
        }
        meter
    }

    /// The turn and the length of a last step to the goal, where it is near, within the steering
    /// limit, and safe.
    fn goal_step(
        &self,
        at: Cell,
        last: Option<usize>,
        meter: &SteeringMeter,
    ) -> Option<(f64, f64)> {
        let ground = self.ground;
        if ground.distance(at) > GOAL_REACHES * f64::from(ground.config.reach) {
            return None;
        }
        let (from, to) = (self.position_m(at, last), ground.center_m(ground.goal));
        let step = to - from;
        let length_m = step.norm();
        let turn_rad = match self.heading_rad(last) {
            Some(heading_rad) => angle_difference(step.angle(), heading_rad),
            None => 0.0,
        };
        let can_turn = ground.asked(turn_rad, length_m).needed_rad <= meter.limit_rad();
        let is_safe = || ground.guard.is_free(ground.problem.obstacles, [from, to]);
        (can_turn && is_safe()).then_some((turn_rad, length_m))
    }

    /// Draws a safe step; none where there is none.
    fn choose(
        &mut self,
        shared: &Shared,
        stream: &mut RandomStream,
        (at, last): (Cell, Option<usize>),
        meter: &SteeringMeter,
    ) -> Option<Candidate> {
        let chosen = self.draw(shared, stream, (at, last), meter);
        if chosen.is_some() || last.is_some() || self.heading_rad(last).is_none() {
            return chosen;
        }
        // No safe step turns from the start's heading: the vehicle will have to change gear there.
        let free = (0..self.ground.ring.len()).map(|step| {
            let length_m = self.ground.length_m(step);
            (step, self.ground.asked(0.0, length_m), length_m)
        });
        self.draw_among(shared, stream, (at, meter), free)
    }

    fn draw(
        &mut self,
        shared: &Shared,
        stream: &mut RandomStream,
        (at, last): (Cell, Option<usize>),
        meter: &SteeringMeter,
    ) -> Option<Candidate> {
        let ground = self.ground;
        if let Some(last) = last {
            let followers = ground.followers[last].iter().map(|&step| {
                let step = usize::from(step);
                (step, ground.turn(last, step), ground.length_m(step))
            });
            return self.draw_among(shared, stream, (at, meter), followers);
        }
        let heading_rad = self.heading_rad(last);
        let from = self.position_m(at, last);
        let first = (0..ground.ring.len()).map(|step| {
            let to = super::ring::moved(at, ground.ring.moves[step]);
            let chord = ground.center_m(to) - from;
            let turn_rad = heading_rad.map_or(0.0, |h| angle_difference(chord.angle(), h));
            (step, ground.asked(turn_rad, chord.norm()), chord.norm())
        });
        self.draw_among(shared, stream, (at, meter), first)
    }

    fn draw_among(
        &mut self,
        shared: &Shared,
        stream: &mut RandomStream,
        (at, meter): (Cell, &SteeringMeter),
        steps: impl Iterator<Item = (usize, Turn, f64)>,
    ) -> Option<Candidate> {
        let ground = self.ground;
        let standing = Standing {
            at,
            number: ground.cells.number(at)?,
            meter,
            memories: &self.memories,
        };
        self.candidates.gather(ground, &standing, steps);
        self.candidates.weigh(ground, &standing, shared);
        let obstacles = ground.problem.obstacles.lethal();
        loop {
            let drawn = self.candidates.draw(stream.unit())?;
            let candidate = *self.candidates.get(drawn);
            let step = usize::from(candidate.step);
            if ground.guard.is_clear(obstacles, at, step, candidate.to) {
                return Some(candidate);
            }
            self.candidates.refuse(drawn);
        }
    }

    /// Where an ant stands, grid coordinates: on cell centers but at the start.
    fn position_m(&self, at: Cell, last: Option<usize>) -> crate::geometry::Point2 {
        match last {
            Some(_) => self.ground.center_m(at),
            None => self.ground.problem.start.position(),
        }
    }

    /// The heading that the next step turns from; none where it is free.
    fn heading_rad(&self, last: Option<usize>) -> Option<f64> {
        let problem = self.ground.problem;
        match last {
            Some(last) => Some(self.ground.ring.directions_rad[last]),
            None => problem
                .start_heading_is_exact
                .then_some(problem.start.heading),
        }
    }
}

impl Walk for ChordWalker<'_> {
    type Shared = Shared;
    type Part = ChordGeneration;

    fn send(
        &mut self,
        shared: &Shared,
        iteration: u32,
        ants: Range<u32>,
        generation: &mut ChordGeneration,
    ) {
        let ground = self.ground;
        for ant in ants {
            let mut stream = self.seed.stream([u64::from(iteration), u64::from(ant)]);
            let (arrived, meter) = self.walk(shared, &mut stream);
            let steps = self.taken.iter().map(|taken| taken.step);
            generation.steps.extend(steps);
            generation
                .steps
                .extend(self.goes_to_goal.then_some(TO_GOAL));
            let cost = meter.total(&ground.config.cost, ground.reference.length_m);
            generation.end_ant(arrived, cost);
        }
    }
}

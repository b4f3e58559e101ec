//! One ant that drives from the start towards the goal.

use super::DriveConfig;
use super::shared::DriveShared;
use crate::colony::worker_pool::Pace;
use crate::geometry::{Arc, Point2};
use crate::numeric::RandomStream;
use crate::progress::DriveWay;
use crate::search::{DriveProblem, Guide, State};
use std::collections::HashSet;

/// Longest curve to the goal, as a multiple of the distance along the field.
const SHOT_RATIO: f64 = 1.5;
/// Allowance on top of [`SHOT_RATIO`], turning radii.
const SHOT_SLACK_RADII: f64 = 6.0;

/// An ant with the memory of one path, which is reused.
pub(super) struct Ant<'a> {
    problem: DriveProblem<'a>,
    config: DriveConfig,
    /// The states of the path so far.
    states: Vec<State>,
    visited: HashSet<u64>,
    candidates: Vec<Candidate>,
}

#[derive(Clone, Copy)]
struct Candidate {
    step: usize,
    state: State,
    /// Estimated cost of a path through it.
    cost: f64,
    weight: f64,
}

impl<'a> Ant<'a> {
    pub(super) fn new(problem: &DriveProblem<'a>, config: &DriveConfig) -> Self {
        Self {
            problem: problem.clone(),
            config: config.clone(),
            states: Vec::new(),
            visited: HashSet::new(),
            candidates: Vec::new(),
        }
    }

    /// Drives once. A greedy ant always takes the candidate of least estimated cost.
    pub(super) fn drive(
        &mut self,
        shared: &DriveShared,
        start: State,
        (draw, is_greedy): (&mut RandomStream, bool),
        pace: &mut Pace,
    ) -> DriveWay {
        let guide = &shared.guide;
        self.states.clear();
        self.visited.clear();
        self.states.push(start);
        let step_m = self.problem.step_m();
        let to_go_m = guide
            .estimate_m(&self.problem, start.pose.position())
            .unwrap_or(0.0);
        let max_steps = (self.config.detour_ratio * (to_go_m / step_m + 20.0)) as u64;
        let mut n_retreats = 0;
        let mut died_at = None;
        for n_steps in 1..=max_steps {
            let here = self.states[self.states.len() - 1];
            if !pace.step() {
                return self.dead(died_at.or(Some(here.pose.position())), n_steps);
            }
            if self
                .problem
                .wants_shot(guide, here.pose.position(), n_steps)
                && let Some(shot) = self.shot(guide, &here)
            {
                return self.arrived(&shot, n_steps);
            }
            self.look_around(shared, &here);
            if let Some(state) = self.choose(&here, draw, is_greedy) {
                self.visited.insert(self.problem.key(&state));
                self.states.push(state);
                if self.problem.at_goal(state.pose) {
                    return self.arrived(&[], n_steps);
                }
                continue;
            }
            died_at.get_or_insert(here.pose.position());
            n_retreats += 1;
            if n_retreats > self.config.n_retreats || self.states.len() == 1 {
                return self.dead(died_at, n_steps);
            }
            self.states.pop();
        }
        let last = self.states[self.states.len() - 1].pose.position();
        self.dead(died_at.or(Some(last)), max_steps)
    }

    /// A free curve to the goal that is not much longer than the distance along the field.
    fn shot(&self, guide: &Guide, here: &State) -> Option<Vec<Arc>> {
        let to_go_m = guide.estimate_m(&self.problem, here.pose.position())?;
        let (arcs, _) = self.problem.shot(here)?;
        let length_m: f64 = arcs.iter().map(|arc| arc.length_m()).sum();
        let slack_m = SHOT_SLACK_RADII * self.problem.map().radius_m();
        (length_m <= SHOT_RATIO * to_go_m + slack_m).then_some(arcs)
    }

    /// Collects the motions from a state with the estimated cost of a path through each: its own
    /// cost, and the distance along the field from the best position one motion farther.
    fn look_around(&mut self, shared: &DriveShared, here: &State) {
        let (problem, visited) = (&self.problem, &self.visited);
        let candidates = &mut self.candidates;
        candidates.clear();
        problem.successors(here, |step, state| {
            if visited.contains(&problem.key(&state)) {
                return;
            }
            if let Some(ahead) = problem.look_ahead(&shared.guide, &state) {
                candidates.push(Candidate {
                    step,
                    state,
                    cost: state.cost - here.cost + ahead,
                    weight: 0.0,
                });
            }
        });
        let least = candidates
            .iter()
            .fold(f64::INFINITY, |least, c| c.cost.min(least));
        let scale = self.config.beta / problem.step_m();
        let alpha = self.config.trails.alpha;
        for candidate in candidates {
            let Candidate { state, cost, .. } = candidate;
            let tau = shared.trails.at(state.pose, state.arc);
            candidate.weight = (1.0 + alpha * tau) * (-scale * (*cost - least)).exp();
        }
    }

    /// A free motion: the best one, or one drawn by weight. Only a chosen motion is checked; one
    /// that hits something is removed.
    fn choose(&mut self, here: &State, draw: &mut RandomStream, is_greedy: bool) -> Option<State> {
        while !self.candidates.is_empty() {
            let place = if is_greedy {
                self.best()
            } else {
                self.drawn(draw)
            };
            let Candidate { step, state, .. } = self.candidates.remove(place);
            if self.problem.is_free(here, step, state.arc) {
                return Some(state);
            }
        }
        None
    }

    fn best(&self) -> usize {
        let costs = self.candidates.iter().enumerate();
        let best = costs.min_by(|a, b| a.1.cost.total_cmp(&b.1.cost));
        best.map_or(0, |(place, _)| place)
    }

    fn drawn(&self, draw: &mut RandomStream) -> usize {
        let total: f64 = self.candidates.iter().map(|c| c.weight).sum();
        let mut left = draw.unit() * total;
        for (place, candidate) in self.candidates.iter().enumerate() {
            left -= candidate.weight;
            if left < 0.0 {
                return place;
            }
        }
        self.best()
    }

    fn arrived(&self, shot: &[Arc], n_steps: u64) -> DriveWay {
        let driven = self.states[1..].iter().map(|state| state.arc);
        DriveWay {
            start: self.states[0].pose,
            arcs: driven.chain(shot.iter().copied()).collect(),
            died_at: None,
            n_steps,
        }
    }

    fn dead(&self, died_at: Option<Point2>, n_steps: u64) -> DriveWay {
        DriveWay {
            died_at,
            ..self.arrived(&[], n_steps)
        }
    }
}

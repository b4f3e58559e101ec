//! The steps among which an ant chooses, and their weights.

use super::graph::{ChordGraph, Turn};
use super::shared::ChordShared;
use super::transition::Memory;
use crate::map::Cell;
use crate::objective::SteeringMeter;

/// A step that an ant might take.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) step: u8,
    pub(super) to: Cell,
    pub(super) number: u32,
    pub(super) turn: Turn,
    pub(super) length_m: f64,
    /// R of its corner, relative to the best candidate.
    pub(super) corner: f64,
    /// Q of its distance, relative to the best candidate.
    pub(super) quality: f64,
    /// Its weight; 0 once its collision check has failed.
    pub(super) weight: f64,
}

/// The position of an ant and its path so far.
pub(super) struct Standing<'a> {
    pub(super) at: Cell,
    pub(super) number: usize,
    pub(super) meter: &'a SteeringMeter,
    pub(super) memories: &'a [Memory; 2],
}

/// All steps among which an ant chooses.
#[derive(Clone, Debug, Default)]
pub(super) struct Candidates {
    list: Vec<Candidate>,
    /// The largest distance to go among them and from the ant's own cell, cells.
    largest_to_go: f64,
}

impl Candidates {
    /// Gathers the steps that lie in the corridor and within the steering limit.
    pub(super) fn gather(
        &mut self,
        graph: &ChordGraph,
        standing: &Standing,
        steps: impl Iterator<Item = (usize, Turn, f64)>,
    ) {
        let to_go = f64::from(graph.to_go[standing.number]);
        let limit_rad = standing.meter.limit_rad();
        self.list.clear();
        self.largest_to_go = to_go;
        for (step, turn, length_m) in steps {
            if turn.needed_rad > limit_rad {
                continue;
            }
            let Some((to, number)) = graph.step_to(standing.at, step) else {
                continue;
            };
            let after = f64::from(graph.to_go[number]);
            if graph.ring.lengths[step] + after - to_go > graph.step_loss {
                continue;
            }
            self.largest_to_go = self.largest_to_go.max(after);
            self.list.push(Candidate {
                step: step as u8,
                to,
                number: number as u32,
                turn,
                length_m,
                corner: 0.0,
                quality: 0.0,
                weight: 0.0,
            });
        }
    }

    /// Weighs them: Li 2024 (25), times guidance.
    pub(super) fn weigh(&mut self, graph: &ChordGraph, standing: &Standing, shared: &ChordShared) {
        self.rate(graph, standing, shared);
        let config = graph.config;
        let to_go = f64::from(graph.to_go[standing.number]);
        let past = [0, 1].map(|i| standing.memories[i].past());
        for candidate in &mut self.list {
            let number = candidate.number as usize;
            let [corner, quality] = [
                standing.memories[0].derivative(candidate.corner, past[0]),
                standing.memories[1].derivative(candidate.quality, past[1]),
            ];
            let step = graph.ring.lengths[usize::from(candidate.step)];
            let ways = [to_go, f64::from(graph.to_go[number])];
            let guidance = config.guidance.log_factor(step, ways).exp();
            candidate.weight = power(f64::from(shared.tau[number]), config.pheromone_exponent)
                * power(corner, config.corner_exponent)
                * power(quality, config.distance_exponent)
                * guidance;
        }
    }

    /// R and Q of every candidate, relative to the best.
    fn rate(&mut self, graph: &ChordGraph, standing: &Standing, shared: &ChordShared) {
        let config = graph.config;
        let limit_rad = standing.meter.limit_rad();
        let ways = shared
            .ways(standing.number)
            .unwrap_or([self.largest_to_go, f64::from(graph.to_go[standing.number])]);
        let mut best = [f64::MIN_POSITIVE; 2];
        for candidate in &mut self.list {
            let turn_rad = candidate.turn.turn_rad.abs();
            let straightness = standing
                .meter
                .straightness()
                .with(turn_rad, candidate.length_m);
            let share = candidate.turn.needed_rad / limit_rad;
            candidate.corner =
                1.0 / (1.0 + config.corner.omega(share, straightness, shared.factor));
            let distance = graph.distance(candidate.to);
            candidate.quality = config.distance.quality(distance, ways, shared.factor);
            best = [
                best[0].max(candidate.corner),
                best[1].max(candidate.quality),
            ];
        }
        for candidate in &mut self.list {
            candidate.corner /= best[0];
            candidate.quality /= best[1];
        }
    }

    /// Draws a candidate by weight; none where all weights are 0.
    pub(super) fn draw(&self, unit: f64) -> Option<usize> {
        let total: f64 = self.list.iter().map(|candidate| candidate.weight).sum();
        let mut left = unit * total;
        let mut drawn = None;
        for (i, candidate) in self.list.iter().enumerate() {
            if candidate.weight > 0.0 {
                drawn = Some(i);
                left -= candidate.weight;
                if left < 0.0 {
                    break;
                }
            }
        }
        drawn
    }

    pub(super) fn get(&self, i: usize) -> &Candidate {
        &self.list[i]
    }

    /// Takes a candidate out of the draw.
    pub(super) fn refuse(&mut self, i: usize) {
        self.list[i].weight = 0.0;
    }
}

/// A power, fast for the exponent 1.
#[inline]
fn power(base: f64, exponent: f64) -> f64 {
    if exponent == 1.0 {
        base
    } else {
        base.powf(exponent)
    }
}

//! An ant's way from start to goal.

use super::config::ColonyConfig;
use super::crew::Walk;
use super::footmarks::{Footmarks, Place};
use super::generation::Generation;
use super::ground::Ground;
use super::node::Node;
use crate::numeric::{RandomStream, Seed};
use std::ops::Range;

/// Sends ants out, one after the other.
pub(super) struct Walker<'a> {
    ground: &'a Ground,
    seed: Seed,
    max_retreats: u32,
    marks: Footmarks,
    visited: Vec<Place>,
}

impl<'a> Walker<'a> {
    pub(super) fn new(ground: &'a Ground, config: &ColonyConfig, seed: Seed) -> Self {
        Self {
            ground,
            seed,
            max_retreats: config.dead_end.max_retreats(),
            marks: Footmarks::new(ground.n_cols, ground.n_rows),
            visited: Vec::new(),
        }
    }

    /// Walks until the goal or until no step is left; whether it is the goal.
    fn walk(&mut self, nodes: &[Node], stream: &mut RandomStream, steps: &mut Vec<u8>) -> bool {
        let (first_step, mut n_retreats) = (steps.len(), 0);
        let (mut at, goal) = self.ground.ends;
        self.visit(nodes[at].place);
        while Some(at) != goal {
            let node = &nodes[at];
            let open = node.allowed & !self.marks.around(node.place);
            let step = if open != 0 {
                let preferred = open & node.first_class;
                let class = if preferred != 0 { preferred } else { open };
                let step = node.draw(class, (stream.next_u64() >> 32) as u32);
                steps.push(step as u8);
                at = node.next(at, step);
                self.visit(nodes[at].place);
                continue;
            } else if n_retreats < self.max_retreats && steps.len() > first_step {
                n_retreats += 1;
                steps.pop().unwrap_or_default()
            } else {
                return false;
            };
            at = node.next(at, (usize::from(step) + 4) % 8);
        }
        true
    }

    #[inline]
    fn visit(&mut self, place: Place) {
        self.marks.mark(place);
        self.visited.push(place);
    }
}

impl Walk for Walker<'_> {
    type Shared = Vec<Node>;
    type Part = Generation;

    fn send(
        &mut self,
        nodes: &Vec<Node>,
        iteration: u32,
        ants: Range<u32>,
        generation: &mut Generation,
    ) {
        for ant in ants {
            let mut stream = self.seed.stream([u64::from(iteration), u64::from(ant)]);
            let arrived = self.walk(nodes, &mut stream, &mut generation.steps);
            generation.end_ant(arrived);
            self.marks.clear(&self.visited);
            self.visited.clear();
        }
    }
}

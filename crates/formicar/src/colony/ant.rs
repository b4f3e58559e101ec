//! The path of an ant from cell to cell.

use super::config::ColonyConfig;
use super::cost::CellCost;
use super::generation::Generation;
use super::graph::StepGraph;
use super::node::Node;
use super::visited::{BitAddress, VisitedCells};
use super::worker_pool::{AntWorker, Pace};
use crate::numeric::{RandomStream, Seed};
use std::ops::Range;

/// Walks ants, one after the other.
pub(super) struct CellWorker<'a> {
    graph: &'a StepGraph,
    config: &'a ColonyConfig,
    seed: Seed,
    visited: VisitedCells,
    marked: Vec<BitAddress>,
}

impl<'a> CellWorker<'a> {
    pub(super) fn new(graph: &'a StepGraph, config: &'a ColonyConfig, seed: Seed) -> Self {
        Self {
            graph,
            config,
            seed,
            visited: VisitedCells::new(graph.n_cols, graph.n_rows),
            marked: Vec::new(),
        }
    }

    /// Walks until the goal, or until no step is left; returns whether the ant arrived.
    fn walk(
        &mut self,
        nodes: &[Node],
        stream: &mut RandomStream,
        steps: &mut Vec<u8>,
        pace: &mut Pace,
    ) -> bool {
        let (first_step, mut n_left) = (steps.len(), self.config.dead_end.max_retreats());
        let (mut at, goal) = self.graph.ends;
        self.visit(nodes[at].address);
        while Some(at) != goal && pace.step() {
            let node = &nodes[at];
            let open = node.allowed & !self.visited.around(node.address);
            let step = if open != 0 {
                let preferred = open & node.first_class;
                let class = if preferred != 0 { preferred } else { open };
                let step = node.draw(class, (stream.next_u64() >> 32) as u32);
                steps.push(step as u8);
                at = node.next(at, step);
                self.visit(nodes[at].address);
                continue;
            } else if n_left > 0 && steps.len() > first_step {
                n_left -= 1;
                steps.pop().unwrap_or_default()
            } else {
                return false;
            };
            at = node.next(at, (usize::from(step) + 4) % 8);
        }
        Some(at) == goal
    }

    #[inline]
    fn visit(&mut self, address: BitAddress) {
        self.visited.mark(address);
        self.marked.push(address);
    }
}

impl AntWorker for CellWorker<'_> {
    type Shared = Vec<Node>;
    type Batch = Generation<CellCost>;

    const STEPS_PER_LOOK: u32 = 4096;

    fn walk_ants(
        &mut self,
        nodes: &Vec<Node>,
        (iteration, ants): (u32, Range<u32>),
        generation: &mut Generation<CellCost>,
        pace: &mut Pace,
    ) {
        for ant in ants {
            if pace.is_over() {
                return;
            }
            let mut stream = self.seed.stream([u64::from(iteration), u64::from(ant)]);
            let has_arrived = self.walk(nodes, &mut stream, &mut generation.steps, pace);
            let cost = if has_arrived {
                CellCost::new(&self.config.cost, generation.open_steps())
            } else {
                CellCost::default()
            };
            generation.end_ant(has_arrived, cost);
            self.visited.clear(&self.marked);
            self.marked.clear();
        }
    }
}

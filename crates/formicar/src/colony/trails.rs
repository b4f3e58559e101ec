//! Pheromone, on cells or on steps from cell to cell.

use super::config::TrailLayout;
use super::graph::{StepGraph, steps_in};
use super::node::Node;
use crate::progress::Pheromone;
use std::ops::Range;

/// Pheromone of all cells, row by row, or of their steps, eight per cell; not a number where no ant
/// can go.
pub(super) struct Trails {
    layout: TrailLayout,
    values: Vec<f32>,
    /// Ranges of the values that ants can change.
    spans: Vec<Range<usize>>,
    /// The least and the most of them.
    range: (f32, f32),
}

/// Nodes weighed between two questions whether to go on.
const NODES_PER_LOOK: usize = 4096;

/// Pheromone counts as gone below this; a floor keeps arithmetic off denormal numbers.
const NOTHING: f32 = 1e-30;

impl Trails {
    /// Trails with an initial value by number of the cell; a step has the value of the cell that it
    /// leads to.
    pub(super) fn new(
        layout: TrailLayout,
        initial: &[f64],
        graph: &StepGraph,
        nodes: &[Node],
    ) -> Self {
        let per_cell = match layout {
            TrailLayout::Cells => 1,
            TrailLayout::Edges => 8,
        };
        let mut values = vec![f32::NAN; graph.n_cols * graph.n_rows * per_cell];
        for (at, &cell) in graph.cells.iter().enumerate() {
            let cell = cell as usize;
            match layout {
                TrailLayout::Cells => values[cell] = initial[at] as f32,
                TrailLayout::Edges => {
                    for step in steps_in(nodes[at].allowed) {
                        values[8 * cell + step] = initial[nodes[at].next(at, step)] as f32;
                    }
                }
            }
        }
        let spans = graph.spans.iter();
        let mut trails = Self {
            layout,
            values,
            spans: spans
                .map(|span| per_cell * span.start..per_cell * span.end)
                .collect(),
            range: (0.0, 0.0),
        };
        trails.update(|tau| tau);
        trails
    }

    /// Changes all values, and finds their new range.
    fn update(&mut self, change: impl Fn(f32) -> f32) {
        // The minimum and the maximum ignore an operand that is not a number.
        let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
        for span in &self.spans {
            for tau in &mut self.values[span.clone()] {
                *tau = change(*tau);
                (low, high) = (low.min(*tau), high.max(*tau));
            }
        }
        self.range = (low, high);
    }

    /// Sets the weights of all nodes to pheromone to the power of `alpha`, times desire.
    /// Every so many nodes `goes_on` is asked whether to go on.
    pub(super) fn weigh(
        &self,
        alpha: f64,
        graph: &StepGraph,
        nodes: &mut [Node],
        goes_on: &mut dyn FnMut() -> bool,
    ) {
        // Only proportions matter: relative to the strongest no power overflows.
        let (alpha, unit) = (alpha as f32, 1.0 / self.range.1);
        let mut first = 0;
        for nodes in nodes.chunks_mut(NODES_PER_LOOK) {
            if !goes_on() {
                return;
            }
            let range = first..first + nodes.len();
            first = range.end;
            self.weigh_some((alpha, unit), graph, nodes, range);
        }
    }

    /// Sets the weights of the nodes with a range of numbers.
    fn weigh_some(
        &self,
        (alpha, unit): (f32, f32),
        graph: &StepGraph,
        nodes: &mut [Node],
        range: Range<usize>,
    ) {
        let (desires, cells) = (&graph.desire[range.clone()], &graph.cells[range]);
        for ((node, desire), &cell) in nodes.iter_mut().zip(desires).zip(cells) {
            let cell = cell as usize;
            // A step that is not allowed has no desire, or is never drawn.
            let place = |step: usize| match self.layout {
                TrailLayout::Cells => cell.wrapping_add_signed(graph.offsets[step]),
                TrailLayout::Edges => 8 * cell + step,
            };
            let tau = |step: usize| self.values.get(place(step)).copied().unwrap_or_default();
            let mut products: [f32; 8] = std::array::from_fn(|step| tau(step) * unit);
            if alpha != 1.0 {
                products = products.map(|share| share.powf(alpha));
            }
            for (product, desire) in products.iter_mut().zip(desire) {
                *product *= desire;
            }
            node.set_weights(products);
        }
    }

    /// Evaporates a share `rho` of all pheromone.
    pub(super) fn evaporate(&mut self, rho: f64) {
        let kept = (1.0 - rho) as f32;
        for span in &self.spans {
            for tau in &mut self.values[span.clone()] {
                *tau *= kept;
            }
        }
    }

    /// Adds an amount, which may be negative, to the pheromone along a path from the start.
    pub(super) fn deposit(&mut self, graph: &StepGraph, steps: &[u8], amount: f64) {
        let amount = amount as f32;
        let mut at = graph.start;
        match self.layout {
            TrailLayout::Cells => {
                self.values[at] += amount;
                for &step in steps {
                    at = at.wrapping_add_signed(graph.offsets[usize::from(step)]);
                    self.values[at] += amount;
                }
            }
            TrailLayout::Edges => {
                for &step in steps {
                    self.values[8 * at + usize::from(step)] += amount;
                    at = at.wrapping_add_signed(graph.offsets[usize::from(step)]);
                }
            }
        }
    }

    /// Keeps all pheromone between limits, and above [`NOTHING`].
    pub(super) fn clamp(&mut self, low: f64, high: f64) {
        let low = (low as f32).clamp(NOTHING, f32::MAX);
        let high = (high as f32).clamp(low, f32::MAX);
        self.update(|tau| tau.clamp(low, high));
    }

    /// The least and the most pheromone where ants can go, after the last [`Self::clamp`].
    pub(super) fn range(&self) -> (f32, f32) {
        self.range
    }

    pub(super) fn view(&self) -> Pheromone<'_> {
        match self.layout {
            TrailLayout::Cells => Pheromone::Cells(&self.values),
            TrailLayout::Edges => Pheromone::Steps(&self.values),
        }
    }
}

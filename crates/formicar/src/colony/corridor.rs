//! On which cells ants may step.

use crate::parameters::{parameters, rules};

rules! {
    /// On which of the cells that allowed steps lead to ants may step.
    #[derive(Default)]
    pub enum Corridor {
        /// All of them.
        #[default]
        None,
        /// Those near the shortest ways.
        Ratio(RatioCorridor),
    }
}

parameters! {
    /// The cells with D + S <= `ratio` L: with the lengths D and S of the shortest ways from the
    /// start and to the goal, and that of the shortest way from start to goal, L.
    ///
    /// Time and memory of a colony are in proportion to the cells of its corridor. A way of the
    /// colony's may be longer than `ratio` L, as long as each of its cells lies on one that is not.
    pub struct RatioCorridor {
        /// Length of the ways that the corridor holds, in shortest ways.
        #[range(1.0..=10.0)]
        pub ratio: f64 = 1.1,
        /// The most that a step of length c may lose, c + S' - S cells; no step between neighbors
        /// loses more than 2.83. Below 1 every such step leads nearer to the goal, and no ant gets
        /// stuck.
        #[range(0.0..=64.0)]
        pub step_loss_cells: f64 = 3.0,
    }
}

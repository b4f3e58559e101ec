//! Words of searches that drive: where a vehicle is, from which end, on what guide, and its path.

use crate::geometry::{Arc, Pose2};

/// A driven path: a start pose and the arcs from there, in grid coordinates.
pub type Driven = (Pose2, Vec<Arc>);

/// By how much obstacles are grown for the goal field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inflation {
    /// Halfway to what the body sweeps in its tightest turn.
    Turning,
    /// The body's inner disc.
    Wide,
    /// What the rear axle can never be nearer than.
    Sure,
}

impl Inflation {
    /// All of them, most growth first.
    pub const ALL: [Self; 3] = [Self::Turning, Self::Wide, Self::Sure];
}

/// From which end a search goes out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From the start.
    Start,
    /// From the goal, so that every motion will be driven backwards.
    Goal,
}

/// Where a vehicle is on the lattice, and how it came.
#[derive(Clone, Copy, Debug)]
pub struct State {
    /// The pose.
    pub pose: Pose2,
    /// The lattice's heading; only a start's heading need not be on the lattice.
    pub heading_index: usize,
    /// The motion that led here; of length 0 at a start.
    pub arc: Arc,
    /// Cost of all motions so far.
    pub cost: f64,
    /// Whether it is a start.
    pub is_start: bool,
}

impl State {
    /// Where a vehicle stands that came by an arc, whatever its heading.
    pub fn start(pose: Pose2, arc: Arc) -> Self {
        Self {
            pose,
            heading_index: 0,
            arc,
            cost: 0.0,
            is_start: true,
        }
    }
}

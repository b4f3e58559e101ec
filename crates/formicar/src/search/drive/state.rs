//! Basic types of searches that drive: state, side, inflation and path.

use crate::geometry::{Arc, Pose2};

/// A driven path: a start pose and the arcs from there, in grid coordinates.
pub type Driven = (Pose2, Vec<Arc>);

/// The cells of a goal field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldGrid {
    /// Side of a cell, meters.
    pub resolution_m: f64,
    /// Number of columns.
    pub n_cols: usize,
    /// Number of rows.
    pub n_rows: usize,
}

/// The radius by which obstacles are inflated for the goal field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inflation {
    /// A quarter of the body's width more than `Turning`: a way around with room to spare.
    Roomy,
    /// Halfway to what the body sweeps in its tightest turn.
    Turning,
    /// The body's inner disc.
    Wide,
    /// The least distance of the rear axle from any obstacle.
    Sure,
}

impl Inflation {
    /// All of them, the largest first.
    pub const ALL: [Self; 4] = [Self::Roomy, Self::Turning, Self::Wide, Self::Sure];
}

/// The end from which a search starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From the start.
    Start,
    /// From the goal, so that every motion will be driven backwards.
    Goal,
}

/// A vehicle's pose on the lattice, and the motion that led there.
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
    /// A start at any pose, reached by an arc.
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

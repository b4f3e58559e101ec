//! Progress of the searches that drive.

use crate::geometry::{Arc, Point2, Pose2};

/// The way of an ant that drives; grid coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DriveWay {
    /// The start pose.
    pub start: Pose2,
    /// The arcs that it drove, up to the goal pose where it arrived.
    pub arcs: Vec<Arc>,
    /// The place where it died, if it did; it may have retreated since.
    pub died_at: Option<Point2>,
    /// Decisions that it took.
    pub n_steps: u64,
}

/// A generation of ants that drive, at its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveView<'a> {
    /// Its number, from 0, in its stage of the race.
    pub generation: u32,
    /// Search steps so far.
    pub n_steps: u64,
    /// The ways of its ants; where the first to arrive wins, up to that one.
    pub ways: &'a [DriveWay],
}

/// Motions of hybrid A* to the states reached since the last such event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReachedView<'a> {
    /// Search steps so far.
    pub n_steps: u64,
    /// The motions, each with the pose where it begins; grid coordinates.
    pub motions: &'a [(Pose2, Arc)],
}

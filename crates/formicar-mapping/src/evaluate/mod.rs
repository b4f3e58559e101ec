//! Evaluation: relations, trajectories, and beams that the map was not built from.

mod held_out;
mod relations;

pub use held_out::{HeldOut, JudgedMap, held_out};
pub use relations::{
    RelationErrors, TrajectoryError, loop_pairs, neighbor_pairs, relation_errors,
    relation_file_errors, trajectory_error,
};

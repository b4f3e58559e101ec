//! The state that all ants of a generation read.

use super::trails::Trails;
use crate::search::{Guide, State};

/// Read by the ants of a generation.
pub(super) struct DriveShared<'a> {
    pub(super) guide: Guide<'a>,
    pub(super) trails: Trails,
    /// The states from which the ants start, in turn.
    pub(super) starts: Vec<State>,
    /// Whether the first ant to arrive ends the generation.
    pub(super) first_wins: bool,
}

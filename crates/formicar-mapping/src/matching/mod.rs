//! Matching: the pose at which a scan fits a map.

mod align;
mod branch_bound;
mod correlative;
mod robust;

pub use align::{AlignRule, Alignment, Prior, align};
pub use branch_bound::{BoundSearch, ScoreGrids};
pub use correlative::{Candidate, Window, search, supported};
pub use robust::Robust;

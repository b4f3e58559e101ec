//! The places of runs: scenario, vehicle and motion mode.

use crate::analysis::statistics::distinct;
use crate::run::Run;

/// All places in the order in which they come.
pub(super) fn places(runs: &[Run]) -> Vec<[&str; 3]> {
    distinct(runs.iter().map(Run::place))
}

//! Groups of drives.

use super::drive::Drive;
use crate::papers::group::{Group, ResultRow};
use crate::report::Field;

impl ResultRow for Drive {
    fn ground(&self) -> &str {
        &self.ground
    }

    fn seed(&self) -> u64 {
        self.seed
    }
}

/// Drives that belong together.
pub(super) type Drives<'a> = Group<'a, Drive>;

/// The drives of a method in a part of the experiment.
pub(super) fn drives_of<'a>(drives: &'a [Drive], part: &str, method: &str) -> Drives<'a> {
    Group::of(drives, |drive| drive.part == part && drive.method == method)
}

impl Drives<'_> {
    /// Those of them on a ground.
    pub(super) fn on(&self, ground: &str) -> Self {
        self.filter(|drive| drive.ground == ground)
    }

    /// The number that is certified, with the interval of its rate.
    pub(super) fn certified(&self) -> Field {
        self.rate(|drive| drive.certified)
    }
}

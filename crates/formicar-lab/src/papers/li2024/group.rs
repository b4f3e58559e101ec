//! Drives by part of the experiment and by method, and the quantities that they are compared by.

use super::drive::Drive;
use crate::papers::group::{Group, Quantity, ResultRow};
use crate::report::Field;

/// Parts of the experiment: all methods on the built-in neighborhood, the proposed method with each
/// of its terms off, its growth with the map, and the scenarios of the data set.
pub(super) const COMPARISON: &str = "comparison";
pub(super) const ABLATION: &str = "ablation";
pub(super) const SCALING: &str = "scaling";
pub(super) const HOOD: &str = "hood";

pub(super) const TIME: Quantity<Drive> =
    Quantity::new("map set-up and query, ms", 1, |drive| Some(drive.total_ms));
pub(super) const LENGTH: Quantity<Drive> =
    Quantity::new("path before rounding, m", 2, |drive| drive.native_length_m);
pub(super) const DRIVEN: Quantity<Drive> =
    Quantity::new("certified curve, m", 3, |drive| drive.certified_length_m);
pub(super) const COST: Quantity<Drive> = Quantity::new("J", 4, |drive| drive.cost);
pub(super) const STEP: Quantity<Drive> =
    Quantity::new("largest turn over 1 m, degrees", 2, |drive| {
        drive.largest_step_deg
    });
pub(super) const LARGE_TURNS: Quantity<Drive> =
    Quantity::new("turns above 10 degrees, %", 2, |drive| {
        Some(100.0 * drive.native_over_10_deg?)
    });

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

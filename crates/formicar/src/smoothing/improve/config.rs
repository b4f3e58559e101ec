//! Parameters of the improvement of driven paths.

use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the improvement of driven paths. An operator whose share is 0 is left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ImproveConfig {
    /// Tries after which to stop, 0 to 10^9; a budget of steps may be lower.
    #[schemars(range(min = 0, max = 1_000_000_000))]
    pub max_tries: u64,
    /// Tries without a gain after which to stop, per turning radius of the path's length, 1 to
    /// 10^6.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub stall_tries_per_radius: u32,
    /// The gain, relative to the cost, below which tries count as without one, 0 to 0.1.
    #[schemars(range(min = 0.0, max = 0.1))]
    pub stall_gain: f64,
    /// Share of tries that join two places of the path by one curve, 0 to 1000.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub shortcut_share: f64,
    /// Share of tries that move a place of the path and join it anew on both sides, 0 to 1000.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub shift_share: f64,
    /// Share of tries that replace a change of gear with its surroundings, 0 to 1000; where no gear
    /// changes, the other tries take it.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub cusp_share: f64,
    /// Most systematic passes over all pieces of the path, before and after the random tries, 0 to
    /// 1000.
    #[schemars(range(min = 0, max = 1000))]
    pub polish_passes: u32,
    /// Curves whose surroundings are looked at in a try, cheapest first, 1 to 100.
    #[schemars(range(min = 1, max = 100))]
    pub n_checked: u32,
}

impl Default for ImproveConfig {
    fn default() -> Self {
        Self {
            max_tries: 1_000_000,
            stall_tries_per_radius: 10,
            stall_gain: 1e-3,
            shortcut_share: 1.0,
            shift_share: 2.0,
            cusp_share: 0.3,
            polish_passes: 1,
            n_checked: 3,
        }
    }
}

impl ImproveConfig {
    /// Checks the ranges.
    ///
    /// # Errors
    /// The first parameter outside its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        check_range("improve.max_tries", self.max_tries as f64, 0.0..=1e9)?;
        let stall = f64::from(self.stall_tries_per_radius);
        check_range("improve.stall_tries_per_radius", stall, 1.0..=1e6)?;
        check_range("improve.stall_gain", self.stall_gain, 0.0..=0.1)?;
        check_range("improve.shortcut_share", self.shortcut_share, 0.0..=1000.0)?;
        check_range("improve.shift_share", self.shift_share, 0.0..=1000.0)?;
        check_range("improve.cusp_share", self.cusp_share, 0.0..=1000.0)?;
        let passes = f64::from(self.polish_passes);
        check_range("improve.polish_passes", passes, 0.0..=1000.0)?;
        check_range("improve.n_checked", f64::from(self.n_checked), 1.0..=100.0)
    }
}

//! Parameters of the bee colony itself.

use super::rule::SearchRule;
use crate::numeric::{OutOfRange, check_range};
use serde::{Deserialize, Serialize};

/// How many bees search how long, and how.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BeeColonyConfig {
    /// SN: food sources, and as many employed bees and onlookers, 4 to 10 000.
    pub n_sources: u32,
    /// Trials in a row without gain after which a source is abandoned, 1 to 1 000 000 000; none
    /// for SN times the number of dimensions (Karaboga & Basturk 2007).
    pub limit: Option<u32>,
    /// Evaluations after which the search ends, `n_sources` to 1 000 000 000 000. They are used to
    /// the last one, so that the last cycle may be cut short.
    pub max_evaluations: u64,
    /// By which rules bees search.
    pub variant: BeeVariant,
}

/// By which rules bees search.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BeeVariant {
    /// By one, [`SearchRule::Neighbor`] (Karaboga 2005).
    Basic,
    /// By five rules, chosen in proportion to what they have gained so far.
    ///
    /// After Kiran, Hakli, Gunduz & Uguz 2015 (Information Sciences 300, 140-157): five rules, each
    /// with a counter that begins at the same constant and decides how likely the rule is chosen.
    /// Read: the constant is 1, a counter grows by 1 with every gain, and the rules are drawn in
    /// proportion. Which five rules: those of [`SearchRule`], each from the paper that it names.
    #[default]
    VariableStrategy,
}

impl BeeVariant {
    /// The rules in use.
    pub fn rules(self) -> &'static [SearchRule] {
        match self {
            Self::Basic => &[SearchRule::Neighbor],
            Self::VariableStrategy => &SearchRule::ALL,
        }
    }
}

impl Default for BeeColonyConfig {
    fn default() -> Self {
        Self {
            n_sources: 10,
            limit: None,
            max_evaluations: 500,
            variant: BeeVariant::default(),
        }
    }
}

impl BeeColonyConfig {
    /// Checks the ranges.
    ///
    /// # Errors
    /// The first parameter outside its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let n_sources = f64::from(self.n_sources);
        check_range("n_sources", n_sources, 4.0..=1e4)?;
        if let Some(limit) = self.limit {
            check_range("limit", f64::from(limit), 1.0..=1e9)?;
        }
        let n_most = self.max_evaluations as f64;
        check_range("max_evaluations", n_most, n_sources..=1e12)
    }

    /// Trials without gain after which a source is abandoned, in a space of so many dimensions.
    pub(super) fn limit_in(&self, n_dimensions: usize) -> u64 {
        let usual = u64::from(self.n_sources) * n_dimensions as u64;
        self.limit.map_or(usual, u64::from)
    }
}

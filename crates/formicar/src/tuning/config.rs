//! Parameters of the bee colony itself.

use super::rule::SearchRule;
use crate::parameters::{OutOfRange, Parameters, Range, parameters};

/// The most evaluations of a search.
const MAX_EVALUATIONS: u64 = 1_000_000_000_000;

parameters! {
    /// The size of the colony, its cycles, and its rule.
    pub struct BeeColonyConfig where check_evaluations {
        /// SN: food sources, and as many employed bees and onlookers.
        #[range(4..=10_000)]
        pub n_sources: u32 = 10,
        /// Trials in a row without gain after which a source is abandoned; none for SN times the
        /// number of dimensions (Karaboga & Basturk 2007).
        #[range(1..=1_000_000_000)]
        pub limit: Option<u32> = None,
        /// Evaluations after which the search ends, at least `n_sources`. They are used to the last one, so that the last
        /// cycle may be cut short.
        #[range(1..=MAX_EVALUATIONS)]
        pub max_evaluations: u64 = 500,
        /// By which rules bees search.
        pub variant: BeeVariant = BeeVariant::default(),
    }
}

/// By which rules bees search.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
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

impl Parameters for BeeVariant {}

impl BeeVariant {
    /// The rules in use.
    pub fn rules(self) -> &'static [SearchRule] {
        match self {
            Self::Basic => &[SearchRule::Neighbor],
            Self::VariableStrategy => &SearchRule::ALL,
        }
    }
}

impl BeeColonyConfig {
    /// Every source must be evaluated once.
    fn check_evaluations(&self) -> Result<(), OutOfRange> {
        let range = Range::of::<u64>(u64::from(self.n_sources)..=MAX_EVALUATIONS);
        range.check("max_evaluations", &self.max_evaluations)
    }

    /// Trials without gain after which a source is abandoned, in a space of so many dimensions.
    pub(super) fn limit_in(&self, n_dimensions: usize) -> u64 {
        let usual = u64::from(self.n_sources) * n_dimensions as u64;
        self.limit.map_or(usual, u64::from)
    }
}

//! Claims of papers, and what our runs say of them.
//!
//! A claim is tested by comparisons of two methods with the same seeds, or by counting runs. A
//! comparison speaks for the claim where the signed-rank test, corrected by Holm over all
//! comparisons of the page, stays below 5 % in the direction that the claim says. A claim holds
//! where all its comparisons speak for it, in part where some do, and not where none does.

mod judge;
mod section;

pub use judge::{Judged, Tested};

/// What a claim says of the first of two methods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// It has less.
    Less,
    /// It has more.
    More,
    /// It has the same but for a share of the other's value.
    Same(f64),
}

/// Two methods with the same seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Who is compared with whom, and where.
    pub name: String,
    /// Quantity and unit.
    pub quantity: String,
    /// Decimals with which it is written.
    pub n_decimals: usize,
    /// A value of the first and one of the other per seed.
    pub pairs: Vec<[f64; 2]>,
    /// What the claim says of the first.
    pub expected: Expected,
}

/// Runs that are as the claim says, of all runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counted {
    /// What is counted, and where.
    pub name: String,
    /// How many are as the claim says.
    pub n: usize,
    /// Of how many.
    pub of: usize,
}

/// What a claim is tested by.
#[derive(Clone, Debug, PartialEq)]
pub enum Evidence {
    /// Paired comparisons.
    Paired(Vec<Comparison>),
    /// Counts: all runs are expected to be as the claim says.
    Counted(Vec<Counted>),
}

/// A claim of a paper.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// What is claimed.
    pub words: String,
    /// Where in the paper.
    pub place: String,
    /// The paper's numbers; a dash where it gives none.
    pub paper: String,
    /// What it is tested by.
    pub evidence: Evidence,
}

/// The claims of a paper.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Claims(pub Vec<Claim>);

impl Claim {
    /// A claim that comparisons test.
    pub(crate) fn paired(
        words: &str,
        (place, paper): (&str, &str),
        comparisons: Vec<Comparison>,
    ) -> Self {
        Self::new(words, (place, paper), Evidence::Paired(comparisons))
    }

    /// A claim that counts test.
    pub(crate) fn counted(words: &str, (place, paper): (&str, &str), counts: Vec<Counted>) -> Self {
        Self::new(words, (place, paper), Evidence::Counted(counts))
    }

    fn new(words: &str, (place, paper): (&str, &str), evidence: Evidence) -> Self {
        Self {
            words: words.to_owned(),
            place: place.to_owned(),
            paper: paper.to_owned(),
            evidence,
        }
    }
}

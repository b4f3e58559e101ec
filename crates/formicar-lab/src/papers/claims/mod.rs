//! Claims of papers, tested by our runs.
//!
//! A claim is tested by comparisons of two methods with the same seeds, or by counting runs. A
//! comparison speaks for the claim where the signed-rank test, corrected by Holm over all
//! comparisons of the page, stays below 5 % in the direction that the claim says. A claim holds
//! where all its comparisons speak for it, in part where some do, and not where none does.

mod judge;
mod section;

pub use judge::{Judged, Tested};

/// The relation that a claim states between the first of two methods and the other.
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
    /// The two methods, and the map.
    pub name: String,
    /// Quantity and unit.
    pub quantity: String,
    /// Decimals with which it is written.
    pub n_decimals: usize,
    /// A value of the first and one of the other per seed.
    pub pairs: Vec<[f64; 2]>,
    /// The relation that the claim states.
    pub expected: Expected,
}

/// Runs that are as the claim says, of all runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counted {
    /// The property that is counted, and the map.
    pub name: String,
    /// Runs that agree with the claim.
    pub n: usize,
    /// All runs.
    pub of: usize,
}

/// The evidence for or against a claim.
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
    /// The claim in a sentence.
    pub words: String,
    /// Its place in the paper.
    pub place: String,
    /// The paper's numbers; a dash where it gives none.
    pub paper: String,
    /// The evidence.
    pub evidence: Evidence,
}

/// The claims of a paper.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Claims(pub Vec<Claim>);

impl From<Vec<Comparison>> for Evidence {
    fn from(comparisons: Vec<Comparison>) -> Self {
        Self::Paired(comparisons)
    }
}

impl From<Vec<Counted>> for Evidence {
    fn from(counts: Vec<Counted>) -> Self {
        Self::Counted(counts)
    }
}

impl Claim {
    /// A claim, its place in the paper, the paper's numbers, and our evidence.
    pub(crate) fn new(
        words: &str,
        place: &str,
        paper: &str,
        evidence: impl Into<Evidence>,
    ) -> Self {
        Self {
            words: words.to_owned(),
            place: place.to_owned(),
            paper: paper.to_owned(),
            evidence: evidence.into(),
        }
    }
}

/// The claims of a paper, a line each: the claim in a sentence, its place in the paper, the paper's
/// numbers (a dash where it gives none), and our evidence.
macro_rules! claims {
    ($($words:literal | $place:literal | $paper:literal => $evidence:expr;)*) => {
        $crate::papers::claims::Claims(vec![
            $($crate::papers::claims::Claim::new($words, $place, $paper, $evidence)),*
        ])
    };
}

pub(crate) use claims;

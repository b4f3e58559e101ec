//! Verdicts on claims.

/// The verdict of experiments on a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// All tests support it.
    Holds,
    /// Some tests support it.
    InPart,
    /// No test supports it.
    Fails,
    /// Too few runs to tell.
    Undecided,
}

impl Verdict {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::InPart => "holds in part",
            Self::Fails => "does not hold",
            Self::Undecided => "too few runs",
        }
    }

    /// A mark that is told apart without color.
    pub(super) fn mark(self) -> &'static str {
        match self {
            Self::Holds => "\u{25cf}",
            Self::InPart => "\u{25d0}",
            Self::Fails => "\u{25cb}",
            Self::Undecided => "\u{2013}",
        }
    }

    /// The class of its mark in the page's style.
    pub(super) fn class(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::InPart => "in-part",
            Self::Fails => "fails",
            Self::Undecided => "undecided",
        }
    }
}

//! The fate of a pocket.

/// The fate of a pocket, and the reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PocketFate {
    /// Closed, but for cells beside diagonal steps past its mouth.
    Closed,
    /// Open: the start or a goal lies in it.
    HoldsEnd,
    /// Open: no step leads in, so that closing it would save no search.
    NoMouth,
    /// Open: paths past it would become longer.
    WouldHarm,
    /// Open: the check whether paths past it would become longer takes too many steps.
    TooIntricate,
}

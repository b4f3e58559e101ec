//! The check that all parameters have in common.

use super::range::OutOfRange;

/// Parameters that can be checked.
///
/// A type without a range of its own, such as a choice of words, implements it with nothing.
pub trait Parameters {
    /// Checks the ranges.
    ///
    /// # Errors
    /// The first parameter outside its range, with its key dotted from here.
    fn check(&self) -> Result<(), OutOfRange> {
        Ok(())
    }
}

/// Any value will do.
impl Parameters for bool {}
/// Any value will do.
impl Parameters for u32 {}

impl<P: Parameters> Parameters for Option<P> {
    fn check(&self) -> Result<(), OutOfRange> {
        self.as_ref().map_or(Ok(()), Parameters::check)
    }
}

impl<P: Parameters> Parameters for Vec<P> {
    fn check(&self) -> Result<(), OutOfRange> {
        self.iter().try_for_each(Parameters::check)
    }
}

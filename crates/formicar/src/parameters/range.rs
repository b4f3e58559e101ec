//! Ranges of parameters, and values outside them.

use std::fmt;
use std::ops::{Bound, RangeBounds};
use thiserror::Error;

/// A parameter outside its range.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{key} = {value}; it must be {range}")]
pub struct OutOfRange {
    /// The parameter, dotted as in a configuration file.
    pub key: String,
    /// Its value.
    pub value: f64,
    /// The allowed values, and a hint where there is one.
    pub range: String,
}

impl OutOfRange {
    /// The same error seen from the section that holds the parameter.
    #[must_use]
    pub fn within(self, section: &str) -> Self {
        let key = format!("{section}.{}", self.key);
        Self { key, ..self }
    }
}

/// The numbers that a parameter may take; infinities and NaN are in no range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The lower end.
    pub low: Bound<f64>,
    /// The upper end.
    pub high: Bound<f64>,
}

impl Range {
    /// The range of a parameter of type `T`, from Rust's notation: `0.0..=1.0`, `1..`, or a pair
    /// of bounds.
    pub fn of<T: Ranged>(bounds: impl RangeBounds<T::Number>) -> Self {
        let number = |bound: Bound<&T::Number>| bound.map(|number| number.to_f64());
        Self {
            low: number(bounds.start_bound()),
            high: number(bounds.end_bound()),
        }
    }

    /// Whether a number is in the range.
    pub fn contains(&self, number: f64) -> bool {
        number.is_finite() && (self.low, self.high).contains(&number)
    }

    /// Checks a parameter: each of its numbers, if there are several.
    ///
    /// # Errors
    /// The first number outside the range.
    pub fn check<T: Ranged + ?Sized>(&self, key: &str, value: &T) -> Result<(), OutOfRange> {
        let outside = value.numbers().find(|&number| !self.contains(number));
        outside.map_or(Ok(()), |value| {
            let preposition = match (self.low, self.high) {
                (Bound::Included(_), Bound::Included(_)) => "in ",
                _ => "",
            };
            Err(OutOfRange {
                key: key.to_owned(),
                value,
                range: format!("{preposition}{self}"),
            })
        })
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use Bound::{Excluded, Included, Unbounded};
        match (self.low, self.high) {
            (Included(low), Included(high)) => write!(f, "{low} to {high}"),
            (Unbounded, Unbounded) => f.write_str("finite"),
            (low, high) => {
                match low {
                    Included(low) => write!(f, "at least {low}")?,
                    Excluded(low) => write!(f, "above {low}")?,
                    Unbounded => {}
                }
                if low != Unbounded && high != Unbounded {
                    f.write_str(" and ")?;
                }
                match high {
                    Included(high) => write!(f, "at most {high}"),
                    Excluded(high) => write!(f, "below {high}"),
                    Unbounded => Ok(()),
                }
            }
        }
    }
}

/// A type of numbers that parameters have.
pub trait Number: Copy {
    /// The number as a float; counts beyond 2^53 lose their last digits.
    fn to_f64(self) -> f64;
}

/// A type whose numbers a range can bound: a number, one that may be left out, or a list.
pub trait Ranged {
    /// The type of the numbers.
    type Number: Number;

    /// The numbers.
    fn numbers(&self) -> impl Iterator<Item = f64>;
}

impl Number for f64 {
    fn to_f64(self) -> f64 {
        self
    }
}

impl Number for u32 {
    fn to_f64(self) -> f64 {
        self.into()
    }
}

impl Number for u64 {
    fn to_f64(self) -> f64 {
        self as f64
    }
}

impl Number for usize {
    fn to_f64(self) -> f64 {
        self as f64
    }
}

impl<N: Number> Ranged for N {
    type Number = N;

    fn numbers(&self) -> impl Iterator<Item = f64> {
        std::iter::once(self.to_f64())
    }
}

impl<N: Number> Ranged for Option<N> {
    type Number = N;

    fn numbers(&self) -> impl Iterator<Item = f64> {
        self.iter().map(|number| number.to_f64())
    }
}

impl<N: Number> Ranged for Vec<N> {
    type Number = N;

    fn numbers(&self) -> impl Iterator<Item = f64> {
        self.iter().map(|number| number.to_f64())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_key_value_and_range() {
        let range = Range::of::<f64>(0.0..=1.0);
        assert_eq!(range.check("rho", &1.0), Ok(()));
        let error = range.check("rho", &1.5).unwrap_err();
        let error = error.within("evaporation").within("colony");
        let message = "colony.evaporation.rho = 1.5; it must be in 0 to 1";
        assert_eq!(error.to_string(), message);
    }

    #[test]
    fn what_is_no_number_is_in_no_range() {
        let positive = Range::of::<f64>(0.0..);
        assert!(positive.contains(1e300));
        for bad in [f64::NAN, f64::INFINITY, -1.0] {
            assert!(!positive.contains(bad), "{bad}");
        }
    }

    #[test]
    fn bounds_lists_and_what_may_be_left_out() {
        let range = Range::of::<Vec<f64>>(0.0..=10.0);
        assert!(range.check("growth", &vec![0.1, 0.0]).is_ok());
        assert!(range.check("growth", &vec![0.1, 11.0]).is_err());
        let range = Range::of::<Option<u32>>(1..=8);
        assert!(range.check("limit", &None::<u32>).is_ok());
        assert!(range.check("limit", &Some(9_u32)).is_err());
    }

    #[test]
    fn ranges_in_words() {
        use Bound::{Excluded, Included};
        let words = |low, high| Range { low, high }.to_string();
        assert_eq!(words(Included(0.0), Included(1e3)), "0 to 1000");
        assert_eq!(Range::of::<u32>(1..).to_string(), "at least 1");
        assert_eq!(words(Excluded(0.0), Excluded(90.0)), "above 0 and below 90");
        assert_eq!(words(Bound::Unbounded, Included(2.0)), "at most 2");
    }
}

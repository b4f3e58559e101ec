//! Parameters within their ranges.

use std::ops::RangeInclusive;
use thiserror::Error;

/// A parameter outside its range.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{key} = {value}; it must be {range}")]
pub struct OutOfRange {
    /// The parameter, dotted as in a configuration file.
    pub key: &'static str,
    /// Its value.
    pub value: f64,
    /// What is allowed.
    pub range: String,
}

/// Checks that a parameter is in its range; what is no number is in none.
///
/// # Errors
/// The parameter with its value and range.
pub fn check_range(
    key: &'static str,
    value: f64,
    range: RangeInclusive<f64>,
) -> Result<(), OutOfRange> {
    if range.contains(&value) {
        return Ok(());
    }
    Err(OutOfRange {
        key,
        value,
        range: format!("in {} to {}", range.start(), range.end()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_key_value_and_range() {
        assert!(check_range("colony.evaporation.rho", 1.0, 0.0..=1.0).is_ok());
        let error = check_range("colony.evaporation.rho", 1.5, 0.0..=1.0).unwrap_err();
        let message = "colony.evaporation.rho = 1.5; it must be in 0 to 1";
        assert_eq!(error.to_string(), message);
        assert!(check_range("x", f64::NAN, 0.0..=1.0).is_err());
    }
}

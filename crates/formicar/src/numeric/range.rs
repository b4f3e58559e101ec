//! Parameters within their ranges.

use std::borrow::Cow;
use std::ops::RangeInclusive;
use thiserror::Error;

/// A parameter outside its range.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{key} = {value}; it must be {range}")]
pub struct OutOfRange {
    /// The parameter, dotted as in a configuration file.
    pub key: Cow<'static, str>,
    /// Its value.
    pub value: f64,
    /// What is allowed.
    pub range: String,
}

impl OutOfRange {
    /// The same of a parameter in another section, for rules that stand in several.
    #[must_use]
    pub fn in_section(self, section: &str) -> Self {
        let (_, rest) = self.key.split_once('.').unwrap_or(("", &self.key));
        Self {
            key: Cow::Owned(format!("{section}.{rest}")),
            ..self
        }
    }
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
        key: Cow::Borrowed(key),
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
        let moved = error.in_section("chords").to_string();
        assert_eq!(moved, "chords.evaporation.rho = 1.5; it must be in 0 to 1");
        assert!(check_range("x", f64::NAN, 0.0..=1.0).is_err());
    }
}

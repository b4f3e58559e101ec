//! The space of parameters: named dimensions, each mapped to the unit interval.

use super::TuningError;
use crate::parameters::OutOfRange;

/// Largest magnitude of an integer bound: every integer up to it is an `f64`.
const MAX_INTEGER: f64 = 9_007_199_254_740_992.0;

/// The values that a dimension takes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)
)]
pub enum Kind {
    /// Numbers from `low` to `high`.
    Real {
        /// The least.
        low: f64,
        /// The greatest, above `low`.
        high: f64,
    },
    /// Numbers from `low` to `high`, equal ratios being equally far.
    LogReal {
        /// The least, above 0.
        low: f64,
        /// The greatest, above `low`.
        high: f64,
    },
    /// Integers from `low` to `high`, all equally wide.
    Integer {
        /// The least.
        low: f64,
        /// The greatest, above `low`.
        high: f64,
    },
    /// Integers from `low` to `high`, equal ratios being equally far.
    LogInteger {
        /// The least, at least 1.
        low: f64,
        /// The greatest, above `low`.
        high: f64,
    },
    /// One of so many things, told as its number from 0; all equally wide, in their order.
    Choice {
        /// Their number, at least 2.
        n_choices: u32,
    },
}

/// A parameter that can be chosen.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Dimension {
    /// Its name.
    pub name: String,
    /// Its values.
    pub kind: Kind,
}

impl Dimension {
    /// A dimension.
    pub fn new(name: &str, kind: Kind) -> Self {
        Self {
            name: name.to_owned(),
            kind,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        let (least, [low, high]) = match self.kind {
            Kind::Real { low, high } => (f64::MIN, [low, high]),
            Kind::LogReal { low, high } => (f64::MIN_POSITIVE, [low, high]),
            Kind::Integer { low, high } => (-MAX_INTEGER, [low, high]),
            Kind::LogInteger { low, high } => (1.0, [low, high]),
            Kind::Choice { n_choices } => (0.0, [0.0, f64::from(n_choices) - 1.0]),
        };
        let most = match self.kind {
            Kind::Integer { .. } | Kind::LogInteger { .. } => MAX_INTEGER,
            _ => f64::MAX,
        };
        let fault = |which: &str, value: f64, range: String| OutOfRange {
            key: format!("{which} of {}", self.name),
            value,
            range,
        };
        if !(least..=most).contains(&low) {
            return Err(fault("low", low, format!("in {least:e} to {most:e}")));
        }
        if let Kind::Choice { n_choices: 0 | 1 } = self.kind {
            let n_choices = high + 1.0;
            return Err(fault("number of choices", n_choices, "at least 2".into()));
        }
        if !(high > low && high <= most && (high - low).is_finite()) {
            return Err(fault("high", high, format!("above {low} and finite")));
        }
        let is_whole = |bound: &f64| bound.fract() == 0.0;
        match (&self.kind, [low, high].iter().find(|b| !is_whole(b))) {
            (Kind::Integer { .. } | Kind::LogInteger { .. }, Some(&bound)) => {
                Err(fault("bound", bound, "an integer".into()))
            }
            _ => Ok(()),
        }
    }

    /// The value at a place of the unit interval.
    fn value(&self, place: f64) -> f64 {
        match self.kind {
            Kind::Real { low, high } => (low + place * (high - low)).clamp(low, high),
            Kind::LogReal { low, high } => (low.ln() + place * (high / low).ln())
                .exp()
                .clamp(low, high),
            Kind::Integer { low, high } => (low + (place * (high - low + 1.0)).floor()).min(high),
            Kind::LogInteger { low, high } => {
                let [from, to] = [low - 0.5, high + 0.5].map(f64::ln);
                let value = (from + place * (to - from)).exp().round();
                value.clamp(low, high)
            }
            Kind::Choice { n_choices } => {
                let n = f64::from(n_choices);
                (place * n).floor().min(n - 1.0)
            }
        }
    }

    /// The place of a value, in the middle of all that mean the same.
    fn place(&self, value: f64) -> f64 {
        let place = match self.kind {
            Kind::Real { low, high } => (value - low) / (high - low),
            Kind::LogReal { low, high } => (value / low).ln() / (high / low).ln(),
            Kind::Integer { low, high } => (value - low + 0.5) / (high - low + 1.0),
            Kind::LogInteger { low, high } => {
                let [from, to] = [low - 0.5, high + 0.5].map(f64::ln);
                (value.ln() - from) / (to - from)
            }
            Kind::Choice { n_choices } => (value + 0.5) / f64::from(n_choices),
        };
        place.clamp(0.0, 1.0)
    }

    /// Least and greatest value.
    fn bounds(&self) -> [f64; 2] {
        match self.kind {
            Kind::Real { low, high }
            | Kind::LogReal { low, high }
            | Kind::Integer { low, high }
            | Kind::LogInteger { low, high } => [low, high],
            Kind::Choice { n_choices } => [0.0, f64::from(n_choices) - 1.0],
        }
    }
}

/// The parameters that can be chosen, each with its values.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct ParameterSpace {
    dimensions: Vec<Dimension>,
}

impl ParameterSpace {
    /// A space of one dimension or more.
    ///
    /// # Errors
    /// No dimension, two of one name, or bounds that are out of range or order.
    pub fn new(dimensions: Vec<Dimension>) -> Result<Self, TuningError> {
        let space = Self { dimensions };
        space.check()?;
        Ok(space)
    }

    /// Checks what was read rather than made.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(super) fn check(&self) -> Result<(), TuningError> {
        if self.dimensions.is_empty() {
            return Err(TuningError::OutOfRange(OutOfRange {
                key: "number of dimensions".to_owned(),
                value: 0.0,
                range: "at least 1".to_owned(),
            }));
        }
        for (i, dimension) in self.dimensions.iter().enumerate() {
            dimension.check()?;
            let before = &self.dimensions[..i];
            if before.iter().any(|other| other.name == dimension.name) {
                return Err(TuningError::NamedTwice {
                    name: dimension.name.clone(),
                });
            }
        }
        Ok(())
    }

    /// The dimensions in order.
    pub fn dimensions(&self) -> &[Dimension] {
        &self.dimensions
    }

    /// The values at a position in the unit cube.
    pub fn values(&self, position: &[f64]) -> Vec<f64> {
        let pairs = self.dimensions.iter().zip(position);
        pairs.map(|(dimension, &u)| dimension.value(u)).collect()
    }

    /// A position in the unit cube that has these values, one for each dimension.
    ///
    /// # Errors
    /// A value outside its dimension, or not one for each.
    pub fn position(&self, values: &[f64]) -> Result<Vec<f64>, TuningError> {
        if values.len() != self.dimensions.len() {
            return Err(TuningError::OutOfRange(OutOfRange {
                key: "number of values".to_owned(),
                value: values.len() as f64,
                range: format!("{}, one for each dimension", self.dimensions.len()),
            }));
        }
        let pairs = self.dimensions.iter().zip(values);
        let place = |(dimension, &value): (&Dimension, &f64)| {
            let [low, high] = dimension.bounds();
            if (low..=high).contains(&value) {
                return Ok(dimension.place(value));
            }
            Err(TuningError::OutOfRange(OutOfRange {
                key: dimension.name.clone(),
                value,
                range: format!("in {low} to {high}"),
            }))
        };
        pairs.map(place).collect()
    }
}

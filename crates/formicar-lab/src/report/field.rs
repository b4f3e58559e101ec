//! The contents of a cell of a table.

use super::Verdict;
use crate::analysis::statistics::wilson_interval;

/// A field of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Field {
    /// Words.
    Words(String),
    /// The verdict on a claim.
    Verdict(Verdict),
    /// A number and its decimals; a dash for `None`.
    Number(Option<f64>, usize),
    /// A probability: four decimals, or that it is less than the least of them.
    Probability(Option<f64>),
    /// A number with its interval, or a median with its quartiles: `[low, value, high]`.
    Spread(Option<[f64; 3]>, usize),
    /// A count out of a total.
    Count(usize, usize),
    /// A count out of a total, with the 95 % interval of the rate in percent (Wilson).
    Rate(usize, usize),
}

/// A number as it is written, and what its name ends with.
pub(super) struct Part {
    pub(super) suffix: &'static str,
    pub(super) text: String,
}

const NONE: &str = "-";

impl Field {
    /// Words.
    pub fn words(words: &str) -> Self {
        Self::Words(words.to_owned())
    }

    /// A whole number.
    pub fn count(n: usize) -> Self {
        Self::Number(Some(n as f64), 0)
    }

    /// The field as text.
    pub fn text(&self) -> String {
        let parts = self.parts();
        let written: Vec<&str> = parts.iter().map(|part| part.text.as_str()).collect();
        self.laid_out(&written)
    }

    /// Its numbers; words and missing values have none.
    pub(super) fn parts(&self) -> Vec<Part> {
        let parts = |named: Vec<(&'static str, String)>| {
            let part = |(suffix, text)| Part { suffix, text };
            named.into_iter().map(part).collect()
        };
        match *self {
            Self::Words(_)
            | Self::Verdict(_)
            | Self::Number(None, _)
            | Self::Probability(None)
            | Self::Spread(None, _) => Vec::new(),
            Self::Probability(Some(p)) => parts(vec![("", probability(p))]),
            Self::Number(Some(value), n) => parts(vec![("", decimal(value, n))]),
            Self::Spread(Some([low, value, high]), n) => parts(vec![
                ("", decimal(value, n)),
                ("low", decimal(low, n)),
                ("high", decimal(high, n)),
            ]),
            Self::Count(n, of) => parts(vec![("", n.to_string()), ("of", of.to_string())]),
            Self::Rate(n, of) => {
                let (low, high) = wilson_interval(n, of);
                parts(vec![
                    ("", n.to_string()),
                    ("of", of.to_string()),
                    ("low", decimal(100.0 * low, 0)),
                    ("high", decimal(100.0 * high, 0)),
                ])
            }
        }
    }

    /// The field around its numbers, as they are written.
    pub(super) fn laid_out(&self, parts: &[&str]) -> String {
        match (self, parts) {
            (Self::Words(words), _) => words.clone(),
            (Self::Verdict(verdict), _) => verdict.name().to_owned(),
            (Self::Number(..) | Self::Probability(_), [value]) => (*value).to_owned(),
            (Self::Spread(..), [value, low, high]) => format!("{value} [{low}, {high}]"),
            (Self::Count(..), [n, of]) => format!("{n}/{of}"),
            (Self::Rate(..), [n, of, low, high]) => format!("{n}/{of} [{low}, {high}] %"),
            _ => NONE.to_owned(),
        }
    }
}

/// A number with so many decimals, never a negative zero.
fn decimal(value: f64, n_decimals: usize) -> String {
    let text = format!("{value:.n_decimals$}");
    let is_zero = text.starts_with('-') && text.chars().all(|c| "-0.".contains(c));
    text[usize::from(is_zero)..].to_owned()
}

fn probability(p: f64) -> String {
    if p < 1e-4 {
        "< 0.0001".to_owned()
    } else {
        decimal(p, 4)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_written() {
        for (field, text) in [
            (Field::words("a"), "a"),
            (Field::Number(Some(1.25), 1), "1.2"),
            (Field::Number(Some(-0.01), 1), "0.0"),
            (Field::Number(Some(-0.5), 1), "-0.5"),
            (Field::Number(None, 1), "-"),
            (Field::Probability(Some(0.012_34)), "0.0123"),
            (Field::Probability(Some(1.3e-9)), "< 0.0001"),
            (Field::Verdict(Verdict::InPart), "holds in part"),
            (Field::Spread(Some([1.0, 2.0, 3.0]), 0), "2 [1, 3]"),
            (Field::Spread(None, 0), "-"),
            (Field::Count(3, 4), "3/4"),
            (Field::Rate(31, 31), "31/31 [89, 100] %"),
        ] {
            assert_eq!(field.text(), text);
        }
    }
}

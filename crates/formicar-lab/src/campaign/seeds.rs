//! Seeds: a count, a list, or a range.

use super::mistake::Text;
use anyhow::Result;
use std::ops::Range;
use toml::{Spanned, Value};

/// The most seeds of a campaign.
const MAX_SEEDS: i64 = 1_000_000;

const EXPECTED: &str = "expected a count from 1 to 1000000 (31 for the seeds 0 to 30), a list of \
                        seeds from 0 on ([0, 5, 7]), or a range ({ from = 10, to = 20 }, both \
                        included)";

/// The seeds that a value names; seed 0 alone where there is no value.
pub(super) fn seeds(value: Option<&Spanned<Value>>, text: &Text) -> Result<Vec<u64>> {
    let Some(value) = value else {
        return Ok(vec![0]);
    };
    let seeds = match value.get_ref() {
        Value::Integer(n) if (1..=MAX_SEEDS).contains(n) => Some((0..*n as u64).collect()),
        Value::Array(list) => list.iter().map(seed).collect::<Option<Vec<u64>>>(),
        Value::Table(table) => range(table),
        _ => None,
    };
    let seeds = seeds.filter(|seeds| !seeds.is_empty());
    let seeds = seeds.ok_or_else(|| wrong(value.span(), text, &fault(value.get_ref())))?;
    let mut sorted = seeds.clone();
    sorted.sort_unstable();
    match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => {
            let what = format!("seed {} stands there twice", pair[0]);
            Err(wrong(value.span(), text, &what))
        }
        None => Ok(seeds),
    }
}

/// The mistake in a value that names no seeds.
fn fault(value: &Value) -> String {
    let bound = |name: &str| value.get(name).and_then(Value::as_integer);
    match (bound("from"), bound("to")) {
        (Some(from), Some(to)) if from > to => {
            format!("from = {from} must not exceed to = {to}; {EXPECTED}")
        }
        _ => EXPECTED.to_owned(),
    }
}

fn wrong(span: Range<usize>, text: &Text, what: &str) -> anyhow::Error {
    text.mistake(Some(span), what)
}

fn seed(value: &Value) -> Option<u64> {
    u64::try_from(value.as_integer()?).ok()
}

fn range(table: &toml::Table) -> Option<Vec<u64>> {
    let (from, to) = (seed(table.get("from")?)?, seed(table.get("to")?)?);
    let is_range = table.len() == 2 && from <= to && to - from < MAX_SEEDS as u64;
    is_range.then(|| (from..=to).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Deserialize)]
    struct Holder {
        seeds: Spanned<Value>,
    }

    fn read(value: &str) -> Result<Vec<u64>> {
        let text = Text {
            name: "c.toml".to_owned(),
            text: format!("\nseeds = {value}"),
        };
        let holder: Holder = toml::from_str(&text.text).unwrap();
        seeds(Some(&holder.seeds), &text)
    }

    #[test]
    fn counts_lists_and_ranges() {
        assert_eq!(read("3").unwrap(), [0, 1, 2]);
        assert_eq!(read("[7, 1]").unwrap(), [7, 1]);
        assert_eq!(read("{ from = 4, to = 6 }").unwrap(), [4, 5, 6]);
    }

    #[test]
    fn others_are_refused_with_what_is_expected() {
        for wrong in [
            "0",
            "-1",
            "[]",
            "[1, 1]",
            "\"many\"",
            "{ from = 2, to = 1 }",
            "1.5",
        ] {
            let told = read(wrong).unwrap_err().to_string();
            assert!(told.starts_with("c.toml, line 2, seeds: "), "{told}");
        }
        let told = read("{ from = 5, to = 2 }").unwrap_err().to_string();
        assert!(told.contains("from = 5 must not exceed to = 2"), "{told}");
    }
}

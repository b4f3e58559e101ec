//! The parameters of a planner that can be tuned, and their ranges: the configuration's schema
//! tells.

use super::leaf::{Leaf, leaves};
use anyhow::{Context, Result, bail};
use formicar::parameters::Kind as ValueKind;
use formicar::planner::PlannerConfig;
use formicar::tuning::{Dimension, Kind, ParameterSpace};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// A range that the caller gives for a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnRange {
    /// The parameter, dotted.
    pub key: String,
    /// The least value.
    pub low: f64,
    /// The greatest.
    pub high: f64,
    /// True if equal ratios are equally far.
    pub is_log: bool,
}

/// Parameters of a configuration that can be tuned.
///
/// A number takes the range of the schema or of the caller, a word one of the words of the schema,
/// a switch both its positions. Rules stay as they are, since another rule has other parameters;
/// so do lists.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TuningSpace {
    /// The space, its dimensions named by dotted keys.
    pub space: ParameterSpace,
    /// Per dimension the words that can be chosen; none of numbers.
    choices: Vec<Vec<Value>>,
    /// The configuration around them.
    base: Value,
}

impl TuningSpace {
    /// The parameters named by `keys`, and those of all sections in `groups` whose range is known;
    /// of neither, those of all sections. Also the parameters of the groups that were left out for
    /// want of a finite range.
    ///
    /// # Errors
    /// A key or group that the planner does not use, one that cannot be tuned, or a range that is
    /// none.
    pub fn new(
        base: &PlannerConfig,
        keys: &[String],
        groups: &[String],
        ranges: &[OwnRange],
    ) -> Result<(Self, Vec<String>)> {
        let base = serde_json::to_value(base)?;
        let leaves = leaves(&base);
        for name in keys.iter().chain(ranges.iter().map(|range| &range.key)) {
            known(name, &leaves)?;
        }
        for group in groups {
            known_group(group, &leaves)?;
        }
        let (mut dimensions, mut choices, mut left_out) = (Vec::new(), Vec::new(), Vec::new());
        for leaf in &leaves {
            let is_named = keys.iter().any(|key| key == leaf.key());
            let is_meant = is_named || (keys.is_empty() && groups.is_empty());
            if !is_meant && !groups.iter().any(|group| is_within(leaf.key(), group)) {
                continue;
            }
            let own = ranges.iter().find(|range| range.key == leaf.key());
            match leaf.dimension(own)? {
                Some((dimension, words)) => {
                    dimensions.push(dimension);
                    choices.push(words);
                }
                None if is_named => bail!(
                    "{}: its schema has no finite range; hint: --range {}=LOW..HIGH",
                    leaf.key(),
                    leaf.key()
                ),
                None => left_out.push(leaf.key().to_owned()),
            }
        }
        if let Some(range) = ranges
            .iter()
            .find(|range| dimensions.iter().all(|d| d.name != range.key))
        {
            bail!(
                "--range {}: this parameter is not tuned; hint: --parameter {}",
                range.key,
                range.key
            );
        }
        let space = ParameterSpace::new(dimensions)?;
        let tuned = Self {
            space,
            choices,
            base,
        };
        Ok((tuned, left_out))
    }

    /// The configuration with values in the place of its own; none where they do not go together.
    pub fn config(&self, values: &[f64]) -> Option<PlannerConfig> {
        let mut whole = self.base.clone();
        for (key, value) in self.parameters(values) {
            *whole.pointer_mut(&pointer(key))? = value;
        }
        let config: PlannerConfig = serde_json::from_value(whole).ok()?;
        config.check().is_ok().then_some(config)
    }

    /// Only what is tuned, as a document: tables of values, with the planner's name.
    pub fn document(&self, values: &[f64]) -> Value {
        let mut whole = Map::new();
        if let Some(planner) = self.base.get("planner") {
            whole.insert("planner".to_owned(), planner.clone());
        }
        for (key, value) in self.parameters(values) {
            insert(&mut whole, key, value);
        }
        Value::Object(whole)
    }

    /// The values that the configuration has by itself.
    ///
    /// # Errors
    /// One that is outside its range.
    pub fn own_values(&self) -> Result<Vec<f64>> {
        let pairs = self.space.dimensions().iter().zip(&self.choices);
        let own = |(dimension, choices): (&Dimension, &Vec<Value>)| {
            let value = self.base.pointer(&pointer(&dimension.name));
            let value = value.context("a dimension is a leaf of its configuration")?;
            let place = choices.iter().position(|choice| choice == value);
            let number = place.map(|place| place as f64).or(value.as_f64());
            number.with_context(|| format!("{} = {value} is no choice", dimension.name))
        };
        pairs.map(own).collect()
    }

    /// Keys and values, as they stand in a document.
    pub fn parameters(&self, values: &[f64]) -> Vec<(&str, Value)> {
        let dimensions = self.space.dimensions().iter();
        let triples = dimensions.zip(&self.choices).zip(values);
        triples
            .map(|((dimension, choices), &value)| {
                let written = match dimension.kind {
                    Kind::Choice { .. } => choices[value as usize].clone(),
                    Kind::Integer { .. } | Kind::LogInteger { .. } => Value::from(value as u64),
                    Kind::Real { .. } | Kind::LogReal { .. } => Value::from(value),
                };
                (dimension.name.as_str(), written)
            })
            .collect()
    }
}

impl Leaf {
    /// The dimension and its words; none of a leaf whose range is open or that is no value.
    fn dimension(&self, own: Option<&OwnRange>) -> Result<Option<(Dimension, Vec<Value>)>> {
        let words = self.words();
        if !words.is_empty() {
            if own.is_some() {
                bail!("--range {}: it takes words, not numbers", self.key());
            }
            let n_choices = words.len() as u32;
            let kind = Kind::Choice { n_choices };
            return Ok(Some((Dimension::new(self.key(), kind), words)));
        }
        let known = self.bounds();
        let (low, high) = match (own, known) {
            (Some(own), _) => (own.low, own.high),
            (None, [Some(low), Some(high)]) => (low, high),
            _ => return Ok(None),
        };
        if low < known[0].unwrap_or(low) || high > known[1].unwrap_or(high) {
            let [low, high] = known.map(|bound| bound.map_or("any".to_owned(), |b| b.to_string()));
            bail!("--range {}: it must stay in {low} to {high}", self.key());
        }
        let is_log = own.is_some_and(|own| own.is_log);
        let kind = match (self.parameter.kind, is_log) {
            (ValueKind::Integer, true) => Kind::LogInteger { low, high },
            (ValueKind::Integer, false) => Kind::Integer { low, high },
            (_, true) => Kind::LogReal { low, high },
            (_, false) => Kind::Real { low, high },
        };
        let is_number = self.value.is_number();
        Ok(is_number.then(|| (Dimension::new(self.key(), kind), Vec::new())))
    }
}

fn pointer(key: &str) -> String {
    format!("/{}", key.replace('.', "/"))
}

fn insert(table: &mut Map<String, Value>, key: &str, value: Value) {
    match key.split_once('.') {
        None => {
            table.insert(key.to_owned(), value);
        }
        Some((section, rest)) => {
            let inner = table
                .entry(section)
                .or_insert_with(|| Value::Object(Map::new()));
            if let Value::Object(inner) = inner {
                insert(inner, rest, value);
            }
        }
    }
}

fn is_within(key: &str, group: &str) -> bool {
    key.strip_prefix(group)
        .is_some_and(|rest| rest.starts_with('.'))
}

fn known(name: &str, leaves: &[Leaf]) -> Result<()> {
    if leaves.iter().any(|leaf| leaf.key() == name) {
        return Ok(());
    }
    let keys: Vec<&str> = leaves.iter().map(Leaf::key).collect();
    bail!(
        "the planner has no parameter {name:?} that can be tuned; there are {}",
        keys.join(", ")
    );
}

fn known_group(group: &str, leaves: &[Leaf]) -> Result<()> {
    if leaves.iter().any(|leaf| is_within(leaf.key(), group)) {
        return Ok(());
    }
    let mut groups: Vec<&str> = leaves
        .iter()
        .filter_map(|leaf| leaf.key().rsplit_once('.').map(|(group, _)| group))
        .collect();
    groups.sort_unstable();
    groups.dedup();
    bail!(
        "the planner has no group {group:?}; there are {}",
        groups.join(", ")
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::planner::PlannerName;
    use serde_json::json;

    /// Counts and costs that may be as large as they like.
    const WITHOUT_MAXIMUM: [&str; 4] = [
        "max_steps",
        "stall_iterations",
        "stall_generations",
        "target_cost",
    ];

    #[test]
    fn every_number_has_the_range_that_is_checked() {
        for planner in PlannerName::ALL {
            let base = serde_json::to_value(PlannerConfig::of(planner)).unwrap();
            let leaves = leaves(&base);
            let numbers = leaves.iter().filter(|leaf| leaf.value.is_number());
            let wrong: Vec<&str> = numbers
                .filter(|leaf| !beyond(leaf).all(|value| is_refused(&base, leaf.key(), value)))
                .map(Leaf::key)
                .collect();
            assert!(wrong.is_empty(), "taken outside of their range: {wrong:?}");
        }
    }

    /// Values just outside the range of a number.
    fn beyond(leaf: &Leaf) -> impl Iterator<Item = f64> {
        let [low, high] = leaf.bounds();
        let is_open = WITHOUT_MAXIMUM
            .iter()
            .any(|name| leaf.key().ends_with(name));
        assert!(low.is_some(), "{} has no least value", leaf.key());
        assert_eq!(
            high.is_none(),
            is_open,
            "the greatest value of {}",
            leaf.key()
        );
        low.map(|low| low - 1.0)
            .into_iter()
            .chain(high.map(|high| high + 1.0))
    }

    /// True if a document with another value in it is no configuration.
    fn is_refused(base: &Value, key: &str, value: f64) -> bool {
        let mut changed = base.clone();
        let place = changed.pointer_mut(&pointer(key)).unwrap();
        *place = if place.is_u64() {
            json!(value as i64)
        } else {
            json!(value)
        };
        serde_json::from_value::<PlannerConfig>(changed).map_or(true, |c| c.check().is_err())
    }
}

//! The values of a configuration, each with what is known of its parameter.

use formicar::parameters::{Parameter, Range};
use formicar::planner::PlannerConfig;
use serde_json::Value;
use std::collections::BTreeMap;
use std::ops::Bound;

/// A value of a configuration and its parameter.
pub(super) struct Leaf {
    pub(super) parameter: Parameter,
    pub(super) value: Value,
}

impl Leaf {
    /// The key, dotted.
    pub(super) fn key(&self) -> &str {
        &self.parameter.key
    }

    /// The words that it can be; both positions of a switch.
    pub(super) fn words(&self) -> Vec<Value> {
        if self.value.is_boolean() {
            return vec![Value::Bool(false), Value::Bool(true)];
        }
        let words = &self.parameter.words;
        if words.len() < 2 {
            return Vec::new();
        }
        words.iter().cloned().map(Value::from).collect()
    }

    /// The least and the greatest value, where the range is closed there.
    pub(super) fn bounds(&self) -> [Option<f64>; 2] {
        let closed = |bound: Bound<f64>| match bound {
            Bound::Included(number) => Some(number),
            Bound::Excluded(_) | Bound::Unbounded => None,
        };
        let range = self.parameter.range;
        range.map_or([None; 2], |Range { low, high }| [low, high].map(closed))
    }
}

/// The allowed values of each parameter of a configuration, by dotted key, in the unit that the
/// key ends with; rules and lists are left out.
pub(crate) fn ranges(config: &Value) -> BTreeMap<String, String> {
    let leaves = leaves(config).into_iter();
    leaves
        .map(|leaf| (leaf.key().to_owned(), leaf.parameter.allowed()))
        .collect()
}

/// All values of a configuration, sorted by key, except the planner's name, the names of rules,
/// and lists.
pub(super) fn leaves(base: &Value) -> Vec<Leaf> {
    let parameters = PlannerConfig::parameters().into_iter();
    let leaf = |parameter: Parameter| {
        let value = parameter.value_in(base)?.clone();
        let is_leaf = !(value.is_array() || value.is_object() || value.is_null());
        is_leaf.then_some(Leaf { parameter, value })
    };
    parameters
        .filter(|parameter| parameter.key != "planner" && !parameter.is_slot())
        .filter_map(leaf)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::planner::PlannerName;

    #[test]
    fn ranges_are_those_of_the_schema() {
        let config = PlannerConfig::of(PlannerName::Lei2020);
        let ranges = ranges(&serde_json::to_value(config).unwrap());
        let of = |key: &str| ranges[key].as_str();
        assert_eq!(of("layers.u_shapes"), "keep, close");
        assert!(of("colony.n_ants").starts_with("1 to "), "{ranges:?}");
        assert!(!ranges.contains_key("planner"));
    }
}

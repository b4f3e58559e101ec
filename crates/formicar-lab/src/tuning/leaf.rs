//! The values of a configuration, each with its part of the schema.

use formicar::planner::PlannerConfig;
use serde_json::Value;
use std::collections::BTreeMap;

/// A leaf of the configuration: its key, its value, and its part of the schema.
pub(super) struct Leaf {
    pub(super) key: String,
    pub(super) value: Value,
    pub(super) schema: Value,
}

impl Leaf {
    /// The words that it can be; both positions of a switch.
    pub(super) fn words(&self) -> Vec<Value> {
        if self.value.is_boolean() {
            return vec![Value::Bool(false), Value::Bool(true)];
        }
        if !self.value.is_string() {
            return Vec::new();
        }
        let variants = self.schema["oneOf"].as_array().into_iter().flatten();
        let constants = variants.filter_map(|variant| variant.get("const").cloned());
        let listed = self.schema["enum"].as_array().into_iter().flatten();
        let words: Vec<Value> = constants.chain(listed.cloned()).collect();
        if words.len() < 2 { Vec::new() } else { words }
    }

    /// What it can be, in words; empty where the schema does not tell.
    fn range(&self) -> String {
        let bound = |name: &str| self.schema.get(name).and_then(Value::as_f64);
        let (least, above) = (bound("minimum"), bound("exclusiveMinimum"));
        match (least, above, bound("maximum")) {
            (Some(low), _, Some(high)) => format!("{low} to {high}"),
            (Some(low), _, None) => format!("from {low}"),
            (None, Some(low), Some(high)) => format!("above {low}, to {high}"),
            (None, Some(low), None) => format!("above {low}"),
            (None, None, Some(high)) => format!("to {high}"),
            (None, None, None) => {
                let words = self.words();
                let words = words.iter().map(|word| match word {
                    Value::String(word) => word.clone(),
                    other => other.to_string(),
                });
                words.collect::<Vec<_>>().join(", ")
            }
        }
    }
}

/// What each value of a configuration can be by the schema, by dotted key, in the unit that the
/// key ends with; nothing of rules and lists.
pub(crate) fn ranges(config: &Value) -> BTreeMap<String, String> {
    let leaves = leaves(config).into_iter();
    leaves
        .map(|leaf| (leaf.key.clone(), leaf.range()))
        .collect()
}

/// All values of a configuration but the planner's name, the names of rules, and lists.
pub(super) fn leaves(base: &Value) -> Vec<Leaf> {
    let schema = schemars::schema_for!(PlannerConfig).to_value();
    let mut leaves = Vec::new();
    collect(&mut leaves, String::new(), base, (&schema, &schema));
    leaves.retain(|leaf| leaf.key != "planner");
    // The order of a document's keys is that of the JSON library; that of dimensions is ours.
    leaves.sort_by(|a, b| a.key.cmp(&b.key));
    leaves
}

fn collect(leaves: &mut Vec<Leaf>, key: String, value: &Value, (part, whole): (&Value, &Value)) {
    let part = resolved(part, whole);
    let Value::Object(fields) = value else {
        if !(value.is_array() || value.is_null()) {
            leaves.push(Leaf {
                key,
                value: value.clone(),
                schema: part,
            });
        }
        return;
    };
    // The variant of the rule in use, beside what all variants have.
    let variants = part["oneOf"].as_array().into_iter().flatten();
    let variants = variants.map(|variant| resolved(variant, whole));
    let of_rule: Vec<Value> = variants
        .filter(|variant| variant["properties"]["rule"]["const"] == value["rule"])
        .collect();
    for (name, value) in fields {
        if name == "rule" {
            continue;
        }
        let places = std::iter::once(&part).chain(&of_rule);
        let mut found = places.filter_map(|place| place["properties"].get(name));
        let dot = if key.is_empty() { "" } else { "." };
        let inner = found.next_back().unwrap_or(&Value::Null);
        collect(leaves, format!("{key}{dot}{name}"), value, (inner, whole));
    }
}

/// A part of a schema with what it refers to laid in.
fn resolved(part: &Value, whole: &Value) -> Value {
    let reference = part.get("$ref").and_then(Value::as_str);
    let target = reference.and_then(|path| whole.pointer(path.trim_start_matches('#')));
    let (Some(Value::Object(target)), Value::Object(own)) = (target, part) else {
        return part.clone();
    };
    let mut merged = target.clone();
    merged.extend(own.iter().map(|(key, value)| (key.clone(), value.clone())));
    merged.remove("$ref");
    Value::Object(merged)
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

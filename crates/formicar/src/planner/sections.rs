//! The configuration as a document: sections, of which only those in use are written.

use super::{PlannerConfig, PlannerName};
use serde::de::{DeserializeOwned, Error};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serializer};
use serde_json::{Map, Value};

/// Names of the sections.
const SECTIONS: [&str; 12] = [
    "hybrid_astar",
    "drive",
    "cost",
    "improve",
    "replan",
    "grid_search",
    "improved_astar",
    "layers",
    "colony",
    "chords",
    "evolution",
    "smoothing",
];
/// The key of the planner's name.
const PLANNER: &str = "planner";
/// The key of the name of a rule, beside the rule's parameters.
const RULE: &str = "rule";

/// Writes the planner and the sections that it uses.
pub(super) fn write<S: Serializer>(
    config: &PlannerConfig,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(None)?;
    map.serialize_entry(PLANNER, &config.planner)?;
    for &name in sections_of(config.planner) {
        match name {
            "hybrid_astar" => map.serialize_entry(name, &config.hybrid_astar)?,
            "drive" => map.serialize_entry(name, &config.drive)?,
            "cost" => map.serialize_entry(name, &config.cost)?,
            "improve" => map.serialize_entry(name, &config.improve)?,
            "replan" => map.serialize_entry(name, &config.replan)?,
            "grid_search" => map.serialize_entry(name, &config.grid_search)?,
            "improved_astar" => map.serialize_entry(name, &config.improved_astar)?,
            "layers" => map.serialize_entry(name, &config.layers)?,
            "colony" => map.serialize_entry(name, &config.colony)?,
            "chords" => map.serialize_entry(name, &config.chords)?,
            "evolution" => map.serialize_entry(name, &config.evolution)?,
            _ => map.serialize_entry(name, &config.smoothing)?,
        }
    }
    map.end()
}

/// The sections that a planner uses.
fn sections_of(planner: PlannerName) -> &'static [&'static str] {
    match planner {
        PlannerName::Formicar => &["hybrid_astar", "drive", "cost", "improve", "replan"],
        PlannerName::HybridAstar => &["hybrid_astar"],
        PlannerName::Astar | PlannerName::Dijkstra => &["grid_search", "smoothing"],
        PlannerName::ImprovedAstar => &["grid_search", "improved_astar", "smoothing"],
        PlannerName::Ga | PlannerName::Aga => &["grid_search", "evolution", "smoothing"],
        PlannerName::Faco2024 => &["chords", "smoothing"],
        _ => &["layers", "colony", "smoothing"],
    }
}

/// Reads what is given onto the defaults of the planner that is named.
pub(super) fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<PlannerConfig, D::Error> {
    let mut given = Map::deserialize(deserializer)?;
    let planner = match given.remove(PLANNER) {
        Some(name) => serde_json::from_value(name)
            .map_err(|error| Error::custom(format!("{PLANNER}: {error}")))?,
        None => PlannerName::default(),
    };
    if let Some(stray) = given.keys().find(|key| !SECTIONS.contains(&key.as_str())) {
        let known = SECTIONS.join(", ");
        let message = format!("unknown section {stray:?}; there are {PLANNER}, {known}");
        return Err(Error::custom(message));
    }
    let defaults = PlannerConfig::of(planner);
    Ok(PlannerConfig {
        planner,
        hybrid_astar: section(&mut given, "hybrid_astar", defaults.hybrid_astar)?,
        drive: section(&mut given, "drive", defaults.drive)?,
        cost: section(&mut given, "cost", defaults.cost)?,
        improve: section(&mut given, "improve", defaults.improve)?,
        replan: section(&mut given, "replan", defaults.replan)?,
        grid_search: section(&mut given, "grid_search", defaults.grid_search)?,
        improved_astar: section(&mut given, "improved_astar", defaults.improved_astar)?,
        layers: section(&mut given, "layers", defaults.layers)?,
        colony: section(&mut given, "colony", defaults.colony)?,
        chords: section(&mut given, "chords", defaults.chords)?,
        evolution: section(&mut given, "evolution", defaults.evolution)?,
        smoothing: section(&mut given, "smoothing", defaults.smoothing)?,
    })
}

/// A section of the given document, laid onto its defaults.
fn section<T, E>(given: &mut Map<String, Value>, name: &str, defaults: T) -> Result<T, E>
where
    T: DeserializeOwned + serde::Serialize,
    E: Error,
{
    let Some(given) = given.remove(name) else {
        return Ok(defaults);
    };
    let fail = |error: serde_json::Error| E::custom(format!("{name}: {error}"));
    let mut whole = serde_json::to_value(defaults).map_err(fail)?;
    lay(given, &mut whole);
    serde_json::from_value(whole).map_err(fail)
}

/// Lays given values onto others, table by table; another rule brings its own parameters.
fn lay(given: Value, onto: &mut Value) {
    match (given, onto) {
        (Value::Object(given), Value::Object(onto)) => {
            if given
                .get(RULE)
                .is_some_and(|rule| onto.get(RULE) != Some(rule))
            {
                onto.clear();
            }
            for (key, value) in given {
                lay(value, onto.entry(key).or_insert(Value::Null));
            }
        }
        (given, onto) => *onto = given,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colony::evaporation::{Constant, Evaporation};
    use crate::colony::presets;

    fn read(json: &str) -> Result<PlannerConfig, String> {
        serde_json::from_str(json).map_err(|error| error.to_string())
    }

    #[test]
    fn what_is_left_out_is_that_of_the_planner() {
        let config = read(r#"{"planner": "wang2019", "colony": {"n_ants": 50}}"#).unwrap();
        let mut expected = PlannerConfig::of(PlannerName::Wang2019);
        expected.colony.n_ants = 50;
        assert_eq!(config, expected);
        assert_eq!(read("{}").unwrap(), PlannerConfig::default());
    }

    #[test]
    fn a_rule_keeps_its_parameters_and_another_brings_its_own() {
        let rho = |json: &str| read(json).unwrap().colony.evaporation;
        let stretched =
            rho(r#"{"planner": "lei2020", "colony": {"evaporation": {"stretch": 7.5}}}"#);
        let mut expected = presets::lei2020().evaporation;
        if let Evaporation::Poisson(poisson) = &mut expected {
            poisson.stretch = 7.5;
        }
        assert_eq!(stretched, expected);
        let constant = r#"{"rule": "constant", "rho": 0.3}"#;
        let constant = rho(&format!(
            r#"{{"planner": "lei2020", "colony": {{"evaporation": {constant}}}}}"#
        ));
        assert_eq!(constant, Evaporation::Constant(Constant { rho: 0.3 }));
    }

    #[test]
    fn every_planner_is_read_back_as_written() {
        for planner in PlannerName::ALL {
            let config = PlannerConfig::of(planner);
            let json = serde_json::to_string(&config).unwrap();
            assert_eq!(read(&json).unwrap(), config, "{json}");
        }
    }

    #[test]
    fn what_is_unknown_or_of_the_wrong_type_is_named() {
        for (bad, named) in [
            (r#"{"colonie": {}}"#, "colonie"),
            (r#"{"planner": "ants"}"#, "lei2020"),
            (r#"{"colony": {"n_ant": 3}}"#, "n_ants"),
            (r#"{"colony": {"n_ants": "many"}}"#, "colony"),
            (
                r#"{"colony": {"evaporation": {"rule": "poison"}}}"#,
                "poisson",
            ),
            (r#"{"colony": {"evaporation": {"lambda": 3}}}"#, "rho"),
        ] {
            let message = read(bad).unwrap_err();
            assert!(message.contains(named), "{message}");
        }
    }
}

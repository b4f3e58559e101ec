//! Configurations as documents: read onto the preset of the planner they name.

use super::catalog::{PlannerConfig, PlannerName};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};

/// The key of the planner's name.
const PLANNER: &str = "planner";

impl<'de> Deserialize<'de> for PlannerConfig {
    /// Reads what is given onto the preset of the planner that is named. Sections of other
    /// planners may stand beside its own; they are checked and left out.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut given = Map::<String, Value>::deserialize(deserializer)?;
        let planner = match given.remove(PLANNER) {
            Some(name) => serde_json::from_value(name)
                .map_err(|error| D::Error::custom(format!("{PLANNER}: {error}")))?,
            None => PlannerName::default(),
        };
        let known = all_sections();
        if let Some(stray) = given.keys().find(|key| !known.contains(&key.as_str())) {
            let known = known.join(", ");
            let message = format!("unknown section {stray:?}; there are {PLANNER}, {known}");
            return Err(D::Error::custom(message));
        }
        if let Some((key, now)) = renamed(&given) {
            let message = format!("unknown key {key}; hint: it is {now} now");
            return Err(D::Error::custom(message));
        }
        let config = Self::of(planner).laid(&mut given)?;
        for other in PlannerName::ALL {
            if given.is_empty() {
                break;
            }
            let other = Self::of(other).laid::<D::Error>(&mut given)?;
            other.check().map_err(D::Error::custom)?;
        }
        Ok(config)
    }
}

/// Keys of earlier versions, and what stands for them now.
const RENAMED: [(&str, &str, &str); 6] = [
    (
        "cost",
        "gear_switch_m",
        "cost.gear_switch_radii, in turning radii",
    ),
    (
        "cost",
        "clearance_wish_m",
        "cost.clearance_wish_widths, in widths of the body",
    ),
    ("hybrid_astar", "reverse_penalty", "cost.reverse_factor"),
    (
        "hybrid_astar",
        "direction_switching_cost",
        "cost.gear_switch_radii, in turning radii",
    ),
    ("hybrid_astar", "cost_penalty", "cost.clearance_weight"),
    (
        "hybrid_astar",
        "clearance_wish_m",
        "cost.clearance_wish_widths, in widths of the body",
    ),
];

/// The first key of an earlier version in a document, and what stands for it now.
fn renamed(given: &Map<String, Value>) -> Option<(String, &'static str)> {
    let found = RENAMED
        .iter()
        .find(|(section, key, _)| given.get(*section).is_some_and(|s| s.get(key).is_some()));
    found.map(|(section, key, now)| (format!("{section}.{key}"), *now))
}

/// Names of the sections of all planners, each once.
fn all_sections() -> Vec<&'static str> {
    let mut names = Vec::new();
    for planner in PlannerName::ALL {
        for &name in PlannerConfig::of(planner).section_names() {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    names
}

#[cfg(feature = "schema")]
impl PlannerConfig {
    /// Every parameter that a configuration may have, for every rule.
    pub fn parameters() -> Vec<crate::parameters::Parameter> {
        crate::parameters::list(&schemars::schema_for!(Self))
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for PlannerConfig {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "PlannerConfig".into()
    }

    /// The sections of all planners side by side: a document may hold any of them.
    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let mut properties = Map::new();
        let mut schemas = Self::section_schemas(generator);
        // Defaults of a section that several planners have: those of the default planner, else of
        // the last ones, which are colonies.
        schemas[1..].reverse();
        for schema in schemas {
            let sections = schema.get("properties").and_then(Value::as_object);
            for (name, section) in sections.into_iter().flatten() {
                properties.entry(name.clone()).or_insert(section.clone());
            }
        }
        let mut planner = generator.subschema_for::<PlannerName>();
        planner.insert("description".to_owned(), "The planner to use.".into());
        planner.insert("default".to_owned(), PlannerName::default().name().into());
        properties.insert(PLANNER.to_owned(), planner.to_value());
        schemars::json_schema!({
            "description": "Which planner, and the parameters of each.",
            "type": "object",
            "properties": properties,
            "additionalProperties": false,
        })
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
        expected.colony_mut().unwrap().colony.n_ants = 50;
        assert_eq!(config, expected);
        assert_eq!(read("{}").unwrap(), PlannerConfig::default());
    }

    #[test]
    fn a_rule_keeps_its_parameters_and_another_brings_its_own() {
        let evaporation = |json: &str| {
            let config = read(json).unwrap();
            config.colony().unwrap().colony.evaporation.clone()
        };
        let stretched =
            evaporation(r#"{"planner": "lei2020", "colony": {"evaporation": {"stretch": 7.5}}}"#);
        let mut expected = presets::lei2020().evaporation;
        if let Evaporation::Poisson(poisson) = &mut expected {
            poisson.stretch = 7.5;
        }
        assert_eq!(stretched, expected);
        let constant = r#"{"rule": "constant", "rho": 0.3}"#;
        let constant = evaporation(&format!(
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
            (
                r#"{"cost": {"gear_switch_m": 10.0}}"#,
                "cost.gear_switch_m; hint: it is cost.gear_switch_radii",
            ),
            (
                r#"{"hybrid_astar": {"reverse_penalty": 3.0}}"#,
                "cost.reverse_factor",
            ),
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

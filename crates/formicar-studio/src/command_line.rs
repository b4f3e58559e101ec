//! The command line and the configuration file that repeat a plan.

use formicar::planner::{Answer, PlannerConfig, RequestDocument};
use formicar::scenario::CurvatureMode;
use serde::Serialize;
use serde_json::Value as Json;

/// The configuration file of an answer.
pub(crate) fn toml(config: &PlannerConfig) -> String {
    toml::to_string(config).unwrap_or_else(|error| format!("# {error}\n"))
}

/// The command that plans the same. `map` is a built-in map or a file; a vehicle that is no preset
/// is the file `vehicle.json`.
pub(crate) fn line(answer: &Answer, request: &RequestDocument, map: &str, seed: u64) -> String {
    let provenance = &answer.provenance;
    let vehicle = match provenance.vehicle.name.as_str() {
        "own" => "vehicle.json",
        name => name,
    };
    let mut words = vec![format!(
        "formicar plan --map {} --vehicle {}",
        quoted(map),
        quoted(vehicle)
    )];
    words.extend(request_flags(request));
    words.push(format!("--planner {} --seed {seed}", answer.planner));
    words.extend(
        provenance
            .config
            .as_ref()
            .and_then(|config| config.known())
            .map(settings),
    );
    words.join(" ").trim_end().to_owned()
}

/// The flags of the fields that a request sets.
fn request_flags(request: &RequestDocument) -> Vec<String> {
    let pose = |flag: &str, [x, y, heading]: [f64; 3]| format!("{flag}={x:?},{y:?},{heading:?}");
    let goals = request.goal.into_iter();
    let goals = goals.chain(request.goals.iter().flatten().copied());
    let tolerance = request.goal_tolerance;
    let curvature = request.curvature.map(|curvature| match curvature {
        CurvatureMode::Continuous(rate) => rate.max_rate_per_m2.map_or_else(
            || "--continuous-curvature".to_owned(),
            |rate| format!("--continuous-curvature={rate}"),
        ),
        _ => String::new(),
    });
    let flags = [
        word("--motion", request.motion),
        word("--start-heading", request.start_heading),
        word("--goal-heading", request.goal_heading),
        tolerance.map(|t| format!("--goal-tolerance={},{}", t.xy_m, t.yaw_rad)),
        curvature.filter(|flag| !flag.is_empty()),
        request.deadline_ms.map(|ms| format!("--deadline {ms}")),
        request.budget_steps.map(|n| format!("--budget {n}")),
    ];
    let start = request.start.map(|start| pose("--start", start));
    let goals = goals.map(|goal| pose("--goal", goal));
    start
        .into_iter()
        .chain(goals)
        .chain(flags.into_iter().flatten())
        .collect()
}

/// A flag with the value as a word.
fn word(flag: &str, value: Option<impl Serialize>) -> Option<String> {
    let word = serde_json::to_value(value?).ok()?;
    Some(format!("{flag} {}", word.as_str()?))
}

/// The flags that turn the defaults of a planner into a configuration: single keys if possible.
fn settings(config: &PlannerConfig) -> String {
    let values = [config, &PlannerConfig::of(config.planner())].map(serde_json::to_value);
    let [Ok(own), Ok(default)] = values else {
        return String::new();
    };
    let mut sets = Vec::new();
    match differences("", &own, &default, &mut sets) {
        Some(()) => sets.join(" "),
        None => "--config planner.toml".to_owned(),
    }
}

/// Collects `--set` flags; none if some difference cannot be set by a single key.
fn differences(key: &str, own: &Json, default: &Json, sets: &mut Vec<String>) -> Option<()> {
    match (own, default) {
        _ if own == default => {}
        (Json::Object(own), Json::Object(default)) if own.len() == default.len() => {
            for (name, value) in own {
                let dot = if key.is_empty() { "" } else { "." };
                differences(
                    &format!("{key}{dot}{name}"),
                    value,
                    default.get(name)?,
                    sets,
                )?;
            }
        }
        (Json::Number(_) | Json::Bool(_), _) => sets.push(format!("--set {key}={own}")),
        (Json::String(word), Json::String(_)) => sets.push(format!("--set {key}={}", quoted(word))),
        _ => return None,
    }
    Some(())
}

/// A word for a shell.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./:@%+,".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::planner::PlannerName;

    #[test]
    fn only_differences_are_set() {
        let mut config = PlannerConfig::of(PlannerName::Lei2020);
        assert_eq!(settings(&config), "");
        config.colony_mut().unwrap().colony.n_ants = 17;
        assert_eq!(settings(&config), "--set colony.n_ants=17");
        config.colony_mut().unwrap().colony = PlannerName::MaxMin.colony().unwrap();
        assert_eq!(settings(&config), "--config planner.toml");
    }

    #[test]
    fn all_fields_of_a_request_become_flags() {
        let request = r#"{"start": [1, 2, 0], "goal": [3.5, -4, 1], "motion": "forward",
            "goal_heading": "any", "goal_tolerance": {"xy": 0.2, "yaw": 0.1}, "deadline_ms": 500,
            "budget_steps": 900, "curvature": {"continuous": {"max_rate_per_m2": 0.5}}}"#;
        let request: RequestDocument = serde_json::from_str(request).unwrap();
        let flags = "--start=1.0,2.0,0.0 --goal=3.5,-4.0,1.0 --motion forward --goal-heading any \
            --goal-tolerance=0.2,0.1 --continuous-curvature=0.5 --deadline 500 --budget 900";
        assert_eq!(request_flags(&request).join(" "), flags);
    }

    #[test]
    fn a_configuration_file_reads_back() {
        for planner in PlannerName::ALL {
            let config = PlannerConfig::of(planner);
            let back: PlannerConfig = toml::from_str(&toml(&config)).unwrap();
            assert_eq!(back, config, "{planner:?}");
        }
    }

    #[test]
    fn words_are_quoted_for_a_shell() {
        assert_eq!(quoted("neighborhood"), "neighborhood");
        assert_eq!(quoted("my map; rm -rf ~"), "'my map; rm -rf ~'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
    }
}

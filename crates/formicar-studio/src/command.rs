//! A request as a line for a terminal and as a configuration file.

use formicar::planner::{Answer, PlannerConfig};
use serde_json::Value as Json;

/// The configuration file of an answer.
pub(crate) fn toml(config: &PlannerConfig) -> String {
    toml::to_string(config).unwrap_or_else(|error| format!("# {error}\n"))
}

/// The command that asks the same, where the map is a built-in or the file `map`, and the vehicle
/// a preset or the file `vehicle.json`.
pub(crate) fn line(answer: &Answer, map: &str, seed: u64) -> String {
    let provenance = &answer.provenance;
    let mut words = vec!["formicar plan --map".to_owned(), quoted(map)];
    let vehicle = match provenance.vehicle.name.as_str() {
        "own" => "vehicle.json",
        name => name,
    };
    words.push(format!("--vehicle {}", quoted(vehicle)));
    let request = provenance.request.as_ref();
    let request = request.and_then(|request| serde_json::to_value(request).ok());
    for (key, flag) in [("start", "--start"), ("goal", "--goal")] {
        let pose = request.as_ref().and_then(|request| request[key].as_array());
        let numbers = pose.map(|pose| pose.iter().map(ToString::to_string).collect::<Vec<_>>());
        words.extend(numbers.map(|numbers| format!("{flag}={}", numbers.join(","))));
    }
    for (key, flag, default) in [
        ("motion", "--motion", "reverse"),
        ("start_heading", "--start-heading", "exact"),
        ("goal_heading", "--goal-heading", "exact"),
    ] {
        let word = request.as_ref().and_then(|request| request[key].as_str());
        let other = word.filter(|&word| word != default);
        words.extend(other.map(|word| format!("{flag} {word}")));
    }
    words.push(format!("--planner {} --seed {seed}", answer.planner));
    words.push(settings(&provenance.config));
    words.join(" ").trim_end().to_owned()
}

/// What makes the defaults of a planner its configuration: single keys where that suffices.
fn settings(config: &PlannerConfig) -> String {
    let values = [config, &PlannerConfig::of(config.planner)].map(serde_json::to_value);
    let [Ok(own), Ok(default)] = values else {
        return String::new();
    };
    let mut sets = Vec::new();
    match differences("", &own, &default, &mut sets) {
        Some(()) => sets.join(" "),
        None => "--config planner.toml".to_owned(),
    }
}

/// Collects `--set` flags; none where something differs that no single key can say.
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
    fn only_what_differs_is_said() {
        let mut config = PlannerConfig::of(PlannerName::Lei2020);
        assert_eq!(settings(&config), "");
        config.colony.n_ants = 17;
        assert_eq!(settings(&config), "--set colony.n_ants=17");
        config.colony = PlannerConfig::of(PlannerName::MaxMin).colony;
        assert_eq!(settings(&config), "--config planner.toml");
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

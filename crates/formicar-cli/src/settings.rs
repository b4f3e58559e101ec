//! Planner parameters from a TOML file and `--set key=value`.

use anyhow::{Context, Result, anyhow, bail};
use formicar::planner::{PlannerConfig, PlannerName};
use formicar::vehicle::Motion;
use std::path::Path;
use toml::{Table, Value};

/// Planner parameters.
#[derive(Debug)]
pub(crate) struct Settings {
    config: PlannerConfig,
    /// The parameters for a point, where no planner was chosen.
    of_point: Option<PlannerConfig>,
}

impl Settings {
    /// The parameters for a vehicle: a point, which the default planner does not drive, is planned for by
    /// A* unless a planner was chosen.
    pub(crate) fn for_motion(self, motion: Motion) -> PlannerConfig {
        match (motion, self.of_point) {
            (Motion::Point, Some(of_point)) => of_point,
            _ => self.config,
        }
    }
}

/// The parameters: defaults, then the file, then single keys, then the planner's name.
pub(crate) fn load(
    file: Option<&Path>,
    sets: &[String],
    planner: Option<PlannerName>,
) -> Result<Settings> {
    let table = match file {
        Some(path) => read(path)?,
        None => Table::new(),
    };
    let mut table = merge(table, &name_of(file), sets, planner)?;
    let config = typed(&table)?;
    let of_point = if table.contains_key("planner") {
        None
    } else {
        // What is left out is that of A*, whose defaults are not those of the default planner.
        table.insert("planner".to_owned(), PlannerName::Astar.name().into());
        Some(typed(&table).with_context(|| name_of(file))?)
    };
    Ok(Settings { config, of_point })
}

/// The parameters of a table, of which every key is known, for a vehicle.
pub(crate) fn of_table(mut table: Table, motion: Motion) -> Result<PlannerConfig> {
    if let Some((_, error)) = unknown(&table) {
        return Err(error);
    }
    if motion == Motion::Point && !table.contains_key("planner") {
        table.insert("planner".to_owned(), PlannerName::Astar.name().into());
    }
    let config = typed(&table)?;
    config.check()?;
    Ok(config)
}

/// A table of a name, with single keys and the planner's name in it; what it comes to is checked.
pub(crate) fn merge(
    mut table: Table,
    name: &str,
    sets: &[String],
    planner: Option<PlannerName>,
) -> Result<Table> {
    if let Some(planner) = planner {
        table.insert("planner".to_owned(), planner.name().into());
    }
    let mut config = typed(&table).with_context(|| name.to_owned())?;
    for set in sets {
        apply(&mut table, set)?;
        config = typed(&table).with_context(|| format!("--set {set:?}"))?;
    }
    config.check()?;
    Ok(table)
}

/// The parameters in a table, each of its own type.
pub(crate) fn typed(table: &Table) -> Result<PlannerConfig> {
    let config = table.clone().try_into();
    config.map_err(|e: toml::de::Error| anyhow!("{}", one_line(&e)))
}

fn name_of(file: Option<&Path>) -> String {
    file.map_or("the planner's parameters".to_owned(), |path| {
        path.display().to_string()
    })
}

/// The table of a file, whose keys are all known.
pub(crate) fn read(path: &Path) -> Result<Table> {
    let text = super::files::read_text(path)?;
    let table: Table = text
        .parse()
        .map_err(|e| anyhow!("{}: {}", path.display(), one_line(&e)))?;
    match unknown(&table) {
        Some((_, error)) => Err(error).with_context(|| path.display().to_string()),
        None => Ok(table),
    }
}

/// The first key of a table that no planner knows, and what to say of it.
pub(crate) fn unknown(table: &Table) -> Option<(String, anyhow::Error)> {
    let known = known_keys();
    let mut keys = keys_of(table, "").into_iter();
    let key = keys.find(|key| !is_known(key, &known))?;
    let error = unknown_key(&key, &known);
    Some((key, error))
}

/// Sets one dotted key.
fn apply(table: &mut Table, set: &str) -> Result<()> {
    let Some((key, text)) = set.split_once('=') else {
        bail!("--set {set:?}: expected KEY=VALUE, for instance hybrid_astar.weight=1.2");
    };
    let (key, known) = (key.trim(), known_keys());
    if !known.iter().any(|k| k == key) {
        return Err(unknown_key(key, &known)).with_context(|| format!("--set {set:?}"));
    }
    let mut parts: Vec<&str> = key.split('.').collect();
    let last = parts.pop().unwrap_or_default();
    let mut inner = table;
    for part in parts {
        let entry = inner
            .entry(part)
            .or_insert_with(|| Value::Table(Table::new()));
        let Value::Table(next) = entry else {
            bail!("--set {set:?}: {part} is no table in the configuration file");
        };
        inner = next;
    }
    inner.insert(last.to_owned(), value(text.trim()));
    Ok(())
}

/// A TOML value; a bare word is a string.
fn value(text: &str) -> Value {
    let parsed = format!("v = {text}").parse::<Table>().ok();
    let parsed = parsed
        .filter(|table| table.len() == 1)
        .and_then(|mut table| table.remove("v"));
    parsed.unwrap_or_else(|| Value::String(text.to_owned()))
}

/// Every key that a configuration may have, dotted.
pub(crate) fn known_keys() -> Vec<String> {
    let parameters = PlannerConfig::parameters().into_iter();
    let mut keys: Vec<String> = parameters.map(|parameter| parameter.key).collect();
    keys.dedup();
    keys
}

/// The keys of a table, dotted.
pub(crate) fn keys_of(table: &Table, prefix: &str) -> Vec<String> {
    let keys = table.iter().flat_map(|(key, value)| {
        let dotted = format!("{prefix}{key}");
        match value {
            Value::Table(inner) if !inner.is_empty() => keys_of(inner, &format!("{dotted}.")),
            _ => vec![dotted],
        }
    });
    keys.collect()
}

/// A key is known by itself or, as an empty table, by what could stand in it.
fn is_known(key: &str, known: &[String]) -> bool {
    let within = format!("{key}.");
    known.iter().any(|k| k == key || k.starts_with(&within))
}

fn unknown_key(key: &str, known: &[String]) -> anyhow::Error {
    let section = key.split('.').next().unwrap_or_default();
    let within = format!("{section}.");
    let mut near: Vec<&str> = known.iter().map(String::as_str).collect();
    if near.iter().any(|known| known.starts_with(&within)) {
        near.retain(|known| known.starts_with(&within));
    }
    anyhow!(
        "no planner parameter is named {key:?}; there are {}",
        near.join(", ")
    )
}

fn one_line(error: &toml::de::Error) -> String {
    error.message().replace('\n', " ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::planner::AstarParameters;

    fn with(sets: &[&str]) -> Result<PlannerConfig> {
        let sets: Vec<_> = sets.iter().map(|s| (*s).to_owned()).collect();
        Ok(load(None, &sets, None)?.for_motion(Motion::Car))
    }

    #[test]
    fn a_point_is_planned_for_on_the_grid_unless_told_otherwise() {
        let planner = |choice| {
            let settings = load(None, &[], choice).unwrap();
            settings.for_motion(Motion::Point).planner()
        };
        assert_eq!(planner(None), PlannerName::Astar);
        assert_eq!(planner(Some(PlannerName::Dijkstra)), PlannerName::Dijkstra);
        assert_eq!(
            planner(Some(PlannerName::HybridAstar)),
            PlannerName::HybridAstar
        );
    }

    #[test]
    fn a_point_gets_the_defaults_of_astar_and_what_was_set() {
        let sets = ["grid_search.diagonal_rule=always".to_owned()];
        let config = load(None, &sets, None).unwrap().for_motion(Motion::Point);
        let mut expected = AstarParameters::default();
        expected.grid_search.diagonal_rule = formicar::map::DiagonalRule::Always;
        assert_eq!(config, PlannerConfig::Astar(expected));
    }

    #[test]
    fn sets_numbers_and_words() {
        let config = with(&["hybrid_astar.weight=2", "planner=hybrid-astar"]).unwrap();
        let PlannerConfig::HybridAstar(parameters) = config else {
            panic!("{config:?}")
        };
        assert_eq!(parameters.hybrid_astar.weight, 2.0);
        // What another planner uses may stand beside it.
        let config = with(&["hybrid_astar.weight=2", "planner=astar"]).unwrap();
        assert_eq!(config, PlannerConfig::of(PlannerName::Astar));
    }

    #[test]
    fn unknown_keys_are_refused_with_the_keys_there_are() {
        for bad in ["hybrid_astar.wieght=2", "weight=2", "hybrid_astar=2", "=2"] {
            let message = format!("{:#}", with(&[bad]).unwrap_err());
            assert!(message.contains("hybrid_astar.weight"), "{message}");
        }
    }

    #[test]
    fn values_out_of_range_or_kind_are_refused() {
        for bad in [
            "hybrid_astar.weight=0",
            "hybrid_astar.weight=fast",
            "planner=ants",
            "planner",
        ] {
            assert!(with(&[bad]).is_err(), "{bad}");
        }
        assert!(with(&["hybrid_astar.weight=nan"]).is_err());
    }
}

//! The origin of each parameter of a configuration.

use super::{Field, Table};
use serde::Serialize;
use serde_json::Value;

/// The origin of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// The paper states it.
    Stated,
    /// The paper leaves it open, and it was read so from what the paper says.
    Read,
    /// The paper says nothing of it.
    Chosen,
    /// A search found it.
    Tuned,
}

impl Source {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stated => "stated",
            Self::Read => "read",
            Self::Chosen => "chosen",
            Self::Tuned => "tuned",
        }
    }
}

/// A parameter, its value, and where that comes from.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Parameter {
    /// Its key in the configuration.
    pub key: String,
    /// Its value.
    pub value: String,
    /// The origin of the value.
    pub source: Source,
    /// The place in the paper, or the reason.
    pub note: String,
}

/// All parameters of a configuration.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ParameterSheet {
    /// The parameters in the order of the configuration.
    pub parameters: Vec<Parameter>,
}

/// The origin of a key, or of all keys that begin with it: `(key, source, note)`.
pub type Known<'a> = (&'a str, Source, &'a str);

impl ParameterSheet {
    /// The leaves of a configuration whose keys begin with one of `parts`. What is not known is
    /// chosen; of what is known the longest key counts.
    pub fn new(config: &Value, parts: &[&str], known: &[Known]) -> Self {
        let belongs = |key: &str| parts.iter().any(|part| is_under(key, part));
        let leaves = leaves(config).into_iter().filter(|(key, _)| belongs(key));
        let parameter = |(key, value): (String, String)| {
            let of_key = known.iter().filter(|(part, ..)| is_under(&key, part));
            let best = of_key.max_by_key(|(part, ..)| part.len());
            let (source, note) = best.map_or((Source::Chosen, ""), |known| (known.1, known.2));
            Parameter {
                value,
                source,
                note: note.to_owned(),
                key,
            }
        };
        Self {
            parameters: leaves.map(parameter).collect(),
        }
    }

    /// The sheet as a table.
    pub fn table(&self, key: &str) -> Table {
        let caption = "Every parameter of the configuration: stated by the paper, read from what \
                       the paper leaves open, chosen here, or tuned.";
        let mut table = Table::new(key, &["parameter", "value", "source", "where, or why"]);
        table = table.captioned(caption);
        for parameter in &self.parameters {
            table.row(vec![
                Field::Words(format!("`{}`", parameter.key)),
                Field::words(&parameter.value),
                Field::words(parameter.source.name()),
                Field::words(&parameter.note),
            ]);
        }
        table
    }
}

fn is_under(key: &str, part: &str) -> bool {
    let rest = key.strip_prefix(part);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// The values of a configuration by dotted key.
pub(crate) fn leaves(config: &Value) -> Vec<(String, String)> {
    let mut leaves = Vec::new();
    collect(config, String::new(), &mut leaves);
    leaves
}

fn collect(value: &Value, key: String, leaves: &mut Vec<(String, String)>) {
    match value {
        Value::Object(map) => {
            for (name, inner) in map {
                let dot = if key.is_empty() { "" } else { "." };
                collect(inner, format!("{key}{dot}{name}"), leaves);
            }
        }
        Value::String(words) => leaves.push((key, words.clone())),
        other => leaves.push((key, other.to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_longest_known_key_counts() {
        let config = json!({"colony": {"n_ants": 5, "rule": {"rho": 0.5, "name": "x"}}, "b": 1});
        let known = [
            ("colony.rule", Source::Read, "text"),
            ("colony.rule.rho", Source::Stated, "sec. 2"),
        ];
        let sheet = ParameterSheet::new(&config, &["colony"], &known);
        let found: Vec<_> = sheet
            .parameters
            .iter()
            .map(|p| (p.key.as_str(), p.value.as_str(), p.source))
            .collect();
        assert_eq!(
            found,
            [
                ("colony.n_ants", "5", Source::Chosen),
                ("colony.rule.name", "x", Source::Read),
                ("colony.rule.rho", "0.5", Source::Stated),
            ]
        );
        assert_eq!(sheet.table("p").rows[2][2], Field::words("stated"));
    }
}

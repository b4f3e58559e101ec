//! The parameters of a configuration, and the origin of each.

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

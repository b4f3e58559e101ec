//! The file of what was tuned: its values, below a line that says where they come from.

use anyhow::Result;
use serde_json::Value;
use toml::Table;
use xxhash_rust::xxh3::xxh3_128;

/// The beginning of the first line of the file; the hash of the values follows.
const MARK: &str = "# Found by formicar tune. Hash of the values: ";

/// A document of tuned values as TOML, below a line that tells so. The line holds their hash, so
/// that a value changed by hand is not taken for one that was found.
///
/// # Errors
/// A document that TOML cannot hold.
pub fn tuned_text(document: &Value) -> Result<String> {
    let text = toml::to_string(document)?;
    let hash = hash(&text.parse()?);
    Ok(format!("{MARK}{hash}\n{text}"))
}

/// True if a configuration file holds what a tuning has found, and nothing else.
pub fn is_as_tuned(text: &str) -> bool {
    let told = text.lines().find_map(|line| line.strip_prefix(MARK));
    let values = text.parse::<Table>().ok();
    told.zip(values)
        .is_some_and(|(told, values)| told.trim() == hash(&values))
}

/// The hash of the values, however they are laid out.
fn hash(values: &Table) -> String {
    format!("{:032x}", xxh3_128(values.to_string().as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn only_what_was_found_counts_as_tuned() {
        let document = json!({"planner": "formicar", "drive": {"beta": 2.0, "n_ants": 8}});
        let text = tuned_text(&document).unwrap();
        assert!(is_as_tuned(&text), "{text}");
        assert!(is_as_tuned(
            &text.replace("beta = 2.0", "beta  = 2.0 # two")
        ));
        assert!(!is_as_tuned(&text.replace("beta = 2.0", "beta = 2.5")));
        assert!(!is_as_tuned(&format!("{text}gamma = 1.0\n")));
        assert!(!is_as_tuned(&toml::to_string(&document).unwrap()));
    }
}

//! Files of reports about results of `bench`.

use crate::files;
use anyhow::Result;
use formicar_lab::campaign::ConfigRecord;
use formicar_lab::report::{Fact, Page, Report, json, markdown, page};
use serde_json::Value;
use std::path::Path;

/// A report as a page, as JSON and as Markdown: names and contents.
pub(super) fn report_files(
    report: &Report,
    facts: &[Fact],
    configs: &[Fact],
) -> Vec<(String, String)> {
    let whole = Page {
        report,
        facts,
        configs,
    };
    vec![
        ("index.html".to_owned(), page(&whole)),
        ("report.json".to_owned(), json(&whole)),
        ("summary.md".to_owned(), markdown(report)),
    ]
}

/// Configurations by name, as JSON that can be read.
pub(super) fn config_facts(configs: &[ConfigRecord]) -> Vec<Fact> {
    let fact = |config: &ConfigRecord| {
        let value = serde_json::from_str::<Value>(&config.json);
        let pretty = value.map_or_else(|_| config.json.clone(), |value| format!("{value:#}"));
        Fact::new(&config.name, pretty)
    };
    configs.iter().map(fact).collect()
}

/// Writes files into a folder, made where it does not exist.
pub(super) fn write_all(folder: &Path, texts: &[(String, String)]) -> Result<()> {
    files::make_folder(folder)?;
    for (name, text) in texts {
        files::write(&folder.join(name), text)?;
    }
    Ok(())
}

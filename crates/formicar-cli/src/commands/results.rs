//! Results of `bench` as they lie on disk, and reports about them.

use crate::files;
use anyhow::{Context, Result, bail};
use formicar::map::format::write_atomically;
use formicar_lab::campaign::{ConfigRecord, Stored, read_csv};
use formicar_lab::report::{Fact, Page, Report, json, markdown, page};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// The name of a file without folders and extension.
pub(super) fn name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or(path.as_os_str());
    stem.to_string_lossy().into_owned()
}

/// Refuses a file that is named twice, be it by other names: its runs would count twice.
pub(super) fn check_once<P: AsRef<Path>>(paths: &[P]) -> Result<()> {
    let mut known: Vec<(PathBuf, &Path)> = Vec::new();
    for path in paths.iter().map(AsRef::as_ref) {
        // What is not there is told by whoever reads it.
        let Ok(real) = path.canonicalize() else {
            continue;
        };
        if let Some((_, other)) = known.iter().find(|(known, _)| *known == real) {
            let (path, other) = (path.display(), other.display());
            bail!("{path}: the same file as {other}; hint: name each file once");
        }
        known.push((real, path));
    }
    Ok(())
}

/// A store, or the table of one.
pub(super) fn read(path: &Path) -> Result<Stored> {
    let is_csv = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("csv"));
    if !is_csv {
        // SQLite would make the file.
        fs::metadata(path).with_context(|| format!("{} cannot be read", path.display()))?;
        return Stored::read(path);
    }
    let text = files::read_text(path)?;
    let mut records = read_csv(&text).with_context(|| path.display().to_string())?;
    let settings = path.with_file_name("settings.json");
    if let (true, Ok(text)) = (settings.exists(), files::read_text(&settings)) {
        let settings: Value = serde_json::from_str(&text).unwrap_or_default();
        for (column, key) in [
            ("machine", "processor"),
            ("cold", "cold"),
            ("version", "version"),
        ] {
            let value = match &settings[key] {
                Value::Null => continue,
                Value::String(text) => text.clone(),
                other => other.to_string(),
            };
            let blank = records
                .iter_mut()
                .filter(|r| r.origin.get(column).is_empty());
            blank.for_each(|record| record.origin.set(column, &value));
        }
    }
    Ok(Stored {
        name: name(path),
        n_planned: records.len(),
        records,
        ..Stored::default()
    })
}

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
pub(super) fn write_all(folder: &Path, files: &[(String, String)]) -> Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    for (name, text) in files {
        let path = folder.join(name);
        write_atomically(&path, text.as_bytes())
            .with_context(|| format!("{} cannot be written", path.display()))?;
    }
    Ok(())
}

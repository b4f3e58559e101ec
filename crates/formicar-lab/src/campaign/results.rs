//! Results of `bench` as they lie on disk.

use super::stored::Stored;
use crate::run::read_csv;
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

/// The largest text file that is read, bytes.
const MAX_TEXT: u64 = 1 << 28;

/// The text of a file.
pub(super) fn read_text(path: &Path) -> Result<String> {
    let read = || -> Result<String> {
        let mut text = String::new();
        let n_bytes = File::open(path)?
            .take(MAX_TEXT + 1)
            .read_to_string(&mut text)?;
        if n_bytes as u64 > MAX_TEXT {
            bail!("more than {MAX_TEXT} bytes");
        }
        Ok(text)
    };
    read().with_context(|| format!("{} cannot be read", path.display()))
}

/// The name of a file without folders and extension.
pub fn name_of_file(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or(path.as_os_str());
    stem.to_string_lossy().into_owned()
}

/// Refuses a file that is named twice, be it by other names: its runs would count twice.
///
/// # Errors
/// The file that is named twice.
pub fn check_once<P: AsRef<Path>>(paths: &[P]) -> Result<()> {
    let mut known: Vec<(PathBuf, &Path)> = Vec::new();
    for path in paths.iter().map(AsRef::as_ref) {
        // A missing file is reported by the code that reads it.
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

/// Reads a store, or the table of one.
///
/// # Errors
/// A file that is neither.
pub fn read_results(path: &Path) -> Result<Stored> {
    let is_csv = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("csv"));
    if !is_csv {
        // SQLite would make the file.
        fs::metadata(path).with_context(|| format!("{} cannot be read", path.display()))?;
        return Stored::read(path);
    }
    let mut runs = read_csv(&read_text(path)?).with_context(|| path.display().to_string())?;
    let settings = read_text(&path.with_file_name("settings.json"));
    if let Ok(settings) = settings {
        let settings: Value = serde_json::from_str(&settings).unwrap_or_default();
        for run in &mut runs {
            let origin = &mut run.origin;
            origin.cold = origin.cold.or(settings["cold"].as_bool());
            let texts = [
                (&mut origin.machine, "processor"),
                (&mut origin.version, "version"),
            ];
            for (text, key) in texts {
                if text.is_empty() {
                    settings[key].as_str().unwrap_or_default().clone_into(text);
                }
            }
        }
    }
    Ok(Stored {
        name: name_of_file(path),
        n_planned: runs.len(),
        runs,
        ..Stored::default()
    })
}

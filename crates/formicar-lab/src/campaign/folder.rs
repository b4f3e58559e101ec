//! A folder of results: a store, with its rows and settings as files.

use super::plan::Campaign;
use super::results::read_text;
use super::sink::Sink;
use super::store::{Store, check_settings};
use crate::run::{Run, RunRecord, read_torn_csv, record_line, records_csv};
use anyhow::{Context, Result};
use formicar::map::format::write_atomically;
use serde_json::Value;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// A folder that takes runs under the same settings. Beside its store, `results.sqlite`, it holds
/// `results.csv` and `settings.json`, written from the store.
#[derive(Debug)]
pub struct Folder {
    table: PathBuf,
    store: Store,
    /// The end of the table, which grows run by run.
    end: File,
}

impl Folder {
    /// Opens a folder for the runs of a campaign, and makes it if need be. The table of a build
    /// that kept no store is taken over. Runs whose answer is asked for and is not there are
    /// missing again.
    ///
    /// # Errors
    /// A folder of other settings, and files that cannot be read or written.
    pub fn open(folder: &Path, campaign: &Campaign, settings: &Value) -> Result<Self> {
        let made = fs::create_dir_all(folder);
        made.with_context(|| format!("{} cannot be made", folder.display()))?;
        let [table, settings_file, store] =
            ["results.csv", "settings.json", "results.sqlite"].map(|name| folder.join(name));
        let before = || {
            if table.exists() {
                take_over(&table, &settings_file, settings)
            } else {
                Ok(Vec::new())
            }
        };
        let mut store = Store::open_growing(&store, campaign, settings, before)?;
        for (i, run) in campaign.runs.iter().enumerate() {
            if run.job.answer.as_ref().is_some_and(|path| !path.exists()) {
                store.remove(i)?;
            }
        }
        write(&settings_file, &format!("{settings:#}\n"))?;
        write(&table, &records_csv(sorted(&store)?.iter())?)?;
        let end = OpenOptions::new().append(true).open(&table);
        Ok(Self {
            end: end.with_context(|| table.display().to_string())?,
            table,
            store,
        })
    }

    /// Notes how many runs are done at once.
    ///
    /// # Errors
    /// A store that cannot be written.
    pub fn note_runs_at_once(&mut self, n_at_once: u32) -> Result<()> {
        self.store.note_runs_at_once(n_at_once)
    }

    /// Sorts the table by scenario, planner and seed, and returns its rows.
    ///
    /// # Errors
    /// Files that cannot be read or written.
    pub fn finish(self) -> Result<Vec<RunRecord>> {
        let records = sorted(&self.store)?;
        write(&self.table, &records_csv(&records)?)?;
        self.store.finish()?;
        Ok(records)
    }
}

impl Sink for Folder {
    fn missing(&self) -> Result<Vec<usize>> {
        self.store.missing()
    }

    fn add(&mut self, index: usize, run: &Run) -> Result<()> {
        self.store.add(index, run)?;
        let line = record_line(&run.record)?;
        let written = self.end.write_all(line.as_bytes());
        written.with_context(|| self.table.display().to_string())
    }
}

/// The rows of a folder that a build before this one has filled.
fn take_over(table: &Path, settings_file: &Path, settings: &Value) -> Result<Vec<RunRecord>> {
    let hint = "hint: another --out, or the flags of before";
    let text = read_text(settings_file).context(hint)?;
    let before: Value =
        serde_json::from_str(&text).with_context(|| settings_file.display().to_string())?;
    check_settings(&before, settings, settings_file)?;
    read_torn_csv(&read_text(table)?).with_context(|| table.display().to_string())
}

fn sorted(store: &Store) -> Result<Vec<RunRecord>> {
    let runs = store.stored()?.runs.into_iter();
    let mut records: Vec<RunRecord> = runs.map(|run| run.record).collect();
    records.sort_by_key(RunRecord::key);
    Ok(records)
}

fn write(path: &Path, text: &str) -> Result<()> {
    write_atomically(path, text.as_bytes())
        .with_context(|| format!("{} cannot be written", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::plan::tests::campaign;
    use crate::run::RunStatus;

    fn text(path: &Path) -> String {
        fs::read_to_string(path).unwrap()
    }

    #[test]
    fn a_folder_of_the_build_before_is_continued() {
        let folder = tempfile::tempdir().unwrap();
        let [table, settings] = [
            include_str!("../../tests/data/folder_before/results.csv"),
            include_str!("../../tests/data/folder_before/settings.json"),
        ];
        let path = |name: &str| folder.path().join(name);
        fs::write(path("results.csv"), table).unwrap();
        fs::write(path("settings.json"), settings).unwrap();
        let value: Value = serde_json::from_str(settings).unwrap();
        let mut campaign = campaign(3);
        for run in &mut campaign.runs {
            "narrow-junction-quarter-turn".clone_into(&mut run.job.task.scenario);
        }
        // The table holds the seeds 0 and 1 of A*, and four other runs.
        let mut results = Folder::open(folder.path(), &campaign, &value).unwrap();
        assert_eq!(results.missing().unwrap(), [2]);
        assert_eq!(text(&path("settings.json")), settings);
        let records = |csv: &str| read_torn_csv(csv).unwrap();
        assert_eq!(records(&text(&path("results.csv"))), records(table));
        let run = Run {
            record: RunRecord {
                status: RunStatus::NoPath,
                ..RunRecord::of_job(&campaign.runs[2].job)
            },
            ..Run::default()
        };
        results.add(2, &run).unwrap();
        let n_lines = text(&path("results.csv")).lines().count();
        assert_eq!(n_lines, table.lines().count() + 1);
        let records = results.finish().unwrap();
        assert_eq!(records.len(), 7);
        assert_eq!(records[2].status, RunStatus::NoPath);
        // From now on the store knows.
        fs::write(path("results.csv"), "torn").unwrap();
        let results = Folder::open(folder.path(), &campaign, &value).unwrap();
        assert_eq!(results.missing().unwrap(), [0_usize; 0]);
        assert_eq!(results.finish().unwrap(), records);
        let mut other = value.clone();
        other["cold"] = true.into();
        let error = Folder::open(folder.path(), &campaign, &other).unwrap_err();
        assert!(error.to_string().contains("settings.json"), "{error}");
    }
}

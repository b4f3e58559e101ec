//! The contents of a store.

use super::plan::ConfigRecord;
use super::tables::{self, AT_ONCE, check_schema, fact, numbers};
use crate::run::{Job, Run, to_csv};
use anyhow::{Context, Result};
use rusqlite::{Connection, OpenFlags};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A store as it stands.
#[derive(Clone, Debug, Default)]
pub struct Stored {
    /// The campaign's name.
    pub name: String,
    /// The campaign file.
    pub text: String,
    /// Number of runs of the campaign.
    pub n_planned: usize,
    /// The runs that are over, in the order of the campaign.
    pub runs: Vec<Run>,
    /// Numbers of runs that were done at once; none where that is not known.
    pub n_at_once: BTreeSet<u32>,
    /// The configurations of its planners.
    pub configs: Vec<ConfigRecord>,
    /// The jobs of its runs, by key; none of a table.
    pub jobs: BTreeMap<String, Job>,
}

impl Stored {
    /// Reads the store at a path.
    ///
    /// # Errors
    /// A file that is not a store.
    pub fn read(path: &Path) -> Result<Self> {
        let read = || -> Result<Self> {
            // A journal left by a kill is rolled back, which is writing.
            let connection = Connection::open_with_flags(path, OpenFlags::SQLITE_OPEN_READ_WRITE)
                .or_else(|_| {
                Connection::open_with_flags(path, OpenFlags::SQLITE_OPEN_READ_ONLY)
            })?;
            check_schema(&connection)?;
            Self::of(&connection)
        };
        read().with_context(|| path.display().to_string())
    }

    /// Reads a store that is open.
    pub(super) fn of(connection: &Connection) -> Result<Self> {
        let jobs = tables::jobs(connection)?;
        Ok(Self {
            name: fact(connection, "campaign")?,
            text: fact(connection, "text")?,
            n_planned: tables::count(connection, "planned")?,
            runs: tables::runs(connection)?,
            n_at_once: numbers(connection, AT_ONCE)?,
            configs: tables::configs(connection, &jobs)?,
            jobs,
        })
    }

    /// All runs as CSV, in the order of the campaign.
    ///
    /// # Errors
    /// No failure is known: the table is written to memory.
    pub fn csv(&self) -> Result<String> {
        to_csv(&self.runs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{RunStatus, read_csv};

    #[test]
    fn a_store_of_the_build_before_is_read_and_exported_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("before.sqlite");
        let connection = Connection::open(&path).unwrap();
        let dump = include_str!("../../tests/data/store_before.sql");
        connection.execute_batch(dump).unwrap();
        connection.close().unwrap();
        let stored = Stored::read(&path).unwrap();
        let [found, lost] = &stored.runs[..] else {
            panic!("{stored:?}");
        };
        assert_eq!(found.record.status, RunStatus::Found);
        assert_eq!(lost.record.status, RunStatus::BudgetExhausted);
        assert_eq!(found.origin.budget_steps, Some(500));
        let last = found.history.improvements.last().unwrap();
        assert_eq!(found.record.length_m, Some(last.length_m));
        assert!(!found.path.as_ref().unwrap().segments.is_empty());
        assert_eq!(stored.jobs[&found.origin.run].key(), found.record.key());
        assert_eq!(stored.n_at_once, BTreeSet::from([1]));
        let table = include_str!("../../tests/data/store_before.csv");
        let rows = |csv: &str| read_csv(csv).unwrap();
        assert_eq!(rows(&stored.csv().unwrap()), rows(table));
    }
}

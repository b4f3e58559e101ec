//! The contents of a store.

use super::plan::ConfigRecord;
use crate::run::{COLUMNS, Job, ORIGIN_COLUMNS, Run, to_csv};
use anyhow::{Context, Result, anyhow, bail};
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OpenFlags, OptionalExtension};
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;
use std::path::Path;

/// Name and version of the tables.
pub(super) const SCHEMA: &str = "formicar/store/1";

/// The fact that holds the numbers of runs done at once.
pub(super) const AT_ONCE: &str = "runs_at_once";

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
        let jobs = jobs(connection)?;
        let n_planned: i64 =
            connection.query_row("SELECT count(*) FROM planned", [], |r| r.get(0))?;
        Ok(Self {
            name: fact(connection, "campaign")?,
            text: fact(connection, "text")?,
            n_planned: n_planned as usize,
            runs: runs(connection)?,
            n_at_once: numbers(connection, AT_ONCE)?,
            configs: configs(connection, &jobs)?,
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

/// The columns of a run, but for its history and its path.
pub(super) fn columns() -> impl Iterator<Item = &'static str> {
    COLUMNS.iter().chain(ORIGIN_COLUMNS).copied()
}

/// A value as text; empty where there is none.
fn text_of(value: ValueRef) -> Result<String> {
    Ok(match value {
        ValueRef::Null => String::new(),
        ValueRef::Integer(n) => n.to_string(),
        ValueRef::Real(x) => json!(x).to_string(),
        ValueRef::Text(text) => std::str::from_utf8(text)?.to_owned(),
        ValueRef::Blob(_) => bail!("a value that is neither a number nor text"),
    })
}

/// The words for a store, for users who name another file.
const EXPECTED: &str = "expected the SQLite file that `bench --store F.sqlite` fills";

/// The error for a file that is not a store.
pub(super) fn no_store(error: impl Display) -> anyhow::Error {
    anyhow!("it is no store of campaigns ({error}); {EXPECTED}")
}

pub(super) fn check_schema(connection: &Connection) -> Result<()> {
    let schema = fact(connection, "schema").map_err(no_store)?;
    if schema != SCHEMA {
        bail!("its tables are {schema:?}, this version reads {SCHEMA:?}; {EXPECTED}");
    }
    Ok(())
}

pub(super) fn fact(connection: &Connection, name: &str) -> Result<String> {
    let sql = "SELECT value FROM fact WHERE name = ?";
    let value = connection.query_row(sql, [name], |row| row.get(0));
    value
        .optional()?
        .with_context(|| format!("it does not tell its {name}"))
}

/// The numbers of a fact that need not be there.
pub(super) fn numbers(connection: &Connection, name: &str) -> Result<BTreeSet<u32>> {
    let sql = "SELECT value FROM fact WHERE name = ?";
    let value = connection.query_row(sql, [name], |row| row.get::<_, String>(0));
    let words = value.optional()?.unwrap_or_default();
    let numbers = words.split_whitespace().map(str::parse);
    Ok(numbers.collect::<Result<_, _>>()?)
}

fn jobs(connection: &Connection) -> Result<BTreeMap<String, Job>> {
    let mut statement = connection.prepare("SELECT run, job FROM planned WHERE job IS NOT NULL")?;
    let mut rows = statement.query([])?;
    let mut jobs = BTreeMap::new();
    while let Some(row) = rows.next()? {
        let text: String = row.get(1)?;
        jobs.insert(row.get(0)?, serde_json::from_str(&text)?);
    }
    Ok(jobs)
}

fn configs(connection: &Connection, jobs: &BTreeMap<String, Job>) -> Result<Vec<ConfigRecord>> {
    let contenders = jobs.values().map(|job| &job.contender);
    let tuned: BTreeMap<&str, &[String]> = contenders
        .map(|contender| (contender.name.as_str(), &contender.tuned[..]))
        .collect();
    let sql = "SELECT name, hash, parameters FROM config ORDER BY rowid";
    let mut statement = connection.prepare(sql)?;
    let configs = statement.query_map([], |row| {
        let name: String = row.get(0)?;
        Ok(ConfigRecord {
            tuned: tuned
                .get(name.as_str())
                .map_or_else(Vec::new, |keys| keys.to_vec()),
            name,
            hash: row.get(1)?,
            json: row.get(2)?,
        })
    })?;
    Ok(configs.collect::<rusqlite::Result<_>>()?)
}

fn runs(connection: &Connection) -> Result<Vec<Run>> {
    let names: Vec<String> = columns().map(|c| format!("\"{c}\"")).collect();
    let sql = format!(
        "SELECT {}, history, path FROM run ORDER BY place",
        names.join(", ")
    );
    let mut statement = connection.prepare(&sql)?;
    let mut rows = statement.query([])?;
    let mut runs = Vec::new();
    while let Some(row) = rows.next()? {
        runs.push(run(row)?);
    }
    Ok(runs)
}

fn run(row: &rusqlite::Row) -> Result<Run> {
    let mut run = Run::default();
    for (i, column) in columns().enumerate() {
        let text = text_of(row.get_ref(i)?)?;
        run.record.set(column, &text)?;
        run.origin.set(column, &text)?;
    }
    let n = COLUMNS.len() + ORIGIN_COLUMNS.len();
    let path: Option<String> = row.get(n + 1)?;
    run.history = serde_json::from_str(&row.get::<_, String>(n)?)?;
    run.path = path.map(|json| serde_json::from_str(&json)).transpose()?;
    Ok(run)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::RunStatus;

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
        assert_eq!(stored.csv().unwrap(), table);
    }
}

//! What stands in the file of a campaign, read.

use super::job::Job;
use super::plan::ConfigRecord;
use super::record::{ORIGIN_COLUMNS, Origin, Record};
use super::row::{COLUMNS, Row};
use super::table::to_csv;
use anyhow::{Context, Result, anyhow, bail};
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OpenFlags, OptionalExtension};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;
use std::path::Path;

/// Name and version of the tables.
pub(super) const SCHEMA: &str = "formicar/store/1";

/// The fact of how many runs were done at once.
pub(super) const AT_ONCE: &str = "runs_at_once";

/// A store as it stands.
#[derive(Clone, Debug, Default)]
pub struct Stored {
    /// The campaign's name.
    pub name: String,
    /// The campaign file.
    pub text: String,
    /// How many runs the campaign has.
    pub n_planned: usize,
    /// The runs that are over, in the order of the campaign.
    pub records: Vec<Record>,
    /// How many runs were done at once; several numbers where it was filled in several ways, none
    /// where that is not known.
    pub n_at_once: BTreeSet<u32>,
    /// The configurations of its planners.
    pub configs: Vec<ConfigRecord>,
    /// What the processes of its runs are told, by key; none of a table.
    pub jobs: BTreeMap<String, Job>,
}

impl Stored {
    /// What stands in the store at a path.
    ///
    /// # Errors
    /// A file that is no store.
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

    /// What stands in a store that is open.
    pub(super) fn of(connection: &Connection) -> Result<Self> {
        let jobs = jobs(connection)?;
        let n_planned: i64 =
            connection.query_row("SELECT count(*) FROM planned", [], |r| r.get(0))?;
        Ok(Self {
            name: fact(connection, "campaign")?,
            text: fact(connection, "text")?,
            n_planned: n_planned as usize,
            records: records(connection)?,
            n_at_once: numbers(connection, AT_ONCE)?,
            configs: configs(connection, &jobs)?,
            jobs,
        })
    }

    /// All runs as CSV, in the order of the campaign.
    ///
    /// # Errors
    /// None in practice: the table is written to memory.
    pub fn csv(&self) -> Result<String> {
        to_csv(&self.records)
    }
}

/// The columns of a run, but for its history and its path.
pub(super) fn columns() -> impl Iterator<Item = &'static str> {
    COLUMNS.into_iter().chain(ORIGIN_COLUMNS)
}

/// A value as it stood in the row.
fn text_of(value: ValueRef) -> Result<serde_json::Value> {
    Ok(match value {
        ValueRef::Null => serde_json::Value::Null,
        ValueRef::Integer(n) => n.into(),
        ValueRef::Real(x) => x.into(),
        ValueRef::Text(text) => std::str::from_utf8(text)?.into(),
        ValueRef::Blob(_) => bail!("a value that is none of ours"),
    })
}

/// What a store is, for those who name another file.
const EXPECTED: &str = "expected the SQLite file that `bench --store F.sqlite` fills";

/// That a file is none of ours.
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
    let mut statement = connection.prepare("SELECT run, job FROM planned")?;
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

fn records(connection: &Connection) -> Result<Vec<Record>> {
    let names: Vec<String> = columns().map(|c| format!("\"{c}\"")).collect();
    let sql = format!(
        "SELECT {}, history, path FROM run ORDER BY place",
        names.join(", ")
    );
    let mut statement = connection.prepare(&sql)?;
    let mut rows = statement.query([])?;
    let mut records = Vec::new();
    while let Some(row) = rows.next()? {
        records.push(record(row)?);
    }
    Ok(records)
}

fn record(stored: &rusqlite::Row) -> Result<Record> {
    let (mut row, mut origin) = (Row::default(), Origin::default());
    for (i, column) in COLUMNS.into_iter().enumerate() {
        row.set(column, &text_of(stored.get_ref(i)?)?);
    }
    for (i, column) in ORIGIN_COLUMNS.into_iter().enumerate() {
        let text = match text_of(stored.get_ref(COLUMNS.len() + i)?)? {
            serde_json::Value::Null => String::new(),
            serde_json::Value::String(text) => text,
            number => number.to_string(),
        };
        origin.set(column, &text);
    }
    let n = COLUMNS.len() + ORIGIN_COLUMNS.len();
    let path: Option<String> = stored.get(n + 1)?;
    Ok(Record {
        row,
        origin,
        history: serde_json::from_str(&stored.get::<_, String>(n)?)?,
        path: path.map(|json| serde_json::from_str(&json)).transpose()?,
    })
}

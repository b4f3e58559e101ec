//! The tables of a store: `SQLite` and what is written to and read from it.

use super::plan::{ConfigRecord, PlannedRun};
use crate::run::{COLUMNS, Job, ORIGIN_COLUMNS, Run};
use anyhow::{Context, Result, anyhow, bail};
use rusqlite::types::{Value, ValueRef};
use rusqlite::{Connection, OptionalExtension, Row, params_from_iter};
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;

/// Name and version of the tables.
pub(super) const SCHEMA: &str = "formicar/store/1";

/// The fact that holds the numbers of runs done at once.
pub(super) const AT_ONCE: &str = "runs_at_once";

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

/// Notes a fact, in the place of one of the same name.
pub(super) fn set_fact(connection: &Connection, name: &str, value: &str) -> Result<()> {
    let sql = "INSERT OR REPLACE INTO fact VALUES (?, ?)";
    connection.execute(sql, (name, value))?;
    Ok(())
}

/// Makes the tables.
pub(super) fn create(connection: &Connection) -> Result<()> {
    // Without a type a column keeps numbers as they are: 2.0 stays a real one.
    let sql = format!(
        "CREATE TABLE fact (name TEXT PRIMARY KEY, value TEXT);
         CREATE TABLE config (name TEXT PRIMARY KEY, hash TEXT, parameters TEXT);
         CREATE TABLE planned (place INTEGER PRIMARY KEY, run TEXT UNIQUE, job TEXT);
         CREATE TABLE run (place INTEGER PRIMARY KEY REFERENCES planned, {}, history TEXT, path TEXT);
         CREATE UNIQUE INDEX run_key ON run (run);",
        columns()
    );
    Ok(connection.execute_batch(&sql)?)
}

/// The columns of a run, but for its place, its history and its path.
fn columns() -> String {
    let columns = COLUMNS.iter().chain(ORIGIN_COLUMNS);
    let quoted: Vec<String> = columns.map(|column| quoted(column)).collect();
    quoted.join(", ")
}

fn quoted(column: &str) -> String {
    format!("\"{column}\"")
}

/// The columns of a run that this build has and the table of a build before it has not.
fn missing_columns(connection: &Connection) -> Result<BTreeSet<&'static str>> {
    let sql = "SELECT name FROM pragma_table_info('run')";
    let known: BTreeSet<String> = rows(connection, sql, |row| Ok(row.get(0)?))?;
    let columns = COLUMNS.iter().chain(ORIGIN_COLUMNS).copied();
    Ok(columns.filter(|column| !known.contains(*column)).collect())
}

/// Adds the columns that a store of a build before this one lacks.
pub(super) fn widen(connection: &Connection) -> Result<()> {
    for column in missing_columns(connection)? {
        connection.execute(
            &format!("ALTER TABLE run ADD COLUMN {}", quoted(column)),
            [],
        )?;
    }
    Ok(())
}

/// The number of rows of a table.
pub(super) fn count(connection: &Connection, table: &str) -> rusqlite::Result<usize> {
    let sql = format!("SELECT count(*) FROM {table}");
    let n: i64 = connection.query_row(&sql, [], |row| row.get(0))?;
    Ok(n as usize)
}

/// All rows of a query.
pub(super) fn rows<T, C: FromIterator<T>>(
    connection: &Connection,
    sql: &str,
    read: impl Fn(&Row) -> Result<T>,
) -> Result<C> {
    let mut statement = connection.prepare(sql)?;
    let rows = statement.query_and_then([], read)?;
    rows.collect()
}

/// Adds the parameters of a planner, in the place of those before.
pub(super) fn set_config(connection: &Connection, config: &ConfigRecord) -> Result<()> {
    let values = (&config.name, &config.hash, &config.json);
    connection.execute("INSERT OR REPLACE INTO config VALUES (?, ?, ?)", values)?;
    Ok(())
}

/// The parameters of planners, with the keys that the jobs call tuned.
pub(super) fn configs(
    connection: &Connection,
    jobs: &BTreeMap<String, Job>,
) -> Result<Vec<ConfigRecord>> {
    let contenders = jobs.values().map(|job| &job.contender);
    let tuned: BTreeMap<&str, &[String]> = contenders
        .map(|contender| (contender.name.as_str(), &contender.tuned[..]))
        .collect();
    let sql = "SELECT name, hash, parameters FROM config ORDER BY rowid";
    rows(connection, sql, |row| {
        let name: String = row.get(0)?;
        let tuned = tuned.get(name.as_str()).copied().unwrap_or_default();
        Ok(ConfigRecord {
            tuned: tuned.to_vec(),
            name,
            hash: row.get(1)?,
            json: row.get(2)?,
        })
    })
}

/// Adds a run that is to be made.
pub(super) fn plan(connection: &Connection, place: i64, run: &PlannedRun) -> Result<()> {
    let values = (place, &run.key, serde_json::to_string(&run.job)?);
    connection.execute("INSERT INTO planned VALUES (?, ?, ?)", values)?;
    Ok(())
}

/// Adds a run that is over.
pub(super) fn insert(connection: &Connection, place: i64, run: &Run) -> Result<()> {
    let mut values = vec![Value::Integer(place)];
    values.extend(run.record.values().into_iter().map(value));
    values.extend(run.origin.values().into_iter().map(value));
    values.push(Value::Text(serde_json::to_string(&run.history)?));
    values.push(match &run.path {
        Some(path) => Value::Text(serde_json::to_string(path)?),
        None => Value::Null,
    });
    let marks = vec!["?"; values.len()].join(", ");
    let columns = columns();
    let sql = format!("INSERT INTO run (place, {columns}, history, path) VALUES ({marks})");
    connection.execute(&sql, params_from_iter(values))?;
    Ok(())
}

/// The jobs of planned runs, by key.
pub(super) fn jobs(connection: &Connection) -> Result<BTreeMap<String, Job>> {
    let sql = "SELECT run, job FROM planned WHERE job IS NOT NULL";
    rows(connection, sql, |row| Ok((row.get(0)?, job(row)?)))
}

/// The job in the second column of a row.
pub(super) fn job(row: &Row) -> Result<Job> {
    Ok(serde_json::from_str(&row.get::<_, String>(1)?)?)
}

/// The runs that are over, in the order of the campaign.
pub(super) fn runs(connection: &Connection) -> Result<Vec<Run>> {
    let missing = missing_columns(connection)?;
    let columns = COLUMNS.iter().chain(ORIGIN_COLUMNS);
    let columns: Vec<String> = columns
        .map(|column| {
            if missing.contains(column) {
                "NULL".to_owned()
            } else {
                quoted(column)
            }
        })
        .collect();
    let columns = columns.join(", ");
    let sql = format!("SELECT {columns}, history, path FROM run ORDER BY place");
    rows(connection, &sql, run)
}

fn run(row: &Row) -> Result<Run> {
    let mut run = Run::default();
    for (i, column) in COLUMNS.iter().chain(ORIGIN_COLUMNS).enumerate() {
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

/// A value of a record as `SQLite` keeps it; an empty text is none.
fn value(value: serde_json::Value) -> Value {
    match value {
        serde_json::Value::Null => Value::Null,
        serde_json::Value::String(text) if text.is_empty() => Value::Null,
        serde_json::Value::Number(number) => match (number.as_i64(), number.as_f64()) {
            (Some(whole), _) => Value::Integer(whole),
            (None, Some(real)) => Value::Real(real),
            (None, None) => Value::Null,
        },
        serde_json::Value::String(text) => Value::Text(text),
        other => Value::Text(other.to_string()),
    }
}

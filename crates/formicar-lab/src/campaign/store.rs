//! The file of a campaign: `SQLite`, one transaction a run.
//!
//! The journal is a rollback journal with full synchronization, not a write-ahead log: runs take
//! longer than a commit, so nothing is gained by a log, and what is left behind is one file. After
//! a kill the next opening rolls back the run that was being written and nothing else.

use super::job::Job;
use super::plan::{Campaign, ConfigRecord};
use super::record::{ORIGIN_COLUMNS, Origin, Record};
use super::row::{COLUMNS, Row};
use super::table::to_csv;
use anyhow::{Context, Result, anyhow, bail};
use rusqlite::types::{Value, ValueRef};
use rusqlite::{Connection, OpenFlags, OptionalExtension, params_from_iter};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

/// Name and version of the tables.
const SCHEMA: &str = "formicar/store/1";

/// The store of a campaign under way, of which this process is the only writer.
#[derive(Debug)]
pub struct Store {
    connection: Connection,
    path: PathBuf,
    _lock: Lock,
}

/// That this process is the only writer; it ends with the process, however that ends.
#[derive(Debug)]
struct Lock {
    path: PathBuf,
    _file: File,
}

impl Drop for Lock {
    fn drop(&mut self) {
        // What is left of a lock file holds nobody up.
        let _ = std::fs::remove_file(&self.path);
    }
}

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
    /// The configurations of its planners.
    pub configs: Vec<ConfigRecord>,
    /// What the processes of its runs are told, by key; none of a table.
    pub jobs: BTreeMap<String, Job>,
}

impl Store {
    /// The store at a path for a campaign: a new one, or that of before, which must be of the same
    /// runs and the same version.
    ///
    /// # Errors
    /// A store of another campaign, one that another process writes to, and a file that is none.
    pub fn open(path: &Path, campaign: &Campaign, version: &str) -> Result<Self> {
        let name = || path.display().to_string();
        let lock = Lock::of(path)?;
        let is_new = !path.exists();
        let connection = Connection::open(path).with_context(name)?;
        let mut store = Self {
            connection,
            path: path.to_owned(),
            _lock: lock,
        };
        // A kill between the making of the file and its first commit leaves it empty.
        if is_new || store.is_empty().with_context(name)? {
            store.create(campaign, version).with_context(name)?;
        } else {
            check_schema(&store.connection).with_context(name)?;
            store.check(campaign, version).with_context(name)?;
        }
        Ok(store)
    }

    /// Places in the campaign of the runs that are not over, in order.
    ///
    /// # Errors
    /// A store that cannot be read.
    pub fn missing(&self) -> Result<Vec<usize>> {
        let sql =
            "SELECT place FROM planned WHERE place NOT IN (SELECT place FROM run) ORDER BY place";
        let mut statement = self.connection.prepare(sql)?;
        let places = statement.query_map([], |row| row.get::<_, i64>(0))?;
        let places: rusqlite::Result<Vec<i64>> = places.collect();
        Ok(places?.into_iter().map(|place| place as usize).collect())
    }

    /// Adds the record of the run at a place; it is on disk when this returns.
    ///
    /// # Errors
    /// A store that cannot be written, and a run that it holds already.
    pub fn add(&mut self, place: usize, record: &Record) -> Result<()> {
        let fields = record.row.fields().iter().chain(record.origin.fields());
        let mut values = vec![Value::Integer(place as i64)];
        values.extend(
            columns()
                .zip(fields)
                .map(|(column, text)| value(column, text)),
        );
        values.push(Value::Text(serde_json::to_string(&record.history)?));
        values.push(match &record.path {
            Some(path) => Value::Text(serde_json::to_string(path)?),
            None => Value::Null,
        });
        let marks = vec!["?"; values.len()].join(", ");
        let sql = format!("INSERT INTO run VALUES ({marks})");
        let inserted = self.connection.execute(&sql, params_from_iter(values));
        inserted.with_context(|| self.path.display().to_string())?;
        Ok(())
    }

    /// Everything in it.
    ///
    /// # Errors
    /// A store that cannot be read.
    pub fn stored(&self) -> Result<Stored> {
        stored(&self.connection).with_context(|| self.path.display().to_string())
    }

    /// Closes the store of a campaign that is done.
    ///
    /// # Errors
    /// A store that cannot be closed.
    pub fn finish(self) -> Result<()> {
        Ok(self.connection.close().map_err(|(_, error)| error)?)
    }

    fn is_empty(&self) -> rusqlite::Result<bool> {
        let sql = "SELECT count(*) FROM sqlite_master";
        let n: i64 = self.connection.query_row(sql, [], |row| row.get(0))?;
        Ok(n == 0)
    }

    fn create(&mut self, campaign: &Campaign, version: &str) -> Result<()> {
        let transaction = self.connection.transaction()?;
        transaction.execute_batch(&tables())?;
        let facts = [
            ("schema", SCHEMA),
            ("version", version),
            ("campaign", &campaign.name),
            ("campaign_hash", &campaign.hash()),
            ("text", &campaign.text),
        ];
        for fact in facts {
            transaction.execute("INSERT INTO fact VALUES (?, ?)", fact)?;
        }
        for config in &campaign.configs {
            let values = (&config.name, &config.hash, &config.json);
            transaction.execute("INSERT INTO config VALUES (?, ?, ?)", values)?;
        }
        for (place, run) in campaign.runs.iter().enumerate() {
            let values = (place as i64, &run.key, serde_json::to_string(&run.job)?);
            transaction.execute("INSERT INTO planned VALUES (?, ?, ?)", values)?;
        }
        Ok(transaction.commit()?)
    }

    /// Refuses the store of another campaign or version.
    fn check(&self, campaign: &Campaign, version: &str) -> Result<()> {
        let hint = "hint: another --store, or the campaign of before";
        let before = fact(&self.connection, "version")?;
        if before != version {
            bail!("its runs are of formicar {before}, this is formicar {version}; {hint}");
        }
        if fact(&self.connection, "campaign_hash")? == campaign.hash() {
            return Ok(());
        }
        let mut statement = self.connection.prepare("SELECT run FROM planned")?;
        let keys = statement.query_map([], |row| row.get::<_, String>(0))?;
        let keys: rusqlite::Result<BTreeSet<String>> = keys.collect();
        let keys = keys?;
        let n_same = campaign.runs.iter().filter(|run| keys.contains(&run.key));
        bail!(
            "it is the store of another campaign, {:?} of {} runs; {:?} has {} runs, of which {} \
             are the same; {hint}",
            fact(&self.connection, "campaign")?,
            keys.len(),
            campaign.name,
            campaign.runs.len(),
            n_same.count()
        )
    }
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
            stored(&connection)
        };
        read().with_context(|| path.display().to_string())
    }

    /// All runs as CSV, in the order of the campaign.
    ///
    /// # Errors
    /// None in practice: the table is written to memory.
    pub fn csv(&self) -> Result<String> {
        to_csv(&self.records)
    }
}

impl Lock {
    /// The lock of a store; refused where another process has it.
    fn of(path: &Path) -> Result<Self> {
        let mut name = path.as_os_str().to_owned();
        name.push(".lock");
        let name = PathBuf::from(name);
        let told = || format!("{} cannot be written", name.display());
        let file = File::create(&name).with_context(told)?;
        match file.try_lock() {
            Ok(()) => Ok(Self {
                path: name,
                _file: file,
            }),
            Err(TryLockError::WouldBlock) => bail!(
                "{}: another process writes to it; hint: wait for it, or take another --store",
                path.display()
            ),
            Err(TryLockError::Error(error)) => Err(error).context(name.display().to_string()),
        }
    }
}

fn columns() -> impl Iterator<Item = &'static str> {
    COLUMNS.into_iter().chain(ORIGIN_COLUMNS)
}

fn tables() -> String {
    // Without a type a column keeps numbers as they are: 2.0 stays a real one.
    let columns: Vec<String> = columns().map(|c| format!("\"{c}\"")).collect();
    format!(
        "CREATE TABLE fact (name TEXT PRIMARY KEY, value TEXT);
         CREATE TABLE config (name TEXT PRIMARY KEY, hash TEXT, parameters TEXT);
         CREATE TABLE planned (place INTEGER PRIMARY KEY, run TEXT UNIQUE, job TEXT);
         CREATE TABLE run (place INTEGER PRIMARY KEY REFERENCES planned, {}, history TEXT, path TEXT);
         CREATE UNIQUE INDEX run_key ON run (run);",
        columns.join(", ")
    )
}

/// Columns that hold words, even where these look like numbers.
const WORDS: [&str; 14] = [
    "scenario",
    "planner",
    "status",
    "valid",
    "source",
    "reason",
    "vehicle",
    "motion",
    "version",
    "build",
    "machine",
    "config_hash",
    "map_hash",
    "run",
];

fn value(column: &str, text: &str) -> Value {
    let is_word = WORDS.contains(&column) || column == "vehicle_hash" || column == "cold";
    let number = || {
        let whole = text.parse::<i64>().ok().map(Value::Integer);
        whole.or_else(|| text.parse::<f64>().ok().map(Value::Real))
    };
    match text {
        "" => Value::Null,
        _ if is_word => Value::Text(text.to_owned()),
        _ => number().unwrap_or_else(|| Value::Text(text.to_owned())),
    }
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

fn check_schema(connection: &Connection) -> Result<()> {
    let schema = fact(connection, "schema")
        .map_err(|error| anyhow!("it is no store of campaigns ({error}); hint: another --store"))?;
    if schema != SCHEMA {
        bail!("its tables are {schema:?}, this version reads {SCHEMA:?}; hint: another --store");
    }
    Ok(())
}

fn fact(connection: &Connection, name: &str) -> Result<String> {
    let sql = "SELECT value FROM fact WHERE name = ?";
    let value = connection.query_row(sql, [name], |row| row.get(0));
    value
        .optional()?
        .with_context(|| format!("it does not tell its {name}"))
}

fn stored(connection: &Connection) -> Result<Stored> {
    let n_planned: i64 = connection.query_row("SELECT count(*) FROM planned", [], |r| r.get(0))?;
    Ok(Stored {
        name: fact(connection, "campaign")?,
        text: fact(connection, "text")?,
        n_planned: n_planned as usize,
        records: records(connection)?,
        configs: configs(connection)?,
        jobs: jobs(connection)?,
    })
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

fn configs(connection: &Connection) -> Result<Vec<ConfigRecord>> {
    let sql = "SELECT name, hash, parameters FROM config ORDER BY rowid";
    let mut statement = connection.prepare(sql)?;
    let configs = statement.query_map([], |row| {
        Ok(ConfigRecord {
            name: row.get(0)?,
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

#[cfg(test)]
mod tests {
    use super::super::plan::tests::campaign;
    use super::*;
    use crate::campaign::record::{History, Improvement};
    use serde_json::json;

    fn done(campaign: &Campaign, place: usize) -> Record {
        let run = &campaign.runs[place];
        let mut row = Row::begin(&run.job);
        let values = json!({
            "status": "found", "valid": true, "length_m": 2.0, "query_s": 0.1, "steps": 17,
            "reason": "\"1e5\"", "total_s": 1e-7,
        });
        row.fill(&values);
        Record {
            row,
            origin: Origin::new(run, ["0.1.0", "release", "a machine"]),
            history: History {
                improvements: vec![Improvement {
                    at_s: 0.1,
                    steps: 3,
                    length_m: 2.5,
                }],
                iterations: Vec::new(),
            },
            path: None,
        }
    }

    #[test]
    fn what_is_stored_is_read_back_in_the_order_of_the_campaign() {
        let folder = tempfile::tempdir().unwrap();
        let (path, campaign) = (folder.path().join("a.sqlite"), campaign(3));
        let mut store = Store::open(&path, &campaign, "0.1.0").unwrap();
        assert_eq!(store.missing().unwrap(), [0, 1, 2]);
        store.add(2, &done(&campaign, 2)).unwrap();
        store.add(0, &done(&campaign, 0)).unwrap();
        assert!(store.add(0, &done(&campaign, 0)).is_err(), "no run twice");
        let error = Store::open(&path, &campaign, "0.1.0").unwrap_err();
        assert!(error.to_string().contains("another process"), "{error}");
        drop(store);
        let store = Store::open(&path, &campaign, "0.1.0").unwrap();
        assert_eq!(store.missing().unwrap(), [1]);
        store.finish().unwrap();
        let stored = Stored::read(&path).unwrap();
        assert_eq!(stored.records, [done(&campaign, 0), done(&campaign, 2)]);
        assert_eq!((stored.n_planned, stored.configs), (3, campaign.configs));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn stores_of_others_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.sqlite");
        Store::open(&path, &campaign(3), "0.1.0")
            .unwrap()
            .finish()
            .unwrap();
        let told = |campaign: &Campaign, version: &str| {
            format!("{:#}", Store::open(&path, campaign, version).unwrap_err())
        };
        let error = told(&campaign(5), "0.1.0");
        assert!(
            error.contains("of 3 runs; \"c\" has 5 runs, of which 3 are the same"),
            "{error}"
        );
        assert!(told(&campaign(3), "0.2.0").contains("formicar 0.1.0, this is formicar 0.2.0"));
        std::fs::write(&path, "scenario,planner\n").unwrap();
        let error = told(&campaign(3), "0.1.0");
        assert!(
            error.contains("a.sqlite") && error.contains("not a database"),
            "{error}"
        );
        assert!(Stored::read(&path).is_err());
    }
}

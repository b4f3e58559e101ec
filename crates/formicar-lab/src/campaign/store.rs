//! The file of a campaign: `SQLite`, one transaction a run.
//!
//! The journal is a rollback journal with full synchronization, not a write-ahead log: runs take
//! longer than a commit, so nothing is gained by a log, and what is left behind is one file. After
//! a kill the next opening rolls back the run that was being written and nothing else.

use super::lock::Lock;
use super::plan::Campaign;
use super::record::Record;
use super::stored::{AT_ONCE, SCHEMA, Stored, check_schema, columns, fact, no_store, numbers};
use anyhow::{Context, Result, bail};
use rusqlite::types::Value;
use rusqlite::{Connection, params_from_iter};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The store of a campaign under way, of which this process is the only writer.
#[derive(Debug)]
pub struct Store {
    connection: Connection,
    path: PathBuf,
    _lock: Lock,
}

impl Store {
    /// The store at a path for a campaign: a new one, or that of before, which must be of the same
    /// runs and the same version.
    ///
    /// # Errors
    /// A store of another campaign, one that another process writes to, and a file that is none.
    pub fn open(path: &Path, campaign: &Campaign, version: &str) -> Result<Self> {
        let name = || path.display().to_string();
        check_place(path)?;
        let lock = Lock::of(path)?;
        let is_new = !path.exists();
        let connection = Connection::open(path).with_context(name)?;
        let mut store = Self {
            connection,
            path: path.to_owned(),
            _lock: lock,
        };
        // A kill between the making of the file and its first commit leaves it empty.
        if is_new || store.is_empty().map_err(no_store).with_context(name)? {
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

    /// Notes that runs which are still missing are done so many at once: it tells on their times.
    /// It is no part of the campaign; a store that was filled in several ways knows them all.
    ///
    /// # Errors
    /// A store that cannot be read or written.
    pub fn note_runs_at_once(&mut self, n_at_once: u32) -> Result<()> {
        if self.missing()?.is_empty() {
            return Ok(());
        }
        let mut known = numbers(&self.connection, AT_ONCE)?;
        known.insert(n_at_once);
        let known: Vec<String> = known.iter().map(u32::to_string).collect();
        let sql = "INSERT OR REPLACE INTO fact VALUES (?, ?)";
        let noted = self.connection.execute(sql, (AT_ONCE, known.join(" ")));
        noted.with_context(|| self.path.display().to_string())?;
        Ok(())
    }

    /// Everything in it.
    ///
    /// # Errors
    /// A store that cannot be read.
    pub fn stored(&self) -> Result<Stored> {
        Stored::of(&self.connection).with_context(|| self.path.display().to_string())
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

/// The table that takes the rows of a store in the end.
///
/// # Errors
/// A store that the table would be written over.
pub fn csv_beside(store: &Path) -> Result<PathBuf> {
    let csv = store.with_extension("csv");
    let is_named_so = store
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("csv"));
    // Two names may be links to one file.
    let real = |path: &Path| path.canonicalize().ok();
    let is_one = real(store).is_some_and(|store| real(&csv) == Some(store));
    if is_named_so || is_one {
        bail!(
            "--store {}: the rows are written to {} in the end, over the store; hint: --store {}",
            store.display(),
            csv.display(),
            store.with_extension("sqlite").display()
        );
    }
    Ok(csv)
}

/// Refuses a place whose folder is not there.
fn check_place(path: &Path) -> Result<()> {
    let folder = path.parent().filter(|folder| *folder != Path::new(""));
    match folder.filter(|folder| !folder.is_dir()) {
        Some(folder) => bail!(
            "{}: there is no folder {}; hint: make it first",
            path.display(),
            folder.display()
        ),
        None => Ok(()),
    }
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
const WORDS: [&str; 16] = [
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
    "vehicle_hash",
    "cold",
    "run",
];

fn value(column: &str, text: &str) -> Value {
    let number = || {
        let whole = text.parse::<i64>().ok().map(Value::Integer);
        whole.or_else(|| text.parse::<f64>().ok().map(Value::Real))
    };
    match text {
        "" => Value::Null,
        _ if WORDS.contains(&column) => Value::Text(text.to_owned()),
        _ => number().unwrap_or_else(|| Value::Text(text.to_owned())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::plan::tests::campaign;
    use crate::campaign::record::{History, Improvement, Origin};
    use crate::campaign::row::Row;
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
        assert!(stored.n_at_once.is_empty(), "nobody has noted it");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn how_many_ran_at_once_is_known_and_no_part_of_the_campaign() {
        let folder = tempfile::tempdir().unwrap();
        let (path, campaign) = (folder.path().join("a.sqlite"), campaign(2));
        let mut store = Store::open(&path, &campaign, "0.1.0").unwrap();
        store.note_runs_at_once(4).unwrap();
        store.add(0, &done(&campaign, 0)).unwrap();
        store.finish().unwrap();
        let mut store = Store::open(&path, &campaign, "0.1.0").unwrap();
        store.note_runs_at_once(1).unwrap();
        store.add(1, &done(&campaign, 1)).unwrap();
        // Nothing is left to be done.
        store.note_runs_at_once(9).unwrap();
        assert_eq!(Vec::from_iter(store.stored().unwrap().n_at_once), [1, 4]);
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
        let error = format!("{:#}", Stored::read(&path).unwrap_err());
        for part in ["a.sqlite", "no store of campaigns", "bench --store"] {
            assert!(error.contains(part), "{error}");
        }
        let nowhere = folder.path().join("none").join("a.sqlite");
        let error = Store::open(&nowhere, &campaign(3), "0.1.0").unwrap_err();
        assert!(error.to_string().contains("there is no folder"), "{error}");
    }

    #[test]
    fn no_table_is_written_over_its_store() {
        let csv = csv_beside(Path::new("a/z.sqlite")).unwrap();
        assert_eq!(csv, Path::new("a/z.csv"));
        for name in ["z.csv", "z.CSV"] {
            let error = csv_beside(Path::new(name)).unwrap_err().to_string();
            assert!(error.contains("hint: --store z.sqlite"), "{error}");
        }
    }

    #[test]
    #[cfg(unix)]
    fn no_table_is_written_over_a_store_that_it_is_a_link_to() {
        let folder = tempfile::tempdir().unwrap();
        let [store, csv] = ["z.sqlite", "z.csv"].map(|name| folder.path().join(name));
        std::fs::write(&store, "").unwrap();
        std::os::unix::fs::symlink(&store, &csv).unwrap();
        assert!(csv_beside(&store).is_err());
    }
}

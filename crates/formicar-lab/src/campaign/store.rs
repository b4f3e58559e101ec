//! The file of a campaign: `SQLite`, one transaction a run.
//!
//! The journal is a rollback journal with full synchronization, not a write-ahead log: runs take
//! longer than a commit, so nothing is gained by a log, and what is left behind is one file. After
//! a kill the next opening rolls back the run that was being written and nothing else.

use super::lock::Lock;
use super::plan::Campaign;
use super::sink::Sink;
use super::stored::Stored;
use super::tables::{self, AT_ONCE, SCHEMA, check_schema, fact, no_store, numbers, rows};
use crate::run::{Run, RunKey, RunRecord};
use anyhow::{Context, Result, bail};
use rusqlite::{Connection, Row};
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The store of a campaign under way, of which this process is the only writer.
#[derive(Debug)]
pub struct Store {
    connection: Connection,
    path: PathBuf,
    /// The place in the store of each run of the campaign.
    places: Vec<i64>,
    _lock: Lock,
}

impl Store {
    /// Opens the store of a campaign: a new one, or one from before, which must be of the same runs
    /// and the same version.
    ///
    /// # Errors
    /// A store of another campaign, one that another process writes to, and other files.
    pub fn open(path: &Path, campaign: &Campaign, version: &str) -> Result<Self> {
        let mut store = Self::connect(path)?;
        let name = || path.display().to_string();
        if store.is_empty().map_err(no_store).with_context(name)? {
            let made = store.create(campaign, version, None, Vec::new());
            made.with_context(name)?;
        } else {
            check_schema(&store.connection).with_context(name)?;
            store.check(campaign, version).with_context(name)?;
            tables::widen(&store.connection).with_context(name)?;
        }
        store.places = (0..campaign.runs.len() as i64).collect();
        Ok(store)
    }

    /// Opens a store that takes any runs under the same settings: one from before, or a new one
    /// that begins with the records of `before`. Runs are told apart by scenario, planner and seed.
    pub(super) fn open_growing(
        path: &Path,
        campaign: &Campaign,
        settings: &serde_json::Value,
        before: impl FnOnce() -> Result<Vec<RunRecord>>,
    ) -> Result<Self> {
        let mut store = Self::connect(path)?;
        let name = || path.display().to_string();
        if store.is_empty().map_err(no_store).with_context(name)? {
            let blank = Campaign {
                runs: Vec::new(),
                ..campaign.clone()
            };
            let version = env!("CARGO_PKG_VERSION");
            let made = store.create(&blank, version, Some(settings), before()?);
            made.with_context(name)?;
        } else {
            check_schema(&store.connection).with_context(name)?;
            tables::widen(&store.connection).with_context(name)?;
            check_settings(&store.settings()?, settings, path)?;
        }
        store.grow(campaign).with_context(name)?;
        Ok(store)
    }

    fn connect(path: &Path) -> Result<Self> {
        check_place(path)?;
        let lock = Lock::of(path)?;
        let connection = Connection::open(path).with_context(|| path.display().to_string())?;
        Ok(Self {
            connection,
            path: path.to_owned(),
            places: Vec::new(),
            _lock: lock,
        })
    }

    /// Removes a run of the campaign, which is missing then.
    pub(super) fn remove(&mut self, index: usize) -> Result<()> {
        let sql = "DELETE FROM run WHERE place = ?";
        self.connection.execute(sql, [self.places[index]])?;
        Ok(())
    }

    /// Notes how many runs are done at once where some are missing, since that influences their
    /// times. It is no part of the campaign; a store keeps all such numbers.
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
        let noted = tables::set_fact(&self.connection, AT_ONCE, &known.join(" "));
        noted.with_context(|| self.path.display().to_string())
    }

    /// Everything in the store.
    ///
    /// # Errors
    /// A store that cannot be read.
    pub fn stored(&self) -> Result<Stored> {
        Stored::of(&self.connection).with_context(|| self.path.display().to_string())
    }

    /// Closes the store.
    ///
    /// # Errors
    /// A store that cannot be closed.
    pub fn finish(self) -> Result<()> {
        Ok(self.connection.close().map_err(|(_, error)| error)?)
    }

    /// True before the first commit: a kill may leave an empty file.
    fn is_empty(&self) -> rusqlite::Result<bool> {
        Ok(tables::count(&self.connection, "sqlite_master")? == 0)
    }

    fn settings(&self) -> Result<serde_json::Value> {
        Ok(serde_json::from_str(&fact(&self.connection, "settings")?)?)
    }

    /// Makes the tables, in one transaction with everything that they begin with.
    fn create(
        &mut self,
        campaign: &Campaign,
        version: &str,
        settings: Option<&serde_json::Value>,
        before: Vec<RunRecord>,
    ) -> Result<()> {
        let transaction = self.connection.transaction()?;
        tables::create(&transaction)?;
        let facts = [
            ("schema", SCHEMA),
            ("version", version),
            ("campaign", &campaign.name),
            ("campaign_hash", &campaign.hash()),
            ("text", &campaign.text),
        ];
        for (name, value) in facts {
            tables::set_fact(&transaction, name, value)?;
        }
        for config in &campaign.configs {
            tables::set_config(&transaction, config)?;
        }
        for (place, run) in campaign.runs.iter().enumerate() {
            tables::plan(&transaction, place as i64, run)?;
        }
        if let Some(settings) = settings {
            tables::set_fact(&transaction, "settings", &settings.to_string())?;
        }
        for record in before {
            let run = Run {
                record,
                ..Run::default()
            };
            transaction.execute("INSERT INTO planned (run, job) VALUES (NULL, NULL)", [])?;
            tables::insert(&transaction, transaction.last_insert_rowid(), &run)?;
        }
        Ok(transaction.commit()?)
    }

    /// Plans the runs that the store does not know yet, behind those that it knows.
    fn grow(&mut self, campaign: &Campaign) -> Result<()> {
        let mut known = self.known()?;
        let sql = "SELECT max(place) + 1 FROM planned";
        let next = self
            .connection
            .query_row(sql, [], |row| row.get::<_, Option<i64>>(0))?;
        let mut next = next.unwrap_or_default();
        let transaction = self.connection.transaction()?;
        for config in &campaign.configs {
            tables::set_config(&transaction, config)?;
        }
        for run in &campaign.runs {
            if let Entry::Vacant(unknown) = known.entry(run.job.key()) {
                tables::plan(&transaction, next, run)?;
                unknown.insert(next);
                next += 1;
            }
        }
        transaction.commit()?;
        let places = campaign.runs.iter().map(|run| known[&run.job.key()]);
        self.places = places.collect();
        Ok(())
    }

    /// The places of all runs, planned or taken over.
    fn known(&self) -> Result<BTreeMap<RunKey, i64>> {
        let sql = "SELECT place, job FROM planned WHERE job IS NOT NULL";
        let planned = |row: &Row| Ok((tables::job(row)?.key(), row.get(0)?));
        let mut known: BTreeMap<RunKey, i64> = rows(&self.connection, sql, planned)?;
        let sql = "SELECT place, scenario, planner, seed FROM run";
        let done: Vec<(RunKey, i64)> = rows(&self.connection, sql, |row| {
            let seed: i64 = row.get(3)?;
            Ok(((row.get(1)?, row.get(2)?, seed as u64), row.get(0)?))
        })?;
        known.extend(done);
        Ok(known)
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
        let sql = "SELECT run FROM planned WHERE run IS NOT NULL";
        let keys: BTreeSet<String> = rows(&self.connection, sql, |row| Ok(row.get(0)?))?;
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

impl Sink for Store {
    fn missing(&self) -> Result<Vec<usize>> {
        let sql = "SELECT place FROM run";
        let done: BTreeSet<i64> = rows(&self.connection, sql, |row| Ok(row.get(0)?))?;
        let is_missing = |i: &usize| !done.contains(&self.places[*i]);
        Ok((0..self.places.len()).filter(is_missing).collect())
    }

    fn add(&mut self, index: usize, run: &Run) -> Result<()> {
        tables::insert(&self.connection, self.places[index], run)
            .with_context(|| self.path.display().to_string())
    }
}

/// Refuses runs under other settings than those of a folder.
pub(super) fn check_settings(
    before: &serde_json::Value,
    settings: &serde_json::Value,
    path: &Path,
) -> Result<()> {
    if before == settings {
        return Ok(());
    }
    bail!(
        "{}: the rows there were made with {before}, now it is {settings}; hint: another --out, or \
         the flags of before",
        path.with_file_name("settings.json").display()
    )
}

/// The table that takes the rows of a store in the end.
///
/// # Errors
/// A table that would be written over the store.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::plan::tests::campaign;
    use crate::run::{History, Improvement, Origin, RunStatus};

    fn done(campaign: &Campaign, place: usize) -> Run {
        let run = &campaign.runs[place];
        Run {
            record: RunRecord {
                status: RunStatus::Found,
                valid: Some(true),
                length_m: Some(2.0),
                query_s: Some(0.1),
                steps: Some(17),
                reason: "\"1e5\"".to_owned(),
                total_s: Some(1e-7),
                ..RunRecord::of_job(&run.job)
            },
            origin: Origin {
                cold: Some(false),
                machine: "a machine".to_owned(),
                budget_steps: Some(9),
                run: run.key.clone(),
                ..Origin::default()
            },
            history: History {
                improvements: vec![Improvement {
                    at_s: 0.1,
                    steps: 3,
                    length_m: 2.5,
                    ..Improvement::default()
                }],
                cold: Vec::new(),
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
        assert_eq!(stored.runs, [done(&campaign, 0), done(&campaign, 2)]);
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

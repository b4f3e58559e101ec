//! Runs as CSV: the columns of the record, then those of its origin.

use super::columns;
use super::record::{COLUMNS, ORIGIN_COLUMNS, Run, RunRecord};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::collections::BTreeSet;

/// The columns without which runs cannot be told apart.
const NEEDED: [&str; 4] = ["scenario", "planner", "seed", "status"];

/// Runs as CSV, with where they come from.
///
/// # Errors
/// No failure is known: the table is written to memory.
pub fn to_csv(runs: &[Run]) -> Result<String> {
    let header: Vec<&str> = [COLUMNS, ORIGIN_COLUMNS].concat();
    let values = |run: &Run| [run.record.values(), run.origin.values()].concat();
    lines(Some(&header), runs.iter().map(values))
}

/// Records as CSV, with a header.
pub(crate) fn records_csv<'a>(records: impl IntoIterator<Item = &'a RunRecord>) -> Result<String> {
    lines(Some(COLUMNS), records.into_iter().map(RunRecord::values))
}

/// One record as a line of CSV.
pub(crate) fn record_line(record: &RunRecord) -> Result<String> {
    lines(None, [record.values()])
}

fn lines(header: Option<&[&str]>, rows: impl IntoIterator<Item = Vec<Value>>) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    if let Some(header) = header {
        writer.write_record(header)?;
    }
    for row in rows {
        writer.write_record(row.iter().map(columns::text))?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Reads runs from a CSV file of `bench`; columns that it lacks stay empty.
///
/// # Errors
/// A table without the columns that tell runs apart or without rows, and values of a wrong type,
/// with their line and column.
pub fn read_csv(text: &str) -> Result<Vec<Run>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers()?.clone();
    let is_there = |name: &&&str| header.iter().any(|column| column == **name);
    if let Some(missing) = NEEDED.iter().find(|name| !is_there(name)) {
        bail!("no column is named {missing:?}; expected a results.csv of `bench`");
    }
    let mut runs = Vec::new();
    for line in reader.records() {
        let line = line?;
        let mut run = Run::default();
        let number = line.position().map_or(0, csv::Position::line);
        for (column, value) in header.iter().zip(&line) {
            let set = run.record.set(column, value);
            set.and_then(|()| run.origin.set(column, value))
                .with_context(|| format!("line {number}"))?;
        }
        runs.push(run);
    }
    if runs.is_empty() {
        bail!("line 1: a header without rows; expected a row for each run below it");
    }
    Ok(runs)
}

/// Reads the table that a build before this one has left in a folder, which may lack columns of
/// this one; a line that a kill has torn is dropped.
///
/// # Errors
/// Columns that this version does not know, rows of other lengths, and runs that stand there twice.
pub(crate) fn read_torn_csv(text: &str) -> Result<Vec<RunRecord>> {
    let n_complete = text.rfind('\n').map_or(0, |i| i + 1);
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .from_reader(&text.as_bytes()[..n_complete]);
    let mut lines = reader.records();
    let Some(header) = lines.next().transpose()? else {
        return Ok(Vec::new());
    };
    let is_there = |name: &&&str| header.iter().any(|column| column == **name);
    if !NEEDED.iter().all(|name| is_there(&name)) || !header.iter().all(|c| COLUMNS.contains(&c)) {
        bail!("its columns are not those of this version; hint: another --out");
    }
    let (mut records, mut keys) = (Vec::new(), BTreeSet::new());
    for line in lines {
        let line = line?;
        let number = line.position().map_or(0, csv::Position::line);
        if line.len() != header.len() {
            bail!("line {number}: no row of {} values", header.len());
        }
        let mut record = RunRecord::default();
        for (column, value) in header.iter().zip(&line) {
            let set = record.set(column, value);
            set.with_context(|| format!("line {number}: no row of {} values", header.len()))?;
        }
        if !keys.insert(record.key()) {
            bail!("line {number}: a second row of one run");
        }
        records.push(record);
    }
    Ok(records)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{Origin, RunStatus};

    #[test]
    fn a_table_read_back_is_the_same() {
        let record = RunRecord {
            scenario: "a, b".to_owned(),
            seed: 3,
            status: RunStatus::Found,
            valid: Some(true),
            length_m: Some(2.0),
            min_clearance_m: Some(1e-7),
            n_cusps: Some(3),
            ..RunRecord::default()
        };
        let origin = Origin {
            machine: "one".to_owned(),
            deadline_ms: Some(20.0),
            ..Origin::default()
        };
        let run = Run {
            record,
            origin,
            ..Run::default()
        };
        let text = to_csv(std::slice::from_ref(&run)).unwrap();
        assert!(
            text.contains("\"a, b\",,3,found,true,,,,,,2.0,1e-7,3,"),
            "{text}"
        );
        assert_eq!(read_csv(&text).unwrap(), [run]);
    }

    #[test]
    fn other_tables_are_refused() {
        let error = read_csv("a,b\n1,2\n").unwrap_err().to_string();
        assert!(error.contains("\"scenario\""), "{error}");
        let told = |rows: &str| {
            let text = format!("scenario,planner,seed,status,length_m\n{rows}");
            format!("{:#}", read_csv(&text).unwrap_err())
        };
        let error = told("a,b,x,found,\n");
        assert!(error.contains("line 2: seed: \"x\""), "{error}");
        let error = told("a,b,0,found,1\na,b,1,fnd,1\n");
        assert!(
            error.contains("line 3: status: \"fnd\"; expected found, no_path"),
            "{error}"
        );
        let error = told("a,b,0,found,far\n");
        assert!(
            error.contains("line 2: length_m: \"far\"; expected a number"),
            "{error}"
        );
        let error = read_csv("scenario,planner,seed,status\n").unwrap_err();
        assert!(error.to_string().contains("without rows"), "{error}");
    }

    #[test]
    fn torn_lines_are_dropped() {
        let record = RunRecord {
            scenario: "a".to_owned(),
            status: RunStatus::Found,
            ..RunRecord::default()
        };
        let text = records_csv([&record]).unwrap();
        let torn = format!("{text}b,astar,0,fou");
        assert_eq!(read_torn_csv(&torn).unwrap(), std::slice::from_ref(&record));
        let twice = format!("{text}{}", record_line(&record).unwrap());
        let error = read_torn_csv(&twice).unwrap_err().to_string();
        assert!(error.contains("line 3: a second row of one run"), "{error}");
        let short = format!("{text}b,astar,0,found\n");
        let error = read_torn_csv(&short).unwrap_err().to_string();
        assert!(error.contains("line 3: no row of 58 values"), "{error}");
        assert_eq!(read_torn_csv("").unwrap(), []);
    }
}

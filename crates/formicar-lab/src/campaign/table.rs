//! Records as CSV: the columns of the row, then those of its origin.

use super::record::{ORIGIN_COLUMNS, Record};
use super::row::COLUMNS;
use anyhow::{Context, Result, bail};
use serde_json::Value;

/// The columns without which nothing can be told apart.
const NEEDED: [&str; 4] = ["scenario", "planner", "seed", "status"];

/// How a run can end: by a planner of ours, by a program, or by no answer at all.
const STATUSES: [&str; 11] = [
    "found",
    "no_path",
    "infeasible",
    "budget_exhausted",
    "timed_out",
    "cancelled",
    "invalid_request",
    "not_found",
    "refused",
    "unavailable",
    "crashed",
];

/// Records as CSV, with a header.
///
/// # Errors
/// None in practice: the table is written to memory.
pub fn to_csv(records: &[Record]) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(COLUMNS.iter().chain(&ORIGIN_COLUMNS))?;
    for record in records {
        writer.write_record(record.row.fields().iter().chain(record.origin.fields()))?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Records of a CSV file of `bench`; columns that it lacks are empty.
///
/// # Errors
/// A table without the columns that tell runs apart or without rows, and lines that are none.
pub fn read_csv(text: &str) -> Result<Vec<Record>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers()?.clone();
    if let Some(missing) = NEEDED
        .iter()
        .find(|name| !header.iter().any(|c| c == **name))
    {
        bail!("no column is named {missing:?}; expected a results.csv of `bench`");
    }
    let mut records = Vec::new();
    for line in reader.records() {
        let line = line?;
        let mut record = Record::default();
        for (column, value) in header.iter().zip(&line) {
            record.row.set(column, &Value::from(value));
            record.origin.set(column, value);
        }
        let number = line.position().map_or(0, csv::Position::line);
        check(&record).with_context(|| format!("line {number}"))?;
        records.push(record);
    }
    if records.is_empty() {
        bail!("line 1: a header without rows; expected a row for each run below it");
    }
    Ok(records)
}

/// Refuses what the columns hold that everything stands on.
fn check(record: &Record) -> Result<()> {
    let [seed, status] = ["seed", "status"].map(|column| record.get(column));
    if seed.parse::<u64>().is_err() {
        bail!("seed: {seed:?}; expected a number from 0 on");
    }
    if !STATUSES.contains(&status) {
        bail!("status: {status:?}; expected {}", STATUSES.join(", "));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::progress::Status;

    #[test]
    fn a_table_read_back_is_the_same() {
        let mut record = Record::default();
        for (column, value) in [
            ("scenario", "a, b"),
            ("seed", "3"),
            ("status", "found"),
            ("length_m", "2.0"),
        ] {
            record.row.set(column, &Value::from(value));
        }
        record.origin.set("machine", "one");
        let text = to_csv(&[record.clone()]).unwrap();
        assert_eq!(read_csv(&text).unwrap(), [record]);
    }

    #[test]
    fn other_tables_are_refused() {
        let error = read_csv("a,b\n1,2\n").unwrap_err().to_string();
        assert!(error.contains("\"scenario\""), "{error}");
        let text = "scenario,planner,seed,status\na,b,x,found\n";
        let error = format!("{:#}", read_csv(text).unwrap_err());
        assert!(error.contains("line 2: seed: \"x\""), "{error}");
        let text = "scenario,planner,seed,status\na,b,0,found\na,b,1,fnd\n";
        let error = format!("{:#}", read_csv(text).unwrap_err());
        assert!(
            error.contains("line 3: status: \"fnd\"; expected found, no_path"),
            "{error}"
        );
        let error = read_csv("scenario,planner,seed,status\n").unwrap_err();
        assert!(error.to_string().contains("without rows"), "{error}");
    }

    #[test]
    fn every_ending_of_a_planner_is_a_status() {
        for status in [
            Status::Found,
            Status::NoPath,
            Status::Infeasible,
            Status::BudgetExhausted,
            Status::TimedOut,
            Status::Cancelled,
        ] {
            assert!(STATUSES.contains(&status.name()), "{status:?}");
        }
    }
}

//! results.csv: a row is written as soon as its run is over, and survives a kill.

use crate::files;
use anyhow::{Context, Result, anyhow, bail};
use formicar::map::format::write_atomically;
use formicar_lab::campaign::{COLUMNS, Row, RowKey};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The table, in memory and on disk.
#[derive(Debug)]
pub(super) struct Results {
    path: PathBuf,
    rows: Vec<Row>,
    file: File,
}

impl Results {
    /// The table of a folder with its complete rows, but for those to be done again; a line that
    /// a kill has torn is dropped.
    pub(super) fn open(
        folder: &Path,
        conditions: &Value,
        again: &BTreeSet<RowKey>,
    ) -> Result<Self> {
        let path = folder.join("results.csv");
        let settings = folder.join("settings.json");
        let rows = if path.exists() {
            check_conditions(&settings, conditions)?;
            let rows = parse(&fs::read(&path).with_context(|| name(&path))?);
            let mut rows = rows.with_context(|| name(&path))?;
            rows.retain(|row| !again.contains(&row.key()));
            rows
        } else {
            let text = format!("{conditions:#}\n");
            write_atomically(&settings, text.as_bytes()).with_context(|| name(&settings))?;
            Vec::new()
        };
        write_atomically(&path, &to_csv(&rows)?).with_context(|| name(&path))?;
        let file = OpenOptions::new().append(true).open(&path);
        let file = file.with_context(|| name(&path))?;
        Ok(Self { path, rows, file })
    }

    /// Adds a row, on disk at once.
    pub(super) fn append(&mut self, row: Row) -> Result<()> {
        let line = csv_lines([row.fields()])?;
        let written = self.file.write_all(&line).and_then(|()| self.file.flush());
        written.with_context(|| name(&self.path))?;
        self.rows.push(row);
        Ok(())
    }

    /// Sorts the table by scenario, planner and seed.
    pub(super) fn finish(&mut self) -> Result<()> {
        self.rows.sort_by_key(Row::key);
        write_atomically(&self.path, &to_csv(&self.rows)?).with_context(|| name(&self.path))
    }

    /// The whole table as text.
    pub(super) fn text(&self) -> Result<String> {
        Ok(String::from_utf8(to_csv(&self.rows)?)?)
    }

    pub(super) fn rows(&self) -> &[Row] {
        &self.rows
    }
}

fn name(path: &Path) -> String {
    path.display().to_string()
}

fn check_conditions(path: &Path, conditions: &Value) -> Result<()> {
    let hint = "hint: another --out, or the flags of before";
    let text = files::read_text(path).context(hint)?;
    let before: Value = serde_json::from_str(&text).with_context(|| name(path))?;
    if before != *conditions {
        bail!(
            "{}: the rows there were made with {before}, now it is {conditions}; {hint}",
            path.display()
        );
    }
    Ok(())
}

fn parse(bytes: &[u8]) -> Result<Vec<Row>> {
    let n_complete = bytes.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .from_reader(&bytes[..n_complete]);
    let mut records = reader.records();
    match records.next().transpose()? {
        None => return Ok(Vec::new()),
        Some(header) if header.iter().eq(COLUMNS) => {}
        Some(_) => bail!("its columns are not those of this version; hint: another --out"),
    }
    let mut rows: Vec<Row> = Vec::new();
    let mut keys = BTreeSet::new();
    for record in records {
        let record = record?;
        let line = record.position().map_or(0, csv::Position::line);
        let fields = record.iter().map(str::to_owned).collect();
        let row = Row::from_fields(fields)
            .ok_or_else(|| anyhow!("line {line}: no row of {} values", COLUMNS.len()))?;
        if !keys.insert(row.key()) {
            bail!("line {line}: a second row of one run");
        }
        rows.push(row);
    }
    Ok(rows)
}

fn to_csv(rows: &[Row]) -> Result<Vec<u8>> {
    let header = COLUMNS.map(str::to_owned);
    csv_lines(std::iter::once(&header[..]).chain(rows.iter().map(Row::fields)))
}

fn csv_lines<'a>(rows: impl IntoIterator<Item = &'a [String]>) -> Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.write_record(row)?;
    }
    writer.into_inner().map_err(|e| anyhow!("{e}"))
}

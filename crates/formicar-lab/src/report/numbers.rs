//! The numbers of a report as CSV.

use super::Report;
use super::keys::Keys;
use anyhow::Result;

/// A line per number of the tables: its name, the same as on the page and in LaTeX, where it
/// stands, and the number as it is written there.
///
/// # Errors
/// No error is expected: everything is written to memory.
pub fn numbers_csv(report: &Report) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(["name", "table", "row", "column", "value"])?;
    let mut keys = Keys::of(report);
    for table in report.tables() {
        let named = keys.name(table);
        for (row, named) in table.rows.iter().zip(&named) {
            let row_name = row.first().map_or(String::new(), super::Field::text);
            for (column, parts) in table.heading.iter().zip(named) {
                for part in parts {
                    let place = [&part.key, &table.key, &row_name, column, &part.text];
                    writer.write_record(place)?;
                }
            }
        }
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Field, Section, Table};

    #[test]
    fn every_number_has_a_line() {
        let mut table = Table::new("t", &["who", "m"]);
        table.row(vec![
            Field::words("a, b"),
            Field::Spread(Some([1.0, 2.0, 3.0]), 1),
        ]);
        let report = Report {
            name: "p".to_owned(),
            sections: vec![Section::of_table("Part", table)],
            ..Report::default()
        };
        let expected = "name,table,row,column,value\npTABM,t,\"a, b\",m,2.0\n\
                        pTABMLow,t,\"a, b\",m,1.0\npTABMHigh,t,\"a, b\",m,3.0\n";
        assert_eq!(numbers_csv(&report).unwrap(), expected);
    }
}

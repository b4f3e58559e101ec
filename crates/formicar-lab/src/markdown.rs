//! Tables in Markdown.

use std::fmt::Write;

/// A table: a heading row, and rows of as many fields.
pub(crate) struct Table {
    text: String,
}

impl Table {
    pub(crate) fn new(heading: &[&str]) -> Self {
        let mut table = Self {
            text: String::new(),
        };
        table.row(heading);
        table.row(&vec!["---"; heading.len()]);
        table
    }

    pub(crate) fn row(&mut self, fields: &[impl AsRef<str>]) {
        self.text.push('|');
        for field in fields {
            let _ = write!(self.text, " {} |", field.as_ref());
        }
        self.text.push('\n');
    }

    pub(crate) fn finish(self) -> String {
        self.text
    }
}

/// A number with so many decimals; a dash for none.
pub(crate) fn number(value: Option<f64>, n_decimals: usize) -> String {
    value.map_or("-".to_owned(), |value| format!("{value:.n_decimals$}"))
}

/// Median, and quartiles in brackets.
pub(crate) fn spread(quartiles: Option<[f64; 3]>, n_decimals: usize) -> String {
    quartiles.map_or("-".to_owned(), |[low, median, high]| {
        format!("{median:.n_decimals$} [{low:.n_decimals$}, {high:.n_decimals$}]")
    })
}

//! Tables.

use super::Field;

/// A table: a heading row, and rows of as many fields.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// A word that names it within its report.
    pub key: String,
    /// The caption; may be empty.
    pub caption: String,
    /// Names of the columns, of which the first names the rows.
    pub heading: Vec<String>,
    /// The rows.
    pub rows: Vec<Row>,
    /// A page shows the caption alone until a reader unfolds the table; paper shows all of it.
    pub is_folded: bool,
}

/// A row: the first field is its name.
pub type Row = Vec<Field>;

/// A column of a table: its heading, and its field of an item.
pub type Column<'c, T> = (&'c str, &'c dyn Fn(&T) -> Field);

impl Table {
    /// A table without rows.
    pub fn new(key: &str, heading: &[&str]) -> Self {
        Self {
            key: key.to_owned(),
            caption: String::new(),
            heading: heading.iter().map(|&name| name.to_owned()).collect(),
            rows: Vec::new(),
            is_folded: false,
        }
    }

    /// A table with a row for each item.
    pub fn of<I: IntoIterator>(key: &str, items: I, columns: &[Column<I::Item>]) -> Self {
        let headings: Vec<&str> = columns.iter().map(|(heading, _)| *heading).collect();
        let row = |item: I::Item| columns.iter().map(|(_, field)| field(&item)).collect();
        Self {
            rows: items.into_iter().map(row).collect(),
            ..Self::new(key, &headings)
        }
    }

    /// The same table with a caption.
    #[must_use]
    pub fn captioned(self, caption: &str) -> Self {
        Self {
            caption: caption.to_owned(),
            ..self
        }
    }

    /// Appends a row.
    pub fn row(&mut self, fields: Row) {
        debug_assert_eq!(fields.len(), self.heading.len());
        self.rows.push(fields);
    }
}

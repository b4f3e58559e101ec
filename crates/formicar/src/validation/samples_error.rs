//! The reasons why a file is no path.

use thiserror::Error;

/// The reason why a table is no path.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum SamplesError {
    /// No rows.
    #[error("the table has no rows of numbers; expected lines of x,y or x,y,heading")]
    Empty,
    /// A header without the columns that are needed.
    #[error("the header {header:?} names no column {missing}; hint: call it {missing}")]
    NoColumn {
        /// The header.
        header: String,
        /// The column that is missing.
        missing: &'static str,
    },
    /// A header with several columns for one coordinate.
    #[error("the header names {name} twice: {:?} and {:?}; hint: leave one out", two[0], two[1])]
    TwoColumns {
        /// The coordinate.
        name: &'static str,
        /// The names.
        two: [String; 2],
    },
    /// A coordinate that is not in meters.
    #[error("the column {name:?} is not in meters; hint: write meters")]
    NotMeters {
        /// The name in the header.
        name: String,
    },
    /// A row with more fields than the header names.
    #[error("line {line}: {n_fields} fields, the header names {n_named}; hint: name every column")]
    LongRow {
        /// Counted from 1.
        line: usize,
        /// Fields found.
        n_fields: usize,
        /// Names in the header.
        n_named: usize,
    },
    /// A quaternion that is no rotation.
    #[error("line {line}: the quaternion points nowhere; expected one of norm 1")]
    BadQuaternion {
        /// Counted from 1.
        line: usize,
    },
    /// A message that holds no path.
    #[error("nav_msgs/Path: {0}")]
    Message(String),
    /// A row with too few fields.
    #[error("line {line}: {n_fields} fields, the path needs {n_needed}")]
    ShortRow {
        /// Counted from 1.
        line: usize,
        /// Fields found.
        n_fields: usize,
        /// Fields needed.
        n_needed: usize,
    },
    /// A field that is no number, or one beyond all maps.
    #[error("line {line}: {field:?} is not a number between -1e9 and 1e9")]
    BadNumber {
        /// Counted from 1.
        line: usize,
        /// The field.
        field: String,
    },
}

/// As much of a text as a message should repeat.
pub(super) fn beginning(text: &str) -> String {
    text.chars().take(40).collect()
}

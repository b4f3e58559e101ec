//! A struct whose fields are the columns of a table.

use anyhow::{Result, bail};
use serde_json::Value;

/// A value of a column, as it is written and read.
pub(super) trait Field: Sized {
    /// The words for what is expected.
    const EXPECTED: &str;

    /// Reads a text; none where it is not a value of this type.
    fn read(text: &str) -> Option<Self>;
}

impl Field for String {
    const EXPECTED: &str = "text";

    fn read(text: &str) -> Option<Self> {
        // A row is a line, so that a torn one is known by its missing end.
        Some(text.replace(['\n', '\r'], " "))
    }
}

impl Field for f64 {
    const EXPECTED: &str = "a number";

    fn read(text: &str) -> Option<Self> {
        text.parse().ok()
    }
}

impl Field for u64 {
    const EXPECTED: &str = "a whole number from 0";

    fn read(text: &str) -> Option<Self> {
        let whole = |x: &f64| *x >= 0.0 && x.fract() == 0.0;
        let rounded = || Some(text.parse().ok().filter(whole)? as u64);
        text.parse().ok().or_else(rounded)
    }
}

impl Field for bool {
    const EXPECTED: &str = "true or false";

    fn read(text: &str) -> Option<Self> {
        text.parse().ok()
    }
}

impl<T: Field> Field for Option<T> {
    const EXPECTED: &str = T::EXPECTED;

    fn read(text: &str) -> Option<Self> {
        match text {
            "" => Some(None),
            text => T::read(text).map(Some),
        }
    }
}

/// Reads the value of a column.
pub(super) fn read<T: Field>(column: &str, text: &str) -> Result<T> {
    match T::read(text) {
        Some(value) => Ok(value),
        None => bail!("{column}: {text:?}; expected {}", T::EXPECTED),
    }
}

/// A JSON value as the text of a cell; empty for null.
pub(super) fn text(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

/// Declares a struct together with the names of its columns, in the order of the table. A column is
/// named like its field, unless `= "name"` says otherwise.
macro_rules! table_columns {
    (
        $(#[$about:meta])*
        $name:ident, $columns:ident:
        $($(#[$field_about:meta])* $field:ident: $kind:ty $(= $column:literal)?,)*
    ) => {
        $(#[$about])*
        #[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(try_from = "serde_json::Map<String, serde_json::Value>")]
        pub struct $name {
            $($(#[$field_about])* $(#[serde(rename = $column)])? pub $field: $kind,)*
        }

        #[doc = concat!("The columns of [`", stringify!($name), "`], in order.")]
        pub const $columns: &[&str] =
            &[$($crate::run::columns::column_name!($field $($column)?)),*];

        impl $name {
            /// The values in the order of the columns; null where there is none.
            pub fn values(&self) -> Vec<serde_json::Value> {
                vec![$(serde_json::json!(self.$field)),*]
            }

            /// Takes the values of a JSON object whose keys are columns; others are ignored.
            pub(crate) fn fill(&mut self, values: &serde_json::Value) -> anyhow::Result<()> {
                for (column, value) in values.as_object().into_iter().flatten() {
                    self.set(column, &$crate::run::columns::text(value))?;
                }
                Ok(())
            }

            /// Reads the text of a cell. Columns of others are ignored.
            pub(crate) fn set(&mut self, column: &str, text: &str) -> anyhow::Result<()> {
                match column {
                    $($crate::run::columns::column_name!($field $($column)?) => {
                        self.$field = $crate::run::columns::read(column, text)?;
                    })*
                    _ => {}
                }
                Ok(())
            }
        }

        impl TryFrom<serde_json::Map<String, serde_json::Value>> for $name {
            type Error = anyhow::Error;

            fn try_from(values: serde_json::Map<String, serde_json::Value>) -> anyhow::Result<Self> {
                let mut row = Self::default();
                row.fill(&serde_json::Value::Object(values))?;
                Ok(row)
            }
        }
    };
}

/// The name of a column: that of its field, unless another is given.
macro_rules! column_name {
    ($field:ident) => {
        stringify!($field)
    };
    ($field:ident $column:literal) => {
        $column
    };
}

pub(super) use {column_name, table_columns};

//! Rows of results that belong together: their numbers as fields of tables, and their pairs.

use crate::analysis::statistics::{quantile, quartiles};
use crate::papers::claims::{Comparison, Counted, Expected};
use crate::report::{BoxGroup, Field, Table};

/// A row of the results of an experiment.
pub(crate) trait ResultRow {
    /// The map, with the request where there are several.
    fn ground(&self) -> &str;
    /// The seed of the run.
    fn seed(&self) -> u64;
}

/// A quantity of a row that claims compare.
#[derive(Debug)]
pub(crate) struct Quantity<R> {
    pub(crate) name: &'static str,
    pub(crate) n_decimals: usize,
    pub(crate) of: fn(&R) -> Option<f64>,
}

impl<R> Quantity<R> {
    pub(crate) const fn new(
        name: &'static str,
        n_decimals: usize,
        of: fn(&R) -> Option<f64>,
    ) -> Self {
        Self {
            name,
            n_decimals,
            of,
        }
    }
}

/// Rows that belong together.
#[derive(Clone, Debug)]
pub(crate) struct Group<'a, R>(Vec<&'a R>);

impl<'a, R> Group<'a, R> {
    /// The rows that belong to it, in order.
    pub(crate) fn of(rows: &'a [R], belongs: impl Fn(&R) -> bool) -> Self {
        Self::new(rows.iter().filter(|row| belongs(row)))
    }

    pub(crate) fn new(rows: impl Iterator<Item = &'a R>) -> Self {
        Self(rows.collect())
    }

    pub(crate) fn filter(&self, belongs: impl Fn(&R) -> bool) -> Self {
        Self::new(self.0.iter().copied().filter(|row| belongs(row)))
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// The values of the rows that have one.
    pub(crate) fn values(&self, of: impl Fn(&R) -> Option<f64>) -> Vec<f64> {
        self.0.iter().filter_map(|row| of(row)).collect()
    }

    pub(crate) fn median(&self, of: impl Fn(&R) -> Option<f64>) -> Option<f64> {
        quantile(&self.values(of), 0.5)
    }

    pub(crate) fn mean(&self, of: impl Fn(&R) -> Option<f64>) -> Option<f64> {
        let values = self.values(of);
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    }

    pub(crate) fn count(&self, is: impl Fn(&R) -> bool) -> usize {
        self.0.iter().filter(|row| is(row)).count()
    }

    /// Median and quartiles as a field.
    pub(crate) fn spread(&self, of: impl Fn(&R) -> Option<f64>, n_decimals: usize) -> Field {
        Field::Spread(quartiles(&self.values(of)), n_decimals)
    }

    /// The median as a field.
    pub(crate) fn number(&self, of: impl Fn(&R) -> Option<f64>, n_decimals: usize) -> Field {
        Field::Number(self.median(of), n_decimals)
    }

    /// The number of rows of a kind, with the interval of its rate.
    pub(crate) fn rate(&self, is: impl Fn(&R) -> bool) -> Field {
        Field::Rate(self.count(is), self.len())
    }

    /// The rows of a kind, for a claim.
    pub(crate) fn counted(&self, name: String, is: impl Fn(&R) -> bool) -> Counted {
        Counted {
            name,
            n: self.count(is),
            of: self.len(),
        }
    }

    /// All values as a row of a box plot.
    pub(crate) fn boxed(&self, name: &str, of: impl Fn(&R) -> Option<f64>) -> BoxGroup {
        BoxGroup {
            name: name.to_owned(),
            values: self.values(of),
        }
    }
}

impl<R: ResultRow> Group<'_, R> {
    /// A quantity against another group's, seed by seed, where both have a value.
    pub(crate) fn compare(
        &self,
        other: &Self,
        quantity: &Quantity<R>,
        name: String,
        expected: Expected,
    ) -> Comparison {
        let pair = |row: &&R| {
            let is_same =
                |other: &&&R| other.seed() == row.seed() && other.ground() == row.ground();
            let same = other.0.iter().find(is_same)?;
            Some([(quantity.of)(row)?, (quantity.of)(same)?])
        };
        Comparison {
            name,
            quantity: quantity.name.to_owned(),
            n_decimals: quantity.n_decimals,
            pairs: self.0.iter().filter_map(pair).collect(),
            expected,
        }
    }
}

/// A column of a table with a row per group: its heading, and the field of a group and its name.
pub(crate) type GroupColumn<'c, R> = (&'static str, &'c dyn Fn(&Group<R>, &str) -> Field);

/// A table with a row per group; the first column holds the names of the groups.
pub(crate) fn table_of<'n, 'a, R: 'a>(
    key: &str,
    name: &'static str,
    columns: &[GroupColumn<R>],
    groups: impl IntoIterator<Item = (&'n str, Group<'a, R>)>,
) -> Table {
    let headings = columns.iter().map(|(heading, _)| *heading);
    let headings: Vec<&str> = [name].into_iter().chain(headings).collect();
    let mut table = Table::new(key, &headings);
    for (name, group) in groups {
        let fields = columns.iter().map(|(_, field)| field(&group, name));
        table.row([Field::words(name)].into_iter().chain(fields).collect());
    }
    table
}

/// One number over another.
pub(crate) fn ratio(value: Option<f64>, to: Option<f64>) -> Option<f64> {
    let ratio = value? / to?;
    ratio.is_finite().then_some(ratio)
}

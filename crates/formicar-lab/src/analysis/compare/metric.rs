//! What is compared.

use super::not_run::not_run;
use crate::campaign::Record;
use serde::Serialize;

/// Which way a metric is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Better {
    /// The less, the better.
    Lower,
    /// The more, the better.
    Higher,
}

/// What a value depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// On the run alone: same seed, same value, on any machine.
    Result,
    /// On the machine and the moment too.
    Measurement,
}

/// Which metrics are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// All of them.
    All,
    /// Those that depend on the run alone: a busy machine changes none of them.
    Results,
}

impl Scope {
    /// Whether a metric is compared.
    pub fn holds(self, metric: &Metric) -> bool {
        self == Self::All || metric.kind == Kind::Result
    }
}

/// A metric of a run.
#[derive(Clone, Copy, Debug)]
pub struct Metric {
    /// Its name, with its unit.
    pub name: &'static str,
    /// The column of the results.
    pub column: &'static str,
    /// Units of the name in one of the column.
    pub scale: f64,
    /// Decimals that are written.
    pub n_decimals: usize,
    /// Which way it is better.
    pub better: Better,
    /// What it depends on.
    pub kind: Kind,
}

/// The name of the metric of every run that took place: 1 where a certified path was returned, else 0.
pub const SUCCESS: &str = "success";

/// The metrics in the order of the tables.
pub const METRICS: [Metric; 10] = [
    metric((SUCCESS, "valid"), 1.0, 3, Better::Higher, Kind::Result),
    metric(
        ("first path ms", "first_feasible_s"),
        1e3,
        2,
        Better::Lower,
        Kind::Measurement,
    ),
    metric(
        ("query ms", "query_s"),
        1e3,
        2,
        Better::Lower,
        Kind::Measurement,
    ),
    metric(
        ("length m", "length_m"),
        1.0,
        3,
        Better::Lower,
        Kind::Result,
    ),
    metric(("cost m", "cost_m"), 1.0, 3, Better::Lower, Kind::Result),
    metric(
        ("clearance m", "min_clearance_m"),
        1.0,
        3,
        Better::Higher,
        Kind::Result,
    ),
    metric(("cusps", "n_cusps"), 1.0, 1, Better::Lower, Kind::Result),
    metric(
        ("memory MB", "peak_rss_bytes"),
        1e-6,
        1,
        Better::Lower,
        Kind::Measurement,
    ),
    metric(("steps", "steps"), 1.0, 0, Better::Lower, Kind::Result),
    metric(
        ("steps to first path", "first_steps"),
        1.0,
        0,
        Better::Lower,
        Kind::Result,
    ),
];

const fn metric(
    (name, column): (&'static str, &'static str),
    scale: f64,
    n_decimals: usize,
    better: Better,
    kind: Kind,
) -> Metric {
    Metric {
        name,
        column,
        scale,
        n_decimals,
        better,
        kind,
    }
}

impl Metric {
    /// Its value of a run; none of a run without a certified path, but for success, which only
    /// runs that did not take place have none of.
    pub fn of(&self, record: &Record) -> Option<f64> {
        let is_solved = record.row.is_solved();
        if self.name == SUCCESS {
            return not_run(record)
                .is_none()
                .then(|| f64::from(u8::from(is_solved)));
        }
        let value = record.row.number(self.column).filter(|_| is_solved)?;
        Some(value * self.scale).filter(|v| v.is_finite())
    }
}

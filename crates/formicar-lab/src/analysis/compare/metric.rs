//! The metrics that are compared.

use super::not_run::not_run;
use crate::run::{Run, RunRecord, number};
use serde::Serialize;

/// The direction in which a metric is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Better {
    /// The less, the better.
    Lower,
    /// The more, the better.
    Higher,
}

/// The dependencies of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// On the run alone: same seed, same value, on any machine.
    Result,
    /// On the machine and the moment too.
    Measurement,
}

/// The metrics that are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// All of them.
    All,
    /// Those that depend on the run alone: a busy machine changes none of them.
    Results,
}

impl Scope {
    /// True if a metric is compared.
    pub fn holds(self, metric: &Metric) -> bool {
        self == Self::All || metric.kind == Kind::Result
    }
}

/// A metric of a run.
#[derive(Clone, Copy, Debug)]
pub struct Metric {
    /// Its name, with its unit.
    pub name: &'static str,
    /// Its value in a record, in the unit of the name.
    pub value: fn(&RunRecord) -> Option<f64>,
    /// Decimals that are written.
    pub n_decimals: usize,
    /// The direction in which it is better.
    pub better: Better,
    /// Its dependencies.
    pub kind: Kind,
}

/// The name of the metric of every run that took place: 1 where a certified path was returned, else 0.
pub const SUCCESS: &str = "success";

/// The metrics in the order of the tables.
pub const METRICS: [Metric; 10] = [
    Metric {
        name: SUCCESS,
        value: |record| Some(f64::from(u8::from(record.is_solved()))),
        n_decimals: 3,
        better: Better::Higher,
        kind: Kind::Result,
    },
    Metric {
        kind: Kind::Measurement,
        ..lower("first path ms", 2, |record| {
            Some(record.first_feasible_s? * 1e3)
        })
    },
    Metric {
        kind: Kind::Measurement,
        ..lower("query ms", 2, |record| Some(record.query_s? * 1e3))
    },
    lower("length m", 3, |record| record.length_m),
    lower("cost m", 3, |record| record.cost_m),
    Metric {
        better: Better::Higher,
        ..lower("clearance m", 3, |record| record.min_clearance_m)
    },
    lower("cusps", 1, |record| number(record.n_cusps)),
    Metric {
        kind: Kind::Measurement,
        ..lower("memory MB", 1, |record| {
            Some(number(record.peak_rss_bytes)? * 1e-6)
        })
    },
    lower("steps", 0, |record| number(record.steps)),
    lower("steps to first path", 0, |record| {
        number(record.first_steps)
    }),
];

/// A result of which less is better.
const fn lower(
    name: &'static str,
    n_decimals: usize,
    value: fn(&RunRecord) -> Option<f64>,
) -> Metric {
    Metric {
        name,
        value,
        n_decimals,
        better: Better::Lower,
        kind: Kind::Result,
    }
}

impl Metric {
    /// Its value of a run: none without a certified path, except that success is known of every run
    /// that took place.
    pub fn of(&self, run: &Run) -> Option<f64> {
        let is_known = if self.name == SUCCESS {
            not_run(run).is_none()
        } else {
            run.record.is_solved()
        };
        let value = (self.value)(&run.record).filter(|value| value.is_finite());
        value.filter(|_| is_known)
    }
}

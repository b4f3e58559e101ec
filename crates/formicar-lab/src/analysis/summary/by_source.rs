//! Totals per source of scenarios and planner.

use crate::run::{RunRecord, RunStatus, number};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Relative difference within which a length is the optimum: files print six digits.
const OPTIMUM_TOLERANCE: f64 = 1e-4;

/// Totals of runs, a line per source and planner.
#[derive(Debug)]
pub struct Summary(Vec<Group>);

/// The rows of one planner on one source of scenarios.
#[derive(Debug)]
struct Group {
    source: String,
    planner: String,
    n_runs: usize,
    n_solved: usize,
    n_certified: usize,
    n_crashed: usize,
    first_feasible_s: Spread,
    query_s: Spread,
    median_length_m: Option<f64>,
    median_clearance_m: Option<f64>,
    median_cusps: Option<f64>,
    /// Runs with a known optimum, and those that meet it.
    optimum: Option<[usize; 2]>,
}

/// Median, 90th percentile and largest value.
#[derive(Debug)]
struct Spread(Option<[f64; 3]>);

impl Summary {
    /// Groups records.
    pub fn new(records: &[RunRecord]) -> Self {
        let mut groups: BTreeMap<_, Vec<&RunRecord>> = BTreeMap::new();
        for record in records {
            let key = (record.source.as_str(), record.planner.as_str());
            groups.entry(key).or_default().push(record);
        }
        Self(groups.values().map(|records| Group::new(records)).collect())
    }

    /// As a page.
    pub fn markdown(&self) -> String {
        let mut text = "# Summary\n\n\
            Per source of scenarios and planner. Solved: a path was returned; certified: it carries \
            the judge's certificate. Times in milliseconds as median / 90th percentile / largest, \
            of the first certified path within its query over the solved runs, and of the query \
            over all runs; lengths, clearances and cusps are medians of the solved runs. Optimal: \
            runs whose length in cells is the published optimum within 1e-4.\n\n\
            | source | planner | runs | solved | certified | crashed | first path ms | query ms \
            | length m | clearance m | cusps | optimal |\n\
            |---|---|---|---|---|---|---|---|---|---|---|---|\n"
            .to_owned();
        for group in &self.0 {
            let optimal = group.optimum.map(|[n, met]| format!("{met} of {n}"));
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
                group.source,
                group.planner,
                group.n_runs,
                group.n_solved,
                group.n_certified,
                group.n_crashed,
                group.first_feasible_s.in_ms(),
                group.query_s.in_ms(),
                decimal(group.median_length_m, 2),
                decimal(group.median_clearance_m, 3),
                decimal(group.median_cusps, 1),
                optimal.unwrap_or_default(),
            );
        }
        text
    }

    /// Writes lines for a terminal.
    ///
    /// # Errors
    /// A writer that fails.
    pub fn write_plain(&self, out: &mut impl Write) -> io::Result<()> {
        let width =
            |name: fn(&Group) -> &str| self.0.iter().map(|g| name(g).len()).max().unwrap_or(0);
        let (of_source, of_planner) = (width(|g| &g.source), width(|g| &g.planner));
        for group in &self.0 {
            write!(
                out,
                "{:of_source$}  {:of_planner$}  {} of {} found",
                group.source, group.planner, group.n_solved, group.n_runs
            )?;
            if group.n_certified < group.n_solved {
                write!(out, ", {} certified", group.n_certified)?;
            }
            if group.n_crashed > 0 {
                write!(out, ", {} crashed", group.n_crashed)?;
            }
            if let Some([n, met]) = group.optimum {
                write!(out, ", {met} of {n} optimal")?;
            }
            if let Some([median_s, _, max_s]) = group.query_s.0 {
                let (median_ms, max_ms) = (median_s * 1e3, max_s * 1e3);
                write!(
                    out,
                    ", query {median_ms:.1} ms (median), {max_ms:.1} ms (largest)"
                )?;
            }
            writeln!(out)?;
        }
        Ok(())
    }
}

impl Group {
    /// The rows are of one group, and at least one.
    fn new(records: &[&RunRecord]) -> Self {
        let count = |is_it: fn(&RunRecord) -> bool| {
            let all = records.iter();
            all.filter(|record| is_it(record)).count()
        };
        let numbers = |of: fn(&RunRecord) -> Option<f64>| -> Vec<f64> {
            let mut numbers: Vec<f64> = records.iter().filter_map(|record| of(record)).collect();
            numbers.sort_by(f64::total_cmp);
            numbers
        };
        let n_with_optimum = count(|record| record.optimal_length_cells.is_some());
        let n_optimal = count(is_optimal);
        Self {
            source: records[0].source.clone(),
            planner: records[0].planner.clone(),
            n_runs: records.len(),
            n_solved: count(|record| record.status == RunStatus::Found),
            n_certified: count(|record| record.valid == Some(true)),
            n_crashed: count(|record| record.status == RunStatus::Crashed),
            first_feasible_s: Spread::new(&numbers(|record| record.first_feasible_s)),
            query_s: Spread::new(&numbers(|record| record.query_s)),
            median_length_m: median(&numbers(|record| record.length_m)),
            median_clearance_m: median(&numbers(|record| record.min_clearance_m)),
            median_cusps: median(&numbers(|record| number(record.n_cusps))),
            optimum: (n_with_optimum > 0).then_some([n_with_optimum, n_optimal]),
        }
    }
}

fn is_optimal(record: &RunRecord) -> bool {
    let (Some(length), Some(optimum)) = (record.length_cells, record.optimal_length_cells) else {
        return false;
    };
    (length - optimum).abs() <= OPTIMUM_TOLERANCE * optimum.max(1.0)
}

impl Spread {
    fn new(sorted: &[f64]) -> Self {
        // Nearest rank: the smallest value that at least nine tenths do not exceed.
        let rank_90 = (sorted.len() * 9).div_ceil(10);
        let median = median(sorted);
        Self(median.and_then(|m| Some([m, *sorted.get(rank_90.checked_sub(1)?)?, *sorted.last()?])))
    }

    fn in_ms(&self) -> String {
        self.0.map_or(String::new(), |seconds| {
            seconds.map(|s| format!("{:.1}", s * 1e3)).join(" / ")
        })
    }
}

fn median(sorted: &[f64]) -> Option<f64> {
    let half = sorted.len() / 2;
    match sorted.len() {
        0 => None,
        n if n % 2 == 1 => Some(sorted[half]),
        _ => Some(0.5 * (sorted[half - 1] + sorted[half])),
    }
}

fn decimal(value: Option<f64>, n_digits: usize) -> String {
    value.map_or(String::new(), |v| format!("{v:.n_digits$}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreads_of_few_and_many() {
        assert_eq!(Spread::new(&[]).0, None);
        assert_eq!(Spread::new(&[2.0]).0, Some([2.0; 3]));
        let ten: Vec<f64> = (1..=10).map(f64::from).collect();
        assert_eq!(Spread::new(&ten).0, Some([5.5, 9.0, 10.0]));
        assert_eq!(Spread::new(&[0.001]).in_ms(), "1.0 / 1.0 / 1.0");
    }
}

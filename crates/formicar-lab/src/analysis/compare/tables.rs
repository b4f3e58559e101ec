//! A comparison as a report.

use super::{Comparison, Duel, Finding, METRICS, SUCCESS};
use crate::report::{Block, Column, Field, Report, Section, Table};

/// The method of comparison, in words.
pub const METHOD: &str = "Paired by scenario and seed. Medians over the pairs in which both sides \
    return a certified path (of success the share over all pairs); `ratio`, the median of the \
    ratios second over first with its 95 % bootstrap interval; `p`, the probability of Wilcoxon's \
    signed-rank test, adjusted after Holm over the table, over the `pairs` that count: one of a \
    scenario on which the seed does not change the metric; `A`, Vargha & Delaney's probability that \
    the second side's value is above the first's, averaged over scenarios. A difference is told \
    where `p` is below 0.05, of times and memory only where the median ratio is off 1 by 1 % or \
    more.";

/// The names of both sides, as columns.
type Names<'a> = [&'a str; 2];

impl Comparison {
    /// All of it as a report.
    pub fn report(&self) -> Report {
        let [a, b] = &self.sides;
        let duels = self.duels.iter();
        Report {
            name: format!("compare {a} {b}"),
            title: format!("{b} beside {a}"),
            intro: format!("Verdicts are on {b}: better or worse than {a}. {METHOD}"),
            sections: duels.map(|duel| duel.section([a, b])).collect(),
        }
    }
}

impl Duel {
    /// The findings as a section, the sides under names.
    pub fn section(&self, names: Names) -> Section {
        let [of_a, of_b] = &self.planners;
        let heading = if of_a == of_b {
            format!("`{of_a}`")
        } else {
            format!("`{of_b}` beside `{of_a}`")
        };
        let mut blocks = vec![Block::Text(self.about())];
        blocks.extend(self.notes.iter().cloned().map(Block::Text));
        blocks.push(Block::Table(self.table(names)));
        for (name, runs) in names.iter().zip([&self.lost, &self.gained]) {
            if !runs.is_empty() {
                let text = format!("Solved by {name} alone: {}.", runs.join(", "));
                blocks.push(Block::Text(text));
            }
        }
        Section { heading, blocks }
    }

    fn about(&self) -> String {
        let [a, b] = self.n_alone;
        let alone = match (a, b) {
            (0, 0) => String::new(),
            _ => format!(" Runs that only one side has are left out: {a} and {b}."),
        };
        format!("{} pairs of runs.{alone}", self.n_pairs)
    }

    fn table(&self, [a, b]: Names) -> Table {
        let columns: [Column<&Finding>; 9] = [
            ("metric", &|finding| Field::words(finding.metric)),
            (a, &|finding| side(finding, 0)),
            (b, &|finding| side(finding, 1)),
            ("pairs", &|finding| Field::count(finding.n_pairs)),
            ("equal", &|finding| Field::count(finding.n_equal)),
            ("ratio", &|finding| Field::Spread(finding.ratio, 3)),
            ("p", &|finding| Field::Probability(finding.p)),
            ("A", &|finding| Field::Number(finding.above, 2)),
            ("verdict", &|finding| Field::words(finding.verdict.words())),
        ];
        let key = format!("compare {}", self.planners[1]);
        Table::of(&key, &self.findings, &columns)
    }
}

fn side(finding: &Finding, i: usize) -> Field {
    let metric = METRICS.iter().find(|metric| metric.name == finding.metric);
    let n_decimals = metric.map_or(3, |metric| metric.n_decimals);
    let n = finding.n_all_pairs;
    match finding.of_sides {
        Some(shares) if finding.metric == SUCCESS => {
            Field::Count((shares[i] * n as f64).round() as usize, n)
        }
        medians => Field::Number(medians.map(|medians| medians[i]), n_decimals),
    }
}

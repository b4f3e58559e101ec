//! Verdicts and tests as sections of a page.

use super::judge::{Judged, Tested};
use super::{Claims, Expected};
use crate::report::{Block, Field, PairedPanel, PairedPlot, Section, Table};

const RULE: &str = "Each claim is tested on our maps, method against method, seed by seed. A test \
     speaks for a claim where the signed-rank test of Wilcoxon (two-sided; exact up to 50 \
     differences of different sizes, normal approximation beyond), corrected by Holm over all tests \
     of this page, has p < 0.05 and the sign that the claim says. A claim `holds` where all its \
     tests speak for it, `holds in part` where some do, `does not hold` where none does; `too few \
     runs` stands where even differences all of one sign could not reach that level. A claim that \
     two are the same holds where the 95 % interval of the median difference lies within the \
     margin given. A claim of a count holds where all runs are as claimed, in part where more than \
     half are. Runs without a value, because no path was found, have no pair.";

impl Claims {
    /// The verdicts.
    pub(crate) fn verdicts(&self) -> Section {
        let table = Block::Table(verdicts(&self.judged()));
        Section::new(
            "Claims and verdicts",
            vec![table, Block::Text(RULE.to_owned())],
        )
    }

    /// The tests behind the verdicts, and their differences as pictures.
    pub(crate) fn tests(&self) -> Section {
        let judged = self.judged();
        let table = Block::Table(tests(&judged));
        let plots = plots(&judged).into_iter().map(Block::Paired);
        let blocks = [table].into_iter().chain(plots).collect();
        Section::new("Tests of the claims", blocks)
    }
}

fn verdicts(judged: &[Judged]) -> Table {
    let mut table = Table::new(
        "verdicts",
        &[
            "no.", "claim", "verdict", "paper", "ours", "for", "against", "open", "where",
        ],
    )
    .captioned(
        "The paper's claims. `ours` gives medians, the paper's method before the other, in the \
         order in which the tests of the claim are listed further below, or counts of runs; `for`, \
         `against` and `open` count tests.",
    );
    for (i, judged) in judged.iter().enumerate() {
        let claim = judged.claim;
        let [n_for, n_against, n_open] = judged.tally();
        table.row(vec![
            Field::Words(format!("{}", i + 1)),
            Field::words(&claim.words),
            Field::Verdict(judged.verdict),
            Field::words(&claim.paper),
            Field::Words(ours(judged)),
            Field::Number(Some(n_for as f64), 0),
            Field::Number(Some(n_against as f64), 0),
            Field::Number(Some(n_open as f64), 0),
            Field::words(&claim.place),
        ]);
    }
    table
}

/// Medians of all comparisons, and counts.
fn ours(judged: &Judged) -> String {
    let tests = judged.tests.iter().map(|test| {
        let n = test.comparison.n_decimals;
        test.medians
            .map_or("no pairs".to_owned(), |[first, other]| {
                format!("{first:.n$} : {other:.n$}")
            })
    });
    let counts = judged
        .counts
        .iter()
        .map(|(count, _)| format!("{}/{}", count.n, count.of));
    tests.chain(counts).collect::<Vec<_>>().join("; ")
}

fn tests(judged: &[Judged]) -> Table {
    let mut table = Table::new(
        "tests",
        &[
            "test",
            "quantity",
            "expected",
            "pairs",
            "first",
            "other",
            "difference",
            "p",
            "p, Holm",
            "A",
        ],
    )
    .captioned(
        "The tests, named by claim: medians of both, the median difference, first less other, with \
         its 95 % interval (percentile bootstrap of 2000 samples, seed 0), the probability of the \
         signed-rank test before and after Holm's correction, and Vargha and Delaney's A: how often \
         the first has the larger value.",
    );
    for (i, judged) in judged.iter().enumerate() {
        for test in &judged.tests {
            table.row(row(i, test));
        }
    }
    table
}

fn row(claim: usize, test: &Tested) -> Vec<Field> {
    let comparison = test.comparison;
    let n = comparison.n_decimals;
    let median = |which: usize| Field::Number(test.medians.map(|medians| medians[which]), n);
    let expected = match comparison.expected {
        Expected::Less => "less".to_owned(),
        Expected::More => "more".to_owned(),
        Expected::Same(share) => format!("same to {:.0} %", 100.0 * share),
    };
    vec![
        Field::Words(format!("{}: {}", claim + 1, comparison.name)),
        Field::words(&comparison.quantity),
        Field::Words(expected),
        Field::Number(Some(comparison.pairs.len() as f64), 0),
        median(0),
        median(1),
        Field::Spread(test.difference, n),
        Field::Probability(test.p),
        Field::Probability(test.p_holm),
        Field::Number(test.a, 2),
    ]
}

/// A picture per claim and quantity.
fn plots(judged: &[Judged]) -> Vec<PairedPlot> {
    let mut plots: Vec<PairedPlot> = Vec::new();
    for (i, judged) in judged.iter().enumerate() {
        for same in judged
            .tests
            .chunk_by(|a, b| a.comparison.quantity == b.comparison.quantity)
        {
            let panels = same.iter().map(|test| PairedPanel {
                name: test.comparison.name.clone(),
                differences: test.comparison.differences(),
            });
            plots.push(PairedPlot {
                caption: format!(
                    "Claim {}, {}: differences in {} seed by seed, first less other, sorted; below \
                     the line at 0 filled, above it hollow.",
                    i + 1,
                    in_a_sentence(&judged.claim.words),
                    same[0].comparison.quantity
                ),
                quantity: same[0].comparison.quantity.clone(),
                panels: panels.collect(),
            });
        }
    }
    plots
}

/// Words with a small first letter, but for names.
fn in_a_sentence(words: &str) -> String {
    let mut chars = words.chars();
    let first = chars.next();
    let is_name = words.chars().nth(1).is_some_and(char::is_uppercase);
    match first {
        Some(first) if !is_name => first.to_lowercase().chain(chars).collect(),
        _ => words.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::papers::claims::{Claim, Comparison, Counted};
    use crate::report::Verdict;

    #[test]
    fn claims_come_with_verdict_tests_and_pictures() {
        let comparison = |name: &str| Comparison {
            name: name.to_owned(),
            quantity: "length, m".to_owned(),
            n_decimals: 1,
            pairs: (0..31).map(|i| [5.0, 6.0 + 0.1 * f64::from(i)]).collect(),
            expected: Expected::Less,
        };
        let count = Counted {
            name: "map".to_owned(),
            n: 31,
            of: 31,
        };
        let claims = Claims(vec![
            Claim::new(
                "shorter",
                "sec. 5",
                "1 : 2",
                vec![comparison("a"), comparison("b")],
            ),
            Claim::new("arrives", "sec. 6", "-", vec![count]),
        ]);
        let (verdicts, tests) = (claims.verdicts(), claims.tests());
        let Block::Table(verdicts) = &verdicts.blocks[0] else {
            panic!("{verdicts:?}")
        };
        let [Block::Table(tests), Block::Paired(plot)] = &tests.blocks[..] else {
            panic!("{tests:?}")
        };
        assert_eq!(verdicts.heading[2], "verdict");
        assert_eq!(verdicts.rows[0][2], Field::Verdict(Verdict::Holds));
        assert_eq!(verdicts.rows[0][4], Field::words("5.0 : 7.5; 5.0 : 7.5"));
        assert_eq!(verdicts.rows[1][4], Field::words("31/31"));
        assert_eq!(tests.rows.len(), 2);
        assert_eq!(tests.rows[1][0], Field::words("1: b"));
        assert_eq!(plot.panels.len(), 2);
    }
}

//! Verdicts and tests as sections of a page.

use super::judge::{Judged, Tested};
use super::{Claims, Expected};
use crate::report::{Block, Column, Field, PairedPanel, PairedPlot, Section, Table};

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
    let tally = |judged: &Judged, i: usize| Field::count(judged.tally()[i]);
    let columns: [Column<(usize, &Judged)>; 9] = [
        ("no.", &|(i, _)| Field::Words(format!("{}", i + 1))),
        ("claim", &|(_, judged)| Field::words(&judged.claim.words)),
        ("verdict", &|(_, judged)| Field::Verdict(judged.verdict)),
        ("paper", &|(_, judged)| Field::words(&judged.claim.paper)),
        ("ours", &|(_, judged)| Field::Words(ours(judged))),
        ("for", &|(_, judged)| tally(judged, 0)),
        ("against", &|(_, judged)| tally(judged, 1)),
        ("open", &|(_, judged)| tally(judged, 2)),
        ("where", &|(_, judged)| Field::words(&judged.claim.place)),
    ];
    Table::of("verdicts", judged.iter().enumerate(), &columns).captioned(
        "The paper's claims. `ours` gives medians, the paper's method before the other, in the \
         order in which the tests of the claim are listed further below, or counts of runs; `for`, \
         `against` and `open` count tests.",
    )
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
    let numbered = (1..).zip(judged);
    let tests = numbered.flat_map(|(claim, judged)| judged.tests.iter().map(move |t| (claim, t)));
    let median = |test: &Tested, which: usize| {
        let medians = test.medians.map(|medians| medians[which]);
        Field::Number(medians, test.comparison.n_decimals)
    };
    let columns: [Column<(usize, &Tested)>; 10] = [
        ("test", &|(claim, test)| {
            Field::Words(format!("{claim}: {}", test.comparison.name))
        }),
        ("quantity", &|(_, test)| {
            Field::words(&test.comparison.quantity)
        }),
        ("expected", &|(_, test)| expected(test.comparison.expected)),
        ("pairs", &|(_, test)| {
            Field::count(test.comparison.pairs.len())
        }),
        ("first", &|(_, test)| median(test, 0)),
        ("other", &|(_, test)| median(test, 1)),
        ("difference", &|(_, test)| {
            Field::Spread(test.difference, test.comparison.n_decimals)
        }),
        ("p", &|(_, test)| Field::Probability(test.p)),
        ("p, Holm", &|(_, test)| Field::Probability(test.p_holm)),
        ("A", &|(_, test)| Field::Number(test.a, 2)),
    ];
    Table::of("tests", tests, &columns).captioned(
        "The tests, named by claim: medians of both, the median difference, first less other, with \
         its 95 % interval (percentile bootstrap of 2000 samples, seed 0), the probability of the \
         signed-rank test before and after Holm's correction, and Vargha and Delaney's A: how often \
         the first has the larger value.",
    )
}

fn expected(expected: Expected) -> Field {
    Field::Words(match expected {
        Expected::Less => "less".to_owned(),
        Expected::More => "more".to_owned(),
        Expected::Same(share) => format!("same to {:.0} %", 100.0 * share),
    })
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

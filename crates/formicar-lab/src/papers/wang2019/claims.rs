//! The claims of the paper.

use super::adjacency::{self, Timing};
use super::variants::{JOSHY, MAPS, PROPOSED, ZHANG};
use crate::papers::Trial;
use crate::papers::claims::{Claims, Comparison, Counted, Expected, claims};
use crate::papers::group::Quantity;
use crate::papers::trials::{self, CONVERGED, Runs, SEARCH};

const LENGTH: Quantity<Trial> = Quantity {
    n_decimals: 2,
    ..trials::LENGTH
};
const SQUEEZES: Quantity<Trial> = Quantity::new("steps through narrow aisles", 0, |trial| {
    Some(trial.n_squeezes? as f64)
});
/// Two ways are the same where their lengths differ by no more.
const SAME: Expected = Expected::Same(0.01);

pub(super) fn claims(runs: Runs, timings: &[Timing]) -> Claims {
    let against = |map: &str, others: &[&str], quantity, expected| -> Vec<Comparison> {
        let compare = |other: &&str| runs.compare(map, [PROPOSED, other], quantity, expected);
        others.iter().map(compare).collect()
    };
    let less =
        |map: &str, others: &[&str], quantity| against(map, others, quantity, Expected::Less);
    let same = |map: &str, others: &[&str]| against(map, others, &LENGTH, SAME);
    let both = [ZHANG, JOSHY];
    claims! {
        "Avoids the narrow aisles" | "sec. 4, fig. 6" | "-" => vec![unsqueezed(runs)];
        "The colony of reference 7 goes through the narrow aisles" | "sec. 4, fig. 6"
            | "-" => less("wang-aisles", &[ZHANG], &SQUEEZES);
        "Finds a shorter way than reference 11 where there are aisles" | "sec. 4, fig. 6"
            | "-" => less("wang-aisles", &[JOSHY], &LENGTH);
        "Without aisles all three find the same way" | "sec. 4, fig. 7(a)"
            | "-" => same("wang-open", &both);
        "Without aisles it converges first" | "sec. 4, fig. 7(b)"
            | "iteration 20 : 40 (reference 7), 30 (11)" => less("wang-open", &both, &CONVERGED);
        "On the third map it finds the same way as reference 11" | "sec. 4, fig. 8(a)"
            | "-" => same("aco20", &[JOSHY]);
        "On the third map it converges earlier than reference 11" | "sec. 4, fig. 8(b)"
            | "-" => less("aco20", &[JOSHY], &CONVERGED);
        "The analytical adjacency takes less time than the global one" | "Table 1, fig. 9"
            | "0.00088 : 0.0037 s at 20 x 20" => adjacency::comparisons(timings);
        "Takes the least time of those compared" | "sec. 5"
            | "-" => MAPS.map(|(map, _)| less(map, &both, &SEARCH)).concat();
    }
}

/// Runs whose way takes no step between two obstacles that meet at a corner.
fn unsqueezed(runs: Runs) -> Counted {
    let group = runs.group("wang-aisles", PROPOSED);
    let name = "wang-aisles, no step through an aisle".to_owned();
    group.counted(name, |trial| trial.n_squeezes == Some(0))
}

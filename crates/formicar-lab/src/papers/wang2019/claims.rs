//! The claims of the paper.

use super::adjacency::{self, Timing};
use super::{JOSHY, PROPOSED, ZHANG};
use crate::papers::Trial;
use crate::papers::claims::{Claim, Claims, Comparison, Counted, Expected};
use crate::papers::group::Quantity;
use crate::papers::trials::Runs;

const LENGTH: Quantity<Trial> = Quantity {
    name: "length, cells",
    n_decimals: 2,
    of: |trial| trial.length_cells,
};
const SQUEEZES: Quantity<Trial> = Quantity {
    name: "steps through narrow aisles",
    n_decimals: 0,
    of: |trial| Some(trial.n_squeezes? as f64),
};
const CONVERGED: Quantity<Trial> = Quantity {
    name: "iterations to within 1 % of its best",
    n_decimals: 0,
    of: |trial| Some(f64::from(trial.n_to_1_percent?)),
};
const TIME: Quantity<Trial> = Quantity {
    name: "search, ms",
    n_decimals: 1,
    of: |trial| Some(trial.search_ms),
};
/// Two ways are the same where their lengths differ by no more.
const SAME: Expected = Expected::Same(0.01);

pub(super) fn claims(runs: Runs, timings: &[Timing]) -> Claims {
    let against = |map: &str, other: &str, quantity, expected| {
        runs.compare(map, [PROPOSED, other], quantity, expected)
    };
    let both = |map: &str, quantity, expected| -> Vec<Comparison> {
        [ZHANG, JOSHY]
            .map(|other| against(map, other, quantity, expected))
            .to_vec()
    };
    let times = super::MAPS.iter();
    let times = times.flat_map(|(map, _)| both(map, &TIME, Expected::Less));
    Claims(vec![
        avoids_aisles(runs),
        Claim::paired(
            "The colony of reference 7 goes through the narrow aisles",
            "sec. 4, fig. 6",
            "-",
            vec![against("wang-aisles", ZHANG, &SQUEEZES, Expected::Less)],
        ),
        Claim::paired(
            "Finds a shorter way than reference 11 where there are aisles",
            "sec. 4, fig. 6",
            "-",
            vec![against("wang-aisles", JOSHY, &LENGTH, Expected::Less)],
        ),
        Claim::paired(
            "Without aisles all three find the same way",
            "sec. 4, fig. 7(a)",
            "-",
            both("wang-open", &LENGTH, SAME),
        ),
        Claim::paired(
            "Without aisles it converges first",
            "sec. 4, fig. 7(b)",
            "iteration 20 : 40 (reference 7), 30 (11)",
            both("wang-open", &CONVERGED, Expected::Less),
        ),
        Claim::paired(
            "On the third map it finds the same way as reference 11",
            "sec. 4, fig. 8(a)",
            "-",
            vec![against("aco20", JOSHY, &LENGTH, SAME)],
        ),
        Claim::paired(
            "On the third map it converges earlier than reference 11",
            "sec. 4, fig. 8(b)",
            "-",
            vec![against("aco20", JOSHY, &CONVERGED, Expected::Less)],
        ),
        adjacency::claim(timings),
        Claim::paired(
            "Takes the least time of those compared",
            "sec. 5",
            "-",
            times.collect(),
        ),
    ])
}

fn avoids_aisles(runs: Runs) -> Claim {
    Claim::counted(
        "Avoids the narrow aisles",
        "sec. 4, fig. 6",
        "-",
        vec![unsqueezed(runs)],
    )
}

/// Runs whose way takes no step between two obstacles that meet at a corner.
fn unsqueezed(runs: Runs) -> Counted {
    let group = runs.group("wang-aisles", PROPOSED);
    let name = "wang-aisles, no step through an aisle".to_owned();
    group.counted(name, |trial| trial.n_squeezes == Some(0))
}

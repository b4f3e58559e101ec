//! The claims of the paper.

use super::MAPS;
use super::variants::{CONSTANT, CONVENTIONAL, ELITE, FREE_TURNS, IMPROVED, OPEN, UNIFORM};
use crate::papers::Trial;
use crate::papers::claims::{Claim, Claims, Comparison, Counted, Expected};
use crate::papers::group::Quantity;
use crate::papers::trials::Runs;

const LENGTH: Quantity<Trial> = Quantity {
    name: "length, cells",
    n_decimals: 1,
    of: |trial| trial.length_cells,
};
const SEARCH: Quantity<Trial> = Quantity {
    name: "search, ms",
    n_decimals: 1,
    of: |trial| Some(trial.search_ms),
};
const TURNS: Quantity<Trial> = Quantity {
    name: "turns",
    n_decimals: 0,
    of: |trial| Some(trial.n_turns? as f64),
};
const ARRIVED: Quantity<Trial> = Quantity {
    name: "ants that arrive, %",
    n_decimals: 1,
    of: |trial| Some(100.0 * trial.arrived_share),
};
const EARLY: Quantity<Trial> = Quantity {
    name: "length after a tenth of the run, cells",
    n_decimals: 1,
    of: |trial| trial.early_length_cells,
};
const CONVERGED: Quantity<Trial> = Quantity {
    name: "iterations to within 1 % of its best",
    n_decimals: 0,
    of: |trial| Some(f64::from(trial.n_to_1_percent?)),
};
const SPREAD: Quantity<Trial> = Quantity {
    name: "spread of best lengths, second half, cells",
    n_decimals: 2,
    of: |trial| trial.late_spread_cells,
};

/// The improved colony against another on all maps.
fn against(
    runs: Runs,
    other: &str,
    quantity: &Quantity<Trial>,
    expected: Expected,
) -> Vec<Comparison> {
    let compare = |map: &str| runs.compare(map, [IMPROVED, other], quantity, expected);
    MAPS.iter().map(|map| compare(map.name)).collect()
}

pub(super) fn claims(runs: Runs) -> Claims {
    let mut claims = of_table_1(runs);
    claims.extend(of_parts(runs));
    claims.extend(of_paths(runs));
    Claims(claims)
}

fn of_table_1(runs: Runs) -> Vec<Claim> {
    let less = |other: &str, quantity| against(runs, other, quantity, Expected::Less);
    vec![
        Claim::paired(
            "Finds shorter ways than the conventional colony",
            "Table 1",
            "37.9 : 78.2; 58.9 : 157.3; 98.2 : 216.9",
            less(CONVENTIONAL, &LENGTH),
        ),
        Claim::paired(
            "Finds shorter ways than the elite colony",
            "Table 1",
            "37.9 : 50.5; 58.9 : 87.4; 98.2 : 133.7",
            less(ELITE, &LENGTH),
        ),
        Claim::paired(
            "Searches for a shorter time than the conventional colony",
            "Table 1",
            "103 : 302 s; 964 : 2429 s; 1207 : 2653 s",
            less(CONVENTIONAL, &SEARCH),
        ),
        Claim::paired(
            "Searches for a shorter time than the elite colony",
            "Table 1",
            "103 : 269 s; 964 : 1581 s; 1207 : 1835 s",
            less(ELITE, &SEARCH),
        ),
        Claim::paired(
            "Converges in fewer iterations than the conventional colony",
            "sec. IV.B, fig. 11",
            "-",
            less(CONVENTIONAL, &CONVERGED),
        ),
    ]
}

fn of_parts(runs: Runs) -> Vec<Claim> {
    let less = |other: &str, quantity| against(runs, other, quantity, Expected::Less);
    let more = |other: &str, quantity| against(runs, other, quantity, Expected::More);
    vec![
        Claim::paired(
            "Closed U-shapes keep ants out of dead ends",
            "sec. II.C",
            "-",
            more(OPEN, &ARRIVED),
        ),
        Claim::paired(
            "The gradient of initial pheromone guides the early search",
            "sec. II.D, V",
            "-",
            less(UNIFORM, &EARLY),
        ),
        Claim::paired(
            "Changing evaporation leads to shorter ways than a constant one",
            "sec. II.E, V",
            "-",
            less(CONSTANT, &LENGTH),
        ),
        Claim::paired(
            "Changing evaporation keeps ants exploring in the middle and at the end",
            "sec. IV.B, fig. 11",
            "-",
            more(CONSTANT, &SPREAD),
        ),
        Claim::paired(
            "The improved colony still explores where the conventional one repeats itself",
            "sec. IV.B, fig. 11",
            "-",
            more(CONVENTIONAL, &SPREAD),
        ),
        Claim::paired(
            "A cost of turns leads to fewer turns",
            "sec. II.G, V",
            "-",
            less(FREE_TURNS, &TURNS),
        ),
    ]
}

fn of_paths(runs: Runs) -> Vec<Claim> {
    vec![
        Claim::paired(
            "Fewer turns than the conventional colony",
            "sec. IV, fig. 10",
            "-",
            against(runs, CONVENTIONAL, &TURNS, Expected::Less),
        ),
        Claim::paired(
            "Removing redundant nodes leaves fewer nodes",
            "sec. IV.A, fig. 9",
            "12 : 33",
            MAPS.iter().map(|map| nodes(runs, map.name)).collect(),
        ),
        Claim::counted(
            "The smoothed path can be driven without collision",
            "sec. IV.B, V",
            "-",
            MAPS.iter().map(|map| certified(runs, map.name)).collect(),
        ),
    ]
}

/// Nodes after and before, run by run.
fn nodes(runs: Runs, map: &str) -> Comparison {
    let nodes = |trial: &Trial| Some([trial.n_nodes_after? as f64, trial.n_nodes_before? as f64]);
    let runs = runs.of(map, IMPROVED);
    Comparison {
        name: format!("{map}, after - before"),
        quantity: "nodes".to_owned(),
        n_decimals: 0,
        pairs: runs.filter_map(|run| nodes(&run.trial)).collect(),
        expected: Expected::Less,
    }
}

fn certified(runs: Runs, map: &str) -> Counted {
    let group = runs.group(map, IMPROVED);
    group.counted(format!("{map}, certified"), |trial| trial.certified)
}

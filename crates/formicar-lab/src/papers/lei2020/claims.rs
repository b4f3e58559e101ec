//! The claims of the paper.

use super::variants::{CONSTANT, CONVENTIONAL, ELITE, FREE_TURNS, IMPROVED, MAPS, OPEN, UNIFORM};
use crate::papers::Trial;
use crate::papers::claims::{Claims, Comparison, Counted, Expected, claims};
use crate::papers::group::Quantity;
use crate::papers::trials::{CONVERGED, LENGTH, Runs, SEARCH};

const TURNS: Quantity<Trial> = Quantity::new("turns", 0, |trial| Some(trial.n_turns? as f64));
const ARRIVED: Quantity<Trial> = Quantity::new("ants that arrive, %", 1, |trial| {
    Some(100.0 * trial.arrived_share)
});
const EARLY: Quantity<Trial> =
    Quantity::new("length after a tenth of the run, cells", 1, |trial| {
        trial.early_length_cells
    });
const SPREAD: Quantity<Trial> =
    Quantity::new("spread of best lengths, second half, cells", 2, |trial| {
        trial.late_spread_cells
    });

pub(super) fn claims(runs: Runs) -> Claims {
    // The improved colony against another on all maps.
    let against = |other: &str, quantity: &Quantity<Trial>, expected| -> Vec<Comparison> {
        let maps = MAPS.iter();
        maps.map(|map| runs.compare(map.name, [IMPROVED, other], quantity, expected))
            .collect()
    };
    let less = |other: &str, quantity| against(other, quantity, Expected::Less);
    let more = |other: &str, quantity| against(other, quantity, Expected::More);
    claims! {
        "Finds shorter ways than the conventional colony" | "Table 1"
            | "37.9 : 78.2; 58.9 : 157.3; 98.2 : 216.9" => less(CONVENTIONAL, &LENGTH);
        "Finds shorter ways than the elite colony" | "Table 1"
            | "37.9 : 50.5; 58.9 : 87.4; 98.2 : 133.7" => less(ELITE, &LENGTH);
        "Searches for a shorter time than the conventional colony" | "Table 1"
            | "103 : 302 s; 964 : 2429 s; 1207 : 2653 s" => less(CONVENTIONAL, &SEARCH);
        "Searches for a shorter time than the elite colony" | "Table 1"
            | "103 : 269 s; 964 : 1581 s; 1207 : 1835 s" => less(ELITE, &SEARCH);
        "Converges in fewer iterations than the conventional colony" | "sec. IV.B, fig. 11"
            | "-" => less(CONVENTIONAL, &CONVERGED);
        "Closed U-shapes keep ants out of dead ends" | "sec. II.C"
            | "-" => more(OPEN, &ARRIVED);
        "The gradient of initial pheromone guides the early search" | "sec. II.D, V"
            | "-" => less(UNIFORM, &EARLY);
        "Changing evaporation leads to shorter ways than a constant one" | "sec. II.E, V"
            | "-" => less(CONSTANT, &LENGTH);
        "Changing evaporation keeps ants exploring in the middle and at the end"
            | "sec. IV.B, fig. 11" | "-" => more(CONSTANT, &SPREAD);
        "The improved colony still explores where the conventional one repeats itself"
            | "sec. IV.B, fig. 11" | "-" => more(CONVENTIONAL, &SPREAD);
        "A cost of turns leads to fewer turns" | "sec. II.G, V"
            | "-" => less(FREE_TURNS, &TURNS);
        "Fewer turns than the conventional colony" | "sec. IV, fig. 10"
            | "-" => less(CONVENTIONAL, &TURNS);
        "Removing redundant nodes leaves fewer nodes" | "sec. IV.A, fig. 9"
            | "12 : 33" => MAPS.map(|map| nodes(runs, map.name)).to_vec();
        "The smoothed path can be driven without collision" | "sec. IV.B, V"
            | "-" => MAPS.map(|map| certified(runs, map.name)).to_vec();
    }
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

//! Tables.

use super::{COLONIES, MAPS};
use crate::analysis::statistics::{quantile, quartiles};
use crate::papers::trial::Trial;
use crate::papers::trials::{Measure, Runs};
use crate::report::{Block, Field, Row, Section, Table};

/// Table 1 of the paper beside ours, and its ratios.
pub(super) fn table_1(runs: Runs) -> Section {
    let heading = [
        "map and colony",
        "paper's length",
        "length",
        "paper's length / improved",
        "ours",
        "paper's time s",
        "time s",
        "paper's time / improved",
        "ours, time",
    ];
    let caption = "Table 1 of the paper beside ours: lengths in cells, times of the search in \
                   seconds; medians with quartiles. Ratios are to the improved colony.";
    let mut table = Table::new("beside", &heading).captioned(caption);
    for map in &MAPS {
        let length: Measure = |trial| trial.length_cells;
        let time: Measure = |trial| Some(1e-3 * trial.search_ms);
        let over = |of: Measure, name: &str| {
            let improved = runs.median(map.name, COLONIES[2], of);
            let own = runs.median(map.name, name, of);
            Field::Number(own.zip(improved).map(|(a, b)| a / b), 2)
        };
        for (i, colony) in COLONIES.into_iter().enumerate() {
            let spread = |of: Measure, n: usize| {
                Field::Spread(quartiles(&runs.values(map.name, colony, of)), n)
            };
            let number = |value: f64, n: usize| Field::Number(Some(value), n);
            table.row(vec![
                Field::Words(format!("{}, {colony}", map.name)),
                number(map.lengths[i], 1),
                spread(length, 1),
                number(map.lengths[i] / map.lengths[2], 2),
                over(length, colony),
                number(map.times_s[i], 0),
                spread(time, 3),
                number(map.times_s[i] / map.times_s[2], 2),
                over(time, colony),
            ]);
        }
    }
    Section {
        heading: "Table 1: length and time".to_owned(),
        blocks: vec![Block::Table(table)],
    }
}

/// All variants of a map.
pub(super) fn ablation(map: &str, runs: Runs) -> Table {
    let mut table = Table::new(
        map,
        &[
            "variant",
            "arrived",
            "certified",
            "length",
            "/ optimum",
            "turns",
            "nodes before",
            "after",
            "to best",
            "ms",
        ],
    );
    for name in runs.variants(map) {
        table.row(row(name, &runs.trials(map, name)));
    }
    table
}

fn row(name: &str, trials: &[&Trial]) -> Row {
    let values = |of: Measure| -> Vec<f64> { trials.iter().filter_map(|t| of(t)).collect() };
    let count = |is: fn(&Trial) -> bool| trials.iter().filter(|trial| is(trial)).count();
    let number = |of: Measure, n| Field::Number(quantile(&values(of), 0.5), n);
    vec![
        Field::words(name),
        Field::Rate(count(|trial| trial.arrived), trials.len()),
        Field::Rate(count(|trial| trial.certified), trials.len()),
        Field::Spread(quartiles(&values(|trial| trial.length_cells)), 1),
        number(|t| Some(t.length_cells? / t.optimum_cells?), 3),
        number(|trial| Some(trial.n_turns? as f64), 0),
        number(|trial| Some(trial.n_nodes_before? as f64), 0),
        number(|trial| Some(trial.n_nodes_after? as f64), 0),
        number(|trial| Some(f64::from(trial.n_to_best?)), 0),
        number(|trial| Some(trial.query_ms), 1),
    ]
}

//! Table 1 of the paper, and the variants of each map.

use super::variants::{COLONIES, MAPS};
use crate::papers::group::{Column, ratio, table_of};
use crate::papers::trial::Trial;
use crate::papers::trials::{Measure, Runs};
use crate::report::{Field, Section, Table};

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
        let improved = runs.group(map.name, COLONIES[2]);
        for (i, colony) in COLONIES.into_iter().enumerate() {
            let own = runs.group(map.name, colony);
            let over = |of: Measure| Field::Number(ratio(own.median(of), improved.median(of)), 2);
            let number = |value: f64, n: usize| Field::Number(Some(value), n);
            table.row(vec![
                Field::Words(format!("{}, {colony}", map.name)),
                number(map.lengths[i], 1),
                own.spread(length, 1),
                number(map.lengths[i] / map.lengths[2], 2),
                over(length),
                number(map.times_s[i], 0),
                own.spread(time, 3),
                number(map.times_s[i] / map.times_s[2], 2),
                over(time),
            ]);
        }
    }
    Section::of_table("Table 1: length and time", table)
}

/// All variants of a map.
pub(super) fn ablation(map: &str, runs: Runs) -> Table {
    let columns: [Column<Trial>; 9] = [
        ("arrived", &|g, _| g.rate(|trial| trial.arrived)),
        ("certified", &|g, _| g.rate(|trial| trial.certified)),
        ("length", &|g, _| g.spread(|trial| trial.length_cells, 1)),
        ("/ optimum", &|g, _| {
            g.number(|t| Some(t.length_cells? / t.optimum_cells?), 3)
        }),
        ("turns", &|g, _| {
            g.number(|trial| Some(trial.n_turns? as f64), 0)
        }),
        ("nodes before", &|g, _| {
            g.number(|trial| Some(trial.n_nodes_before? as f64), 0)
        }),
        ("after", &|g, _| {
            g.number(|trial| Some(trial.n_nodes_after? as f64), 0)
        }),
        ("to best", &|g, _| {
            g.number(|trial| Some(f64::from(trial.n_to_best?)), 0)
        }),
        ("ms", &|g, _| g.number(|trial| Some(trial.query_ms), 1)),
    ];
    table_of(map, "variant", &columns, runs.groups(map))
}

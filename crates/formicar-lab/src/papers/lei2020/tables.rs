//! Table 1 of the paper, and the variants of each map.

use super::variants::{COLONIES, MAPS, Map};
use crate::papers::group::{GroupColumn, ratio, table_of};
use crate::papers::trial::Trial;
use crate::papers::trials::{Measure, Runs};
use crate::report::{Column, Field, Section, Table};

/// Table 1 of the paper beside ours, and its ratios.
pub(super) fn table_1(runs: Runs) -> Section {
    let caption = "Table 1 of the paper beside ours: lengths in cells, times of the search in \
                   seconds; medians with quartiles. Ratios are to the improved colony.";
    let rows = MAPS
        .iter()
        .flat_map(|map| (0..COLONIES.len()).map(move |i| (map, i)));
    let length: Measure = |trial| trial.length_cells;
    let time: Measure = |trial| Some(1e-3 * trial.search_ms);
    let own = |(map, i): &(&Map, usize)| runs.group(map.name, COLONIES[*i]);
    let over = |at: &(&Map, usize), of: Measure| {
        let improved = runs.group(at.0.name, COLONIES[2]);
        Field::Number(ratio(own(at).median(of), improved.median(of)), 2)
    };
    let number = |value: f64, n: usize| Field::Number(Some(value), n);
    let columns: [Column<(&Map, usize)>; 9] = [
        ("map and colony", &|&(map, i)| {
            Field::Words(format!("{}, {}", map.name, COLONIES[i]))
        }),
        ("paper's length", &|&(map, i)| number(map.lengths[i], 1)),
        ("length", &|at| own(at).spread(length, 1)),
        ("paper's length / improved", &|&(map, i)| {
            number(map.lengths[i] / map.lengths[2], 2)
        }),
        ("ours", &|at| over(at, length)),
        ("paper's time s", &|&(map, i)| number(map.times_s[i], 0)),
        ("time s", &|at| own(at).spread(time, 3)),
        ("paper's time / improved", &|&(map, i)| {
            number(map.times_s[i] / map.times_s[2], 2)
        }),
        ("ours, time", &|at| over(at, time)),
    ];
    let table = Table::of("beside", rows, &columns).captioned(caption);
    Section::of_table("Table 1: length and time", table)
}

/// All variants of a map.
pub(super) fn ablation(map: &str, runs: Runs) -> Table {
    let columns: [GroupColumn<Trial>; 9] = [
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

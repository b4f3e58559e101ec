//! Both calculations of the adjacency, timed: Table 1 and figure 9.

use crate::analysis::statistics::quartiles;
use crate::papers::claims::{Comparison, Expected};
use crate::papers::experiment::Scale;
use crate::report::{Block, Column, Field, Section, Table, Trend, TrendPanel, Trends};
use crate::run::measure;
use anyhow::Result;
use formicar::colony::Adjacency;
use formicar::map::generate::{ScatterParameters, scattered_obstacles};
use formicar::map::{BitGrid, DiagonalRule, MoveMasks};
use formicar::numeric::Seed;
use formicar::render::AxisScale;
use std::hint::black_box;

/// Sides of the maps on which adjacencies are timed, as in figure 9.
const SIDES: [usize; 6] = [10, 20, 30, 40, 60, 80];
/// The side in Table 1.
const SIDE: usize = 20;
/// Means of Table 1, milliseconds: global and analytical.
const PAPER_MS: [f64; 2] = [3.7, 0.877_34];

/// Times on one map, milliseconds.
pub(super) struct Timing {
    side: usize,
    global: Vec<f64>,
    analytical: Vec<f64>,
    masks: Vec<f64>,
}

/// Times both calculations, and the move masks that are used instead, on maps of all sizes.
pub(super) fn time_all(scale: Scale) -> Result<Vec<Timing>> {
    let rule = DiagonalRule::AtMostOneObstacle;
    let of_side = |&side: &usize| {
        let blocked = scattered(side)?;
        Ok(Timing {
            side,
            global: times_ms(scale, || drop(black_box(Adjacency::global(&blocked, rule)))),
            analytical: times_ms(scale, || {
                drop(black_box(Adjacency::analytical(&blocked, rule)));
            }),
            masks: times_ms(scale, || drop(black_box(MoveMasks::new(&blocked, rule)))),
        })
    };
    SIDES.iter().map(of_side).collect()
}

/// A square map with about a fifth of its cells occupied.
fn scattered(side: usize) -> Result<BitGrid> {
    let parameters = ScatterParameters {
        n_cols: side,
        n_rows: side,
        density: 0.2,
        ..ScatterParameters::default()
    };
    Ok(scattered_obstacles(&parameters, Seed(1))?.lethal_cells())
}

/// Times after one that is not counted.
fn times_ms(scale: Scale, mut work: impl FnMut()) -> Vec<f64> {
    work();
    let time = |_| 1e3 * measure(&mut (), |_| work()).query_s;
    (0..scale.n_timings).map(time).collect()
}

/// Table 1 and figure 9.
pub(super) fn section(timings: &[Timing]) -> Section {
    let blocks = vec![Block::Table(table(timings)), Block::Trends(figure(timings))];
    Section::new("Adjacency: Table 1 and figure 9", blocks)
}

fn table(timings: &[Timing]) -> Table {
    let caption = "Table 1 of the paper, a map of 20 x 20, beside ours, and further sizes of \
                   figure 9: milliseconds, medians with quartiles of repeated calculations. The \
                   global calculation looks at all pairs of cells, the analytical one at neighbors. \
                   `move masks` are what the colonies here use instead.";
    let of_paper = |timing: &Timing, value: f64, n_decimals| {
        Field::Number((timing.side == SIDE).then_some(value), n_decimals)
    };
    let ratio = |timing: &Timing| {
        let medians = quartiles(&timing.global).zip(quartiles(&timing.analytical));
        medians.map(|(global, analytical)| global[1] / analytical[1])
    };
    let [global_ms, analytical_ms] = PAPER_MS;
    let columns: [Column<&Timing>; 8] = [
        ("map", &|t| Field::Words(format!("{0} x {0}", t.side))),
        ("global ms", &|t| Field::Spread(quartiles(&t.global), 4)),
        ("paper's ms", &|t| of_paper(t, global_ms, 4)),
        ("analytical ms", &|t| {
            Field::Spread(quartiles(&t.analytical), 4)
        }),
        ("paper's, ms", &|t| of_paper(t, analytical_ms, 4)),
        ("ratio", &|t| Field::Number(ratio(t), 1)),
        ("paper's ratio", &|t| {
            of_paper(t, global_ms / analytical_ms, 1)
        }),
        ("move masks ms", &|t| Field::Spread(quartiles(&t.masks), 5)),
    ];
    Table::of("adjacency", timings, &columns).captioned(caption)
}

/// Figure 9.
fn figure(timings: &[Timing]) -> Trends {
    let trend = |name: &str, of: fn(&Timing) -> &Vec<f64>| Trend {
        name: name.to_owned(),
        points: timings
            .iter()
            .filter_map(|timing| {
                let [low, median, high] = quartiles(of(timing))?;
                Some([(timing.side * timing.side) as f64, low, median, high])
            })
            .collect(),
    };
    Trends {
        caption: "Figure 9: time of both calculations over the size of the map, both axes \
                  logarithmic, so that the slope is the exponent: about 2 for all pairs of cells, 1 \
                  for neighbors."
            .to_owned(),
        quantity: "time, ms".to_owned(),
        y_scale: AxisScale::Log,
        panels: vec![TrendPanel {
            x: "cells".to_owned(),
            x_scale: AxisScale::Log,
            trends: vec![
                trend("global", |timing| &timing.global),
                trend("analytical", |timing| &timing.analytical),
                trend("move masks", |timing| &timing.masks),
            ],
        }],
    }
}

/// Both calculations, side by side on each map.
pub(super) fn comparisons(timings: &[Timing]) -> Vec<Comparison> {
    let compare = |timing: &Timing| Comparison {
        name: format!("{0} x {0}, analytical - global", timing.side),
        quantity: "time, ms".to_owned(),
        n_decimals: 4,
        pairs: timing
            .analytical
            .iter()
            .zip(&timing.global)
            .map(|(&analytical, &global)| [analytical, global])
            .collect(),
        expected: Expected::Less,
    };
    timings.iter().map(compare).collect()
}

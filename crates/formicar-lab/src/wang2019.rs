//! Wang et al. 2019: narrow aisles, convergence, and the cost of the adjacency.

use crate::experiment::{Ground, Scale, Setup, Variant, run_all};
use crate::report::{Field, Report, Section, Table};
use crate::reproduction::Reproduction;
use crate::statistics::{quantile, quartiles};
use crate::trial::Trial;
use anyhow::Result;
use formicar::colony::Adjacency;
use formicar::colony::heuristic::{Guidance, StepLength, Visibility};
use formicar::layers::Expansion;
use formicar::map::generate::{ScatterParameters, scattered_obstacles};
use formicar::map::{BitGrid, DiagonalRule, MoveMasks};
use formicar::numeric::Seed;
use formicar::planner::{PlannerConfig, PlannerName};
use std::hint::black_box;
use std::time::Instant;

const MAPS: [&str; 3] = ["wang-aisles", "wang-open", "aco20"];

/// Sides of the maps on which adjacencies are timed, as in figure 9.
const SIDES: [usize; 6] = [10, 20, 30, 40, 60, 80];

/// Runs the colony and those it is compared with, and times both calculations of the adjacency.
///
/// # Errors
/// None that is expected: maps and configurations are built in.
pub fn wang2019(setup: &Setup, tell: &mut dyn FnMut(&str)) -> Result<Reproduction> {
    let grounds = MAPS.map(Ground::builtin);
    let grounds = grounds.into_iter().collect::<Result<Vec<_>>>()?;
    let trials = run_all(&grounds, |_| variants(), setup.scale, tell)?;
    tell("adjacency timing");
    let timing = adjacency_table(setup.scale)?;
    let report = report(&trials, timing);
    Reproduction::of_trials(report, &trials, (&grounds, |_| variants()), setup.scale)
}

fn variants() -> Vec<Variant> {
    let changed = |planner: PlannerName, what: &str, change: fn(&mut PlannerConfig)| {
        Variant::changed(planner, what, change)
    };
    vec![
        Variant::of(PlannerName::Wang2019),
        Variant::of(PlannerName::Zhang2016),
        changed(PlannerName::Zhang2016, "obstacles grown by 1", |c| {
            c.layers.expansion = Expansion::Cells(1);
        }),
        Variant::of(PlannerName::Joshy2016),
        changed(PlannerName::Wang2019, "without goal guidance", |c| {
            c.colony.guidance = Guidance::None;
        }),
        changed(PlannerName::Wang2019, "visibility to the letter", |c| {
            c.colony.visibility = Visibility::StepLength(StepLength { beta: 7.0 });
        }),
        changed(PlannerName::Wang2019, "no corner cut", |c| {
            c.colony.diagonal_rule = DiagonalRule::NoObstacles;
        }),
    ]
}

fn report(trials: &[Trial], timing: Table) -> Report {
    let maps = MAPS.map(|map| Section::of_table(map, table(map, trials)));
    let timing = Section::of_table("Adjacency: Table 1 and figure 9", timing);
    Report {
        name: "wang2019".to_owned(),
        title: "Wang et al. 2019: aisles, convergence, adjacency".to_owned(),
        intro: "Lengths in cells, a diagonal step counting the square root of 2; medians with \
                quartiles. `squeezes` are diagonal steps between two obstacles that meet at a \
                corner: runs with any. `to best` is the iteration that found the best way, `to 1 \
                %` the one that found a way at most 1 % dearer."
            .to_owned(),
        sections: maps.into_iter().chain([timing]).collect(),
    }
}

fn table(map: &str, trials: &[Trial]) -> Table {
    let mut table = Table::new(
        map,
        &[
            "variant",
            "arrived",
            "squeezes",
            "length",
            "/ optimum",
            "to best",
            "to 1 %",
            "ms",
        ],
    );
    for variant in variants() {
        let belongs = |trial: &&Trial| trial.map == map && trial.variant == variant.name;
        let own: Vec<&Trial> = trials.iter().filter(belongs).collect();
        let values = |of: fn(&Trial) -> Option<f64>| -> Vec<f64> {
            own.iter().filter_map(|trial| of(trial)).collect()
        };
        let number =
            |of: fn(&Trial) -> Option<f64>, n| Field::Number(quantile(&values(of), 0.5), n);
        let count = |is: fn(&Trial) -> bool| own.iter().filter(|trial| is(trial)).count();
        let n_squeezing = count(|t| t.n_squeezes.is_some_and(|n| n > 0));
        table.row(vec![
            Field::words(&variant.name),
            Field::Count(count(|trial| trial.arrived), own.len()),
            Field::Number(Some(n_squeezing as f64), 0),
            Field::Spread(quartiles(&values(|trial| trial.length_cells)), 1),
            number(|t| Some(t.length_cells? / t.optimum_cells?), 3),
            number(|trial| Some(f64::from(trial.n_to_best?)), 0),
            number(|trial| Some(f64::from(trial.n_to_1_percent?)), 0),
            number(|trial| Some(trial.query_ms), 1),
        ]);
    }
    table
}

/// Median times of the adjacency by both calculations, and of the move masks in use.
fn adjacency_table(scale: Scale) -> Result<Table> {
    let mut table = Table::new(
        "adjacency",
        &[
            "map",
            "global, ms",
            "analytical, ms",
            "ratio",
            "paper's ratio",
            "move masks, ms",
        ],
    );
    for side in SIDES {
        let blocked = scattered(side)?;
        let rule = DiagonalRule::AtMostOneObstacle;
        let [global, analytical, masks] = [
            median_ms(scale, || drop(black_box(Adjacency::global(&blocked, rule)))),
            median_ms(scale, || {
                drop(black_box(Adjacency::analytical(&blocked, rule)));
            }),
            median_ms(scale, || drop(black_box(MoveMasks::new(&blocked, rule)))),
        ];
        // Table 1: 0.0037 s and 0.00087734 s on average.
        let paper = (side == 20).then_some(0.0037 / 8.7734e-4);
        table.row(vec![
            Field::Words(format!("{side} x {side}")),
            Field::Number(Some(global), 4),
            Field::Number(Some(analytical), 4),
            Field::Number(Some(global / analytical), 1),
            Field::Number(paper, 1),
            Field::Number(Some(masks), 5),
        ]);
    }
    Ok(table)
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

fn median_ms(scale: Scale, mut work: impl FnMut()) -> f64 {
    let times: Vec<f64> = (0..scale.n_timings)
        .map(|_| {
            let begun = Instant::now();
            work();
            begun.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    quantile(&times, 0.5).unwrap_or_default()
}

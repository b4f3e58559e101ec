//! Lei & Zheng 2020: what each part of the method brings, on three maps.

use crate::experiment::{Ground, Setup, Variant, run_all};
use crate::report::{Field, Report, Row, Section, Table};
use crate::reproduction::Reproduction;
use crate::statistics::{quantile, quartiles};
use crate::trial::Trial;
use anyhow::Result;
use formicar::colony::evaporation::{Constant, Evaporation};
use formicar::colony::initial::{InitialPheromone, PheromoneUnit, Uniform};
use formicar::colony::transition::Transition;
use formicar::layers::UShapes;
use formicar::planner::{PlannerConfig, PlannerName};
use formicar::smoothing::{Corners, RedundantNodes};

/// The maps with the lengths that the paper gives in its Table 1 for maps of the same sizes of its
/// own: conventional, elite, improved.
const MAPS: [(&str, [f64; 3]); 3] = [
    ("lei-map1", [78.2, 50.5, 37.9]),
    ("lei-map2", [157.3, 87.4, 58.9]),
    ("lei-map3", [216.9, 133.7, 98.2]),
];

/// The three colonies of the paper's Table 1.
const COLONIES: [PlannerName; 3] = [
    PlannerName::AntSystem,
    PlannerName::Elitist,
    PlannerName::Lei2020,
];

/// Runs conventional, elitist and improved colonies, and the improved one less each of its parts.
///
/// # Errors
/// None that is expected: maps and configurations are built in.
pub fn lei2020(setup: &Setup, tell: &mut dyn FnMut(&str)) -> Result<Reproduction> {
    let grounds = MAPS.map(|(map, _)| Ground::builtin(map));
    let grounds = grounds.into_iter().collect::<Result<Vec<_>>>()?;
    let trials = run_all(&grounds, variants, setup.scale, tell)?;
    Reproduction::of_trials(report(&trials), &trials, (&grounds, variants), setup.scale)
}

/// All variants, of the size that the paper uses on a map.
fn variants(ground: &Ground) -> Vec<Variant> {
    let improved = |what: &str, change: fn(&mut PlannerConfig)| {
        Variant::changed(PlannerName::Lei2020, what, change)
    };
    let closed = |planner: PlannerName| {
        Variant::changed(planner, "U-shapes closed", |c| {
            c.layers.u_shapes = UShapes::Close;
        })
    };
    let mut variants = vec![
        Variant::of(PlannerName::AntSystem),
        closed(PlannerName::AntSystem),
        Variant::of(PlannerName::Elitist),
        closed(PlannerName::Elitist),
        closed(PlannerName::MaxMin),
        Variant::of(PlannerName::Lei2020),
        improved("U-shapes open", |c| c.layers.u_shapes = UShapes::Keep),
        improved("uniform pheromone", |c| {
            c.colony.initial = InitialPheromone::Uniform(Uniform {
                tau: 1.0,
                unit: PheromoneUnit::Deposit,
            });
        }),
        improved("constant evaporation", |c| {
            c.colony.evaporation = Evaporation::Constant(Constant { rho: 0.5 });
        }),
        improved("one class of steps", |c| {
            c.colony.transition = Transition::Roulette;
        }),
        improved("turns cost nothing", |c| c.colony.cost.turn_weight = 0.0),
        improved("redundant nodes kept", |c| {
            c.smoothing.redundant_nodes = RedundantNodes::Collinear;
        }),
        improved("2-turning alone", |c| {
            c.smoothing.corners = Corners::TwoTurning;
        }),
        improved("evaporation stretched to N/20", |c| stretch(c, 20.0)),
        improved("stopped after 5 idle iterations", |c| {
            c.colony.stopping.stall_iterations = 5;
        }),
    ];
    if ground.map != "lei-map1" {
        for variant in &mut variants {
            // Sec. IV.B: the size for maps 2 and 3.
            variant.config.colony.n_ants = 1000;
            variant.config.colony.n_iterations = 200;
            if variant.name.contains("stretched") {
                stretch(&mut variant.config, 20.0);
            }
        }
    }
    variants
}

/// Stretches the evaporation so that a run is as long as `k_last` units of k.
fn stretch(config: &mut PlannerConfig, k_last: f64) {
    if let Evaporation::Poisson(poisson) = &mut config.colony.evaporation {
        poisson.stretch = f64::from(config.colony.n_iterations) / k_last;
    }
}

fn report(trials: &[Trial]) -> Report {
    let maps = MAPS.map(|(map, _)| Section::of_table(map, table(map, trials)));
    let beside = Section::of_table("Table 1 of the paper beside ours", beside(trials));
    Report {
        name: "lei2020".to_owned(),
        title: "Lei & Zheng 2020: what each part brings".to_owned(),
        intro: "Lengths of the ants' way in cells; medians with quartiles. `optimum` is the \
                shortest way under the same layers and moves. `certified` counts smoothed paths, \
                free headings, with a certificate of the whole swept body. `to best` is the \
                iteration that found the best way. Times are those of whole queries on one thread."
            .to_owned(),
        sections: maps.into_iter().chain([beside]).collect(),
    }
}

fn of<'a>(trials: &'a [Trial], map: &str, variant: &str) -> Vec<&'a Trial> {
    let belongs = |trial: &&Trial| trial.map == map && trial.variant == variant;
    trials.iter().filter(belongs).collect()
}

/// The values of some runs that have one.
fn values(trials: &[&Trial], of: impl Fn(&Trial) -> Option<f64>) -> Vec<f64> {
    trials.iter().filter_map(|trial| of(trial)).collect()
}

fn table(map: &str, trials: &[Trial]) -> Table {
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
    let mut names: Vec<&str> = Vec::new();
    for trial in trials.iter().filter(|trial| trial.map == map) {
        if !names.contains(&trial.variant.as_str()) {
            names.push(&trial.variant);
        }
    }
    for name in names {
        table.row(row(name, &of(trials, map, name)));
    }
    table
}

fn row(name: &str, trials: &[&Trial]) -> Row {
    let median = |of: fn(&Trial) -> Option<f64>| quantile(&values(trials, of), 0.5);
    let count = |is: fn(&Trial) -> bool| trials.iter().filter(|trial| is(trial)).count();
    let number = |of: fn(&Trial) -> Option<f64>, n| Field::Number(median(of), n);
    vec![
        Field::words(name),
        Field::Rate(count(|trial| trial.arrived), trials.len()),
        Field::Rate(count(|trial| trial.certified), trials.len()),
        Field::Spread(quartiles(&values(trials, |trial| trial.length_cells)), 1),
        number(|t| Some(t.length_cells? / t.optimum_cells?), 3),
        number(|trial| Some(trial.n_turns? as f64), 0),
        number(|trial| Some(trial.n_nodes_before? as f64), 0),
        number(|trial| Some(trial.n_nodes_after? as f64), 0),
        number(|trial| Some(f64::from(trial.n_to_best?)), 0),
        number(|trial| Some(trial.query_ms), 1),
    ]
}

/// Lengths of the paper and ours, on maps of the same sizes, as ratios to the improved colony's.
fn beside(trials: &[Trial]) -> Table {
    let mut table = Table::new(
        "beside",
        &[
            "map",
            "conventional / improved, paper",
            "ours",
            "elite / improved, paper",
            "ours",
        ],
    );
    for (map, paper) in MAPS {
        let ours = COLONIES.map(|planner| {
            let trials = of(trials, map, planner.name());
            quantile(&values(&trials, |trial| trial.length_cells), 0.5)
        });
        let ratio = |i: usize| Field::Number(ours[i].zip(ours[2]).map(|(a, b)| a / b), 2);
        let stated = |i: usize| Field::Number(Some(paper[i] / paper[2]), 2);
        table.row(vec![
            Field::words(map),
            stated(0),
            ratio(0),
            stated(1),
            ratio(1),
        ]);
    }
    table
}

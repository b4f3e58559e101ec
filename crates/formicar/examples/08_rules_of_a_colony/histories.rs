//! What rules do over the iterations of a run.

use crate::{Outcome, ground, send};
use formicar::colony::dead_end::{DeadEnd, Retreat};
use formicar::colony::deposit::{AllAnts, BestAnt, BestWorst, Deposit, Elitist, Fittest};
use formicar::colony::evaporation::{Adaptive, Constant, Evaporation, PoissonEvaporation};
use formicar::colony::limits::{Floor, MaxMin, PheromoneLimits};
use formicar::colony::{ColonyConfig, ColonyProblem, presets};
use formicar::geometry::Point2;
use formicar::progress::IterationRecord;
use formicar::render::{Axis, Chart, Dash, Picture, SERIES_COLORS, Series, palette};

/// How many ants arrive on a map with long walls, by what they do in dead ends.
pub(crate) fn dead_ends() -> Outcome<Picture> {
    let (_, problem) = ground("lei-map3", 1)?;
    let retreat = |max_steps| DeadEnd::Retreat(Retreat { max_steps });
    let mut series = Vec::new();
    for (name, rule) in [
        ("die", DeadEnd::Die),
        ("retreat, max_steps = 10", retreat(10)),
        ("retreat, max_steps = 100", retreat(100)),
        ("retreat, max_steps = 1000", retreat(1000)),
    ] {
        let config = ColonyConfig {
            dead_end: rule,
            ..presets::ant_system()
        };
        let share = |r: &IterationRecord| 100.0 * f64::from(r.n_arrived) / f64::from(r.n_ants);
        series.push((name, over_iterations(&problem, &config, share)?));
    }
    let caption = "Ant System on lei-map3, obstacles grown by one cell, 500 ants";
    Ok(charts(
        "Ants that arrive",
        caption,
        vec![chart("ants that arrive, %", series)],
    ))
}

/// The evaporated share over a run of 150 iterations.
pub(crate) fn evaporation() -> Picture {
    let poisson = |stretch| {
        Evaporation::Poisson(PoissonEvaporation {
            stretch,
            ..PoissonEvaporation::default()
        })
    };
    let rules = [
        ("constant", Evaporation::Constant(Constant::default())),
        ("poisson, stretch = 1", poisson(1.0)),
        ("poisson, stretch = N / 20", poisson(150.0 / 20.0)),
        (
            "adaptive, nothing better found",
            Evaporation::Adaptive(Adaptive::default()),
        ),
    ];
    let series = rules.into_iter().map(|(name, rule)| {
        let rho = |i| Point2::new(f64::from(i + 1), rule.rho(i, 150, i));
        (name, (0..150).map(rho).collect())
    });
    charts(
        "What evaporates after each iteration",
        "150 iterations; every rule with its defaults but for what is named",
        vec![chart("rho", series.collect())],
    )
}

/// Who deposits: how fast ants agree, and how much pheromone piles up.
pub(crate) fn deposit() -> Outcome<Picture> {
    let (_, problem) = ground("lei-map1", 1)?;
    let (mut costs, mut most) = (Vec::new(), Vec::new());
    for (name, rule) in [
        ("all-ants", Deposit::AllAnts(AllAnts::default())),
        ("elitist", Deposit::Elitist(Elitist::default())),
        ("fittest", Deposit::Fittest(Fittest::default())),
        ("best-ant", Deposit::BestAnt(BestAnt::default())),
        ("best-worst", Deposit::BestWorst(BestWorst::default())),
    ] {
        let config = ColonyConfig {
            deposit: rule,
            limits: PheromoneLimits::Floor(Floor::default()),
            ..presets::ant_system()
        };
        let mean = |record: &IterationRecord| record.mean_cost.unwrap_or(f64::NAN);
        costs.push((name, over_iterations(&problem, &config, mean)?));
        let most_pheromone = |record: &IterationRecord| record.max_pheromone;
        most.push((
            name,
            relative_log(over_iterations(&problem, &config, most_pheromone)?),
        ));
    }
    let caption = "Ant System on lei-map1 with each rule's defaults and a floor of 0.001";
    let charts_of = vec![
        chart("mean cost of ants that arrive", costs),
        chart("log10 of most pheromone / that of iteration 1", most),
    ];
    Ok(charts("Who deposits", caption, charts_of))
}

/// The most (solid) and the least (dashed) pheromone under limits.
pub(crate) fn limits() -> Outcome<Picture> {
    let (_, problem) = ground("lei-map1", 1)?;
    let mut series = Vec::new();
    for (name, color, rule) in [
        ("none", SERIES_COLORS[1], PheromoneLimits::None),
        (
            "floor",
            SERIES_COLORS[2],
            PheromoneLimits::Floor(Floor::default()),
        ),
        (
            "max-min",
            SERIES_COLORS[0],
            PheromoneLimits::MaxMin(MaxMin::default()),
        ),
    ] {
        let config = ColonyConfig {
            limits: rule,
            ..presets::max_min()
        };
        let log = |value: f64| value.max(f64::MIN_POSITIVE).log10();
        let high = over_iterations(&problem, &config, |r| log(r.max_pheromone))?;
        let low = over_iterations(&problem, &config, |r| log(r.min_pheromone))?;
        series.push(Series::new(&format!("{name}: most"), high, color));
        series.push(Series {
            dash: Dash::Dashed,
            ..Series::new(&format!("{name}: least"), low, color)
        });
    }
    let chart = Chart {
        series,
        ..chart("log10 of pheromone", Vec::new())
    };
    let caption = "MAX-MIN Ant System on lei-map1 with its limits, a floor of 0.001, and none";
    Ok(charts(
        "Between which limits pheromone lies",
        caption,
        vec![chart],
    ))
}

fn over_iterations(
    problem: &ColonyProblem,
    config: &ColonyConfig,
    value: impl Fn(&IterationRecord) -> f64,
) -> Outcome<Vec<Point2>> {
    let history = send(problem, config)?.history.iterations;
    let point = |r: &IterationRecord| Point2::new(f64::from(r.iteration + 1), value(r));
    Ok(history.iter().map(point).collect())
}

/// Logarithms of values relative to the first.
fn relative_log(points: Vec<Point2>) -> Vec<Point2> {
    let first = points.first().map_or(1.0, |point| point.y);
    let log = |p: Point2| Point2::new(p.x, (p.y / first).log10());
    points.into_iter().map(log).collect()
}

/// A chart over iterations.
fn chart(quantity: &str, lines: Vec<(&str, Vec<Point2>)>) -> Chart {
    let dashes = [
        Dash::Solid,
        Dash::Dashed,
        Dash::Solid,
        Dash::Dashed,
        Dash::Dotted,
    ];
    let colors = SERIES_COLORS.into_iter().chain([palette::INK]);
    let looks = colors.zip(dashes);
    let line = |((label, points), (color, dash)): ((&str, _), _)| Series {
        dash,
        ..Series::new(label, points, color)
    };
    Chart {
        x: Axis::named("iteration"),
        y: Axis::named(quantity),
        series: lines.into_iter().zip(looks).map(line).collect(),
        height_px: 260.0,
        ..Chart::default()
    }
}

fn charts(title: &str, caption: &str, charts: Vec<Chart>) -> Picture {
    Picture {
        title: title.to_owned(),
        caption: caption.to_owned(),
        charts,
        ..Picture::default()
    }
}

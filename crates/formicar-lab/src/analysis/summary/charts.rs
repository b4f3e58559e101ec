//! Runs of stores as charts: how values are spread, how pairs differ, how paths get better.

use crate::analysis::compare::{METRICS, Metric, planners, runs_of};
use crate::report::{
    Block, BoxGroup, BoxPlot, PairedPanel, PairedPlot, Section, Trend, TrendPanel, Trends,
};
use crate::run::{Improvement, Run};
use formicar::render::AxisScale;
use std::collections::BTreeMap;

/// Metrics that are drawn as they are, on a logarithmic axis.
const TIMES: [&str; 2] = ["first path ms", "query ms"];
/// Metrics that depend on how far apart the ends are: drawn over the least of their scenario.
const EXTENTS: [&str; 2] = ["length m", "cost m"];
/// Metrics that are drawn as they are.
const PLAIN: [&str; 1] = ["clearance m"];

fn metrics<'a>(names: &'a [&str]) -> impl Iterator<Item = &'static Metric> + 'a {
    METRICS.iter().filter(|metric| names.contains(&metric.name))
}

/// The least value of a metric in each place, whoever reached it.
fn least<'a>(runs: &'a [Run], metric: &Metric) -> BTreeMap<[&'a str; 3], f64> {
    let mut least = BTreeMap::new();
    for run in runs {
        if let Some(value) = metric.of(run).filter(|value| *value > 0.0) {
            let entry = least.entry(run.place()).or_insert(value);
            *entry = value.min(*entry);
        }
    }
    least
}

/// Every planner's values, as boxes.
pub(super) fn spreads(runs: &[Run]) -> Section {
    let mut blocks = Vec::new();
    for metric in metrics(&TIMES) {
        let of = |run: &Run| metric.of(run);
        blocks.extend(spread(runs, metric.name, AxisScale::Log, of));
    }
    for metric in metrics(&EXTENTS) {
        let least = least(runs, metric);
        let of = |run: &Run| Some(metric.of(run)? / least.get(&run.place())?);
        let words = metric.name.trim_end_matches(" m");
        let quantity = format!("{words} over the least of its scenario");
        blocks.extend(spread(runs, &quantity, AxisScale::Linear, of));
    }
    for metric in metrics(&PLAIN) {
        let of = |run: &Run| metric.of(run);
        blocks.extend(spread(runs, metric.name, AxisScale::Linear, of));
    }
    Section {
        heading: "How values are spread".to_owned(),
        blocks,
    }
}

/// A box for each planner that has values; nothing where none has.
fn spread(
    runs: &[Run],
    quantity: &str,
    scale: AxisScale,
    of: impl Fn(&Run) -> Option<f64>,
) -> Option<Block> {
    let group = |name: &&str| BoxGroup {
        name: (*name).to_owned(),
        values: runs_of(runs, name).into_iter().filter_map(&of).collect(),
    };
    let names = planners(runs);
    let groups = names.iter().map(group);
    let groups: Vec<BoxGroup> = groups.filter(|group| !group.values.is_empty()).collect();
    (!groups.is_empty()).then(|| {
        Block::BoxPlot(BoxPlot {
            caption: format!(
                "Solved runs, {quantity}: box from quartile to quartile with the median, whiskers \
                 within 1.5 box lengths, every run a dot."
            ),
            quantity: quantity.to_owned(),
            scale,
            groups,
            reference: None,
        })
    })
}

/// By how many percent a planner is above another, pair by pair; nothing without pairs.
pub(super) fn differences(pairs: &[[&Run; 2]]) -> Option<Block> {
    let panel = |metric: &Metric| {
        let difference = |[first, other]: &[&Run; 2]| {
            let base = metric.of(first).filter(|v| *v > 0.0)?;
            Some(100.0 * (metric.of(other)? / base - 1.0))
        };
        PairedPanel {
            name: metric.name.to_owned(),
            differences: pairs.iter().filter_map(difference).collect(),
        }
    };
    let drawn = metrics(&TIMES)
        .chain(metrics(&EXTENTS))
        .chain(metrics(&PLAIN));
    let panels = drawn.map(panel);
    let panels: Vec<PairedPanel> = panels.filter(|p| !p.differences.is_empty()).collect();
    (!panels.is_empty()).then(|| {
        Block::Paired(PairedPlot {
            caption:
                "Pairs of one scenario and seed that both solve, sorted: filled dots are below \
                      the first planner, hollow ones above."
                    .to_owned(),
            quantity: "difference to the first planner, %".to_owned(),
            panels,
        })
    })
}

/// Convergence of the paths of solved runs; nothing where no history is known.
pub(super) fn convergence(runs: &[Run]) -> Option<Section> {
    let figures = [by_time_and_steps(runs), by_iteration(runs)];
    let figures = figures.into_iter().filter(is_drawn);
    let blocks: Vec<Block> = figures.map(Block::Trends).collect();
    (!blocks.is_empty()).then(|| Section {
        heading: "How paths get better".to_owned(),
        blocks,
    })
}

fn is_drawn(plot: &Trends) -> bool {
    let mut trends = plot.panels.iter().flat_map(|panel| &panel.trends);
    trends.any(|trend| !trend.points.is_empty())
}

/// Length of the best path by time and by steps, over the least of its scenario.
fn by_time_and_steps(runs: &[Run]) -> Trends {
    let least: BTreeMap<_, f64> = metrics(&["length m"])
        .flat_map(|length| least(runs, length))
        .collect();
    let panel = |x: &str, of: fn(&Improvement) -> f64| {
        let points = |run: &Run| {
            let least_m = least.get(&run.place()).copied().unwrap_or(f64::NAN);
            let points = run.history.improvements.iter();
            points
                .map(|i| [of(i).max(f64::MIN_POSITIVE), i.length_m / least_m])
                .collect()
        };
        TrendPanel {
            x: x.to_owned(),
            x_scale: AxisScale::Log,
            trends: trends(runs, AxisScale::Log, points),
        }
    };
    Trends {
        caption: "Certified paths of the solved runs alone, from the beginning of the query on: \
                  median and the band between quartiles, from where three quarters of a planner's \
                  solved runs have a path; a dot with its quartiles where all of that is one place."
            .to_owned(),
        quantity: "length over the least of its scenario".to_owned(),
        y_scale: AxisScale::Linear,
        panels: vec![
            panel("ms", |improvement| 1e3 * improvement.at_s),
            panel("steps", |improvement| improvement.steps as f64),
        ],
    }
}

/// Least cost so far of colonies by iteration, over the last one of its run: what a colony costs
/// its ways in is its own, so that other colonies' costs are in other units.
fn by_iteration(runs: &[Run]) -> Trends {
    let points = |run: &Run| {
        let costs = run.history.iterations.iter();
        let costs: Vec<Option<f64>> = costs.map(|i| i["best_so_far_cost"].as_f64()).collect();
        let last = costs.iter().rev().find_map(|cost| *cost);
        let point = |(i, cost): (usize, &Option<f64>)| {
            let share = (*cost)? / last.filter(|last| *last > 0.0)?;
            Some([1.0 + i as f64, share])
        };
        costs.iter().enumerate().filter_map(point).collect()
    };
    Trends {
        caption: "Ways of the ants in the solved runs alone: the least cost up to an iteration \
                  over that after the last one, median and the band between quartiles, from where \
                  three quarters of a colony's solved runs have a way; a dot where that is one \
                  iteration."
            .to_owned(),
        quantity: "least cost over the last of its run".to_owned(),
        y_scale: AxisScale::Linear,
        panels: vec![TrendPanel {
            x: "iteration".to_owned(),
            x_scale: AxisScale::Linear,
            trends: trends(runs, AxisScale::Linear, points),
        }],
    }
}

/// A trend for each planner, over its solved runs that have points.
fn trends(runs: &[Run], scale: AxisScale, points: impl Fn(&Run) -> Vec<[f64; 2]>) -> Vec<Trend> {
    let trend = |planner: &&str| {
        let runs = runs_of(runs, planner).into_iter();
        let solved = runs.filter(|run| run.record.is_solved());
        let runs: Vec<Vec<[f64; 2]>> = solved.map(&points).filter(|run| !run.is_empty()).collect();
        Trend::of_runs(planner, &runs, scale)
    };
    planners(runs).iter().map(trend).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn run(planner: &str, seed: u64, is_solved: bool) -> Run {
        let mut run = Run::default();
        run.record
            .fill(&json!({
                "scenario": "s", "planner": planner, "seed": seed, "length_m": 10.0,
                "status": if is_solved { "found" } else { "no_path" }, "valid": is_solved,
            }))
            .unwrap();
        if is_solved {
            let improvement = |at_s, length_m| Improvement {
                at_s,
                steps: 1,
                length_m,
                ..Improvement::default()
            };
            run.history.improvements = vec![improvement(0.1, 20.0), improvement(0.4, 10.0)];
        }
        run
    }

    #[test]
    fn a_planner_that_rarely_solves_has_a_trend_of_its_solved_runs() {
        let runs: Vec<Run> = (0..8).map(|seed| run("p", seed, seed == 3)).collect();
        let section = convergence(&runs).unwrap();
        let [Block::Trends(plot)] = &section.blocks[..] else {
            panic!("{section:?}");
        };
        let points = &plot.panels[0].trends[0].points;
        assert_eq!(points[0][1..], [2.0; 3]);
        assert_eq!(points[points.len() - 1], [400.0, 1.0, 1.0, 1.0]);
        assert!(plot.caption.contains("solved runs alone"));
        assert_eq!(convergence(&runs[..3]), None);
    }

    #[test]
    fn a_colony_of_one_iteration_is_a_dot() {
        let mut runs = vec![run("ants", 0, true), run("ants", 1, true)];
        for run in &mut runs {
            run.history.iterations = vec![json!({"best_so_far_cost": 6.0})];
        }
        let Block::Trends(plot) = &convergence(&runs).unwrap().blocks[1] else {
            panic!("no picture by iteration");
        };
        assert_eq!(plot.panels[0].trends[0].points, [[1.0; 4]]);
        assert!(plot.to_svg().contains("<circle"));
    }

    #[test]
    fn colonies_have_a_trend_by_iteration() {
        let mut runs = vec![run("ants", 0, true), run("astar", 0, true)];
        let costs = [None, Some(6.0), Some(4.0)];
        let iterations = costs.map(|cost: Option<f64>| json!({"best_so_far_cost": cost}));
        runs[0].history.iterations = iterations.to_vec();
        let section = convergence(&runs).unwrap();
        let Block::Trends(plot) = &section.blocks[1] else {
            panic!("{section:?}");
        };
        let [ants, other] = &plot.panels[0].trends[..] else {
            panic!("{plot:?}");
        };
        assert_eq!(ants.points[0], [2.0, 1.5, 1.5, 1.5]);
        assert_eq!(ants.points[ants.points.len() - 1], [3.0, 1.0, 1.0, 1.0]);
        assert!(other.points.is_empty());
        let svg = plot.to_svg();
        assert!(svg.contains(">ants<") && !svg.contains(">astar<"), "{svg}");
    }
}

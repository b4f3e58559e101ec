//! Runs of stores as charts: how values are spread, how pairs differ, how paths get better.

use super::record::{Improvement, Record};
use super::report::place;
use crate::compare::{METRICS, Metric, planners, runs_of};
use crate::report::{
    BandPanel, Bands, Block, BoxGroup, BoxPlot, Course, PairedPanel, PairedPlot, ScaleKind, Section,
};
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
fn least<'a>(records: &'a [Record], metric: &Metric) -> BTreeMap<[&'a str; 3], f64> {
    let mut least = BTreeMap::new();
    for record in records {
        if let Some(value) = metric.of(record).filter(|value| *value > 0.0) {
            let entry = least.entry(place(record)).or_insert(value);
            *entry = value.min(*entry);
        }
    }
    least
}

/// Every planner's values, as boxes.
pub(super) fn spreads(records: &[Record]) -> Section {
    let mut blocks = Vec::new();
    for metric in metrics(&TIMES) {
        let of = |record: &Record| metric.of(record);
        blocks.extend(spread(records, (metric.name, ScaleKind::Log), of));
    }
    for metric in metrics(&EXTENTS) {
        let least = least(records, metric);
        let of = |record: &Record| Some(metric.of(record)? / least.get(&place(record))?);
        let words = metric.name.trim_end_matches(" m");
        let quantity = format!("{words} over the least of its scenario");
        blocks.extend(spread(records, (&quantity, ScaleKind::Linear), of));
    }
    for metric in metrics(&PLAIN) {
        let of = |record: &Record| metric.of(record);
        blocks.extend(spread(records, (metric.name, ScaleKind::Linear), of));
    }
    Section {
        heading: "How values are spread".to_owned(),
        blocks,
    }
}

/// A box for each planner that has values; nothing where none has.
fn spread(
    records: &[Record],
    (quantity, scale): (&str, ScaleKind),
    of: impl Fn(&Record) -> Option<f64>,
) -> Option<Block> {
    let group = |name: &&str| BoxGroup {
        name: (*name).to_owned(),
        values: runs_of(records, name).into_iter().filter_map(&of).collect(),
    };
    let names = planners(records);
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
pub(super) fn differences([first, other]: [&[&Record]; 2]) -> Option<Block> {
    let key = |record: &Record| {
        ["scenario", "vehicle", "motion", "seed"].map(|c| record.get(c).to_owned())
    };
    let of_first: BTreeMap<_, &Record> = first.iter().map(|r| (key(r), *r)).collect();
    let panel = |metric: &Metric| {
        let difference = |record: &&Record| {
            let base = metric
                .of(of_first.get(&key(record))?)
                .filter(|v| *v > 0.0)?;
            Some(100.0 * (metric.of(record)? / base - 1.0))
        };
        PairedPanel {
            name: metric.name.to_owned(),
            differences: other.iter().filter_map(difference).collect(),
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

/// Length of the best path by time and by steps, over the least of its scenario.
pub(super) fn convergence(records: &[Record]) -> Option<Section> {
    let length = metrics(&["length m"]).next()?;
    let least = least(records, length);
    let panel = |x: &str, of: fn(&Improvement) -> f64| BandPanel {
        x: x.to_owned(),
        x_scale: ScaleKind::Log,
        courses: courses(records, &least, of),
    };
    let panels = vec![
        panel("ms", |improvement| 1e3 * improvement.at_s),
        panel("steps", |improvement| improvement.steps as f64),
    ];
    let is_drawn = panels
        .iter()
        .any(|p| p.courses.iter().any(|c| !c.points.is_empty()));
    is_drawn.then(|| Section {
        heading: "How paths get better".to_owned(),
        blocks: vec![Block::Bands(Bands {
            caption: "Certified paths from the beginning of the query on: median of the runs and \
                      the band between quartiles, from where three quarters of the runs have a path."
                .to_owned(),
            quantity: "length over the least of its scenario".to_owned(),
            y_scale: ScaleKind::Linear,
            panels,
        })],
    })
}

fn courses(
    records: &[Record],
    least: &BTreeMap<[&str; 3], f64>,
    x: fn(&Improvement) -> f64,
) -> Vec<Course> {
    let course = |planner: &&str| {
        let run = |record: &Record| {
            let least_m = least.get(&place(record)).copied().unwrap_or(f64::NAN);
            let points = record.history.improvements.iter();
            points
                .map(|i| [x(i).max(f64::MIN_POSITIVE), i.length_m / least_m])
                .collect()
        };
        let runs: Vec<Vec<[f64; 2]>> = runs_of(records, planner).into_iter().map(run).collect();
        Course::of_runs(planner, &runs, ScaleKind::Log)
    };
    planners(records).iter().map(course).collect()
}

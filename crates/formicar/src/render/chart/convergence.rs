//! Charts of a colony over its iterations: costs, evaporation, ants that arrived.

use super::{Axis, Chart, Series, Side};
use crate::geometry::Point2;
use crate::progress::{History, IterationRecord};
use crate::render::palette::{self, Color};
use crate::render::style::Dash;

const COSTS_PX: f64 = 360.0;
const ARRIVED_PX: f64 = 110.0;
const FILM_COSTS_PX: f64 = 110.0;

/// Cost of the best way so far, of the best and of the mean way of each iteration, with the
/// evaporation rho on the right; below, how many ants arrived. Iterations count from 1; without
/// any there are no charts.
pub fn convergence_charts(history: &History) -> Vec<Chart> {
    if history.iterations.is_empty() {
        return Vec::new();
    }
    vec![costs(&history.iterations), arrived(&history.iterations)]
}

/// The costs of the first iterations, with axes that suit all, for a film.
pub(in crate::render) fn costs_up_to(history: &History, n_shown: usize) -> Chart {
    let mut chart = costs(&history.iterations);
    let (x, y) = (chart.x_scale(), chart.y_scale(Side::Left));
    (chart.x.range, chart.y.range) = (Some((x.low, x.high)), Some((y.low, y.high)));
    for series in &mut chart.series {
        series.points.truncate(n_shown);
    }
    chart.height_px = FILM_COSTS_PX;
    chart
}

fn costs(records: &[IterationRecord]) -> Chart {
    let series = |(label, color, dash), value: fn(&IterationRecord) -> Option<f64>| Series {
        dash,
        ..Series::new(label, points(records, value), color)
    };
    let rho = series(RHO, |r| Some(r.rho));
    Chart {
        title: "cost of ways".to_owned(),
        x: Axis::named("iteration"),
        y_right: Some(Axis {
            label: "evaporation ρ".to_owned(),
            range: Some((0.0, 1.0)),
            ..Axis::default()
        }),
        series: vec![
            Series {
                side: Side::Right,
                ..rho
            },
            series(MEAN, |r| r.mean_cost),
            series(BEST, |r| r.best_cost),
            series(BEST_SO_FAR, |r| r.best_so_far_cost),
        ],
        height_px: COSTS_PX,
        ..Chart::default()
    }
}

/// Name, color and dash of a line.
type Look = (&'static str, Color, Dash);
const RHO: Look = ("ρ", palette::MUTED, Dash::Dotted);
const MEAN: Look = ("mean", palette::REVERSE, Dash::Dashed);
const BEST: Look = ("best", palette::SWEPT, Dash::Solid);
const BEST_SO_FAR: Look = ("best so far", palette::FORWARD, Dash::Solid);

fn arrived(records: &[IterationRecord]) -> Chart {
    let n_ants = records.iter().map(|r| r.n_ants).max().unwrap_or(0);
    let n_arrived = points(records, |r| Some(f64::from(r.n_arrived)));
    Chart {
        title: "ants that arrived".to_owned(),
        x: Axis::named("iteration"),
        y: Axis {
            label: format!("of {n_ants}"),
            range: Some((0.0, f64::from(n_ants.max(1)))),
            ..Axis::default()
        },
        y_right: Some(Axis {
            label: "share".to_owned(),
            range: Some((0.0, 1.0)),
            ..Axis::default()
        }),
        series: vec![Series::new("", n_arrived, palette::FORWARD)],
        height_px: ARRIVED_PX,
        ..Chart::default()
    }
}

/// A value by iteration; iterations without one interrupt the line.
fn points(
    records: &[IterationRecord],
    value: impl Fn(&IterationRecord) -> Option<f64>,
) -> Vec<Point2> {
    let point = |record: &IterationRecord| {
        let number = f64::from(record.iteration) + 1.0;
        Point2::new(number, value(record).unwrap_or(f64::NAN))
    };
    records.iter().map(point).collect()
}

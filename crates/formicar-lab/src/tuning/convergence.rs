//! Convergence of the search, as a picture.

use super::TuningState;
use formicar::geometry::Point2;
use formicar::render::{Axis, Chart, Dash, Picture, Series, palette};

/// Least objective so far and the middle source, by evaluations. Costs of candidates that do not
/// go together are left out.
pub(super) fn picture(state: &TuningState) -> Picture {
    let points = |of: fn(&formicar::tuning::CycleRecord) -> f64| {
        let cycles = state.colony().history().iter();
        let points = cycles.map(move |cycle| Point2::new(cycle.n_evaluations as f64, of(cycle)));
        points.filter(|point| point.y < f64::MAX).collect()
    };
    let chart = Chart {
        title: "objective by evaluations; the default is 1".to_owned(),
        x: Axis::named("evaluations"),
        y: Axis::named("times the default's"),
        series: vec![
            Series::new("least so far", points(|c| c.best_cost), palette::FORWARD),
            Series {
                dash: Dash::Dashed,
                ..Series::new("middle source", points(|c| c.median_cost), palette::REVERSE)
            },
        ],
        height_px: 300.0,
        ..Chart::default()
    };
    Picture {
        title: "convergence of the tuning".to_owned(),
        charts: vec![chart],
        ..Picture::default()
    }
}

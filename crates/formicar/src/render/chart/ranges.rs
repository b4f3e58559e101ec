//! Lowest and highest values of the axes of a chart.

use super::scale::Scale;
use super::{Axis, AxisScale, Chart, Side};

/// Room beside data whose marks reach over their values, as a share of the axis.
const ROOM: f64 = 0.04;
/// The same on a logarithmic axis, as a ratio.
const LOG_ROOM: f64 = 1.06;

impl Chart {
    /// The x axis. Lines alone touch both of its ends; dots and boxes have a little room there.
    pub(super) fn x_scale(&self) -> Scale {
        let lines = self.series.iter().flat_map(|s| &s.points);
        let dots = self.dots.iter().flat_map(|d| &d.points);
        let xs = lines.chain(dots).map(|p| p.x);
        let ribbons = self.ribbons.iter().flat_map(|r| &r.points);
        let boxes = self.boxes.iter().flat_map(|row| &row.values).copied();
        let reference = self.reference.iter().map(|r| r.value);
        let values = xs.chain(ribbons.map(|p| p[0])).chain(boxes);
        scale(&self.x, || {
            let (low, high) = span(values.chain(reference), self.x.scale);
            let room = ROOM * (high - low);
            match self.x.scale {
                AxisScale::Log => (low / LOG_ROOM, high * LOG_ROOM),
                _ if self.dots.is_empty() && self.boxes.is_empty() => (low, high),
                AxisScale::Linear => (low - room, high + room),
            }
        })
    }

    /// The y axis of a side, with a little air.
    pub(super) fn y_scale(&self, side: Side) -> Scale {
        let lines = self.series.iter().filter(|s| s.side == side);
        let lines = lines.flat_map(|s| s.points.iter().map(|p| p.y));
        let none = Axis::default();
        let (axis, others) = match side {
            Side::Right => (self.y_right.as_ref().unwrap_or(&none), Vec::new()),
            Side::Left => (&self.y, self.left_values()),
        };
        scale(axis, || {
            let (low, high) = span(lines.chain(others), axis.scale);
            match axis.scale {
                AxisScale::Log => (low / LOG_ROOM, high * LOG_ROOM),
                AxisScale::Linear => {
                    let [below, above] = [low, high].map(|end| self.air(end, side));
                    (low - below * (high - low), high + above * (high - low))
                }
            }
        })
    }

    /// The values of the left axis that are not lines.
    fn left_values(&self) -> Vec<f64> {
        let ribbons = self.ribbons.iter().flat_map(|r| &r.points);
        let edges = ribbons.flat_map(|p| [p[1], p[2]]);
        let limits = self.limits.iter().map(|l| l.value);
        let dots = self.dots.iter().flat_map(|d| {
            let heads = d.points.iter().map(|p| p.y);
            heads.chain(d.stem_from)
        });
        edges.chain(limits).chain(dots).collect()
    }

    /// Air beyond an end of a linear y axis, as a share of its range.
    fn air(&self, end: f64, side: Side) -> f64 {
        // Limits at an end are named beyond their line.
        let is_limit = self.limits.iter().any(|l| l.value == end);
        match side {
            Side::Left if is_limit => 0.22,
            _ if end == 0.0 => 0.0,
            _ => 0.08,
        }
    }
}

fn scale(axis: &Axis, of_data: impl FnOnce() -> (f64, f64)) -> Scale {
    let (low, high) = axis.range.unwrap_or_else(of_data);
    Scale::new(axis.scale, low, high)
}

/// Lowest and highest of the values that can be drawn; never empty.
fn span(values: impl Iterator<Item = f64>, scale: AxisScale) -> (f64, f64) {
    let is_log = scale == AxisScale::Log;
    let drawable = values.filter(|v| v.abs() < 1e15 && (!is_log || *v > 1e-15));
    let (low, high) = drawable.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
        (low.min(v), high.max(v))
    });
    if low > high {
        return if is_log { (1.0, 2.0) } else { (0.0, 1.0) };
    }
    if high - low > 1e-9 * high.abs() {
        return (low, high);
    }
    let half = (0.5 * low.abs()).max(0.5);
    if is_log {
        (0.5 * low, 2.0 * low)
    } else {
        (low - half, high + half)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point2;
    use crate::render::chart::{Limit, Series};
    use crate::render::palette;

    fn ends(scale: Scale) -> (f64, f64) {
        (scale.low, scale.high)
    }

    #[test]
    fn ranges_cover_lines_and_limits_and_pass_over_what_is_no_number() {
        let points = [(0.0, 1.0), (4.0, f64::NAN), (5.0, 3.0)].map(|(x, y)| Point2::new(x, y));
        let limit = Limit {
            label: String::new(),
            value: 11.0,
        };
        let chart = Chart {
            series: vec![Series::new("", points.to_vec(), palette::INK)],
            limits: vec![limit],
            ..Chart::default()
        };
        assert_eq!(ends(chart.x_scale()), (0.0, 5.0));
        let (low, high) = ends(chart.y_scale(Side::Left));
        assert!((low - 0.2).abs() < 1e-12 && (high - 13.2).abs() < 1e-12);
        assert_eq!(ends(Chart::default().y_scale(Side::Right)), (0.0, 1.08));
    }

    #[test]
    fn one_value_or_none_is_an_axis_too() {
        for scale in [AxisScale::Linear, AxisScale::Log] {
            for values in [vec![], vec![7.0]] {
                let (low, high) = span(values.into_iter(), scale);
                assert!(!Scale::new(scale, low, high).ticks(5.0).is_empty());
            }
        }
        assert_eq!(
            span([0.0, 3.0, 40.0].into_iter(), AxisScale::Log),
            (3.0, 40.0)
        );
    }
}

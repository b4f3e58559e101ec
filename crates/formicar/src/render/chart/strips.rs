//! Strip charts along a path: curvature, steering and clearance over arc length.

use super::{Axis, Band, Chart, Limit, Series};
use crate::geometry::Point2;
use crate::path::Direction;
use crate::render::palette;
use crate::render::style::clearance_label;
use crate::vehicle::{Motion, Vehicle};

/// The values of the strip charts at one place of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfilePoint {
    /// Arc length driven so far, meters.
    pub s_m: f64,
    /// Curvature of the rear-axle center's path, positive left.
    pub curvature_per_m: f64,
    /// Steering angle, where the wheelbase is known.
    pub steer_rad: Option<f64>,
    /// Distance from the footprint to the nearest obstacle; a value that is not finite leaves a
    /// gap.
    pub clearance_m: f64,
    /// The gear in which the place is reached.
    pub direction: Direction,
}

/// Curvature, steering (where known) and clearance over arc length, with the vehicle's limits and
/// the stretches in reverse shaded; steering in degrees. A point has clearance only.
pub fn strip_charts(profile: &[ProfilePoint], vehicle: &Vehicle) -> Vec<Chart> {
    if profile.len() < 2 {
        return Vec::new();
    }
    let mut charts = Vec::new();
    let max_curvature_per_m = vehicle.max_curvature_per_m();
    if vehicle.motion() == Motion::Car {
        charts.push(Chart {
            limits: both_sides(max_curvature_per_m, |k| format!("{k:.2} 1/m")),
            ..steps(profile, "curvature", "1/m", |p| p.curvature_per_m)
        });
    }
    if let Some(limit_rad) = vehicle
        .steer_rad(max_curvature_per_m)
        .filter(|_| profile.iter().any(|p| p.steer_rad.is_some()))
    {
        let steer_deg = |p: &ProfilePoint| p.steer_rad.map_or(f64::NAN, f64::to_degrees);
        charts.push(Chart {
            limits: both_sides(limit_rad.to_degrees(), |a| format!("{a:.1}°")),
            ..steps(profile, "steering", "degrees", steer_deg)
        });
    }
    charts.push(clearance(profile));
    stacked(charts, "arc length, m")
}

/// Charts over one x axis: the first names the stretches in reverse, the last the axis.
pub(in crate::render) fn stacked(mut charts: Vec<Chart>, x_label: &str) -> Vec<Chart> {
    if let Some(first) = charts.first_mut() {
        let name = |band: &mut Band| String::from("reverse").clone_into(&mut band.label);
        first.bands.iter_mut().for_each(name);
    }
    if let Some(last) = charts.last_mut() {
        x_label.clone_into(&mut last.x.label);
    }
    charts
}

fn clearance(profile: &[ProfilePoint]) -> Chart {
    let finite = profile.iter().filter(|p| p.clearance_m.is_finite());
    let tightest = finite.min_by(|a, b| a.clearance_m.total_cmp(&b.clearance_m));
    let label = |p: &ProfilePoint| {
        let place = Point2::new(p.s_m, p.clearance_m);
        (place, clearance_label(p.clearance_m))
    };
    Chart {
        limits: vec![Limit {
            label: "contact".to_owned(),
            value: 0.0,
        }],
        ringed: tightest.map(label),
        ..strip(profile, "clearance", "m", |p| p.clearance_m)
    }
}

/// A strip of values that hold from one point to the next: those of the gear and arc on which the
/// point was reached.
fn steps(
    profile: &[ProfilePoint],
    title: &str,
    unit: &str,
    value: impl Fn(&ProfilePoint) -> f64,
) -> Chart {
    let mut chart = strip(profile, title, unit, &value);
    if let Some(series) = chart.series.first_mut() {
        let steps = profile.windows(2).flat_map(|pair| {
            let reached = value(&pair[1]);
            [pair[0].s_m, pair[1].s_m].map(|s_m| Point2::new(s_m, reached))
        });
        series.points = steps.collect();
    }
    chart
}

fn strip(
    profile: &[ProfilePoint],
    title: &str,
    unit: &str,
    value: impl Fn(&ProfilePoint) -> f64,
) -> Chart {
    let points = profile
        .iter()
        .map(|p| Point2::new(p.s_m, value(p)))
        .collect();
    let length_m = profile.last().map_or(0.0, |p| p.s_m);
    Chart {
        title: title.to_owned(),
        x: Axis {
            label: String::new(),
            range: (length_m.is_finite() && length_m > 0.0).then_some((0.0, length_m)),
            ..Axis::default()
        },
        y: Axis::named(unit),
        bands: reverse_stretches(profile.iter().map(|p| (p.s_m, p.direction))),
        series: vec![Series::new("", points, palette::FORWARD)],
        ..Chart::default()
    }
}

pub(in crate::render) fn both_sides(limit: f64, label: impl Fn(f64) -> String) -> Vec<Limit> {
    [limit, -limit]
        .map(|value| Limit {
            label: label(value),
            value,
        })
        .to_vec()
}

/// Shades the stretches of an axis that are driven in reverse, from its values and the gears in
/// which they are reached.
pub(in crate::render) fn reverse_stretches(
    points: impl Iterator<Item = (f64, Direction)>,
) -> Vec<Band> {
    let mut bands: Vec<Band> = Vec::new();
    let mut from = None;
    for (to, direction) in points {
        match (from.replace(to), direction, bands.last_mut()) {
            (None, _, _) | (_, Direction::Forward, _) => {}
            (Some(from), Direction::Reverse, Some(band)) if band.to == from => band.to = to,
            (Some(from), Direction::Reverse, _) => bands.push(Band {
                label: String::new(),
                from,
                to,
            }),
        }
    }
    bands
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(s_m: f64, direction: Direction) -> ProfilePoint {
        ProfilePoint {
            s_m,
            curvature_per_m: 0.1,
            steer_rad: None,
            clearance_m: 1.0 - 0.1 * s_m,
            direction,
        }
    }

    #[test]
    fn shades_the_ground_driven_in_reverse() {
        use Direction::{Forward, Reverse};
        let gears = [Forward, Reverse, Reverse, Forward, Reverse];
        let profile: Vec<_> = (0..5)
            .map(|i| point(f64::from(i), gears[i as usize]))
            .collect();
        let points = profile.iter().map(|p| (p.s_m, p.direction));
        let stretches: Vec<_> = reverse_stretches(points)
            .iter()
            .map(|b| (b.from, b.to))
            .collect();
        assert_eq!(stretches, [(0.0, 2.0), (3.0, 4.0)]);
        let charts = strip_charts(&profile, &Vehicle::sedan());
        assert_eq!(charts.len(), 2, "no steering was given");
        let (place, label) = charts[1].ringed.clone().unwrap();
        assert_eq!((place.x, label.as_str()), (4.0, "0.60 m"));
    }
}

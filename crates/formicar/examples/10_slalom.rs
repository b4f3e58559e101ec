//! A slalom of a suspended car: what the steering needs, and what it can give, along the way.
//!
//! `cargo run --release -p formicar --example 10_slalom`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::geometry::Point2;
use formicar::render::{Axis, Chart, Picture, SERIES_COLORS, Series};
use formicar::vehicle::{SteeringDemand, SuspendedSteering, SuspensionParameters};
use std::{error::Error, f64::consts::TAU, fs};

type Change = fn(&mut SuspensionParameters, f64);
type Shown = fn(&SteeringDemand) -> f64;

fn main() -> Result<(), Box<dyn Error>> {
    let [limit, needed]: [Shown; 2] = [|demand| demand.limit_rad, |demand| demand.needed_rad];
    let speed: Change = |car, value| car.speed_mps = value;
    let soft: Change = |car, value| car.compliance_m_per_n = 1e-6 * value;
    let damped: Change = |car, value| car.damping_order = value;
    let felt: Change = |car, value| car.heading_order = value;
    let mut picture = Picture::default();
    for (title, shown, change, values) in [
        ("Limit by speed, m/s", limit, speed, [0.3, 1., 2., 3.]),
        ("Limit by give, mm/kN", limit, soft, [0., 50., 100., 200.]),
        ("Limit, damping order", limit, damped, [0.25, 0.5, 0.75, 1.]),
        ("Needed by give, mm/kN", needed, soft, [0., 50., 100., 200.]),
        ("Needed, heading order", needed, felt, [1., 0.9, 0.7, 0.5]),
    ] {
        let mut chart = Chart::default();
        (chart.title, chart.y) = (title.to_owned(), Axis::named("deg"));
        for (value, color) in values.into_iter().zip(SERIES_COLORS) {
            let mut car = SuspensionParameters::default();
            (car.mass_kg, car.speed_mps, car.window) = (1200.0, 3.0, 64);
            change(&mut car, value);
            let line = drive(car, shown)?;
            let least = line.iter().map(|p| p.y).fold(f64::MAX, f64::min);
            println!("{title}, {value}: {least:.2} deg at least");
            let name = value.to_string();
            chart.series.push(Series::new(&name, line, color));
        }
        picture.charts.push(chart);
    }
    if let Some(last) = picture.charts.last_mut() {
        last.x = Axis::named("arc length, m");
    }
    fs::create_dir_all("formicar-examples")?;
    fs::write("formicar-examples/10_slalom.svg", picture.to_svg())?;
    Ok(())
}

/// A sedan in two waves of 16 m, steered by 25 degrees to either side, then straight on.
fn drive(car: SuspensionParameters, shown: Shown) -> Result<Vec<Point2>, Box<dyn Error>> {
    let mut steering = SuspendedSteering::new([2.8, 35_f64.to_radians()], car, 0.1)?;
    let step = |i: u32| {
        let wave = (TAU * f64::from(i.min(320)) / 160.0).sin();
        let turn_rad = 0.1 * (25_f64.to_radians() * wave).tan() / 2.8;
        let angle_rad = shown(&steering.advance(turn_rad, 0.1));
        Point2::new(0.1 * f64::from(i), angle_rad.to_degrees())
    };
    Ok((1..=400).map(step).collect())
}

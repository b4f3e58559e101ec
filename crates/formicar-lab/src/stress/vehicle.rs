//! Vehicles: the presets, rectangles of random measures, and polygons.

use formicar::numeric::RandomStream;
use formicar::vehicle::{FootprintSpec, Vehicle, VehicleParameters};
use std::f64::consts::TAU;

/// Presets that steer.
const CARS: [&str; 5] = ["lei2020", "warehouse_amr", "f1tenth", "tpcap", "sedan"];

/// A vehicle, with the name of its kind.
pub(super) fn draw(random: &mut RandomStream) -> (&'static str, Vehicle) {
    let (name, vehicle) = match random.below(4) {
        0 | 1 => {
            let name = CARS[random.below(CARS.len())];
            (name, Vehicle::preset(name))
        }
        2 => ("rectangle", Vehicle::new(rectangle(random))),
        _ => ("polygon", Vehicle::new(polygon(random))),
    };
    let vehicle = vehicle.expect("measures are in range");
    if random.below(6) > 0 {
        return (name, vehicle);
    }
    let margin_m = random.range(0.0, 0.15) * vehicle.width_m();
    let grown = vehicle.with_safety_margin(margin_m);
    (name, grown.expect("a margin in range"))
}

fn rectangle(random: &mut RandomStream) -> VehicleParameters {
    let wheelbase_m = random.range(0.3, 3.5);
    let mut of_wheelbase = |low, high| Some(wheelbase_m * random.range(low, high));
    VehicleParameters {
        wheelbase_m: Some(wheelbase_m),
        width_m: of_wheelbase(0.3, 1.2),
        front_overhang_m: of_wheelbase(0.0, 0.5),
        rear_overhang_m: of_wheelbase(0.0, 0.5),
        max_steer_deg: Some(random.range(15.0, 55.0)),
        ..VehicleParameters::default()
    }
}

/// Corners around a center ahead of the rear axle, made convex by the vehicle.
fn polygon(random: &mut RandomStream) -> VehicleParameters {
    let size_m = random.range(0.3, 2.0);
    let (ahead_m, squeeze) = (size_m * random.range(-0.2, 0.8), random.range(0.4, 1.0));
    let n_corners = 3 + random.below(6);
    let corner = |i: usize| {
        let angle_rad = TAU * (i as f64 + random.range(0.0, 0.5)) / n_corners as f64;
        let radius_m = size_m * random.range(0.8, 1.0);
        let (sin, cos) = angle_rad.sin_cos();
        [ahead_m + radius_m * cos, squeeze * radius_m * sin]
    };
    let corners = (0..n_corners).map(corner).collect();
    VehicleParameters {
        footprint: Some(FootprintSpec::Points(corners)),
        min_turning_radius_m: Some(size_m * random.range(0.5, 3.0)),
        ..VehicleParameters::default()
    }
}

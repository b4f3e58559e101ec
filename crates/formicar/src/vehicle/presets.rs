//! Vehicles by name.

use super::{Vehicle, VehicleError, VehicleParameters};

/// Names of the built-in vehicles; the second is the default.
///
/// ```
/// use formicar::Vehicle;
/// use formicar::vehicle::PRESET_NAMES;
///
/// for name in PRESET_NAMES {
///     assert!(Vehicle::preset(name).is_ok());
/// }
/// assert!(Vehicle::preset("hovercraft").unwrap_err().to_string().contains("sedan"));
/// ```
pub const PRESET_NAMES: [&str; 6] = [
    "lei2020",
    "warehouse_amr",
    "f1tenth",
    "tpcap",
    "sedan",
    "point",
];

impl Vehicle {
    /// The vehicle of Lei & Zheng 2020, sec. IV.B; its overhangs and its pace are our choice.
    pub fn lei2020() -> Self {
        let pace = Pace(1.0, 1.0, 0.5);
        let car = rectangle([2.0, 1.0, 0.5, 0.5], 40_f64.to_radians(), pace);
        made(VehicleParameters {
            track_width_m: Some(0.8),
            ..car
        })
    }

    /// A warehouse robot of 0.90 x 0.62 m: the default vehicle. All of it is our choice.
    pub fn warehouse_amr() -> Self {
        let pace = Pace(1.0, 1.0, 0.5);
        let steer_rad = 40_f64.to_radians();
        made(rectangle([0.65, 0.62, 0.125, 0.125], steer_rad, pace))
    }

    /// The 1:10 racing car of the F1TENTH series. Steering rate and acceleration are those of the
    /// F1TENTH simulator (`sv_max`, `a_max`); its speed is our choice, a tenth of the simulator's.
    pub fn f1tenth() -> Self {
        let pace = Pace(3.2, 2.0, 9.51);
        made(rectangle([0.33, 0.30, 0.09, 0.09], 0.4189, pace))
    }

    /// The car of the TPCAP parking cases, with the limits that the competition states.
    pub fn tpcap() -> Self {
        let pace = Pace(0.5, 2.5, 1.0);
        made(rectangle([2.8, 1.942, 0.96, 0.929], 0.75, pace))
    }

    /// A middle-sized passenger car; its pace is our choice, that of a car in a parking lot.
    pub fn sedan() -> Self {
        let pace = Pace(0.6, 2.0, 1.0);
        made(rectangle([2.8, 1.8, 0.9, 1.0], 35_f64.to_radians(), pace))
    }

    /// A built-in vehicle by name.
    ///
    /// # Errors
    /// A name that is not in [`PRESET_NAMES`].
    pub fn preset(name: &str) -> Result<Self, VehicleError> {
        match name {
            "lei2020" => Ok(Self::lei2020()),
            "warehouse_amr" => Ok(Self::warehouse_amr()),
            "f1tenth" => Ok(Self::f1tenth()),
            "tpcap" => Ok(Self::tpcap()),
            "sedan" => Ok(Self::sedan()),
            "point" => Ok(Self::point()),
            _ => Err(VehicleError::UnknownPreset {
                name: name.to_owned(),
            }),
        }
    }
}

/// Steering rate, rad/s; top speed, m/s; acceleration, m/s^2.
#[derive(Clone, Copy)]
struct Pace(f64, f64, f64);

/// `[wheelbase, width, front overhang, rear overhang]`, meters.
fn rectangle(lengths: [f64; 4], max_steer_rad: f64, pace: Pace) -> VehicleParameters {
    let [wheelbase_m, width_m, front_overhang_m, rear_overhang_m] = lengths.map(Some);
    VehicleParameters {
        wheelbase_m,
        width_m,
        front_overhang_m,
        rear_overhang_m,
        max_steer_rad: Some(max_steer_rad),
        max_steer_rate_rad_per_s: Some(pace.0),
        speed_mps: Some(pace.1),
        max_acceleration_mps2: Some(pace.2),
        ..VehicleParameters::default()
    }
}

fn made(parameters: VehicleParameters) -> Vehicle {
    Vehicle::new(parameters).expect("preset measures are in range")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_its_vehicle() {
        for name in PRESET_NAMES {
            assert!(Vehicle::preset(name).is_ok(), "{name}");
        }
        assert!(Vehicle::preset("tank").is_err());
    }
}

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
    /// The vehicle of Lei & Zheng 2020, sec. IV.B; its overhangs are our choice.
    pub fn lei2020() -> Self {
        let track_width_m = Some(0.8);
        rectangle([2.0, 1.0, 0.5, 0.5], 40_f64.to_radians(), track_width_m)
    }

    /// A warehouse robot of 0.90 x 0.62 m: the default vehicle.
    pub fn warehouse_amr() -> Self {
        rectangle([0.65, 0.62, 0.125, 0.125], 40_f64.to_radians(), None)
    }

    /// The 1:10 racing car of the F1TENTH series.
    pub fn f1tenth() -> Self {
        rectangle([0.33, 0.30, 0.09, 0.09], 0.4189, None)
    }

    /// The car of the TPCAP parking cases.
    pub fn tpcap() -> Self {
        rectangle([2.8, 1.942, 0.96, 0.929], 0.75, None)
    }

    /// A middle-sized passenger car.
    pub fn sedan() -> Self {
        rectangle([2.8, 1.8, 0.9, 1.0], 35_f64.to_radians(), None)
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

/// `[wheelbase, width, front overhang, rear overhang]`, meters.
fn rectangle(lengths: [f64; 4], max_steer_rad: f64, track_width_m: Option<f64>) -> Vehicle {
    let [wheelbase_m, width_m, front_overhang_m, rear_overhang_m] = lengths.map(Some);
    Vehicle::new(VehicleParameters {
        wheelbase_m,
        width_m,
        front_overhang_m,
        rear_overhang_m,
        track_width_m,
        max_steer_rad: Some(max_steer_rad),
        ..VehicleParameters::default()
    })
    .expect("preset measures are in range")
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

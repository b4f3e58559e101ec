//! Vehicle files, as JSON where they begin so, else as TOML; the footprint may be a ROS string.
#![no_main]

use formicar::collision::Body;
use formicar::vehicle::{Vehicle, VehicleParameters};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Some(text) = formicar_fuzz::text(bytes) else {
        return;
    };
    let parameters: Option<VehicleParameters> = match text.starts_with('{') {
        true => serde_json::from_str(text).ok(),
        false => toml::from_str(text).ok(),
    };
    let Some(Ok(vehicle)) = parameters.map(Vehicle::new) else {
        return;
    };
    let _ = Body::new(&vehicle);
    let again = Vehicle::new(vehicle.parameters().clone()).expect("checked once");
    assert_eq!(again.hash(), vehicle.hash());
});

//! Scenario files of others: Moving AI, car scenarios, TPCAP cases.
#![no_main]

use formicar::map::format::{TpcapCase, parse_car_scenarios, parse_movingai_scenarios};
use formicar::vehicle::Vehicle;
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    let Some(text) = formicar_fuzz::text(bytes) else {
        return;
    };
    let _ = parse_movingai_scenarios(text);
    if let Ok(case) = TpcapCase::parse(text) {
        let _ = case.rasterize(0.5);
    }
    for scenario in parse_car_scenarios(text, Path::new(".")).unwrap_or_default() {
        let _ = Vehicle::new(scenario.vehicle);
    }
});

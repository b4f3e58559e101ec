//! Documents of planners, as JSON where they begin so, else as TOML: one that is read is written
//! and read again as the same.
#![no_main]

use formicar::planner::PlannerConfig;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Some(text) = formicar_fuzz::text(bytes) else {
        return;
    };
    let config: Option<PlannerConfig> = match text.starts_with('{') {
        true => serde_json::from_str(text).ok(),
        false => toml::from_str(text).ok(),
    };
    let Some(config) = config.filter(|config| config.check().is_ok()) else {
        return;
    };
    let written = serde_json::to_string(&config).expect("a checked configuration");
    let read: PlannerConfig = serde_json::from_str(&written).expect("what was written");
    assert_eq!(serde_json::to_string(&read).expect("as before"), written);
});

//! A file of relations between poses.
#![no_main]

use formicar_mapping::log::parse_relations;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Some(text) = formicar_fuzz::text(bytes) {
        let _ = parse_relations(text);
    }
});

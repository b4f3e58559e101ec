//! A lidar log in CARMEN's format, plain or packed; what is read is mapped.
#![no_main]

use formicar_mapping::log::carmen::parse_carmen;
use formicar_mapping::{Go, Mapper, MappingConfig};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(mut log) = parse_carmen(bytes) else {
        return;
    };
    log.scans.truncate(5);
    log.odometry = log.odometry.map(|odometry| odometry[..log.scans.len()].to_vec());
    let mut mapper = Mapper::new(MappingConfig::default()).expect("valid parameters");
    mapper.resolve_ranges(&log);
    if mapper.add_log(&log, |_| true, |_| Go::On).is_ok() {
        let _ = mapper.finish(|_| Go::On);
    }
});

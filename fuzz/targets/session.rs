//! A session of mapping; one that is read is written again.
#![no_main]

use formicar_mapping::Mapper;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(mapper) = Mapper::from_session(bytes) {
        mapper.to_session().expect("what was read can be written");
    }
});

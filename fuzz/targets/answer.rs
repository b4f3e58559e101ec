//! Answers that were stored: their paths stand before the judge.
#![no_main]

use formicar::planner::StoredPath;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let stored = formicar_fuzz::text(bytes).map(StoredPath::from_json);
    if let Some(Ok(stored)) = stored {
        formicar_fuzz::judge_in_yard(&stored.path);
    }
});

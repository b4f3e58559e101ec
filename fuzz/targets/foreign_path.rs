//! Paths of others: samples as a table, `nav_msgs/Path`, logs of OMPL.
#![no_main]

use formicar::path::Direction;
use formicar_lab::rival::import;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Some(runs) = formicar_fuzz::text(bytes).map(import::read) else {
        return;
    };
    let samples = runs.into_iter().flatten().filter_map(|run| run.samples);
    for samples in samples.take(4) {
        for gear in [Direction::Forward, Direction::Reverse] {
            if let Some(path) = samples.path(gear) {
                formicar_fuzz::judge_in_yard(&path);
            }
        }
    }
});

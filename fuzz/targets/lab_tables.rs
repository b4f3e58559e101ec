//! Tables that the lab reads back: results, peers, the state of a tuning.
#![no_main]

use formicar_lab::run::read_csv;
use formicar_lab::analysis::standing::Peer;
use formicar_lab::tuning::TuningState;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Some(text) = formicar_fuzz::text(bytes) else {
        return;
    };
    let _ = read_csv(text);
    let _ = Peer::read(text);
    let _ = TuningState::read(text);
});

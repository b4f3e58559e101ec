//! Answers of other programs in a campaign.
#![no_main]

use formicar_lab::rival::RivalAnswer;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Some(Ok(answer)) = formicar_fuzz::text(bytes).map(RivalAnswer::read) {
        let _ = answer.samples();
    }
});

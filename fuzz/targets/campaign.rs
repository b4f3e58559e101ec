//! Campaign files.
#![no_main]

use formicar_lab::campaign::{Document, Text};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Some(text) = formicar_fuzz::text(bytes) else {
        return;
    };
    let _ = Document::read(Text {
        name: "campaign.toml".to_owned(),
        text: text.to_owned(),
    });
});

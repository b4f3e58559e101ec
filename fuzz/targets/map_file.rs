//! Maps in one file: the first byte chooses the kind, the rest is the file.
#![no_main]

use formicar::map::format::{
    ReadOptions, map_from_bytes, ros_pgm, ros_png, to_csv_matrix, to_movingai_map, to_text_matrix,
};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

const NAMES: [&str; 6] = ["a.map", "a.txt", "a.csv", "a.pgm", "a.png", "a"];

fuzz_target!(|bytes: &[u8]| {
    let Some((kind, bytes)) = bytes.split_first() else {
        return;
    };
    let name = NAMES[usize::from(*kind) % NAMES.len()];
    let options = ReadOptions {
        resolution_m: Some(0.1),
        ..ReadOptions::default()
    };
    let Ok(map) = map_from_bytes(Path::new(name), bytes, &options) else {
        return;
    };
    let _ = (to_movingai_map(&map), to_text_matrix(&map), to_csv_matrix(&map));
    let _ = (ros_pgm(&map), ros_png(&map));
});

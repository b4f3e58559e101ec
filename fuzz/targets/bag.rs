//! A bag of ROS 2: its log and its map, and messages by themselves.
#![no_main]

use formicar_record::messages::{LaserScan, OccupancyGrid, Odometry, TFMessage};
use formicar_record::{Bag, LogOptions, MapAt, cdr, read_log, read_map};
use libfuzzer_sys::fuzz_target;
use std::io::Cursor;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(mut bag) = Bag::open("fuzz.mcap", Cursor::new(bytes)) {
        let _ = read_log(&mut bag, &LogOptions::default());
        let _ = read_map(&mut bag, None, MapAt::Last);
    }
    let _ = cdr::decode::<LaserScan>(bytes);
    let _ = cdr::decode::<Odometry>(bytes);
    let _ = cdr::decode::<TFMessage>(bytes);
    if let Ok(grid) = cdr::decode::<OccupancyGrid>(bytes) {
        let _ = formicar_record::from_message("/map", &grid);
    }
});

//! Maps and scenarios in files: the only part of the library that touches a file system.
//!
//! Every format has functions from text or bytes, and [`read_map`] and [`write_map`] choose one by
//! the file's name, and by its contents where the name is not enough.

mod bmp;
mod car;
mod error;
mod files;
mod grey_image;
mod map_file;
mod matrix;
mod movingai;
mod pgm;
mod png_file;
mod read;
mod ros;
mod ros_grid;
mod table;
mod tpcap;
mod write;

pub use car::{CarScenario, parse_car_scenarios, read_car_scenarios};
pub use error::{FormatError, FormatProblem, Place};
pub use files::write_atomically;
pub use grey_image::GreyImage;
pub use map_file::{MapFile, MapWarning, SAVER_UNKNOWN_GREY};
pub use matrix::{parse_matrix, to_csv_matrix, to_text_matrix};
pub use movingai::{
    MovingAiScenario, parse_movingai_map, parse_movingai_scenarios, read_movingai_scenarios,
    to_movingai_map,
};
pub use read::{ReadOptions, map_from_bytes, read_map};
pub use ros::{RosMapDescription, RosMapMode};
pub use tpcap::{TPCAP_MARGIN_M, TpcapCase};
pub use write::{ros_pgm, ros_png, write_map};

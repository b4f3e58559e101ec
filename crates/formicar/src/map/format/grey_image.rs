//! A grayscale image, whatever file it came from.

use super::{FormatError, FormatProblem, bmp, pgm, png_file};
use crate::geometry::Pose2;
use crate::map::{GridFrame, MapError};

/// A grayscale image: rows from the top, 0 is black, `max_value` white.
#[derive(Clone, Debug, PartialEq)]
pub struct GreyImage {
    /// Number of columns, at least 1.
    pub n_cols: usize,
    /// Number of rows, at least 1.
    pub n_rows: usize,
    /// The value of white: 255 in most files, up to 65535.
    pub max_value: u16,
    /// `n_cols * n_rows` values of at most `max_value`.
    pub values: Vec<u16>,
    /// The pixels that are not fully opaque, if the image has transparency at all.
    pub transparent: Option<Vec<bool>>,
}

impl GreyImage {
    /// Reads a PGM (P2 or P5), PNG or BMP image. Colors become the rounded mean of red, green and blue.
    ///
    /// # Errors
    /// Another kind of file, a broken one, or more pixels than a map may have cells.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, FormatError> {
        match bytes {
            [b'P', b'2' | b'5', ..] => pgm::read(bytes),
            [0x89, b'P', b'N', b'G', ..] => png_file::read(bytes),
            [b'B', b'M', ..] => bmp::read(bytes),
            _ => {
                let expected = "a PGM (P2 or P5), PNG or BMP image";
                Err(FormatProblem::wrong_magic(bytes, expected).into())
            }
        }
    }
}

/// Refuses sizes that no map can have, before anything is allocated.
pub(super) fn check_size(n_cols: usize, n_rows: usize) -> Result<(), MapError> {
    GridFrame::new(n_cols, n_rows, 1.0, Pose2::default()).map(|_| ())
}

//! Windows bitmaps without compression, as grey values and transparency.

use super::grey_image::{GreyImage, check_size};
use super::{FormatError, FormatProblem};
use std::ops::Range;

/// Size of the file's header, bytes.
const FILE_HEADER: usize = 14;
/// Size of the oldest header of an image that is read (`BITMAPINFOHEADER`), bytes.
const INFO_HEADER: usize = 40;
/// Compression methods: none, and colors at places that masks tell.
const UNCOMPRESSED: u32 = 0;
const BIT_FIELDS: u32 = 3;

/// Reads a bitmap of 1, 4, 8, 24 or 32 bits per pixel; colors are averaged.
///
/// The fourth byte of 32 bits is transparency only where a mask says so.
pub(super) fn read(bytes: &[u8]) -> Result<GreyImage, FormatError> {
    let header = Header::read(bytes)?;
    let (n_cols, n_rows) = (header.n_cols, header.n_rows);
    check_size(n_cols, n_rows)?;
    // Rows end at a multiple of four bytes.
    let row_bytes = (n_cols * header.depth).div_ceil(32) * 4;
    let needed = row_bytes * n_rows;
    let data = bytes.get(header.data..).unwrap_or(&[]);
    if data.len() < needed {
        let (unit, found) = ("bytes of image data", data.len());
        return Err(FormatProblem::Truncated {
            unit,
            found,
            needed,
        }
        .into());
    }
    let has_alpha = header.alpha.is_some();
    let mut image = GreyImage {
        n_cols,
        n_rows,
        max_value: 255,
        values: Vec::with_capacity(n_cols * n_rows),
        transparent: has_alpha.then(Vec::new),
    };
    for row in 0..n_rows {
        let row = if header.is_top_down {
            row
        } else {
            n_rows - 1 - row
        };
        let row = &data[row * row_bytes..][..row_bytes];
        for col in 0..n_cols {
            let pixel = header.pixel(row, col);
            image.values.push(u16::from(pixel.grey));
            if let Some(transparent) = &mut image.transparent {
                transparent.push(!pixel.is_opaque);
            }
        }
    }
    Ok(image)
}

struct Pixel {
    grey: u8,
    is_opaque: bool,
}

struct Header {
    n_cols: usize,
    n_rows: usize,
    is_top_down: bool,
    /// Bits per pixel.
    depth: usize,
    /// The first byte of the image.
    data: usize,
    /// Greys of the indices of up to 8 bits.
    palette: Vec<u8>,
    /// The bytes of red, green and blue in a pixel of 24 or 32 bits.
    colors: [usize; 3],
    /// The byte of the opacity.
    alpha: Option<usize>,
}

impl Header {
    fn read(bytes: &[u8]) -> Result<Self, FormatError> {
        let size = number(bytes, FILE_HEADER, "the header's size")? as usize;
        if size < INFO_HEADER {
            let expected = "at least 40; hint: save it as PNG";
            return Err(FormatProblem::bad_value("the header's size", size, expected).into());
        }
        let signed = |at| number(bytes, at, "the image's size").map(u32::cast_signed);
        let [width, height] = [signed(18)?, signed(22)?];
        let depth = (number(bytes, 26, "the depth")? >> 16) as usize;
        let compression = number(bytes, 30, "the compression")?;
        if ![UNCOMPRESSED, BIT_FIELDS].contains(&compression) {
            let expected = "0 (none) or 3 (bit fields); hint: save it without compression";
            return Err(FormatProblem::bad_value("the compression", compression, expected).into());
        }
        let is_known = match compression {
            BIT_FIELDS => depth == 32,
            _ => [1, 4, 8, 24, 32].contains(&depth),
        };
        if !is_known {
            let expected = "1, 4, 8, 24 or 32 bits per pixel; hint: save it as 8-bit grey";
            return Err(FormatProblem::bad_value("the depth", depth, expected).into());
        }
        let (colors, alpha) = match compression {
            BIT_FIELDS => masks(bytes, size)?,
            _ => ([2, 1, 0], None),
        };
        Ok(Self {
            n_cols: usize::try_from(width).unwrap_or(0),
            n_rows: height.unsigned_abs() as usize,
            is_top_down: height < 0,
            depth,
            data: number(bytes, 10, "the place of the image")? as usize,
            palette: palette(bytes, FILE_HEADER + size, depth)?,
            colors,
            alpha,
        })
    }

    fn pixel(&self, row: &[u8], col: usize) -> Pixel {
        if self.depth <= 8 {
            let bit = col * self.depth;
            let shift = 8 - self.depth - bit % 8;
            let index = usize::from(row[bit / 8] >> shift) & ((1 << self.depth) - 1);
            return Pixel {
                // An index beyond the palette is black, as everywhere.
                grey: self.palette.get(index).copied().unwrap_or(0),
                is_opaque: true,
            };
        }
        let pixel = &row[col * self.depth / 8..];
        Pixel {
            grey: mean(self.colors.map(|at| pixel[at])),
            is_opaque: self.alpha.is_none_or(|at| pixel[at] == u8::MAX),
        }
    }
}

/// The bytes of red, green, blue and opacity, as the masks behind the first 40 bytes tell.
fn masks(bytes: &[u8], size: usize) -> Result<([usize; 3], Option<usize>), FormatError> {
    let mask = |i: usize| number(bytes, FILE_HEADER + INFO_HEADER + 4 * i, "a color mask");
    let byte = |mask: u32| {
        let at = (mask.trailing_zeros() / 8) as usize;
        let is_byte = mask != 0 && mask == 0xff << (8 * at);
        is_byte.then_some(at).ok_or_else(|| {
            let expected = "a whole byte; hint: save it as 8-bit grey";
            FormatProblem::bad_value("a color mask", format!("{mask:#x}"), expected)
        })
    };
    let colors = [byte(mask(0)?)?, byte(mask(1)?)?, byte(mask(2)?)?];
    // Only longer headers hold a mask of the opacity, and 0 says that there is none.
    let alpha = if size > INFO_HEADER + 12 { mask(3)? } else { 0 };
    let alpha = if alpha == 0 { None } else { Some(byte(alpha)?) };
    Ok((colors, alpha))
}

/// The greys of a palette: four bytes for each color, blue first.
fn palette(bytes: &[u8], at: usize, depth: usize) -> Result<Vec<u8>, FormatError> {
    if depth > 8 {
        return Ok(Vec::new());
    }
    let most = 1 << depth;
    let n_stated = number(bytes, 46, "the number of colors")? as usize;
    let n_colors = if n_stated == 0 {
        most
    } else {
        n_stated.min(most)
    };
    let range: Range<usize> = at..at + 4 * n_colors;
    let colors = bytes.get(range).ok_or(FormatProblem::Truncated {
        unit: "bytes",
        found: bytes.len(),
        needed: at + 4 * n_colors,
    })?;
    let colors = colors.chunks_exact(4);
    Ok(colors
        .map(|color| mean([color[2], color[1], color[0]]))
        .collect())
}

/// The rounded mean of red, green and blue.
fn mean(colors: [u8; 3]) -> u8 {
    let sum: u32 = colors.into_iter().map(u32::from).sum();
    ((sum + 1) / 3) as u8
}

/// The number of four bytes at a place, least significant first.
fn number(bytes: &[u8], at: usize, thing: &'static str) -> Result<u32, FormatError> {
    let hint = "the file ends before it";
    let four = bytes.get(at..at + 4).and_then(|four| four.try_into().ok());
    let four = four.ok_or(FormatProblem::Missing { thing, hint })?;
    Ok(u32::from_le_bytes(four))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bitmap of 2 columns; `behind` follows the first 40 bytes of the header.
    fn bitmap(depth: u16, height: i32, compression: u32, behind: &[u8], data: &[u8]) -> Vec<u8> {
        let size = if behind.len() == 16 { 56_u32 } else { 40 };
        let at = FILE_HEADER as u32 + 40 + behind.len() as u32;
        let mut bytes = b"BM\0\0\0\0\0\0\0\0".to_vec();
        bytes.extend(at.to_le_bytes());
        bytes.extend(size.to_le_bytes());
        bytes.extend(2_i32.to_le_bytes());
        bytes.extend(height.to_le_bytes());
        bytes.extend(1_u16.to_le_bytes());
        bytes.extend(depth.to_le_bytes());
        bytes.extend(compression.to_le_bytes());
        bytes.extend([0; 12]);
        let n_colors = if depth <= 8 {
            behind.len() as u32 / 4
        } else {
            0
        };
        bytes.extend(n_colors.to_le_bytes());
        bytes.extend([0; 4]);
        bytes.extend(behind);
        bytes.extend(data);
        bytes
    }

    #[test]
    fn reads_palettes_and_colors_from_below_and_from_above() {
        let palette = [0, 0, 0, 0, 30, 60, 90, 0];
        let eight = read(&bitmap(8, 2, 0, &palette, &[0, 1, 0, 0, 1, 1, 0, 0])).unwrap();
        assert_eq!((eight.n_cols, eight.n_rows), (2, 2));
        assert_eq!(eight.values, [60, 60, 0, 60]);
        let above = read(&bitmap(8, -2, 0, &palette, &[0, 1, 0, 0, 1, 1, 0, 0])).unwrap();
        assert_eq!(above.values, [0, 60, 60, 60]);
        let four = read(&bitmap(4, 1, 0, &palette, &[0x10, 0, 0, 0])).unwrap();
        assert_eq!(four.values, [60, 0]);
        let one = read(&bitmap(1, 1, 0, &palette, &[0b0100_0000, 0, 0, 0])).unwrap();
        assert_eq!(one.values, [0, 60]);
        let colors = read(&bitmap(24, 1, 0, &[], &[1, 2, 3, 255, 255, 255, 0, 0])).unwrap();
        assert_eq!((colors.values, colors.transparent), (vec![2, 255], None));
        let reserved = read(&bitmap(32, 1, 0, &[], &[1, 2, 3, 0, 9, 9, 9, 0])).unwrap();
        assert_eq!((reserved.values, reserved.transparent), (vec![2, 9], None));
    }

    #[test]
    fn transparency_counts_where_a_mask_tells_it() {
        let mask = |byte: u32| (0xff_u32 << (8 * byte)).to_le_bytes();
        let masks = [mask(1), mask(2), mask(3), mask(0)].concat();
        let data = [255, 1, 2, 3, 254, 9, 9, 9];
        let image = read(&bitmap(32, 1, 3, &masks, &data)).unwrap();
        assert_eq!(image.values, [2, 9]);
        assert_eq!(image.transparent, Some(vec![false, true]));
    }

    #[test]
    fn refuses_broken_files_and_those_of_other_kinds() {
        let whole = bitmap(8, 2, 0, &[0; 8], &[0; 8]);
        for end in 0..whole.len() {
            assert!(read(&whole[..end]).is_err(), "cut at {end}");
        }
        let message = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
        assert!(message(&bitmap(8, 2, 1, &[], &[])).contains("without compression"));
        assert!(message(&bitmap(16, 2, 0, &[], &[])).contains("the depth is 16"));
        assert!(message(&bitmap(24, i32::MIN, 0, &[], &[])).contains("the limit is"));
        assert!(message(&bitmap(24, 0, 0, &[], &[])).contains("2 x 0 cells"));
        assert!(message(&bitmap(32, 1, 3, &[7; 12], &[0; 8])).contains("a color mask"));
    }
}

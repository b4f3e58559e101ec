//! PNG images of any color type, as grey values and transparency.

use super::grey_image::{GreyImage, check_size};
use super::{FormatError, FormatProblem};
use png::{BitDepth, ColorType, Decoder, DecodingError, Encoder, Limits, Reader, Transformations};
use std::io::Cursor;

/// Largest decoded image: a 16-bit grey map of the largest size, or an 8-bit one with colors.
const MAX_DECODED_BYTES: usize = 1 << 30;
/// Deflate cannot shrink data further than this, so a smaller file lies about its size.
const MAX_DEFLATE_RATIO: usize = 1032;

/// Reads a PNG; palettes and low bit depths are expanded, colors averaged.
pub(super) fn read(bytes: &[u8]) -> Result<GreyImage, FormatError> {
    let limits = Limits { bytes: 64 << 20 };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    decoder.set_transformations(Transformations::EXPAND);
    let info = decoder.read_header_info().map_err(failed)?;
    let (n_cols, n_rows) = (info.width as usize, info.height as usize);
    check_size(n_cols, n_rows)?;
    let n_coded = info.raw_row_length().saturating_mul(n_rows);
    let needed = n_coded.div_ceil(MAX_DEFLATE_RATIO);
    if bytes.len() < needed {
        let (unit, found) = ("bytes", bytes.len());
        return Err(FormatProblem::Truncated {
            unit,
            found,
            needed,
        }
        .into());
    }
    // Lower bit depths are spread over 0..=255.
    let max_value = match info.bit_depth {
        BitDepth::Sixteen => u16::MAX,
        _ => 255,
    };
    let mut reader = decoder.read_info().map_err(failed)?;
    let decoded = decode(&mut reader)?;
    let (color, depth) = reader.output_color_type();
    let mut image = GreyImage {
        n_cols,
        n_rows,
        max_value,
        values: Vec::with_capacity(n_cols * n_rows),
        transparent: None,
    };
    if depth == BitDepth::Sixteen {
        let samples: Vec<u16> = decoded
            .chunks_exact(2)
            .map(|pair| u16::from_be_bytes([pair[0], pair[1]]))
            .collect();
        fill(&mut image, &samples, color);
    } else {
        fill(&mut image, &decoded, color);
    }
    Ok(image)
}

/// Writes an 8-bit grey PNG; `values` are rows from the top.
pub(super) fn write(n_cols: usize, n_rows: usize, values: &[u8]) -> Result<Vec<u8>, FormatError> {
    let failed = |e: png::EncodingError| FormatError::from(FormatProblem::Png(e.to_string()));
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, n_cols as u32, n_rows as u32);
    encoder.set_color(ColorType::Grayscale);
    encoder.set_depth(BitDepth::Eight);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(values).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

fn decode(reader: &mut Reader<Cursor<&[u8]>>) -> Result<Vec<u8>, FormatError> {
    let size = reader.output_buffer_size().unwrap_or(usize::MAX);
    if size > MAX_DECODED_BYTES {
        let expected = format!("at most {MAX_DECODED_BYTES} bytes; hint: save it as 8-bit grey");
        return Err(FormatProblem::bad_value("the decoded image", size, expected).into());
    }
    let mut decoded = vec![0; size];
    reader.next_frame(&mut decoded).map_err(failed)?;
    reader.finish().map_err(failed)?;
    Ok(decoded)
}

/// Splits samples into grey values and transparency.
fn fill<T: Copy + Into<u32> + PartialEq>(image: &mut GreyImage, samples: &[T], color: ColorType) {
    let opaque = u32::from(image.max_value);
    let n_channels = color.samples();
    let n_colors = match color {
        ColorType::Grayscale | ColorType::GrayscaleAlpha | ColorType::Indexed => 1,
        ColorType::Rgb | ColorType::Rgba => 3,
    };
    let pixels = samples.chunks_exact(n_channels);
    image.values.extend(pixels.clone().map(|pixel| {
        let sum: u32 = pixel[..n_colors].iter().map(|&c| c.into()).sum();
        ((sum + n_colors as u32 / 2) / n_colors as u32) as u16
    }));
    if n_channels > n_colors {
        image.transparent = Some(
            pixels
                .map(|pixel| pixel[n_colors].into() != opaque)
                .collect(),
        );
    }
}

#[allow(
    clippy::needless_pass_by_value,
    reason = "it stands in map_err, which hands errors over by value"
)]
fn failed(error: DecodingError) -> FormatError {
    FormatProblem::Png(error.to_string()).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encode(color: ColorType, depth: BitDepth, size: (u32, u32), data: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, size.0, size.1);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if color == ColorType::Indexed {
            encoder.set_palette(vec![0, 0, 0, 30, 60, 90]);
            encoder.set_trns(vec![255, 128]);
        }
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(data).unwrap();
        writer.finish().unwrap();
        bytes
    }

    fn decode(color: ColorType, depth: BitDepth, data: &[u8]) -> GreyImage {
        read(&encode(color, depth, (2, 1), data)).unwrap()
    }

    #[test]
    fn reads_every_color_type() {
        use BitDepth::{Eight, One, Sixteen};
        let grey = decode(ColorType::Grayscale, Eight, &[7, 200]);
        assert_eq!((grey.values, grey.transparent), (vec![7, 200], None));
        let deep = decode(ColorType::Grayscale, Sixteen, &[1, 0, 255, 255]);
        assert_eq!((deep.values, deep.max_value), (vec![256, 65535], 65535));
        let bits = decode(ColorType::Grayscale, One, &[0b0100_0000]);
        assert_eq!((bits.values, bits.max_value), (vec![0, 255], 255));
        let alpha = decode(ColorType::GrayscaleAlpha, Eight, &[7, 255, 8, 254]);
        assert_eq!(alpha.values, [7, 8]);
        assert_eq!(alpha.transparent, Some(vec![false, true]));
        let colors = decode(ColorType::Rgb, Eight, &[1, 2, 3, 255, 255, 255]);
        assert_eq!((colors.values, colors.transparent), (vec![2, 255], None));
        let both = decode(ColorType::Rgba, Eight, &[1, 1, 3, 0, 9, 9, 9, 255]);
        assert_eq!(both.values, [2, 9]);
        assert_eq!(both.transparent, Some(vec![true, false]));
        let palette = decode(ColorType::Indexed, One, &[0b0100_0000]);
        assert_eq!(palette.values, [0, 60]);
        assert_eq!(palette.transparent, Some(vec![false, true]));
    }

    #[test]
    fn refuses_lying_and_broken_files() {
        let whole = encode(ColorType::Grayscale, BitDepth::Eight, (20, 20), &[9; 400]);
        for end in 0..whole.len() - 12 {
            assert!(read(&whole[..end]).is_err(), "cut at {end}");
        }
        let message = |width: u32, height: u32| {
            let mut bytes = whole.clone();
            bytes[16..20].copy_from_slice(&width.to_be_bytes());
            bytes[20..24].copy_from_slice(&height.to_be_bytes());
            // Checksums of the header are right again, so that the size itself is judged.
            let crc = crc(&bytes[12..29]).to_be_bytes();
            bytes[29..33].copy_from_slice(&crc);
            read(&bytes).unwrap_err().to_string()
        };
        let bomb = message(1_000_000_000, 1_000_000_000);
        assert!(bomb.contains("the limit is"), "{bomb}");
        let lie = message(16_000, 16_000);
        assert!(lie.contains("cut short"), "{lie}");
    }

    /// CRC-32 as PNG uses it, bit by bit.
    fn crc(bytes: &[u8]) -> u32 {
        !bytes.iter().fold(u32::MAX, |crc, &byte| {
            (0..8).fold(crc ^ u32::from(byte), |c, _| {
                (c >> 1) ^ (0xEDB8_8320 * (c & 1))
            })
        })
    }
}

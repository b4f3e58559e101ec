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
    // A low bit depth is spread over 0..=255, so that the values are not the file's own.
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
    let n_channels = color.samples();
    if depth == BitDepth::Sixteen {
        let samples: Vec<u16> = decoded
            .chunks_exact(2)
            .map(|pair| u16::from_be_bytes([pair[0], pair[1]]))
            .collect();
        fill(&mut image, &samples, color);
    } else {
        fill(&mut image, &decoded, color);
    }
    check_decoded(&image, n_channels)?;
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

fn check_decoded(image: &GreyImage, n_channels: usize) -> Result<(), FormatError> {
    let (found, needed) = (image.values.len(), image.n_cols * image.n_rows);
    if found == needed {
        return Ok(());
    }
    let problem = format!("{found} pixels of {n_channels} channels decoded instead of {needed}");
    Err(FormatProblem::Png(problem).into())
}

#[allow(
    clippy::needless_pass_by_value,
    reason = "it stands in map_err, which hands errors over by value"
)]
fn failed(error: DecodingError) -> FormatError {
    FormatProblem::Png(error.to_string()).into()
}

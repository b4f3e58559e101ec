//! Films: pictures after each other as an animated GIF.

use super::png::RenderError;
use super::quantize::{Census, MAX_COLORS, bin};
use super::{Picture, palette};
use ::gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};
use std::borrow::Cow;

/// The time that a picture stays, in hundredths of a second.
const DELAY_CS: u16 = 12;
/// The time that the last one stays.
const LAST_DELAY_CS: u16 = 150;
/// The place in the palette that means: as before.
const UNCHANGED: u8 = MAX_COLORS as u8;

/// A film that begins anew after its last picture, `width_px` wide and as high as the highest.
///
/// All pictures share one palette of 255 colors, and each holds only what changes.
///
/// # Errors
/// No picture, a width that some picture cannot have, more than 65535 pixels to a side.
pub fn to_gif(pictures: &[Picture], width_px: u32) -> Result<Vec<u8>, RenderError> {
    let refused = |reason: &str| RenderError::Film {
        n_pictures: pictures.len(),
        width_px,
        reason: reason.to_owned(),
    };
    let mut census = Census::default();
    let mut pages = Vec::new();
    for picture in pictures {
        pages.push(binned(picture, width_px, &mut census)?);
    }
    let n_pixels = pages.iter().map(Vec::len).max();
    let n_pixels = n_pixels.ok_or_else(|| refused("it has no picture"))?;
    let side = |px: usize| u16::try_from(px).map_err(|_| refused("a side is beyond 65535 px"));
    let size = [
        side(width_px as usize)?,
        side(n_pixels / width_px as usize)?,
    ];
    let blank = bin([palette::PAGE.red, palette::PAGE.green, palette::PAGE.blue]);
    for page in &mut pages {
        page.resize(n_pixels, blank);
    }
    encoded(&pages, size, &census).map_err(|error| refused(&error.to_string()))
}

/// The pixels of a picture as bins of color.
fn binned(picture: &Picture, width_px: u32, census: &mut Census) -> Result<Vec<u16>, RenderError> {
    let pixels = picture.rasterized(width_px)?;
    let colors = pixels.data().chunks_exact(4);
    Ok(colors.map(|p| census.count([p[0], p[1], p[2]])).collect())
}

fn encoded(
    pages: &[Vec<u16>],
    [width, height]: [u16; 2],
    census: &Census,
) -> Result<Vec<u8>, EncodingError> {
    let (colors, place_of_bin) = census.palette();
    let rgb: Vec<u8> = colors.iter().flatten().copied().collect();
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height, &rgb)?;
    encoder.set_repeat(Repeat::Infinite)?;
    let mut shown: Vec<u8> = Vec::new();
    for (i, page) in pages.iter().enumerate() {
        let places: Vec<u8> = page
            .iter()
            .map(|&bin| place_of_bin[usize::from(bin)])
            .collect();
        let mut frame = changes(&shown, &places, usize::from(width));
        frame.delay = if i + 1 == pages.len() {
            LAST_DELAY_CS
        } else {
            DELAY_CS
        };
        encoder.write_frame(&frame)?;
        shown = places;
    }
    drop(encoder);
    Ok(file)
}

/// The rectangle in which a page differs from what is shown; all of the first page.
fn changes(shown: &[u8], page: &[u8], width: usize) -> Frame<'static> {
    let is_changed = |i: usize| shown.get(i) != Some(&page[i]);
    let changed = || (0..page.len()).filter(|&i| is_changed(i));
    let span = |along: fn(usize, usize) -> usize| {
        let places = changed().map(|i| along(i, width));
        let (low, high) = places.fold((usize::MAX, 0), |(low, high), at| {
            (low.min(at), high.max(at))
        });
        // Where nothing changes, one pixel.
        low.min(high)..high + 1
    };
    let (cols, rows) = (span(|i, width| i % width), span(|i, width| i / width));
    let places = rows
        .clone()
        .flat_map(|row| cols.clone().map(move |col| row * width + col));
    let buffer: Vec<u8> = places
        .map(|i| if is_changed(i) { page[i] } else { UNCHANGED })
        .collect();
    Frame {
        left: cols.start as u16,
        top: rows.start as u16,
        width: cols.len() as u16,
        height: rows.len() as u16,
        transparent: Some(UNCHANGED),
        dispose: DisposalMethod::Keep,
        buffer: Cow::Owned(buffer),
        ..Frame::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_holds_what_changes() {
        let shown = [1, 1, 1, 1, 1, 1];
        let frame = changes(&shown, &[1, 1, 1, 1, 2, 3], 3);
        assert_eq!(
            [frame.left, frame.top, frame.width, frame.height],
            [1, 1, 2, 1]
        );
        assert_eq!(*frame.buffer, [2, 3]);
        let frame = changes(&shown, &[2, 1, 1, 1, 1, 2], 3);
        assert_eq!(*frame.buffer, [2, 255, 255, 255, 255, 2]);
        assert_eq!(*changes(&shown, &shown, 3).buffer, [UNCHANGED]);
        assert_eq!(*changes(&[], &shown, 3).buffer, shown);
    }
}

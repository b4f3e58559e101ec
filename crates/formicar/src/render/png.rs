//! Pictures as PNG files.

use super::Picture;
use resvg::{tiny_skia, usvg};
use thiserror::Error;

/// Most pixels of a picture: 2^28, a gigabyte of memory.
const MAX_PIXELS: f64 = 268_435_456.0;

/// The reason why a picture could not become pixels.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RenderError {
    /// A width that the picture cannot have.
    #[error("picture width {width_px} px; this picture can be 1 to {limit_px} px wide")]
    BadWidth {
        /// The width asked for.
        width_px: u32,
        /// The largest that is allowed.
        limit_px: u32,
    },
    /// The rasterizer failed on a picture of ours.
    #[error("the picture could not be rasterized: {0}")]
    Rasterize(String),
    /// A film that a GIF cannot hold.
    #[cfg(feature = "gif-pictures")]
    #[error("a film of {n_pictures} pictures, {width_px} px wide, does not fit a GIF: {reason}")]
    Film {
        /// The number of pictures.
        n_pictures: usize,
        /// The width asked for.
        width_px: u32,
        /// The reason.
        reason: String,
    },
}

impl Picture {
    /// The picture as a PNG file, `width_px` wide; its height follows.
    ///
    /// # Errors
    /// A width of 0, or one that makes an image of more than 2^28 pixels.
    pub fn to_png(&self, width_px: u32) -> Result<Vec<u8>, RenderError> {
        let pixels = self.rasterized(width_px)?;
        let png = pixels.encode_png();
        png.map_err(|error| RenderError::Rasterize(error.to_string()))
    }

    /// Its pixels, all of them opaque.
    pub(super) fn rasterized(&self, width_px: u32) -> Result<tiny_skia::Pixmap, RenderError> {
        let options = usvg::Options::default();
        let tree = usvg::Tree::from_str(&self.to_svg(), &options)
            .map_err(|error| RenderError::Rasterize(error.to_string()))?;
        let size = tree.size();
        let ratio = f64::from(size.height()) / f64::from(size.width());
        let limit_px = (MAX_PIXELS / ratio).sqrt() as u32;
        if !(1..=limit_px).contains(&width_px) {
            return Err(RenderError::BadWidth { width_px, limit_px });
        }
        let height_px = (f64::from(width_px) * ratio).round().max(1.0) as u32;
        let mut pixels = tiny_skia::Pixmap::new(width_px, height_px)
            .ok_or(RenderError::BadWidth { width_px, limit_px })?;
        let scale = width_px as f32 / size.width();
        let transform = tiny_skia::Transform::from_scale(scale, scale);
        resvg::render(&tree, transform, &mut pixels.as_mut());
        Ok(pixels)
    }
}

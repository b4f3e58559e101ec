//! A whole picture, and its two file formats.

use thiserror::Error;

/// Why a picture could not become a PNG.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// A width that no picture can have.
    #[error("picture width {width_px} px; it must be 1 to {limit_px} for this picture")]
    BadWidth {
        /// The width asked for.
        width_px: u32,
        /// The largest that is allowed.
        limit_px: u32,
    },
    /// The rasteriser failed on a picture of ours.
    #[error("the picture could not be rasterized: {0}")]
    Rasterize(String),
}

/// A scene with its title above and its charts below or beside it.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// The heading; empty for none.
    pub title: String,
    /// Key numbers or a reason, under the title; empty for none.
    pub caption: String,
}

impl Picture {
    /// The picture as an SVG document.
    pub fn to_svg(&self) -> String {
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"10\" height=\"10\"/>".to_owned()
    }

    /// The picture as a PNG file, `width_px` wide; its height follows.
    ///
    /// # Errors
    /// A width of 0 or one that needs an image of more than 2^28 pixels.
    #[cfg(feature = "png-pictures")]
    pub fn to_png(&self, width_px: u32) -> Result<Vec<u8>, RenderError> {
        let _ = width_px;
        Ok(Vec::new())
    }
}

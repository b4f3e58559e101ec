//! Blocks: the parts of a section of a report.

use super::Table;
use super::plot::{BoxPlot, PairedPlot, Trends};
use formicar::render::Picture;
use serde::Serialize;

/// A part of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// A table.
    Table(Table),
    /// A picture that is drawn already.
    Figure(Figure),
    /// Values of groups.
    BoxPlot(BoxPlot),
    /// Differences of pairs.
    Paired(PairedPlot),
    /// Medians and quartiles along a run.
    Trends(Trends),
}

/// A picture with its caption.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Figure {
    /// The words below it.
    pub caption: String,
    /// The picture as SVG.
    pub svg: String,
}

impl Figure {
    /// A picture of the library with its caption.
    pub fn new(caption: &str, picture: &Picture) -> Self {
        Self {
            caption: caption.to_owned(),
            svg: picture.to_svg(),
        }
    }
}

impl Block {
    /// The block as a picture with its caption; `None` for text and tables.
    pub fn figure(&self) -> Option<Figure> {
        let svg = match self {
            Self::Text(_) | Self::Table(_) => return None,
            Self::Figure(figure) => return Some(figure.clone()),
            Self::BoxPlot(plot) => plot.to_svg(),
            Self::Paired(plot) => plot.to_svg(),
            Self::Trends(plot) => plot.to_svg(),
        };
        let caption = self.figure_caption()?.to_owned();
        Some(Figure { caption, svg })
    }

    /// The caption of a picture; `None` for text and tables.
    pub(super) fn figure_caption(&self) -> Option<&str> {
        match self {
            Self::Text(_) | Self::Table(_) => None,
            Self::Figure(figure) => Some(&figure.caption),
            Self::BoxPlot(plot) => Some(&plot.caption),
            Self::Paired(plot) => Some(&plot.caption),
            Self::Trends(plot) => Some(&plot.caption),
        }
    }
}

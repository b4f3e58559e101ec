//! What stands in a section of a report.

use super::Table;
use super::plot::{Bands, BoxPlot, PairedPlot};
use serde::Serialize;

/// What stands in a section.
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
    Bands(Bands),
}

/// A picture with its caption.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Figure {
    /// What it shows.
    pub caption: String,
    /// The picture as SVG.
    pub svg: String,
}

impl Block {
    /// The block as a picture with its caption; none of text and tables.
    pub fn figure(&self) -> Option<Figure> {
        let (caption, svg) = match self {
            Self::Text(_) | Self::Table(_) => return None,
            Self::Figure(figure) => (&figure.caption, figure.svg.clone()),
            Self::BoxPlot(plot) => (&plot.caption, plot.to_svg()),
            Self::Paired(plot) => (&plot.caption, plot.to_svg()),
            Self::Bands(plot) => (&plot.caption, plot.to_svg()),
        };
        Some(Figure {
            caption: caption.clone(),
            svg,
        })
    }

    /// The caption of a picture; none of text and tables.
    pub(super) fn figure_caption(&self) -> Option<&str> {
        match self {
            Self::Text(_) | Self::Table(_) => None,
            Self::Figure(figure) => Some(&figure.caption),
            Self::BoxPlot(plot) => Some(&plot.caption),
            Self::Paired(plot) => Some(&plot.caption),
            Self::Bands(plot) => Some(&plot.caption),
        }
    }
}

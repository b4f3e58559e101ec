//! The looks of layers, as values.

use super::palette::{self, Color};

/// Room for coordinates left of a panel or plot.
pub(super) const LEFT_PX: f64 = 44.0;
/// Width of charts beside a scene, or without one.
pub(super) const COLUMN_PX: f64 = 460.0;

/// The room that a picture has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// A page or a screen: up to about 1200 px wide, charts beside or below the map.
    #[default]
    Page,
    /// A phone held upright: about 400 px wide, everything below each other.
    Phone,
}

/// The dashes of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dash {
    /// Not at all.
    #[default]
    Solid,
    /// Long strokes.
    Dashed,
    /// Short strokes.
    Dotted,
    /// Long and short strokes in turn.
    DashDotted,
}

impl Dash {
    /// The pattern in pixels for a line of a width, as SVG wants it.
    pub(super) fn pattern(self) -> Option<&'static str> {
        match self {
            Self::Solid => None,
            Self::Dashed => Some("7 4"),
            Self::Dotted => Some("2 3.5"),
            Self::DashDotted => Some("9 3 2 3"),
        }
    }
}

/// A line with its name in the legend.
#[derive(Clone, Debug, PartialEq)]
pub struct LineStyle {
    /// Its name; empty to stay out of the legend.
    pub label: String,
    /// Its color.
    pub color: Color,
    /// Its width in pixels of a picture about 1200 wide.
    pub width_px: f64,
    /// Its dashes.
    pub dash: Dash,
}

/// A set of cells with its name in the legend.
#[derive(Clone, Debug, PartialEq)]
pub struct CellStyle {
    /// Its name; empty to stay out of the legend.
    pub label: String,
    /// Its color.
    pub color: Color,
}

impl CellStyle {
    /// Cells by which obstacles were grown.
    pub fn expanded() -> Self {
        Self {
            label: "expanded".to_owned(),
            color: palette::EXPANDED,
        }
    }

    /// Cells of closed U-shapes (Lei 2020).
    pub fn closed() -> Self {
        Self {
            label: "closed U-shape".to_owned(),
            color: palette::CLOSED,
        }
    }
}

/// The end of a path that a pose marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoseMark {
    /// The start pose.
    Start,
    /// The goal pose.
    Goal,
}

/// A clearance with its unit, to the millimeter where it is small; contact has a word of its own.
pub(super) fn clearance_label(clearance_m: f64) -> String {
    if clearance_m == 0.0 {
        "contact".to_owned()
    } else if clearance_m < 0.1 {
        format!("{clearance_m:.3} m")
    } else {
        format!("{clearance_m:.2} m")
    }
}

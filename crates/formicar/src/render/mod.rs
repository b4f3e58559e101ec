//! Pictures: scenes of maps and paths, ants, charts, as SVG and (feature `png-pictures`) PNG;
//! films as GIF (feature `gif-pictures`).
//!
//! Renderers draw what they are handed and compute nothing about it: clearances, profiles and
//! limits come in as values. The same input gives the same bytes. Text is drawn as strokes, so
//! that no font is needed and a picture looks the same everywhere.

#[cfg(feature = "serde")]
mod answer;
mod ants;
mod cells;
mod chart;
mod colony;
mod drive;
mod focus;
#[cfg(feature = "gif-pictures")]
mod gif;
mod heat;
mod labels;
mod legend;
mod lettering;
mod marks;
mod markup;
pub mod palette;
mod panel;
mod picture;
mod plan;
mod plan_parts;
#[cfg(feature = "png-pictures")]
mod png;
#[cfg(feature = "gif-pictures")]
mod quantize;
mod scene;
mod space_time;
mod style;
mod svg;
mod ticks;
mod view;

#[cfg(feature = "serde")]
pub use answer::{AnswerPicture, answer_picture};
pub use chart::{
    Axis, AxisScale, Band, BoxRow, Chart, ChartGrid, DotFill, Dots, Limit, ProfilePoint, Ribbon,
    SERIES_COLORS, SERIES_LOOKS, Series, Side, YRange, convergence_charts, strip_charts,
};
pub use colony::{ColonyPicture, colony_film, colony_picture};
pub use drive::{DrivePicture, drive_charts, drive_picture};
#[cfg(feature = "gif-pictures")]
pub use gif::to_gif;
pub use markup::{Element, Markup, escape, html_page};
pub use palette::Color;
pub use picture::Picture;
pub use plan::{plan_picture, plan_picture_in};
pub use plan_parts::PlanPicture;
#[cfg(feature = "png-pictures")]
pub use png::RenderError;
pub use scene::Scene;
pub use space_time::space_time_charts;
pub use style::{CellStyle, Dash, Layout, LineStyle, PoseMark};

//! Charts of measured values: their description for JSON, and their statistics as charts of the
//! library.

mod box_plot;
mod paired;
mod trends;

pub use box_plot::{BoxGroup, BoxPlot};
pub use paired::{PairedPanel, PairedPlot};
pub use trends::{Trend, TrendPanel, Trends};

//! Charts of measured values, drawn for a light page and readable in greyscale: text as text, so
//! that it can be searched, and nothing that is not in the page itself.

mod axis;
mod bands;
mod box_plot;
mod canvas;
mod paired;

pub use axis::ScaleKind;
pub use bands::{BandPanel, Bands, Course};
pub use box_plot::{BoxGroup, BoxPlot};
pub use paired::{PairedPanel, PairedPlot};

//! Results as a document: sections of text, tables and figures, written as a page, as Markdown, as
//! LaTeX, as JSON and as CSV from one description.

mod block;
mod field;
mod html;
mod json;
mod keys;
mod latex;
mod markdown;
mod numbers;
mod ompl_log;
mod overlay;
mod parameters;
mod plot;
mod provenance;
mod table;
mod verdict;

pub use block::{Block, Figure};
pub use field::Field;
pub use html::{Fact, Page, page};
pub use json::json;
pub use latex::latex;
pub use markdown::markdown;
pub use numbers::numbers_csv;
pub use ompl_log::{OmplLog, OmplPlanner, OmplRun, Property, PropertyKind};
pub use overlay::{Overlay, OverlayPath, strips};
pub use parameters::Source;
pub(crate) use parameters::leaves;
pub use plot::{BoxGroup, BoxPlot, PairedPanel, PairedPlot, Trend, TrendPanel, Trends};
pub use provenance::config_hash;
pub use table::{Column, Row, Table};
pub use verdict::Verdict;

/// Words longer than this are set in several lines.
const PROSE_CHARS: usize = 34;

/// A document; words between backticks are set as code.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// The prefix of the names of numbers and tables; of a reproduction also its folder.
    pub name: String,
    /// The heading.
    pub title: String,
    /// The contents of the tables, in a paragraph.
    pub intro: String,
    /// The sections in order.
    pub sections: Vec<Section>,
}

/// A part of a document under a heading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// The heading.
    pub heading: String,
    /// Its contents.
    pub blocks: Vec<Block>,
}

impl Section {
    /// A section of some blocks.
    pub fn new(heading: impl Into<String>, blocks: Vec<Block>) -> Self {
        Self {
            heading: heading.into(),
            blocks,
        }
    }

    /// A section of one table.
    pub fn of_table(heading: &str, table: Table) -> Self {
        Self::new(heading, vec![Block::Table(table)])
    }
}

impl Report {
    /// All tables in order.
    pub fn tables(&self) -> impl Iterator<Item = &Table> {
        let blocks = self.sections.iter().flat_map(|section| &section.blocks);
        blocks.filter_map(|block| match block {
            Block::Table(table) => Some(table),
            _ => None,
        })
    }
}

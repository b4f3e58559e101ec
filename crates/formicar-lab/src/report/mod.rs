//! Results as a document: sections of text, tables and figures, written as a page, as Markdown and
//! as LaTeX from one description.

mod field;
mod html;
mod keys;
mod latex;
mod markdown;
mod table;

pub use field::Field;
pub use html::{Fact, Page, page};
pub use latex::latex;
pub use markdown::markdown;
pub use table::{Row, Table};

/// A document; words between backticks are set as code.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// What the folder and the names of numbers begin with: a word.
    pub name: String,
    /// The heading.
    pub title: String,
    /// What the tables hold, in a paragraph.
    pub intro: String,
    /// The sections in order.
    pub sections: Vec<Section>,
}

/// A part of a document under a heading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// The heading.
    pub heading: String,
    /// What stands below it.
    pub blocks: Vec<Block>,
}

/// What stands in a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// A table.
    Table(Table),
    /// A picture.
    Figure(Figure),
}

/// A picture with its caption.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// What it shows.
    pub caption: String,
    /// The picture as SVG.
    pub svg: String,
}

impl Section {
    /// A section of one table.
    pub fn of_table(heading: &str, table: Table) -> Self {
        Self {
            heading: heading.to_owned(),
            blocks: vec![Block::Table(table)],
        }
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

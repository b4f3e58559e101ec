//! Which figure or table of a paper is which part of a page.

use crate::report::{Block, Field, Section, Table};

/// A figure or table of the paper: its name there, where it is here, and a remark.
pub(crate) type Place = [&'static str; 3];

/// What stands where a figure is not made.
pub(crate) const NOT_MADE: &str = "not made";

/// All figures and tables of a paper, for the end of a page.
pub(crate) fn section(places: &[Place]) -> Section {
    let caption = "Every figure and table of the paper. Drawings of a concept hold nothing to \
                   measure; photographs show the authors' machine.";
    let mut table = Table::new("figures", &["paper", "here", "remark"]).captioned(caption);
    for place in places {
        table.row(place.iter().map(|words| Field::words(words)).collect());
    }
    Section {
        heading: "Figures and tables of the paper".to_owned(),
        blocks: vec![Block::Table(table)],
    }
}

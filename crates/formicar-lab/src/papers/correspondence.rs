//! The part of a page that shows each figure and table of a paper.

use crate::report::{Field, Section, Table};

/// All figures and tables of a paper, for the end of a page. `places` has a line for each: its
/// name in the paper, its place here, and a remark, between bars.
pub(crate) fn section(places: &str) -> Section {
    let caption = "Every figure and table of the paper. Drawings of a concept hold nothing to \
                   measure; photographs show the authors' machine.";
    let mut table = Table::new("figures", &["paper", "here", "remark"]).captioned(caption);
    for line in places.lines() {
        table.row(line.split(" | ").map(Field::words).collect());
    }
    Section::of_table("Figures and tables of the paper", table)
}

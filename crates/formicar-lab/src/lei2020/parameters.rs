//! Where the parameters come from.

use super::variants::variants;
use crate::experiment::Ground;
use crate::report::{Block, Known, ParameterSheet, Section, Source};
use anyhow::Result;

const PARTS: [&str; 3] = ["colony", "layers", "smoothing"];

const KNOWN: [Known; 1] = [("colony.n_ants", Source::Stated, "sec. IV.B")];

pub(super) fn section(ground: &Ground) -> Result<Section> {
    let improved = variants(ground)
        .into_iter()
        .find(|variant| variant.name == super::IMPROVED);
    let config = serde_json::to_value(improved.map(|variant| variant.config))?;
    let sheet = ParameterSheet::new(&config, &PARTS, &KNOWN);
    Ok(Section {
        heading: "Parameters".to_owned(),
        blocks: vec![Block::Table(sheet.table("parameters"))],
    })
}

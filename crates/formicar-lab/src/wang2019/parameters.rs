//! Where the parameters come from.

use super::PROPOSED;
use crate::report::{Block, Known, ParameterSheet, Section, Source};
use anyhow::Result;

const PARTS: [&str; 2] = ["colony", "layers"];

const KNOWN: [Known; 1] = [("colony.n_ants", Source::Read, "")];

pub(super) fn section() -> Result<Section> {
    let variants = super::variants();
    let own = variants.iter().find(|variant| variant.name == PROPOSED);
    let config = serde_json::to_value(own.map(|variant| &variant.config))?;
    let sheet = ParameterSheet::new(&config, &PARTS, &KNOWN);
    Ok(Section {
        heading: "Parameters".to_owned(),
        blocks: vec![Block::Table(sheet.table("parameters"))],
    })
}

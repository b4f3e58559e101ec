//! Parameter sheets from the tables of the library's `references`.

use crate::experiment::Variant;
use crate::report::{Block, Known, ParameterSheet, Section, Source};
use anyhow::Result;

pub(crate) const LEI2020: &str = include_str!("../../formicar/references/lei2020.md");
pub(crate) const WANG2019: &str = include_str!("../../formicar/references/wang2019.md");
pub(crate) const LI2024: &str = include_str!("../../formicar/references/li2024.md");

/// The configuration of a variant, each parameter with its origin as the reference of its paper
/// states it.
pub(crate) fn section(reference: &str, variant: &Variant) -> Result<Section> {
    let config = serde_json::to_value(&variant.config)?;
    let known = known(reference);
    let parts: Vec<&str> = known
        .iter()
        .filter_map(|known| known.0.split('.').next())
        .collect();
    let sheet = ParameterSheet::new(&config, &parts, &known);
    Ok(Section {
        heading: "Parameters".to_owned(),
        blocks: vec![Block::Table(sheet.table("parameters"))],
    })
}

/// The rows of the first table of parameters: `| key | value | origin | from |`.
fn known(reference: &str) -> Vec<Known<'_>> {
    let lines = reference.lines();
    let rows = lines.skip_while(|line| row(line).is_none());
    rows.map_while(row).collect()
}

fn row(line: &str) -> Option<Known<'_>> {
    let fields: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
    let [key, _, origin, from] = fields[..] else {
        return None;
    };
    let source = match origin {
        "stated" => Source::Stated,
        "read" => Source::Read,
        "chosen" => Source::Chosen,
        "tuned" => Source::Tuned,
        _ => return None,
    };
    Some((key.trim_matches('`'), source, from))
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::planner::PlannerName;

    #[test]
    fn references_know_every_parameter() {
        for (reference, planner, n_least) in [
            (LEI2020, PlannerName::Lei2020, 40),
            (WANG2019, PlannerName::Wang2019, 35),
            (LI2024, PlannerName::Faco2024, 40),
        ] {
            let known = known(reference);
            assert!(known.len() >= n_least, "{planner:?}: {}", known.len());
            let config = serde_json::to_value(Variant::of(planner).config).unwrap();
            let mut sheet = ParameterSheet::new(&config, &["colony", "chords", "layers"], &known);
            sheet
                .parameters
                .retain(|parameter| parameter.note.is_empty());
            assert_eq!(sheet.parameters, [], "{planner:?}");
        }
    }
}

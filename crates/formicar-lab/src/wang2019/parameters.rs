//! Where the parameters come from.

use super::PROPOSED;
use crate::report::{Block, Known, ParameterSheet, Section, Source};
use anyhow::Result;

const PARTS: [&str; 2] = ["colony", "layers"];

const KNOWN: [Known; 17] = [
    ("colony.n_ants", Source::Stated, "sec. 4"),
    ("colony.n_iterations", Source::Stated, "sec. 4"),
    ("colony.alpha", Source::Stated, "sec. 4"),
    ("colony.visibility.beta", Source::Stated, "sec. 4"),
    ("colony.guidance.gamma", Source::Stated, "sec. 4"),
    ("colony.evaporation", Source::Stated, "sec. 4"),
    ("colony.deposit", Source::Stated, "eq. 10-12, sec. 4"),
    ("colony.diagonal_rule", Source::Stated, "eq. 3-6"),
    ("colony.directions", Source::Stated, "fig. 2"),
    (
        "colony.cost",
        Source::Stated,
        "eq. 7: 1 and the square root of 2, turns cost nothing",
    ),
    (
        "colony.guidance.rule",
        Source::Stated,
        "eq. 8-9: the shortest safe distance to the goal",
    ),
    (
        "colony.guidance.floor_cells",
        Source::Read,
        "eq. 9 has no value at the goal",
    ),
    (
        "colony.visibility.rule",
        Source::Read,
        "to the letter, 1/d of a step, ways are longer",
    ),
    (
        "colony.visibility.floor_cells",
        Source::Read,
        "no value at the goal",
    ),
    (
        "colony.initial",
        Source::Read,
        "8, as in code that circulates",
    ),
    (
        "colony.limits",
        Source::Read,
        "the penalty of the worst way needs a floor",
    ),
    (
        "colony.trails",
        Source::Read,
        "eq. 10: pheromone of the step from i to j",
    ),
];

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::Variant;
    use formicar::planner::PlannerName;

    #[test]
    fn every_known_key_is_in_the_configuration() {
        let variant = Variant::of(PlannerName::Wang2019);
        let config = serde_json::to_value(&variant.config).unwrap();
        assert_eq!(ParameterSheet::unknown(&config, &KNOWN), [""; 0]);
    }
}

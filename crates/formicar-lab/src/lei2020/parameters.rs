//! Where the parameters come from.

use super::variants::{IMPROVED, variants};
use crate::experiment::Ground;
use crate::report::{Block, Known, ParameterSheet, Section, Source};
use anyhow::Result;

const PARTS: [&str; 3] = ["colony", "layers", "smoothing"];

const KNOWN: [Known; 27] = [
    (
        "colony.n_ants",
        Source::Stated,
        "M, sec. IV.B; 1000 on maps 2 and 3",
    ),
    (
        "colony.n_iterations",
        Source::Stated,
        "N, sec. IV.B; 200 on maps 2 and 3",
    ),
    ("colony.alpha", Source::Stated, "sec. IV.B"),
    ("colony.visibility.beta", Source::Stated, "sec. IV.B"),
    (
        "colony.visibility.rule",
        Source::Read,
        "eq. 2: eta is not defined",
    ),
    (
        "colony.visibility.floor_cells",
        Source::Read,
        "eq. 2: eta is not defined",
    ),
    ("colony.cost.diagonal_length", Source::Stated, "eq. 3"),
    (
        "colony.cost.length_weight",
        Source::Read,
        "eq. 3: A is not given",
    ),
    (
        "colony.cost.turn_weight",
        Source::Read,
        "eq. 3: B is not given",
    ),
    (
        "colony.deposit",
        Source::Read,
        "who deposits, and Q, are not given",
    ),
    ("colony.evaporation.rule", Source::Stated, "eq. 1"),
    ("colony.evaporation.lambda", Source::Stated, "eq. 1, fig. 5"),
    ("colony.evaporation.amplitude", Source::Stated, "A, fig. 5"),
    (
        "colony.evaporation.offset",
        Source::Read,
        "B is not given: rho stays between 0 and 1",
    ),
    (
        "colony.evaporation.stretch",
        Source::Read,
        "1 is to the letter; fig. 5 puts the trough in mid-run",
    ),
    ("colony.initial.rule", Source::Stated, "sec. II.D"),
    (
        "colony.initial.tau_min",
        Source::Read,
        "fig. 4 gives no numbers",
    ),
    (
        "colony.initial.tau_max",
        Source::Read,
        "fig. 4 gives no numbers",
    ),
    (
        "colony.initial.unit",
        Source::Read,
        "so that first deposits do not swamp the gradient",
    ),
    ("colony.transition", Source::Stated, "eq. 2, sec. II.F"),
    ("colony.directions", Source::Stated, "fig. 6"),
    ("colony.diagonal_rule", Source::Read, "no corner is cut"),
    (
        "colony.dead_end",
        Source::Read,
        "an ant without a next cell is lost",
    ),
    ("layers.expansion", Source::Stated, "sec. II.B"),
    (
        "layers.u_shapes",
        Source::Stated,
        "sec. II.C; closed only where no way is lengthened",
    ),
    (
        "smoothing.redundant_nodes",
        Source::Stated,
        "sec. III.A, eq. 4-5",
    ),
    (
        "smoothing.corners",
        Source::Stated,
        "sec. III.B; where 2-turning has no room, shortest curves (read)",
    ),
];

pub(super) fn section(ground: &Ground) -> Result<Section> {
    let variants = variants(ground);
    let improved = variants.iter().find(|variant| variant.name == IMPROVED);
    let config = serde_json::to_value(improved.map(|variant| &variant.config))?;
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
        let variant = Variant::of(PlannerName::Lei2020);
        let config = serde_json::to_value(&variant.config).unwrap();
        assert_eq!(ParameterSheet::unknown(&config, &KNOWN), [""; 0]);
    }
}

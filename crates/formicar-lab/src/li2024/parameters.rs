//! Where the parameters of the proposed method come from.

use super::methods::PROPOSED;
use crate::experiment::Variant;
use crate::report::{Block, Known, ParameterSheet, Section, Source};
use anyhow::Result;

const PARTS: [&str; 2] = ["chords", "smoothing"];

const TUNED: &str = "sec. 5.2: found by the paper with an artificial bee colony";

const KNOWN: [Known; 31] = [
    ("chords.corner.epsilon", Source::Stated, TUNED),
    ("chords.cost.epsilon", Source::Stated, TUNED),
    (
        "chords.cost.steering_weight",
        Source::Stated,
        "lambda 1; sec. 5.2, tuned by the paper",
    ),
    (
        "chords.cost.length_weight",
        Source::Stated,
        "lambda 2; sec. 5.2, tuned by the paper",
    ),
    (
        "chords.n_iterations",
        Source::Stated,
        "N max; sec. 5.2, tuned by the paper",
    ),
    ("chords.distance.eta", Source::Stated, TUNED),
    (
        "chords.deposit.spread_weight",
        Source::Stated,
        "kappa 1; sec. 5.2, tuned by the paper",
    ),
    (
        "chords.deposit.length_weight",
        Source::Stated,
        "kappa 2; sec. 5.2, tuned by the paper",
    ),
    (
        "chords.evaporation.decay",
        Source::Stated,
        "a; sec. 5.2, tuned by the paper",
    ),
    (
        "chords.corner.rule",
        Source::Read,
        "eq. 18: printed without a plus where all others survived",
    ),
    ("chords.corner.straightness", Source::Read, "eq. 19"),
    ("chords.distance.rule", Source::Read, "eq. 20"),
    (
        "chords.safety",
        Source::Read,
        "eq. 16-17: the oriented footprint with a margin",
    ),
    (
        "chords.initial",
        Source::Read,
        "eq. 21: n and c are not given",
    ),
    (
        "chords.deposit.by",
        Source::Read,
        "eq. 22-23: who deposits is not said",
    ),
    (
        "chords.deposit.pheromone",
        Source::Read,
        "eq. 22-23: P h is not given",
    ),
    (
        "chords.evaporation.recursion",
        Source::Read,
        "eq. 24: its literal powers fall to 1e-20 at once",
    ),
    (
        "chords.evaporation.rho",
        Source::Read,
        "eq. 24: the first value is not given",
    ),
    ("chords.evaporation.rho_min", Source::Read, "eq. 24"),
    ("chords.evaporation.rule", Source::Read, "eq. 24"),
    (
        "chords.transition",
        Source::Read,
        "eq. 25-27: orders, window and floor are not given",
    ),
    (
        "chords.limit",
        Source::Read,
        "eq. 4-14: the suspension's numbers are not given",
    ),
    (
        "chords.reach",
        Source::Read,
        "the paper gives no moves: on eight neighbors no ant could turn",
    ),
    ("chords.n_ants", Source::Read, "not given"),
    (
        "chords.corridor",
        Source::Read,
        "sec. 5.2: local space weighting",
    ),
    (
        "chords.guidance",
        Source::Read,
        "sec. 5.2: local space weighting",
    ),
    (
        "chords.corner_exponent",
        Source::Read,
        "eq. 25: b is not given",
    ),
    (
        "chords.distance_exponent",
        Source::Read,
        "eq. 25: b is not given",
    ),
    (
        "chords.pheromone_exponent",
        Source::Read,
        "eq. 25: b is not given",
    ),
    (
        "smoothing",
        Source::Chosen,
        "corners are rounded so that the curve can be driven and judged",
    ),
    (
        "smoothing.redundant_nodes",
        Source::Read,
        "the paper shows the path as it was searched",
    ),
];

pub(super) fn section(variants: &[Variant]) -> Result<Option<Section>> {
    let Some(own) = variants.iter().find(|variant| variant.name == PROPOSED) else {
        return Ok(None);
    };
    let config = serde_json::to_value(&own.config)?;
    let sheet = ParameterSheet::new(&config, &PARTS, &KNOWN);
    Ok(Some(Section {
        heading: "Parameters".to_owned(),
        blocks: vec![Block::Table(sheet.table("parameters"))],
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::planner::PlannerName;

    #[test]
    fn every_known_key_is_in_the_configuration() {
        let variant = Variant::of(PlannerName::Faco2024);
        let config = serde_json::to_value(&variant.config).unwrap();
        assert_eq!(ParameterSheet::unknown(&config, &KNOWN), [""; 0]);
        let section = section(&[variant]).unwrap().unwrap();
        assert_eq!(section.heading, "Parameters");
    }
}

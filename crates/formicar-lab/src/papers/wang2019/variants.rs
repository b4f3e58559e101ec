//! The maps, and the paper's colony with its variants beside those of its references.

use crate::papers::experiment::Variant;
use formicar::colony::heuristic::{Guidance, StepLength, Visibility};
use formicar::layers::Expansion;
use formicar::map::DiagonalRule;
use formicar::planner::{ColonyParameters, PlannerName};

/// The maps with the figure that each stands for: narrow aisles, none, and the matrix that
/// circulates.
pub(super) const MAPS: [(&str, &str); 3] =
    [("wang-aisles", "6"), ("wang-open", "7"), ("aco20", "8")];

/// The paper's colony and those of its references 7 and 11.
pub(super) const PROPOSED: &str = "wang2019";
pub(super) const ZHANG: &str = "zhang2016";
pub(super) const JOSHY: &str = "joshy2016";
pub(super) const COLONIES: [&str; 3] = [ZHANG, JOSHY, PROPOSED];

pub(super) fn variants() -> Vec<Variant> {
    let changed = |planner: PlannerName, what: &str, change: fn(&mut ColonyParameters)| {
        Variant::changed(planner, what, change)
    };
    vec![
        Variant::of(PlannerName::Wang2019),
        Variant::of(PlannerName::Zhang2016),
        changed(PlannerName::Zhang2016, "obstacles grown by 1", |c| {
            c.layers.expansion = Expansion::Cells(1);
        }),
        Variant::of(PlannerName::Joshy2016),
        changed(PlannerName::Wang2019, "without goal guidance", |c| {
            c.colony.guidance = Guidance::None;
        }),
        changed(PlannerName::Wang2019, "visibility to the letter", |c| {
            c.colony.visibility = Visibility::StepLength(StepLength { beta: 7.0 });
        }),
        changed(PlannerName::Wang2019, "no corner cut", |c| {
            c.colony.diagonal_rule = DiagonalRule::NoObstacles;
        }),
    ]
}

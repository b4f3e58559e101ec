//! Cells that block though they are no obstacles: unknown ones, and those of keep-out areas.

use super::closed::Closed;
use formicar::map::{Cell, DistanceField, OCCUPIED, OccupancyGrid, UNKNOWN, UnknownPolicy};
use formicar::planner::Explanation;
use formicar::scenario::{Endpoint, ScenarioError, StartContact};
use formicar::search::widest_passage;
use formicar::vehicle::Vehicle;

/// What blocks besides obstacles; empty where flags and file leave nothing to tell apart.
#[derive(Clone, Debug, Default)]
pub(crate) struct Blocked {
    /// The map as its file has it, where its unknown cells block.
    unknown: Option<OccupancyGrid>,
    /// The keep-out areas as occupied cells of a map that is free otherwise.
    keep_out: Option<OccupancyGrid>,
}

/// The reason why a cell blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Obstacle,
    Unknown,
    KeepOut,
}

impl Blocked {
    /// Of a map as its file has it.
    pub(super) fn new(map: &OccupancyGrid, unknown: UnknownPolicy, closed: Closed) -> Self {
        let blocks = unknown == UnknownPolicy::Occupied && map.values().contains(&UNKNOWN);
        Self {
            unknown: blocks.then(|| map.clone()),
            keep_out: closed.cells,
        }
    }

    /// Closes the keep-out ground of a map.
    pub(super) fn close(&self, map: &mut OccupancyGrid) {
        if let Some(closed) = &self.keep_out {
            let cells = closed.lethal_cells();
            cells.iter().for_each(|cell| map.set(cell, OCCUPIED));
        }
    }

    fn kind(&self, cell: Cell) -> Kind {
        let is = |map: &Option<OccupancyGrid>, value: i8| {
            map.as_ref().is_some_and(|map| map.value(cell) == value)
        };
        if is(&self.keep_out, OCCUPIED) {
            Kind::KeepOut
        } else if is(&self.unknown, UNKNOWN) {
            Kind::Unknown
        } else {
            Kind::Obstacle
        }
    }

    /// The same error with what the body overlaps called by its name.
    pub(crate) fn named(&self, error: ScenarioError, contact: StartContact) -> ScenarioError {
        let ScenarioError::Occupied {
            which,
            x,
            y,
            problem,
            hint,
            cells,
        } = error
        else {
            return error;
        };
        let count = |kind| {
            cells
                .iter()
                .filter(|cell| self.kind(**cell) == kind)
                .count()
        };
        let counts = [Kind::Obstacle, Kind::Unknown, Kind::KeepOut].map(count);
        let unknown = match counts[1] {
            0 => "",
            _ => "; --unknown free drives on unknown ground",
        };
        let escape = match (which, contact) {
            (Endpoint::Start, StartContact::Refuse) => "; --escape drives out of contact first",
            _ => "",
        };
        let (problem, hint) = (with_kinds(&problem, counts), hint + unknown + escape);
        ScenarioError::Occupied {
            which,
            x,
            y,
            problem,
            hint,
            cells,
        }
    }

    /// Advice where a way would lead over unknown ground: none where it would not, or nobody knows.
    pub(crate) fn hint(
        &self,
        explanation: &Explanation,
        vehicle: &Vehicle,
        ends: [Cell; 2],
    ) -> Option<String> {
        let is_blocked = explanation
            .gap
            .as_ref()
            .is_none_or(|gap| gap.gap_m < vehicle.width_m());
        let known = self.unknown.as_ref().filter(|_| is_blocked)?;
        let mut open = known.clone().with_unknown(UnknownPolicy::Free);
        self.close(&mut open);
        let truncation = DistanceField::DEFAULT_TRUNCATION_CELLS;
        let distance = DistanceField::new(&open.lethal_cells(), truncation);
        let [from, to] = ends;
        let passage = widest_passage(&distance, from, to)?;
        let resolution_m = known.frame().resolution_m();
        let disc_m = passage
            .widest_disc_cells(&distance)
            .unwrap_or(f64::INFINITY)
            * resolution_m;
        let n_unknown = known
            .values()
            .iter()
            .filter(|value| **value == UNKNOWN)
            .count();
        (disc_m >= vehicle.width_m()).then(|| {
            format!(
                "{n_unknown} cells of the map are unknown and count as occupied; --unknown free drives on them, and a way is wide enough then"
            )
        })
    }
}

/// A sentence on obstacle cells, with the kinds of these cells.
fn with_kinds(problem: &str, [n_obstacles, n_unknown, n_closed]: [usize; 3]) -> String {
    let kinds = [
        (n_obstacles, "obstacle cell"),
        (n_unknown, "unknown cell"),
        (n_closed, "keep-out cell"),
    ];
    let present: Vec<_> = kinds.into_iter().filter(|(n, _)| *n > 0).collect();
    match present[..] {
        [] => problem.to_owned(),
        [(_, name)] => problem.replacen("obstacle cell", name, 1),
        _ => {
            let parts = present.iter().map(|(n, name)| {
                let plural = if *n == 1 { "" } else { "s" };
                format!("{n} {name}{plural}")
            });
            let parts = parts.collect::<Vec<_>>().join(", ");
            let cells = problem.replacen("obstacle cell", "blocked cell", 1);
            format!("{cells} ({parts})")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocked_cells_are_called_by_their_kind() {
        let told = "the footprint overlaps 5 obstacle cells, deepest by 0.2 m at cell (1, 2)";
        assert_eq!(with_kinds(told, [5, 0, 0]), told);
        assert!(with_kinds(told, [0, 5, 0]).contains("overlaps 5 unknown cells, deepest"));
        assert!(with_kinds(told, [0, 0, 5]).contains("overlaps 5 keep-out cells"));
        let mixed = with_kinds(told, [1, 2, 2]);
        assert!(mixed.contains("overlaps 5 blocked cells"), "{mixed}");
        assert!(
            mixed.ends_with("(1 obstacle cell, 2 unknown cells, 2 keep-out cells)"),
            "{mixed}"
        );
    }
}

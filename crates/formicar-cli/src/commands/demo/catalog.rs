//! The runs of the demo: every request of the built-in maps, and a few variations.

use super::case::{Case, Chapter};
use anyhow::Result;
use formicar::geometry::Pose2;
use formicar::map::builtin::{self, BuiltinKind, BuiltinMap};
use formicar::planner::PlannerName;
use formicar::vehicle::Gears;
use std::f64::consts::PI;

/// Runs that are drawn as PNG too, one or two per chapter.
const DRAWN_AS_PNG: [&str; 7] = [
    "lei-map1.lei2020",
    "warehouse.dock-to-rack",
    "parking-lot.back-in",
    "neighborhood.across",
    "u-turn-street.three-point",
    "parking-lot.nose-in-forward",
    "lei-map1.across",
];

/// All runs, in the order of the page.
pub(super) fn cases() -> Result<Vec<Case>> {
    let mut cases = Vec::new();
    for chapter in Chapter::ALL {
        match chapter {
            Chapter::Scenes => cases.extend(of_kind(BuiltinKind::Scene, chapter)?),
            Chapter::Narrow => cases.extend(of_kind(BuiltinKind::Narrow, chapter)?),
            Chapter::Variations => cases.extend(variations(chapter)?),
            Chapter::Grids => cases.extend(of_kind(BuiltinKind::GridProblem, chapter)?),
            Chapter::Ants => cases.extend(ants(chapter)?),
        }
    }
    for case in &mut cases {
        case.has_png = DRAWN_AS_PNG.contains(&case.id().as_str());
    }
    Ok(cases)
}

/// Every request of the built-in maps of a kind.
fn of_kind(kind: BuiltinKind, chapter: Chapter) -> Result<Vec<Case>> {
    let maps = builtin::all().iter().filter(|map| map.kind == kind);
    let requests = maps.flat_map(|map| map.requests.iter().map(|request| (map.name, request.id)));
    requests
        .map(|(map, request)| Case::new(chapter, map, request))
        .collect()
}

/// Other conditions, another frame, and two requests that nothing can answer.
fn variations(chapter: Chapter) -> Result<Vec<Case>> {
    Ok(vec![
        Case {
            request: "nose-in-forward",
            motion: Gears::Forward,
            about: "As parking-lot / nose-in, but reverse is forbidden: the way is longer, and no \
                    gear changes.",
            ..Case::new(chapter, "parking-lot", "nose-in")?
        },
        Case {
            request: "rotated-frame",
            origin: Some(Pose2::new(-120.0, 48.0, PI / 7.0)),
            about: "As warehouse / rack-to-packing on a map whose origin is (-120, 48) with a yaw \
                    of 26 degrees, as ROS maps may have: everything is asked and answered in world \
                    coordinates.",
            ..Case::new(chapter, "warehouse", "rack-to-packing")?
        },
        Case {
            request: "other-street",
            goal: Pose2::new(25.0, 8.0, PI),
            is_impossible: true,
            about: "The goal lies in the other of two closed streets: no vehicle gets there.",
            ..Case::new(chapter, "u-turn-street", "three-point")?
        },
        Case {
            request: "road-works",
            goal: Pose2::new(22.0, 5.2, 0.0),
            keep_out: &[[11.0, 3.0], [12.0, 3.0], [12.0, 6.5], [11.0, 6.5]],
            is_impossible: true,
            about: "Road works close most of the lane: what is left is thinner than the car.",
            ..Case::new(chapter, "parallel-parking", "gap-6.4m")?
        },
    ])
}

/// Colonies on the maps of their papers, and where a vehicle works.
fn ants(chapter: Chapter) -> Result<Vec<Case>> {
    let by = |planner: PlannerName, map: &str, about: &'static str| -> Result<Case> {
        let request = BuiltinMap::by_name(map)?.requests[0].id;
        Ok(Case {
            request: planner.name(),
            planner,
            about,
            ..Case::new(chapter, map, request)?
        })
    };
    Ok(vec![
        by(
            PlannerName::AntSystem,
            "lei-map1",
            "The conventional colony: uniform pheromone, one class of steps. Its way wanders, and \
             may turn too often for a car.",
        )?,
        by(
            PlannerName::Lei2020,
            "lei-map1",
            "Lei & Zheng 2020: U-shapes closed, steps towards the goal first, turns cost. Corners \
             become pairs of arcs, or curves where those touch an obstacle.",
        )?,
        by(
            PlannerName::Lei2020,
            "lei-map3",
            "Lei & Zheng 2020 where long walls force the way up, down and up again.",
        )?,
        by(
            PlannerName::Wang2019,
            "wang-aisles",
            "Wang et al. 2019: no step between two obstacles that meet at a corner, so the ants go \
             around.",
        )?,
        by(
            PlannerName::Zhang2016,
            "wang-aisles",
            "Zhang 2016 on the same map: its ants squeeze through, which only a point can do.",
        )?,
        by(
            PlannerName::Lei2020,
            "warehouse",
            "Ants where a robot works: 400 000 cells, obstacles grown by half its width, then arcs \
             and curves for its true footprint.",
        )?,
        by(
            PlannerName::Faco2024,
            "li-neighborhood",
            "Li et al. 2024: ants that step by chords as a suspended car steers, over 400 000 \
             cells, and the fewest and widest arcs that keep a margin.",
        )?,
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_run_has_a_name_of_its_own() {
        let cases = cases().unwrap();
        let ids: BTreeSet<_> = cases.iter().map(Case::id).collect();
        assert_eq!(ids.len(), cases.len());
        assert!(DRAWN_AS_PNG.iter().all(|&id| ids.contains(id)));
    }
}

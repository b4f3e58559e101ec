//! Curves over what is missing of a path.

use crate::geometry::{Arc, Curve, Pose2, dubins, reeds_shepp};
use crate::objective::VehicleCost;
use crate::search::DriveProblem;
use crate::vehicle::Gears;

/// Distances before the end of a stretch at which it may be left, and after the beginning of the
/// next at which that may be met: turning radii.
pub(super) const OFFSETS_RADII: [f64; 7] = [0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.5];
/// Words looked at from one place to another, shortest first.
const N_WORDS: usize = 4;
/// Curves checked exactly, cheapest first.
const MAX_CHECKED: usize = 48;

/// A place at which a path may be left or met, and how much of it is lost there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) pose: Pose2,
    /// Driven distance along the path, meters.
    pub(super) at_m: f64,
    /// Length of the path that stays undriven, meters.
    pub(super) lost_m: f64,
}

/// A curve from one place to another.
#[derive(Clone, Debug)]
pub(super) struct Bridge {
    pub(super) from: Place,
    pub(super) to: Place,
    pub(super) arcs: Vec<Arc>,
}

/// The cheapest free curve from one of some places to one of others, as driving on open ground
/// costs; what of the path it replaces counts in its favor.
pub(super) fn bridge(
    problem: &DriveProblem,
    cost: &VehicleCost,
    exits: &[Place],
    entries: &[Place],
) -> Option<Bridge> {
    let mut drafts: Vec<(f64, Place, Place, Curve)> = Vec::new();
    for &from in exits {
        for &to in entries {
            let mut curves = words(problem, from.pose, to.pose);
            curves.sort_by(|a, b| a.length_m().total_cmp(&b.length_m()));
            drafts.extend(curves.into_iter().take(N_WORDS).map(|curve| {
                let gain_m = from.lost_m + to.lost_m;
                let price_m = cost.open_path_m(curve.arcs());
                (price_m - gain_m, from, to, curve)
            }));
        }
    }
    drafts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_free = |from: Pose2, curve: &Curve| {
        let mut arcs = curve.placed_arcs(from);
        arcs.all(|(start, arc)| problem.is_arc_free(start, arc))
    };
    let mut drafts = drafts.into_iter().take(MAX_CHECKED);
    let (_, from, to, curve) = drafts.find(|(_, from, _, curve)| is_free(from.pose, curve))?;
    Some(Bridge {
        from,
        to,
        arcs: curve.arcs().to_vec(),
    })
}

fn words(problem: &DriveProblem, from: Pose2, to: Pose2) -> Vec<Curve> {
    let radius_m = problem.map().radius_m();
    match problem.gears() {
        Gears::Forward => dubins::candidates(from, to, radius_m),
        Gears::Both => reeds_shepp::candidates(from, to, radius_m),
    }
}

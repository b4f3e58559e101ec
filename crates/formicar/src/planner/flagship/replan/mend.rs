//! A previous path made whole again: cut off behind the vehicle, and bridged where it is broken.

use super::bridge::{Bridge, OFFSETS_RADII, Place, bridge};
use super::kept::{Stretch, arcs_between, kept_stretches};
use crate::geometry::{Arc, Pose2, angle_difference};
use crate::objective::VehicleCost;
use crate::path::CurvePath;
use crate::search::{DriveProblem, Driven};

/// A vehicle this near to the path, meters and radians, is on it.
const ON_PATH: f64 = 1e-6;

/// Searches for a way from one pose to another where no curve leads, in grid coordinates.
pub(super) type Detour<'a> = &'a mut dyn FnMut(Pose2, Pose2) -> Option<Vec<Arc>>;

/// A previous path in grid coordinates, and what is left of it.
pub(super) struct Mender<'a> {
    pub(super) problem: &'a DriveProblem<'a>,
    pub(super) cost: VehicleCost,
    path: CurvePath,
    kept: Vec<Stretch>,
    start: Pose2,
}

impl<'a> Mender<'a> {
    /// Takes the part of a path that is ahead of one of the problem's starts: of several, that
    /// which is nearest to the path. None where there is no start or nothing ahead.
    pub(super) fn new(
        problem: &'a DriveProblem<'a>,
        cost: VehicleCost,
        previous: &CurvePath,
    ) -> Option<Self> {
        let radius_m = problem.map().radius_m();
        let resolution_m = problem.map().obstacles().frame().resolution_m();
        let apart = |start: Pose2| {
            let behind_m = previous.nearest_m(start, radius_m, resolution_m);
            let pose = previous.pose_at(behind_m);
            (distance(start, pose, radius_m), behind_m, start)
        };
        let starts = problem.starts().iter().map(|&start| apart(start));
        let (_, behind_m, start) = starts.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let path = previous.between_m(behind_m, previous.length_m());
        Some(Self {
            kept: kept_stretches(problem, &path),
            problem,
            cost,
            path,
            start,
        })
    }

    /// The path made whole; none where a gap cannot be bridged.
    pub(super) fn mend(&self, mut detour: Option<Detour>) -> Option<Driven> {
        let mut arcs = Vec::new();
        let mut at = self.first_place();
        let mut next = 0_usize;
        if self.is_on_path() {
            at.at_m = 0.0;
            next = 1;
        }
        loop {
            let on = next.checked_sub(1).map(|last| self.kept[last].clone());
            let ends = on.as_ref().is_some_and(|on| self.ends_at_goal(on));
            if let (Some(on), true) = (&on, ends) {
                arcs.extend(arcs_between(&self.path, at.at_m..on.end));
                break;
            }
            let exits = self.exits(at, on.as_ref());
            let (bridge, after) = self.bridge_on(&exits, next, detour.as_mut())?;
            arcs.extend(arcs_between(&self.path, at.at_m..bridge.from.at_m));
            arcs.extend(bridge.arcs);
            at = bridge.to;
            next = after;
            if next > self.kept.len() {
                break;
            }
        }
        self.holds(&arcs).then_some((self.start, arcs))
    }

    /// A bridge from a place to the first of the next stretches that can be met, or to a goal;
    /// with the number of the stretch behind it, one more than there are at a goal.
    fn bridge_on(
        &self,
        exits: &[Place],
        next: usize,
        detour: Option<&mut Detour>,
    ) -> Option<(Bridge, usize)> {
        for after in next..=self.kept.len() {
            let entries = self.entries(after);
            if let Some(bridge) = bridge(self.problem, &self.cost, exits, &entries) {
                return Some((bridge, after + 1));
            }
        }
        let entries = self.entries(next);
        // From the middle of where the path may be left to the middle of where it may be met:
        // what is nearest to the gap may be stuck there.
        let (from, to) = (
            *exits.get(exits.len() / 2)?,
            *entries.get(entries.len() / 2)?,
        );
        let arcs = detour?(from.pose, to.pose)?;
        Some((Bridge { from, to, arcs }, next + 1))
    }

    /// Places to leave the path: the vehicle's place, or along the stretch that it is on.
    fn exits(&self, at: Place, on: Option<&Stretch>) -> Vec<Place> {
        let Some(on) = on else {
            return vec![at];
        };
        let places = self.offsets_m().map(|offset_m| on.end - offset_m);
        let places = places.filter(|&place_m| place_m >= at.at_m);
        let mut places: Vec<Place> = places.map(|m| self.place(m, on.end - m)).collect();
        if places.is_empty() {
            places.push(at);
        }
        places
    }

    /// Places to meet the path again: along a stretch, or behind the last one at the goals.
    fn entries(&self, stretch: usize) -> Vec<Place> {
        let Some(stretch) = self.kept.get(stretch) else {
            let goals = self.problem.goals().iter();
            return goals.map(|&pose| self.end_place(pose)).collect();
        };
        let places = self.offsets_m().map(|offset_m| stretch.start + offset_m);
        let places = places.filter(|&place_m| place_m <= stretch.end);
        places.map(|m| self.place(m, m - stretch.start)).collect()
    }

    fn offsets_m(&self) -> impl Iterator<Item = f64> {
        let radius_m = self.problem.map().radius_m();
        OFFSETS_RADII.into_iter().map(move |radii| radii * radius_m)
    }

    fn place(&self, at_m: f64, lost_m: f64) -> Place {
        Place {
            pose: self.path.pose_at(at_m),
            at_m,
            lost_m,
        }
    }

    fn first_place(&self) -> Place {
        Place {
            pose: self.start,
            at_m: 0.0,
            lost_m: 0.0,
        }
    }

    fn end_place(&self, pose: Pose2) -> Place {
        Place {
            pose,
            at_m: self.path.length_m(),
            lost_m: 0.0,
        }
    }

    /// True where the vehicle is on a stretch that begins at its place.
    fn is_on_path(&self) -> bool {
        let begins_here = self.kept.first().is_some_and(|kept| kept.start == 0.0);
        begins_here && distance(self.start, self.path.start(), 1.0) <= ON_PATH
    }

    /// True where a stretch is the end of the path, and that is at a goal.
    fn ends_at_goal(&self, stretch: &Stretch) -> bool {
        stretch.end >= self.path.length_m() - ON_PATH && self.problem.at_goal(self.path.end())
    }

    /// True where arcs from the start on are free and lead to a goal.
    fn holds(&self, arcs: &[Arc]) -> bool {
        let mut pose = self.start;
        let is_free = arcs.iter().all(|&arc| {
            let start = pose;
            pose = arc.end_from(pose);
            self.problem.is_arc_free(start, arc)
        });
        is_free && self.problem.at_goal(pose)
    }
}

fn distance(a: Pose2, b: Pose2, meters_per_rad: f64) -> f64 {
    let turn_rad = angle_difference(a.heading, b.heading).abs();
    a.position().distance(b.position()) + meters_per_rad * turn_rad
}

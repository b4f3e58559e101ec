//! What stopped a chain: the first place on the way that could not be passed.

use super::chain::{Stuck, Task};
use super::polyline::Leg;
use super::roadmap::{Facing, Member, Roadmap, Role};
use super::{CornerProblem, SmoothingError, TwoTurning};
use crate::geometry::{Arc, Point2, Pose2};
use crate::scenario::Endpoint;

/// Poses per arc at which overlaps are measured.
const N_SAMPLES: u32 = 16;

/// Why a chain got stuck.
pub(super) fn explain(task: &Task, map: &Roadmap, stuck: Stuck) -> SmoothingError {
    let heading = |which| SmoothingError::Heading {
        which,
        reach_m: task.reach_m().min(map.line.length_m()),
    };
    let Some(reached) = stuck.reached else {
        return heading(Endpoint::Start);
    };
    let leg = map.places[reached].leg;
    if leg == map.line.n_corners() {
        return if task.ends.goals.is_empty() {
            straight(task, map, reached)
        } else {
            heading(Endpoint::Goal)
        };
    }
    match problem(task, map, (leg, reached)) {
        Some(problem) => {
            let place = world(task, map.line.points[leg + 1]);
            SmoothingError::Corner {
                number: leg + 1,
                x: place.x,
                y: place.y,
                turn_deg: map.line.turn_rad(leg).to_degrees(),
                problem,
                corners: task.config.corners,
            }
        }
        None => straight(task, map, reached),
    }
}

fn straight(task: &Task, map: &Roadmap, place: usize) -> SmoothingError {
    let place = world(task, map.pose(place, Facing::Along).position());
    SmoothingError::Straight {
        x: place.x,
        y: place.y,
        corners: task.config.corners,
    }
}

fn world(task: &Task, place: Point2) -> Point2 {
    let frame = task.obstacles.frame();
    frame.to_world(Pose2::at(place, 0.0)).position()
}

/// What is wrong with a corner; nothing where the straight way to it is at fault.
fn problem(task: &Task, map: &Roadmap, (corner, reached): (usize, usize)) -> Option<CornerProblem> {
    let members: Vec<&Member> = map.members.iter().filter(|m| m.corner == corner).collect();
    if members.is_empty() {
        let legs = [map.line.legs[corner], map.line.legs[corner + 1]];
        return Some(shortage(task, map.line.turn_rad(corner), legs));
    }
    let is_free = |member: &&&Member| {
        let facings = task.facings().iter();
        facings.copied().any(|f| drives_free(task, map, member, f))
    };
    let free: Vec<&&Member> = members.iter().filter(is_free).collect();
    if free.is_empty() {
        let depths = members.iter().map(|m| overlap_m(task, map, m));
        let depth_m = depths.fold(f64::INFINITY, f64::min);
        return Some(CornerProblem::Touches { depth_m });
    }
    if free.iter().any(|member| member.places[0] > reached) {
        return None;
    }
    let needs = free.iter().map(|member| member.turning.before_m);
    let before = map.legs[corner].clone();
    let turn_ends = before.filter(|&p| matches!(map.places[p].role, Role::TurnEnds(_)));
    let first = turn_ends.map(|p| map.places[p].at_m).next()?;
    Some(CornerProblem::Crowded {
        needs_m: needs.fold(f64::INFINITY, f64::min),
        has_m: map.line.legs[corner].length_m - first,
    })
}

/// By how much the member that comes nearest to fitting lacks room.
fn shortage(task: &Task, turn_rad: f64, [before, after]: [Leg; 2]) -> CornerProblem {
    let lacks = |t: &TwoTurning| {
        let (before_m, after_m) = (t.before_m - before.length_m, t.after_m - after.length_m);
        before_m.max(0.0) + after_m.max(0.0)
    };
    let family = TwoTurning::family(turn_rad, task.radius_m, task.config.n_members);
    let nearest = family.iter().min_by(|a, b| lacks(a).total_cmp(&lacks(b)));
    match nearest {
        Some(t) if t.before_m > before.length_m => CornerProblem::TooShort {
            needs_m: t.before_m,
            has_m: before.length_m,
            side: "before",
        },
        Some(t) => CornerProblem::TooShort {
            needs_m: t.after_m,
            has_m: after.length_m,
            side: "after",
        },
        None => CornerProblem::TurnsBack,
    }
}

fn motion(map: &Roadmap, member: &Member, facing: Facing) -> (Pose2, [Arc; 2]) {
    let sign = facing.sign();
    let seen = |arc: Arc| Arc::new(sign * arc.curvature_per_m, sign * arc.signed_length_m);
    let start = map.pose(member.places[0], facing);
    (start, member.turning.arcs().map(seen))
}

fn drives_free(task: &Task, map: &Roadmap, member: &Member, facing: Facing) -> bool {
    let (start, arcs) = motion(map, member, facing);
    task.all_free(start, &arcs)
}

/// The deepest overlap along a member driven forward, metres.
fn overlap_m(task: &Task, map: &Roadmap, member: &Member) -> f64 {
    let (mut pose, arcs) = motion(map, member, Facing::Along);
    let mut deepest: f64 = 0.0;
    for arc in arcs {
        let depths = (0..=N_SAMPLES).map(|i| {
            let driven_m = arc.signed_length_m * f64::from(i) / f64::from(N_SAMPLES);
            let at = pose.advance(arc.curvature_per_m, driven_m);
            let overlap = task.obstacles.overlap(task.body, at);
            overlap.map_or(0.0, |overlap| overlap.depth_m)
        });
        deepest = depths.fold(deepest, f64::max);
        pose = arc.end_from(pose);
    }
    deepest
}

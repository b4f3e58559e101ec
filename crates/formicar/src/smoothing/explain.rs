//! The first place on the polyline that no chain could pass.

use super::chain::Stuck;
use super::error::{CornerProblem, SmoothingError};
use super::polyline::Leg;
use super::roadmap::{Facing, Member, Roadmap};
use super::task::RoundingTask;
use super::two_turning::TwoTurning;
use crate::geometry::{Arc, Point2, Pose2};
use crate::scenario::Endpoint;

/// Poses per arc at which overlaps are measured.
const N_SAMPLES: u32 = 16;

/// The farthest leg that was reached, by the vehicle in one facing.
struct Farthest {
    leg: usize,
    facing: Facing,
    /// The first and the last junction reached.
    junctions: [usize; 2],
}

/// The reason why no chain reached the goal.
pub(super) fn explain(task: &RoundingTask, map: &Roadmap, stuck: &Stuck) -> SmoothingError {
    let heading = |which| SmoothingError::Heading {
        which,
        reach_m: task.reach_m().min(map.line.length_m()),
    };
    let Some(farthest) = farthest(map, stuck) else {
        return heading(Endpoint::Start);
    };
    let leg = farthest.leg;
    if leg == map.line.n_corners() {
        return if task.ends.goal_is_free {
            straight(task, map, farthest.junctions[1])
        } else {
            heading(Endpoint::Goal)
        };
    }
    let Some(problem) = problem(task, map, &farthest) else {
        return straight(task, map, farthest.junctions[1]);
    };
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

fn farthest(map: &Roadmap, stuck: &Stuck) -> Option<Farthest> {
    let &(junction, _) = stuck.reached.last()?;
    let leg = map.junctions[junction].leg;
    let on_leg = |facing: Facing| {
        let on_leg = stuck.reached.iter();
        on_leg.filter(move |&&(junction, f)| f == facing && map.junctions[junction].leg == leg)
    };
    Facing::ALL.into_iter().find_map(|facing| {
        let (first, _) = on_leg(facing).next()?;
        let (last, _) = on_leg(facing).next_back()?;
        Some(Farthest {
            leg,
            facing,
            junctions: [*first, *last],
        })
    })
}

fn straight(task: &RoundingTask, map: &Roadmap, junction: usize) -> SmoothingError {
    let place = world(task, map.pose(junction, Facing::Along).position());
    SmoothingError::Straight {
        x: place.x,
        y: place.y,
        corners: task.config.corners,
    }
}

fn world(task: &RoundingTask, place: Point2) -> Point2 {
    let frame = task.obstacles.frame();
    frame.to_world(Pose2::at(place, 0.0)).position()
}

/// The problem of the corner at the end of a leg; none where the straight way to it is at fault.
fn problem(task: &RoundingTask, map: &Roadmap, farthest: &Farthest) -> Option<CornerProblem> {
    let (corner, facing) = (farthest.leg, farthest.facing);
    let members = || map.members.iter().filter(|m| m.corner == corner);
    if members().next().is_none() {
        let legs = [map.line.legs[corner], map.line.legs[corner + 1]];
        return Some(shortage(task, map.line.turn_rad(corner), legs));
    }
    let is_free = |member: &&Member| {
        let (start, arcs) = motion(map, member, facing);
        task.all_free(start, &arcs)
    };
    let free: Vec<&Member> = members().filter(is_free).collect();
    if free.is_empty() {
        return Some(CornerProblem::Touches {
            depth_m: least_overlap_m(task, map, members(), facing),
        });
    }
    // The turns of free members begin before the first junction that the chains reached.
    let first = farthest.junctions[0];
    if free.iter().any(|member| member.junctions[0] > first) {
        return None;
    }
    let needs = free.iter().map(|member| member.turning.before_m);
    Some(CornerProblem::Crowded {
        needs_m: needs.fold(f64::INFINITY, f64::min),
        has_m: map.line.legs[corner].length_m - map.junctions[first].at_m,
    })
}

/// The lack of room of the member that comes nearest to fitting.
fn shortage(task: &RoundingTask, turn_rad: f64, [before, after]: [Leg; 2]) -> CornerProblem {
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
    let start = map.pose(member.junctions[0], facing);
    (start, member.turning.arcs().map(|arc| facing.seen(arc)))
}

/// The deepest overlap along the member that looks freest on the distance transform, meters.
fn least_overlap_m<'a>(
    task: &RoundingTask,
    map: &Roadmap,
    members: impl Iterator<Item = &'a Member>,
    facing: Facing,
) -> f64 {
    let tracks = members.map(|member| poses(map, member, facing));
    let ceiling_m = |track: &Vec<Pose2>| {
        let ceilings = track.iter();
        let ceilings = ceilings.map(|&pose| task.obstacles.clearance_ceiling_m(task.body, pose));
        ceilings.fold(f64::INFINITY, f64::min)
    };
    let freest = tracks.max_by(|a, b| ceiling_m(a).total_cmp(&ceiling_m(b)));
    let overlaps = freest.into_iter().flatten();
    let overlaps = overlaps.filter_map(|pose| task.obstacles.overlap(task.body, pose));
    overlaps.fold(0.0, |deepest, overlap| overlap.depth_m.max(deepest))
}

/// Poses along a member.
fn poses(map: &Roadmap, member: &Member, facing: Facing) -> Vec<Pose2> {
    let (mut pose, arcs) = motion(map, member, facing);
    let mut poses = Vec::new();
    for arc in arcs {
        let step_m = arc.signed_length_m / f64::from(N_SAMPLES);
        let driven = (0..=N_SAMPLES).map(|i| step_m * f64::from(i));
        poses.extend(driven.map(|driven_m| pose.advance(arc.curvature_per_m, driven_m)));
        pose = arc.end_from(pose);
    }
    poses
}

//! Places of a path at which it may be cut: the middles of its segments, its ends, and where it
//! changes gear; and the chain between two of them to begin with.

use super::chain::{Chain, Ramp};
use super::fit::{Limits, RESERVE};
use crate::geometry::Pose2;
use crate::path::CurveSegment;

/// A place of the path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Station {
    pub(super) pose: Pose2,
    pub(super) s_m: f64,
    /// The segment in whose middle it lies, or that begins at it.
    segment: usize,
    /// Whether the vehicle stands there: its wheels may turn.
    pub(super) stands: bool,
}

/// Segments shorter than this are rounding, meters.
const NEGLIGIBLE_M: f64 = 1e-9;

/// The segments that have a length.
pub(super) fn driven(segments: &[CurveSegment]) -> Vec<CurveSegment> {
    let driven = segments.iter().filter(|s| s.length_m > NEGLIGIBLE_M);
    driven.copied().collect()
}

/// All stations in order; none where there are no segments.
pub(super) fn stations(segments: &[CurveSegment]) -> Vec<Station> {
    let mut stations = Vec::with_capacity(2 * segments.len());
    let mut s_m = 0.0;
    for (i, segment) in segments.iter().enumerate() {
        let begins = i == 0 || segments[i - 1].direction != segment.direction;
        if begins {
            stations.push(Station {
                pose: segment.start,
                s_m,
                segment: i,
                stands: true,
            });
        }
        stations.push(Station {
            pose: segment.pose_at(0.5 * segment.length_m),
            s_m: s_m + 0.5 * segment.length_m,
            segment: i,
            stands: false,
        });
        s_m += segment.length_m;
    }
    if let Some(last) = segments.last() {
        stations.push(Station {
            pose: last.end(),
            s_m,
            segment: segments.len(),
            stands: true,
        });
    }
    stations
}

/// A part of a segment.
#[derive(Clone, Copy)]
struct Part {
    curvature_per_m: f64,
    length_m: f64,
    sign: f64,
    /// Whether nothing lies beyond it on that side, so that all of it may become a transition.
    ends: [bool; 2],
}

/// The path between two stations with transitions at its joints, as long as the rate needs or as
/// the room allows. It keeps neither rate nor end yet.
pub(super) fn first_chain(
    segments: &[CurveSegment],
    [from, to]: [&Station; 2],
    limits: Limits,
) -> Chain {
    let parts = parts(segments, from, to, limits);
    let mut chain = Chain::default();
    let gears = parts.chunk_by(|a, b| a.sign == b.sign);
    let n_gears = gears.clone().count();
    for (i, gear) in gears.enumerate() {
        let frees = [i > 0 || from.stands, i + 1 < n_gears || to.stands];
        add_gear(&mut chain, gear, frees, limits);
    }
    chain
}

fn parts(segments: &[CurveSegment], from: &Station, to: &Station, limits: Limits) -> Vec<Part> {
    let bend = limits.max_curvature_per_m * (1.0 - RESERVE);
    let last = if to.stands {
        to.segment
    } else {
        to.segment + 1
    };
    let range = from.segment..last;
    let starts_midway = |i: usize| !from.stands && i == from.segment;
    let ends_midway = |i: usize| !to.stands && i == to.segment;
    let part = |i: usize| {
        let segment = &segments[i];
        let halves = [starts_midway(i), ends_midway(i)];
        let share = 1.0 - 0.5 * f64::from(u8::from(halves[0]) + u8::from(halves[1]));
        let gear = |other: Option<&CurveSegment>| {
            other.is_none_or(|other| other.direction != segment.direction)
        };
        let before = i.checked_sub(1).and_then(|i| segments.get(i));
        Part {
            curvature_per_m: segment.curvature_per_m.clamp(-bend, bend),
            length_m: share * segment.length_m,
            sign: segment.direction.sign(),
            ends: [
                halves[0] || gear(before),
                halves[1] || gear(segments.get(i + 1)),
            ],
        }
    };
    range.map(part).collect()
}

/// Plateaus and transitions of one gear; its first and last curvature may be free.
fn add_gear(chain: &mut Chain, parts: &[Part], frees: [bool; 2], limits: Limits) {
    let sign = parts[0].sign;
    let rate = limits.max_rate_per_m2 * (1.0 - RESERVE);
    let half_ramp = |a: &Part, b: &Part| {
        let wanted = 0.5 * (b.curvature_per_m - a.curvature_per_m).abs() / rate;
        let room =
            |part: &Part, side: usize| part.length_m * if part.ends[side] { 1.0 } else { 0.5 };
        wanted.min(room(a, 0)).min(room(b, 1))
    };
    let mut node = chain.node(parts[0].curvature_per_m, frees[0]);
    let mut taken_m = 0.0;
    for (i, part) in parts.iter().enumerate() {
        let next = parts.get(i + 1);
        let half_m = next.map_or(0.0, |next| half_ramp(part, next));
        let flat_m = part.length_m - taken_m - half_m;
        if flat_m > 1e-3 || next.is_none() {
            let to = chain.node(part.curvature_per_m, next.is_some() || frees[1]);
            chain.ramps.push(Ramp {
                from: node,
                to,
                length_m: flat_m.max(1e-3),
                sign,
            });
            node = to;
        }
        if let Some(next) = next {
            let to = chain.node(next.curvature_per_m, true);
            chain.ramps.push(Ramp {
                from: node,
                to,
                length_m: (2.0 * half_m).max(1e-3),
                sign,
            });
            node = to;
        }
        taken_m = half_m;
    }
}

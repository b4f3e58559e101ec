//! Junctions on a polyline and the 2-turnings that may connect them.

use super::config::SmoothingConfig;
use super::polyline::Polyline;
use super::two_turning::TwoTurning;
use crate::geometry::{Arc, Pose2};
use std::f64::consts::PI;
use std::ops::Range;

/// The direction in which the vehicle faces: along the polyline, driving forward, or against it, in
/// reverse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Facing {
    Along,
    Against,
}

impl Facing {
    /// Both facings.
    pub(super) const ALL: [Self; 2] = [Self::Along, Self::Against];

    /// +1 along, -1 against: the gear in which the polyline is followed.
    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Along => 1.0,
            Self::Against => -1.0,
        }
    }

    /// A line or arc along the polyline as it is driven.
    pub(super) fn seen(self, arc: Arc) -> Arc {
        let sign = self.sign();
        Arc::new(sign * arc.curvature_per_m, sign * arc.signed_length_m)
    }

    fn turn_rad(self) -> f64 {
        match self {
            Self::Along => 0.0,
            Self::Against => PI,
        }
    }
}

/// A point of a leg at which pieces may join.
#[derive(Clone, Copy, Debug)]
pub(super) struct Junction {
    pub(super) leg: usize,
    /// Distance from the leg's beginning, meters.
    pub(super) at_m: f64,
    pub(super) role: Role,
}

/// The purpose of a junction. At one point they stand in this order, so that a turn may end where
/// the next begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Role {
    /// `S3` of a 2-turning.
    TurnEnds(usize),
    /// Curves begin and end here.
    Station,
    /// `S1` of a 2-turning.
    TurnBegins(usize),
}

/// A 2-turning that the legs on both sides have room for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member {
    pub(super) corner: usize,
    pub(super) turning: TwoTurning,
    /// The junctions of `S1` and `S3`.
    pub(super) junctions: [usize; 2],
}

impl Member {
    /// Cost, meters: the length of the stretch that it replaces, not its own, so that the deviation
    /// alone decides among members.
    pub(super) fn cost(&self) -> f64 {
        self.turning.before_m + self.turning.after_m + self.turning.deviation_m()
    }
}

/// The polyline with its junctions, in order.
#[derive(Clone, Debug)]
pub(super) struct Roadmap {
    pub(super) line: Polyline,
    pub(super) junctions: Vec<Junction>,
    /// The junctions of each leg, its two ends among them.
    pub(super) legs: Vec<Range<usize>>,
    pub(super) members: Vec<Member>,
}

impl Roadmap {
    pub(super) fn new(line: Polyline, config: &SmoothingConfig, radius_m: f64) -> Self {
        let mut members = members(&line, config, radius_m);
        let mut junctions = Vec::new();
        let mut legs = Vec::new();
        for leg in 0..line.legs.len() {
            let first = junctions.len();
            junctions.extend(stations(&line, leg, config.station_radii * radius_m));
            junctions.extend(turn_junctions(&line, leg, &members));
            junctions[first..].sort_by(|a, b| a.at_m.total_cmp(&b.at_m).then(a.role.cmp(&b.role)));
            legs.push(first..junctions.len());
        }
        for (i, junction) in junctions.iter().enumerate() {
            match junction.role {
                Role::TurnBegins(member) => members[member].junctions[0] = i,
                Role::TurnEnds(member) => members[member].junctions[1] = i,
                Role::Station => {}
            }
        }
        Self {
            line,
            junctions,
            legs,
            members,
        }
    }

    /// The pose of the vehicle at a junction, grid coordinates.
    pub(super) fn pose(&self, junction: usize, facing: Facing) -> Pose2 {
        let Junction { leg, at_m, .. } = self.junctions[junction];
        let pose = self.line.legs[leg].start.advance(0.0, at_m);
        Pose2::at(pose.position(), pose.heading + facing.turn_rad())
    }

    /// Length of the polyline up to a junction, meters.
    pub(super) fn s_m(&self, junction: usize) -> f64 {
        let Junction { leg, at_m, .. } = self.junctions[junction];
        self.line.legs[leg].s_m + at_m
    }

    /// The next junction of the same leg, and the distance to it in meters.
    pub(super) fn next_on_leg(&self, junction: usize) -> Option<(usize, f64)> {
        let here = &self.junctions[junction];
        let next = self
            .junctions
            .get(junction + 1)
            .filter(|next| next.leg == here.leg)?;
        Some((junction + 1, next.at_m - here.at_m))
    }

    /// Whether the polyline ends at a junction.
    pub(super) fn is_end(&self, junction: usize) -> bool {
        junction + 1 == self.junctions.len()
    }

    pub(super) fn is_station(&self, junction: usize) -> bool {
        self.junctions[junction].role == Role::Station
    }
}

fn members(line: &Polyline, config: &SmoothingConfig, radius_m: f64) -> Vec<Member> {
    let room = |leg: usize| line.legs[leg].length_m;
    let of_corner = |corner: usize| {
        TwoTurning::family(line.turn_rad(corner), radius_m, config.n_members)
            .into_iter()
            .filter(move |t| t.before_m <= room(corner) && t.after_m <= room(corner + 1))
            .map(move |turning| Member {
                corner,
                turning,
                junctions: [0; 2],
            })
    };
    (0..line.n_corners()).flat_map(of_corner).collect()
}

/// Evenly spread over a leg, both ends included.
fn stations(line: &Polyline, leg: usize, spacing_m: f64) -> impl Iterator<Item = Junction> {
    let length_m = line.legs[leg].length_m;
    let n_steps = (length_m / spacing_m).ceil().max(1.0) as usize;
    (0..=n_steps).map(move |i| Junction {
        leg,
        at_m: length_m * (i as f64 / n_steps as f64),
        role: Role::Station,
    })
}

/// The junctions at which turns begin and end on a leg.
fn turn_junctions(
    line: &Polyline,
    leg: usize,
    members: &[Member],
) -> impl Iterator<Item = Junction> {
    let length_m = line.legs[leg].length_m;
    members.iter().enumerate().filter_map(move |(i, member)| {
        let turning = &member.turning;
        let (at_m, role) = if member.corner == leg {
            (length_m - turning.before_m, Role::TurnBegins(i))
        } else if member.corner + 1 == leg {
            (turning.after_m, Role::TurnEnds(i))
        } else {
            return None;
        };
        Some(Junction { leg, at_m, role })
    })
}

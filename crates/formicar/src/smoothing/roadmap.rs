//! Places on a polyline and the pieces of path that may join them.

use super::polyline::Polyline;
use super::{SmoothingConfig, TwoTurning};
use crate::geometry::{Arc, Pose2};
use std::f64::consts::PI;
use std::ops::Range;

/// How the vehicle stands on the polyline: along it, driving forward, or against it, in reverse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Facing {
    Along,
    Against,
}

impl Facing {
    /// +1 along, -1 against: the gear in which the polyline is followed.
    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Along => 1.0,
            Self::Against => -1.0,
        }
    }

    /// How a line or arc along the polyline is driven.
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
pub(super) struct Place {
    pub(super) leg: usize,
    /// Distance from the leg's beginning, metres.
    pub(super) at_m: f64,
    pub(super) role: Role,
}

/// What a place is for. In this order at one point, so that a turn may end where the next begins.
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
    /// The places of `S1` and `S3`.
    pub(super) places: [usize; 2],
}

impl Member {
    /// What it costs: not its own length but that of what it replaces, so that the deviation alone
    /// decides among members.
    pub(super) fn cost(&self) -> f64 {
        self.turning.before_m + self.turning.after_m + self.turning.deviation_m()
    }
}

/// The polyline with its places, in order.
#[derive(Clone, Debug)]
pub(super) struct Roadmap {
    pub(super) line: Polyline,
    pub(super) places: Vec<Place>,
    /// The places of each leg, its two ends among them.
    pub(super) legs: Vec<Range<usize>>,
    pub(super) members: Vec<Member>,
}

impl Roadmap {
    pub(super) fn new(line: Polyline, config: &SmoothingConfig, radius_m: f64) -> Self {
        let mut members = members(&line, config, radius_m);
        let mut places = Vec::new();
        let mut legs = Vec::new();
        for leg in 0..line.legs.len() {
            let first = places.len();
            places.extend(stations(&line, leg, config.station_radii * radius_m));
            places.extend(turn_places(&line, leg, &members));
            places[first..].sort_by(|a, b| a.at_m.total_cmp(&b.at_m).then(a.role.cmp(&b.role)));
            legs.push(first..places.len());
        }
        for (i, place) in places.iter().enumerate() {
            match place.role {
                Role::TurnBegins(member) => members[member].places[0] = i,
                Role::TurnEnds(member) => members[member].places[1] = i,
                Role::Station => {}
            }
        }
        Self {
            line,
            places,
            legs,
            members,
        }
    }

    /// How the vehicle stands at a place, grid coordinates.
    pub(super) fn pose(&self, place: usize, facing: Facing) -> Pose2 {
        let Place { leg, at_m, .. } = self.places[place];
        let pose = self.line.legs[leg].start.advance(0.0, at_m);
        Pose2::at(pose.position(), pose.heading + facing.turn_rad())
    }

    /// Length of the polyline up to a place, metres.
    pub(super) fn s_m(&self, place: usize) -> f64 {
        let Place { leg, at_m, .. } = self.places[place];
        self.line.legs[leg].s_m + at_m
    }

    /// The next place of the same leg, and how far it is in metres.
    pub(super) fn next_on_leg(&self, place: usize) -> Option<(usize, f64)> {
        let here = &self.places[place];
        let next = self
            .places
            .get(place + 1)
            .filter(|next| next.leg == here.leg)?;
        Some((place + 1, next.at_m - here.at_m))
    }

    /// Whether the polyline ends at a place.
    pub(super) fn is_end(&self, place: usize) -> bool {
        place + 1 == self.places.len()
    }

    pub(super) fn is_station(&self, place: usize) -> bool {
        self.places[place].role == Role::Station
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
                places: [0; 2],
            })
    };
    (0..line.n_corners()).flat_map(of_corner).collect()
}

/// Evenly spread over a leg, both ends included.
fn stations(line: &Polyline, leg: usize, spacing_m: f64) -> impl Iterator<Item = Place> {
    let length_m = line.legs[leg].length_m;
    let n_steps = (length_m / spacing_m).ceil().max(1.0) as usize;
    (0..=n_steps).map(move |i| Place {
        leg,
        at_m: length_m * (i as f64 / n_steps as f64),
        role: Role::Station,
    })
}

/// Where turns begin and end on a leg.
fn turn_places(line: &Polyline, leg: usize, members: &[Member]) -> impl Iterator<Item = Place> {
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
        Some(Place { leg, at_m, role })
    })
}

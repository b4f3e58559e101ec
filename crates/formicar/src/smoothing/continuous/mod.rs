//! From a chain of lines and arcs to one whose curvature is continuous.
//!
//! The path is cut at stations: the middles of its segments, and the places where the vehicle
//! stands. Between two stations, transitions replace the joints, and a solver looks for the least
//! change of curvatures and lengths with which the chain meets the second station exactly (`fit`).
//! If that fails, or the part touches an obstacle, the part begins at an earlier station. Where the
//! vehicle stands, its wheels may turn: curvatures are free there, and a part that reaches over a
//! change of gear may move it. If the shortest part to a station comes near obstacles, longer parts
//! are tried too, and the cheapest is taken.

mod chain;
mod fit;
mod stations;

use crate::collision::{Body, ClothoidDrive, MIN_CLEARANCE_M, NearbyDrive, ObstacleMap};
use crate::geometry::{Arc, Pose2};
use crate::objective::{DriveCost, DriveMeter};
use crate::path::{CurvePath, CurveSegment, Direction};
use crate::vehicle::Vehicle;
use chain::Chain;
use fit::{Limits, fit};
use stations::{Station, driven, first_chain, stations};
use thiserror::Error;

/// Most stations that one part of the path reaches over.
const MAX_SPAN: usize = 14;

/// Deviations with which a clothoid is checked, meters: most are free with the first.
const TOLERANCES_M: [f64; 2] = [1e-3, 5e-5];

/// The map, the vehicle and the limits of a continuous path.
#[derive(Clone, Debug)]
pub struct Continuity<'a> {
    /// The map.
    pub obstacles: &'a ObstacleMap,
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// Fastest change of the curvature per driven meter, 1/m^2, above 0.
    pub max_rate_per_m2: f64,
    /// The cost of driving, by which parts are compared.
    pub cost: &'a DriveCost,
}

/// The place beyond which a path cannot be made continuous.
#[derive(Clone, Debug, Error, PartialEq)]
#[error(
    "no transitions of curvature that change by at most {max_rate_per_m2:.4} 1/m^2 fit beyond ({x:.3}, {y:.3}), s = {s_m:.3} m{}",
    if *.touches { ": those tried touch obstacles" } else { ": the arcs are too short or too tight" }
)]
pub struct NoTransition {
    /// The last place that was reached, meters.
    pub x: f64,
    /// The same.
    pub y: f64,
    /// Arc length there.
    pub s_m: f64,
    /// The rate that was asked for.
    pub max_rate_per_m2: f64,
    /// Whether transitions were found that touch something.
    pub touches: bool,
}

/// A part of the result, from a station before.
#[derive(Clone)]
struct PartialPath {
    from: usize,
    chain: Chain,
    /// Cost of passing near obstacles on this part, meters.
    nearness_m: f64,
    /// Cost of the path up to its end, meters.
    cost_m: f64,
}

impl Continuity<'_> {
    /// A path with the same first and last pose, whose curvature is continuous inside each gear and
    /// changes no faster than the rate. World coordinates; lines and arcs are expected.
    ///
    /// # Errors
    /// The place beyond which no transitions fit.
    pub fn apply(&self, path: &CurvePath) -> Result<CurvePath, NoTransition> {
        let segments = driven(path.segments());
        let stations = stations(&segments);
        if stations.is_empty() {
            return Ok(path.clone());
        }
        let body = Body::new(self.vehicle);
        let mut paths: Vec<Option<PartialPath>> = vec![None; stations.len()];
        let mut touches = false;
        for to in 1..stations.len() {
            let froms = (to.saturating_sub(MAX_SPAN)..to).rev();
            let free = froms.filter_map(|from| {
                let before_m = match &paths[from] {
                    Some(path) => path.cost_m,
                    None if from == 0 => 0.0,
                    None => return None,
                };
                let ends = [&stations[from], &stations[to]];
                let chain = self.between(&segments, ends)?;
                let is_free = self.is_free(&body, &chain, ends[0].pose);
                touches |= !is_free;
                is_free.then(|| {
                    let nearness_m = self.nearness_m(&body, &chain, ends[0].pose);
                    PartialPath {
                        from,
                        nearness_m,
                        cost_m: before_m + chain.length_m() + nearness_m,
                        chain,
                    }
                })
            });
            paths[to] = cheapest(free);
        }
        assembled(&stations, &paths).ok_or_else(|| self.failure(&stations, &paths, touches))
    }

    fn limits(&self) -> Limits {
        Limits {
            max_curvature_per_m: self.vehicle.max_curvature_per_m(),
            max_rate_per_m2: self.max_rate_per_m2,
        }
    }

    fn between(&self, segments: &[CurveSegment], ends: [&Station; 2]) -> Option<Chain> {
        let mut chain = first_chain(segments, ends, self.limits());
        let target = ends[0].pose.relative(ends[1].pose);
        fit(&mut chain, target, self.limits()).then_some(chain)
    }

    /// Cost of passing near obstacles along a chain, meters.
    fn nearness_m(&self, body: &Body, chain: &Chain, start: Pose2) -> f64 {
        let cost = self.cost.of_vehicle(self.vehicle);
        let meter = DriveMeter::new(self.obstacles, body, &cost);
        let drives = self.drives(chain, start);
        let parts = drives.flat_map(|drive| drive.arcs(body, TOLERANCES_M[0]));
        let around_m = |part: NearbyDrive| {
            let arc = Arc::new(part.drive.curvature_per_m, part.drive.signed_length_m);
            meter.around_m(part.drive.start, arc, f64::INFINITY)
        };
        parts.map(around_m).sum()
    }

    /// The drives along a chain, in grid coordinates.
    fn drives<'c>(
        &self,
        chain: &'c Chain,
        start: Pose2,
    ) -> impl Iterator<Item = ClothoidDrive> + use<'c> {
        let frame = *self.obstacles.frame();
        let poses = chain.poses(start);
        chain.ramps.iter().zip(poses).map(move |(ramp, start)| {
            let [from, to] = chain.curvatures(ramp);
            ClothoidDrive {
                start: frame.to_grid(start),
                curvature_per_m: from,
                curvature_rate_per_m2: (to - from) / ramp.length_m,
                signed_length_m: ramp.sign * ramp.length_m,
            }
        })
    }

    /// Whether the body touches nothing along a chain.
    fn is_free(&self, body: &Body, chain: &Chain, start: Pose2) -> bool {
        self.drives(chain, start).all(|drive| {
            let stays = |tolerance_m: f64| {
                drive.arcs(body, tolerance_m).iter().all(|arc| {
                    let enough_m = arc.deviation_m + 2.0 * MIN_CLEARANCE_M;
                    let clearance_m = self.obstacles.drive_clearance_m(body, &arc.drive, enough_m);
                    clearance_m >= enough_m
                })
            };
            TOLERANCES_M.into_iter().any(stays)
        })
    }

    fn failure(
        &self,
        stations: &[Station],
        paths: &[Option<PartialPath>],
        touches: bool,
    ) -> NoTransition {
        let last = (0..stations.len()).rev().find(|&i| paths[i].is_some());
        let station = &stations[last.unwrap_or(0)];
        NoTransition {
            x: station.pose.x,
            y: station.pose.y,
            s_m: station.s_m,
            max_rate_per_m2: self.max_rate_per_m2,
            touches,
        }
    }
}

/// The cheapest of some paths; a path that is far from all obstacles ends the search.
fn cheapest(paths: impl Iterator<Item = PartialPath>) -> Option<PartialPath> {
    let mut best: Option<PartialPath> = None;
    for path in paths {
        let is_clear = path.nearness_m == 0.0;
        if best.as_ref().is_none_or(|best| path.cost_m < best.cost_m) {
            best = Some(path);
        }
        if is_clear {
            break;
        }
    }
    best
}

/// The partial paths that lead to the last station, as one path.
fn assembled(stations: &[Station], paths: &[Option<PartialPath>]) -> Option<CurvePath> {
    let mut parts = Vec::new();
    let mut to = stations.len() - 1;
    while to > 0 {
        let path = paths[to].as_ref()?;
        parts.push(path);
        to = path.from;
    }
    let mut segments: Vec<CurveSegment> = Vec::new();
    for path in parts.into_iter().rev() {
        for segment in segments_of(&path.chain, stations[path.from].pose) {
            match segments.last_mut() {
                Some(last) if goes_on(last, &segment) => last.length_m += segment.length_m,
                _ => segments.push(segment),
            }
        }
    }
    Some(CurvePath::from_segments(stations[0].pose, segments))
}

fn goes_on(last: &CurveSegment, next: &CurveSegment) -> bool {
    let rates = [last.curvature_rate_per_m2, next.curvature_rate_per_m2];
    rates == [0.0, 0.0]
        && last.curvature_per_m == next.curvature_per_m
        && last.direction == next.direction
}

fn segments_of(chain: &Chain, start: Pose2) -> impl Iterator<Item = CurveSegment> + '_ {
    chain
        .ramps
        .iter()
        .zip(chain.poses(start))
        .map(|(ramp, start)| {
            let [from, to] = chain.curvatures(ramp);
            CurveSegment {
                start,
                curvature_per_m: from,
                curvature_rate_per_m2: (to - from) / ramp.length_m,
                length_m: ramp.length_m,
                direction: if ramp.sign < 0.0 {
                    Direction::Reverse
                } else {
                    Direction::Forward
                },
            }
        })
}

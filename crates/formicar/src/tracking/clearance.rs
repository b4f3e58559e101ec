//! The clearance of the body along the path that it really drove.

use super::Tracking;
use crate::collision::{Body, Drive, ObstacleMap};
use crate::geometry::Pose2;
use crate::path::CurveSegment;
use crate::validation::{CURVATURE_TOLERANCE, Violation, ViolationKind, judge_path};
use crate::vehicle::Vehicle;

/// The body on its driven way: exact, as the judge measures any path.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct DrivenClearance {
    /// Least distance from the footprint (with its safety margin) to an occupied cell square or
    /// the map border, meters; 0 where it touched.
    pub min_clearance_m: f64,
    /// The pose where it is least.
    pub tightest: Pose2,
    /// Length driven to that pose, meters.
    pub tightest_driven_m: f64,
    /// The first contact of the body; null where it never touched.
    pub contact: Option<Contact>,
    /// Every stretch on which it touched; arc lengths are driven ones.
    pub violations: Vec<Violation>,
}

/// The first touch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Contact {
    /// With an occupied cell, or with the border of the map.
    pub kind: ViolationKind,
    /// Time since the drive began, seconds.
    pub t_s: f64,
    /// Length driven, meters.
    pub driven_m: f64,
    /// Arc length of the path's nearest place, meters.
    pub s_m: f64,
    /// The pose of the vehicle.
    pub pose: Pose2,
}

impl Tracking {
    /// The body's exact clearance along the driven way.
    ///
    /// The vehicle must be the one that was driven. A collision does not stop the drive: it shows
    /// where the controller would have led.
    pub fn clearance(&self, obstacles: &ObstacleMap, vehicle: &Vehicle) -> DrivenClearance {
        let report = judge_path(obstacles, vehicle, &self.driven, CURVATURE_TOLERANCE);
        let touches =
            |v: &Violation| matches!(v.kind, ViolationKind::Collision | ViolationKind::LeavesMap);
        let violations: Vec<_> = report.violations.into_iter().filter(touches).collect();
        let first = violations.first();
        let contact = first.map(|first| self.first_contact(obstacles, vehicle, first.kind));
        DrivenClearance {
            min_clearance_m: report.min_clearance_m,
            tightest: report.tightest,
            tightest_driven_m: report.tightest_s_m,
            contact,
            violations,
        }
    }

    fn first_contact(
        &self,
        obstacles: &ObstacleMap,
        vehicle: &Vehicle,
        kind: ViolationKind,
    ) -> Contact {
        let body = Body::new(vehicle);
        let is_free = |segment: &CurveSegment, length_m: f64| {
            let drive = Drive {
                start: obstacles.frame().to_grid(segment.start),
                curvature_per_m: segment.curvature_per_m,
                signed_length_m: segment.direction.sign() * length_m,
            };
            obstacles.is_free(&body, &drive)
        };
        let segments = self.driven.segments();
        let touches = |segment: &CurveSegment| !is_free(segment, segment.length_m);
        // A vehicle that never moved touches without a segment.
        let (driven_m, pose) = match segments.iter().position(touches) {
            None => (0.0, self.driven.start()),
            Some(i) => {
                let within_m = first_failure(segments[i].length_m, |m| is_free(&segments[i], m));
                let before_m: f64 = segments[..i].iter().map(|s| s.length_m).sum();
                (before_m + within_m, segments[i].pose_at(within_m))
            }
        };
        let (a, b, share) = self.at_driven_m(driven_m);
        let between = |a: f64, b: f64| a + share * (b - a);
        Contact {
            kind,
            t_s: between(a.t_s, b.t_s),
            driven_m,
            s_m: between(a.s_m, b.s_m),
            pose: pose.wrapped(),
        }
    }
}

/// The least length, to a billionth of the whole, that is not free; the whole is not.
fn first_failure(whole: f64, is_free: impl Fn(f64) -> bool) -> f64 {
    if !is_free(0.0) {
        return 0.0;
    }
    let (mut free, mut touching) = (0.0, whole);
    for _ in 0..30 {
        let middle = 0.5 * (free + touching);
        if is_free(middle) {
            free = middle;
        } else {
            touching = middle;
        }
    }
    touching
}

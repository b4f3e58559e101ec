//! The region that a body sweeps along a clothoid: that of short arcs with a proven deviation.
//!
//! Take a piece of half length h about its middle, with curvature k there and rate c. The heading of
//! the arc of curvature k through the middle differs by `c t^2 / 2` at the distance t. Turned about
//! the middle by `c h^2 / 4`, it differs by `d(t) = c (t^2 / 2 - h^2 / 4)`, at most `|c| h^2 / 4` on the
//! piece. Unit vectors whose angles differ by d are at most |d| apart, so that the rear axle is off
//! by at most the integral of |d| from 0 to h: `|c| h^3 (2 sqrt(2) - 1) / 12 < |c| h^3 / 6`. A body
//! point at most R from the rear axle is off by at most R times the heading's difference more. So
//! every body point, at every moment, is within
//!
//! `|c| h^2 (R / 4 + h / 6)`
//!
//! of where the arc has it, and the clearance of the clothoid is at least that of the arc less this.

use super::{Body, Drive};
use crate::geometry::Pose2;

/// A motion along a clothoid, grid coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClothoidDrive {
    /// The first pose.
    pub start: Pose2,
    /// Curvature at the start, positive left.
    pub curvature_per_m: f64,
    /// Change of the curvature per meter driven.
    pub curvature_rate_per_m2: f64,
    /// Driven length, negative in reverse.
    pub signed_length_m: f64,
}

/// An arc in the place of a part of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearbyDrive {
    /// The arc.
    pub drive: Drive,
    /// No body point is farther than this from where the arc has it, meters; 0 for a line or arc.
    pub deviation_m: f64,
}

/// No more arcs than this for one clothoid: the deviation grows instead, and stays proven.
const MAX_ARCS: f64 = 1e6;

impl ClothoidDrive {
    /// Arcs from which no body point deviates by more than a tolerance (unless that takes more than
    /// a million of them). A rate of 0 gives the arc itself.
    pub fn arcs(&self, body: &Body, tolerance_m: f64) -> Vec<NearbyDrive> {
        let rate = self.curvature_rate_per_m2.abs();
        if rate == 0.0 {
            return vec![NearbyDrive {
                drive: Drive {
                    start: self.start,
                    curvature_per_m: self.curvature_per_m,
                    signed_length_m: self.signed_length_m,
                },
                deviation_m: 0.0,
            }];
        }
        let length_m = self.signed_length_m.abs();
        // No half length above the cube root holds the second term of the bound alone; with the
        // least that is certain put in there, the first term gives the half length.
        let most_m = (6.0 * tolerance_m / rate).cbrt().min(0.5 * length_m);
        let half_m = (12.0 * tolerance_m / (rate * (3.0 * body.reach_m() + 2.0 * most_m))).sqrt();
        let n_arcs = (0.5 * length_m / half_m).ceil().clamp(1.0, MAX_ARCS);
        let half_m = 0.5 * length_m / n_arcs;
        let deviation_m = rate * half_m * half_m * (body.reach_m() / 4.0 + half_m / 6.0);
        (0..n_arcs as usize)
            .map(|i| NearbyDrive {
                drive: self.arc_about((2.0 * i as f64 + 1.0) * half_m, half_m),
                deviation_m,
            })
            .collect()
    }

    /// The arc for the part of half length `half_m` about a place, turned for the least deviation.
    fn arc_about(&self, middle_m: f64, half_m: f64) -> Drive {
        let sign = self.signed_length_m.signum();
        let signed_rate = sign * self.curvature_rate_per_m2;
        let mut middle =
            self.start
                .advance_clothoid(self.curvature_per_m, signed_rate, sign * middle_m);
        middle.heading += 0.25 * signed_rate * half_m * half_m;
        let curvature_per_m = self.curvature_per_m + self.curvature_rate_per_m2 * middle_m;
        Drive {
            start: middle.advance(curvature_per_m, -sign * half_m),
            curvature_per_m,
            signed_length_m: 2.0 * sign * half_m,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicle::Vehicle;
    use proptest::prelude::*;

    proptest! {
        /// The bound against the truth: no corner of the body is off by more, and the bound is not
        /// far from what is reached.
        #[test]
        fn body_points_stay_within_the_deviation(
            curvature_per_m in -0.5..0.5_f64,
            curvature_rate_per_m2 in -1.0..1.0_f64,
            signed_length_m in -4.0..4.0_f64,
            tolerance_m in 1e-5..1e-2_f64,
        ) {
            let body = Body::new(&Vehicle::sedan());
            let start = Pose2::new(1.0, 2.0, 0.5);
            let clothoid = ClothoidDrive { start, curvature_per_m, curvature_rate_per_m2, signed_length_m };
            let arcs = clothoid.arcs(&body, tolerance_m);
            let n_arcs = arcs.len();
            let signed_rate = signed_length_m.signum() * curvature_rate_per_m2;
            for (i, arc) in arcs.iter().enumerate() {
                prop_assert!(arc.deviation_m <= tolerance_m * (1.0 + 1e-9));
                let mut worst = 0.0_f64;
                for j in 0..=20 {
                    let share = f64::from(j) / 20.0;
                    let driven = signed_length_m * (i as f64 + share) / n_arcs as f64;
                    let truth = start.advance_clothoid(curvature_per_m, signed_rate, driven);
                    let near = arc.drive.pose_at(share);
                    for &corner in &body.corners {
                        worst = worst.max(truth.transform(corner).distance(near.transform(corner)));
                    }
                }
                prop_assert!(worst <= arc.deviation_m + 1e-12, "{worst} {}", arc.deviation_m);
                prop_assert!(worst >= 0.5 * arc.deviation_m - 1e-12, "{worst} {}", arc.deviation_m);
            }
        }
    }

    #[test]
    fn a_rate_of_zero_is_the_arc_itself() {
        let clothoid = ClothoidDrive {
            start: Pose2::new(1.0, 2.0, 0.5),
            curvature_per_m: 0.3,
            curvature_rate_per_m2: 0.0,
            signed_length_m: -2.0,
        };
        let arcs = clothoid.arcs(&Body::new(&Vehicle::sedan()), 1e-4);
        assert_eq!(arcs.len(), 1);
        assert_eq!(
            (arcs[0].deviation_m, arcs[0].drive.start),
            (0.0, clothoid.start)
        );
    }
}

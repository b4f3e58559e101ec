//! Collision checks of drives, by steps as long as the estimated clearance allows.

use super::{Body, Drive, MIN_CLEARANCE_M, ObstacleMap};

/// The estimate exceeds the truth by less than this, cells: distances between centers,
/// interpolated, exceed the true ones by less than 0.15, and a square reaches from its center to
/// its corner by 0.21 more than to its side.
const OVERESTIMATE_CELLS: f64 = 0.4;
/// Length of the stretches that are checked exactly where the estimate cannot decide, in half
/// lengths of the body.
const EXACT_HALF_LENGTHS: f64 = 0.5;
/// Clearances beyond this are not distinguished, in half lengths of the body.
const ENOUGH_HALF_LENGTHS: f64 = 4.0;

impl ObstacleMap {
    /// The least clearance of a body along a drive as [`Self::drive_clearance_m`] finds it, faster
    /// on long drives, for clearances between two limits, meters: any value up to the lower limit
    /// where it is below that, and the upper one where it is above that.
    pub fn drive_clearance_by_steps_m(
        &self,
        body: &Body,
        drive: &Drive,
        [low_m, high_m]: [f64; 2],
    ) -> f64 {
        let mut least_m = high_m;
        self.march(body, drive, high_m, |part| {
            least_m = self.drive_clearance_m(body, part, least_m);
            (least_m > low_m).then_some(least_m)
        });
        least_m
    }

    /// Same result as [`Self::is_free`], faster on long drives that mostly keep some distance.
    pub fn is_free_by_steps(&self, body: &Body, drive: &Drive) -> bool {
        let mut is_free = true;
        self.march(body, drive, MIN_CLEARANCE_M, |part| {
            is_free = self.is_free(body, part);
            is_free.then_some(MIN_CLEARANCE_M)
        });
        is_free
    }

    /// Hands over the stretches of a drive on which the clearance may be less than a needed one.
    /// The look at a stretch returns the clearance needed from there on; none ends the march.
    ///
    /// If the estimated clearance of a pose is c, no point of the body comes nearer to anything
    /// than n before it has moved by c - n less the estimate's error: the drive keeps n that far
    /// on both sides.
    fn march(
        &self,
        body: &Body,
        drive: &Drive,
        mut needed_m: f64,
        mut look: impl FnMut(&Drive) -> Option<f64>,
    ) {
        let length_m = drive.signed_length_m.abs();
        let half_m = body.half.x.max(body.half.y);
        let stretch_m = EXACT_HALF_LENGTHS * half_m;
        if body.inset > 0.0 || length_m <= stretch_m {
            look(drive);
            return;
        }
        let error_m = OVERESTIMATE_CELLS * self.frame().resolution_m();
        // How much any point of the body moves while the rear axle moves by 1.
        let lever = 1.0 + drive.curvature_per_m.abs() * body.reach_m();
        let (mut known_m, mut at_m) = (0.0, 0.0);
        while known_m < length_m {
            let pose = drive.pose_at(at_m / length_m);
            let enough_m = needed_m + ENOUGH_HALF_LENGTHS * half_m;
            let estimate_m = self.clearance_estimate_m(body, pose, enough_m);
            let room_m = (estimate_m - error_m - needed_m) / lever;
            if room_m > 0.25 * stretch_m && at_m - room_m < known_m {
                known_m = at_m + room_m;
                at_m = known_m + 0.75 * room_m;
            } else {
                let to_m = (known_m + stretch_m).min(length_m);
                match look(&drive.between(known_m / length_m, to_m / length_m)) {
                    Some(more_m) => needed_m = more_m,
                    None => return,
                }
                (known_m, at_m) = (to_m, to_m);
            }
            at_m = at_m.min(length_m);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose2;
    use crate::map::generate::{ScatterParameters, scattered_obstacles};
    use crate::numeric::Seed;
    use crate::vehicle::Vehicle;

    #[test]
    fn answers_as_the_exact_check_does() {
        let parameters = ScatterParameters {
            density: 0.01,
            ..ScatterParameters::default()
        };
        let (mut n_free, mut n_hits) = (0, 0);
        for (seed, vehicle) in [Vehicle::lei2020(), Vehicle::f1tenth()]
            .into_iter()
            .enumerate()
        {
            let map = scattered_obstacles(&parameters, Seed(seed as u64)).unwrap();
            let map = ObstacleMap::new(&map);
            let body = Body::new(&vehicle);
            let extent = map.frame().extent_m();
            let mut stream = Seed(6).stream([seed as u64, 0]);
            for _ in 0..3_000 {
                let (x, y) = (stream.range(0.0, extent.x), stream.range(0.0, extent.y));
                let drive = Drive {
                    start: Pose2::new(x, y, stream.range(-3.0, 3.0)),
                    curvature_per_m: [0.0, stream.range(-0.5, 0.5)][stream.below(2)],
                    signed_length_m: stream.range(-10.0, 10.0),
                };
                let least_m = map.drive_clearance_m(&body, &drive, 0.5);
                let by_steps_m = map.drive_clearance_by_steps_m(&body, &drive, [0.1, 0.5]);
                if least_m > 0.1 {
                    assert!((by_steps_m - least_m).abs() < 1e-6, "{drive:?}");
                } else {
                    assert!((0.0..0.1 + 1e-6).contains(&by_steps_m), "{drive:?}");
                }
                let is_free = map.is_free(&body, &drive);
                assert_eq!(map.is_free_by_steps(&body, &drive), is_free, "{drive:?}");
                *(if is_free { &mut n_free } else { &mut n_hits }) += 1;
            }
        }
        assert!(n_free > 200 && n_hits > 200, "{n_free} {n_hits}");
    }
}

//! Regulated pure pursuit: slower in turns, near obstacles and toward the goal.

use super::controller::{DriveCommand, DriveController, DriveMoment};
use crate::parameters::parameters;
use crate::tracking::stretch::faced;

parameters! {
    /// Pure pursuit whose lookahead grows with the speed, and whose speed is regulated by curvature,
    /// by the distance of obstacles and by the distance of the end (S. Macenski, S. Singh, F. Martín
    /// and J. Ginés, *Regulated pure pursuit for robot path tracking*, Autonomous Robots 47, 2023).
    #[derive(Copy)]
    pub struct RegulatedPurePursuit {
        /// Lookahead as a time, seconds; the lookahead distance is the speed times it.
        #[range(0.05..=10.0)]
        pub lookahead_time_s: f64 = 1.0,
        /// Least lookahead, meters; half a wheelbase where left out.
        #[range(0.01..=100.0)]
        pub min_lookahead_m: Option<f64> = None,
        /// Largest lookahead, meters; two wheelbases where left out.
        #[range(0.01..=100.0)]
        pub max_lookahead_m: Option<f64> = None,
        /// Radius of a turn below which the speed falls in proportion, meters.
        #[range(0.0..=100.0)]
        pub slow_radius_m: f64 = 0.9,
        /// Distance of obstacles below which the speed falls in proportion, meters.
        #[range(0.0..=100.0)]
        pub slow_clearance_m: f64 = 0.2,
        /// Length before a stop below which the speed falls in proportion, meters.
        #[range(0.0..=100.0)]
        pub approach_m: f64 = 0.3,
        /// The speed below which it is not regulated, meters per second.
        #[range(0.001..=100.0)]
        pub min_speed_mps: f64 = 0.1,
    }
}

impl RegulatedPurePursuit {
    pub(in crate::tracking) fn for_wheelbase(self, wheelbase_m: f64) -> Self {
        let min_lookahead_m = self.min_lookahead_m.unwrap_or(0.5 * wheelbase_m);
        let most_m = (2.0 * wheelbase_m).max(min_lookahead_m);
        Self {
            min_lookahead_m: Some(min_lookahead_m),
            max_lookahead_m: Some(self.max_lookahead_m.unwrap_or(most_m)),
            ..self
        }
    }

    /// Macenski et al. 2023 (1): the lookahead at a speed.
    fn lookahead_m(&self, speed_mps: f64, wheelbase_m: f64) -> f64 {
        let this = self.for_wheelbase(wheelbase_m);
        let least_m = this.min_lookahead_m.unwrap_or(0.0);
        let most_m = this.max_lookahead_m.unwrap_or(f64::INFINITY);
        (speed_mps * self.lookahead_time_s).max(least_m).min(most_m)
    }

    /// Macenski et al. 2023 (4) to (6): the slowest of the regulated speeds, but not below the least
    /// speed, and never above the one wished for.
    fn regulated_mps(&self, wished_mps: f64, at: &DriveMoment, curvature_per_m: f64) -> f64 {
        let share = |value: f64, full: f64| {
            if full > 0.0 {
                (value / full).min(1.0)
            } else {
                1.0
            }
        };
        let by_turn = share(1.0 / curvature_per_m.abs(), self.slow_radius_m);
        let by_clearance = share(at.clearance_m.max(0.0), self.slow_clearance_m);
        let left_m = at.stretch_m[1].min(at.reference.end().s_m) - at.s_m;
        let by_approach = share(left_m.max(0.0), self.approach_m);
        let regulated = wished_mps * by_turn.min(by_clearance).min(by_approach);
        regulated.max(self.min_speed_mps).min(wished_mps)
    }
}

impl DriveController for RegulatedPurePursuit {
    fn name(&self) -> &'static str {
        "regulated-pure-pursuit"
    }

    fn command(&mut self, at: &DriveMoment) -> DriveCommand {
        let wheelbase_m = at.limits.wheelbase_m;
        let lookahead_m = self.lookahead_m(at.state.speed_mps.abs(), wheelbase_m);
        let ahead = at.stretch.pose_at(at.foot_m + lookahead_m);
        let pose = faced(at.state.pose, at.direction);
        let point = pose.relative(ahead).position();
        let squared_m2 = point.dot(point);
        // Macenski et al. 2023 (2): the curvature to the point ahead.
        let curvature_per_m = if squared_m2 > 0.0 {
            2.0 * point.y / squared_m2
        } else {
            0.0
        };
        let speed_mps = self.regulated_mps(at.scheduled_speed_mps(), at, curvature_per_m);
        let steer_rad = (wheelbase_m * curvature_per_m).atan();
        at.drive(speed_mps, at.direction.sign() * steer_rad)
    }
}

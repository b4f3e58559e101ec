//! The Stanley law (Hoffmann et al. 2007): the front wheels along the path, and towards it.

use super::view::View;
use crate::geometry::{Point2, wrap_angle};
use crate::parameters::parameters;

parameters! {
    /// Steers by the heading error and by the front axle's cross-track error (G. M. Hoffmann, C. J.
    /// Tomlin, M. Montemerlo and S. Thrun, *Autonomous automobile trajectory tracking for off-road
    /// driving*, 2007; S. Thrun et al., *Stanley: the robot that won the DARPA Grand Challenge*,
    /// 2006).
    #[derive(Copy)]
    pub struct Stanley {
        /// Rate at which the front axle comes back to the path, 1/s.
        #[range(0.01..=100.0)]
        pub gain_per_s: f64 = 1.0,
        /// Added to the speed, so that a slow vehicle turns its wheels less, m/s.
        #[range(0.0..=100.0)]
        pub softening_mps: f64 = 0.0,
    }
}

impl Stanley {
    /// psi + atan(k e / (v + softening)) (Hoffmann 2007, sec. III).
    ///
    /// The path is that of the rear axle. Over it the front axle draws a track of its own, whose
    /// tangent is the heading plus the path's steering angle; psi and e are those of that track.
    pub(super) fn steer_rad(self, view: &View) -> f64 {
        let (stretch, wheelbase_m) = (view.stretch, view.wheelbase_m);
        let ahead = Point2::new(wheelbase_m, 0.0);
        let front = view.pose.transform(ahead);
        let foot_m = stretch.foot_m(front, wheelbase_m, view.foot_m);
        let nearest = stretch.pose_at(foot_m);
        let path_steer_rad = (wheelbase_m * stretch.curvature_at(foot_m)).atan();
        let tangent_rad = nearest.heading + path_steer_rad;
        let off = front - nearest.transform(ahead);
        let to_the_right_m = off.cross(Point2::unit(tangent_rad));
        let towards_rad =
            (self.gain_per_s * to_the_right_m).atan2(view.speed_mps + self.softening_mps);
        wrap_angle(tangent_rad - view.pose.heading) + towards_rad
    }
}

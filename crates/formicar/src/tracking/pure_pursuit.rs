//! Pure pursuit (Coulter 1992): the circle to a point ahead.

use super::view::View;
use crate::parameters::parameters;

parameters! {
    /// Steers along the circle that touches the heading at the rear axle and passes through a point
    /// ahead on the path (R. C. Coulter, *Implementation of the pure pursuit path tracking
    /// algorithm*, 1992).
    #[derive(Copy, Default)]
    pub struct PurePursuit {
        /// How far ahead of the nearest place the point lies along the path, meters; half a
        /// wheelbase where left out.
        #[range(0.01..=100.0)]
        pub lookahead_m: Option<f64>,
    }
}

impl PurePursuit {
    /// Lookahead where none is given, in wheelbases.
    pub const DEFAULT_LOOKAHEAD_WHEELBASES: f64 = 0.5;

    pub(super) fn for_wheelbase(self, wheelbase_m: f64) -> Self {
        let usual_m = Self::DEFAULT_LOOKAHEAD_WHEELBASES * wheelbase_m;
        Self {
            lookahead_m: self.lookahead_m.or(Some(usual_m)),
        }
    }

    /// atan(wheelbase 2 y / l^2), where the point lies l away and y to the left (Coulter 1992).
    pub(super) fn steer_rad(self, view: &View) -> f64 {
        let usual_m = Self::DEFAULT_LOOKAHEAD_WHEELBASES * view.wheelbase_m;
        let ahead_m = view.foot_m + self.lookahead_m.unwrap_or(usual_m);
        let point = view.pose.relative(view.stretch.pose_at(ahead_m)).position();
        let squared_m2 = point.dot(point);
        if squared_m2 == 0.0 {
            return 0.0;
        }
        (view.wheelbase_m * 2.0 * point.y / squared_m2).atan()
    }
}

//! Curves that may join two poses: many cheap ones, of which few are looked at closely.

use super::task::ImproveTask;
use crate::geometry::joins::{Corner, Tangents};
use crate::geometry::{Curve, Pose2, dubins, reeds_shepp};
use crate::numeric::RandomStream;
use crate::vehicle::Gears;

/// In which gears two poses may be joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JoinGears {
    Forward,
    Reverse,
    Both,
}

/// Sides on which the first and the last arc may turn.
const SIDES: [[f64; 2]; 4] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
/// Share of arcs of the least turning radius.
const TIGHTEST_SHARE: f64 = 0.35;
/// The widest arcs that are drawn, as a share of the distance.
const WIDEST_DISTANCES: f64 = 3.0;
/// Words of Dubins with three arcs matter between poses nearer than this, turning radii.
const TURNING_RADII: f64 = 6.0;
/// Corners drawn besides the widest one.
const N_CORNERS: usize = 2;

/// Two poses that are to be joined.
#[derive(Clone, Copy)]
pub(super) struct Gap {
    pub(super) from: Pose2,
    pub(super) to: Pose2,
    /// Curvatures with which the path comes and goes on: arcs that keep them need no change.
    pub(super) curvatures_per_m: [f64; 2],
}

impl Gap {
    /// The same gap driven in the opposite direction.
    fn swapped(self) -> Self {
        let [before, after] = self.curvatures_per_m;
        Self {
            from: self.to,
            to: self.from,
            curvatures_per_m: [after, before],
        }
    }

    /// Curves over the gap in some gears.
    pub(super) fn curves(
        self,
        task: &ImproveTask,
        gears: JoinGears,
        stream: &mut RandomStream,
    ) -> Vec<Curve> {
        let mut curves = Vec::with_capacity(24);
        match gears {
            JoinGears::Forward => self.push_forward(task, stream, &mut curves),
            JoinGears::Reverse => {
                self.swapped().push_forward(task, stream, &mut curves);
                for curve in &mut curves {
                    *curve = curve.driven_back();
                }
            }
            JoinGears::Both => {
                let radius_m = self.draw_radius_m(task, stream);
                for radius_m in [task.radius_m, radius_m] {
                    curves.extend(reeds_shepp::shortest(self.from, self.to, radius_m));
                }
            }
        }
        curves
    }

    fn push_forward(&self, task: &ImproveTask, stream: &mut RandomStream, curves: &mut Vec<Curve>) {
        self.push_tangents(task, stream, curves);
        self.push_corners(task, stream, curves);
        if self.distance_m() < TURNING_RADII * task.radius_m {
            curves.extend(dubins::shortest(self.from, self.to, task.radius_m));
        }
    }

    fn push_tangents(
        &self,
        task: &ImproveTask,
        stream: &mut RandomStream,
        curves: &mut Vec<Curve>,
    ) {
        let mut radii = |curvature_per_m: f64| {
            let drawn_m = self.draw_radius_m(task, stream);
            let kept_m = if curvature_per_m == 0.0 {
                self.draw_radius_m(task, stream)
            } else {
                (1.0 / curvature_per_m.abs()).max(task.radius_m)
            };
            [kept_m, drawn_m]
        };
        let [first, last] = self.curvatures_per_m;
        let (firsts, lasts) = (radii(first), radii(last));
        let tangents = Tangents::between(self.from, self.to);
        for r1 in firsts {
            for r2 in lasts {
                let curves_of_sides = SIDES
                    .iter()
                    .filter_map(|[side1, side2]| tangents.curve([side1 * r1, side2 * r2]));
                curves.extend(curves_of_sides);
            }
        }
    }

    fn push_corners(&self, task: &ImproveTask, stream: &mut RandomStream, curves: &mut Vec<Curve>) {
        let Some(corner) = Corner::between(self.from, self.to) else {
            return;
        };
        let widest_m = corner.widest_m();
        if widest_m < task.radius_m {
            return;
        }
        curves.push(corner.rounded(widest_m));
        for _ in 0..N_CORNERS {
            let radius_m = log_uniform(stream, task.radius_m, widest_m);
            curves.push(corner.rounded(radius_m));
        }
    }

    fn draw_radius_m(&self, task: &ImproveTask, stream: &mut RandomStream) -> f64 {
        let widest_m = WIDEST_DISTANCES * self.distance_m();
        if stream.unit() < TIGHTEST_SHARE {
            return task.radius_m;
        }
        log_uniform(stream, task.radius_m, widest_m)
    }

    fn distance_m(&self) -> f64 {
        self.from.position().distance(self.to.position())
    }
}

impl JoinGears {
    /// Whether a request allows them.
    pub(super) fn are_allowed(self, allowed: Gears) -> bool {
        allowed == Gears::Both || self == Self::Forward
    }
}

/// A number whose logarithm is uniform; the low end where the range is empty.
pub(super) fn log_uniform(stream: &mut RandomStream, low: f64, high: f64) -> f64 {
    low * (stream.unit() * (high / low).ln().max(0.0)).exp()
}

//! The operators of local search: connect two places of the path anew, move a place, remove a
//! change of gear.

use super::chain::{Chain, PathPosition, Piece};
use super::joins::{Gap, JoinGears, log_uniform};
use super::task::ImproveTask;
use super::window::{Route, Window};
use crate::geometry::{Curve, Pose2};
use crate::numeric::RandomStream;

/// Shortest stretches that are replaced, turning radii.
const SHORTEST_RADII: f64 = 0.5;
/// Longest stretches on either side of a place that is moved, turning radii.
const SHIFT_REACH_RADII: f64 = 12.0;
/// Least and largest shift of a place, turning radii.
const SHIFT_RADII: [f64; 2] = [0.005, 1.0];
/// Least and largest turn of a place, radians.
const TURN_RAD: [f64; 2] = [0.003, 0.5];
/// Largest distance from a change of gear at which its surroundings are replaced, turning radii.
const CUSP_REACH_RADII: f64 = 10.0;
/// Share of the ends of stretches that are moved onto a joint.
const JOINT_SHARE: f64 = 0.5;
/// Both gears are tried in a stretch without reverse if it is shorter than this, turning radii.
const BOTH_GEARS_RADII: f64 = 8.0;
/// Curves kept on each side of a place that is moved.
const N_SIDE_CURVES: usize = 3;

/// One random change of a path.
pub(super) struct Attempt<'a> {
    pub(super) task: &'a ImproveTask<'a>,
    pub(super) chain: &'a mut Chain,
    pub(super) stream: RandomStream,
}

impl Attempt<'_> {
    /// Connects two random places; returns whether the path became cheaper.
    pub(super) fn shortcut(&mut self) -> bool {
        let length_m = self.chain.length_m;
        let shortest_m = SHORTEST_RADII * self.task.radius_m;
        let window_m = log_uniform(&mut self.stream, shortest_m, length_m);
        // Stretches may reach over the ends, so that these are as well covered as the middle.
        let middle_m = self.stream.range(0.0, length_m);
        let ends_m = [middle_m - 0.5 * window_m, middle_m + 0.5 * window_m];
        let ends_m = ends_m.map(|end_m| {
            if self.stream.unit() < JOINT_SHARE {
                self.chain.nearest_joint_m(end_m)
            } else {
                end_m.clamp(0.0, length_m)
            }
        });
        self.join(ends_m, false)
    }

    /// Connects places on both sides of one or several changes of gear; returns whether the path
    /// became cheaper.
    pub(super) fn without_cusp(&mut self, cusps_m: &[f64]) -> bool {
        let first = self.stream.below(cusps_m.len());
        let last = (first + self.stream.below(3)).min(cusps_m.len() - 1);
        let reach_m = CUSP_REACH_RADII * self.task.radius_m;
        let mut reach = || log_uniform(&mut self.stream, 0.02 * reach_m, reach_m);
        let ends_m = [cusps_m[first] - reach(), cusps_m[last] + reach()];
        self.join(
            ends_m.map(|end_m| end_m.clamp(0.0, self.chain.length_m)),
            true,
        )
    }

    /// Connects two places, given as driven lengths; returns whether the path became cheaper.
    pub(super) fn join(&mut self, [from_m, to_m]: [f64; 2], any_gears: bool) -> bool {
        if to_m <= from_m {
            return false;
        }
        let (from, to) = (self.chain.position(from_m), self.chain.position(to_m));
        let gears = if any_gears {
            vec![JoinGears::Forward, JoinGears::Reverse, JoinGears::Both]
        } else {
            self.gears_between(from, to)
        };
        let end = self.chain.pose(to);
        self.join_to([from, to], end, &gears)
    }

    /// Ends the path elsewhere within the goal's tolerance: before its end, or at a pose that a
    /// curve leads to; returns whether the path became cheaper.
    pub(super) fn move_end(&mut self) -> bool {
        let Some(region) = self.task.end else {
            return false;
        };
        let length_m = self.chain.length_m;
        let last = self.chain.position(length_m);
        if self.stream.below(2) == 0 {
            let cut_m = self.stream.range(0.0, 2.0 * region.tolerance().xy_m);
            let at = self.chain.position((length_m - cut_m).max(0.0));
            let end = self.chain.pose(at);
            let is_start = at.piece == 0 && at.driven_m == 0.0;
            return !is_start && region.contains(end) && self.cut(at, last);
        }
        let radius_m = self.task.radius_m;
        let (shortest_m, longest_m) = (SHORTEST_RADII * radius_m, SHIFT_REACH_RADII * radius_m);
        let reach_m = log_uniform(&mut self.stream, shortest_m, longest_m);
        let from = self.chain.position((length_m - reach_m).max(0.0));
        let draws = [0; 3].map(|_| self.stream.unit());
        let Some(end) = region.pose_near(self.chain.pose(last), draws) else {
            return false;
        };
        if from == last {
            return false;
        }
        let gears = self.gears_between(from, last);
        self.join_to([from, last], end, &gears)
    }

    /// Leaves out what comes after a place.
    fn cut(&mut self, at: PathPosition, last: PathPosition) -> bool {
        let route = Route {
            start: self.chain.pose(at),
            curves: [Curve::default(), Curve::default()],
            bound_m: 0.0,
            low_m: 0.0,
        };
        let mut window = Window::new(self.task, self.chain, at, last);
        window.settle(self.task);
        window.replace(self.task, self.chain, &route)
    }

    /// Connects a place with a pose that takes that of a later one.
    fn join_to(&mut self, [from, to]: [PathPosition; 2], end: Pose2, gears: &[JoinGears]) -> bool {
        let curves = self.curves([from, to], end, gears);
        let window = Window::new(self.task, self.chain, from, to);
        let start = self.chain.pose(from);
        let routes = curves.into_iter().filter_map(|curve| {
            window.bounded(
                self.task,
                Route {
                    start,
                    curves: [curve, Curve::default()],
                    bound_m: 0.0,
                    low_m: 0.0,
                },
            )
        });
        let routes = routes.collect();
        self.take_best(window, routes)
    }

    /// Shifts and turns a random place, and connects it anew on both sides; returns whether the path
    /// became cheaper.
    pub(super) fn shift(&mut self) -> bool {
        let (length_m, radius_m) = (self.chain.length_m, self.task.radius_m);
        let middle_m = self.stream.range(0.0, length_m);
        let shortest_m = SHORTEST_RADII * radius_m;
        let mut reach = || log_uniform(&mut self.stream, shortest_m, SHIFT_REACH_RADII * radius_m);
        let ends_m = [middle_m - reach(), middle_m + reach()];
        let ends_m = ends_m.map(|end_m| end_m.clamp(0.0, length_m));
        let [from, middle, to] = [ends_m[0], middle_m, ends_m[1]].map(|m| self.chain.position(m));
        if from == middle || middle == to {
            return false;
        }
        let via = self.moved(middle);
        let ends =
            [from, to].map(|position| (self.chain.pose(position), self.curvature_at(position)));
        let gaps = [
            Gap {
                from: ends[0].0,
                to: via,
                curvatures_per_m: [ends[0].1, 0.0],
            },
            Gap {
                from: via,
                to: ends[1].0,
                curvatures_per_m: [0.0, ends[1].1],
            },
        ];
        let sides = [(from, middle), (middle, to)].map(|(a, b)| self.gears_between(a, b));
        let [before, after] = [0, 1].map(|side| self.best_curves(gaps[side], &sides[side]));
        let window = Window::new(self.task, self.chain, from, to);
        let pairs = before
            .iter()
            .flat_map(|&a| after.iter().map(move |&b| [a, b]));
        let routes = pairs.filter_map(|curves| {
            window.bounded(
                self.task,
                Route {
                    start: ends[0].0,
                    curves,
                    bound_m: 0.0,
                    low_m: 0.0,
                },
            )
        });
        let routes = routes.collect();
        self.take_best(window, routes)
    }

    /// A pose beside that of a place, on the side with more clearance or on a random side.
    fn moved(&mut self, position: PathPosition) -> Pose2 {
        let pose = self.chain.pose(position);
        let [least, most] = SHIFT_RADII.map(|radii| radii * self.task.radius_m);
        let by_m = log_uniform(&mut self.stream, least, most);
        let turn_rad = log_uniform(&mut self.stream, TURN_RAD[0], TURN_RAD[1]);
        let turn_rad = match self.stream.below(3) {
            0 => 0.0,
            1 => turn_rad,
            _ => -turn_rad,
        };
        let beside = |by_m: f64| pose.compose(Pose2::new(0.0, by_m, turn_rad));
        let sides = [beside(by_m), beside(-by_m)];
        let follows_room = self.stream.below(2) == 0;
        let side = self.stream.below(2);
        let task = self.task;
        let [left_m, right_m] =
            sides.map(|pose| task.obstacles.clearance_estimate_m(task.body, pose, by_m));
        if follows_room && left_m != right_m {
            sides[usize::from(right_m > left_m)]
        } else {
            sides[side]
        }
    }

    /// The cheapest curves over a gap if there were no obstacles.
    fn best_curves(&mut self, gap: Gap, gears: &[JoinGears]) -> Vec<Curve> {
        let mut curves: Vec<(f64, Curve)> = Vec::new();
        for &gears in gears {
            let found = gap.curves(self.task, gears, &mut self.stream).into_iter();
            curves.extend(found.map(|curve| (self.open_ground_m(&curve), curve)));
        }
        curves.sort_by(|a, b| a.0.total_cmp(&b.0));
        curves.truncate(N_SIDE_CURVES);
        curves.into_iter().map(|(_, curve)| curve).collect()
    }

    fn open_ground_m(&self, curve: &Curve) -> f64 {
        let meter = &self.task.meter;
        let arcs = curve.arcs();
        let joints = arcs.windows(2).map(|w| meter.joint_m(w[0], w[1]));
        arcs.iter()
            .map(|&arc| meter.open_ground_m(arc))
            .sum::<f64>()
            + joints.sum::<f64>()
    }

    fn curves(
        &mut self,
        [from, to]: [PathPosition; 2],
        end: Pose2,
        gears: &[JoinGears],
    ) -> Vec<Curve> {
        let gap = Gap {
            from: self.chain.pose(from),
            to: end,
            curvatures_per_m: [from, to].map(|position| self.curvature_at(position)),
        };
        let allowed = self.task.gears;
        let mut curves = Vec::new();
        for &gears in gears.iter().filter(|gears| gears.are_allowed(allowed)) {
            curves.extend(gap.curves(self.task, gears, &mut self.stream));
        }
        curves
    }

    fn curvature_at(&self, position: PathPosition) -> f64 {
        self.chain.pieces[position.piece].arc.curvature_per_m
    }

    /// Gears worth trying between two places.
    fn gears_between(&self, from: PathPosition, to: PathPosition) -> Vec<JoinGears> {
        let pieces = &self.chain.pieces[from.piece..=to.piece];
        let has_forward = pieces.iter().any(Piece::is_forward);
        let has_reverse = pieces.iter().any(|piece| !piece.is_forward());
        let mut gears = Vec::with_capacity(3);
        if has_forward {
            gears.push(JoinGears::Forward);
        }
        if has_reverse {
            gears.push(JoinGears::Reverse);
        }
        let length_m = pieces.iter().map(|p| p.arc.length_m()).sum::<f64>();
        if has_reverse || length_m < BOTH_GEARS_RADII * self.task.radius_m {
            gears.push(JoinGears::Both);
        }
        gears.retain(|gears| gears.are_allowed(self.task.gears));
        gears
    }

    /// Replaces a stretch by the first of the cheapest routes that is free and gains.
    fn take_best(&mut self, mut window: Window, mut routes: Vec<Route>) -> bool {
        routes.sort_by(|a, b| a.bound_m.total_cmp(&b.bound_m));
        let task = self.task;
        let n_checked = task.config.n_checked as usize;
        let routes = routes
            .iter()
            .filter(|route| !route.is_certainly_too_near(task));
        for route in routes.take(n_checked) {
            window.settle(task);
            if window.bounded(task, *route).is_none() {
                continue;
            }
            if window.replace(task, self.chain, route) {
                return true;
            }
        }
        false
    }
}

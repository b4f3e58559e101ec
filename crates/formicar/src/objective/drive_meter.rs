//! The cost of driving a chain of arcs on a map: the integral along it.

use super::VehicleCost;
use crate::collision::{Body, Drive, ObstacleMap};
use crate::geometry::{Arc, Point2, Pose2};
use std::f64::consts::SQRT_2;

/// Additional cost of a meter at a position in grid coordinates, at least 0: a preference.
pub type SoftCost<'a> = &'a (dyn Fn(Point2) -> f64 + Sync);

/// Measures the [`VehicleCost`] of arcs for a body on a map, in grid coordinates.
///
/// The cost of a path is the sum over its arcs and its joints and what its least clearance adds,
/// [`VehicleCost::least_clearance_price_m`]. Along arcs, clearance is sampled halfway along
/// equal steps of each arc, by [`ObstacleMap::clearance_estimate_m`]; steps far from obstacles are
/// skipped, which does not change the sum. If arcs of one motion are merged
/// ([`DriveMeter::merged`]), the cost depends on the path alone and not on how it is cut.
#[derive(Clone, Copy)]
pub struct DriveMeter<'a> {
    obstacles: &'a ObstacleMap,
    body: &'a Body,
    cost: &'a VehicleCost,
    soft: Option<SoftCost<'a>>,
    spacing_m: f64,
}

impl<'a> DriveMeter<'a> {
    /// Steps of the integral as a share of the wish: what is summed is smooth on its scale.
    const SPACING_WISHES: f64 = 0.25;
    /// Steps never get shorter than this share of a cell.
    const LEAST_SPACING_CELLS: f64 = 0.5;

    /// For a body on a map.
    pub fn new(obstacles: &'a ObstacleMap, body: &'a Body, cost: &'a VehicleCost) -> Self {
        let least_m = Self::LEAST_SPACING_CELLS * obstacles.frame().resolution_m();
        Self {
            obstacles,
            body,
            cost,
            soft: None,
            spacing_m: (Self::SPACING_WISHES * cost.clearance_wish_m).max(least_m),
        }
    }

    /// With a further cost of positions.
    #[must_use]
    pub fn with_soft_cost(self, soft: SoftCost<'a>) -> Self {
        let least_m = Self::LEAST_SPACING_CELLS * self.obstacles.frame().resolution_m();
        Self {
            soft: Some(soft),
            spacing_m: least_m,
            ..self
        }
    }

    /// Cost of a whole path.
    pub fn path_m(&self, start: Pose2, arcs: &[Arc]) -> f64 {
        let arcs = Self::merged(arcs);
        let mut pose = start;
        let (mut around_m, mut least_m) = (0.0, self.cost.clearance_wish_m);
        for &arc in &arcs {
            around_m += self.around_m(pose, arc, f64::INFINITY);
            least_m = self.least_clearance_m(pose, arc, [0.0, least_m]);
            pose = arc.end_from(pose);
        }
        let open_m = self.cost.open_path_m(&arcs);
        open_m + around_m + self.least_clearance_price_m(open_m, least_m)
    }

    /// The least clearance of a path, meters, at most the wish.
    pub fn path_least_clearance_m(&self, start: Pose2, arcs: &[Arc]) -> f64 {
        let mut pose = start;
        arcs.iter()
            .fold(self.cost.clearance_wish_m, |least_m, &arc| {
                let from = pose;
                pose = arc.end_from(pose);
                self.least_clearance_m(from, arc, [0.0, least_m])
            })
    }

    /// What the least clearance of a path adds to its cost, given that on open ground.
    pub fn least_clearance_price_m(&self, open_path_m: f64, least_clearance_m: f64) -> f64 {
        self.cost
            .least_clearance_price_m(open_path_m, least_clearance_m)
    }

    /// The least clearance at which its price is that much, given the cost on open ground: at less
    /// it is dearer.
    pub fn least_clearance_for_m(&self, open_path_m: f64, price_m: f64) -> f64 {
        self.cost.least_clearance_for_m(open_path_m, price_m)
    }

    /// True where the least clearance counts.
    pub fn counts_least_clearance(&self) -> bool {
        self.cost.counts_least_clearance()
    }

    /// True for a clearance from the wish on, or where none counts.
    pub fn is_enough_m(&self, clearance_m: f64) -> bool {
        !self.counts_least_clearance() || clearance_m >= self.cost.clearance_wish_m
    }

    /// The least clearance along an arc, exact between two limits: where it is below the lower
    /// one, any value up to that; above the upper one or the wish, the lesser of the two.
    pub fn least_clearance_m(&self, start: Pose2, arc: Arc, [low_m, high_m]: [f64; 2]) -> f64 {
        let limit_m = high_m.min(self.cost.clearance_wish_m);
        if !self.cost.counts_least_clearance() {
            return limit_m;
        }
        let drive = Drive {
            start,
            curvature_per_m: arc.curvature_per_m,
            signed_length_m: arc.signed_length_m,
        };
        self.obstacles
            .drive_clearance_by_steps_m(self.body, &drive, [low_m, limit_m])
    }

    /// The same path with arcs that continue one motion made one, and those without length gone.
    pub fn merged(arcs: &[Arc]) -> Vec<Arc> {
        let mut merged: Vec<Arc> = Vec::with_capacity(arcs.len());
        for &arc in arcs.iter().filter(|arc| arc.signed_length_m != 0.0) {
            match merged.last_mut() {
                Some(last) if last.continues_in(arc) => last.signed_length_m += arc.signed_length_m,
                _ => merged.push(arc),
            }
        }
        merged
    }

    /// What a length driven in reverse adds to the cost of a path.
    pub fn long_reverse_m(&self, reversed_m: f64) -> f64 {
        self.cost.long_reverse_m(reversed_m)
    }

    /// Cost of the joint from an arc to the next.
    pub fn joint_m(&self, before: Arc, after: Arc) -> f64 {
        self.cost.joint_m(before, after)
    }

    /// Cost of an arc far from obstacles: a lower bound anywhere.
    pub fn open_ground_m(&self, arc: Arc) -> f64 {
        self.cost.open_ground_m(arc)
    }

    /// Cost of an arc in its place.
    pub fn arc_m(&self, start: Pose2, arc: Arc) -> f64 {
        self.open_ground_m(arc) + self.around_m(start, arc, f64::INFINITY)
    }

    /// Cost of passing near obstacles along an arc; above a limit, any value above the limit.
    pub fn around_m(&self, start: Pose2, arc: Arc, limit_m: f64) -> f64 {
        if !self.cost.sees_obstacles() && self.soft.is_none() {
            return 0.0;
        }
        let n_steps = (arc.length_m() / self.spacing_m).ceil().max(1.0);
        let signed_step_m = arc.signed_length_m / n_steps;
        let step_m = signed_step_m.abs();
        // Where the middle of a step is passed over, no point of the body moves by more.
        let stride_m = step_m * (1.0 + arc.curvature_per_m.abs() * self.body.reach_m());
        let mut walk = Walk::new(start, arc.curvature_per_m, signed_step_m);
        let mut sum = 0.0;
        let mut step = 0.0;
        while step < n_steps {
            let (rate, room_m) = self.rate(&walk);
            sum += rate * step_m;
            if sum > limit_m {
                break;
            }
            let n_skipped = (room_m / stride_m).floor().max(0.0);
            step += 1.0 + n_skipped;
            if n_skipped > 0.0 {
                walk.jump(step);
            } else {
                walk.step();
            }
        }
        sum
    }

    /// Additional cost of a meter at a place, and the distance that the body may move while it stays
    /// 0.
    fn rate(&self, walk: &Walk) -> (f64, f64) {
        let wish_m = self.cost.clearance_wish_m;
        let (near, room_m) = if self.cost.sees_obstacles() {
            let (position, along) = (walk.position, walk.along);
            let clearance_m = self
                .obstacles
                .estimate_at(self.body, position, along, wish_m);
            let room_m = (clearance_m - wish_m) / SQRT_2;
            (self.cost.nearness(clearance_m), room_m)
        } else {
            (0.0, f64::INFINITY)
        };
        match self.soft {
            Some(soft) => (near + soft(walk.position), 0.0),
            None => (near, room_m),
        }
    }
}

/// Places halfway along equal steps of an arc.
struct Walk {
    start: Pose2,
    curvature_per_m: f64,
    signed_step_m: f64,
    position: Point2,
    along: Point2,
    /// The next step: its chord in the frame of the heading before it, and its turn.
    chord: Point2,
    turn: Point2,
}

impl Walk {
    fn new(start: Pose2, curvature_per_m: f64, signed_step_m: f64) -> Self {
        let step = Pose2::default().advance(curvature_per_m, signed_step_m);
        let mut walk = Self {
            start,
            curvature_per_m,
            signed_step_m,
            position: Point2::default(),
            along: Point2::default(),
            chord: step.position(),
            turn: Point2::unit(step.heading),
        };
        walk.jump(0.0);
        walk
    }

    /// Goes to the middle of a step.
    fn jump(&mut self, step: f64) {
        let driven_m = (step + 0.5) * self.signed_step_m;
        let pose = self.start.advance(self.curvature_per_m, driven_m);
        self.position = pose.position();
        self.along = Point2::unit(pose.heading);
    }

    /// Goes to the middle of the next step.
    fn step(&mut self) {
        let rotated =
            |v: Point2, by: Point2| Point2::new(v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x);
        self.position = self.position + rotated(self.chord, self.along);
        self.along = rotated(self.along, self.turn);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::OccupancyGrid;
    use crate::objective::DriveCost;
    use crate::vehicle::Vehicle;

    /// A wall along the lower side of a wide yard, 0.2 m cells.
    fn yard() -> ObstacleMap {
        let (open, wall) = (".".repeat(300), "#".repeat(300));
        let mut rows = vec![open.as_str(); 150];
        rows.extend([wall.as_str(); 2]);
        ObstacleMap::new(&OccupancyGrid::from_rows(&rows, 0.2).unwrap())
    }

    /// Nearness alone, so that costs add up.
    fn cost() -> VehicleCost {
        VehicleCost {
            clearance_weight: 2.0,
            clearance_wish_m: 0.4,
            least_clearance_share: 0.0,
            least_clearance_m: 0.0,
            ..DriveCost::default().in_meters(2.0, 1.0)
        }
    }

    #[test]
    fn a_line_along_a_wall_costs_its_clearance() {
        let (map, body, cost) = (yard(), Body::new(&Vehicle::lei2020()), cost());
        let meter = DriveMeter::new(&map, &body, &cost);
        let line = [Arc::new(0.0, 10.0)];
        // 0.2 m between the wall at 0.4 m and the side of a body that is 1 m wide.
        let near = meter.path_m(Pose2::new(20.0, 1.1, 0.0), &line);
        let stands_out_m = body.discs_stand_out_m();
        let expected = 10.0 * (1.0 + cost.nearness(0.2 - stands_out_m));
        assert!((near - expected).abs() < 1e-9, "{near} {expected}");
        assert_eq!(meter.path_m(Pose2::new(20.0, 15.0, 0.0), &line), 10.0);
    }

    #[test]
    fn the_least_clearance_is_priced_once_and_exactly() {
        let (map, body) = (yard(), Body::new(&Vehicle::lei2020()));
        let cost = VehicleCost {
            clearance_weight: 0.0,
            clearance_wish_m: 0.4,
            least_clearance_share: 0.8,
            least_clearance_m: 16.0,
            ..DriveCost::default().in_meters(2.0, 1.0)
        };
        let meter = DriveMeter::new(&map, &body, &cost);
        let cost_m =
            |y, length_m| meter.path_m(Pose2::new(20.0, y, 0.0), &[Arc::new(0.0, length_m)]);
        let total_m = |m, clearance_m| m + cost.least_clearance_price_m(m, clearance_m);
        // The wall ends at 0.4 m, and the body is 1 m wide.
        assert!((cost_m(1.1, 10.0) - total_m(10.0, 0.2)).abs() < 1e-9);
        assert!((cost_m(1.0, 4.0) - total_m(4.0, 0.1)).abs() < 1e-9);
        assert_eq!(cost_m(1.4, 10.0), 10.0);
    }

    #[test]
    fn costs_do_not_depend_on_cuts_nor_on_what_is_passed_over() {
        let (map, body, cost) = (yard(), Body::new(&Vehicle::lei2020()), cost());
        let meter = DriveMeter::new(&map, &body, &cost);
        let start = Pose2::new(20.0, 3.2, -1.0);
        let arc = Arc::new(0.25, 8.0);
        let whole = meter.path_m(start, &[arc]);
        let cut = [
            Arc::new(0.25, 3.3),
            Arc::new(0.25, 0.0),
            Arc::new(0.25, 4.7),
        ];
        assert!((meter.path_m(start, &cut) - whole).abs() < 1e-12);
        assert!(whole > meter.open_ground_m(arc) + 0.01, "{whole}");
        // Arcs priced alone differ from the whole by the error of the integral.
        let first = Arc::new(0.25, 3.3);
        let rest = Arc::new(0.25, 4.7);
        let apart = meter.arc_m(start, first) + meter.arc_m(first.end_from(start), rest);
        assert!((apart - whole).abs() < 1e-3 * whole, "{apart} {whole}");
        // A soft cost of nothing keeps every step.
        let nothing = |_: Point2| 0.0;
        let every = DriveMeter {
            soft: Some(&nothing),
            ..meter
        };
        assert!((every.path_m(start, &[arc]) - whole).abs() < 1e-9);
    }

    #[test]
    fn soft_costs_add_up_and_limits_cut_short() {
        let (map, body, cost) = (yard(), Body::new(&Vehicle::lei2020()), cost());
        let soft = |p: Point2| if p.x < 25.0 { 0.5 } else { 0.0 };
        let meter = DriveMeter::new(&map, &body, &cost).with_soft_cost(&soft);
        let start = Pose2::new(20.0, 15.0, 0.0);
        let line = Arc::new(0.0, 10.0);
        assert!((meter.arc_m(start, line) - 12.5).abs() < 1e-9);
        let cut_short = meter.around_m(start, line, 1.0);
        assert!((1.0..1.1).contains(&cut_short), "{cut_short}");
    }
}

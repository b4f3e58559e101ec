//! A* over legs and the arcs between them.

use super::fillet::{Fillet, Rounded};
use super::refine::Chain;
use super::sight::{Sight, Sights, View};
use crate::geometry::{Arc, Curve, Point2, Pose2, angle_difference};
use crate::smoothing::open_list::OpenList;
use crate::smoothing::task::RoundingTask;
use std::collections::HashMap;

/// The longest leg, turning radii.
const LEG_RADII: f64 = 100.0;
/// Largest share of a leg that a corner may take where half is not enough.
const CROWDED_SHARE: f64 = 0.95;
/// Distances of the first corner from the start along its heading, turning radii.
const LEAD_RADII: [f64; 7] = [0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0];

/// A path of straight lines, arcs and curves.
#[derive(Clone, Debug)]
pub(in crate::smoothing) struct WidePath {
    pub(in crate::smoothing) start: Pose2,
    pub(in crate::smoothing) arcs: Vec<Arc>,
    pub(in crate::smoothing) points: Vec<Point2>,
    pub(in crate::smoothing) corners: Vec<Rounded>,
}

/// The path of least cost through some of the points of a polyline, its ends among them, with the
/// requested headings; none where no such path is free.
pub(in crate::smoothing) fn widest(task: &RoundingTask, polyline: &[Point2]) -> Option<WidePath> {
    let (config, radius_m) = (task.config, task.radius_m);
    let view = View {
        lethal: task.obstacles.lethal(),
        resolution_m: task.obstacles.frame().resolution_m(),
        reach_m: LEG_RADII * radius_m,
        corner_m: config.corner_radii * radius_m,
        goes_on: task.goes_on,
    };
    let lead =
        |start: &Pose2| LEAD_RADII.map(|radii| start.advance(0.0, radii * radius_m).position());
    let starts = task
        .ends
        .starts
        .iter()
        .take(usize::from(!task.ends.start_is_free));
    let leads: Vec<Point2> = starts.flat_map(lead).collect();
    let mut search = Search {
        sights: Sights::new(polyline, &leads, &view)?,
        task,
        open: OpenList::default(),
        legs: Vec::new(),
        closed: HashMap::new(),
        curves: Vec::new(),
    };
    search.open_start();
    while let Some(entry) = search.open.pop()
        && !task.is_over()
    {
        let cost = entry.cost;
        match entry.item {
            Step::Lead(from, sight) => search.expand_lead(from, sight),
            Step::LeadCurve(from, sight, curve) => search.try_lead(from, sight, curve, cost),
            Step::Turn(leg, sight, radius) => search.try_turn(leg, sight, radius, cost),
            Step::Tail(leg) => search.expand_tail(leg, cost),
            Step::TailCurve(leg, curve) if search.is_tail_free(leg, curve) => {
                return Some(search.path(leg, Some(curve)));
            }
            Step::End(leg) if search.is_whole_leg_free(leg) => {
                return Some(search.path(leg, None));
            }
            Step::TailCurve(..) | Step::End(_) => {}
        }
    }
    None
}

/// A candidate on the open list: points, legs and curves by number.
#[derive(Clone, Copy)]
pub(super) enum Step {
    /// Some curve from the start onto a leg, at a lower bound of its cost.
    Lead(usize, Sight),
    /// A curve from the start onto a leg.
    LeadCurve(usize, Sight, usize),
    /// From a leg to the next by an arc: the widest one, tightened a number of times.
    Turn(usize, Sight, i32),
    /// Some curve from the end of a leg to the goal, at a lower bound of its cost.
    Tail(usize),
    /// A curve from the end of a leg to the goal.
    TailCurve(usize, usize),
    /// A leg that ends at the goal.
    End(usize),
}

/// The origin of a leg.
#[derive(Clone, Copy)]
pub(super) enum Reached {
    /// It begins at the start.
    AtStart,
    /// By a curve from the start.
    ByCurve(usize),
    /// From a leg, by an arc or straight on.
    FromLeg(usize, Fillet),
}

pub(super) struct Leg {
    from: usize,
    pub(super) sight: Sight,
    reached: Reached,
    /// The end of the arc that leads onto the leg, meters from the leg's first point.
    begins_m: f64,
    /// From there the body is known to be free up to `clear_m`, and to hit something before
    /// `hit_m`.
    clear_m: f64,
    hit_m: f64,
    /// Cost of passing near obstacles on that stretch, meters.
    tightness_m: f64,
}

impl Leg {
    /// A leg that begins at its first point.
    pub(super) fn new(from: usize, sight: Sight, reached: Reached) -> Self {
        Self {
            from,
            sight,
            reached,
            begins_m: 0.0,
            clear_m: 0.0,
            hit_m: f64::INFINITY,
            tightness_m: 0.0,
        }
    }
}

pub(super) struct Search<'a> {
    pub(super) task: &'a RoundingTask<'a>,
    pub(super) sights: Sights,
    pub(super) open: OpenList<Step>,
    pub(super) legs: Vec<Leg>,
    closed: HashMap<(usize, usize), usize>,
    /// Curves with the poses from which they are driven.
    pub(super) curves: Vec<(Pose2, Curve)>,
}

impl Search<'_> {
    pub(super) fn is_closed(&self, from: usize, sight: Sight) -> bool {
        self.closed.contains_key(&(from, sight.to))
    }

    /// Keeps a leg that is reached at a cost, and opens what may follow it.
    pub(super) fn close(&mut self, leg: Leg, cost: f64) {
        let (number, sight) = (self.legs.len(), leg.sight);
        self.closed.insert((leg.from, sight.to), number);
        self.legs.push(leg);
        let cost = cost + sight.distance_m;
        if sight.to == self.sights.last() {
            if self.task.ends.goal_is_free {
                self.open.push([cost, 0.0], Step::End(number));
            }
            return;
        }
        let goal = self.sights.points[self.sights.last()];
        if !self.task.ends.goal_is_free && self.is_near(goal, sight.to) {
            let least = goal.distance(self.sights.points[sight.to]) + self.corner_m();
            self.open.push([cost, least], Step::Tail(number));
        }
        for next in self.sights.from(sight.to).to_vec() {
            if !self.is_closed(sight.to, next) {
                self.open_turn(number, next, 0, cost);
            }
        }
    }

    /// Opens the turn from a leg to a next one by an arc; `cost` is that up to the corner.
    fn open_turn(&mut self, leg: usize, next: Sight, radius: i32, cost: f64) {
        let Some(fillet) = self.fillet(leg, next, radius) else {
            return;
        };
        let remaining = fillet.cost(self.task) + next.distance_m + self.sights.rest_m(next.to);
        self.open
            .push([cost, remaining], Step::Turn(leg, next, radius));
    }

    /// The arc at the end of a leg; none where the legs have no room for one or the turn is too
    /// sharp.
    fn fillet(&self, leg: usize, next: Sight, n_tighter: i32) -> Option<Fillet> {
        let Leg {
            sight, begins_m, ..
        } = self.legs[leg];
        let turn_rad = angle_difference(next.heading_rad, sight.heading_rad);
        // The next corner needs room too; at a free goal there is none.
        let is_last = next.to == self.sights.last() && self.task.ends.goal_is_free;
        let before_m = sight.distance_m - begins_m;
        let with_share = |share: f64| {
            let room_m = before_m.min(share * next.distance_m);
            Fillet::new(self.task, turn_rad, room_m, n_tighter)
        };
        if is_last {
            return with_share(1.0);
        }
        with_share(0.5).or_else(|| {
            // A larger share only where half was not enough for any arc.
            let half = before_m.min(0.5 * next.distance_m);
            let was_enough = Fillet::new(self.task, turn_rad, half, 0).is_some();
            (!was_enough).then(|| with_share(CROWDED_SHARE)).flatten()
        })
    }

    /// Takes a turn if the body is free on the straight before it and on its arc; else opens the
    /// next tighter one.
    fn try_turn(&mut self, leg: usize, next: Sight, radius: i32, cost: f64) {
        let from = self.legs[leg].sight.to;
        if self.is_closed(from, next) {
            return;
        }
        let Some(fillet) = self.fillet(leg, next, radius) else {
            return;
        };
        let ends_m = self.legs[leg].sight.distance_m - fillet.tangent_m;
        // A tighter arc would only make the straight before it longer.
        let Some(straight_m) = self.straight_tightness_m(leg, ends_m) else {
            return;
        };
        let Some(arc_m) = self.arc_tightness_m(leg, ends_m, &fillet) else {
            self.open_turn(leg, next, radius + 1, cost);
            return;
        };
        let cost = cost + fillet.cost(self.task) + straight_m + arc_m;
        let mut reached = Leg::new(from, next, Reached::FromLeg(leg, fillet));
        (reached.begins_m, reached.clear_m) = (fillet.tangent_m, fillet.tangent_m);
        self.close(reached, cost);
    }

    /// The pose on a leg, some meters from its beginning.
    pub(super) fn pose(&self, leg: usize, at_m: f64) -> Pose2 {
        let Leg { from, sight, .. } = self.legs[leg];
        Pose2::at(self.sights.points[from], sight.heading_rad).advance(0.0, at_m)
    }

    /// Cost of passing near obstacles from where a leg begins up to some meters from its first
    /// point; none where the body hits something.
    fn straight_tightness_m(&mut self, leg: usize, up_to_m: f64) -> Option<f64> {
        let Leg {
            clear_m,
            hit_m,
            tightness_m,
            ..
        } = self.legs[leg];
        if up_to_m <= clear_m {
            return Some(tightness_m);
        }
        if up_to_m >= hit_m {
            return None;
        }
        let arc = Arc::new(0.0, up_to_m - clear_m);
        let more_m = self.task.tightness_m(self.pose(leg, clear_m), &[arc]);
        let known = &mut self.legs[leg];
        match more_m {
            Some(more_m) => {
                known.clear_m = up_to_m;
                known.tightness_m = tightness_m.max(more_m);
            }
            None => known.hit_m = up_to_m,
        }
        more_m.map(|_| known.tightness_m)
    }

    fn arc_tightness_m(&self, leg: usize, from_m: f64, fillet: &Fillet) -> Option<f64> {
        self.task
            .tightness_m(self.pose(leg, from_m), &[fillet.arc()])
    }

    pub(super) fn is_whole_leg_free(&mut self, leg: usize) -> bool {
        let length_m = self.legs[leg].sight.distance_m;
        self.straight_tightness_m(leg, length_m).is_some()
    }

    /// The path that ends with a leg and, where the goal's heading is given, a curve.
    fn path(&self, last: usize, tail: Option<usize>) -> WidePath {
        let mut legs = vec![last];
        while let Reached::FromLeg(before, _) = self.legs[legs[legs.len() - 1]].reached {
            legs.push(before);
        }
        legs.reverse();
        let lead = match self.legs[legs[0]].reached {
            Reached::ByCurve(curve) => Some(curve),
            _ => None,
        };
        let mut points: Vec<Point2> = legs
            .iter()
            .map(|&leg| self.sights.points[self.legs[leg].from])
            .collect();
        points.push(self.sights.points[self.legs[last].sight.to]);
        let fillets = legs[1..].iter().map(|&leg| match self.legs[leg].reached {
            Reached::FromLeg(_, fillet) => fillet,
            _ => Fillet::default(),
        });
        let mut chain = Chain {
            points,
            fillets: fillets.collect(),
            tightness_m: vec![0.0; legs.len()],
            first_is_fixed: !self.task.ends.start_is_free,
            last_is_fixed: tail.is_some(),
        };
        chain.refine(self.task);
        let arcs_of = |curve: Option<usize>| {
            curve.map_or(Vec::new(), |curve| self.curves[curve].1.arcs().to_vec())
        };
        let start = lead.map_or(chain.pose(0, 0.0), |lead| self.curves[lead].0);
        let mut points = vec![self.sights.points[0]];
        points.extend(&chain.points);
        points.push(self.sights.points[self.sights.last()]);
        points.dedup();
        WidePath {
            start,
            arcs: [arcs_of(lead), chain.arcs(), arcs_of(tail)].concat(),
            points,
            corners: chain.corners(),
        }
    }
}

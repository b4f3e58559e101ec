//! The cheapest collision-free chain of pieces along a polyline.
//!
//! Dijkstra's algorithm over places and facings. A piece goes on the list with its cost and is
//! checked for collisions only when it comes up: most never do.

use super::roadmap::{Facing, Roadmap, Role};
use super::{Corners, SmoothingConfig};
use crate::collision::{Body, Drive, ObstacleMap};
use crate::geometry::{Arc, Curve, Point2, Pose2, dubins, reeds_shepp};
use crate::scenario::MotionMode;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// How many curves are tried between two poses, cheapest first.
const MAX_WORDS: usize = 6;

/// The poses that the ends of a path are held to; none where the heading is free.
#[derive(Clone, Debug)]
pub(super) struct Ends {
    pub(super) starts: Vec<Pose2>,
    pub(super) goals: Vec<Pose2>,
}

/// What a chain is made for.
#[derive(Clone, Copy)]
pub(super) struct Task<'a> {
    pub(super) obstacles: &'a ObstacleMap,
    pub(super) body: &'a Body,
    pub(super) radius_m: f64,
    pub(super) config: &'a SmoothingConfig,
    pub(super) motion: MotionMode,
    pub(super) ends: &'a Ends,
}

impl Task<'_> {
    pub(super) fn reach_m(&self) -> f64 {
        self.config.reach_radii * self.radius_m
    }

    pub(super) fn is_free(&self, start: Pose2, arc: Arc) -> bool {
        let drive = Drive {
            start,
            curvature_per_m: arc.curvature_per_m,
            signed_length_m: arc.signed_length_m,
        };
        self.obstacles.is_free(self.body, &drive)
    }

    pub(super) fn all_free(&self, start: Pose2, arcs: &[Arc]) -> bool {
        let mut pose = start;
        arcs.iter().all(|&arc| {
            let from = pose;
            pose = arc.end_from(pose);
            self.is_free(from, arc)
        })
    }

    /// Facings in which the polyline may be followed.
    pub(super) fn facings(&self) -> &'static [Facing] {
        match self.motion {
            MotionMode::Forward => &[Facing::Along],
            MotionMode::Reverse => &[Facing::Along, Facing::Against],
        }
    }

    fn words(&self, from: Pose2, to: Pose2) -> Vec<Curve> {
        match self.motion {
            MotionMode::Forward => dubins::candidates(from, to, self.radius_m),
            MotionMode::Reverse => reeds_shepp::candidates(from, to, self.radius_m),
        }
    }

    /// Cost of driving a length along the polyline.
    fn gear_factor(&self, facing: Facing) -> f64 {
        match facing {
            Facing::Along => 1.0,
            Facing::Against => self.config.reverse_penalty,
        }
    }

    /// Cost of a curve between two gears; 0 stands for none.
    fn word_cost(&self, curve: &Curve, before: f64, after: f64) -> f64 {
        let mut gear = before;
        let mut cost = 0.0;
        for arc in curve.arcs() {
            let factor = if arc.signed_length_m < 0.0 {
                self.config.reverse_penalty
            } else {
                1.0
            };
            let next = arc.signed_length_m.signum();
            cost += factor * arc.length_m() + self.switching_cost(gear, next);
            gear = next;
        }
        cost + self.switching_cost(gear, after)
    }

    fn switching_cost(&self, before: f64, after: f64) -> f64 {
        if before * after < 0.0 {
            self.config.direction_switching_cost
        } else {
            0.0
        }
    }
}

/// A piece of a chain: arcs from a pose, and the 2-turning that they are, if so.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) start: Pose2,
    pub(super) arcs: Vec<Arc>,
    pub(super) member: Option<usize>,
}

/// Where a chain got to, if not to the goal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stuck {
    /// The farthest place reached, if any.
    pub(super) reached: Option<usize>,
}

/// The cheapest chain from start to goal.
pub(super) fn cheapest(task: &Task, map: &Roadmap) -> Result<Vec<Piece>, Stuck> {
    let mut search = Search::new(task, map);
    search.open_start();
    while let Some(entry) = search.open.pop() {
        if search.came_by[entry.to].is_some() {
            continue;
        }
        if matches!(entry.step, Step::AnyWord) {
            search.expand(&entry);
        } else if search.is_free(&entry) {
            search.came_by[entry.to] = Some((entry.from, entry.step));
            search.costs[entry.to] = entry.cost;
            if entry.to == search.goal() {
                return Ok(search.pieces());
            }
            search.open_from(entry.to);
        }
    }
    let reached = (0..map.places.len()).rev().find(|&place| {
        let nodes = [2 * place, 2 * place + 1];
        nodes.iter().any(|&node| search.came_by[node].is_some())
    });
    Err(Stuck { reached })
}

/// A way from one node to another.
#[derive(Clone, Copy, Debug)]
enum Step {
    /// To the next place of the leg.
    Straight,
    /// By a 2-turning.
    Turning(usize),
    /// By some curve, with a lower bound of its cost.
    AnyWord,
    /// By a curve of the list.
    Word(usize),
    /// The start or goal with a free heading: nothing to drive.
    Here,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    cost: f64,
    age: usize,
    from: usize,
    to: usize,
    step: Step,
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Entry {
    /// The cheapest is the greatest; among equals the oldest.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_cost = other.cost.total_cmp(&self.cost);
        by_cost.then(other.age.cmp(&self.age))
    }
}

/// Nodes are places with facings, twice the place plus 0 or 1; then the start and the goal.
struct Search<'a> {
    task: &'a Task<'a>,
    map: &'a Roadmap,
    came_by: Vec<Option<(usize, Step)>>,
    costs: Vec<f64>,
    open: BinaryHeap<Entry>,
    n_opened: usize,
    words: Vec<(Pose2, Curve)>,
    /// Per leg and facing, whether the body can drive from each place to the next.
    straights: Vec<Option<Vec<bool>>>,
}

impl<'a> Search<'a> {
    fn new(task: &'a Task<'a>, map: &'a Roadmap) -> Self {
        Self {
            task,
            map,
            came_by: vec![None; 2 * map.places.len() + 2],
            costs: vec![0.0; 2 * map.places.len() + 2],
            open: BinaryHeap::new(),
            n_opened: 0,
            words: Vec::new(),
            straights: vec![None; 2 * map.legs.len()],
        }
    }

    fn start(&self) -> usize {
        2 * self.map.places.len()
    }

    fn goal(&self) -> usize {
        self.start() + 1
    }

    fn place(node: usize) -> (usize, Facing) {
        let facing = if node.is_multiple_of(2) {
            Facing::Along
        } else {
            Facing::Against
        };
        (node / 2, facing)
    }

    fn node(place: usize, facing: Facing) -> usize {
        2 * place + usize::from(facing == Facing::Against)
    }

    fn push(&mut self, cost: f64, [from, to]: [usize; 2], step: Step) {
        self.n_opened += 1;
        self.open.push(Entry {
            cost,
            age: self.n_opened,
            from,
            to,
            step,
        });
    }

    fn open_start(&mut self) {
        let (start, goal) = (self.start(), self.goal());
        let reach_m = self.task.reach_m();
        let ends = self.task.ends;
        for &facing in self.task.facings() {
            if ends.starts.is_empty() && !self.map.places.is_empty() {
                self.push(0.0, [start, Self::node(0, facing)], Step::Here);
            }
            for place in 0..self.map.places.len() {
                let near = self.map.s_m(place) <= reach_m;
                if !ends.starts.is_empty() && near && self.map.is_station(place) {
                    self.push_word([start, Self::node(place, facing)]);
                }
            }
        }
        let is_short = self.map.line.length_m() <= reach_m;
        if is_short && !ends.starts.is_empty() && !ends.goals.is_empty() {
            self.push_word([start, goal]);
        }
    }

    /// Opens every piece that begins at a node.
    fn open_from(&mut self, node: usize) {
        let cost = self.costs[node];
        let (place, facing) = Self::place(node);
        let (map, factor) = (self.map, self.task.gear_factor(facing));
        let here = map.places[place];
        if place + 1 < map.legs[here.leg].end {
            let length_m = map.places[place + 1].at_m - here.at_m;
            let next = Self::node(place + 1, facing);
            self.push(cost + factor * length_m, [node, next], Step::Straight);
        } else if here.leg + 1 == map.legs.len() && self.task.ends.goals.is_empty() {
            self.push(cost, [node, self.goal()], Step::Here);
        }
        match here.role {
            Role::TurnBegins(member) => {
                // What it replaces, so that among members the deviation alone decides.
                let turning = &map.members[member].turning;
                let length_m = turning.before_m + turning.after_m + turning.deviation_m();
                let next = Self::node(map.members[member].places[1], facing);
                self.push(
                    cost + factor * length_m,
                    [node, next],
                    Step::Turning(member),
                );
            }
            Role::Station => self.open_words(node),
            Role::TurnEnds(_) => {}
        }
    }

    /// Opens the curves from a station to later ones and to the goal.
    fn open_words(&mut self, node: usize) {
        let (place, _) = Self::place(node);
        let map = self.map;
        let end_m = map.s_m(place) + self.task.reach_m();
        if self.task.config.corners == Corners::TwoTurningOrDubins {
            let next_leg = map.legs[map.places[place].leg].end;
            let later = (next_leg..map.places.len()).take_while(|&to| map.s_m(to) <= end_m);
            for to in later.filter(|&to| map.is_station(to)) {
                for &facing in self.task.facings() {
                    self.push_word([node, Self::node(to, facing)]);
                }
            }
        }
        if !self.task.ends.goals.is_empty() && map.line.length_m() <= end_m {
            self.push_word([node, self.goal()]);
        }
    }

    /// Opens the curves between two nodes at a lower bound of their cost.
    fn push_word(&mut self, nodes: [usize; 2]) {
        if self.came_by[nodes[1]].is_some() {
            return;
        }
        let [from, to] = nodes.map(|node| self.position(node));
        let least = from.distance(to) + self.passing_cost(nodes);
        self.push(self.costs[nodes[0]] + least, nodes, Step::AnyWord);
    }

    /// Cost of the corners that a curve passes.
    fn passing_cost(&self, [from, to]: [usize; 2]) -> f64 {
        let leg = |node: usize| self.map.places[Self::place(node).0].leg;
        let first = if from == self.start() { 0 } else { leg(from) };
        let last = if to == self.goal() {
            self.map.line.n_corners()
        } else {
            leg(to)
        };
        (last - first) as f64 * self.task.config.passed_corner_radii * self.task.radius_m
    }

    /// The poses that a node stands for.
    fn poses(&self, node: usize) -> Vec<Pose2> {
        if node == self.start() {
            return self.task.ends.starts.clone();
        }
        if node == self.goal() {
            return self.task.ends.goals.clone();
        }
        let (place, facing) = Self::place(node);
        vec![self.map.pose(place, facing)]
    }

    fn position(&self, node: usize) -> Point2 {
        let points = &self.map.line.points;
        if node == self.start() {
            return points[0];
        }
        if node == self.goal() {
            return points[points.len() - 1];
        }
        self.map.pose(node / 2, Facing::Along).position()
    }

    /// The gear in which a node is passed; 0 where none is engaged yet or any more.
    fn gear(&self, node: usize) -> f64 {
        if node >= self.start() {
            return 0.0;
        }
        Self::place(node).1.sign()
    }

    /// Puts the cheapest curves between two nodes on the list, each with its cost.
    fn expand(&mut self, entry: &Entry) {
        let nodes = [entry.from, entry.to];
        let gears = nodes.map(|node| self.gear(node));
        let [from, to] = nodes.map(|node| self.poses(node));
        let mut words = Vec::new();
        for (&a, &b) in from.iter().flat_map(|a| to.iter().map(move |b| (a, b))) {
            words.extend(self.task.words(a, b).into_iter().map(|curve| {
                let cost = self.task.word_cost(&curve, gears[0], gears[1]);
                (cost, a, curve)
            }));
        }
        words.sort_by(|a, b| a.0.total_cmp(&b.0));
        let before = self.costs[entry.from] + self.passing_cost(nodes);
        for (cost, start, curve) in words.into_iter().take(MAX_WORDS) {
            self.push(before + cost, nodes, Step::Word(self.words.len()));
            self.words.push((start, curve));
        }
    }

    fn is_free(&mut self, entry: &Entry) -> bool {
        match entry.step {
            Step::Straight => {
                let (place, facing) = Self::place(entry.from);
                self.is_straight_free(place, facing)
            }
            Step::Turning(_) | Step::Word(_) => {
                let (start, arcs) = self.motion(entry.from, entry.step);
                self.task.all_free(start, &arcs)
            }
            Step::Here => true,
            Step::AnyWord => false,
        }
    }

    fn is_straight_free(&mut self, place: usize, facing: Facing) -> bool {
        let leg = self.map.places[place].leg;
        let range = self.map.legs[leg].clone();
        let slot = Self::node(leg, facing);
        let (task, map) = (self.task, self.map);
        let free = self.straights[slot].get_or_insert_with(|| {
            let mut free = vec![false; range.len() - 1];
            mark_free(task, (map, facing), range.start, &mut free);
            free
        });
        free[place - range.start]
    }

    /// Where a step begins, and its arcs.
    fn motion(&self, from: usize, step: Step) -> (Pose2, Vec<Arc>) {
        if let Step::Word(word) = step {
            let (start, curve) = &self.words[word];
            return (*start, curve.arcs().to_vec());
        }
        let (place, facing) = Self::place(from);
        let sign = facing.sign();
        let start = self.map.pose(place, facing);
        let seen = |arc: Arc| Arc::new(sign * arc.curvature_per_m, sign * arc.signed_length_m);
        let arcs = match step {
            Step::Turning(member) => self.map.members[member].turning.arcs().map(seen).to_vec(),
            Step::Straight => {
                let places = &self.map.places;
                vec![seen(Arc::new(
                    0.0,
                    places[place + 1].at_m - places[place].at_m,
                ))]
            }
            Step::Here | Step::AnyWord | Step::Word(_) => Vec::new(),
        };
        (start, arcs)
    }

    /// The pieces from start to goal.
    fn pieces(&self) -> Vec<Piece> {
        let mut pieces = Vec::new();
        let mut node = self.goal();
        while let Some((from, step)) = self.came_by[node] {
            // A free start stands where its first piece does.
            let at = if from == self.start() { node } else { from };
            let (start, arcs) = self.motion(at, step);
            let member = match step {
                Step::Turning(member) => Some(member),
                _ => None,
            };
            pieces.push(Piece {
                start,
                arcs,
                member,
            });
            node = from;
        }
        pieces.reverse();
        pieces
    }
}

/// Marks the steps from place to place that are free: the whole as one sweep or else its halves.
fn mark_free(task: &Task, (map, facing): (&Roadmap, Facing), first: usize, free: &mut [bool]) {
    let length_m = map.places[first + free.len()].at_m - map.places[first].at_m;
    let arc = Arc::new(0.0, facing.sign() * length_m);
    if task.is_free(map.pose(first, facing), arc) {
        free.fill(true);
    } else if free.len() > 1 {
        let half = free.len() / 2;
        let (low, high) = free.split_at_mut(half);
        mark_free(task, (map, facing), first, low);
        mark_free(task, (map, facing), first + half, high);
    }
}

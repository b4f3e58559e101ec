//! The cheapest collision-free chain of pieces along a polyline.
//!
//! A* over places and facings. A piece goes on the list with its cost and is checked for
//! collisions only when it comes up: most never do. The estimate of what remains is what the
//! cheapest chain would cost if nothing could be hit and every curve were a straight line.

use super::Corners;
use super::open_list::OpenList;
use super::roadmap::{Facing, Roadmap, Role};
use super::task::Task;
use crate::geometry::{Arc, Curve, Point2, Pose2};

/// How many curves are tried between two poses, cheapest first.
const MAX_WORDS: usize = 6;

/// A piece of a chain: arcs from a pose, and the 2-turning that they are, if so.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) start: Pose2,
    pub(super) arcs: Vec<Arc>,
    pub(super) member: Option<usize>,
}

/// A way from one node to another.
#[derive(Clone, Copy, Debug)]
enum Step {
    /// To the next place of the leg.
    Straight,
    /// By a 2-turning of the list.
    Turning(usize),
    /// By some curve, at a lower bound of its cost.
    AnyWord,
    /// By a curve of the list.
    Word(usize),
    /// The start or the goal with the polyline's own heading: nothing to drive.
    Here,
}

/// A step between two nodes.
#[derive(Clone, Copy, Debug)]
struct Move {
    from: usize,
    to: usize,
    step: Step,
}

/// How far the chains got of which none reached the goal.
#[derive(Clone, Debug)]
pub(super) struct Stuck {
    /// The places reached, in order along the polyline.
    pub(super) reached: Vec<(usize, Facing)>,
}

/// The cheapest chain from start to goal.
pub(super) fn cheapest(task: &Task, map: &Roadmap) -> Result<Vec<Piece>, Stuck> {
    let mut search = Search::new(task, map);
    search.open_start();
    while let Some(entry) = search.open.pop() {
        let Move { from, to, step } = entry.item;
        if search.came_by[to].is_some() {
            continue;
        }
        if matches!(step, Step::AnyWord) {
            search.expand([from, to]);
        } else if search.is_free(from, step) {
            search.came_by[to] = Some((from, step));
            search.costs[to] = entry.cost;
            if to == search.goal() {
                return Ok(search.pieces());
            }
            search.open_from(to);
        }
    }
    let nodes = (0..search.start()).filter(|&node| search.came_by[node].is_some());
    Err(Stuck {
        reached: nodes.map(Search::place).collect(),
    })
}

/// Nodes are places with facings, twice the place plus 0 or 1; then the start and the goal.
struct Search<'a> {
    task: &'a Task<'a>,
    map: &'a Roadmap,
    /// How each node was reached first, and at what cost.
    came_by: Vec<Option<(usize, Step)>>,
    costs: Vec<f64>,
    /// Per place the least that the rest of the way costs.
    remaining: Vec<f64>,
    open: OpenList<Move>,
    /// Curves with the poses from which they are driven.
    words: Vec<(Pose2, Curve)>,
    /// Per leg and facing, whether the body can drive from each place to the next.
    straights: Vec<Option<Vec<bool>>>,
}

impl<'a> Search<'a> {
    fn new(task: &'a Task<'a>, map: &'a Roadmap) -> Self {
        let n_nodes = 2 * map.places.len() + 2;
        let mut search = Self {
            task,
            map,
            came_by: vec![None; n_nodes],
            costs: vec![0.0; n_nodes],
            open: OpenList::default(),
            words: Vec::new(),
            straights: vec![None; 2 * map.legs.len()],
            remaining: vec![f64::INFINITY; map.places.len()],
        };
        for place in (0..map.places.len()).rev() {
            search.remaining[place] = search.least_remaining(place);
        }
        search
    }

    /// The least that the way costs from a place on, by what is known of later places.
    fn least_remaining(&self, place: usize) -> f64 {
        let (map, node) = (self.map, 2 * place);
        let onward = |to: usize, cost: f64| cost + self.remaining[to];
        let mut least = f64::INFINITY;
        if let Some((next, length_m)) = map.next_on_leg(place) {
            least = least.min(onward(next, length_m));
        } else if map.is_end(place) && self.task.ends.goal_is_free {
            least = 0.0;
        }
        match map.places[place].role {
            Role::TurnBegins(member) => {
                let member = &map.members[member];
                least = least.min(onward(member.places[1], member.cost()));
            }
            Role::Station => {
                for to in self.later_stations(place) {
                    least = least.min(onward(to, self.least_word_cost([node, 2 * to])));
                }
                if self.goal_is_near(place) {
                    least = least.min(self.least_word_cost([node, self.goal()]));
                }
            }
            Role::TurnEnds(_) => {}
        }
        least
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

    fn push(&mut self, cost: f64, nodes: [usize; 2], step: Step) {
        let remaining = if nodes[1] == self.goal() {
            0.0
        } else {
            self.remaining[nodes[1] / 2]
        };
        let [from, to] = nodes;
        self.open.push([cost, remaining], Move { from, to, step });
    }

    /// Opens the pieces that begin at the start.
    fn open_start(&mut self) {
        let (start, goal) = (self.start(), self.goal());
        let (map, reach_m) = (self.map, self.task.reach_m());
        for &facing in self.task.facings() {
            if self.task.ends.start_is_free && !map.places.is_empty() {
                self.push(0.0, [start, Self::node(0, facing)], Step::Here);
            }
            let near = (0..map.places.len()).take_while(|&place| map.s_m(place) <= reach_m);
            for place in near.filter(|&place| map.is_station(place)) {
                self.open_word([start, Self::node(place, facing)]);
            }
        }
        if map.line.length_m() <= reach_m {
            self.open_word([start, goal]);
        }
    }

    /// Opens the pieces that begin at a place.
    fn open_from(&mut self, node: usize) {
        let (place, facing) = Self::place(node);
        let (map, cost) = (self.map, self.costs[node]);
        let factor = self.task.gear_factor(facing.sign());
        if let Some((next, length_m)) = map.next_on_leg(place) {
            let nodes = [node, Self::node(next, facing)];
            self.push(cost + factor * length_m, nodes, Step::Straight);
        } else if map.is_end(place) && self.task.ends.goal_is_free {
            self.push(cost, [node, self.goal()], Step::Here);
        }
        match map.places[place].role {
            Role::TurnBegins(i) => {
                let member = &map.members[i];
                let nodes = [node, Self::node(member.places[1], facing)];
                self.push(cost + factor * member.cost(), nodes, Step::Turning(i));
            }
            Role::Station => self.open_words(node),
            Role::TurnEnds(_) => {}
        }
    }

    /// Opens the curves from a station to those on later legs and to the goal.
    fn open_words(&mut self, node: usize) {
        let (place, _) = Self::place(node);
        for to in self.later_stations(place) {
            for &facing in self.task.facings() {
                self.open_word([node, Self::node(to, facing)]);
            }
        }
        if self.goal_is_near(place) {
            self.open_word([node, self.goal()]);
        }
    }

    /// Stations on later legs to which a curve may lead.
    fn later_stations(&self, place: usize) -> impl Iterator<Item = usize> + use<'a> {
        let map = self.map;
        let end_m = map.s_m(place) + self.task.reach_m();
        let later = match self.task.config.corners {
            Corners::TwoTurning | Corners::BSpline => 0..0,
            Corners::TwoTurningOrDubins | Corners::WideArcs => {
                map.legs[map.places[place].leg].end..map.places.len()
            }
        };
        let near = later.take_while(move |&to| map.s_m(to) <= end_m);
        near.filter(|&to| map.is_station(to))
    }

    /// Whether a curve may lead to the goal.
    fn goal_is_near(&self, place: usize) -> bool {
        self.map.line.length_m() - self.map.s_m(place) <= self.task.reach_m()
    }

    /// Opens the curves between two nodes at a lower bound of their cost.
    fn open_word(&mut self, nodes: [usize; 2]) {
        if self.came_by[nodes[1]].is_none() {
            let cost = self.costs[nodes[0]] + self.least_word_cost(nodes);
            self.push(cost, nodes, Step::AnyWord);
        }
    }

    fn least_word_cost(&self, nodes: [usize; 2]) -> f64 {
        let [from, to] = nodes.map(|node| self.position(node));
        from.distance(to) + self.passing_cost(nodes)
    }

    /// Cost of the corners that a curve passes; to begin or end with a curve where the polyline's
    /// own heading would do costs as much.
    fn passing_cost(&self, [from, to]: [usize; 2]) -> f64 {
        let leg = |node: usize| self.map.places[node / 2].leg;
        let ends = self.task.ends;
        let (first, begins) = if from == self.start() {
            (0, usize::from(ends.start_is_free))
        } else {
            (leg(from), 0)
        };
        let (last, finishes) = if to == self.goal() {
            (self.map.line.n_corners(), usize::from(ends.goal_is_free))
        } else {
            (leg(to), 0)
        };
        let n_passed = last - first + begins + finishes;
        n_passed as f64 * self.task.config.passed_corner_radii * self.task.radius_m
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
    fn expand(&mut self, nodes: [usize; 2]) {
        let gears = nodes.map(|node| self.gear(node));
        let [from, to] = nodes.map(|node| self.poses(node));
        let mut words = Vec::new();
        for (&a, &b) in from.iter().flat_map(|a| to.iter().map(move |b| (a, b))) {
            let curves = self.task.words(a, b).into_iter();
            words.extend(curves.map(|curve| (self.task.word_cost(&curve, gears), a, curve)));
        }
        words.sort_by(|a, b| a.0.total_cmp(&b.0));
        let before = self.costs[nodes[0]] + self.passing_cost(nodes);
        for (cost, start, curve) in words.into_iter().take(MAX_WORDS) {
            let word = Step::Word(self.words.len());
            self.push(before + cost, nodes, word);
            self.words.push((start, curve));
        }
    }

    fn is_free(&mut self, from: usize, step: Step) -> bool {
        match step {
            Step::Straight => self.is_straight_free(from),
            Step::Turning(_) | Step::Word(_) => {
                let (start, arcs) = self.motion(from, step);
                self.task.all_free(start, &arcs)
            }
            Step::Here => true,
            Step::AnyWord => false,
        }
    }

    /// Whether the body can drive straight on to the next place.
    fn is_straight_free(&mut self, node: usize) -> bool {
        let (place, facing) = Self::place(node);
        let (task, map) = (self.task, self.map);
        let leg = map.places[place].leg;
        let range = map.legs[leg].clone();
        let free = self.straights[Self::node(leg, facing)].get_or_insert_with(|| {
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
        let arcs = match step {
            Step::Turning(member) => self.map.members[member].turning.arcs().to_vec(),
            Step::Straight => {
                let next = self.map.next_on_leg(place);
                next.into_iter()
                    .map(|(_, length_m)| Arc::new(0.0, length_m))
                    .collect()
            }
            Step::Here | Step::AnyWord | Step::Word(_) => Vec::new(),
        };
        let arcs = arcs.into_iter().map(|arc| facing.seen(arc)).collect();
        (self.map.pose(place, facing), arcs)
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

/// Marks the steps from place to place that are free: all by one sweep, or else their halves.
fn mark_free(task: &Task, (map, facing): (&Roadmap, Facing), first: usize, free: &mut [bool]) {
    let length_m = map.places[first + free.len()].at_m - map.places[first].at_m;
    let arc = facing.seen(Arc::new(0.0, length_m));
    if task.is_free(map.pose(first, facing), arc) {
        free.fill(true);
    } else if free.len() > 1 {
        let half = free.len() / 2;
        let (low, high) = free.split_at_mut(half);
        mark_free(task, (map, facing), first, low);
        mark_free(task, (map, facing), first + half, high);
    }
}

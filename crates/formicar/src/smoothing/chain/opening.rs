//! The pieces that may follow a node.

use super::node::Node;
use super::{Search, Span, Step};
use crate::geometry::Pose2;
use crate::smoothing::config::Corners;
use crate::smoothing::roadmap::{Facing, Role};

/// Curves tried between two poses, cheapest first.
const MAX_WORDS: usize = 6;

impl<'a> Search<'a> {
    /// Opens the pieces that begin at the start.
    pub(super) fn open_start(&mut self) {
        let (map, reach_m) = (self.map, self.task.reach_m());
        let from = Node::Start;
        for &facing in self.task.facings() {
            if self.task.ends.start_is_free && !map.junctions.is_empty() {
                let to = Node::Passing(0, facing);
                self.push(0.0, Span { from, to }, Step::Here);
            }
            let near = (0..map.junctions.len()).take_while(|&to| map.s_m(to) <= reach_m);
            for junction in near.filter(|&junction| map.is_station(junction)) {
                let to = Node::Passing(junction, facing);
                self.open_word(Span { from, to });
            }
        }
        if map.line.length_m() <= reach_m {
            let to = Node::Goal;
            self.open_word(Span { from, to });
        }
    }

    /// Opens the pieces that begin at a junction.
    pub(super) fn open_from(&mut self, junction: usize, facing: Facing) {
        let from = Node::Passing(junction, facing);
        let (map, cost) = (self.map, self.costs[from]);
        let factor = self.task.cost.gear_factor(facing.sign());
        if let Some((next, length_m)) = map.next_on_leg(junction) {
            let to = Node::Passing(next, facing);
            self.push(cost + factor * length_m, Span { from, to }, Step::Straight);
        } else if map.is_end(junction) && self.task.ends.goal_is_free {
            let to = Node::Goal;
            self.push(cost, Span { from, to }, Step::Here);
        }
        match map.junctions[junction].role {
            Role::TurnBegins(i) => {
                let member = &map.members[i];
                let to = Node::Passing(member.junctions[1], facing);
                let cost = cost + factor * member.cost();
                self.push(cost, Span { from, to }, Step::Turning(i));
            }
            Role::Station => self.open_words(junction, from),
            Role::TurnEnds(_) => {}
        }
    }

    /// Opens the curves from a station to those on later legs and to the goal.
    fn open_words(&mut self, junction: usize, from: Node) {
        for later in self.later_stations(junction) {
            for &facing in self.task.facings() {
                let to = Node::Passing(later, facing);
                self.open_word(Span { from, to });
            }
        }
        if self.goal_is_near(junction) {
            let to = Node::Goal;
            self.open_word(Span { from, to });
        }
    }

    /// Stations on later legs to which a curve may lead.
    pub(super) fn later_stations(&self, junction: usize) -> impl Iterator<Item = usize> + use<'a> {
        let map = self.map;
        let end_m = map.s_m(junction) + self.task.reach_m();
        let later = match self.task.config.corners {
            Corners::TwoTurning | Corners::BSpline => 0..0,
            Corners::TwoTurningOrDubins | Corners::WideArcs => {
                map.legs[map.junctions[junction].leg].end..map.junctions.len()
            }
        };
        let near = later.take_while(move |&to| map.s_m(to) <= end_m);
        near.filter(|&to| map.is_station(to))
    }

    /// Whether a curve may lead to the goal.
    pub(super) fn goal_is_near(&self, junction: usize) -> bool {
        self.map.line.length_m() - self.map.s_m(junction) <= self.task.reach_m()
    }

    /// Opens the curves between two nodes at a lower bound of their cost.
    fn open_word(&mut self, span: Span) {
        if self.came_by[span.to].is_none() {
            let cost = self.costs[span.from] + self.least_word_cost(span);
            self.push(cost, span, Step::AnyWord);
        }
    }

    /// Puts the cheapest curves between two nodes on the open list, each with its cost.
    pub(super) fn expand(&mut self, span: Span) {
        let nodes = [span.from, span.to];
        let gears = nodes.map(gear);
        let [from, to] = nodes.map(|node| self.poses(node));
        let mut words = Vec::new();
        for (&a, &b) in from.iter().flat_map(|a| to.iter().map(move |b| (a, b))) {
            let curves = self.task.words(a, b).into_iter();
            words.extend(curves.map(|curve| (self.task.word_cost(&curve, gears), a, curve)));
        }
        words.sort_by(|a, b| a.0.total_cmp(&b.0));
        let before = self.costs[span.from] + self.passing_cost(span);
        for (cost, start, curve) in words.into_iter().take(MAX_WORDS) {
            let word = Step::Word(self.words.len());
            self.push(before + cost, span, word);
            self.words.push((start, curve));
        }
    }

    /// The poses of a node.
    fn poses(&self, node: Node) -> Vec<Pose2> {
        match node {
            Node::Passing(junction, facing) => vec![self.map.pose(junction, facing)],
            Node::Start => self.task.ends.starts.clone(),
            Node::Goal => self.task.ends.goals.clone(),
        }
    }
}

/// The gear in which a node is passed; 0 at the ends, where no gear is engaged.
fn gear(node: Node) -> f64 {
    match node {
        Node::Passing(_, facing) => facing.sign(),
        Node::Start | Node::Goal => 0.0,
    }
}

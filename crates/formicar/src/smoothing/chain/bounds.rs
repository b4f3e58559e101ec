//! Lower bounds of costs.

use super::node::Node;
use super::{Search, Span};
use crate::geometry::Point2;
use crate::smoothing::roadmap::{Facing, Role};

impl Search<'_> {
    /// Lower bound of the cost from a junction to the goal, from those of later junctions.
    pub(super) fn least_remaining(&self, junction: usize) -> f64 {
        let map = self.map;
        let onward = |to: usize, cost: f64| cost + self.remaining[to];
        let by_word = |to: Node| {
            let from = Node::Passing(junction, Facing::Along);
            self.least_word_cost(Span { from, to })
        };
        let mut least = f64::INFINITY;
        if let Some((next, length_m)) = map.next_on_leg(junction) {
            least = least.min(onward(next, length_m));
        } else if map.is_end(junction) && self.task.ends.goal_is_free {
            least = 0.0;
        }
        match map.junctions[junction].role {
            Role::TurnBegins(member) => {
                let member = &map.members[member];
                least = least.min(onward(member.junctions[1], member.cost()));
            }
            Role::Station => {
                for to in self.later_stations(junction) {
                    least = least.min(onward(to, by_word(Node::Passing(to, Facing::Along))));
                }
                if self.goal_is_near(junction) {
                    least = least.min(by_word(Node::Goal));
                }
            }
            Role::TurnEnds(_) => {}
        }
        least
    }

    pub(super) fn least_word_cost(&self, span: Span) -> f64 {
        let [from, to] = [span.from, span.to].map(|node| self.position(node));
        from.distance(to) + self.passing_cost(span)
    }

    /// Cost of the corners that a curve passes. A curve at an end whose heading is free costs as
    /// much as a corner: the polyline's own heading would do.
    pub(super) fn passing_cost(&self, span: Span) -> f64 {
        let leg = |junction: usize| self.map.junctions[junction].leg;
        let ends = self.task.ends;
        let (first, begins) = match span.from {
            Node::Passing(junction, _) => (leg(junction), 0),
            Node::Start | Node::Goal => (0, usize::from(ends.start_is_free)),
        };
        let (last, finishes) = match span.to {
            Node::Passing(junction, _) => (leg(junction), 0),
            Node::Start | Node::Goal => (self.map.line.n_corners(), usize::from(ends.goal_is_free)),
        };
        let n_passed = last - first + begins + finishes;
        n_passed as f64 * self.task.config.passed_corner_radii * self.task.radius_m
    }

    fn position(&self, node: Node) -> Point2 {
        let points = &self.map.line.points;
        match node {
            Node::Passing(junction, _) => self.map.pose(junction, Facing::Along).position(),
            Node::Start => points[0],
            Node::Goal => points[points.len() - 1],
        }
    }
}

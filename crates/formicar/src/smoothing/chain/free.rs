//! Collision checks of the steps between nodes.

use super::node::Node;
use super::{Search, Step};
use crate::geometry::{Arc, Pose2};
use crate::smoothing::roadmap::{Facing, Roadmap};
use crate::smoothing::task::RoundingTask;

impl Search<'_> {
    pub(super) fn is_free(&mut self, from: Node, step: Step) -> bool {
        match (step, from) {
            (Step::Straight, Node::Passing(junction, facing)) => {
                self.is_straight_free(junction, facing)
            }
            (Step::Turning(_) | Step::Word(_), _) => {
                let (start, arcs) = self.motion(from, step);
                self.task.all_free(start, &arcs)
            }
            (Step::Here, _) => true,
            (Step::Straight | Step::AnyWord, _) => false,
        }
    }

    /// Whether the body can drive straight on to the next junction.
    fn is_straight_free(&mut self, junction: usize, facing: Facing) -> bool {
        let leg = self.map.junctions[junction].leg;
        let range = self.map.legs[leg].clone();
        let line = StraightLine {
            task: self.task,
            map: self.map,
            facing,
        };
        let free = self.straights[leg][facing as usize].get_or_insert_with(|| {
            let mut free = vec![false; range.len() - 1];
            line.mark_free(range.start, &mut free);
            free
        });
        free[junction - range.start]
    }

    /// The pose at which a step begins, and its arcs.
    pub(super) fn motion(&self, from: Node, step: Step) -> (Pose2, Vec<Arc>) {
        let (junction, facing) = match (step, from) {
            (Step::Word(word), _) => {
                let (start, curve) = &self.words[word];
                return (*start, curve.arcs().to_vec());
            }
            (_, Node::Passing(junction, facing)) => (junction, facing),
            (_, Node::Start | Node::Goal) => return (Pose2::default(), Vec::new()),
        };
        let arcs = match step {
            Step::Turning(member) => self.map.members[member].turning.arcs().to_vec(),
            Step::Straight => {
                let next = self.map.next_on_leg(junction);
                next.into_iter()
                    .map(|(_, length_m)| Arc::new(0.0, length_m))
                    .collect()
            }
            Step::Here | Step::AnyWord | Step::Word(_) => Vec::new(),
        };
        let arcs = arcs.into_iter().map(|arc| facing.seen(arc)).collect();
        (self.map.pose(junction, facing), arcs)
    }
}

/// A leg driven in a facing.
struct StraightLine<'a> {
    task: &'a RoundingTask<'a>,
    map: &'a Roadmap,
    facing: Facing,
}

impl StraightLine<'_> {
    /// Marks the steps from junction to junction that are free: all by one sweep, or else their
    /// halves.
    fn mark_free(&self, first: usize, free: &mut [bool]) {
        let junctions = &self.map.junctions;
        let length_m = junctions[first + free.len()].at_m - junctions[first].at_m;
        let arc = self.facing.seen(Arc::new(0.0, length_m));
        if self.task.is_free(self.map.pose(first, self.facing), arc) {
            free.fill(true);
        } else if free.len() > 1 {
            let half = free.len() / 2;
            let (low, high) = free.split_at_mut(half);
            self.mark_free(first, low);
            self.mark_free(first + half, high);
        }
    }
}

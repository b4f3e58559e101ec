//! A chain of clothoids between two poses. The variables of its solver are curvatures at nodes, and
//! lengths.

use crate::geometry::{Point2, Pose2};

/// A curvature at a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) curvature_per_m: f64,
    /// Whether it may change.
    pub(super) is_free: bool,
}

/// A clothoid between two nodes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ramp {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) length_m: f64,
    /// +1 forward, -1 in reverse.
    pub(super) sign: f64,
}

/// Clothoids one after the other. Neighbors in one gear share a node.
#[derive(Clone, Debug, Default)]
pub(super) struct Chain {
    pub(super) nodes: Vec<Node>,
    pub(super) ramps: Vec<Ramp>,
}

/// The derivative of the last pose by a variable.
pub(super) type Effect = [f64; 3];

impl Chain {
    /// Adds a node.
    pub(super) fn node(&mut self, curvature_per_m: f64, is_free: bool) -> usize {
        self.nodes.push(Node {
            curvature_per_m,
            is_free,
        });
        self.nodes.len() - 1
    }

    pub(super) fn curvatures(&self, ramp: &Ramp) -> [f64; 2] {
        [ramp.from, ramp.to].map(|i| self.nodes[i].curvature_per_m)
    }

    pub(super) fn length_m(&self) -> f64 {
        self.ramps.iter().map(|ramp| ramp.length_m).sum()
    }

    /// The poses between the ramps, from the first to the last, beginning at a pose.
    pub(super) fn poses(&self, start: Pose2) -> Vec<Pose2> {
        let ramps = self.ramps.iter().scan(start, |pose, ramp| {
            *pose = pose.compose(local(self.curvatures(ramp), ramp.length_m, ramp.sign));
            Some(*pose)
        });
        std::iter::once(start).chain(ramps).collect()
    }

    /// The derivatives of the last of `poses` by the curvature of each node and the length of each
    /// ramp.
    pub(super) fn effects(&self, poses: &[Pose2]) -> Vec<Effect> {
        let mut effects = vec![[0.0; 3]; self.nodes.len() + self.ramps.len()];
        let end = poses[poses.len() - 1].position();
        for (i, ramp) in self.ramps.iter().enumerate() {
            let lever = end - poses[i + 1].position();
            let along = Point2::unit(poses[i].heading);
            let carried = |[x, y, turn]: Effect| {
                let shift = along * x + along.perpendicular() * y + lever.perpendicular() * turn;
                [shift.x, shift.y, turn]
            };
            let [by_from, by_to, by_length] = self.local_effects(ramp).map(carried);
            for (place, effect) in [
                (ramp.from, by_from),
                (ramp.to, by_to),
                (self.nodes.len() + i, by_length),
            ] {
                for (sum, part) in effects[place].iter_mut().zip(effect) {
                    *sum += part;
                }
            }
        }
        effects
    }

    /// Central differences: a ramp's end by its curvatures and its length.
    fn local_effects(&self, ramp: &Ramp) -> [Effect; 3] {
        let ([a, b], length) = (self.curvatures(ramp), ramp.length_m);
        let bend = 1e-4 / length.max(1e-3);
        let stretch = 1e-4 * length;
        let at = |a, b, length| local([a, b], length, ramp.sign);
        [
            difference(at(a - bend, b, length), at(a + bend, b, length), bend),
            difference(at(a, b - bend, length), at(a, b + bend, length), bend),
            difference(
                at(a, b, length - stretch),
                at(a, b, length + stretch),
                stretch,
            ),
        ]
    }
}

fn local([from, to]: [f64; 2], length_m: f64, sign: f64) -> Pose2 {
    let rate = sign * (to - from) / length_m;
    Pose2::default().advance_clothoid(from, rate, sign * length_m)
}

fn difference(before: Pose2, after: Pose2, step: f64) -> Effect {
    let scale = 0.5 / step;
    [
        scale * (after.x - before.x),
        scale * (after.y - before.y),
        scale * (after.heading - before.heading),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effects_are_those_of_small_changes() {
        let mut chain = Chain::default();
        for k in [0.1, 0.4, -0.2, 0.3, 0.0] {
            chain.node(k, true);
        }
        let ramp = |from, to, length_m, sign| Ramp {
            from,
            to,
            length_m,
            sign,
        };
        chain.ramps = vec![
            ramp(0, 1, 1.0, 1.0),
            ramp(1, 2, 2.0, 1.0),
            ramp(3, 4, 1.5, -1.0),
        ];
        let start = Pose2::new(1.0, 2.0, 0.5);
        let end = |chain: &Chain| chain.poses(start)[3];
        let effects = chain.effects(&chain.poses(start));
        for (i, effect) in effects.iter().enumerate() {
            let moved = |by: f64| {
                let mut other = chain.clone();
                match i {
                    0..5 => other.nodes[i].curvature_per_m += by,
                    _ => other.ramps[i - 5].length_m += by,
                }
                end(&other)
            };
            let truth = difference(moved(-1e-4), moved(1e-4), 1e-4);
            let off = effect.iter().zip(truth).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 1e-6, "{i}: {effect:?} {truth:?}");
        }
    }
}

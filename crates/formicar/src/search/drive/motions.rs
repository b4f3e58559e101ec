//! The motions of a query: their ends and their collision checks.

use super::{DriveProblem, Guide, State};
use crate::collision::Drive;
use crate::geometry::{Arc, Point2, Pose2};
use crate::vehicle::{Alignment, Gears};

impl DriveProblem<'_> {
    /// The states that motions lead to and that do not certainly hit anything: by a primitive
    /// each, or from a start by the arcs onto the lattice.
    pub fn successors(&self, from: &State, mut then: impl FnMut(usize, State)) {
        if !from.is_start {
            for step in 0..self.n_primitives() {
                if let Some(state) = self.arrive(from, step) {
                    then(step, state);
                }
            }
            return;
        }
        let arcs = self.primitives().alignment_arcs(from.pose.heading);
        for (step, Alignment { arc, heading_index }) in arcs.into_iter().enumerate() {
            let position = arc.end_from(from.pose).position();
            let is_allowed = self.step_gears == Gears::Both || arc.signed_length_m >= 0.0;
            if is_allowed && let Some(state) = self.after(from, arc, position, heading_index) {
                then(step, state);
            }
        }
    }

    /// Least estimated cost of another motion in the same gear and the path from there; none where
    /// every such motion certainly hits something or leads nowhere.
    pub fn look_ahead(&self, guide: &Guide, state: &State) -> Option<f64> {
        let primitives = self.primitives();
        let half = primitives.primitives().len() / 2;
        let of_gear = if state.arc.signed_length_m < 0.0 {
            half..2 * half
        } else {
            0..half
        };
        let moved = &primitives.displacements(state.heading_index)[of_gear.clone()];
        let moves = primitives.primitives()[of_gear].iter().zip(moved);
        let mut least = None::<f64>;
        for (primitive, &moved) in moves {
            let position = state.pose.position() + moved;
            let heading_index = primitives.heading_after(state.heading_index, primitive);
            if self.hits(position, primitives.unit(heading_index)) {
                continue;
            }
            if let Some(to_go) = guide.estimate_m(self, position) {
                let ahead = primitive.length_m + to_go;
                least = Some(least.map_or(ahead, |least| least.min(ahead)));
            }
        }
        least
    }

    /// Approximate length of a motion, meters.
    pub fn step_m(&self) -> f64 {
        self.primitives().primitives()[0].length_m
    }

    /// Number of motions from a state on the lattice.
    pub fn n_primitives(&self) -> usize {
        let n_primitives = self.primitives().primitives().len();
        match self.step_gears {
            Gears::Forward => n_primitives / 2,
            Gears::Both => n_primitives,
        }
    }

    /// The state that a primitive leads to; none where it certainly hits something. Headings are
    /// put exactly on the lattice, so that rounding does not add up.
    pub fn arrive(&self, from: &State, step: usize) -> Option<State> {
        let lattice = self.primitives();
        let primitive = &lattice.primitives()[step];
        let moved = lattice.displacements(from.heading_index)[step];
        let heading_index = lattice.heading_after(from.heading_index, primitive);
        let position = from.pose.position() + moved;
        self.after(from, primitive.arc(), position, heading_index)
    }

    fn after(
        &self,
        from: &State,
        arc: Arc,
        position: Point2,
        heading_index: usize,
    ) -> Option<State> {
        let along = self.primitives().unit(heading_index);
        if self.hits(position, along) {
            return None;
        }
        let dearness = self.dearness(position, along)?;
        Some(State {
            pose: Pose2::at(position, self.primitives().heading_rad(heading_index)),
            heading_index,
            arc,
            cost: from.cost + self.cost(from.arc, arc, dearness),
            is_start: false,
        })
    }

    /// Whether the body certainly hits something or keeps too little clearance: a look at one cell.
    pub(super) fn hits(&self, position: Point2, along: Point2) -> bool {
        let (obstacles, body) = (self.map.obstacles(), self.map.body());
        obstacles.ceiling_at_m(body, position, along) < self.kept_clearance_m
    }

    /// Whether a motion from a state is free, by its mask or exactly.
    pub fn is_free(&self, from: &State, step: usize, arc: Arc) -> bool {
        if from.is_start {
            return arc.signed_length_m == 0.0 || self.is_arc_free(from.pose, arc);
        }
        let (padded, position) = (self.map.padded(), from.pose.position());
        let masks = &self.lattice.masks;
        masks.is_clear(padded, position, from.heading_index, step)
            || self.is_exact && self.is_arc_free(from.pose, arc)
    }

    /// Whether the body keeps off everything along an arc, exactly.
    pub fn is_arc_free(&self, start: Pose2, arc: Arc) -> bool {
        let drive = Drive {
            start,
            curvature_per_m: arc.curvature_per_m,
            signed_length_m: arc.signed_length_m,
        };
        let obstacles = self.map.obstacles();
        obstacles.is_free_by_steps(self.map.body(), &drive)
    }
}

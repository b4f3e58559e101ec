//! From the nodes that a search over cells found to a path that the vehicle can drive.

use super::{Ended, Found, Stages, Task};
use crate::map::{BitGrid, DiagonalRule, MoveMasks};
use crate::path::GridPath;
use crate::progress::{Limits, Status};
use crate::smoothing::{SmoothingConfig, SmoothingProblem, smooth_while};
use std::cell::RefCell;

/// A path over cells, with the ground on which it was found and by whom.
pub(super) struct CellPath<'a> {
    pub(super) path: &'a GridPath,
    /// The cells that it avoids.
    pub(super) blocked: &'a BitGrid,
    /// The rule by which it passes corners.
    pub(super) rule: DiagonalRule,
    /// Who found what, as a sentence begins.
    pub(super) found: String,
    /// Advice where the path cannot be driven.
    pub(super) hint: &'static str,
}

impl<'a> CellPath<'a> {
    /// A path over these moves, which the planner that is asked has found.
    pub(super) fn of_search(
        task: &Task,
        moves: &'a MoveMasks,
        path: &'a GridPath,
        places: &str,
    ) -> Self {
        let (planner, n_places) = (task.planner(), path.cells.len());
        Self {
            path,
            blocked: moves.blocked(),
            rule: moves.rule(),
            found: format!("{planner} found a way of {n_places} {places}"),
            hint: "hybrid-astar searches over what the car can drive",
        }
    }

    /// Makes the path drivable: for a car redundant nodes go and corners are rounded, for a point
    /// it stays a polyline.
    pub(super) fn made_drivable(
        &self,
        task: &Task,
        smoothing: &SmoothingConfig,
        mut stages: Stages,
        limits: &mut Limits,
    ) -> Result<Found, Ended> {
        let problem = SmoothingProblem {
            obstacles: task.obstacles(),
            vehicle: task.vehicle(),
            blocked: self.blocked,
            rule: self.rule,
        };
        let nodes = smoothing
            .redundant_nodes
            .apply(self.blocked, self.rule, self.path);
        let shared = RefCell::new(&mut *limits);
        let goes_on = || shared.borrow_mut().look().is_ok();
        let smoothed = smooth_while(&problem, (smoothing, task.request()), &nodes, &goes_on);
        stages.nodes = nodes;
        if let Err(status) = limits.look() {
            return Err(Ended::new(status, stages));
        }
        match smoothed {
            Ok(smoothed) => {
                stages.corners = smoothed.corners;
                Ok(Found::new(smoothed.path, stages))
            }
            Err(error) => {
                let reason = format!(
                    "{} that cannot be made drivable: {error}; hint: {}",
                    self.found, self.hint
                );
                Err(Ended::because(Status::Infeasible, reason, stages))
            }
        }
    }
}

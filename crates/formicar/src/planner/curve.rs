//! From the nodes that a search over cells found to a path that the vehicle can drive.

use super::run::{Ended, Found};
use super::{Planner, Stages};
use crate::map::{BitGrid, DiagonalRule};
use crate::path::GridPath;
use crate::progress::Status;
use crate::scenario::Request;
use crate::smoothing::{SmoothingProblem, smooth};

/// On which problem a way was found, and by whom.
pub(super) struct Origin<'a> {
    /// The cells that it avoids.
    pub(super) blocked: &'a BitGrid,
    /// The rule by which it passes corners.
    pub(super) rule: DiagonalRule,
    /// Who found what, as a sentence begins.
    pub(super) found: String,
    /// What may help where the way cannot be driven.
    pub(super) hint: &'static str,
}

impl Planner {
    /// Makes a way over cells drivable: for a car redundant nodes go and corners are rounded, for
    /// a point it stays a polyline.
    pub(super) fn curve_of(
        &self,
        request: &Request,
        mut stages: Stages,
        way: &GridPath,
        origin: &Origin,
    ) -> Result<Found, Ended> {
        let problem = SmoothingProblem {
            obstacles: &self.obstacles,
            vehicle: &self.vehicle,
            blocked: origin.blocked,
            rule: origin.rule,
        };
        let config = &self.config.smoothing;
        let nodes = config
            .redundant_nodes
            .apply(problem.blocked, problem.rule, way);
        let smoothed = smooth(&problem, config, request, &nodes);
        stages.nodes = nodes;
        match smoothed {
            Ok(smoothed) => {
                stages.corners = smoothed.corners;
                Ok(Found::new(smoothed.path, stages))
            }
            Err(error) => {
                let reason = format!(
                    "{} that cannot be made drivable: {error}; hint: {}",
                    origin.found, origin.hint
                );
                Err(Ended::because(Status::Infeasible, reason, stages))
            }
        }
    }
}

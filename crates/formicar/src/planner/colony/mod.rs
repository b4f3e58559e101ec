//! Colonies over cells: layers, ants, nodes, a curve.

use super::family::{Family, sections};
use super::polyline::CellPath;
use super::{Abilities, Ended, Found, Halt, Stages, Task};
use crate::colony::{ColonyConfig, ColonyProblem, ColonyRun, presets, run};
use crate::geometry::Pose2;
use crate::layers::{Expansion, Layers, LayersConfig, UShapes};
use crate::map::{Cell, MoveMasks};
use crate::objective::DriveCost;
use crate::progress::{Event, Limits, Status, Stop};
use crate::smoothing::{Corners, SmoothingConfig};

sections! {
    /// Parameters of the colonies over cells.
    ColonyParameters {
        /// Layers over the map, on which ants walk.
        layers: LayersConfig,
        /// The colony.
        colony: ColonyConfig,
        /// Smoothing: from a path over cells to one that a car can drive.
        smoothing: SmoothingConfig,
        /// Weights of transitions, where a request asks for continuous curvature.
        #[cfg_attr(feature = "serde", serde(skip_serializing_if = "DriveCost::is_default"))]
        cost: DriveCost,
    }
}

impl Default for ColonyParameters {
    fn default() -> Self {
        Self::of(ColonyConfig::default())
    }
}

impl ColonyParameters {
    /// A colony on obstacles grown by half the vehicle's width, corners rounded.
    pub fn of(colony: ColonyConfig) -> Self {
        Self {
            layers: LayersConfig {
                expansion: Expansion::HalfWidth,
                u_shapes: UShapes::Keep,
            },
            colony,
            smoothing: SmoothingConfig::default(),
            cost: DriveCost::default(),
        }
    }

    /// The method of Lei & Zheng 2020: U-shapes are closed.
    pub fn lei2020() -> Self {
        let mut parameters = Self::of(presets::lei2020());
        parameters.layers.u_shapes = UShapes::Close;
        parameters
    }

    /// The second method that Li et al. 2024 compare with: a B-spline.
    pub fn acof() -> Self {
        let mut parameters = Self::of(presets::acof());
        parameters.smoothing.corners = Corners::BSpline;
        parameters
    }
}

impl Family for ColonyParameters {
    /// Sends the colony, and makes its best path drivable.
    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt> {
        let (layers, [start, goal]) = self.lay(task, limits)?;
        limits.tell(&Event::SearchStarted);
        let moves = MoveMasks::new(&layers.blocked, self.colony.diagonal_rule);
        let problem = ColonyProblem::new(moves, start, goal);
        limits.look()?;
        let mut stages = Stages {
            layers: Some(layers),
            ..Stages::default()
        };
        let run = match run(
            &problem,
            &self.colony,
            task.seed(),
            task.n_threads(),
            limits,
        ) {
            Ok(run) => run,
            Err(error) => {
                let ended = Halt::from(error).ended()?;
                return Err(Ended::new(ended.status, stages).into());
            }
        };
        let (best, stop, reason) = (run.best.clone(), run.stop, self.reason(task, &run));
        stages.colony = Some(run);
        stages.grid_path.clone_from(&best);
        let Some(best) = best.filter(|_| stop != Stop::Cancelled) else {
            return Err(Halt::Ended(Ended {
                reason,
                ..Ended::new(stop.status(), stages)
            }));
        };
        let way = CellPath {
            path: &best,
            blocked: problem.moves().blocked(),
            rule: self.colony.diagonal_rule,
            found: format!("the ants found a way of {} cells", best.cells.len()),
            hint: "a larger layers.expansion keeps them off corners",
        };
        Ok(way.made_drivable(
            task,
            &self.smoothing,
            stages,
            &mut stop.limits_after(limits),
        )?)
    }

    fn abilities(&self) -> Abilities {
        Abilities {
            sends_ants: true,
            ..Abilities::default()
        }
    }

    fn cost(&self) -> &DriveCost {
        &self.cost
    }
}

impl ColonyParameters {
    /// Lays the layers, and finds the cells between which ants walk: those of start and goal or,
    /// where these are covered, the nearest that are not.
    fn lay(&self, task: &Task, limits: &mut Limits) -> Result<(Layers, [Cell; 2]), Ended> {
        let frame = task.obstacles().frame();
        let cell = |pose: Pose2| frame.cell_at(pose.position()).unwrap_or_default();
        let ends = [task.request().start, task.request().goal].map(cell);
        let width_cells = width_cells(task);
        let rule = self.colony.diagonal_rule;
        let lethal = task.obstacles().lethal();
        let ground = (lethal, width_cells);
        let goes_on = &mut || limits.look().is_ok();
        let layers = Layers::new_while(ground, &self.layers, (&ends, rule), goes_on);
        limits.look()?;
        // The body is free at both ends, so its middle is no farther than this from open ground.
        let radius = 2 * self.layers.expansion.n_cells(width_cells) + 1;
        let open = |end: &str, cell: Cell| {
            layers.nearest_open(cell, radius).ok_or_else(|| {
                let reason = format!(
                    "no cell within {radius} cells of the {end} is open after obstacle expansion; hint: a smaller layers.expansion"
                );
                Ended::because(Status::NoPath, reason, Stages::default())
            })
        };
        let ends = [open("start", ends[0])?, open("goal", ends[1])?];
        Ok((layers, ends))
    }

    /// Why the colony has no path, where that is its own fault.
    fn reason(&self, task: &Task, run: &ColonyRun) -> Option<String> {
        let n_expanded = self.layers.expansion.n_cells(width_cells(task));
        match run.stop {
            Stop::Iterations | Stop::Stall => Some(format!(
                "none of {} ants reached the goal in {} iterations; hint: more ants (colony.n_ants), colony.guidance.rule=\"advantage\" or colony.dead_end.rule=\"retreat\"",
                self.colony.n_ants,
                run.history.iterations.len()
            )),
            Stop::NoWay if n_expanded > 0 => Some(format!(
                "no steps lead from start to goal among obstacles grown by {n_expanded} cells; hint: a smaller layers.expansion, or hybrid-astar, which uses the true footprint"
            )),
            Stop::TargetCost | Stop::Budget | Stop::Deadline | Stop::Cancelled | Stop::NoWay => {
                None
            }
        }
    }
}

fn width_cells(task: &Task) -> f64 {
    task.vehicle().width_m() / task.obstacles().frame().resolution_m()
}

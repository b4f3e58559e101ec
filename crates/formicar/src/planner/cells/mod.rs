//! `astar`, `dijkstra` and `improved-astar`: a shortest path on grown obstacles, made drivable.

mod config;

pub(super) use config::taut;
pub use config::{AstarParameters, DijkstraParameters, GridSearchConfig, ImprovedAstarParameters};

use super::family::Family;
use super::polyline::CellPath;
use super::prepared::PreparedCells;
use super::{Abilities, Found, Halt, SeveralGoals, Stages, Task};
use crate::map::{Cell, DiagonalRule};
use crate::objective::DriveCost;
use crate::progress::{Event, Limits};
use crate::search::{GoalField, GridSearch, SearchError, astar, improved_astar};
use crate::smoothing::SmoothingConfig;

impl Family for AstarParameters {
    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt> {
        let search = CellSearch::new(&self.grid_search, &self.smoothing);
        search.find(task, limits, |cells, [start, goal], limits| {
            let PreparedCells { moves, workspace } = cells;
            astar(moves, start, goal, workspace, limits)
        })
    }

    fn abilities(&self) -> Abilities {
        one_goal(self.grid_search.diagonal_rule)
    }

    fn cost(&self) -> &DriveCost {
        &self.cost
    }
}

impl Family for DijkstraParameters {
    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt> {
        let search = CellSearch::new(&self.grid_search, &self.smoothing);
        search.find(task, limits, |cells, [start, goal], limits| {
            GoalField::new(&cells.moves, &[goal], limits)?.path(&cells.moves, start)
        })
    }

    fn abilities(&self) -> Abilities {
        one_goal(self.grid_search.diagonal_rule)
    }

    fn cost(&self) -> &DriveCost {
        &self.cost
    }
}

impl Family for ImprovedAstarParameters {
    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt> {
        let search = CellSearch::new(&self.grid_search, &self.smoothing);
        search.find(task, limits, |cells, ends, limits| {
            let PreparedCells { moves, workspace } = cells;
            improved_astar(moves, ends, &self.improved_astar, workspace, limits)
        })
    }

    fn abilities(&self) -> Abilities {
        one_goal(self.grid_search.diagonal_rule)
    }

    fn cost(&self) -> &DriveCost {
        &self.cost
    }
}

/// The abilities of a search over cells that steps by a rule.
pub(super) fn one_goal(rule: DiagonalRule) -> Abilities {
    Abilities {
        goals: SeveralGoals::NearestFirst(rule),
        ..Abilities::default()
    }
}

/// The frame of every search over cells.
struct CellSearch<'a> {
    rule: DiagonalRule,
    smoothing: &'a SmoothingConfig,
}

impl<'a> CellSearch<'a> {
    fn new(grid_search: &GridSearchConfig, smoothing: &'a SmoothingConfig) -> Self {
        Self {
            rule: grid_search.diagonal_rule,
            smoothing,
        }
    }

    /// Searches over cells, and makes the path drivable.
    fn find(
        &self,
        task: &mut Task,
        limits: &mut Limits,
        search: impl FnOnce(
            &mut PreparedCells,
            [Cell; 2],
            &mut Limits,
        ) -> Result<GridSearch, SearchError>,
    ) -> Result<Found, Halt> {
        task.with_cells(self.rule, |task, cells| {
            limits.look()?;
            let ends = task.open_ends(cells.moves.blocked())?;
            limits.tell(&Event::SearchStarted);
            let path = search(cells, ends, limits)?.path;
            let way = CellPath::of_search(task, &cells.moves, &path, "cells");
            let stages = Stages {
                grid_path: Some(path.clone()),
                ..Stages::default()
            };
            Ok(way.made_drivable(task, self.smoothing, stages, limits)?)
        })
    }
}

//! Search on grids: A* from cell to cell, and the field of all costs to a goal.

mod astar;
mod bucket_queue;
mod cost;
mod goal_field;
mod grid_search;

pub use astar::{AstarWorkspace, astar};
pub use cost::{DIAGONAL_COST, STRAIGHT_COST};
pub use goal_field::GoalField;
pub use grid_search::{GridSearch, SearchError};

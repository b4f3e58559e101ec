//! Search: A* from cell to cell, the field of all costs to a goal, hybrid A* from pose to pose.

mod astar;
mod bucket_queue;
mod cost;
mod drive;
mod goal_field;
mod grid_search;
mod guide_field;
mod hybrid_astar;
mod improved_astar;
mod open_queue;
mod passage;
mod wave;

pub use astar::{AstarWorkspace, astar};
pub use cost::{DIAGONAL_COST, STRAIGHT_COST};
pub use drive::{
    DrivableMap, DrivableMapParts, DriveProblem, Driven, FieldGrid, Guide, HybridAstarConfig,
    Inflation, Side, State,
};
pub use goal_field::GoalField;
pub(crate) use grid_search::check_end;
pub use grid_search::{GridSearch, SearchError};
pub use guide_field::GuideField;
pub use hybrid_astar::{HybridSearch, Stage, hybrid_astar};
pub use improved_astar::{ImprovedAstarConfig, improved_astar};
pub use passage::{Passage, widest_passage};
pub(crate) use passage::{widest_passage_while, widest_way_out};

//! Ants that drive: a step is a motion of the vehicle, a path a chain of arcs to the goal pose.
//!
//! First they look for any path. The goal field guides them; it sees obstacles but no headings, and
//! may lead into places that the vehicle cannot drive. Ants die there, and the field is repaired:
//! the cells around get an extra cost, which leads the next ants around them. The repair acts like
//! negative pheromone on the guide.
//!
//! Once a path is known, ants leave it at random positions and drive on by themselves, attracted by
//! the pheromone of the best paths. They find other routes, which local search then shortens.

mod ant;
mod colony;
mod config;
mod repair;
mod shared;
mod trails;
mod walk;

pub use colony::DriveColony;
pub use config::{DriveConfig, FieldRepair, Racers, TrailsConfig};

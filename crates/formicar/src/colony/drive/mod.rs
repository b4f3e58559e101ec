//! Ants that drive: a step is a motion of the vehicle, a way a chain of arcs to the goal pose.
//!
//! They look for a first way. The goal field guides them, which knows obstacles but no headings;
//! where it leads into places that the vehicle cannot drive, ants die, and where they die the field
//! is repaired: these cells become dearer, so that the next ants are led around them. It is
//! pheromone of the opposite sign, laid on the guide.
//!
//! When a way is known, ants leave it anywhere and drive on by themselves, drawn to the pheromone
//! that the best ways left: other ways around, which local search then makes short.

mod ant;
mod colony;
mod config;
mod repair;
mod trails;
mod walk;

pub use colony::DriveColony;
pub use config::{DriveConfig, FieldRepair, Racers, TrailsConfig};

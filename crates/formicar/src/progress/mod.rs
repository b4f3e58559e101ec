//! Watching, timing, limiting and cancelling a query, and its named endings.

mod cancel;
mod clock;
mod driving;
mod frames;
mod history;
mod iteration;
mod limits;
mod observer;
mod pheromone;
mod population;
mod status;

pub use cancel::CancelToken;
pub use clock::StdClock;
pub use driving::{DriveView, DriveWay, ReachedView};
pub use frames::{AntFrame, AntFrames, Traffic};
pub use history::{History, Stop};
pub use iteration::{AntWays, ColonyView, IterationRecord, Pheromone, path_of};
pub use limits::Limits;
pub use observer::{Event, Observer};
pub use pheromone::pheromone_by_cell;
pub use population::PopulationView;
pub use status::Status;

pub(crate) use history::iterate;

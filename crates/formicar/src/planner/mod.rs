//! The one door: a map, a vehicle and a configuration in, certified paths out.
//!
//! Every planner is a [`PathSearch`]. A folder holds each family of built-in planners: its
//! parameters, its search, and what it says of its failures. `door` holds what happens to every
//! request, whichever search is asked; `catalog` names the planners.

mod around;
mod catalog;
mod cells;
mod chords;
mod colony;
mod config;
#[cfg(feature = "serde")]
mod config_document;
mod documents;
mod door;
mod evolution;
mod family;
mod flagship;
mod halt;
mod hybrid;
mod in_time;
mod outcome;
mod polyline;
mod prepared;
mod search;
mod task;

pub use crate::search::{HybridAstarConfig, ImprovedAstarConfig};
pub use around::{WayAround, way_around};
pub use catalog::{PlannerConfig, PlannerName};
pub use cells::{AstarParameters, DijkstraParameters, GridSearchConfig, ImprovedAstarParameters};
pub use chords::ChordParameters;
pub use colony::ColonyParameters;
pub use config::ConfigError;
#[cfg(feature = "serde")]
pub use documents::{
    ANSWER_SCHEMA, Answer, AnswerContext, AnswerError, AnswerStatus, CertificateHashes,
    CertificateNumbers, ColonyRecord, ConfigRecord, EscapeRecord, KeepOutMapRecord, MOVING_SCHEMA,
    MapRecord, MotionRecord, MovingDocument, PathDocument, PoseRecord, ProfileRecord, Provenance,
    RequestDocument, SegmentRecord, SoftCostsRecord, StoredPath, Timing, VehicleRecord, ViaRecord,
    are_samples_of,
};
pub use documents::{Collision, Disconnected, Explanation, Gap};
pub use door::{Escape, Planner, plan};
pub use evolution::EvolutionParameters;
pub use flagship::{FormicarParameters, ReplanConfig};
pub use halt::{Ended, Found, Halt};
pub use hybrid::HybridAstarParameters;
pub use in_time::{DriveError, DriveQuestion, TimedPlan, drive_in_time};
pub use outcome::{NotFound, Outcome, Plan, PlanError, Stages};
pub use prepared::PreparedCells;
pub use search::{Abilities, Hints, PathSearch, SeveralGoals, Vehicles};
pub use task::Task;

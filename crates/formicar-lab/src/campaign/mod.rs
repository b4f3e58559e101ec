//! Campaigns: scenarios x vehicles x planners x seeds, every run once, in one file.
//!
//! A [`Document`] is what a user writes. A [`Campaign`] is the list of [`Job`]s that it comes to,
//! in a fixed order, each with a stable key. A [`Store`] is the file that takes a [`Record`] for
//! each, one transaction a run, so that a kill loses nothing but the runs under way and a restart
//! repeats none that are over.

mod document;
mod job;
mod lock;
mod mistake;
mod plan;
mod record;
mod row;
mod scenarios;
mod seeds;
mod store;
mod stored;
mod table;

pub use document::{Document, PlannerEntry};
pub use job::{
    Contender, Job, Limits, OWN_VEHICLE, Place, RivalCommand, RowKey, Task, VehicleChoice,
};
pub use mistake::Text;
pub use plan::{Campaign, ConfigRecord, Ground, PlannedRun};
pub use record::{History, Improvement, ORIGIN_COLUMNS, Origin, Record, Told};
pub use row::{COLUMNS, KNOWN_BY, Row};
pub use scenarios::ScenariosEntry;
pub use store::{Store, csv_beside};
pub use stored::Stored;
pub use table::{read_csv, to_csv};

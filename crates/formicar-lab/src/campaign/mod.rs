//! Campaigns: scenarios x vehicles x planners x seeds, every run once, in one store.
//!
//! A [`Document`] is what a user writes, a [`CampaignSpec`] what it names. A [`Campaign`] is the
//! list of runs that it comes to, in a fixed order, each with a stable key. [`run_into`] carries
//! out those that are missing in a [`Store`], one transaction a run: a kill loses the runs under
//! way, and a restart repeats no others. A [`Folder`] is a store with its rows as a table.

mod document;
mod execute;
mod folder;
mod lock;
mod mistake;
mod plan;
mod results;
mod scenarios;
mod seeds;
mod sink;
mod spec;
mod store;
mod stored;
mod tables;
mod tasks;

pub use document::{Document, PlannerEntry};
pub use execute::{Execution, MeasuredBy, run, run_in_turns, run_into};
pub use folder::Folder;
pub use mistake::Text;
pub use plan::{Campaign, ConfigRecord, Fingerprint, PlannedRun};
pub use results::{check_once, name_of_file, read_results};
pub use scenarios::ScenariosEntry;
pub use sink::Sink;
pub use spec::CampaignSpec;
pub use store::{Store, csv_beside};
pub use stored::Stored;
pub use tasks::{TaskSource, check_names, spread, tasks_of};

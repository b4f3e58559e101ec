//! All runs of stores in one report: tables, charts, parameter sheets, logs of OMPL.

mod charts;
mod ompl;
mod report;
mod sheets;

pub use ompl::ompl_logs;
pub use report::report;
pub use sheets::parameter_section;

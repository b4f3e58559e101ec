//! Summaries of runs: totals per source of scenarios, and a report of tables, charts and parameter
//! sheets; logs of OMPL.

mod anytime;
mod by_source;
mod charts;
mod ompl;
mod places;
mod ratios;
mod report;
mod sheets;

pub use by_source::Summary;
pub use ompl::ompl_logs;
pub use report::report;
pub use sheets::parameter_section;

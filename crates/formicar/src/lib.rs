//! Path planning for car-like robots on occupancy grids, with a certificate for every path.
//!
//! A robot with a steering axle cannot turn on the spot, and its body scrapes corners. Given an
//! occupancy grid, a [`Vehicle`] and two poses, formicar returns a path that the vehicle can drive,
//! proven by a [`Certificate`], or a named reason why there is none.
//!
//! ```
//! use formicar::{OccupancyGrid, PlannerConfig, Pose2, Scenario, Seed, Vehicle};
//!
//! let map = OccupancyGrid::from_rows(&["...................."; 12], 0.5)?;
//! let (start, goal) = (Pose2::new(2.0, 1.5, 0.0), Pose2::new(7.0, 4.0, 1.57));
//! let scenario = Scenario::new(&map, Vehicle::warehouse_amr(), start, goal)?;
//! let plan = formicar::plan(&scenario, &PlannerConfig::default(), Seed(7), &mut ())?.found()?;
//! assert!(plan.certificate.min_clearance_m > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Planner`] answers many requests on one map, a [`Request`] says more than two poses, and a
//! [`StdClock`] or a [`CancelToken`] ends a query early.
//!
//! SI units and radians inside; a pose is the center of the rear axle, x forward, y left, heading
//! counter-clockwise. The same map, vehicle, request, configuration and seed give the same path.
//!
//! # Stability
//!
//! The names at the root and the modules [`geometry`], [`vehicle`], [`map`], [`path`],
//! [`scenario`], [`validation`], [`metrics`], [`progress`] and [`planner`] change only in a major
//! release (before 1.0: in a minor one, with a line in the changelog). The modules [`parameters`],
//! [`numeric`], [`collision`], [`motion`], [`layers`], [`objective`], [`smoothing`], [`search`], [`colony`],
//! [`evolution`], [`tracking`], [`tuning`] and [`render`] are open for study and for planners of
//! your own; they may change in any minor release.
//!
//! Types that a caller only reads are `#[non_exhaustive]`. Configurations and [`Request`] have
//! public fields and gain some over time: end a literal with `..Default::default()`.
//!
//! # Modules
//!
//! Modules are ranked, and each uses only those before it: [`parameters`], [`numeric`],
//! [`geometry`], [`vehicle`], [`map`], [`path`], [`collision`], [`scenario`], [`validation`],
//! [`metrics`], [`motion`], [`progress`], [`layers`], [`objective`], [`smoothing`], [`search`], [`colony`],
//! [`evolution`], [`tracking`], [`planner`], [`tuning`], [`render`].
#![forbid(unsafe_code)]

pub mod collision;
pub mod colony;
pub mod evolution;
pub mod geometry;
pub mod layers;
pub mod map;
pub mod metrics;
pub mod motion;
pub mod numeric;
pub mod objective;
pub mod parameters;
pub mod path;
pub mod planner;
pub mod progress;
pub mod render;
pub mod scenario;
pub mod search;
pub mod smoothing;
pub mod tracking;
pub mod tuning;
pub mod validation;
pub mod vehicle;

pub use geometry::{Point2, Pose2};
pub use map::{MapError, OccupancyGrid};
pub use metrics::PathMetrics;
pub use numeric::Seed;
pub use path::CurvePath;
pub use planner::{NotFound, Outcome, Plan, PlanError, Planner, PlannerConfig, PlannerName, plan};
pub use progress::{CancelToken, Event, Observer, Status, StdClock};
pub use scenario::{GoalTolerance, Request, Scenario, ScenarioError, ViaPoint};
pub use validation::Certificate;
pub use vehicle::{Gears, Vehicle, VehicleError, VehicleParameters};

/// Compiles the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

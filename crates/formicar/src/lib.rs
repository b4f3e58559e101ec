//! Path planning for car-like robots on occupancy grids, with a certificate for every path.
//!
//! A robot with a steering axle cannot turn on the spot, and its body scrapes corners. Given an
//! occupancy grid, a [`vehicle::Vehicle`] and two poses, formicar returns a path that the vehicle
//! can drive, proven by a [`validation::Certificate`], or a named reason why there is none.
//!
//! Modules are ranked, and each uses only those before it: [`parameters`], [`numeric`], [`geometry`], [`vehicle`],
//! [`map`], [`path`], [`collision`], [`scenario`], [`validation`], [`metrics`], [`progress`],
//! [`layers`], [`objective`], [`smoothing`], [`search`], [`colony`], [`evolution`],
//! [`tracking`], [`planner`], [`tuning`], [`render`]. SI units and radians inside; a pose is the center of the rear axle, x forward, y
//! left, heading counter-clockwise.
#![forbid(unsafe_code)]

pub mod collision;
pub mod colony;
pub mod evolution;
pub mod geometry;
pub mod layers;
pub mod map;
pub mod metrics;
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

/// Compiles the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

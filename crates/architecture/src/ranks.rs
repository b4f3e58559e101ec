//! The ranks of modules, lowest first: a module uses only modules that stand before it.

use crate::scan::{Kind, Path};
use crate::source::{Crate, File};
use std::collections::BTreeSet;

/// The library.
pub const LIBRARY: &[&str] = &[
    "parameters",
    "numeric",
    "geometry",
    "vehicle",
    "map",
    "path",
    "collision",
    "scenario",
    "validation",
    "metrics",
    "motion",
    "progress",
    "layers",
    "objective",
    "smoothing",
    "search",
    "colony",
    "evolution",
    "tracking",
    "planner",
    "tuning",
    "render",
];

/// The command line. Commands stand side by side: what two of them share is a module below them.
pub const CLI: &[&str] = &[
    "failure",
    "optional",
    "files",
    "values",
    "bag",
    "output",
    "settings",
    "scene",
    "mode_args",
    "motion_files",
    "path_file",
    "picture",
    "ants",
    "summary",
    "session",
    "lidar",
    "commands",
    "reading",
    "cli",
];

/// The lab.
pub const LAB: &[&str] = &[
    "words",
    "analysis::statistics",
    "report",
    "rival",
    "run",
    "campaign",
    "papers",
    "tuning",
    "analysis",
    "stress",
];

/// Mapping.
pub const MAPPING: &[&str] = &[
    "error",
    "matrix",
    "scan",
    "log",
    "sdf",
    "matching",
    "motion",
    "occupancy",
    "graph",
    "simulate",
    "config",
    "evaluate",
    "front_end",
    "localize",
    "trajectory",
    "loops",
    "refine",
    "mapper",
    "session",
    "report",
];

/// Bags of ROS 2.
pub const RECORD: &[&str] = &[
    "messages",
    "cdr",
    "error",
    "foreign",
    "topic",
    "walk",
    "qos",
    "writer",
    "bag",
    "frames",
    "grid",
    "beams",
    "ride",
    "log",
    "recording",
];

/// Drives in simulation.
pub const DRIVE: &[&str] = &[
    "error",
    "random",
    "limits",
    "solid",
    "world",
    "lidar",
    "agents",
    "contact",
    "simulation",
    "known_map",
    "estimate",
    "route",
    "driver",
    "record",
    "run",
    "picture",
];

/// The studio.
pub const STUDIO: &[&str] = &[
    "options",
    "protocol",
    "outbox",
    "wanted",
    "maps",
    "scene",
    "planner_cache",
    "plan_observer",
    "plan_slot",
    "command_line",
    "state",
    "session",
    "connection",
    "catalog",
    "upload",
    "access",
    "routes",
];

/// The compiled part of the Python package.
pub const PYTHON: &[&str] = &[
    "errors",
    "values",
    "vehicle",
    "cells",
    "grid",
    "lidar_log",
    "mapper",
    "localizer",
    "scenarios",
    "pictures",
    "observe",
    "plan",
    "planner",
    "path",
    "curves",
    "motion",
    "drive",
    "bees",
    "campaign",
];

/// Paths to modules that a module may not use, modules without a rank, and ways around the list.
pub fn rank_faults(source: &Crate, ranks: &[&str]) -> Vec<String> {
    let is_ranked = |name: &str| {
        ranks
            .iter()
            .any(|entry| entry.split("::").next() == Some(name))
    };
    let missing = source
        .top_modules()
        .into_iter()
        .filter(|name| !is_ranked(name));
    let missing = missing.map(|name| format!("module `{name}` has no rank"));
    let files = source.files.iter().filter(|file| !file.module.is_empty());
    let faults = files.flat_map(|file| {
        let paths = file.scan.paths.iter();
        paths.filter_map(|path| fault(ranks, file, path))
    });
    // Each module that a file should not use is named once.
    let faults: BTreeSet<String> = missing.chain(faults).collect();
    faults.into_iter().collect()
}

/// The place of the longest entry that a path goes through.
fn rank(ranks: &[&str], path: &[String]) -> Option<usize> {
    let leads_through = |entry: &str| {
        let n_parts = entry.split("::").count();
        n_parts <= path.len() && entry.split("::").zip(path).all(|(part, name)| part == name)
    };
    let entries = ranks
        .iter()
        .enumerate()
        .filter(|(_, entry)| leads_through(entry));
    entries
        .max_by_key(|(_, entry)| entry.len())
        .map(|(at, _)| at)
}

fn fault(ranks: &[&str], file: &File, path: &Path) -> Option<String> {
    let first_two = path.segments[..path.segments.len().min(2)].join("::");
    let fault = Some(format!("{}: {first_two}", file.name));
    if first_two == "super::super" || path.segments == ["crate"] {
        return fault;
    }
    let root = path.segments[0].as_str();
    if path.kind != Kind::Inline && !["crate", "super", "self"].contains(&root) {
        // Another crate, or a module of the file's own.
        return None;
    }
    let target = file.absolute(path)?;
    let own = rank(ranks, &file.module)?;
    let is_allowed = match rank(ranks, &target) {
        Some(rank) => rank <= own,
        // Seen from a module's tests, `super` leads to items of the module.
        None => root != "crate" || target.first() == file.module.first(),
    };
    if is_allowed { None } else { fault }
}

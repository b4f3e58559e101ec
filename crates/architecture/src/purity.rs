//! The outside world, which a library leaves alone: its inputs are arguments.

use crate::source::{Crate, File};

/// Parts of `std` that reach out of the program.
const OUTSIDE_WORLD: [&str; 5] = ["env", "fs", "net", "process", "thread"];
/// Macros that print.
const PRINTING: [&str; 5] = ["print", "println", "eprint", "eprintln", "dbg"];
/// Types that read a clock.
const CLOCKS: [&str; 2] = ["Instant", "SystemTime"];

/// The parts of a library that may reach out.
#[derive(Clone, Copy, Debug)]
pub struct Purity {
    /// The folder that may use files and the environment.
    pub files: &'static str,
    /// The file that may start threads.
    pub threads: &'static str,
    /// The file that may read a clock.
    pub clock: &'static str,
}

/// Uses of the outside world by files that may not.
pub fn purity_faults(source: &Crate, rules: &Purity) -> Vec<String> {
    source
        .files
        .iter()
        .flat_map(|file| faults_of(file, rules))
        .collect()
}

fn faults_of(file: &File, rules: &Purity) -> Vec<String> {
    let may_touch_files = file.name.starts_with(&format!("{}/", rules.files));
    let is_exempt =
        |part: &str| may_touch_files || (file.name == rules.threads && part == "thread");
    let std_paths = file.scan.paths.iter().map(|path| &path.segments);
    let std_paths = std_paths.filter(|segments| segments[0] == "std");
    let parts = std_paths.filter_map(|segments| segments.get(1));
    let parts = parts.filter(|part| OUTSIDE_WORLD.contains(&part.as_str()) && !is_exempt(part));
    let parts = parts.map(|part| format!("std::{part}"));
    let printing = PRINTING
        .iter()
        .filter(|name| file.scan.macros.contains(**name));
    let printing = printing.map(|name| format!("{name}!"));
    let names = |clock: &&&str| {
        let mut paths = file.scan.paths.iter().map(|path| &path.segments);
        file.scan.words.contains(**clock)
            || paths.any(|path| path.iter().any(|word| word == **clock))
    };
    let clocks = CLOCKS
        .iter()
        .filter(|_| file.name != rules.clock)
        .filter(names);
    let clocks = clocks.map(|clock| (*clock).to_owned());
    let faults = parts.chain(printing).chain(clocks);
    faults
        .map(|fault| format!("{}: {fault}", file.name))
        .collect()
}

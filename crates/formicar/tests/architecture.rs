//! The house rules that the compiler does not know: module ranks, and what the library must not
//! touch.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Lowest rank first: a module may use only modules before it. Names of modules that are yet to
/// come stand here already, so that each finds its place.
const RANKED: [&str; 20] = [
    "numeric",
    "geometry",
    "vehicle",
    "map",
    "path",
    "collision",
    "scenario",
    "validation",
    "metrics",
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

/// The one module that may touch the file system and the environment.
const FILES: &str = "map/format";
/// The one file that may start threads.
const THREADS: &str = "colony/worker_pool.rs";
/// Parts of `std` that only [`FILES`] may use: a pure library gets its inputs as arguments.
const OUTSIDE_WORLD: [&str; 5] = ["env", "fs", "net", "process", "thread"];
/// What no module may do. (Time comes in through `progress::Observer`.)
const FORBIDDEN: [&str; 7] = [
    "print!",
    "println!",
    "eprint!",
    "eprintln!",
    "dbg!",
    "Instant",
    "SystemTime",
];

#[test]
fn modules_use_only_modules_of_lower_rank() {
    report(files().iter().flat_map(rank_faults).collect());
}

#[test]
fn the_library_does_not_touch_the_outside_world() {
    report(files().iter().flat_map(purity_faults).collect());
}

#[test]
fn every_module_has_a_rank() {
    let lib = fs::read_to_string(source_folder().join("lib.rs")).unwrap();
    let declared: Vec<&str> = lib
        .lines()
        .filter_map(|line| line.trim().trim_start_matches("pub ").strip_prefix("mod "))
        .map(|rest| rest.trim_end_matches(';'))
        .collect();
    let strays = declared.iter().filter(|name| rank(name).is_none());
    let unlisted = strays.map(|name| format!("lib.rs: module `{name}` has no rank"));
    let orphans = files().into_iter().filter_map(|file| {
        let known = declared.contains(&file.module()) || file.name == "lib.rs";
        (!known).then(|| format!("{}: its module is not in lib.rs", file.name))
    });
    assert!(declared.len() > 10, "lib.rs was not understood");
    report(unlisted.chain(orphans).collect());
}

#[test]
fn every_file_of_tests_is_a_module_of_its_binary() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut faults = Vec::new();
    for entry in fs::read_dir(crates).unwrap() {
        let tests = entry.unwrap().path().join("tests");
        let Ok(main) = fs::read_to_string(tests.join("main.rs")) else {
            continue;
        };
        for file in fs::read_dir(&tests).unwrap() {
            let file = file.unwrap().path();
            let module = format!("mod {};", file.file_stem().unwrap().display());
            let is_suite =
                file.extension().is_some_and(|e| e == "rs") && !file.ends_with("main.rs");
            if is_suite && !main.lines().any(|line| line == module) {
                faults.push(format!("{}: not in main.rs", file.display()));
            }
        }
    }
    report(faults);
}

#[test]
fn the_scanner_finds_what_is_planted() {
    let faults = |name: &str, text: &str| {
        let file = Source::new(name, text);
        rank_faults(&file).len() + purity_faults(&file).len()
    };
    for bad in [
        "use crate::planner::Planner;",
        "use crate::{\n    geometry::Pose2,\n    search::{astar, GoalField},\n};",
        "fn f() { crate::search::astar() }",
        "use crate :: render;",
        "pub use crate::*;",
        "use super::super::search;",
        "mod tests {\n    use super::super::cell;\n}",
        "use crate as home;",
        "use ::std::{collections::BTreeMap, fs};",
        "fn f() { std::env::var(\"HOME\") }",
        "fn f() { println!(\"here\") }",
        "use std::time::{Duration, Instant};",
    ] {
        assert_eq!(faults("map/grid.rs", bad), 1, "{bad}");
    }
    assert_eq!(faults("map.rs", "use super::search::astar;"), 1);
    assert_eq!(faults("map/mod.rs", "use super::{geometry, search};"), 1);
    for good in [
        "use crate::geometry::{Pose2, angle};\nuse crate::map::Cell;",
        "//! Not [`crate::search`].\n/* crate::planner */ pub(crate) fn f<'a>(c: &'a char) {}",
        "const S: &str = \"crate::search, println!, std::fs\"; const Q: char = '\"';",
        "const R: &str = r#\"use \"crate::search\";\"#;",
        "use super::search::astar;",
        "use std::time::Duration;\nuse std::{fmt, io};",
    ] {
        assert_eq!(faults("map/grid.rs", good), 0, "{good}");
    }
    assert_eq!(faults("map/format/files.rs", "use std::fs::File;"), 0);
    assert_eq!(faults(THREADS, "use std::thread;"), 0);
    assert_eq!(faults(THREADS, "use std::fs::File;"), 1);
    assert_eq!(faults("colony/ant.rs", "use std::thread;"), 1);
    assert_eq!(faults("map/formation.rs", "use std::fs::File;"), 1);
}

/// A source file without comments and the contents of literals.
struct Source {
    /// Path below `src`.
    name: String,
    code: String,
}

impl Source {
    fn new(name: &str, text: &str) -> Self {
        Self {
            name: name.to_owned(),
            code: bare(text),
        }
    }

    /// The module under the crate root that it belongs to.
    fn module(&self) -> &str {
        let first = self.name.split('/').next().unwrap_or_default();
        first.trim_end_matches(".rs")
    }

    /// Whether `super` means the crate root here.
    fn is_module_root(&self) -> bool {
        let module = self.module();
        self.name == format!("{module}.rs") || self.name == format!("{module}/mod.rs")
    }
}

fn rank(module: &str) -> Option<usize> {
    RANKED.iter().position(|&name| name == module)
}

fn rank_faults(file: &Source) -> Vec<String> {
    if file.name == "lib.rs" {
        return Vec::new();
    }
    let own = rank(file.module());
    let may_use = |name: &str| rank(name).is_some_and(|rank| own.is_some_and(|own| rank <= own));
    let by_crate = roots(&file.code, "crate")
        .into_iter()
        .filter(|name| !may_use(name))
        .map(|name| format!("{}: crate::{name}", file.name));
    // A name that is no module is something of the module's own, seen from its `mod tests`.
    let by_super = roots(&file.code, "super").into_iter().filter(|name| {
        let leaves = file.is_module_root() && rank(name).is_some() && !may_use(name);
        name == "super" || leaves
    });
    let by_super = by_super.map(|name| format!("{}: super::{name}", file.name));
    by_crate.chain(by_super).collect()
}

fn purity_faults(file: &Source) -> Vec<String> {
    let may_touch_files = file.name.starts_with(&format!("{FILES}/"));
    let is_exempt = |name: &str| may_touch_files || (file.name == THREADS && name == "thread");
    let std_use = roots(&file.code, "std")
        .into_iter()
        .filter(|name| !is_exempt(name) && OUTSIDE_WORLD.contains(&name.as_str()))
        .map(|name| format!("{}: std::{name}", file.name));
    let stands_in = |word: &str| {
        let mut places = words(&file.code, word.trim_end_matches('!'));
        places.any(|at| file.code[at.start..].starts_with(word))
    };
    let words = FORBIDDEN
        .iter()
        .filter(|word| stands_in(word))
        .map(|word| format!("{}: {word}", file.name));
    std_use.chain(words).collect()
}

/// The names that follow a path root directly: of `crate::{a::b, c}` they are `a` and `c`.
/// A root without a path, as in `use crate as x`, gives itself.
fn roots(code: &str, root: &str) -> Vec<String> {
    let mut names = Vec::new();
    for at in words(code, root) {
        let after = code[at.end..].trim_start();
        match after.strip_prefix("::").map(str::trim_start) {
            Some(tree) if tree.starts_with('{') => names.extend(branches(tree)),
            Some(path) => names.push(first_name(path)),
            // As in `pub(crate)`.
            None if after.starts_with(')') => {}
            None => names.push(root.to_owned()),
        }
    }
    names
}

/// The first names of a braced group's elements.
fn branches(tree: &str) -> Vec<String> {
    let (mut depth, mut from) = (0, 1);
    let mut names = Vec::new();
    for (i, c) in tree.char_indices() {
        depth += match c {
            '{' => 1,
            '}' => -1,
            _ => 0,
        };
        if (c == ',' && depth == 1) || depth == 0 {
            names.push(first_name(tree[from..i].trim_start()));
            from = i + 1;
        }
        if depth == 0 {
            break;
        }
    }
    names.retain(|name| !name.is_empty());
    names
}

fn first_name(path: &str) -> String {
    let end = path.find(|c: char| !is_word(c)).unwrap_or(path.len());
    match &path[..end] {
        "" => path.chars().take(1).filter(|&c| c == '*').collect(),
        name => name.to_owned(),
    }
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Where a word stands by itself.
fn words<'a>(code: &'a str, word: &'a str) -> impl Iterator<Item = Range<usize>> + 'a {
    code.match_indices(word)
        .map(|(at, word)| at..at + word.len())
        .filter(|at| {
            let joined = code[..at.start].ends_with(is_word) || code[at.end..].starts_with(is_word);
            !joined
        })
}

/// Rust code with comments and the contents of literals left out.
fn bare(text: &str) -> String {
    let mut code = String::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let skipped = ignored_length(rest);
        if skipped > 0 {
            code.push(' ');
            rest = &rest[skipped..];
        } else {
            code.push(c);
            rest = &rest[c.len_utf8()..];
        }
    }
    code
}

/// Length of the comment or literal that begins here; 0 where none does.
fn ignored_length(rest: &str) -> usize {
    let through = |end: &str, from: usize| {
        rest[from..]
            .find(end)
            .map_or(rest.len(), |i| from + i + end.len())
    };
    if rest.starts_with("//") {
        return rest.find('\n').unwrap_or(rest.len());
    }
    if rest.starts_with("/*") {
        return through("*/", 2);
    }
    if let Some(hashed) = rest.strip_prefix('r') {
        let n_hashes = hashed.chars().take_while(|&c| c == '#').count();
        if hashed[n_hashes..].starts_with('"') {
            return through(&format!("\"{}", "#".repeat(n_hashes)), n_hashes + 2);
        }
    }
    match rest.chars().next() {
        Some('"') => quoted(rest, '"'),
        // A lifetime has no second quote.
        Some('\'') if rest[1..].starts_with('\\') || rest.chars().nth(2) == Some('\'') => {
            quoted(rest, '\'')
        }
        _ => 0,
    }
}

fn quoted(rest: &str, quote: char) -> usize {
    let mut escaped = false;
    for (i, c) in rest.char_indices().skip(1) {
        if c == quote && !escaped {
            return i + 1;
        }
        escaped = c == '\\' && !escaped;
    }
    rest.len()
}

fn source_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn files() -> Vec<Source> {
    let root = source_folder();
    let mut folders = vec![root.clone()];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let below = path.strip_prefix(&root).unwrap();
                let name: Vec<_> = below.iter().map(|part| part.to_string_lossy()).collect();
                files.push(Source::new(
                    &name.join("/"),
                    &fs::read_to_string(&path).unwrap(),
                ));
            }
        }
    }
    files
}

fn report(mut faults: Vec<String>) {
    faults.sort();
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        faults.join("\n")
    );
}

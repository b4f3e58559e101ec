//! A crate as files, and the files that its paths lead to.

use crate::scan::{Kind, Path, Scan};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path as FilePath;

/// A source file.
#[derive(Debug)]
pub struct File {
    /// Path below `src`.
    pub name: String,
    /// The module that it holds, from the crate's root; empty for the root.
    pub module: Vec<String>,
    pub(crate) scan: Scan,
}

impl File {
    /// The path from the crate's root, as written; none for a path into another crate.
    pub(crate) fn absolute(&self, path: &Path) -> Option<Vec<String>> {
        let own = self.module.iter().chain(&path.inside);
        let mut base: Vec<String> = own.cloned().collect();
        let mut rest = &path.segments[..];
        match rest.first().map(String::as_str) {
            Some("crate") => {
                base.clear();
                rest = &rest[1..];
            }
            Some("self") => rest = &rest[1..],
            Some("super") => {
                while rest.first().is_some_and(|first| first == "super") {
                    base.pop();
                    rest = &rest[1..];
                }
            }
            Some(first) => {
                base.clone_from(&self.module);
                let is_child = self.scan.children.iter().any(|(name, _)| name == first);
                if !is_child {
                    let import = imports(self).find(|(name, _)| *name == first)?;
                    if import.1.segments.first().is_some_and(|root| root == first) {
                        return None;
                    }
                    let mut target = self.absolute(import.1)?;
                    target.extend_from_slice(&rest[1..]);
                    return Some(target);
                }
            }
            None => {}
        }
        base.extend_from_slice(rest);
        Some(base)
    }
}

/// The source files of a crate.
#[derive(Debug)]
pub struct Crate {
    /// The files, by name.
    pub files: Vec<File>,
    by_module: BTreeMap<Vec<String>, usize>,
}

impl Crate {
    /// Reads the crate of this workspace that lies in a folder of this name.
    ///
    /// # Panics
    /// On a folder that cannot be read, or a file that is no Rust.
    pub fn read(folder: &str) -> Self {
        let crates = FilePath::new(env!("CARGO_MANIFEST_DIR")).parent();
        let root = crates
            .expect("crates lie in a folder")
            .join(folder)
            .join("src");
        let mut folders = vec![root.clone()];
        let mut files = Vec::new();
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).expect("the folder can be read") {
                let path = entry.expect("the folder can be read").path();
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|extension| extension == "rs") {
                    let below = path
                        .strip_prefix(&root)
                        .expect("the file lies below the root");
                    let name: Vec<_> = below.iter().map(|part| part.to_string_lossy()).collect();
                    let text = fs::read_to_string(&path).expect("the file can be read");
                    files.push((name.join("/"), text));
                }
            }
        }
        Self::of(
            files
                .iter()
                .map(|(name, text)| (name.as_str(), text.as_str())),
        )
    }

    /// A crate of file names and texts.
    ///
    /// # Panics
    /// On a text that is no Rust.
    pub fn of<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let file = |(name, text): (&str, &str)| File {
            name: name.to_owned(),
            module: module_of(name),
            scan: Scan::of(text),
        };
        let mut files: Vec<File> = files.into_iter().map(file).collect();
        files.sort_by(|a, b| a.name.cmp(&b.name));
        // Of two roots, that of the library, which comes first by name, holds the modules.
        let by_module = files.iter().enumerate().rev();
        let by_module = by_module
            .map(|(i, file)| (file.module.clone(), i))
            .collect();
        Self { files, by_module }
    }

    /// The modules that the root declares.
    ///
    /// # Panics
    /// Without a root.
    pub fn top_modules(&self) -> Vec<&str> {
        let root = &self.files[self.by_module[&Vec::new()]];
        let children = root.scan.children.iter();
        children.map(|(name, _)| name.as_str()).collect()
    }

    /// The file that defines what a path from the root leads to; none where the path names a
    /// module itself or leads to another crate.
    pub(crate) fn definition(&self, path: &[String]) -> Option<usize> {
        self.definition_within(path, 0)
    }

    fn definition_within(&self, path: &[String], depth: usize) -> Option<usize> {
        const DEEPEST: usize = 16;
        let n_module = (0..=path.len())
            .rev()
            .find(|&n| self.by_module.contains_key(&path[..n]))?;
        let at = self.by_module[&path[..n_module]];
        let file = &self.files[at];
        let name = path.get(n_module)?;
        if depth > DEEPEST || name == "*" || file.scan.items.contains(name) {
            return Some(at);
        }
        let mut imports = imports(file);
        if let Some((_, import)) = imports.find(|(alias, _)| alias == name) {
            let mut target = file.absolute(import)?;
            target.extend_from_slice(&path[n_module + 1..]);
            return if target == path {
                Some(at)
            } else {
                self.definition_within(&target, depth + 1)
            };
        }
        let globs = file.scan.paths.iter().filter(|path| is_glob(path));
        for glob in globs {
            let mut target = file.absolute(glob)?;
            target.pop();
            let known = self.by_module.get(&target).map(|&i| &self.files[i]);
            if known.is_some_and(|known| known.scan.items.contains(name)) {
                return self.by_module.get(&target).copied();
            }
        }
        Some(at)
    }

    /// The other files that a file uses outside of its tests, each once.
    pub(crate) fn used_by(&self, at: usize) -> Vec<usize> {
        let file = &self.files[at];
        let paths = file.scan.paths.iter().filter(|path| !path.is_test);
        let paths = paths.filter(|path| match &path.kind {
            // A name that is only handed on is no use.
            Kind::Import { name, is_public } => !is_public || file.scan.words.contains(name),
            Kind::Inline => true,
        });
        let targets = paths.filter_map(|path| self.definition(&file.absolute(path)?));
        let mut targets: Vec<usize> = targets.filter(|&target| target != at).collect();
        targets.sort_unstable();
        targets.dedup();
        targets
    }

    /// Whether a file holds tests only.
    pub(crate) fn is_test(&self, at: usize) -> bool {
        let module = &self.files[at].module;
        (0..module.len()).any(|n| {
            let parent = self.by_module.get(&module[..n]).map(|&i| &self.files[i]);
            let children = parent.into_iter().flat_map(|parent| &parent.scan.children);
            let mut children = children.filter(|(name, _)| *name == module[n]);
            children.any(|(_, is_test)| *is_test)
        })
    }
}

/// The names that a file imports at its top.
fn imports(file: &File) -> impl Iterator<Item = (&str, &Path)> {
    file.scan.paths.iter().filter_map(|path| match &path.kind {
        Kind::Import { name, .. } if path.inside.is_empty() && name != "*" => {
            Some((name.as_str(), path))
        }
        _ => None,
    })
}

fn is_glob(path: &Path) -> bool {
    path.segments.last().is_some_and(|last| last == "*")
}

/// The module of a file below `src`.
fn module_of(name: &str) -> Vec<String> {
    let mut parts: Vec<String> = name
        .trim_end_matches(".rs")
        .split('/')
        .map(str::to_owned)
        .collect();
    let is_folder = parts.last().is_some_and(|last| last == "mod");
    let is_root = name == "lib.rs" || name == "main.rs";
    if is_folder || is_root {
        parts.pop();
    }
    parts
}

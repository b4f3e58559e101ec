//! Output: files, checked before planning and written in one piece, and JSON on stdout.

use crate::files;
use anyhow::{Context, Result, bail};
use serde::Serialize;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// An output file, and the kind of content that goes into it.
#[derive(Clone, Debug)]
pub(crate) struct Target<Kind> {
    path: PathBuf,
    pub(crate) kind: Kind,
}

impl<Kind: Copy> Target<Kind> {
    /// A target whose extension is one of `kinds` and whose folder takes files.
    pub(crate) fn new(path: &Path, kinds: &[(&str, Kind)]) -> Result<Self> {
        let extension = path
            .extension()
            .and_then(|e| e.to_str())
            .unwrap_or_default();
        let kind = kinds
            .iter()
            .find(|(known, _)| extension.eq_ignore_ascii_case(known));
        let Some(&(_, kind)) = kind else {
            let known: Vec<_> = kinds.iter().map(|(known, _)| format!(".{known}")).collect();
            bail!(
                "{}: unknown extension; the name must end in {}",
                path.display(),
                known.join(" or ")
            );
        };
        check_writable(path).with_context(|| format!("{} cannot be written", path.display()))?;
        Ok(Self {
            path: path.to_owned(),
            kind,
        })
    }

    /// A target where a file is named.
    pub(crate) fn of(path: Option<&Path>, kinds: &[(&str, Kind)]) -> Result<Option<Self>> {
        path.map(|path| Self::new(path, kinds)).transpose()
    }

    /// Writes the whole file, or nothing.
    pub(crate) fn write(&self, bytes: &[u8]) -> Result<()> {
        files::write(&self.path, bytes)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }
}

/// Prints a document as JSON on a line.
pub(crate) fn print_json(out: &mut impl Write, document: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer(&mut *out, document)?;
    writeln!(out)
}

/// Checks that a file can be written, by writing an empty one beside it.
fn check_writable(path: &Path) -> Result<()> {
    if fs::metadata(path).is_ok_and(|found| !found.is_file()) {
        bail!("it exists and is no regular file; hint: give another name");
    }
    let folder = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        bail!(
            "the folder {} does not exist; hint: create it first",
            folder.display()
        );
    }
    let probe = folder.join(format!(".formicar-probe-{}", std::process::id()));
    if let Err(error) = fs::write(&probe, b"") {
        bail!("{error}; hint: name a folder that is writable");
    }
    fs::remove_file(&probe).context("the file cannot be removed again")
}

//! Input text of bounded size, from files and from stdin.

use anyhow::{Context, Result, bail};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The largest text file that is read, bytes.
const MAX_TEXT: u64 = 1 << 28;

/// The text of a file.
pub(crate) fn read_text(path: &Path) -> Result<String> {
    let read = || bounded(File::open(path)?);
    read().with_context(|| format!("{} cannot be read", path.display()))
}

/// The text of a file, or of stdin where its name is `-`.
pub(crate) fn read_document(path: &Path) -> Result<String> {
    if path == Path::new("-") {
        return bounded(std::io::stdin().lock()).context("stdin cannot be read");
    }
    read_text(path)
}

fn bounded(source: impl Read) -> Result<String> {
    let mut text = String::new();
    let n_bytes = source.take(MAX_TEXT + 1).read_to_string(&mut text)?;
    if n_bytes as u64 > MAX_TEXT {
        bail!("more than {MAX_TEXT} bytes");
    }
    Ok(text)
}

//! Input text of bounded size, from files and from stdin; files and folders for results.

use anyhow::{Context, Result, bail};
use formicar::map::format::write_atomically;
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

/// The bytes of a file of at most 1 GiB.
#[cfg(feature = "mapping")]
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>> {
    const MAX_BYTES: u64 = 1 << 30;
    let read = || -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let n_bytes = File::open(path)?
            .take(MAX_BYTES + 1)
            .read_to_end(&mut bytes)?;
        if n_bytes as u64 > MAX_BYTES {
            bail!("more than {MAX_BYTES} bytes");
        }
        Ok(bytes)
    };
    read().with_context(|| format!("{} cannot be read", path.display()))
}

/// The text of a file, or of stdin where its name is `-`.
pub(crate) fn read_document(path: &Path) -> Result<String> {
    if path == Path::new("-") {
        return bounded(std::io::stdin().lock()).context("stdin cannot be read");
    }
    read_text(path)
}

/// Writes a whole file, or nothing.
pub(crate) fn write(path: &Path, bytes: impl AsRef<[u8]>) -> Result<()> {
    write_atomically(path, bytes.as_ref())
        .with_context(|| format!("{} cannot be written", path.display()))
}

/// Makes a folder that does not exist yet.
#[cfg(any(feature = "lab", feature = "mapping"))]
pub(crate) fn make_folder(path: &Path) -> Result<()> {
    std::fs::create_dir_all(path).with_context(|| format!("{} cannot be made", path.display()))
}

fn bounded(source: impl Read) -> Result<String> {
    let mut text = String::new();
    let n_bytes = source.take(MAX_TEXT + 1).read_to_string(&mut text)?;
    if n_bytes as u64 > MAX_TEXT {
        bail!("more than {MAX_TEXT} bytes");
    }
    Ok(text)
}

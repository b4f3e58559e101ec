//! Whole files in, whole files out.

use super::{FormatError, FormatProblem};
use std::fs::{self, File, OpenOptions};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Longest map file that is read: a plain PGM of the largest map.
pub(super) const MAX_MAP_BYTES: u64 = 1 << 30;
/// Longest description that is read: YAML, or JSON scenarios.
pub(super) const MAX_TEXT_BYTES: u64 = 64 << 20;

/// The bytes of a file of at most `limit` bytes.
pub(super) fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, FormatError> {
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(limit + 1).read_to_end(&mut bytes))
        .map_err(|e| FormatError::from(FormatProblem::Read(e)).in_file(path))?;
    if bytes.len() as u64 > limit {
        return Err(FormatError::from(FormatProblem::TooLong { limit }).in_file(path));
    }
    Ok(bytes)
}

/// The text of a file's bytes, without a byte order mark.
pub(super) fn text<'a>(bytes: &'a [u8], expected: &'static str) -> Result<&'a str, FormatError> {
    let text = std::str::from_utf8(bytes)
        .map_err(|e| FormatProblem::NotText { expected }.at(super::Place::Byte(e.valid_up_to())))?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        return Err(FormatProblem::Empty { expected }.into());
    }
    Ok(text)
}

/// Writes a file so that a reader sees either the old contents or all of the new ones.
///
/// The bytes go to a temporary file in the same folder, which then takes the name.
///
/// # Errors
/// The file cannot be written; nothing of it is left behind then.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), FormatError> {
    Staged::write(path, bytes)?.publish()
}

/// A complete file under a temporary name; removed again unless it is published.
pub(super) struct Staged {
    temporary: PathBuf,
    path: PathBuf,
}

impl Staged {
    pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<Self, FormatError> {
        let failed = |e| FormatError::from(FormatProblem::Write(e)).in_file(path);
        let temporary = path.with_file_name(temporary_name(path).map_err(failed)?);
        let mut file = OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(&temporary)
            .map_err(failed)?;
        let staged = Self {
            temporary,
            path: path.to_path_buf(),
        };
        file.write_all(bytes).map_err(failed)?;
        Ok(staged)
    }

    pub(super) fn publish(self) -> Result<(), FormatError> {
        fs::rename(&self.temporary, &self.path)
            .map_err(|e| FormatError::from(FormatProblem::Write(e)).in_file(&self.path))
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        // After publishing the temporary name is gone, and there is nothing to remove.
        let _ = fs::remove_file(&self.temporary);
    }
}

fn temporary_name(path: &Path) -> std::io::Result<std::ffi::OsString> {
    static COUNTER: AtomicU64 = AtomicU64::new(0);
    let Some(name) = path.file_name() else {
        let kind = std::io::ErrorKind::InvalidInput;
        return Err(std::io::Error::new(kind, "the path names no file"));
    };
    let number = COUNTER.fetch_add(1, Ordering::Relaxed);
    let mut temporary = std::ffi::OsString::from(".");
    temporary.push(name);
    temporary.push(format!(".{}-{number}.tmp", std::process::id()));
    Ok(temporary)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_nothing_behind_when_the_name_is_taken_by_a_folder() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("taken");
        fs::create_dir(&path).unwrap();
        let error = write_atomically(&path, b"x").unwrap_err();
        assert!(matches!(error.problem(), FormatProblem::Write(_)));
        assert!(error.to_string().contains("taken"), "{error}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        assert!(write_atomically(&folder.path().join("no/such/folder"), b"").is_err());
        assert!(write_atomically(Path::new("/"), b"").is_err());
    }

    #[test]
    fn replaces_the_whole_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("map");
        write_atomically(&path, b"a long first text").unwrap();
        write_atomically(&path, b"short").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"short");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn refuses_files_past_the_limit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("long");
        fs::write(&path, [0; 11]).unwrap();
        assert_eq!(read_bytes(&path, 11).unwrap().len(), 11);
        let error = read_bytes(&path, 10).unwrap_err();
        assert!(matches!(
            error.problem(),
            FormatProblem::TooLong { limit: 10 }
        ));
    }
}

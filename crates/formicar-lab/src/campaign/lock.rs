//! One writer to a store at a time.

use anyhow::{Context, Result, bail};
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

/// Marks this process as the only writer; it ends with the process, however that ends.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    _file: File,
}

impl Drop for Lock {
    fn drop(&mut self) {
        // What is left of a lock file holds nobody up.
        let _ = std::fs::remove_file(&self.path);
    }
}

impl Lock {
    /// The lock of a store; refused where another process has it.
    pub(super) fn of(path: &Path) -> Result<Self> {
        let mut name = path.as_os_str().to_owned();
        name.push(".lock");
        let name = PathBuf::from(name);
        let told = || format!("{} cannot be written", name.display());
        let file = File::create(&name).with_context(told)?;
        match file.try_lock() {
            Ok(()) => Ok(Self {
                path: name,
                _file: file,
            }),
            Err(TryLockError::WouldBlock) => bail!(
                "{}: another process writes to it; hint: wait for it, or take another --store",
                path.display()
            ),
            Err(TryLockError::Error(error)) => Err(error).context(name.display().to_string()),
        }
    }
}

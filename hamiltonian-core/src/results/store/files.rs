//! Files that are written atomically.
//!
//! A file is written under a temporary name and then renamed. Files that killed processes left unfinished stay in the
//! directory `status/parts`, which readers of Zarr ignore, until the store is complete.

use crate::errors::Error;
use crate::errors::StoreError;
use std::collections::hash_map::RandomState;
use std::fs::{self, File};
use std::hash::{BuildHasher, Hasher};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Names of temporary files, different in every process on every machine.
#[derive(Debug)]
pub(super) struct TemporaryFiles {
    directory: PathBuf,
    /// A random number. Process identifiers would be unique only on one machine.
    process: u64,
    next: AtomicU64,
}

impl TemporaryFiles {
    #[inline]
    pub(super) fn of(root: &Path) -> Self {
        TemporaryFiles {
            directory: root.join(super::layout::STATUS).join("parts"),
            process: RandomState::new().build_hasher().finish(),
            next: AtomicU64::new(0),
        }
    }

    /// Returns a path that no other process uses.
    #[inline]
    pub(super) fn new_path(&self) -> io::Result<PathBuf> {
        fs::create_dir_all(&self.directory)?;
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        let name = format!("{:016x}-{number}", self.process);
        Ok(self.directory.join(name))
    }

    /// Removes the files that killed processes left.
    #[inline]
    pub(super) fn remove(&self) {
        // The directory may not exist, or another process may be removing it.
        let _ = fs::remove_dir_all(&self.directory);
    }

    /// Writes a file. Afterwards, `path` has all bytes or is unchanged.
    #[inline]
    pub(super) fn write(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let temporary = self.new_path()?;
        let written = write_new(&temporary, bytes).and_then(|()| {
            if let Some(directory) = path.parent() {
                fs::create_dir_all(directory)?;
            }
            fs::rename(&temporary, path)
        });
        if written.is_err() {
            // The temporary file would only take space.
            let _ = fs::remove_file(&temporary);
        }
        written
    }
}

/// Writes a file and waits until it is on the disk.
#[inline]
pub(super) fn write_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Returns the error for a file of the store `root`.
#[inline]
pub(super) fn failed(root: &Path, path: &Path, error: &io::Error) -> Error {
    let full = [ErrorKind::StorageFull, ErrorKind::QuotaExceeded];
    match full.contains(&error.kind()) {
        true => StoreError::Full {
            path: root.display().to_string().into(),
        },
        false => StoreError::File {
            path: path.display().to_string().into(),
            message: error.to_string().into(),
        },
    }
    .into()
}

/// Reads a file; `None` if it does not exist.
#[inline]
pub(super) fn read(root: &Path, path: &Path) -> Result<Option<Vec<u8>>, Error> {
    match fs::read(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(failed(root, path, &error)),
    }
}

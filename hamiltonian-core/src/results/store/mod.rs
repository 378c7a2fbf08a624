//! Results of a sweep on disk, as Zarr v3.
//!
//! Input: chunks of members. Output: a directory that zarr-python and xarray open. Invariants: a chunk
//! is present with all its columns or not at all; a chunk that is present is never written again; the bytes
//! of a complete store depend only on its layout and its chunks.
//!
//! # Order of writing
//! A chunk has one file per array. Each file appears by a rename, the one of `status` last. A chunk is present if its
//! file of `status` is. A killed process may leave files of a chunk that is not present; the process that writes this
//! chunk later writes the same bytes.

mod files;
mod json;
mod layout;

pub use layout::{Attribute, Layout, Rows};

use crate::errors::{Error, StoreError};
use crate::results::checkpoint::differing;
use core::fmt;
use core::ops::Range;
use files::{TemporaryFiles, failed};
use layout::{COUNT, HASHES, Kind, MEMBER, ROWS, STATUS, STEPS, TIME, ZarrArray};
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// A directory of results, written chunk by chunk.
///
/// Several processes may write to one store without coordination, each its own chunks. Threads may share a `Store`.
///
/// ```
/// use hamiltonian::results::{ChunkData, Layout, Store};
/// use hamiltonian::prelude::*;
///
/// fn main() -> Result<(), Error> {
///     let path = std::env::temp_dir().join("example.zarr");
///     let layout = Layout {
///         chunk: 2,
///         attributes: vec![("step".to_string(), 0.01.into())],
///         ..Layout::new(3, ["theta"])
///     };
///     let store = Store::open_or_create(&path, &layout)?;
///     for chunk in 0..layout.chunks() {
///         if store.present(chunk)? {
///             continue;
///         }
///         let members = layout.members_of(chunk);
///         let theta: Vec<f64> = members.map(|member| 0.5 * member as f64).collect();
///         let count = theta.len();
///         store.write(chunk, &ChunkData {
///             columns: vec![theta],
///             status: vec![1; count],
///             time: vec![10.0; count],
///             steps: vec![1000; count],
///             ..ChunkData::default()
///         })?;
///     }
///     assert!(store.completeness()?.is_complete());
///     let last = store.read(1)?.expect("it was written");
///     assert_eq!(last.columns, [[1.0]]);
///     std::fs::remove_dir_all(path)?;
///     Ok(())
/// }
/// ```
#[derive(Debug)]
pub struct Store {
    root: PathBuf,
    layout: Layout,
    arrays: Vec<ZarrArray>,
    temporary: TemporaryFiles,
}

/// The results of the members of one chunk.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChunkData {
    /// The values of each column: one per member for [`Rows::One`], one per member and value for [`Rows::At`] (member
    /// after member), one per row for [`Rows::Any`]. NaN is a missing value.
    pub columns: Vec<Vec<f64>>,
    /// The member of each row for [`Rows::Any`], with rows in the order of their members; otherwise empty.
    pub member: Vec<u64>,
    /// The status of each member: 0 (missing), 1 (ended), 2 (stopped by an event) or a failure from 3.
    pub status: Vec<u8>,
    /// The time at the end of each member.
    pub time: Vec<f64>,
    /// The number of steps of each member.
    pub steps: Vec<u64>,
    /// A hash of the parameters and the start of the first member, and a hash of all members.
    pub hashes: [u64; 2],
}

impl Store {
    /// Opens the store at `path`, or creates it with its directories.
    ///
    /// # Errors
    /// [`StoreError::Layout`] for an invalid layout, [`StoreError::Other`] for a store with another layout or other
    /// attributes, [`StoreError::Foreign`] for a directory that is not a store, [`StoreError::Full`] and
    /// [`StoreError::File`].
    pub fn open_or_create(path: impl AsRef<Path>, layout: &Layout) -> Result<Self, Error> {
        let store = Self::at(path.as_ref(), layout)?;
        if store.exists()? {
            return Ok(store);
        }
        // The metadata of the group are written last, so that a store always has those of all arrays.
        for (path, metadata) in store.metadata() {
            store.write_file(&path, metadata.as_bytes())?;
        }
        if let Rows::At { name, values } = &layout.rows {
            let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
            store.write_file(&store.root.join(name).join("c/0"), &bytes)?;
        }
        store.write_file(&store.top(), layout.group().to_string().as_bytes())?;
        Ok(store)
    }

    /// Opens the store at `path`; `None` if it does not exist or is being created.
    ///
    /// # Errors
    /// Those of [`open_or_create`](Store::open_or_create).
    pub fn open(path: impl AsRef<Path>, layout: &Layout) -> Result<Option<Self>, Error> {
        let store = Self::at(path.as_ref(), layout)?;
        Ok(store.exists()?.then_some(store))
    }

    /// Returns the store of a layout at a path, at which it may not exist yet.
    #[inline]
    fn at(root: &Path, layout: &Layout) -> Result<Self, Error> {
        layout.check()?;
        Ok(Store {
            arrays: layout.arrays(),
            layout: layout.clone(),
            temporary: TemporaryFiles::of(root),
            root: root.to_path_buf(),
        })
    }

    /// Returns the path of the metadata of the group.
    #[inline]
    fn top(&self) -> PathBuf {
        self.root.join("zarr.json")
    }

    /// Returns true if the store exists. A store with another layout and a directory that is not a store are errors.
    #[inline]
    fn exists(&self) -> Result<bool, Error> {
        let top = self.top();
        let Some(saved) = files::read(&self.root, &top)? else {
            self.refuse_foreign()?;
            return Ok(false);
        };
        self.check_same(&top, &saved, &self.layout.group().to_string())?;
        for (path, metadata) in self.metadata() {
            let saved = files::read(&self.root, &path)?.unwrap_or_default();
            self.check_same(&path, &saved, &metadata)?;
        }
        Ok(true)
    }

    /// The layout.
    #[inline]
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Returns true if a chunk has been written.
    ///
    /// # Errors
    /// [`StoreError::File`].
    #[inline]
    pub fn present(&self, chunk: u64) -> Result<bool, Error> {
        let marker = self.chunk_path(STATUS, chunk);
        (marker.try_exists()).map_err(|error| failed(&self.root, &marker, &error))
    }

    /// Writes a chunk, unless it is present.
    ///
    /// # Errors
    /// [`StoreError::NoChunk`] for a number beyond the last chunk, [`StoreError::Shape`] for data that does not fit the
    /// layout, [`StoreError::Full`], [`StoreError::File`].
    #[inline]
    pub fn write(&self, chunk: u64, data: &ChunkData) -> Result<(), Error> {
        self.check_shape(chunk, data)?;
        if self.present(chunk)? {
            return Ok(());
        }
        let written = self.write_files(chunk, data);
        // Another process may have completed the store meanwhile, and removed the temporary files of this one.
        match written.is_err() && self.present(chunk)? {
            true => Ok(()),
            false => written,
        }
    }

    #[inline]
    fn write_files(&self, chunk: u64, data: &ChunkData) -> Result<(), Error> {
        if self.layout.rows == Rows::Any {
            self.write_rows(chunk, data)?;
        }
        for array in &self.arrays {
            let bytes = match (array.name.as_str(), array.kind) {
                (STATUS, _) => data.status.clone(),
                (TIME, _) => bytes_of(&data.time, f64::to_le_bytes),
                (STEPS, _) => bytes_of(&data.steps, u64::to_le_bytes),
                (HASHES, _) => bytes_of(&data.hashes, u64::to_le_bytes),
                (COUNT, Kind::U64) => bytes_of(&self.counts(chunk, data), u64::to_le_bytes),
                (name, _) => {
                    let of = self.layout.columns.iter().position(|column| column == name);
                    // The coordinate of `Rows::At` is not part of a chunk.
                    let Some(column) = of.and_then(|at| data.columns.get(at)) else {
                        continue;
                    };
                    bytes_of(column, f64::to_le_bytes)
                }
            };
            self.write_file(&self.chunk_path(&array.name, chunk), &padded(bytes, array))?;
        }
        Ok(())
    }

    /// Returns the number of rows of each member.
    #[inline]
    fn counts(&self, chunk: u64, data: &ChunkData) -> Vec<u64> {
        let members = self.layout.members_of(chunk);
        let mut counts = vec![0; data.status.len()];
        for member in &data.member {
            counts[(member - members.start) as usize] += 1;
        }
        counts
    }

    /// Writes the group of a chunk's rows, a directory that appears by one rename.
    #[inline]
    fn write_rows(&self, chunk: u64, data: &ChunkData) -> Result<(), Error> {
        let path = self.root.join(ROWS).join(chunk.to_string());
        let write = || -> io::Result<()> {
            let temporary = self.temporary.new_path()?;
            fs::create_dir(&temporary)?;
            let arrays = self.layout.rows_arrays(data.member.len() as u64);
            let group = layout::consolidated(json::Json::Object(Vec::new()), &arrays).to_string();
            files::write_new(&temporary.join("zarr.json"), group.as_bytes())?;
            let columns = data.columns.iter().map(|c| bytes_of(c, f64::to_le_bytes));
            let members = bytes_of(&data.member, u64::to_le_bytes);
            for (array, bytes) in arrays.iter().zip(core::iter::once(members).chain(columns)) {
                let directory = temporary.join(&array.name);
                fs::create_dir_all(directory.join("c"))?;
                let metadata = array.metadata().to_string();
                files::write_new(&directory.join("zarr.json"), metadata.as_bytes())?;
                if !bytes.is_empty() {
                    files::write_new(&directory.join("c/0"), &bytes)?;
                }
            }
            // The group exists already if another process was killed after it wrote the group, before the status.
            match fs::rename(&temporary, &path) {
                Err(_) if path.is_dir() => fs::remove_dir_all(&temporary),
                renamed => renamed,
            }
        };
        write().map_err(|error| failed(&self.root, &path, &error))
    }

    /// Reads the data of a chunk; `None` if it is not present.
    ///
    /// # Errors
    /// [`StoreError::Damaged`] for a file of the wrong length, [`StoreError::File`].
    #[inline]
    pub fn read(&self, chunk: u64) -> Result<Option<ChunkData>, Error> {
        if chunk >= self.layout.chunks() || !self.present(chunk)? {
            return Ok(None);
        }
        let members = self.layout.members_of(chunk);
        let members = (members.end - members.start) as usize;
        let bytes = |name: &str, elements: usize| {
            let array = self.arrays.iter().find(|array| array.name == name);
            let (size, all) = array.map_or((8, 0), |array| (array.kind.size(), array.elements()));
            let mut bytes = self.file(&self.chunk_path(name, chunk), size * all)?;
            bytes.truncate(size * elements);
            Ok::<_, Error>(bytes)
        };
        let mut data = ChunkData {
            status: bytes(STATUS, members)?,
            time: floats(&bytes(TIME, members)?),
            steps: integers(&bytes(STEPS, members)?),
            ..ChunkData::default()
        };
        if let [first, all] = integers(&bytes(HASHES, 2)?)[..] {
            data.hashes = [first, all];
        }
        match &self.layout.rows {
            Rows::Any => {
                let rows: u64 = integers(&bytes(COUNT, members)?).iter().sum();
                let directory = self.root.join(ROWS).join(chunk.to_string());
                let array = |name: &str| match rows {
                    0 => Ok(Vec::new()),
                    _ => self.file(&directory.join(name).join("c/0"), 8 * rows as usize),
                };
                data.member = integers(&array(MEMBER)?);
                for name in &self.layout.columns {
                    data.columns.push(floats(&array(name)?));
                }
            }
            rows => {
                for name in &self.layout.columns {
                    let of_chunk = bytes(name, members * rows.per_member())?;
                    data.columns.push(floats(&of_chunk));
                }
            }
        }
        Ok(Some(data))
    }

    /// Compares the hash of the first member of a chunk with the stored hash. Hashes are computed from the parameters
    /// and the start of a member.
    ///
    /// # Errors
    /// [`StoreError::Members`] if the hashes differ, and those of [`Store::read`].
    #[inline]
    pub fn check_first(&self, chunk: u64, hash: u64) -> Result<(), Error> {
        let saved = self.file(&self.chunk_path(HASHES, chunk), 16)?;
        match integers(&saved).first() {
            Some(first) if *first == hash => Ok(()),
            _ => Err(StoreError::Members {
                path: self.root.display().to_string().into(),
                chunk,
            }
            .into()),
        }
    }

    /// Finds the missing chunks. If no chunk is missing, it removes files that killed processes left.
    ///
    /// # Errors
    /// [`StoreError::File`].
    #[inline]
    pub fn completeness(&self) -> Result<Completeness, Error> {
        let mut missing: Vec<Range<u64>> = Vec::new();
        for chunk in 0..self.layout.chunks() {
            if self.present(chunk)? {
                continue;
            }
            match missing.last_mut() {
                Some(last) if last.end == chunk => last.end += 1,
                _ => missing.push(chunk..chunk + 1),
            }
        }
        if missing.is_empty() {
            self.temporary.remove();
        }
        Ok(Completeness {
            chunks: self.layout.chunks(),
            missing,
        })
    }

    /// Returns the path of a chunk's file. Only the first dimension of an array is divided into chunks.
    #[inline]
    fn chunk_path(&self, array: &str, chunk: u64) -> PathBuf {
        let is_flat = |array: &&ZarrArray| array.shape.len() == 1;
        let flat = (self.arrays.iter()).any(|known| known.name == array && is_flat(&known));
        let mut path = self.root.join(array).join("c").join(chunk.to_string());
        if !flat {
            path.push("0");
        }
        path
    }

    /// Returns the paths and contents of the metadata below the group.
    #[inline]
    fn metadata(&self) -> Vec<(PathBuf, String)> {
        let file = |array: &ZarrArray| {
            let path = self.root.join(&array.name).join("zarr.json");
            (path, array.metadata().to_string())
        };
        let mut files: Vec<_> = self.arrays.iter().map(file).collect();
        if self.layout.rows == Rows::Any {
            let group = layout::group(json::Json::Object(Vec::new()));
            files.push((self.root.join(ROWS).join("zarr.json"), group.to_string()));
        }
        files
    }

    /// Refuses a directory without group metadata that has other entries than a store that is being created.
    #[inline]
    fn refuse_foreign(&self) -> Result<(), Error> {
        let error = |error: io::Error| failed(&self.root, &self.root, &error);
        let entries = match fs::read_dir(&self.root) {
            Ok(entries) => entries,
            Err(missing) if missing.kind() == ErrorKind::NotFound => return Ok(()),
            Err(other) => return Err(error(other)),
        };
        for entry in entries {
            let name = entry.map_err(error)?.file_name();
            let name = name.to_string_lossy();
            let ours = name == ROWS || self.arrays.iter().any(|array| array.name == *name);
            if !ours {
                return Err(StoreError::Foreign {
                    path: self.root.display().to_string().into(),
                    entry: name.into(),
                }
                .into());
            }
        }
        Ok(())
    }

    #[inline]
    fn check_same(&self, path: &Path, saved: &[u8], given: &str) -> Result<(), Error> {
        let saved = String::from_utf8_lossy(saved);
        let Some((saved, given)) = differing(&saved, given) else {
            return Ok(());
        };
        let line = |text: &str| text.trim().trim_end_matches(',').into();
        Err(StoreError::Other {
            path: path.display().to_string().into(),
            saved: line(saved),
            given: line(given),
        }
        .into())
    }

    #[inline]
    fn write_file(&self, path: &Path, bytes: &[u8]) -> Result<(), Error> {
        (self.temporary.write(path, bytes)).map_err(|error| failed(&self.root, path, &error))
    }

    /// Reads a file of a known length.
    #[inline]
    fn file(&self, path: &Path, expected: usize) -> Result<Vec<u8>, Error> {
        let bytes = files::read(&self.root, path)?.unwrap_or_default();
        match bytes.len() == expected {
            true => Ok(bytes),
            false => Err(StoreError::Damaged {
                path: path.display().to_string().into(),
                found: bytes.len(),
                expected,
            }
            .into()),
        }
    }

    #[inline]
    fn check_shape(&self, chunk: u64, data: &ChunkData) -> Result<(), Error> {
        let check = |array: &str, found: usize, expected: usize| match found == expected {
            true => Ok(()),
            false => Err(StoreError::Shape {
                chunk,
                array: array.into(),
                found,
                expected,
            }),
        };
        let range = self.layout.members_of(chunk);
        let members = (range.end - range.start) as usize;
        if members == 0 {
            let chunks = self.layout.chunks();
            return Err(StoreError::NoChunk { chunk, chunks }.into());
        }
        check(STATUS, data.status.len(), members)?;
        check(TIME, data.time.len(), members)?;
        check(STEPS, data.steps.len(), members)?;
        check("columns", data.columns.len(), self.layout.columns.len())?;
        let rows = match &self.layout.rows {
            Rows::Any => data.member.len(),
            rows => {
                check(MEMBER, data.member.len(), 0)?;
                members * rows.per_member()
            }
        };
        for (name, column) in self.layout.columns.iter().zip(&data.columns) {
            check(name, column.len(), rows)?;
        }
        let sorted = data.member.is_sorted();
        if let Some(outside) = data.member.iter().find(|m| !range.contains(m) || !sorted) {
            let fact = match sorted {
                true => format!("member {outside} is not of chunk {chunk}"),
                false => format!("the rows of chunk {chunk} are not in the order of members"),
            };
            let remedy = "give the rows of its members, in their order";
            return Err(StoreError::layout(fact, remedy).into());
        }
        Ok(())
    }
}

impl Rows {
    /// Returns the number of rows of a member, if it is the same for all members.
    #[inline]
    fn per_member(&self) -> usize {
        match self {
            Rows::At { values, .. } => values.len(),
            Rows::One | Rows::Any => 1,
        }
    }
}

/// The number of chunks of a store, and the missing ones.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Completeness {
    /// The number of chunks of the layout.
    pub chunks: u64,
    /// The numbers of the chunks that are missing.
    pub missing: Vec<Range<u64>>,
}

impl Completeness {
    /// Returns true if no chunk is missing.
    #[inline]
    pub fn is_complete(&self) -> bool {
        self.missing.is_empty()
    }
}

/// `complete (7 chunks)`, or `3 of 7 chunks are missing: 1, 5 to 6`.
impl fmt::Display for Completeness {
    #[inline]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// The largest number of ranges that are listed.
        const MAX_RANGES: usize = 8;
        if self.is_complete() {
            return write!(f, "complete ({} chunks)", self.chunks);
        }
        let count: u64 = self
            .missing
            .iter()
            .map(|range| range.end - range.start)
            .sum();
        write!(f, "{count} of {} chunks are missing: ", self.chunks)?;
        for (index, range) in self.missing.iter().take(MAX_RANGES).enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            match range.end - range.start {
                1 => write!(f, "{comma}{}", range.start)?,
                _ => write!(f, "{comma}{} to {}", range.start, range.end - 1)?,
            }
        }
        match self.missing.len() > MAX_RANGES {
            true => write!(f, ", …"),
            false => Ok(()),
        }
    }
}

/// Extends the bytes of an array's chunk by fill values beyond the last member.
#[inline]
fn padded(mut bytes: Vec<u8>, array: &ZarrArray) -> Vec<u8> {
    let length = array.elements() * array.kind.size();
    while bytes.len() < length {
        bytes.extend_from_slice(array.kind.fill());
    }
    bytes
}

fn bytes_of<T: Copy, const N: usize>(values: &[T], bytes: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    values.iter().flat_map(|value| bytes(*value)).collect()
}

#[inline]
fn integers(bytes: &[u8]) -> Vec<u64> {
    let words = bytes.as_chunks::<8>().0;
    words.iter().map(|word| u64::from_le_bytes(*word)).collect()
}

#[inline]
fn floats(bytes: &[u8]) -> Vec<f64> {
    let words = bytes.as_chunks::<8>().0;
    words.iter().map(|word| f64::from_le_bytes(*word)).collect()
}

//! The arrays of a store.
//!
//! Input: a [`Layout`]. Output: the metadata of its arrays in the Zarr v3 format. Source: A. Miles, R. Abernathey et
//! al., "Zarr core specification", version 3.0 (2023).

use super::json::Json;
use crate::errors::StoreError;

/// The contents of a store.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// The names of the columns.
    pub columns: Vec<String>,
    /// The rows of a member.
    pub rows: Rows,
    /// The number of members.
    pub members: u64,
    /// The number of members in a chunk; the last chunk may have fewer.
    pub chunk: u64,
    /// The names of the failures, one word each, for the status numbers from 3.
    pub failures: Vec<String>,
    /// The attributes that distinguish this sweep from others, for example the text of H, the scheme, the step and the
    /// seed. A store with different attributes is refused.
    pub attributes: Vec<(String, Attribute)>,
}

/// The rows of a member.
#[derive(Debug, Clone, PartialEq)]
pub enum Rows {
    /// One row: columns have the dimension `member`.
    One,
    /// One row for each of the values, for example times. Columns have the dimensions `member` and `name`, and the
    /// values are the coordinate `name`.
    At {
        /// The name of the dimension.
        name: String,
        /// Its values.
        values: Vec<f64>,
    },
    /// Any number of rows. Chunk k has a group `rows/k` with the additional column `member` and the dimension `row`.
    /// The array `count` has the number of rows of each member.
    Any,
}

/// The value of an attribute.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Attribute {
    /// A text.
    Text(String),
    /// A whole number.
    Whole(u64),
    /// A number.
    Number(f64),
    /// A truth value.
    Flag(bool),
}

macro_rules! attribute {
    ($($from:ty => $variant:ident),*) => {$(
        impl From<$from> for Attribute {
            #[inline]
            fn from(value: $from) -> Self {
                Attribute::$variant(value.into())
            }
        }
    )*};
}
attribute!(&str => Text, String => Text, u32 => Whole, u64 => Whole, f64 => Number, bool => Flag);

impl Attribute {
    #[inline]
    fn json(&self) -> Json {
        match self {
            Attribute::Text(text) => Json::text(text.as_str()),
            Attribute::Whole(number) => Json::Whole(*number),
            Attribute::Number(number) => Json::Number(*number),
            Attribute::Flag(flag) => Json::Flag(*flag),
        }
    }
}

/// The arrays of every store: the status, end time and steps of members, and the hashes of chunks.
pub(super) const STATUS: &str = "status";
pub(super) const TIME: &str = "time";
pub(super) const STEPS: &str = "steps";
pub(super) const HASHES: &str = "members_hash";
/// The arrays of a store with any number of rows.
pub(super) const COUNT: &str = "count";
pub(super) const ROWS: &str = "rows";
pub(super) const MEMBER: &str = "member";

impl Layout {
    /// Creates a layout with one row per member, in chunks of 4096 members, without attributes.
    pub fn new<N: Into<String>>(members: u64, columns: impl IntoIterator<Item = N>) -> Self {
        Layout {
            columns: columns.into_iter().map(Into::into).collect(),
            rows: Rows::One,
            members,
            chunk: 4096,
            failures: Vec::new(),
            attributes: Vec::new(),
        }
    }

    /// The number of chunks.
    #[inline]
    pub fn chunks(&self) -> u64 {
        self.members.div_ceil(self.chunk.max(1))
    }

    /// The members of a chunk.
    #[inline]
    pub fn members_of(&self, chunk: u64) -> core::ops::Range<u64> {
        let first = chunk.saturating_mul(self.chunk).min(self.members);
        first..first.saturating_add(self.chunk).min(self.members)
    }

    /// Checks the sizes and the names.
    #[inline]
    pub(super) fn check(&self) -> Result<(), StoreError> {
        let layout = |fact: String, remedy: &str| Err(StoreError::layout(fact, remedy));
        if self.members == 0 || self.chunk == 0 {
            let fact = format!(
                "a store of {} members in chunks of {}",
                self.members, self.chunk
            );
            return layout(fact, "give at least one member and one member a chunk");
        }
        let dimension = match &self.rows {
            Rows::At { name, .. } => Some(name),
            Rows::One | Rows::Any => None,
        };
        let names = || dimension.into_iter().chain(&self.columns);
        for (index, name) in names().enumerate() {
            let reserved = [
                STATUS,
                TIME,
                STEPS,
                HASHES,
                COUNT,
                ROWS,
                MEMBER,
                "row",
                "zarr.json",
            ];
            if reserved.contains(&name.as_str()) {
                let fact = format!("a store has an array `{name}` already");
                return layout(fact, "give the column another name");
            }
            // The specification excludes names that begin with `__` and names of dots alone.
            let is_path = name.contains(['/', '\\']) || name.contains(char::is_control);
            if is_path || name.starts_with("__") || name.chars().all(|letter| letter == '.') {
                let fact = format!("`{name}` is no name of an array");
                return layout(fact, "use letters, digits, `_`, `-`, `.` and brackets");
            }
            if names().take(index).any(|before| before == name) {
                let fact = format!("two columns have the name `{name}`");
                return layout(fact, "give each column a name of its own");
            }
        }
        if self.failures.len() > usize::from(u8::MAX) - 2 {
            let fact = format!("{} kinds of failures", self.failures.len());
            return layout(fact, "a status has room for 253 of them");
        }
        Ok(())
    }

    /// Returns the metadata of the group with those of its arrays, so that readers open only one file.
    ///
    /// If members have any number of rows, the metadata of arrays are omitted: each chunk adds a group, which readers
    /// of consolidated metadata would ignore.
    #[inline]
    pub(super) fn group(&self) -> Json {
        let own = [
            ("members".to_owned(), Json::Whole(self.members)),
            ("chunk".to_owned(), Json::Whole(self.chunk)),
        ];
        let given = self.attributes.iter();
        let given = given.map(|(name, value)| (name.clone(), value.json()));
        let attributes = Json::Object(own.into_iter().chain(given).collect());
        match self.rows {
            Rows::Any => group(attributes),
            Rows::One | Rows::At { .. } => consolidated(attributes, &self.arrays()),
        }
    }

    /// Returns the arrays of the root group.
    #[inline]
    pub(super) fn arrays(&self) -> Vec<ZarrArray> {
        let per_member = |name: &str, kind| ZarrArray {
            name: name.to_owned(),
            kind,
            shape: vec![self.members],
            chunk: vec![self.chunk],
            dimensions: vec![MEMBER.to_owned()],
            attributes: Vec::new(),
        };
        let mut arrays = Vec::new();
        match &self.rows {
            Rows::One => {
                arrays.extend(self.columns.iter().map(|name| per_member(name, Kind::F64)));
            }
            Rows::At { name, values } => {
                let count = values.len() as u64;
                arrays.push(ZarrArray::line(name, Kind::F64, count, name));
                for column in &self.columns {
                    let mut array = per_member(column, Kind::F64);
                    array.shape.push(count);
                    array.chunk.push(count.max(1));
                    array.dimensions.push(name.clone());
                    arrays.push(array);
                }
            }
            Rows::Any => arrays.push(per_member(COUNT, Kind::U64)),
        }
        arrays.push(per_member(TIME, Kind::F64));
        arrays.push(per_member(STEPS, Kind::U64));
        arrays.push(ZarrArray {
            shape: vec![self.chunks(), 2],
            chunk: vec![1, 2],
            dimensions: vec!["chunk".to_owned(), "first_and_all".to_owned()],
            ..per_member(HASHES, Kind::U64)
        });
        let mut status = per_member(STATUS, Kind::U8);
        let known = ["missing", "ended", "stopped_by_event"].map(str::to_owned);
        let meanings: Vec<String> = known.into_iter().chain(self.failures.clone()).collect();
        // The flags of the CF conventions, section 3.5.
        status.attributes = vec![
            (
                "flag_values".to_owned(),
                Json::List((0..meanings.len() as u64).map(Json::Whole).collect()),
            ),
            ("flag_meanings".to_owned(), Json::Text(meanings.join(" "))),
        ];
        arrays.push(status);
        arrays
    }

    /// Returns the arrays of a chunk with `rows` rows, for members with any number of rows.
    #[inline]
    pub(super) fn rows_arrays(&self, rows: u64) -> Vec<ZarrArray> {
        let line = |name: &str, kind| ZarrArray::line(name, kind, rows, "row");
        let columns = self.columns.iter().map(|name| line(name, Kind::F64));
        core::iter::once(line(MEMBER, Kind::U64))
            .chain(columns)
            .collect()
    }
}

/// The type of an array's elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    U8,
    U64,
    F64,
}

impl Kind {
    /// Returns the number of bytes of an element.
    #[inline]
    pub(super) fn size(self) -> usize {
        match self {
            Kind::U8 => 1,
            Kind::U64 | Kind::F64 => 8,
        }
    }

    /// Returns the bytes of a missing element.
    #[inline]
    pub(super) fn fill(self) -> &'static [u8] {
        match self {
            Kind::U8 => &[0],
            Kind::U64 => &[0; 8],
            Kind::F64 => const { &f64::NAN.to_le_bytes() },
        }
    }
}

/// The metadata of an array of a store.
#[derive(Debug, Clone)]
pub(super) struct ZarrArray {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) shape: Vec<u64>,
    pub(super) chunk: Vec<u64>,
    pub(super) dimensions: Vec<String>,
    attributes: Vec<(String, Json)>,
}

impl ZarrArray {
    /// Creates an array with one dimension in one chunk.
    #[inline]
    fn line(name: &str, kind: Kind, length: u64, dimension: &str) -> Self {
        ZarrArray {
            name: name.to_owned(),
            kind,
            shape: vec![length],
            chunk: vec![length.max(1)],
            dimensions: vec![dimension.to_owned()],
            attributes: Vec::new(),
        }
    }

    /// Returns the contents of its `zarr.json`.
    #[inline]
    pub(super) fn metadata(&self) -> Json {
        let named = |name: &str, configuration| {
            Json::object([("name", Json::text(name)), ("configuration", configuration)])
        };
        let wholes =
            |numbers: &[u64]| Json::List(numbers.iter().copied().map(Json::Whole).collect());
        let (kind, fill) = match self.kind {
            Kind::U8 => ("uint8", Json::Whole(0)),
            Kind::U64 => ("uint64", Json::Whole(0)),
            Kind::F64 => ("float64", Json::Number(f64::NAN)),
        };
        let shape = Json::object([("chunk_shape", wholes(&self.chunk))]);
        let separator = Json::object([("separator", Json::text("/"))]);
        let endian = Json::object([("endian", Json::text("little"))]);
        Json::object([
            ("zarr_format", Json::Whole(3)),
            ("node_type", Json::text("array")),
            ("shape", wholes(&self.shape)),
            ("data_type", Json::text(kind)),
            ("chunk_grid", named("regular", shape)),
            ("chunk_key_encoding", named("default", separator)),
            ("fill_value", fill),
            ("codecs", Json::List(vec![named("bytes", endian)])),
            ("attributes", Json::Object(self.attributes.clone())),
            (
                "dimension_names",
                Json::List(self.dimensions.iter().map(Json::text).collect()),
            ),
        ])
    }

    /// Returns the number of elements of a chunk, including those beyond the end of the array.
    #[inline]
    pub(super) fn elements(&self) -> usize {
        self.chunk.iter().product::<u64>() as usize
    }
}

/// Returns the metadata of a group.
#[inline]
pub(super) fn group(attributes: Json) -> Json {
    Json::object(group_members(attributes))
}

#[inline]
fn group_members(attributes: Json) -> [(&'static str, Json); 3] {
    [
        ("zarr_format", Json::Whole(3)),
        ("node_type", Json::text("group")),
        ("attributes", attributes),
    ]
}

/// Returns the metadata of a group with those of all of its arrays, in the form of zarr-python. The specification does
/// not yet contain this form, and readers may ignore it.
#[inline]
pub(super) fn consolidated(attributes: Json, arrays: &[ZarrArray]) -> Json {
    let metadata = arrays
        .iter()
        .map(|array| (array.name.clone(), array.metadata()));
    let consolidated = Json::object([
        ("kind", Json::text("inline")),
        ("must_understand", Json::Flag(false)),
        ("metadata", Json::Object(metadata.collect())),
    ]);
    let [format, node, attributes] = group_members(attributes);
    Json::object([
        format,
        node,
        attributes,
        ("consolidated_metadata", consolidated),
    ])
}

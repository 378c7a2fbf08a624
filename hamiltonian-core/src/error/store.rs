//! Errors of stores.

/// An error of a store.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum StoreError {
    /// A layout that no store can have.
    #[error("{fact}\nhelp: {remedy}")]
    Layout {
        /// The part that does not fit.
        fact: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// The directory holds something else.
    #[error("`{path}` is no store: it has `{found}` in it\nhelp: give a path of its own")]
    Foreign {
        /// The directory.
        path: String,
        /// A name in the directory that no store has.
        found: String,
    },
    /// The store belongs to another sweep.
    #[error(
        "`{path}` is the store of another sweep: it says `{saved}`, and this sweep `{given}`\n\
         help: give another path, or remove the store"
    )]
    Other {
        /// The file that differs.
        path: String,
        /// The first line of it that differs.
        saved: String,
        /// That line for this sweep.
        given: String,
    },
    /// The chunk was written with other members.
    #[error(
        "chunk {chunk} of `{path}` was made from other members: its first one had another system or \
         another start\nhelp: give another path, or make the members as they were made"
    )]
    Members {
        /// The store.
        path: String,
        /// The number of the chunk.
        chunk: u64,
    },
    /// A file of the store differs from what was written.
    #[error("`{path}` is damaged: it has {found} bytes, and must have {expected}\nhelp: remove it")]
    Damaged {
        /// The file.
        path: String,
        /// Its length.
        found: u64,
        /// Its length as it was written.
        expected: u64,
    },
    /// A chunk does not have the shape of the layout.
    #[error("chunk {chunk}: `{array}` has {found} values, and must have {expected}")]
    Shape {
        /// The number of the chunk.
        chunk: u64,
        /// The array, or `chunk` for a number beyond the last chunk.
        array: String,
        /// The number of values given.
        found: u64,
        /// The number the layout has.
        expected: u64,
    },
    /// The disk is full, or a quota is used up. Chunks written before are intact.
    #[error(
        "`{path}` cannot be written: no space is left\n\
         help: make space and run the sweep again; chunks that exist are skipped"
    )]
    Full {
        /// The store.
        path: String,
    },
    /// A file cannot be read or written.
    #[error("`{path}`: {message}")]
    File {
        /// Its path.
        path: String,
        /// The system's message.
        message: String,
    },
}

//! Calls of users' closures, whose panics become errors.
//!
//! Input: a closure. Output: its value, or [`Error::Panicked`] with the text of the panic.

use crate::error::Error;

/// Returns the value of a closure. If it panics, and panics unwind, returns [`Error::Panicked`].
#[cfg(feature = "std")]
pub(crate) fn guard<A>(closure: impl FnOnce() -> A) -> Result<A, Error> {
    use alloc::borrow::ToOwned;
    use alloc::string::String;
    use std::panic::{AssertUnwindSafe, catch_unwind};
    // Unwind-safe: the closure modifies data of its own member only, which is not used again.
    catch_unwind(AssertUnwindSafe(closure)).map_err(|payload| {
        let message = match (
            payload.downcast_ref::<&str>(),
            payload.downcast_ref::<String>(),
        ) {
            (Some(text), _) => (*text).to_owned(),
            (_, Some(text)) => text.clone(),
            _ => "no message".to_owned(),
        };
        Error::Panicked { message }
    })
}

/// Returns the value of a closure: without `std` panics do not unwind.
#[cfg(not(feature = "std"))]
pub(crate) fn guard<A>(closure: impl FnOnce() -> A) -> Result<A, Error> {
    Ok(closure())
}

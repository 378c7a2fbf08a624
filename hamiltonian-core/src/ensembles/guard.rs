//! Calls of users' closures, whose panics become errors.
//!
//! Input: a closure. Output: its value, or `SweepError::Panicked` with the
//! text of the panic.

use crate::errors::Error;

/// Returns the value of a closure. If it panics, and panics unwind, returns
/// `SweepError::Panicked`.
#[cfg(feature = "std")]
pub(crate) fn guard<A>(closure: impl FnOnce() -> A) -> Result<A, Error> {
    use crate::errors::SweepError;
    use alloc::string::String;
    use std::panic::{AssertUnwindSafe, catch_unwind};
    // Unwind-safe: the closure modifies data of its own member only, which is not used again.
    catch_unwind(AssertUnwindSafe(closure)).map_err(|payload| {
        let message = match (
            payload.downcast_ref::<&str>(),
            payload.downcast_ref::<String>(),
        ) {
            (Some(text), _) => *text,
            (_, Some(text)) => text.as_str(),
            _ => "no message",
        };
        SweepError::Panicked {
            message: message.into(),
        }
        .into()
    })
}

/// Returns the value of a closure: without `std` panics do not unwind.
#[cfg(not(feature = "std"))]
pub(crate) fn guard<A>(closure: impl FnOnce() -> A) -> Result<A, Error> {
    Ok(closure())
}

//! Closures of users, whose panics become errors.

use crate::error::Error;

/// The value of a closure, or [`Error::Panicked`] where panics unwind.
#[cfg(feature = "std")]
pub(crate) fn guard<A>(closure: impl FnOnce() -> A) -> Result<A, Error> {
    use alloc::borrow::ToOwned;
    use alloc::string::String;
    use std::panic::{AssertUnwindSafe, catch_unwind};
    // What the closure had in its hands is its member's, which is not used again.
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

/// Without `std` panics do not unwind.
#[cfg(not(feature = "std"))]
pub(crate) fn guard<A>(closure: impl FnOnce() -> A) -> Result<A, Error> {
    Ok(closure())
}

//! The text of the parameters of a system, written when it is needed.
//!
//! Input: a system. Output: [`ParameterText`]. Invariant: the text is that of the system at the time it was given, also
//! if the system has changed since.

use super::System;
use alloc::string::String;
use alloc::sync::Arc;
use core::fmt;

/// The parameters of a system as text, which is written when a run is saved: see [`System::parameter_text`].
///
/// ```
/// use hamiltonian::prelude::*;
/// use hamiltonian::systems::ParameterText;
///
/// hamiltonian! {
///     /// A spring.
///     pub struct Spring { k = 1.0 }
///     H(q; p) = p^2/2 + k*q^2/2
/// }
///
/// let text = ParameterText::of(Spring { k: 2.0 });
/// assert_eq!(text.write(), "k = 2.0\n");
/// ```
#[derive(Clone)]
pub struct ParameterText(Arc<dyn Fn() -> String + Send + Sync>);

impl ParameterText {
    /// The text of a system that is kept for it.
    pub fn of<S: System + Send + Sync + 'static>(system: S) -> Self {
        Self::by(move || Self::of_now(&system))
    }

    /// The text that a closure writes.
    pub(crate) fn by(write: impl Fn() -> String + Send + Sync + 'static) -> Self {
        ParameterText(Arc::new(write))
    }

    /// Writes the text.
    pub fn write(&self) -> String {
        (self.0)()
    }

    /// Writes the text of a system.
    pub(crate) fn of_now<S: System + ?Sized>(system: &S) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = system.describe_parameters(&mut text);
        text
    }
}

impl fmt::Debug for ParameterText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.write())
    }
}

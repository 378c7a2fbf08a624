//! Parts of messages: place, number, remedy.

use alloc::boxed::Box;
use core::fmt::{Display, Formatter, Result};

/// ` in the flow of …`, if there is a piece.
pub(super) struct Within<'a>(pub(super) &'a Option<Box<str>>);

impl Display for Within<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self.0 {
            Some(piece) => write!(f, " in the flow of `{piece}`"),
            None => Ok(()),
        }
    }
}

/// A number in the fewest digits that identify it, with an exponent if it is large or small.
pub(super) struct Number(pub(super) f64);

impl Display for Number {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        // The numbers to which `{:?}` gives an exponent; it writes integers with `.0`.
        let size = self.0.abs();
        match size.is_finite() && size != 0.0 && !(1e-5..1e16).contains(&size) {
            true => write!(f, "{:e}", self.0),
            false => write!(f, "{}", self.0),
        }
    }
}

/// Components: the first few, and the first that is not finite.
pub(super) struct Numbers<'a>(pub(super) &'a [f64]);

impl Display for Numbers<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        const MAX_NUMBERS: usize = 12;
        let all = self.0;
        let [a, b, c, ..] = all else {
            return write!(f, "{all:?}");
        };
        if all.len() <= MAX_NUMBERS {
            return write!(f, "{all:?}");
        }
        write!(f, "[{a:?}, {b:?}, {c:?}, … {} numbers", all.len())?;
        if let Some(at) = all.iter().position(|x| !x.is_finite()) {
            write!(f, ", number {at} is {:?}", all[at])?;
        }
        write!(f, "]")
    }
}

/// `the derivative part of …`, if it is one.
pub(super) struct DerivativePart(pub(super) bool);

impl Display for DerivativePart {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(if self.0 {
            "the derivative part of "
        } else {
            ""
        })
    }
}

/// The remedy for a start without values, or without derivative parts.
pub(super) struct StartRemedy<'a>(pub(super) &'a Option<Box<str>>, pub(super) bool);

impl Display for StartRemedy<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self.0 {
            Some(parameter) => write!(f, "the parameter `{parameter}` must be finite"),
            None if self.1 => write!(
                f,
                "choose a start and parameters at which H and its first and second derivatives are finite"
            ),
            None => write!(
                f,
                "choose a start and parameters at which H and its first derivatives are finite"
            ),
        }
    }
}

/// ` in lane …`, if there are several.
pub(super) struct Lane(pub(super) Option<u32>);

impl Display for Lane {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self.0 {
            Some(lane) => write!(f, " in lane {lane}"),
            None => Ok(()),
        }
    }
}

/// Declared names, for the message about an unknown one: what they name, and the names.
pub(crate) struct Known<'a, S>(pub(crate) &'static str, pub(crate) &'a [S]);

impl<S: AsRef<str>> Display for Known<'_, S> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        /// More names than this are not listed.
        const MAX_NAMES: usize = 24;
        let Known(what, names) = self;
        for (at, name) in names.iter().take(MAX_NAMES).enumerate() {
            match at {
                0 => write!(f, "\nhelp: {what} `{}`", name.as_ref())?,
                _ => write!(f, ", `{}`", name.as_ref())?,
            }
        }
        match names.len() {
            count if count > MAX_NAMES => write!(f, " and {} more", count - MAX_NAMES),
            _ => Ok(()),
        }
    }
}

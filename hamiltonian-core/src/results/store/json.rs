//! The part of JSON that the metadata of a store requires.
//!
//! Invariant: equal values have equal texts, with one member of an object per line. Therefore the text identifies a
//! store, and the first line that differs shows the difference.

use core::fmt;

/// A value of JSON.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Json {
    Flag(bool),
    Whole(u64),
    Number(f64),
    Text(String),
    List(Vec<Json>),
    Object(Vec<(String, Json)>),
}

impl Json {
    pub(super) fn text(text: impl Into<String>) -> Self {
        Json::Text(text.into())
    }

    pub(super) fn object<const N: usize>(members: [(&str, Json); N]) -> Self {
        Json::Object(members.map(|(name, value)| (name.into(), value)).into())
    }

    /// Writes the text, indented by `indent` levels.
    #[inline]
    fn write(&self, f: &mut fmt::Formatter<'_>, indent: usize) -> fmt::Result {
        match self {
            Json::Flag(flag) => write!(f, "{flag}"),
            Json::Whole(number) => write!(f, "{number}"),
            // JSON has no such numbers; Zarr represents them by these texts.
            Json::Number(number) if number.is_nan() => write!(f, "\"NaN\""),
            Json::Number(number) if number.is_infinite() => {
                let sign = if *number < 0.0 { "-" } else { "" };
                write!(f, "\"{sign}Infinity\"")
            }
            Json::Number(number) => write!(f, "{number:?}"),
            Json::Text(text) => quoted(f, text),
            Json::List(values) => {
                write!(f, "[")?;
                for (index, value) in values.iter().enumerate() {
                    write!(f, "{}", if index == 0 { "" } else { ", " })?;
                    value.write(f, indent)?;
                }
                write!(f, "]")
            }
            Json::Object(members) if members.is_empty() => write!(f, "{{}}"),
            Json::Object(members) => {
                for (index, (name, value)) in members.iter().enumerate() {
                    write!(f, "{}", if index == 0 { "{\n" } else { ",\n" })?;
                    write!(f, "{:width$}", "", width = 2 * indent + 2)?;
                    quoted(f, name)?;
                    write!(f, ": ")?;
                    value.write(f, indent + 1)?;
                }
                write!(f, "\n{:width$}}}", "", width = 2 * indent)
            }
        }
    }
}

impl fmt::Display for Json {
    #[inline]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, 0)
    }
}

/// Writes a text between quotes (RFC 8259, section 7).
#[inline]
fn quoted(f: &mut fmt::Formatter<'_>, text: &str) -> fmt::Result {
    write!(f, "\"")?;
    for letter in text.chars() {
        match letter {
            '"' | '\\' => write!(f, "\\{letter}")?,
            letter if u32::from(letter) < 0x20 => write!(f, "\\u{:04x}", u32::from(letter))?,
            letter => write!(f, "{letter}")?,
        }
    }
    write!(f, "\"")
}

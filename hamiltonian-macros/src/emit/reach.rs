//! Questions to the sizes: whether indices stay in range.
//!
//! Input: [`Reach`]es. Output: statements that ask. Invariant: what const generics decide is asked
//! when the code is compiled, the rest in `new`; nothing is asked where anything is evaluated.

use super::block::Context;
use super::generics::Generics;
use super::item::located;
use super::lex;
use proc_macro2::{Span, TokenStream};
use quote::quote;
use std::fmt::Write;

/// An index, or the first value of a range, that only the sizes can keep in its bounds. Forms are
/// `[constant, factor of each size…, factor of each loop…]`.
#[derive(Debug)]
pub struct Reach {
    /// As it is written,
    pub shown: String,
    /// and where.
    pub span: Span,
    /// The sizes in forms, by their numbers in the model.
    pub sizes: Vec<usize>,
    /// The ranges of its loops, outermost first, each in the loops before it.
    pub loops: Vec<[Vec<i64>; 2]>,
    /// The form that must be ≥ 0.
    pub form: Vec<i64>,
    /// Its upper bound, excluded; the first value of a range has none.
    pub extent: Option<Bound>,
}

/// An extent.
#[derive(Debug, Clone, Copy)]
pub enum Bound {
    /// A number.
    Literal(u64),
    /// A size, by its number in the model.
    Size(usize),
}

impl Reach {
    /// Whether a size that is set at run time has a say.
    pub fn is_run_time(&self, context: Context) -> bool {
        let extent = match self.extent {
            Some(Bound::Size(size)) => Some(size),
            Some(Bound::Literal(_)) | None => None,
        };
        let mut sizes = self.sizes.iter().chain(&extent);
        sizes.any(|size| context.is_run_time[*size])
    }

    /// The value that knows the answer.
    fn value(&self, context: Context) -> String {
        let name = |size: &usize| context.indices.sizes[*size].as_str();
        let sizes: Vec<&str> = self.sizes.iter().map(name).collect();
        let ranges = |[lower, upper]: &[Vec<i64>; 2]| format!("[&{lower:?}, &{upper:?}]");
        let loops: Vec<String> = self.loops.iter().map(ranges).collect();
        format!(
            "__h::Reach {{ sizes: &[{}], loops: [{}], index: &{:?} }}",
            sizes.join(", "),
            loops.join(", "),
            self.form
        )
    }

    fn extent(&self, context: Context) -> Option<String> {
        self.extent.map(|extent| match extent {
            Bound::Literal(value) => format!("{value}usize"),
            Bound::Size(size) => context.indices.sizes[size].clone(),
        })
    }
}

/// What is asked when the code is compiled for certain sizes: a constant for each question, which
/// rustc shows at the index if it fails.
pub fn compiled(reaches: &[Reach], context: Context, generics: &Generics) -> TokenStream {
    let mut constants = TokenStream::new();
    for (number, reach) in questions(reaches, context) {
        let (value, shown) = (reach.value(context), &reach.shown);
        let (bound, message) = match (reach.extent(context), reach.extent) {
            (Some(extent), Some(bound)) => {
                let last = match bound {
                    Bound::Literal(value) => value.saturating_sub(1).to_string(),
                    Bound::Size(size) => format!("{} - 1", context.model.sizes[size]),
                };
                let message = format!(
                    "`{shown}` is out of range for these sizes: indices there run from 0 to {last}"
                );
                (extent, message)
            }
            _ => (
                "__h::core::primitive::usize::MAX".to_owned(),
                format!("`{shown}` begins below 0 for these sizes"),
            ),
        };
        let text = format!(
            "const __REACH{number}: () = __h::core::assert!({value}.is_within({bound}), {message:?});"
        );
        constants.extend(located(lex(&text), reach.span, usize::MAX));
    }
    if constants.is_empty() {
        return constants;
    }
    let header = format!("impl{} {}", generics.declaration(), generics.system_type());
    let header = lex(&header);
    // Loops of three and more that may be empty are run.
    quote! { #[allow(long_running_const_eval)] #header { #constants } }
}

/// The statements that have [`compiled`] asked.
pub fn asked(reaches: &[Reach], context: Context) -> String {
    let numbers = questions(reaches, context);
    numbers
        .map(|(number, _)| format!("let () = Self::__REACH{number};\n"))
        .collect()
}

fn questions<'a>(
    reaches: &'a [Reach],
    context: Context,
) -> impl Iterator<Item = (usize, &'a Reach)> {
    let all = reaches.iter().enumerate();
    all.filter(move |(_, reach)| !reach.is_run_time(context))
}

/// The questions asked when a system is made.
pub fn constructed(reaches: &[Reach], context: Context) -> String {
    let mut out = String::new();
    for reach in reaches.iter().filter(|reach| reach.is_run_time(context)) {
        let (value, shown) = (reach.value(context), &reach.shown);
        let check = match reach.extent(context) {
            Some(extent) => format!("check({shown:?}, {extent})"),
            None => format!("check_range({shown:?})"),
        };
        let _ = writeln!(out, "{value}.{check}?;");
    }
    out
}

//! Questions to the sizes: whether indices stay in range.
//!
//! Input: [`Reach`]es. Output: statements that ask. Invariant: questions to const generics are asked
//! when the code is compiled, the rest in `new`; nothing is asked where anything is evaluated.

use super::context::Context;
use super::{lex, located};
use hamiltonian_language::checked::{Extent, Reach};
use hamiltonian_symbolic::index::{Affine, Domain, Size};
use hamiltonian_symbolic::sort::Arrange;
use proc_macro2::TokenStream;
use quote::quote;
use std::fmt::Write;
use std::iter;

/// The sizes in the forms of a question.
fn sizes(reach: &Reach) -> Vec<Size> {
    let ranges = reach.loops.iter().flat_map(|(_, range)| range);
    let forms = ranges.chain([&reach.form]);
    let mut sizes: Vec<Size> = forms.flat_map(Affine::all_sizes).collect();
    sizes.arrange();
    sizes.dedup();
    sizes
}

/// Returns true if a size that is set at run time has a say.
fn is_run_time(reach: &Reach, context: Context) -> bool {
    let extent = reach.extent.and_then(|extent| match extent {
        Extent::Size(size) => Some(size),
        Extent::Literal(_) => None,
    });
    let mut sizes = sizes(reach).into_iter().chain(extent);
    sizes.any(|size| context.is_run_time[usize::from(size.0)])
}

/// The value that knows the answer. Forms are `[constant, factor of each size…, factor of each
/// loop…]`, those of a range in the loops before it.
fn value(reach: &Reach, context: Context) -> String {
    let sizes = sizes(reach);
    let factors = |form: &Affine, loops: &[(Domain, [Affine; 2])]| {
        let of_sizes = sizes.iter().map(|size| form.factor_of_size(*size));
        let of_loops = loops.iter().map(|(id, _)| form.factor(*id));
        let factors: Vec<i64> = iter::once(form.constant)
            .chain(of_sizes)
            .chain(of_loops)
            .collect();
        format!("&{factors:?}")
    };
    let range = |(level, (_, range)): (usize, &(Domain, [Affine; 2]))| {
        let [lower, upper] = range
            .each_ref()
            .map(|form| factors(form, &reach.loops[..level]));
        format!("[{lower}, {upper}]")
    };
    let loops: Vec<String> = reach.loops.iter().enumerate().map(range).collect();
    let names: Vec<&str> = sizes
        .iter()
        .map(|size| context.indices.size(*size))
        .collect();
    format!(
        "__h::Reach {{ sizes: &[{}], loops: [{}], index: {} }}",
        names.join(", "),
        loops.join(", "),
        factors(&reach.form, &reach.loops)
    )
}

fn bound(extent: Extent, context: Context) -> String {
    match extent {
        Extent::Literal(value) => format!("{value}usize"),
        Extent::Size(size) => context.indices.size(size).to_owned(),
    }
}

/// The questions asked when the code is compiled for certain sizes: a constant for each, which
/// rustc shows at the index if it fails.
pub fn compiled(context: Context) -> TokenStream {
    let mut constants = TokenStream::new();
    for (number, reach) in questions(context) {
        let (value, shown) = (value(reach, context), &reach.shown);
        let (bound, message) = match reach.extent {
            Some(extent) => {
                let last = match extent {
                    Extent::Literal(value) => value.saturating_sub(1).to_string(),
                    Extent::Size(size) => {
                        format!("{} - 1", context.model.sizes[usize::from(size.0)])
                    }
                };
                let message = format!(
                    "`{shown}` is out of range for these sizes: indices there run from 0 to {last}"
                );
                (bound(extent, context), message)
            }
            None => (
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
    let header = lex(&context.generics.header());
    // Loops of three and more that may be empty are run.
    quote! { #[allow(long_running_const_eval)] #header { #constants } }
}

/// The statements that have [`compiled`] asked.
pub fn asked(context: Context) -> String {
    let numbers = questions(context);
    numbers
        .map(|(number, _)| format!("let () = Self::__REACH{number};\n"))
        .collect()
}

fn questions(context: Context<'_>) -> impl Iterator<Item = (usize, &Reach)> {
    let all = context.definition.checked.reaches.iter().enumerate();
    all.filter(move |(_, reach)| !is_run_time(reach, context))
}

/// The questions asked when a system is made.
pub fn constructed(context: Context) -> String {
    let mut out = String::new();
    let reaches = context.definition.checked.reaches.iter();
    for reach in reaches.filter(|reach| is_run_time(reach, context)) {
        let (value, shown) = (value(reach, context), &reach.shown);
        let check = match reach.extent {
            Some(extent) => format!("check({shown:?}, {})", bound(extent, context)),
            None => format!("check_range({shown:?})"),
        };
        let _ = writeln!(out, "{value}.{check}?;");
    }
    out
}

//! Checks that indices stay in range for the sizes.
//!
//! Input: [`Reach`]es. Output: statements that check them. Invariant: rustc checks those of const generics when
//! it compiles the code, `new` checks those of run-time sizes; evaluations check nothing.

use crate::emit::names::context::Context;
use crate::emit::tokens::{lex, located};
use hamiltonian_language::checked::{Bound, Extent, Reach, Type};
use hamiltonian_symbolic::index::{Affine, Domain, Size};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::sort::Arrange;
use proc_macro2::TokenStream;
use quote::quote;
use std::fmt::Write;
use std::iter;

/// The sizes, and products of sizes, in the forms of a check.
fn sizes(reach: &Reach) -> Vec<Vec<Size>> {
    let ranges = reach.loops.iter().flat_map(|(_, range)| range);
    let mut sizes: Vec<Vec<Size>> = Vec::new();
    for form in ranges.chain([&reach.form]) {
        sizes.extend(form.sizes.iter().map(|(size, _)| vec![*size]));
        sizes.extend(form.products.iter().map(|(product, _)| product.clone()));
    }
    sizes.arrange();
    sizes.dedup();
    sizes
}

/// Returns true if the check depends on a size that is set at run time.
fn is_run_time(reach: &Reach, context: Context) -> bool {
    let extent = match reach.limit {
        Bound::Extent(extent) => extent.affine(),
        Bound::Nothing | Bound::Memory => Affine::default(),
    };
    let mut sizes = sizes(reach).into_iter().flatten().chain(extent.all_sizes());
    sizes.any(|size| context.is_run_time[usize::from(size.0)])
}

/// The value whose methods do the check. Forms are `[constant, factor of each size…, factor of each
/// loop…]`, those of a range in the loops before it.
fn value(reach: &Reach, context: Context) -> String {
    let sizes = sizes(reach);
    let factors = |form: &Affine, loops: &[(Domain, [Affine; 2])]| {
        let of_sizes = sizes.iter().map(|sizes| form.factor_of_sizes(sizes));
        let of_loops = loops.iter().map(|(id, _)| form.factor(*id));
        let factors: Vec<i64> = iter::once(form.constant)
            .chain(of_sizes)
            .chain(of_loops)
            .into_list();
        format!("&{factors:?}")
    };
    let range = |(level, (_, range)): (usize, &(Domain, [Affine; 2]))| {
        let [lower, upper] = range
            .each_ref()
            .map(|form| factors(form, &reach.loops[..level]));
        format!("[{lower}, {upper}]")
    };
    let loops: Vec<String> = reach.loops.iter().enumerate().map(range).into_list();
    let name = |sizes: &Vec<Size>| {
        let names = sizes.iter().map(|size| context.indices.size(*size));
        let names: Vec<&str> = names.into_list();
        match *names {
            [name] => name.to_owned(),
            _ => format!("__h::product(&[{}])", names.join(", ")),
        }
    };
    let names: Vec<String> = sizes.iter().map(name).into_list();
    format!(
        "__h::Reach {{ sizes: &[{}], loops: [{}], index: {} }}",
        names.join(", "),
        loops.join(", "),
        factors(&reach.form, &reach.loops)
    )
}

fn bound(extent: Extent, context: Context) -> String {
    context.indices.plain(&extent.affine())
}

/// An extent as it is written.
fn written(extent: Extent, context: Context) -> String {
    let name = |size: &Size| context.model.sizes[usize::from(size.0)].clone();
    match extent {
        Extent::Literal(value) => value.to_string(),
        Extent::Size(size) => name(&size),
        Extent::Product(number, sizes) => {
            let number = (number > 1).then(|| number.to_string()).into_iter();
            let factors = number.chain(sizes.iter().flatten().map(name));
            factors.into_list().join("*")
        }
    }
}

/// The name of a parameter, with its extents if one of them is a product.
pub fn declared(name: &str, ty: Type, context: Context) -> String {
    let extents = ty.extents();
    let is_product = |extent: &Extent| matches!(extent, Extent::Product(..));
    let shown = extents.iter().filter(|_| extents.iter().any(is_product));
    let shown = shown.map(|extent| format!("[{}]", written(*extent, context)));
    name.to_owned() + &shown.collect::<String>()
}

/// The checks that rustc makes when it compiles the code for certain sizes: a constant for each, which it shows
/// at the index if the check fails.
pub fn compiled(context: Context) -> TokenStream {
    let mut constants = TokenStream::new();
    for (number, reach) in constant(context) {
        let (value, shown) = (value(reach, context), &reach.shown);
        let (condition, message) = match reach.limit {
            Bound::Extent(extent) => {
                let last = match extent {
                    Extent::Literal(value) => value.saturating_sub(1).to_string(),
                    _ => format!("{} - 1", written(extent, context)),
                };
                (
                    format!("is_within({})", bound(extent, context)),
                    format!(
                        "`{shown}` is out of range for these sizes: indices there run from 0 to {last}"
                    ),
                )
            }
            Bound::Nothing => (
                "begins_at_0()".to_owned(),
                format!("`{shown}` begins below 0 for these sizes"),
            ),
            Bound::Memory => (
                "fits()".to_owned(),
                format!("`{shown}` does not fit into memory: the sizes are too large"),
            ),
        };
        let text = format!(
            "const __REACH{number}: () = __h::core::assert!({value}.{condition}, {message:?});"
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

/// The statements that evaluate the constants of [`compiled`].
pub fn asserted(context: Context) -> String {
    let numbers = constant(context);
    numbers
        .map(|(number, _)| format!("let () = Self::__REACH{number};\n"))
        .collect()
}

/// The checks that depend on const generics alone, with their numbers.
fn constant(context: Context<'_>) -> impl Iterator<Item = (usize, &Reach)> {
    let all = context.definition.checked.reaches.iter().enumerate();
    all.filter(move |(_, reach)| !is_run_time(reach, context))
}

/// The checks that `new` makes: first that products of sizes fit into memory, then the others.
pub fn constructed(context: Context) -> [String; 2] {
    let mut out = [const { String::new() }; 2];
    let reaches = context.definition.checked.reaches.iter();
    for reach in reaches.filter(|reach| is_run_time(reach, context)) {
        let (value, shown) = (value(reach, context), &reach.shown);
        let check = match reach.limit {
            Bound::Extent(extent) => format!("check({shown:?}, {})", bound(extent, context)),
            Bound::Nothing => format!("check_range({shown:?})"),
            Bound::Memory => format!("check_memory({shown:?})"),
        };
        let later = usize::from(reach.limit != Bound::Memory);
        let _ = writeln!(out[later], "{value}.{check}?;");
    }
    out
}

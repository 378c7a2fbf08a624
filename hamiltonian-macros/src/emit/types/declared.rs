//! The variables a definition was declared in, where it is integrated in others: their storage,
//! and the methods that carry states from one to the other.
//!
//! Input: [`Declared`]. Output: the two methods, and the context their struct is emitted from,
//! where they have one. Invariant: the mathematics of a map reads and writes vectors of the
//! system's own shape, in which the declared variables have their places; here they are only
//! moved.

use crate::emit::functions::holder::Receiver;
use crate::emit::names::context::{Context, ZERO};
use crate::emit::names::layout::{Layout, layout};
use crate::emit::tokens::lex;
use hamiltonian_language::analyse::variables::Declared;
use hamiltonian_symbolic::model::{Shape, VectorUse};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use std::fmt::Write;

/// The context of the storage of the declared variables.
pub fn context<'a>(declared: &'a Declared, own: Context<'a>) -> Context<'a> {
    Context {
        groups: &declared.groups,
        layout: layout(&declared.groups),
        suffix: "Declared",
        ..own
    }
}

/// The contexts of the structs of coordinates of mixed shape: of those of the whole system, and of the
/// declared ones.
pub fn mixed(own: Context<'_>) -> impl Iterator<Item = Context<'_>> {
    let declared = own
        .definition
        .declared
        .map(|declared| context(declared, own));
    let own = own.definition.piece.is_none().then_some(own);
    let all = own.into_iter().chain(declared);
    all.filter(|context| context.layout == Layout::Mixed)
}

/// A part of a vector and the place in it.
fn place(context: Context, group: u16, row: u32) -> (u16, u32) {
    match context.layout {
        Layout::Scalars => (0, u32::from(group)),
        Layout::Array => (0, row),
        Layout::Mixed => (group, row),
    }
}

/// The statements that move the numbers of one side from `from` to `to`; `back` moves from the
/// system's own variables to the declared ones.
fn moved(declared: &Declared, own: Context, (from, to): (&str, &str), back: bool) -> String {
    let theirs = context(declared, own);
    let mut out = String::new();
    for placement in &declared.places {
        let (group, row) = placement.old;
        let shape = &declared.groups[usize::from(group)].shape;
        // A scalar, and an array as a whole, begin at row 0.
        let old = place(theirs, group, row.unwrap_or_default());
        let new = place(own, placement.new, 0);
        let ((a, i), (b, j)) = if back { (new, old) } else { (old, new) };
        let (from, to) = (
            format!("__h::Vector::part(&{from}, {a})"),
            format!("__h::Vector::part_mut(&mut {to}, {b})"),
        );
        let _ = match row.is_none() && *shape != Shape::Scalar {
            true => writeln!(
                out,
                "{{ let (_from, _to) = ({from}, {to});\n\
                 __h::core::assert!(_from.len() == _to.len(), \"the state does not have the shape of the system\");\n\
                 _to.copy_from_slice(_from); }}"
            ),
            false => writeln!(out, "{to}[{j}] = {from}[{i}];"),
        };
    }
    out
}

/// The method from declared variables to the system's own, over the function of the prepared
/// system where coordinates change, or with `back` the other way.
pub fn method(
    declared: &Declared,
    own: Context,
    visibility: &TokenStream,
    back: bool,
) -> TokenStream {
    let theirs = context(declared, own);
    let usage = match back {
        true => VectorUse::ToDeclared,
        false => VectorUse::FromDeclared,
    };
    let function = own.model.vectors.iter().position(|v| v.usage == usage);
    let time = declared.time.map(|group| place(own, group, 0));
    let (their_zeros, own_zeros) = (theirs.zeros(), own.zeros());
    let mut body = String::from("let _self = self;\n");
    Receiver::System.bind_sizes(&mut body, own);
    let prepared = "<Self as __h::System>::prepare::<T>(self)";
    if back {
        // The state's own map, into a vector of its own shape; then to the places.
        let (q, p) = match function {
            Some(at) => {
                let _ = write!(
                    body,
                    "let (mut _q, mut _p) = ({own_zeros}, {own_zeros});\n\
                     {prepared}.v{at}(state.t, &state.q, &state.p, &mut _q, &mut _p);\n"
                );
                ("_q", "_p")
            }
            None => ("state.q", "state.p"),
        };
        let t = match time {
            Some((part, at)) => format!("__h::Vector::part(&state.q, {part})[{at}]"),
            None => "state.t".to_owned(),
        };
        let _ = writeln!(
            body,
            "let mut _new = __h::State {{ t: {t}, q: {their_zeros}, p: {their_zeros} }};\n{}{}_new",
            moved(declared, own, (q, "_new.q"), true),
            moved(declared, own, (p, "_new.p"), true)
        );
    } else {
        let _ = writeln!(
            body,
            "let (mut _q, mut _p) = ({own_zeros}, {own_zeros});\n{}{}",
            moved(declared, own, ("state.q", "_q"), false),
            moved(declared, own, ("state.p", "_p"), false)
        );
        let t = if time.is_some() { ZERO } else { "state.t" };
        let _ = match function {
            Some(at) => write!(
                body,
                "let mut _new = __h::State {{ t: {t}, q: {own_zeros}, p: {own_zeros} }};\n\
                 {prepared}.v{at}(state.t, &_q, &_p, &mut _new.q, &mut _new.p);\n"
            ),
            None => writeln!(
                body,
                "let mut _new = __h::State {{ t: {t}, q: _q, p: _p }};"
            ),
        };
        let _ = match time {
            Some((part, at)) => writeln!(
                body,
                "__h::Vector::part_mut(&mut _new.q, {part})[{at}] = state.t;\n\
                 self.on_shell(&_new)"
            ),
            None => writeln!(body, "_new"),
        };
    }
    let (text, of_time) = match back {
        true => (
            " The state in the variables H was declared in, from those the system is integrated in.",
            " Its `t` is the time of H.",
        ),
        false => (
            " The state in the variables the system is integrated in, from those H was declared in.",
            " It is on the shell, its `t` (that is s) is 0.",
        ),
    };
    let text = format!("{text}{}", if time.is_some() { of_time } else { "" });
    let (body, name) = (lex(&body), format_ident!("{}", usage.name()));
    let (from, to) = match back {
        true => (own, theirs),
        false => (theirs, own),
    };
    let (from, to) = (lex(&from.vector()), lex(&to.vector()));
    quote! {
        #[doc = #text]
        #[must_use]
        #visibility fn #name<T: __h::Real>(&self, state: &__h::State<#from>) -> __h::State<#to> {
            #body
        }
    }
}

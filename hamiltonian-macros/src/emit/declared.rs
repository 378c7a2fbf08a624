//! The variables a definition was declared in, where it is integrated in others: their storage,
//! and the methods that carry states from one to the other.
//!
//! Input: [`Declared`]. Output: the two methods, and the context their struct is emitted from,
//! where they have one. Invariant: the mathematics of a map reads and writes vectors of the
//! system's own shape, in which the declared variables have their places; here they are only
//! moved.

use super::block::Context;
use super::dynamics;
use super::generics::Generics;
use super::holder::Receiver;
use super::layout::{Layout, layout};
use super::{Definition, lex};
use hamiltonian_symbolic::model::{Model, Shape};
use hamiltonian_symbolic::transform::Placement;
use proc_macro2::TokenStream;
use quote::quote;
use std::fmt::Write;

/// The declared variables.
#[derive(Debug)]
pub struct Declared {
    /// Their groups; nothing else of this model is read.
    pub model: Model,
    /// Where each stands among the system's own variables.
    pub places: Vec<Placement>,
    /// The group of the system that is the declared time, where it has another.
    pub time: Option<u16>,
}

/// The context of the storage of the declared variables.
fn context<'a>(declared: &'a Declared, own: Context<'a>) -> Context<'a> {
    Context {
        in_place: false,
        reversed: false,
        model: &declared.model,
        layout: layout(&declared.model.groups),
        suffix: "Declared",
        ..own
    }
}

/// The type of declared coordinates and of declared momenta over `T`.
pub fn vector(declared: &Declared, own: Context, generics: &Generics) -> String {
    dynamics::vector(context(declared, own), generics, "T", "__h")
}

/// The context of their struct, where the declared variables are of mixed shape.
pub fn mixed<'a>(definition: &Definition<'a>, own: Context<'a>) -> Option<Context<'a>> {
    let context = context(definition.declared?, own);
    (context.layout == Layout::Mixed).then_some(context)
}

/// A part of a vector and the place in it.
fn place(context: Context, group: u16, row: u32) -> (u16, u32) {
    match context.layout {
        Layout::Scalars => (0, u32::from(group)),
        Layout::Array => (0, row),
        Layout::Mixed => (group, row),
    }
}

/// The numbers of one side, moved from `from` to `to`; `back` moves from the system's own
/// variables to the declared ones.
fn moved(
    out: &mut String,
    declared: &Declared,
    contexts: (Context, Context),
    (from, to): (&str, &str),
    back: bool,
) {
    let (theirs, own) = contexts;
    for placement in &declared.places {
        let (group, row) = placement.old;
        let shape = &declared.model.groups[usize::from(group)].shape;
        let is_array = row.is_none() && *shape != Shape::Scalar;
        // A scalar, and an array as a whole, begin at row 0.
        let old = place(theirs, group, row.unwrap_or_default());
        let new = place(own, placement.new, 0);
        let ((a, i), (b, j)) = if back { (new, old) } else { (old, new) };
        let _ = if is_array {
            writeln!(
                out,
                "{{ let (_from, _to) = (__h::Vector::part(&{from}, {a}), __h::Vector::part_mut(&mut {to}, {b}));\n\
                 __h::core::assert!(_from.len() == _to.len(), \"the state does not have the shape of the system\");\n\
                 _to.copy_from_slice(_from); }}"
            )
        } else {
            writeln!(
                out,
                "__h::Vector::part_mut(&mut {to}, {b})[{j}] = __h::Vector::part(&{from}, {a})[{i}];"
            )
        };
    }
}

/// The method `name` from declared variables to the system's own over the prepared system's
/// `function`, or with `back` the other way.
pub fn method(
    declared: &Declared,
    own: Context,
    generics: &Generics,
    visibility: &TokenStream,
    (name, function): (String, Option<String>),
    back: bool,
) -> TokenStream {
    let theirs = context(declared, own);
    let bound = lex(&generics.state_bound());
    let vector = |context| lex(&dynamics::vector(context, generics, "T", "__h"));
    let (their_vector, own_vector) = (vector(theirs), vector(own));
    let time = declared.time.map(|group| place(own, group, 0));
    let zero = "T::constant(0.0, 0.0)";
    let (their_zeros, own_zeros) = (
        dynamics::zeros(theirs, generics),
        dynamics::zeros(own, generics),
    );
    let mut body = String::from("let _self = self;\n");
    for (size, run_time) in own.is_run_time.iter().enumerate() {
        if *run_time {
            Receiver::System.bind_size(&mut body, generics, size);
        }
    }
    let prepared = "<Self as __h::System<T>>::prepare(self)";
    if back {
        // The state's own map, into a vector of its own shape; then to the places.
        let _ = match &function {
            Some(function) => write!(
                body,
                "let (mut _q, mut _p) = ({own_zeros}, {own_zeros});\n\
                 {prepared}.{function}(state.t, &state.q, &state.p, &mut _q, &mut _p);\n"
            ),
            None => writeln!(body, "let (_q, _p) = (&state.q, &state.p);"),
        };
        let t = match time {
            Some((part, at)) => format!("__h::Vector::part(&state.q, {part})[{at}]"),
            None => "state.t".to_owned(),
        };
        let _ = writeln!(
            body,
            "let mut _new = __h::State {{ t: {t}, q: {their_zeros}, p: {their_zeros} }};"
        );
        let (q, p) = match &function {
            Some(_) => ("_q", "_p"),
            None => ("*_q", "*_p"),
        };
        moved(&mut body, declared, (theirs, own), (q, "_new.q"), true);
        moved(&mut body, declared, (theirs, own), (p, "_new.p"), true);
        body.push_str("_new\n");
    } else {
        let _ = writeln!(body, "let (mut _q, mut _p) = ({own_zeros}, {own_zeros});");
        moved(&mut body, declared, (theirs, own), ("state.q", "_q"), false);
        moved(&mut body, declared, (theirs, own), ("state.p", "_p"), false);
        let t = if time.is_some() { zero } else { "state.t" };
        let _ = match &function {
            Some(function) => write!(
                body,
                "let mut _new = __h::State {{ t: {t}, q: {own_zeros}, p: {own_zeros} }};\n\
                 {prepared}.{function}(state.t, &_q, &_p, &mut _new.q, &mut _new.p);\n"
            ),
            None => writeln!(
                body,
                "let mut _new = __h::State {{ t: {t}, q: _q, p: _p }};"
            ),
        };
        match time {
            Some((part, at)) => {
                let _ = writeln!(
                    body,
                    "__h::Vector::part_mut(&mut _new.q, {part})[{at}] = state.t;\n\
                     self.on_shell(&_new)"
                );
            }
            None => body.push_str("_new\n"),
        }
    }
    let (body, name) = (lex(&body), lex(&name));
    let mut text = if back {
        "The state in the variables H was declared in, from those the system is integrated in."
    } else {
        "The state in the variables the system is integrated in, from those H was declared in."
    }
    .to_owned();
    if time.is_some() {
        text.push_str(if back {
            " Its `t` is the time of H."
        } else {
            " It is on the shell, its `t` (that is s) is 0."
        });
    }
    let text = format!(" {text}");
    let (from, to) = if back {
        (own_vector, their_vector)
    } else {
        (their_vector, own_vector)
    };
    quote! {
        #[doc = #text]
        #[must_use]
        #visibility fn #name<T: #bound>(&self, state: &__h::State<#from>) -> __h::State<#to> {
            #body
        }
    }
}

//! Monitors, invariants and events: their values, and methods of the type.
//!
//! Input: a definition. Output: text of their dispatch, tokens of the methods.
//! Invariant: a vector-valued observable is one entry a component, in order.

use crate::emit::names::context::Context;
use crate::emit::tokens::{allowances, documented, lex};
use hamiltonian_symbolic::facts::conditions;
use hamiltonian_symbolic::model::{Model, Observable, ObservableKind};
use proc_macro2::TokenStream;
use quote::quote;
use std::fmt::Write;

/// The body of `Dynamics::observable`.
pub fn dispatch(model: &Model) -> String {
    let mut out = "match _index {\n".to_owned();
    let mut index = 0;
    for (at, observable) in model.observables.iter().enumerate() {
        for component in 0..observable.components.len() {
            let _ = writeln!(out, "{index} => self.o{at}(_t, _q, _p)[{component}],");
            index += 1;
        }
    }
    let _ = write!(
        out,
        "_ => __h::core::panic!(\"observable {{}} of {{}}\", _index, {index}),\n}}"
    );
    out
}

/// The methods of the type.
pub fn methods(context: Context, visibility: &TokenStream) -> TokenStream {
    let state = lex(&context.vector());
    let mut out = TokenStream::new();
    let observables = context.model.observables.iter().enumerate();
    for ((at, observable), item) in observables.zip(&context.definition.checked.observables) {
        let (name, attributes) = (&item.name, &item.attributes);
        let allow = allowances(&[name]);
        let components = observable.components.len();
        let call =
            format!("<Self as __h::System>::prepare::<T>(self).o{at}(state.t, &state.q, &state.p)");
        let (result, body) = if components == 1 {
            ("T".to_owned(), format!("let [_value] = {call}; _value"))
        } else {
            (
                format!("__h::SVector<T, {components}>"),
                format!("__h::Matrix::from_array_storage(__h::ArrayStorage([{call}]))"),
            )
        };
        let (result, body) = (lex(&result), lex(&body));
        let text = format!(" {:?} `{}` at a state.", observable.kind, observable.name);
        let docs = documented(attributes, &text);
        let domain = domain(context.model, observable);
        let proof = match context.definition.proofs[at].as_slice() {
            [] => None,
            sentences => {
                let text = format!("\n\n {}", sentences.join(" "));
                Some(quote! { #[doc = #text] })
            }
        };
        out.extend(quote! {
            #docs
            #domain
            #proof
            #allow
            #[must_use]
            #visibility fn #name<T: __h::Real>(&self, state: &__h::State<#state>) -> #result { #body }
        });
    }
    out
}

/// The domain of an invariant, on which it is conserved, if that is not the domain of H.
fn domain(model: &Model, observable: &Observable) -> Option<TokenStream> {
    if observable.kind != ObservableKind::Invariant {
        return None;
    }
    let of_h = conditions(model, &[model.h()]);
    let mut own = conditions(model, &observable.components);
    own.retain(|condition| !of_h.contains(condition));
    if own.is_empty() {
        return None;
    }
    let text = format!("\n\n Conserved where H has values and {}.", own.join(", "));
    Some(quote! { #[doc = #text] })
}

//! Vector functions as methods of the type: velocities and momenta of a Lagrangian, forces,
//! gradients of events and monitors, maps between coordinates, starts on a shell.
//!
//! Input: a definition. Output: tokens of the methods, each over one function of the prepared
//! system. Invariant: vectors have the system's shape.

use crate::emit::names::context::Context;
use crate::emit::tokens::{allowances, lex};
use crate::emit::types::declared;
use hamiltonian_symbolic::model::VectorUse;
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

/// The methods of the type.
pub fn methods(context: Context, visibility: &TokenStream) -> TokenStream {
    let vector = lex(&context.vector());
    let state = quote! { __h::State<#vector> };
    let zeros = quote! { <Self as __h::System>::zeros::<T>(self) };
    let mut out = TokenStream::new();
    for (at, function) in context.model.vectors.iter().enumerate() {
        let call = format_ident!("v{at}");
        let call = quote! { <Self as __h::System>::prepare::<T>(self).#call };
        let one = |more: TokenStream, result: TokenStream| {
            quote! {
                let mut _v = #zeros;
                #call(#more, &mut _v);
                #result
            }
        };
        let at_state = quote! { state.t, &state.q, &state.p };
        let name = function.usage.name();
        let (mut name, mut arguments) = (format_ident!("{name}"), quote! { state: &#state });
        let (text, result, body) = match function.usage {
            VectorUse::ConjugateMomentum => {
                arguments = quote! { time: T, coordinates: &#vector, velocities: &#vector };
                (
                    "The momenta ∂L/∂v at a time, coordinates and velocities.".to_owned(),
                    &vector,
                    one(quote! { time, coordinates, velocities }, quote! { _v }),
                )
            }
            VectorUse::Velocity => (
                "The velocities dq/dt at a state.".to_owned(),
                &vector,
                one(at_state, quote! { _v }),
            ),
            VectorUse::Force => (
                "The force f on the momenta at a state: dp/dt = −∂H/∂q + f.".to_owned(),
                &vector,
                one(at_state, quote! { _v }),
            ),
            VectorUse::OnShell => (
                "The state with the momentum of time set to −H, so that it moves as the system does."
                    .to_owned(),
                &state,
                one(
                    at_state,
                    quote! { __h::State { t: state.t, q: __h::core::clone::Clone::clone(&state.q), p: _v } },
                ),
            ),
            VectorUse::Gradient(observable) => {
                let of = &context.definition.checked.observables[observable].name;
                name = format_ident!("{of}_gradient");
                (
                    format!("The gradient of `{of}` at a state."),
                    &quote! { __h::Gradient<#vector> },
                    quote! {
                        let mut _g = __h::Gradient { q: #zeros, p: #zeros };
                        #call(#at_state, &mut _g.q, &mut _g.p);
                        _g
                    },
                )
            }
            // Maps are between two shapes, below.
            VectorUse::FromDeclared | VectorUse::ToDeclared => continue,
        };
        let (text, allow) = (format!(" {text}"), allowances(&[&name]));
        out.extend(quote! {
            #[doc = #text]
            #allow
            #[must_use]
            #visibility fn #name<T: __h::Real>(&self, #arguments) -> #result { #body }
        });
        if function.usage == VectorUse::ConjugateMomentum {
            out.extend(state_from_velocity(context, visibility));
        }
    }
    if let Some(declared) = context.definition.declared {
        for back in [false, true] {
            out.extend(declared::method(declared, context, visibility, back));
        }
    }
    out
}

/// The start of a Lagrangian system. In another time it is given in the variables of L, which `from_declared`
/// puts among the system's own.
fn state_from_velocity(context: Context, visibility: &TokenStream) -> TokenStream {
    let own = lex(&context.vector());
    let (theirs, state) = match context.definition.declared {
        Some(declared) => (
            lex(&declared::context(declared, context).vector()),
            quote! {
                let _moved = self.from_declared(&__h::State { t: time, q: _q, p: _v });
                let _p = self.conjugate_momentum(time, &_moved.q, &_moved.p);
                self.on_shell(&__h::State { t: _moved.t, q: _moved.q, p: _p })
            },
        ),
        None => (
            own.clone(),
            quote! {
                let _p = self.conjugate_momentum(time, &_q, &_v);
                __h::State { t: time, q: _q, p: _p }
            },
        ),
    };
    let method = |name: &str, text: &str, scalar: TokenStream| {
        let name = format_ident!("{name}");
        quote! {
            #[doc = #text]
            #visibility fn #name<T: __h::Real #scalar, __M, __A: __h::IntoVector<__M, Vector = #theirs>>(
                &self, time: T, coordinates: __A, velocities: __A,
            ) -> __h::State<#own> {
                let (_q, _v) =
                    (__h::IntoVector::into_vector(coordinates), __h::IntoVector::into_vector(velocities));
                #state
            }
        }
    };
    let mut methods = method(
        "state_from_velocity",
        " The state at a time with these coordinates and velocities, over `f64`.",
        quote! { + __h::Plain },
    );
    methods.extend(method(
        "state_from_velocity_over",
        " The state at a time with these coordinates and velocities, over any scalar.",
        TokenStream::new(),
    ));
    methods
}

//! Vector functions as methods of the type: velocities and momenta of a Lagrangian, forces,
//! gradients of events and monitors, maps between coordinates, starts on a shell.
//!
//! Input: a definition. Output: tokens of the methods, each over one function of the prepared
//! system. Invariant: vectors have the system's shape.

use super::block::Context;
use super::dynamics::vector;
use super::generics::Generics;
use super::{Definition, allowances, declared, lex};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// A vector function of the model, in its order.
#[derive(Debug)]
pub struct VectorItem {
    /// Its use.
    pub usage: VectorUse,
    /// The name of its method.
    pub name: Ident,
}

/// The use of a vector function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VectorUse {
    /// p(q, v)
    ConjugateMomentum,
    /// v(q, p)
    Velocity,
    /// The force on the momenta.
    Force,
    /// The gradient of an event or a monitor.
    Gradient,
    /// The coordinates the system is integrated in, from the declared ones.
    FromDeclared,
    /// The declared coordinates.
    ToDeclared,
    /// The momentum of time on the shell.
    OnShell,
}

impl VectorItem {
    /// A vector function with the name its use has.
    pub fn of(usage: VectorUse) -> VectorItem {
        let name = match usage {
            VectorUse::ConjugateMomentum => "conjugate_momentum",
            VectorUse::Velocity => "velocity",
            VectorUse::Force => "force",
            VectorUse::Gradient => "gradient",
            VectorUse::FromDeclared => "from_declared",
            VectorUse::ToDeclared => "to_declared",
            VectorUse::OnShell => "on_shell",
        };
        let name = Ident::new(name, Span::call_site());
        VectorItem { usage, name }
    }
}

/// The methods of the type.
pub fn methods(
    definition: &Definition,
    context: Context,
    generics: &Generics,
    visibility: &TokenStream,
) -> TokenStream {
    let bound = lex(&generics.state_bound());
    let vector = lex(&vector(context, generics, "T", "__h"));
    let zeros = quote! { <Self as __h::System<T>>::zeros(self) };
    let prepared = quote! { <Self as __h::System<T>>::prepare(self) };
    let state_from_velocity = state_from_velocity(definition, context, generics, visibility);
    let mut out = TokenStream::new();
    for (at, item) in definition.vectors.iter().enumerate() {
        let (name, function) = (&item.name, Ident::new(&format!("v{at}"), Span::call_site()));
        let allow = allowances(&[name]);
        let method = match item.usage {
            VectorUse::ConjugateMomentum => quote! {
                /// The momenta ∂L/∂v at a time, coordinates and velocities.
                #[must_use]
                #visibility fn #name<T: #bound>(
                    &self, time: T, coordinates: &#vector, velocities: &#vector
                ) -> #vector {
                    let mut _p = #zeros;
                    #prepared.#function(time, coordinates, velocities, &mut _p);
                    _p
                }
                #state_from_velocity
            },
            VectorUse::Velocity => quote! {
                /// The velocities dq/dt at a state.
                #[must_use]
                #visibility fn #name<T: #bound>(&self, state: &__h::State<#vector>) -> #vector {
                    let mut _v = #zeros;
                    #prepared.#function(state.t, &state.q, &state.p, &mut _v);
                    _v
                }
            },
            VectorUse::Force => quote! {
                /// The force f on the momenta at a state: dp/dt = −∂H/∂q + f.
                #[must_use]
                #visibility fn #name<T: #bound>(&self, state: &__h::State<#vector>) -> #vector {
                    let mut _f = #zeros;
                    #prepared.#function(state.t, &state.q, &state.p, &mut _f);
                    _f
                }
            },
            VectorUse::Gradient => {
                let text = format!(
                    " The gradient of `{}` at a state.",
                    name.to_string().trim_end_matches("_gradient")
                );
                quote! {
                    #[doc = #text]
                    #allow
                    #[must_use]
                    #visibility fn #name<T: #bound>(&self, state: &__h::State<#vector>) -> __h::Gradient<#vector> {
                        let mut _g = __h::Gradient { q: #zeros, p: #zeros };
                        #prepared.#function(state.t, &state.q, &state.p, &mut _g.q, &mut _g.p);
                        _g
                    }
                }
            }
            // Maps are between two shapes, below.
            VectorUse::FromDeclared | VectorUse::ToDeclared => continue,
            VectorUse::OnShell => quote! {
                /// The state with the momentum of time set to −H, so that it moves as the system does.
                #[must_use]
                #visibility fn #name<T: #bound>(&self, state: &__h::State<#vector>) -> __h::State<#vector> {
                    let mut _p = #zeros;
                    #prepared.#function(state.t, &state.q, &state.p, &mut _p);
                    __h::State { t: state.t, q: __h::core::clone::Clone::clone(&state.q), p: _p }
                }
            },
        };
        out.extend(method);
    }
    let directions = [
        (VectorUse::FromDeclared, false),
        (VectorUse::ToDeclared, true),
    ];
    for (usage, back) in directions {
        let Some(declared) = definition.declared else {
            break;
        };
        let at = definition.vectors.iter().position(|v| v.usage == usage);
        let function = at.map(|at| format!("v{at}"));
        let name = VectorItem::of(usage).name;
        let names = (name.to_string(), function);
        out.extend(declared::method(
            declared, context, generics, visibility, names, back,
        ));
    }
    out
}

/// The start of a Lagrangian system. In another time it is given in the variables of L, whose place
/// among the system's own `from_declared` knows.
fn state_from_velocity(
    definition: &Definition,
    context: Context,
    generics: &Generics,
    visibility: &TokenStream,
) -> TokenStream {
    let bound = lex(&generics.state_bound());
    let own = lex(&vector(context, generics, "T", "__h"));
    let theirs = match definition.declared {
        Some(declared) => lex(&declared::vector(declared, context, generics)),
        None => own.clone(),
    };
    let state = if definition.declared.is_some() {
        quote! {
            let _moved = self.from_declared(&__h::State { t: time, q: _q, p: _v });
            let _p = self.conjugate_momentum(time, &_moved.q, &_moved.p);
            self.on_shell(&__h::State { t: _moved.t, q: _moved.q, p: _p })
        }
    } else {
        quote! {
            let _p = self.conjugate_momentum(time, &_q, &_v);
            __h::State { t: time, q: _q, p: _p }
        }
    };
    quote! {
        /// The state at a time with these coordinates and velocities.
        #visibility fn state_from_velocity<T: #bound, __M, __A: __h::IntoVector<__M, Vector = #theirs>>(
            &self, time: T, coordinates: __A, velocities: __A,
        ) -> __h::State<#own> {
            let (_q, _v) =
                (__h::IntoVector::into_vector(coordinates), __h::IntoVector::into_vector(velocities));
            #state
        }
    }
}

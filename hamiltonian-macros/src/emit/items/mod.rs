//! The output of the macro.
//!
//! Input: a definition. Output: the item form, with its documentation and methods, or the expression form. Invariant: the
//! user's names, attributes and paths keep their own tokens.

mod expression;
mod item;
mod vectors;

use crate::emit::definition::Definition;
use crate::emit::names::context::Context;
use crate::emit::names::generics::Generics;
use proc_macro2::TokenStream;

/// The tokens of a definition.
pub fn generate(definition: &Definition) -> TokenStream {
    let generics = Generics::of(definition);
    let context = Context::of(definition, &generics);
    match &definition.checked.item {
        Some(item) => item::generate(context, item),
        None => expression::generate(context),
    }
}

//! The code in the place of a wrong definition: its errors, and a stub that keeps the rest of the
//! program from erring too.
//!
//! Input: the tree as far as it was read, and the errors. Output: items or an expression.
//! Invariant: no use of the stub — fields, methods, traits, generics — raises a further
//! error. That needs a type rustc knows to be erroneous: in expression form the last
//! `compile_error!` is the value; in item form the type is an alias of a struct with the declared
//! fields, one of whose const arguments is the last `compile_error!`.

use hamiltonian_language::ast::{Ast, Header, Item, ParameterEntry, ParameterKind};
use hamiltonian_language::names;
use hamiltonian_language::report::Report;
use hamiltonian_language::tokens::is_attribute;
use hamiltonian_symbolic::list::IntoList;
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

/// The errors with a stub.
pub fn stub(ast: &Ast, report: &Report) -> TokenStream {
    let mut errors: Vec<TokenStream> = report
        .errors()
        .iter()
        .map(|error| error.to_compile_error())
        .into_list();
    match &ast.item {
        Some(item) if is_name(&item.header.name) => {
            let last = errors.pop();
            let item = item_stub(item, last.expect("a stub stands for something wrong"));
            quote!(#(#errors)* #item)
        }
        Some(_) => quote!(#(#errors)*),
        None if ast.is_item || errors.len() == 1 => quote!(#(#errors)*),
        None => quote!({ #(#errors)* }),
    }
}

fn item_stub(item: &Item, error: TokenStream) -> TokenStream {
    let Header {
        visibility,
        name,
        attributes,
        ..
    } = &item.header;
    let docs = attributes
        .iter()
        .filter(|attribute| is_attribute(attribute, "doc"));
    let hidden = format_ident!("__{name}", span = name.span());
    let sizes = distinct(&item.generics, |name| name);
    let parameters = distinct(&item.parameters, |parameter| &parameter.name);
    let is_number =
        |kind: &ParameterKind| !matches!(kind, ParameterKind::Size | ParameterKind::Function(_));
    let is_function =
        |parameter: &&&ParameterEntry| matches!(parameter.kind, ParameterKind::Function(_));
    let functions = parameters.iter().filter(is_function);
    let functions: Vec<Ident> = functions
        .map(|parameter| format_ident!("__F{}", parameter.name))
        .into_list();
    let scalar = parameters
        .iter()
        .any(|parameter| is_number(&parameter.kind));
    let fields = parameters.iter().map(|parameter| {
        let field = &parameter.name;
        let ty = match parameter.kind {
            ParameterKind::Size => quote!(usize),
            ParameterKind::Scalar(_) => quote!(__P),
            ParameterKind::Array(..) => quote!([__P; __ERROR]),
            ParameterKind::Function(_) => {
                let function = format_ident!("__F{}", parameter.name);
                quote!(#function)
            }
        };
        quote!(#visibility #field: #ty)
    });
    let parameter = scalar.then(|| quote!(__P,));
    let with_default = scalar.then(|| quote!(__P = f64,));
    quote! {
        #[doc(hidden)]
        #visibility struct #hidden<#(const #sizes: usize,)* #(#functions,)* #parameter const __ERROR: usize> {
            #(#fields),*
        }
        #(#docs)*
        #visibility type #name<#(const #sizes: usize,)* #(#functions,)* #with_default> =
            #hidden<#(#sizes,)* #(#functions,)* #parameter { #error }>;
    }
}

/// Not a keyword of Rust.
fn is_name(name: &Ident) -> bool {
    !names::is_rust_keyword(&name.to_string())
}

/// The items that a stub may have: a bad header may repeat a name, or name something by a keyword.
fn distinct<T>(items: &[T], name: impl Fn(&T) -> &Ident) -> Vec<&T> {
    let mut seen: Vec<&T> = Vec::new();
    for item in items {
        if is_name(name(item)) && !seen.iter().any(|other| name(other) == name(item)) {
            seen.push(item);
        }
    }
    seen
}

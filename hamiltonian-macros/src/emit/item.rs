//! Item form: the struct with its docs, `Display` and methods.
//!
//! Input: a definition and its header. Output: its tokens. Invariant: fields are public where they
//! can be anything; sizes set at run time and the arrays that depend on them are private and of a
//! type that nothing else makes, so that lengths that `new` checked stay right.

use super::block::Context;
use super::generics::Generics;
use super::index::Indices;
use super::layout::{self, Layout, layout};
use super::number::Numbers;
use super::{
    Definition, Field, Form, Item, VectorUse, allowances, construct, declared, dynamics, externals,
    lex, markers, mixed, observables, reach, vectors,
};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use std::fmt::Write;

/// The owner of the borrows of a [`Context`].
#[derive(Debug)]
pub struct Parts {
    sizes: Vec<String>,
    is_run_time: Vec<bool>,
    numbers: Numbers,
}

impl Parts {
    /// The names of sizes inside bodies.
    pub fn of(definition: &Definition, generics: &Generics) -> Parts {
        let is_run_time: Vec<bool> = match &definition.form {
            Form::Item(item) => item.sizes.iter().map(|size| size.run_time).collect(),
            Form::Expression(_) => Vec::new(),
        };
        let mut constants = generics.constants.iter();
        let sizes = is_run_time.iter().enumerate().map(|(at, run_time)| {
            if *run_time {
                format!("_n{at}")
            } else {
                let name = constants.next().cloned();
                name.expect("a size is a constant or set at run time")
            }
        });
        Parts {
            sizes: sizes.collect(),
            is_run_time,
            numbers: Numbers::default(),
        }
    }

    /// The context of bodies.
    pub fn context<'a>(&'a self, definition: &Definition<'a>) -> Context<'a> {
        Context {
            in_place: false,
            reversed: false,
            model: definition.model,
            program: definition.program,
            layout: layout(&definition.model.groups),
            suffix: "Vector",
            indices: Indices { sizes: &self.sizes },
            is_run_time: &self.is_run_time,
            numbers: &self.numbers,
        }
    }
}

/// How deep the signatures of methods stand in implementations; in their bodies nothing is wrong.
const SIGNATURES: usize = 1;

/// The tokens of a type.
pub fn generate(definition: &Definition, item: &Item) -> TokenStream {
    let generics = Generics::of(definition);
    let parts = Parts::of(definition, &generics);
    let context = parts.context(definition);
    let root = &definition.root;
    let declaration = declaration(definition, item, context, &generics);
    let (mut text, functions) = dynamics::implementations(definition, context, &generics);
    text.push_str(&markers::implementations(&definition.structure, &generics));
    text.push_str(&display(definition, &generics));
    if context.layout == Layout::Mixed && item.whole.is_none() {
        text.push_str(&mixed::implementations(context, &generics));
    }
    if let Some(declared) = declared::mixed(definition, context) {
        text.push_str(&mixed::implementations(declared, &generics));
    }
    text.push_str(&construct::default(item, context, &generics));
    let implementations = located(lex(&text), item.name.span(), SIGNATURES);
    let functions = lex(&functions);
    let externals = externals::wrappers(definition);
    let inherent = inherent(definition, item, context, &generics);
    let questions = reach::compiled(definition.reaches, context, &generics);
    quote! {
        #declaration
        #[allow(clippy::approx_constant)]
        const _: () = {
            use #root::private as __h;
            #externals
            #implementations
            #functions
            #questions
            #inherent
        };
    }
}

/// The struct, and that of its coordinates where it has one.
fn declaration(
    definition: &Definition,
    item: &Item,
    context: Context,
    generics: &Generics,
) -> TokenStream {
    let root = &definition.root;
    let (visibility, name) = (&item.visibility, &item.name);
    let constants = item
        .sizes
        .iter()
        .filter(|size| !size.run_time)
        .map(|size| &size.name);
    let scalar = match generics.scalars.first() {
        Some(scalar) => {
            let scalar = user_scalar(item, scalar);
            let scalar = lex(&scalar);
            quote! { #scalar = #root::private::core::primitive::f64 }
        }
        None => TokenStream::new(),
    };
    let parameters =
        quote! { < #(const #constants: #root::private::core::primitive::usize,)* #scalar > };
    let parameters = if item.sizes.iter().all(|size| size.run_time) && scalar.is_empty() {
        TokenStream::new()
    } else {
        parameters
    };
    let fields = item
        .fields
        .iter()
        .map(|field| struct_field(definition, item, context, generics, *field));
    let attributes = &item.attributes;
    let docs = docs(definition, item, context);
    let names: Vec<_> = item
        .sizes
        .iter()
        .map(|s| &s.name)
        .chain(item.parameters.iter().map(|p| &p.name))
        .collect();
    let allow = allowances(&names);
    let vector = |context: Context, doc: String| {
        let text = mixed::declaration(context, generics, "__ROOT__");
        // Another type of the name is an error here.
        let text = located(with_root(lex(&text), root), name.span(), 0);
        let derives = with_root(lex(&mixed::derives(context, "__ROOT__")), root);
        quote! {
            #[doc = #doc]
            #derives
            #text
        }
    };
    let mut vectors = TokenStream::new();
    if context.layout == Layout::Mixed && item.whole.is_none() {
        let doc = format!(" Coordinates, or momenta, of [`{name}`].");
        vectors.extend(vector(context, doc));
    }
    if let Some(declared) = declared::mixed(definition, context) {
        let doc =
            format!(" Coordinates, or momenta, in the variables that [`{name}`] was declared in.");
        vectors.extend(vector(declared, doc));
    }
    let before = located(quote!(#visibility struct), name.span(), 0);
    let parameters = located(parameters, name.span(), usize::MAX);
    let fields = located(quote!({ #(#fields)* }), name.span(), 0);
    quote! {
        #(#attributes)*
        #docs
        #allow
        #[derive(#root::private::core::clone::Clone, #root::private::core::fmt::Debug)]
        #before #name #parameters #fields
        #vectors
    }
}

/// The scalar of the parameters as readers see it: `P`, unless a const generic has the name.
fn user_scalar(item: &Item, scalar: &str) -> String {
    let mut name = scalar.to_owned();
    while item
        .sizes
        .iter()
        .any(|size| !size.run_time && size.name == name)
    {
        name.push('_');
    }
    name
}

fn struct_field(
    definition: &Definition,
    item: &Item,
    context: Context,
    generics: &Generics,
    field: Field,
) -> TokenStream {
    let root = &definition.root;
    let visibility = &item.visibility;
    match field {
        Field::Size(number) => {
            let size = &item.sizes[number];
            let (name, attributes) = (&size.name, &size.attributes);
            quote! { #(#attributes)* #name: #root::private::SetByNew<#root::private::core::primitive::usize>, }
        }
        Field::Parameter(number) => {
            let parameter = &item.parameters[number];
            let (name, attributes) = (&parameter.name, &parameter.attributes);
            let shape = &context.model.parameters[number].shape;
            let scalar = user_scalar(item, generics.scalars.first().map_or("P", String::as_str));
            // Const generics have the user's names here.
            let sizes: Vec<String> = item
                .sizes
                .iter()
                .map(|size| size.name.to_string())
                .collect();
            let ty = layout::storage(
                shape,
                &scalar,
                Indices { sizes: &sizes },
                context.is_run_time,
                "__ROOT__",
            );
            let ty = with_root(lex(&ty), root);
            let docs = if attributes.is_empty() {
                let text = format!(" Parameter `{name}` of H.");
                quote! { #[doc = #text] }
            } else {
                quote! { #(#attributes)* }
            };
            if layout::is_dynamic(shape, context.is_run_time) {
                quote! { #docs #name: #root::private::SetByNew<#ty>, }
            } else {
                quote! { #docs #visibility #name: #ty, }
            }
        }
    }
}

/// `__ROOT__` replaced by the private module of the facade.
fn with_root(tokens: TokenStream, root: &TokenStream) -> TokenStream {
    use proc_macro2::{Group, TokenTree};
    let mut out = TokenStream::new();
    for token in tokens {
        match token {
            TokenTree::Ident(ident) if ident == "__ROOT__" => out.extend(quote! { #root::private }),
            TokenTree::Group(group) => {
                let inner = with_root(group.stream(), root);
                out.extend([TokenTree::Group(Group::new(group.delimiter(), inner))]);
            }
            token => out.extend([token]),
        }
    }
    out
}

/// Tokens that rustc is to show at the name of the type instead of at the whole definition, with
/// what is inside of groups down to some depth.
pub(super) fn located(tokens: TokenStream, name: Span, depth: usize) -> TokenStream {
    use proc_macro2::{Group, TokenTree};
    let span = Span::call_site().located_at(name);
    let moved = tokens.into_iter().map(|mut token| {
        if let TokenTree::Group(group) = &token
            && depth > 0
        {
            let inner = located(group.stream(), name, depth - 1);
            token = Group::new(group.delimiter(), inner).into();
        }
        token.set_span(span);
        token
    });
    moved.collect()
}

/// H, what is known of it, Hamilton's equations and what they cost, as docs.
fn docs(definition: &Definition, item: &Item, context: Context) -> TokenStream {
    let text = &definition.text;
    let mut doc = String::new();
    if item.attributes.is_empty() {
        let _ = writeln!(doc, "The Hamiltonian system `{}`.\n", item.name);
    }
    let _ = write!(
        doc,
        "\n# Hamiltonian\n\n```text\n{}\n```\n",
        text.hamiltonian
    );
    for fact in &text.facts {
        let _ = write!(doc, "\n{fact}\n");
    }
    if !text.equations.is_empty() {
        let _ = write!(
            doc,
            "\n# Equations of motion\n\n```text\n{}\n```\n",
            text.equations.join("\n")
        );
    }
    let is_forced = definition
        .vectors
        .iter()
        .any(|v| v.usage == VectorUse::Force);
    if is_forced {
        doc.push_str(
            "\nThe declared force is in these equations. Schemes integrate it, and the method `force` gives it.\n",
        );
    }
    if !text.latex.is_empty() {
        let _ = write!(doc, "\n# LaTeX\n\n```text\n{}\n", text.latex);
        for line in &text.latex_equations {
            let _ = writeln!(doc, "{line}");
        }
        doc.push_str("```\n");
    }
    if !text.operations.is_empty() {
        let _ = write!(
            doc,
            "\n# Operations\n\nOf one evaluation, without what parameters alone decide, which is done once a run. \
             A fused multiply–add is two, the sine and cosine of an angle are one.\n\n{}\n",
            text.operations.join("\n")
        );
    }
    if context.is_run_time.contains(&true) {
        doc.push_str("\n# Panics\n\nEvaluation panics on a state that does not have the shape of the system. `check_shape` gives an\nerror instead; runs and starts ask it once.\n");
    }
    quote! { #[doc = #doc] }
}

/// `Display`: the formula of H.
pub fn display(definition: &Definition, generics: &Generics) -> String {
    format!(
        "#[automatically_derived]\nimpl{} __h::core::fmt::Display for {} {{\n\
         fn fmt(&self, _f: &mut __h::core::fmt::Formatter<'_>) -> __h::core::fmt::Result {{ _f.write_str({:?}) }}\n}}\n",
        generics.declaration_without_bounds(),
        generics.system_type(),
        definition.text.hamiltonian,
    )
}

/// Constants, the getters of private fields, observables, derivatives by parameters.
fn inherent(
    definition: &Definition,
    item: &Item,
    context: Context,
    generics: &Generics,
) -> TokenStream {
    let header = lex(&format!(
        "impl{} {}",
        generics.declaration(),
        generics.system_type()
    ));
    let visibility = &item.visibility;
    let methods = observables::methods(definition, context, generics, visibility);
    let vectors = vectors::methods(definition, context, generics, visibility);
    let pieces = pieces(definition, item, generics);
    let new = construct::new(definition, item, context, generics);
    let getters = construct::getters(item, context, generics);
    let derivatives = if item.parameters.is_empty() {
        TokenStream::new()
    } else {
        let bound = lex(&generics.state_bound());
        let state = lex(&dynamics::vector(context, generics, "T", "__h"));
        let result = lex(&generics.system_type_over(&["T".to_owned()]));
        quote! {
            /// ∂H/∂(each parameter) at a state, in the fields of the same type.
            #[must_use]
            #visibility fn parameter_gradient<T: #bound>(&self, state: &__h::State<#state>) -> #result {
                <Self as __h::System<T>>::prepare(self).parameters(state.t, &state.q, &state.p)
            }
        }
    };
    // Nothing in their paths would tell the scalar.
    let (constants, system) = construct::over_f64(generics);
    let untold = lex(&format!("impl{constants} {system}"));
    let latex = &definition.text.latex;
    let equations = definition.text.latex_equations.join("\n");
    quote! {
        #new
        #untold {
            /// H in LaTeX.
            #visibility const LATEX: &'static __h::core::primitive::str = #latex;
            /// Hamilton's equations in LaTeX, one a line.
            #visibility const LATEX_EQUATIONS: &'static __h::core::primitive::str = #equations;
        }
        #header {
            #getters
            #methods
            #vectors
            #pieces
            #derivatives
        }
    }
}

/// The pieces of a split as systems with the same parameters.
fn pieces(definition: &Definition, item: &Item, generics: &Generics) -> TokenStream {
    let (visibility, own) = (&item.visibility, &item.name);
    let fields: Vec<&Ident> = item
        .fields
        .iter()
        .map(|field| match field {
            Field::Size(number) => &item.sizes[*number].name,
            Field::Parameter(number) => &item.parameters[*number].name,
        })
        .collect();
    let mut out = TokenStream::new();
    for (name, ty) in &definition.pieces {
        let method = Ident::new(
            &format!("piece_{}", name.to_string().to_lowercase()),
            name.span(),
        );
        let result = generics
            .system_type()
            .replacen(&own.to_string(), &ty.to_string(), 1);
        let result = lex(&result);
        let text = format!(" The piece `{name}` of the split as a system of its own.");
        out.extend(quote! {
            #[doc = #text]
            #[must_use]
            #visibility fn #method(&self) -> #result {
                #ty { #(#fields: __h::core::clone::Clone::clone(&self.#fields),)* }
            }
        });
    }
    out
}

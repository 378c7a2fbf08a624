//! Proven structure of H as types, and the reasons for the rest.
//!
//! Input: the verdicts. Output: text of the markers' implementations. Invariant: every marker is
//! implemented for every system; one that does not hold has a bound that nothing satisfies,
//! whose message is the reason, so that a scheme that needs it says what couples what.

use crate::emit::names::context::Context;
use crate::emit::types::construct::is_all_defaults;
use hamiltonian_language::analyse::structure::Reason;
use hamiltonian_symbolic::list::IntoList;
use proc_macro2::Ident;
use std::fmt::Write;

/// A piece that cannot exist.
const NEVER: &str = "__h::Never<__h::Point<__h::VectorOf<Self, T>>>";

/// The types of pieces, and their values.
pub type Pieces<'a> = (&'a [String], &'a str);

/// A trait of pieces, each as a type and as a function that returns one of these values, if they are there.
pub fn of_pieces(
    out: &mut String,
    context: Context,
    name: &str,
    names: &[&str],
    pieces: Result<Pieces, (&str, &Reason)>,
) {
    let mut items = String::new();
    for (at, name) in names.iter().enumerate() {
        let (ty, value) = match &pieces {
            Ok((types, value)) => (types[at].as_str(), *value),
            Err(_) => (NEVER, "__h::Never::PIECE"),
        };
        let method = name.to_lowercase();
        let _ = writeln!(
            items,
            "type {name}<T: __h::Real> = {ty};\n#[inline(always)]\nfn {method}<T: __h::Real>() -> Self::{name}<T> {{ {value} }}"
        );
    }
    let declaration = context.generics.declaration();
    marker(out, context, name, &declaration, pieces.err(), &items);
}

/// `QuadraticKinetic`, `Autonomous`, `Unforced`, `Exact`, `ToTolerance`, `Display` and `Default`.
pub fn implementations(context: Context) -> String {
    let (structure, generics) = (&context.definition.structure, context.generics);
    let (mut out, mut known) = (String::new(), String::new());
    let declaration = generics.declaration_without_bounds();
    for (name, bound, verdict) in [
        (
            "QuadraticKinetic",
            "__KineticIsQuadratic",
            &structure.quadratic_kinetic,
        ),
        ("Autonomous", "__HIsAutonomous", &structure.autonomous),
        ("Unforced", "__Forced", &structure.unforced),
        ("Exact", "__NotExact", &structure.exact),
    ] {
        match verdict {
            Ok(()) => known += &format!(" {name}"),
            Err(reason) => {
                let missing = Some((bound, reason));
                marker(&mut out, context, name, &declaration, missing, "");
            }
        }
    }
    let scheme = match (&structure.quadratic_kinetic, &structure.unforced) {
        (Ok(()), Ok(())) => "GaussNystrom",
        _ => "Gauss",
    };
    let _ = writeln!(
        out,
        "impl{} __h::ToTolerance for {} {{ type Scheme = __h::{scheme}<8>; }}",
        generics.declaration(),
        generics.system_type(),
    );
    let text = &context.definition.text;
    let texts = context.definition.checked.item.as_ref().map(|_| {
        let (constants, system) = generics.over_f64();
        let (default, missing) = match (is_all_defaults(context), generics.scalars.is_empty()) {
            (false, _) => (without_default(&mut out, context), ""),
            (true, true) => ("= Self {}".to_owned(), " AnyParameter"),
            (true, false) => (
                "= Self::with_defaults()".to_owned(),
                " ParameterWithoutDefault",
            ),
        };
        known += missing;
        format!(
            " {} [impl{constants}] {system}: {:?}, {:?} {default}",
            generics.visibility,
            text.latex,
            text.latex_equations.join("\n"),
        )
    });
    let _ = writeln!(
        out,
        "__h::known!([impl{declaration}] {}: {:?};{known};{});",
        generics.system_type(),
        text.hamiltonian,
        texts.unwrap_or_default(),
    );
    out
}

/// The bound of `Default` that names what has no default: sizes set at run time, functions and parameters, in the order of
/// the arguments of `new`.
fn without_default(out: &mut String, context: Context) -> String {
    let checked = context.definition.checked;
    let sizes = context
        .run_time_sizes()
        .map(|size| &checked.sizes[size].name);
    let functions = checked.functions.iter().map(|function| &function.name);
    let parameters = checked.parameters.iter().zip(context.definition.defaults);
    let parameters = parameters.filter(|(_, default)| default.is_none());
    let parameters = parameters.map(|(parameter, _)| &parameter.name);
    let kinds: [(&str, Vec<String>); 3] = [
        ("size", sizes.map(Ident::to_string).into_list()),
        ("function", functions.map(Ident::to_string).into_list()),
        ("parameter", parameters.map(Ident::to_string).into_list()),
    ];
    let groups = kinds.iter().filter(|(_, names)| !names.is_empty());
    let groups = groups.map(|(noun, names)| {
        let plural = if names.len() == 1 { "" } else { "s" };
        format!("its {noun}{plural} `{}`", names.join("`, `"))
    });
    let groups = groups.into_list().join(" and ");
    let missing = kinds.each_ref().map(|(_, names)| names.as_slice()).concat();
    let (first, name) = (&missing[0], &context.generics.name);
    let verb = match missing.len() {
        1 => "has",
        _ => "have",
    };
    // Only numbers can have a default.
    let (question, alternative) = match missing.len() == kinds[2].1.len() {
        true => ("", ", or declare a default for each parameter"),
        false if context.has_run_time_sizes() => ("?", ""),
        false => ("", ""),
    };
    let reason = Reason {
        message: format!("`{name}` has no `Default`: {groups} {verb} no default"),
        label: format!("`{first}` has no value"),
        note: format!(
            "write `{name}::new({}){question}`{alternative}",
            missing.join(", ")
        ),
    };
    let bound = format!("__{first}_has_no_default");
    out.push_str("#[allow(non_camel_case_types)]\n");
    reason_trait(out, &bound, &reason);
    format!("? {bound}")
}

/// An implementation of a marker trait. If the trait does not hold, a bound that nothing satisfies carries the reason.
fn marker(
    out: &mut String,
    context: Context,
    name: &str,
    declaration: &str,
    missing: Option<(&str, &Reason)>,
    items: &str,
) {
    let system = context.generics.system_type();
    let condition = match missing {
        None => String::new(),
        Some((bound, reason)) => {
            reason_trait(out, bound, reason);
            format!(" where for<'a> &'a {system}: {bound}")
        }
    };
    let _ = write!(
        out,
        "impl{declaration} __h::{name} for {system}{condition} {{\n{items}}}\n",
    );
}

/// Why rustc goes on to speak of a trait that nobody wrote.
const CARRIER: &str = "the trait that rustc names only carries this message: implement nothing, change H or the scheme";

/// A trait nothing implements. The bound is on references of all lifetimes: that keeps rustc from
/// deciding it where it is written, and from naming the marker instead of the reason.
fn reason_trait(out: &mut String, name: &str, reason: &Reason) {
    let _ = write!(
        out,
        "#[diagnostic::on_unimplemented(message = {:?}, label = {:?}, note = {:?}, note = {CARRIER:?})]\n\
         #[doc(hidden)]\npub trait {name} {{}}\n",
        escaped(&reason.message),
        escaped(&reason.label),
        escaped(&reason.note),
    );
}

/// A text in which braces would be placeholders.
fn escaped(text: &str) -> String {
    text.replace('{', "{{").replace('}', "}}")
}

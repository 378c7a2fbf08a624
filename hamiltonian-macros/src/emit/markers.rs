//! Proven structure of H as types, and the reasons for the rest.
//!
//! Input: the verdicts. Output: text of the markers' implementations. Invariant: every marker is
//! implemented for every system; one that does not hold asks for a bound that nothing satisfies,
//! whose message is the reason, so that a scheme that needs it says what couples what.

use super::generics::Generics;
use super::{Reason, Structure};
use std::fmt::Write;

/// A piece that cannot exist.
const NEVER: &str = "__h::Never<__h::Point<<Self as __h::System<T>>::Vector>>";

/// `Separable`, `Nystrom` and `Split` where they do not hold, `QuadraticKinetic`, `Autonomous` and `Cyclic`.
pub fn implementations(structure: &Structure, generics: &Generics) -> String {
    let mut out = String::new();
    let system = generics.system_type();
    let panic = |reason: &Reason| {
        let message = reason.message.replace('{', "{{").replace('}', "}}");
        format!("__h::core::panic!({message:?})")
    };
    let pair = |[first, second]: [(&str, &str); 2], reason: &Reason| {
        let panic = panic(reason);
        format!(
            "type {0} = {NEVER};\ntype {1} = {NEVER};\n\
             const {2}: Self::{0} = {panic};\nconst {3}: Self::{1} = {panic};\n",
            first.0, second.0, first.1, second.1,
        )
    };
    if let Err(reason) = &structure.separable {
        let items = pair([("Kick", "KICK"), ("Drift", "DRIFT")], reason);
        missing(
            &mut out,
            "Separable",
            "__HIsSeparable",
            reason,
            &items,
            generics,
        );
    }
    if let Err(reason) = &structure.nystrom {
        let items = pair([("Kick", "KICK"), ("Quadratic", "QUADRATIC")], reason);
        missing(
            &mut out,
            "Nystrom",
            "__HIsKickedQuadratic",
            reason,
            &items,
            generics,
        );
    }
    if let Err(reason) = &structure.split {
        let items = format!(
            "type Pieces = {NEVER};\nconst PIECES: Self::Pieces = {};\n\
             const NAMES: &'static [&'static __h::core::primitive::str] = &[];\n",
            panic(reason),
        );
        missing(&mut out, "Split", "__HIsSplit", reason, &items, generics);
    }
    marker(
        &mut out,
        "QuadraticKinetic",
        "__KineticIsQuadratic",
        &structure.quadratic_kinetic,
        generics,
    );
    marker(
        &mut out,
        "Autonomous",
        "__HIsAutonomous",
        &structure.autonomous,
        generics,
    );
    for (name, bound, verdict) in [
        ("Unforced", "__Forced", &structure.unforced),
        ("Exact", "__NotExact", &structure.exact),
    ] {
        marker(&mut out, name, bound, verdict, generics);
    }
    let _ = write!(
        out,
        "#[automatically_derived]\nimpl{} __h::Cyclic for {system} {{\n\
         const CYCLIC: &'static [&'static __h::core::primitive::str] = &{:?};\n}}\n",
        generics.declaration_without_bounds(),
        structure.cyclic,
    );
    out
}

/// A trait over the scalar that does not hold, with the items it would have.
fn missing(
    out: &mut String,
    name: &str,
    bound: &str,
    reason: &Reason,
    items: &str,
    generics: &Generics,
) {
    reason_trait(out, bound, reason);
    let system = generics.system_type();
    let _ = write!(
        out,
        "#[automatically_derived]\n\
         impl{} __h::{name}<T> for {system} where for<'a> &'a {system}: {bound} {{\n{items}}}\n",
        generics.declaration_with_scalar(),
    );
}

/// A marker without items.
fn marker(
    out: &mut String,
    name: &str,
    bound: &str,
    verdict: &Result<(), Reason>,
    generics: &Generics,
) {
    let system = generics.system_type();
    let condition = match verdict {
        Ok(()) => String::new(),
        Err(reason) => {
            reason_trait(out, bound, reason);
            format!(" where for<'a> &'a {system}: {bound}")
        }
    };
    let _ = write!(
        out,
        "#[automatically_derived]\nimpl{} __h::{name} for {system}{condition} {{}}\n",
        generics.declaration_without_bounds(),
    );
}

/// Why rustc goes on to speak of a trait that nobody wrote.
const CARRIER: &str = "the trait that rustc names only carries this message: implement nothing, change H or the scheme";

/// A trait nothing implements. It is asked of references of all lifetimes: that keeps rustc from
/// deciding the bound where it is written, and from speaking of the marker instead of the reason.
fn reason_trait(out: &mut String, name: &str, reason: &Reason) {
    // Braces are placeholders in these texts.
    let escape = |text: &str| text.replace('{', "{{").replace('}', "}}");
    let _ = write!(
        out,
        "#[diagnostic::on_unimplemented(message = {:?}, label = {:?}, note = {:?}, note = {CARRIER:?})]\n\
         #[doc(hidden)]\npub trait {name} {{}}\n",
        escape(&reason.message),
        escape(&reason.label),
        escape(&reason.note),
    );
}

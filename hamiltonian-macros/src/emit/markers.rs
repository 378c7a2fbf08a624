//! What was proven about H, as types, and what was not, with the reason.
//!
//! Input: the verdicts. Output: text of the markers' implementations. Invariant: every marker is
//! implemented for every system; one that does not hold asks for a bound that nothing satisfies,
//! whose message is the reason, so that a scheme that needs it says what couples what.

use super::Structure;
use super::generics::Generics;
use std::fmt::Write;

/// A piece that cannot exist.
const NEVER: &str = "__h::Never<__h::Point<<Self as __h::System<T>>::Vector>>";

/// `Separable` and `Split` where they do not hold, `QuadraticKinetic`, `Autonomous` and `Cyclic`.
pub fn implementations(structure: &Structure, generics: &Generics) -> String {
    let mut out = String::new();
    let system = generics.system_type();
    if let Err(reason) = &structure.separable {
        reason_trait(&mut out, "__HIsSeparable", reason);
        let _ = write!(
            out,
            "#[automatically_derived]\n\
             impl{generics} __h::Separable<T> for {system} where for<'a> &'a {system}: __HIsSeparable {{\n\
             type Kick = {never};\ntype Drift = {never};\n\
             const KICK: Self::Kick = __h::core::panic!({message:?});\n\
             const DRIFT: Self::Drift = __h::core::panic!({message:?});\n}}\n",
            generics = generics.declaration_with_scalar(),
            never = NEVER,
            message = reason.message.replace('{', "{{").replace('}', "}}"),
        );
    }
    if let Err(reason) = &structure.split {
        reason_trait(&mut out, "__HIsSplit", reason);
        let _ = write!(
            out,
            "#[automatically_derived]\n\
             impl{generics} __h::Split<T> for {system} where for<'a> &'a {system}: __HIsSplit {{\n\
             type Pieces = {NEVER};\n\
             const PIECES: Self::Pieces = __h::core::panic!({message:?});\n\
             const NAMES: &'static [&'static __h::core::primitive::str] = &[];\n}}\n",
            generics = generics.declaration_with_scalar(),
            message = reason.message.replace('{', "{{").replace('}', "}}"),
        );
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

/// A marker without items.
fn marker(
    out: &mut String,
    name: &str,
    bound: &str,
    verdict: &Result<(), super::Reason>,
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
fn reason_trait(out: &mut String, name: &str, reason: &super::Reason) {
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

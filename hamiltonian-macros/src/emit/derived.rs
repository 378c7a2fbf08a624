//! Functions of large systems that are made from the gradient at run time instead of being written
//! out, so that the code rustc reads grows with H once and not nine times.
//!
//! Input: a purpose without a function of its own. Output: the text of its body. Invariant: no
//! memory is allocated: the vectors of such systems have no size set at run time.

use super::generics::Generics;
use hamiltonian_symbolic::program::Purpose;

/// The body of a method of prepared systems whose function is not in the program; `third` is the Rust function of which
/// a third derivative would be needed.
pub fn body(purpose: Purpose, third: Option<&str>) -> String {
    const CALL: &str = "<Self as __h::Dynamics<T>>::energy_and_gradient(self, _t, _q, _p,";
    match purpose {
        Purpose::Gradient => format!("let _ = {CALL} _oq, _op);"),
        Purpose::GradientQ => {
            format!("let mut _x = *_oq;\nlet _ = {CALL} _oq, &mut _x);")
        }
        Purpose::GradientP => {
            format!("let mut _x = *_op;\nlet _ = {CALL} &mut _x, _op);")
        }
        Purpose::HessianVector => refusal(&third.map_or_else(
            || "the second derivatives of H were not derived".to_owned(),
            |function| {
                format!(
                    "the second derivatives of H have a third derivative of `{function}` in them, and Rust functions have \
                     two; Newton's iteration of schemes with stages, such as `Gauss`, and `TimeTransformed` need them; \
                     help: write it in the language: `let {function}(x) = …`"
                )
            },
        )),
        _ => refusal("this function of the system was not derived"),
    }
}

/// A compile error where a function is used, and nowhere else.
fn refusal(message: &str) -> String {
    format!("const {{ __h::core::panic!({message:?}) }}")
}

/// The expression that makes the field for coefficient `_c`.
pub const FLOW: &str = "__Field { prepared: __h::core::clone::Clone::clone(_self), c: _c }";

/// The field: a gradient, then two accumulations.
pub fn flow(generics: &Generics, vector: &str) -> String {
    let (declaration, visibility) = (generics.holder_declaration(), &generics.visibility);
    let [prepared, field] = ["__Prepared", "__Field"].map(|name| generics.holder_type(name));
    format!(
        "#[doc(hidden)]\n#[derive(__h::core::clone::Clone, __h::core::fmt::Debug)]\n\
         {visibility} struct __Field{declaration} {{ prepared: {prepared}, c: T }}\n\
         #[automatically_derived]\nimpl{declaration} __h::VectorField<{vector}> for {field} {{\n\
         #[inline(always)]\nfn add(&self, _t: T, _q: &{vector}, _p: &{vector}, _oq: &mut {vector}, _op: &mut {vector}) {{\n\
         let (mut _x, mut _y) = (*_oq, *_op);\n\
         let _ = __h::Dynamics::energy_and_gradient(&self.prepared, _t, _q, _p, &mut _x, &mut _y);\n\
         __h::Vector::accumulate(_oq, self.c, &_y);\n\
         __h::Vector::accumulate(_op, -self.c, &_x);\n}}\n}}\n"
    )
}

//! Functions of large systems that are made from the gradient at run time instead of being written
//! out, so that the code rustc reads grows with H once and not nine times.
//!
//! Input: a purpose without a function of its own. Output: the text of its body. Invariant: no
//! memory is allocated: the vectors of such systems have no size set at run time.

use hamiltonian_symbolic::program::Purpose;

/// The body of a method of prepared systems whose function is not in the program.
pub fn body(purpose: Purpose) -> String {
    const CALL: &str = "<Self as __h::Dynamics<T>>::energy_and_gradient(self, _t, _q, _p,";
    match purpose {
        Purpose::Gradient => format!("let _ = {CALL} _oq, _op);"),
        Purpose::GradientQ => {
            format!("let mut _x = *_oq;\nlet _ = {CALL} _oq, &mut _x);")
        }
        Purpose::GradientP => {
            format!("let mut _x = *_op;\nlet _ = {CALL} &mut _x, _op);")
        }
        // A compile error where the function is used, and nowhere else.
        _ => "const { __h::core::panic!(\"this function of the system was not derived\") }"
            .to_owned(),
    }
}

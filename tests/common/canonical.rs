//! Numbers that are equal up to rounding.

use hamiltonian::Vector;

#[track_caller]
pub fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-12 * (1.0 + a.abs()), "{a} is not {b}");
}

#[track_caller]
pub fn equal<V: Vector<Scalar = f64>>(a: &V, b: &V) {
    assert_eq!(a.len(), b.len());
    for k in 0..a.len() {
        close(a.component(k), b.component(k));
    }
}

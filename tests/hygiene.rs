//! Emitted code in hostile surroundings: warnings denied, names of the language and of
//! the library taken, the library under another name.
#![deny(
    warnings,
    missing_docs,
    missing_debug_implementations,
    unused_qualifications
)]
#![deny(
    unreachable_pub,
    unused_results,
    explicit_outlives_requirements,
    unnameable_types
)]
#![deny(clippy::all, clippy::pedantic)]
#![forbid(unsafe_code)]

use mechanics::System;

/// A library that re-exports this one.
mod physics {
    pub(crate) use mechanics as analytical;
}

/// Every name that emitted code could have meant.
#[allow(
    dead_code,
    non_camel_case_types,
    non_upper_case_globals,
    clippy::all,
    clippy::pedantic
)]
mod shadow {
    pub(crate) struct f64;
    pub(crate) struct usize;
    pub(crate) struct str;
    pub(crate) struct Option;
    pub(crate) struct Result;
    pub(crate) struct Ok;
    pub(crate) struct Vec;
    pub(crate) struct String;
    pub(crate) trait Clone {}
    pub(crate) trait Debug {}
    pub(crate) trait Default {}
    pub(crate) trait Copy {}
    pub(crate) trait Real {}
    pub(crate) trait System {}
    pub(crate) struct T;
    pub(crate) struct P;
    pub(crate) struct SVector;
    pub(crate) struct Prepared;
    pub(crate) mod core {}
    pub(crate) mod std {}
    pub(crate) mod private {}
    pub(crate) const q: i32 = 1;
    pub(crate) const p: i32 = 1;
    pub(crate) const t: i32 = 1;
    pub(crate) const v: i32 = 1;
    pub(crate) const c: i32 = 1;
    pub(crate) const of: i32 = 1;
    pub(crate) const other: i32 = 1;
    pub(crate) static M: i32 = 1;
    pub(crate) static i: i32 = 1;
}

/// Systems among the shadows.
pub mod systems {
    #[allow(unused_imports)]
    use super::shadow::*;

    mechanics::hamiltonian! {
        /// Scalars, a name in capitals, a constant of the user's with a parameter's name.
        pub struct Scalars { M, G = 9.81 }
        H(x, y; p_x, p_y; t) = (p_x^2 + p_y^2)/(2*M) - M*G*y + 3.14159*sin(pi*t)*x;
        monitor L_z = x*p_y - y*p_x
    }

    super::physics::analytical::hamiltonian! {
        /// A type of the name that is usually the scalar's.
        pub struct P { k = 1.0 }
        H = p^2/2 + k*q^2/2
    }

    super::physics::analytical::hamiltonian! {
        /// A loop with a const generic of the name that is usually the scalar's.
        pub struct Ring<const P: usize> { T = 1.0 }
        H(q[P]; p[P]) = sum(i in 0..P) { p[i]^2/2 + T*exp(q[i] - q[(i + 1) % P]) }
    }

    mechanics::hamiltonian! {
        /// A size of run time.
        pub struct Bodies { n: usize, m: [n] }
        H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) + norm(q[i]) }
    }

    mechanics::hamiltonian! {
        /// Mixed shapes.
        pub(crate) struct Mixed { w: [3][3] }
        H(x, q[3]; y, p[3]) = x^2 + y^2 + dot(q, w*p)
    }

    mechanics::hamiltonian! {
        /// More parameters than a function written by hand should have arguments.
        pub struct Eighth { c1, c2, c3, c4, c5, c6, c7, c8 }
        H = c1*p^2 + c2*q^2 + c3*q^3 + c4*q^4 + c5*q^5 + c6*q^6 + c7*q^7 + c8*q^8
    }
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-15, "{a} is not {b}");
}

#[test]
fn systems_among_shadows() {
    let state = mechanics::State::new([1.0, 0.0], [0.0, 2.0]);
    close(systems::Scalars::new(2.0).L_z(&state), 2.0);
    let state = mechanics::State::new([1.0], [1.0]);
    close(systems::P::default().energy(&state), 1.0);
    let ring = systems::Ring::<1>::default();
    close(ring.energy(&state), 1.5);
    assert!(systems::Bodies::new(1, std::vec![1.0]).is_ok());
    let eighth = systems::Eighth::new(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0);
    close(eighth.energy(&state), 8.0);
    let vector = systems::MixedVector::new(1.0, [1.0, 0.0, 0.0]);
    let mixed = systems::Mixed::new([[1.0; 3]; 3]);
    let state = mechanics::State::new(vector, vector);
    close(mixed.energy(&state), 3.0);
}

#[test]
fn values_and_types_inside_functions() {
    #[allow(unused_imports)]
    use mechanics::prelude::*;
    let (m, k) = (2.0, 3);
    let value = hamiltonian! { H(x; p) = p^2/(2*m) + k*x^2/2 + pi; monitor square = x^2 };
    let state = State::new([1.0], [2.0]);
    close(value.energy(&state), 2.5 + core::f64::consts::PI);
    close(value.square(&state), 1.0);
    let mixed = hamiltonian! { H(x, q[3]; y, p[3]) = x^2 + y^2 + m*dot(q, p) };
    let (q, p) = (
        mixed.vector(1.0, [1.0, 2.0, 3.0]),
        mixed.vector(1.0, [1.0, 0.0, 0.0]),
    );
    close(mixed.energy(&State::new(q, p)), 4.0);
    hamiltonian! { struct Local { a = 1.0 } H = p^2/2 + a*q^2/2 }
    close(Local::default().energy(&State::new([1.0], [1.0])), 1.0);
}

/// Types with the names of the prelude.
mod named_like_the_prelude {
    use mechanics::prelude::*;

    hamiltonian! {
        /// The name of the trait whose methods it has.
        struct System { a = 1.0 }
        H = p^2/2 + a*q^2/2
    }

    #[test]
    fn methods_are_found() {
        let state = State::new([1.0], [1.0]);
        super::close(System::default().energy(&state), 1.0);
    }
}

//! Hamiltonian systems from one line of mathematics, integrated with structure-preserving schemes.
//!
//! The macro [`hamiltonian!`] checks and differentiates a Hamiltonian H(q, p) at compile time. An [`Integrator`] runs
//! the system from a start, with a scheme and a step.
//!
//! ```
//! use hamiltonian::prelude::*;
//!
//! hamiltonian! {
//!     /// A planar pendulum.
//!     pub struct Pendulum {
//!         /// Mass of the bob.
//!         m = 1.0,
//!         l = 10.0,
//!         g = 9.81,
//!     }
//!     H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)
//! }
//!
//! let pendulum = Pendulum { l: 2.0, ..Default::default() };
//! let start = State::new([std::f64::consts::FRAC_PI_4], [0.0]);
//! let mut run = Integrator::new(&pendulum, StormerVerlet::default(), start, 1e-3)?;
//! run.advance(1_000)?;
//! println!("{}", run.state().q[0]);
//! # Ok::<(), Error>(())
//! ```
//!
//! | module | contents |
//! |---|---|
//! | [`prelude`] | the names that most programs need |
//! | [`language`] | the reference of the macro |
//! | [`schemes`] | the list of schemes |
//! | [`observers`] | what a run can record |
//! | [`results`] | tables, saved runs and stores |
//! | [`analysis`] | Lyapunov exponents, periodic orbits, starts on a surface |
//! | [`systems`] | functions with data, coordinates of bodies |
//! | [`errors`] | the phases of [`Error`] |
//! | `plot` | pictures of results, with the feature `plot` |
//! | [`gallery`] | the pictures of the examples |
//!
//! | feature | |
//! |---|---|
//! | `std` (default) | ensembles on threads, files, the features of the CPU; without it the crate is `no_std` with `alloc` |
//! | `rayon` (default) | one run on several threads |
//! | `linear-algebra` | norms and decompositions of vectors and matrices, by nalgebra |
//! | `progress` | a progress bar as an observer |
//! | `plot` | pictures of results, as SVG |
//! | `serde` | states, parameters, functions with data, tables and saved runs that serde reads and writes |
//!
//! The package is `hamiltonian-dynamics`, the library in it `hamiltonian`.
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

// Beside pictures, this crate has no code of its own: it joins the macro and the library under one name, also in a program
// that renames the dependency.

pub use hamiltonian_core::*;

#[doc(inline)]
pub use hamiltonian_lanes as lanes;

/// The linear algebra that vectors are stored in. Norms and decompositions (`state.q.norm()`) need
/// the feature `linear-algebra`; sums, products and `dot` do not.
#[doc(no_inline)]
pub use hamiltonian_core::nalgebra;

/// The only paths that code emitted by [`hamiltonian!`] names.
#[doc(hidden)]
pub use hamiltonian_core::private;

#[doc(hidden)]
pub use hamiltonian_macros as __private_macros;

#[cfg(feature = "plot")]
pub mod plot;

/// The names that a program needs to define and run systems.
pub mod prelude {
    pub use crate::hamiltonian;
    pub use hamiltonian_core::prelude::*;
}

/// Defines a Hamiltonian system: a type with named parameters, or a value.
///
/// ```
/// use hamiltonian::prelude::*;
///
/// // Expression form: a value. Other names are captured from scope.
/// let (m, k) = (1.0, 4.0);
/// let spring = hamiltonian! { H(x; p_x) = p_x^2/(2*m) + k*x^2/2 };
/// assert_eq!(spring.energy(&State::new([0.5], [1.0])), 1.0);
///
/// // Item form: a documented type.
/// hamiltonian! {
///     /// An oscillator driven at frequency `omega`.
///     pub struct Driven { a = 0.1, omega = 1.0 }
///     let U(r) = r^2/2 + r^4/4;
///     H(q; p; t) = p^2/2 + U(q) - a*q*cos(omega*t);
///     monitor power = -a*p*cos(omega*t)
/// }
/// let driven = Driven { a: 0.2, ..Default::default() };
/// assert_eq!(driven.power(&State::new([0.0], [1.0])), -0.2);
/// ```
///
/// The input is a list of statements, separated by `;`. `H = …` is short for `H(q; p) = …`. Numbers are exact until
/// code is emitted, and `^` is power. The equations of motion are dq/dt = ∂H/∂p and dp/dt = −∂H/∂q.
/// [`language`](crate::language) describes every statement.
#[macro_export]
macro_rules! hamiltonian {
    ($($definition:tt)*) => {
        $crate::__private_macros::hamiltonian_impl! { ($crate) $($definition)* }
    };
}

/// The value of an expression form. Its name is read where the form stands in the place of an item:
/// rustc then says that "the usage of" this macro "is likely invalid in item context".
#[doc(hidden)]
#[macro_export]
macro_rules! __an_item_needs_pub_struct_Name_first {
    ($($value:tt)*) => { $($value)* };
}

/// The language of [`hamiltonian!`](crate::hamiltonian), construct by construct: a chapter of the book.
///
/// [Exact flows]: crate::Split
/// [list of schemes]: crate::schemes
///
#[doc = include_str!("../book/src/language.md")]
pub mod language {}

/// Makes the page of the pictures. They are read for documentation alone, so that no build stores them.
#[cfg(doc)]
macro_rules! gallery {
    ($($name:ident $caption:literal)*) => {
        /// The pictures of the examples. In a clone of the repository, `cargo run --release --example NAME` makes those
        /// of one example.
        $(
            #[doc = ""]
            #[doc = concat!("# ", stringify!($name), "\n\n", $caption, "\n\n<div style=\"overflow-x:auto\">")]
            #[doc = include_str!(concat!("../book/src/images/", stringify!($name), ".svg"))]
            #[doc = "</div>"]
        )*
        pub mod gallery {}
    };
}

#[cfg(doc)]
gallery! {
    henon_heiles "The section x = 0 of the Hénon–Heiles system at one energy: each orbit in one colour."
    kerr "A section of the torus that an orbit round a rotating black hole fills; the horizon is on the left."
    driven_pendulum "A pendulum whose pivot shakes: hanging, upside down, and the chaotic sea between."
    double_pendulum "Two double pendulums that start almost alike."
    dipole "A particle in the radiation belt: gyration, bounce and mirror points."
    fput "Fermi, Pasta, Ulam and Tsingou: the energy returns to the first mode."
    nbody_eight "Three bodies on a figure eight."
    nbody_collapse "A ball of stars collapses and ejects a few of them."
    stars "Two clusters of 5000 stars after their first passage; each star attracts all others."
    chaos_map "MEGNO of 40 000 orbits of the Hénon–Heiles system: islands of regular orbits in the chaotic sea."
    phi4 "The φ⁴ field at four times, from top to bottom: a bent kink and antikink meet and leave a shrinking bubble."
    breather "A ring of the sine-Gordon field at four times: it shrinks to a point and spreads again."
    basins "Basins of attraction of the three periodic orbits of a damped, driven pendulum."
    mixing "Stars of one energy in a rotating bar at t = 5: the colours show on which side each began."
    nls "A wave on a ring of 32 waveguides breaks up into peaks."
    rigid_body "The path of the axis of Kowalevski's top, seen from above."
    schwarzschild "Orbits round a black hole, without and with a magnetic field about it."
    solar_system "The resonance angle of Neptune and Pluto, which complete three and two orbits in the same time."
    sweep "The momenta at t = 100 of 8000 pendulums whose support moves, let go at rest at different angles."
    three_body "Arenstorf's orbit round the Earth and the Moon, in the frame that turns with them."
    toda "Two solitons on a ring of 200 particles: the faster one overtakes."
    vortices "Paths of four point vortices, each moved by the others."
    wisdom_holman "Change of H for the outer planets in steps of a third of a year, with and without Kepler orbits as pieces of H."
    paper_pendulum "The paper's figure 1: its schemes 1 and 2 make H of a pendulum oscillate; (29) hardly changes it."
    paper_short "The paper's figure 2: its schemes on H = ½(q²+1)(p²+1), to t = 1."
    paper_long "The paper's schemes on H = ½(q²+1)(p²+1), in a longer run than the paper's: its explicit schemes do not preserve H."
    paper_far "The same H to t = 10⁵: exact flows and the implicit midpoint rule keep H, the paper's schemes do not."
    work_precision_34 "Equation (34): the change of H against the CPU time for one unit of time; numbers at curves are orders."
    work_precision_schwarzschild "An orbit round a black hole: the change of H against the CPU time for one unit of time."
}

#[doc = include_str!("../README.md")]
#[cfg(doctest)]
struct Readme;

/// The chapters of the book, whose listings are programs that the tests compile and run.
#[cfg(doctest)]
mod book {
    /// One chapter a type.
    macro_rules! chapters {
        ($($Name:ident $file:literal)*) => {
            $(
                #[doc = include_str!(concat!("../book/src/", $file))]
                struct $Name;
            )*
        };
    }
    chapters! {
        FirstSteps "first-steps.md"
        Pendulum "tour/pendulum.md"
        Chaos "tour/chaos.md"
        Planets "tour/planets.md"
        Lattices "tour/lattices.md"
        Charges "tour/charges.md"
        BlackHole "tour/black-hole.md"
        Sphere "tour/sphere.md"
        Lagrangian "tour/lagrangian.md"
        ManyPendulums "tour/sweep.md"
        Sensitivities "tour/sensitivities.md"
        Studies "studies.md"
        Schemes "schemes.md"
        ExactFlows "exact-flows.md"
        Observers "observers.md"
        Restart "restart.md"
        Embedding "embedding.md"
        Ensembles "ensembles.md"
        Extending "extending.md"
        Troubleshooting "troubleshooting.md"
    }
}

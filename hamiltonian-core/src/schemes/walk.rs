//! Walks through the schemes that a kind of system can be integrated with: a [`Visitor`] is called with each of them.
//!
//! ```
//! use hamiltonian::prelude::*;
//! use hamiltonian::schemes::walk::{Visitor, visit_split};
//! use hamiltonian::{Scheme, StateOf};
//!
//! hamiltonian! {
//!     /// A product that does not separate, and splits.
//!     pub struct Coupled {}
//!     H = (q^2 + 1)*(p^2 + 1)/2
//! }
//!
//! /// Prints the change of H of each scheme.
//! struct Compare;
//!
//! impl Visitor<Coupled> for Compare {
//!     fn visit<M: Scheme<Coupled>>(&mut self, scheme: M) {
//!         let name = scheme.entry().name;
//!         let start: StateOf<Coupled> = State::new([0.0], [1.0]);
//!         let run = Integrator::new(&Coupled {}, scheme, start, 0.01).unwrap();
//!         let mut run = run.observe(EnergyDrift::new());
//!         run.advance(100).unwrap();
//!         println!("{name}: {:.1e}", run.observer().max_relative());
//!     }
//! }
//! visit_split(&mut Compare);
//! ```

pub use super::catalogue::{
    Visitor, visit_any, visit_compensated, visit_doubled, visit_energy, visit_exact,
    visit_implicit, visit_nystrom, visit_quadratic, visit_separable, visit_split,
    visit_transformed, visit_unforced,
};

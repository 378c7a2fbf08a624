//! Hamiltonian systems that are defined at run time: from a text to a system that every scheme of `hamiltonian` runs.
//!
//! ```
//! use hamiltonian::prelude::*;
//! use hamiltonian_runtime::Definition;
//!
//! let text = "struct HenonHeiles { lambda = 1.0 }
//!     H(x, y; px, py) = (px^2 + py^2)/2 + (x^2 + y^2)/2 + lambda*(x^2*y - y^3/3)";
//! let definition = Definition::parse(text, "henon_heiles.txt")?;
//! let system = definition.system([("lambda", 0.5)])?;
//!
//! let start = State::new(vec![0.0, 0.1], vec![0.5, 0.0]);
//! let mut run = Integrator::new(&system, BlanesMoan4, start, 0.1)?.observe(EnergyDrift::new());
//! run.advance(1000)?;
//! assert!(run.observer().max_relative() < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # From a text to a step
//!
//! text → [`Definition`] → [`RuntimeSystem`] → a run of `hamiltonian`.
//!
//! 1. [`Definition::parse`] reads the text, proves its statements and derives its programs, by the same code as the macro:
//!    `read` and `analyse` of hamiltonian-language. Errors are [`Diagnostics`].
//! 2. [`Definition::system`] takes the sizes and makes each program flat code (`flatten`): operations on numbered
//!    registers, in which values that are not needed at the same time share one (`allocate`). Indices are forms over the
//!    variables of loops. The code is the same for all parameters, so systems of the same sizes share it.
//! 3. `System::prepare` computes, over any scalar, the numbers that depend on parameters alone: [`Prepared`]. A flow or a
//!    field computes those of its step coefficient when it is made.
//! 4. An evaluation copies the numbers it holds into registers, its flow's or those on the stack, and runs the operations in
//!    one loop (`machine`).
//!    The scalar is `f64`, a dual number, a pack of members or of stages. Each operation is that of `interpret` of
//!    hamiltonian-symbolic, in the same order, so the bits are those of compiled code that does not fuse.
//!
//!    The flows of a splitting, if they are short, are unrolled (`unroll`, `interleave`), and made one after the other with the
//!    point in the registers of a frame (`frame`), for as many steps as nobody looks at (`cycle`); those of few operations are
//!    one code (`joined`), in which operations follow those that they wait for (`chain`). Fields of longer code are evaluated
//!    in a frame too.
//!
//! [`Run`] and [`Swarm`] are core's runs and ensembles behind a trait object, so that a text names the scheme. A splitting is a
//! table of run time (`by_table`), and all of them have one map.
//!
//! One type stands for all definitions. So it has every marker (`Separable`, `Split` …), and its
//! [`Description`](hamiltonian_core::schemes::author::Description) lists those that do not hold, each with the reason. A run
//! compares them with what its scheme requires.
#![forbid(unsafe_code)]

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

mod allocate;
mod beside;
mod by_lanes;
mod by_table;
mod chain;
mod code;
mod command;
mod cycle;
mod definition;
mod diagnostics;
mod dynamics;
mod erased;
mod error;
mod flatten;
mod flow;
mod folded;
mod frame;
mod in_frame;
mod interleave;
mod joined;
mod machine;
mod many;
mod matrix;
mod names;
mod nests;
mod op;
mod prepared;
mod registers;
mod run;
mod schemes;
mod sizes;
mod starts;
mod swarm;
mod sweep;
mod system;
mod tabulated;
mod tiles;
mod unroll;
mod values;
mod variables;
mod watching;
mod weights;
mod words;

pub use beside::PartWork;
pub use command::command;
pub use definition::Definition;
pub use diagnostics::{Diagnostic, Diagnostics, Place};
pub use error::{RunError, SystemError};
pub use flow::{Field, Inside, PartFlow};
pub use prepared::Prepared;
pub use run::{Crossing, FlatState, Run};
pub use schemes::{NamedScheme, scheme_of_members, schemes};
pub use swarm::{MemberStates, Swarm};
pub use sweep::NamedSweep;
pub use system::{RuntimePiece, RuntimePieces, RuntimeSystem};
pub use tabulated::Tabulated;
pub use values::{Value, Values};
pub use variables::Coordinates;

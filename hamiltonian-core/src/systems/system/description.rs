//! The description of a system, as a value: names, formulas, and facts about H for which no code is specialised.
//!
//! Input: nothing. Output: [`Description`], which [`System`](super::System) and its prepared form return. Invariant: all
//! texts and lists are borrowed for ever or owned, so a system made at run time has one as well as a compiled one.

use crate::errors::ObservableError;
use alloc::borrow::Cow;
use alloc::string::String;
use alloc::vec::Vec;

/// A text that is a constant of the program or owned.
pub type Text = Cow<'static, str>;

/// One declared coordinate, a number or an array: `q`, `x[N]`, `q[n][3]`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// The coordinate's name.
    pub coordinate: Text,
    /// The name of the conjugate momentum.
    pub momentum: Text,
    /// 0 for a scalar, 1 for `[N]`, 2 for `[N][c]`, the number of axes of a [`Lattice`](crate::Lattice).
    pub rank: usize,
    /// The part of the [`Vector`](crate::Vector) that holds the group, and
    pub part: usize,
    /// the index of its first component in that part.
    pub offset: usize,
    /// The last extent of a rank-2 group that is stored column after column; 1 otherwise.
    pub columns: usize,
}

impl Group {
    /// A scalar coordinate and its momentum, at an index of the first part.
    #[must_use]
    pub const fn scalar(coordinate: &'static str, momentum: &'static str, offset: usize) -> Self {
        Group {
            coordinate: Cow::Borrowed(coordinate),
            momentum: Cow::Borrowed(momentum),
            rank: 0,
            part: 0,
            offset,
            columns: 1,
        }
    }

    /// An array of coordinates and that of its momenta, which are a part of the [`Vector`](crate::Vector) each: its
    /// number of axes, the number of the part, and the last extent if it has two axes (1 otherwise).
    #[must_use]
    pub const fn array(
        coordinate: &'static str,
        momentum: &'static str,
        rank: usize,
        part: usize,
        columns: usize,
    ) -> Self {
        Group {
            coordinate: Cow::Borrowed(coordinate),
            momentum: Cow::Borrowed(momentum),
            rank,
            part,
            offset: 0,
            columns,
        }
    }
}

/// The declaration of a named function of (t, q, p).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ObservableKind {
    /// `monitor name = e`
    Monitor,
    /// `invariant name = e`, proven at compile time or assumed by its author
    Invariant,
    /// `event name = e`
    Event,
}

/// A named scalar function of (t, q, p). A function with vector values has one entry for each component.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Observable {
    /// The declared name, with the component in brackets for vectors: `angular_momentum[2]`.
    pub name: Text,
    /// Its declaration.
    pub kind: ObservableKind,
    /// True if t is in it.
    pub depends_on_time: bool,
    /// True if it reads coordinates, and the same for momenta.
    pub reads: [bool; 2],
}

impl Observable {
    /// An observable that may read all coordinates and momenta, but not the time.
    #[must_use]
    pub const fn new(kind: ObservableKind, name: &'static str) -> Self {
        Observable {
            name: Cow::Borrowed(name),
            kind,
            depends_on_time: false,
            reads: [true; 2],
        }
    }
}

/// A piece of H, or of the force, whose flow a splitting composes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedPiece {
    /// Its name in `split { … }`, otherwise its formula; `force` for a force apart from a kick.
    pub name: Text,
    /// Its formula, by which saved runs recognise it.
    pub formula: Text,
    /// True if it jumps at times that do not depend on the state, see [`Description::jumps`].
    pub jumps: bool,
}

impl NamedPiece {
    /// A piece that does not jump in time, with its name as the formula.
    #[must_use]
    pub const fn new(name: &'static str) -> Self {
        NamedPiece {
            name: Cow::Borrowed(name),
            formula: Cow::Borrowed(name),
            jumps: false,
        }
    }
}

/// A property that schemes require and that H is not proven to have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Missing {
    /// The name of its trait: `Separable`, `Split`, `Nystrom`, `QuadraticKinetic`, `Autonomous`, `Unforced`, `Exact`.
    pub marker: Text,
    /// The reason: `` H of `Coupled` is not separable: the term `p*q` couples q and p ``.
    pub message: Text,
    /// The relation of a scheme to it: `needs H = T(p) + V(q)`.
    pub label: Text,
    /// The alternative.
    pub note: Text,
}

/// The description of a system: its name and formula, its variables, observables and pieces, and facts about H.
///
/// It is a value, and not a set of constants of the type, so that a system made at run time has one too. Nothing in it
/// is read within a step. [`System::description`](crate::System::description) returns that of a system,
/// [`Dynamics::description`](super::Dynamics::description) that of a prepared one.
///
/// ```
/// use hamiltonian::prelude::*;
///
/// hamiltonian! {
///     /// A particle in a plane that attracts it.
///     pub struct Falling { g = 9.81 }
///     H(x, z; px, pz) = (px^2 + pz^2)/2 + g*z;
///     event ground = z
/// }
///
/// let falling = Falling::default();
/// let described = falling.description();
/// assert_eq!(described.name, "Falling");
/// assert_eq!(described.groups[1].momentum, "pz");
/// assert_eq!(described.observables[0].name, "ground");
/// assert_eq!(described.cyclic[0], "x"); // So px is conserved.
/// assert_eq!(described.pieces.len(), 2);
/// assert!(!described.is_forced);
/// ```
///
/// The description of a system written by hand is a constant. [`new`](Description::new) makes it of a name and the variables, and
/// [`NONE`](Description::NONE) completes one with more fields:
///
/// ```
/// use hamiltonian::schemes::author::{Description, Group};
/// use hamiltonian::systems::NamedPiece;
/// use std::borrow::Cow;
///
/// const GROUPS: &[Group] = &[Group::scalar("q", "p", 0)];
/// const PIECES: &[NamedPiece] = &[NamedPiece::new("p^2/2"), NamedPiece::new("q^2/2")];
/// const SPRING: &Description = &Description {
///     name: Cow::Borrowed("Spring"),
///     groups: Cow::Borrowed(GROUPS),
///     pieces: Cow::Borrowed(PIECES),
///     ..Description::NONE
/// };
/// assert_eq!(SPRING.pieces[0].name, "p^2/2");
/// assert_eq!(Description::new("Spring", GROUPS).clock(), "t");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Description {
    /// The name of the system (of the type for item form, `H` for expression form).
    pub name: Text,
    /// H in the author's notation, with a force where there is one; by it a saved run is recognised.
    pub formula: Text,
    /// The groups of coordinates in declaration order.
    pub groups: Cow<'static, [Group]>,
    /// Monitors, invariants and events in declaration order.
    pub observables: Cow<'static, [Observable]>,
    /// The coordinates that do not appear in H, as declared (`q`, or `q[0]` for a component): their momenta are
    /// conserved.
    pub cyclic: Cow<'static, [Text]>,
    /// The pieces of [`Split`](super::Split), the outermost first; none if H does not split.
    pub pieces: Cow<'static, [NamedPiece]>,
    /// The name of the time s of a time-transformed system, dt = g ds: there H is g·(h + p_t) with h the
    /// declared one, its last coordinate is the time t, and its last momentum is p_t = −h on the shell
    /// H = 0, on which alone orbits are those of h. Runs require starts on it and show h as the energy.
    pub fictitious_time: Option<Text>,
    /// True if a force acts on the momenta besides −∂H/∂q.
    pub is_forced: bool,
    /// True if H is proven not to depend on t. If false, runs to a tolerance compare the slopes at both ends of each step
    /// with those at its stages.
    pub is_autonomous: bool,
    /// `Some(n)` if H is defined for all finite numbers, and neither it nor a part of it grows faster than the n-th
    /// power of their size. Runs do not evaluate H where it is known to be finite. `None` if nothing is known: runs
    /// then evaluate H at the end of each block of steps.
    pub growth: Option<u32>,
    /// True if the kick, with the force in it, jumps at times that do not depend on the state, such as
    /// `if t < 1 { … } else { … }`, and the same for the rest of H. Without a kick apart, both are true if anything
    /// jumps. Schemes then evaluate what jumps inside of their steps only, or are refused, so that steps may end at the
    /// jumps.
    pub jumps: [bool; 2],
    /// The properties that are not proven, of a system whose type has every marker because its H is known at run time
    /// alone. A run is refused if its scheme requires one of them. None of other systems, whose types have the markers
    /// that hold.
    pub missing: Cow<'static, [Missing]>,
}

impl Description {
    /// The description of nothing, which a constant completes.
    pub const NONE: Self = Description {
        name: Cow::Borrowed(""),
        formula: Cow::Borrowed(""),
        groups: Cow::Borrowed(&[]),
        observables: Cow::Borrowed(&[]),
        cyclic: Cow::Borrowed(&[]),
        pieces: Cow::Borrowed(&[]),
        fictitious_time: None,
        is_forced: false,
        is_autonomous: false,
        growth: None,
        jumps: [false; 2],
        missing: Cow::Borrowed(&[]),
    };

    /// The description of a system of which its name and its variables are known.
    #[must_use]
    pub const fn new(name: &'static str, groups: &'static [Group]) -> Self {
        Description {
            name: Cow::Borrowed(name),
            groups: Cow::Borrowed(groups),
            ..Description::NONE
        }
    }

    /// The name of the time of a run: `t`, or that of a time-transformed system.
    #[must_use]
    pub fn clock(&self) -> &str {
        self.fictitious_time.as_deref().unwrap_or("t")
    }

    /// The index of an observable in [`observables`](Description::observables), from its name: `height`, or
    /// `angular_momentum[2]` for a component.
    #[must_use]
    pub fn observable_index(&self, name: &str) -> Option<usize> {
        self.observables.iter().position(|known| known.name == name)
    }

    /// The names of the first coordinate and its momentum, for errors of their shape.
    pub(crate) fn first_names(&self) -> [&str; 2] {
        let first = self.groups.first();
        first.map_or(["q", "p"], |group| [&*group.coordinate, &*group.momentum])
    }

    /// The error for the name of an observable that the system does not declare.
    pub(crate) fn unknown(&self, name: &str) -> ObservableError {
        ObservableError::Unknown {
            name: name.into(),
            system: (*self.name).into(),
            known: (self.observables.iter())
                .map(|known| (*known.name).into())
                .collect(),
        }
    }

    /// The formulas of the pieces, by which saved runs and stores recognise them.
    pub(crate) fn piece_formulas(&self, between: &str) -> String {
        let formulas: Vec<&str> = self.pieces.iter().map(|piece| &*piece.formula).collect();
        formulas.join(between)
    }

    /// Returns true if H or the force [jumps](Description::jumps) in time.
    #[must_use]
    pub fn is_jumping(&self) -> bool {
        self.jumps[0] || self.jumps[1]
    }

    /// The names of the [`pieces`](Description::pieces).
    #[must_use]
    pub fn piece_names(&self) -> Vec<&str> {
        self.pieces.iter().map(|piece| &*piece.name).collect()
    }

    /// Returns whether the first of the [`pieces`](Description::pieces) jumps in time, and whether any other does. The
    /// macro puts a piece first that does not jump.
    #[must_use]
    pub fn jumping_pieces(&self) -> [bool; 2] {
        match &*self.pieces {
            [] => [self.is_jumping(); 2],
            [first, others @ ..] => [first.jumps, others.iter().any(|piece| piece.jumps)],
        }
    }
}

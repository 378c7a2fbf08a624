//! The list of all schemes.
//!
//! Input: the schemes with each of their choices. Output: [`catalogue`] to print,
//! [`visit_any`] and its like to run. Invariant: what is in the list is measured by the
//! tests, which iterate over it; a scheme that is not in it is not in the library.

use super::{
    ConsecutiveSubTrajectories, ImplicitMidpoint, IntersectingSubTrajectories, Pihajoki,
    RungeKutta4, Start, StormerVerlet, Strang, SymplecticEuler, TwoStepMidpoint,
};
use crate::scheme::{Entry, Listed, Scheme};
use crate::system::{Separable, Split, System, Unforced};
use hamiltonian_lanes::Real;

/// What is done with each scheme of the catalogue.
pub trait Visitor<T: Real, S: System<T>> {
    /// Does it with one.
    fn visit<M: Scheme<T, S>>(&mut self, scheme: M);
}

macro_rules! catalogue {
    (any { $($any:expr,)+ } unforced { $($unforced:expr,)+ } split { $($split:expr,)+ }
     separable { $($separable:expr,)+ }) => {
        /// The entries of all schemes, those for any H first.
        ///
        /// ```
        /// for entry in hamiltonian_core::schemes::catalogue() {
        ///     println!("{} {} ({}): order {}", entry.name, entry.variant, entry.equations, entry.order);
        /// }
        /// ```
        pub fn catalogue() -> impl Iterator<Item = Entry> {
            [$($unforced.entry(),)+ $($any.entry(),)+ $($split.entry(),)+ $($separable.entry(),)+]
                .into_iter()
        }

        /// Visits the schemes that serve any H, with forces.
        pub fn visit_any<T: Real, S: System<T>>(visitor: &mut impl Visitor<T, S>) {
            $(visitor.visit($any);)+
        }

        /// Visits the schemes that ask for no forces.
        pub fn visit_unforced<T: Real, S: System<T> + Unforced>(visitor: &mut impl Visitor<T, S>) {
            $(visitor.visit($unforced);)+
        }

        /// Visits the schemes that ask for pieces with exact flows.
        pub fn visit_split<T: Real, S: Split<T>>(visitor: &mut impl Visitor<T, S>) {
            $(visitor.visit($split);)+
        }

        /// Visits the schemes that ask for H = T(p, t) + V(q, t).
        pub fn visit_separable<T: Real, S: Separable<T>>(visitor: &mut impl Visitor<T, S>) {
            $(visitor.visit($separable);)+
        }
    };
}

catalogue! {
any {
    ImplicitMidpoint::default(),
    RungeKutta4,
}
unforced {
    TwoStepMidpoint { start: Start::Equal },
    TwoStepMidpoint { start: Start::HalfEuler },
    TwoStepMidpoint { start: Start::SecondOrder },
    ConsecutiveSubTrajectories { start: Start::Equal },
    ConsecutiveSubTrajectories { start: Start::HalfEuler },
    ConsecutiveSubTrajectories { start: Start::SecondOrder },
    IntersectingSubTrajectories { start: Start::Equal },
    IntersectingSubTrajectories { start: Start::HalfEuler },
    IntersectingSubTrajectories { start: Start::SecondOrder },
    Pihajoki::CoordinateFirst,
    Pihajoki::MomentumFirst,
}
split {
    Strang,
}
separable {
    SymplecticEuler::KickDrift,
    SymplecticEuler::DriftKick,
    StormerVerlet::KickDriftKick,
    StormerVerlet::DriftKickDrift,
}
}

//! The list of all schemes.
//!
//! Input: the schemes with all their settings. Output: [`catalogue`] to print, [`visit_any`] and
//! similar functions to run. Invariant: every entry is measured by the tests, which iterate over
//! it; a scheme that is not in it is not in the library.

use super::{
    Aba104, Aba864, Aba1064, BlanesCasasEscorihuela8, BlanesCasasMurua8, BlanesMoan4, BlanesMoan6,
    CheapProcessed4, Compensated, ConsecutiveSubTrajectories, DiscreteGradient, Gauss,
    GaussNystrom, ImplicitMidpoint, IntersectingSubTrajectories, KahanLi6, KahanLi8, McLachlan8,
    MidpointProjected, Mixed, MomentumVariational, Pihajoki, Processed4, Processed6, RungeKutta4,
    Ruth3, Saba2, Saba3, Saba4, SecondPoint, Semiexplicit, SofroniouSpaletta8, SofroniouSpaletta10,
    Srkn6b, Srkn11b, Srkn14a, StormerVerlet, Strang, Suzuki4, SymplecticEuler, Tao,
    TransformedVerlet, TwoStepMidpoint, Variational, WisdomHolman3, WisdomHolman5, WisdomHolman7,
    WisdomHolman11, WisdomHolman17, Yoshida4, Yoshida6,
};
use crate::schemes::scheme::{Entry, Listed, OneStep, Scheme};
use crate::systems::system::{
    Autonomous, Exact, Nystrom, QuadraticKinetic, Separable, Split, System, Unforced,
};
use crate::systems::transformed::TimeTransformed;

#[cfg(test)]
mod needs;

/// A visitor of the schemes of the catalogue.
pub trait Visitor<S: System> {
    /// Visits a scheme.
    fn visit<M: Scheme<S>>(&mut self, scheme: M);
    /// Visits a scheme that has an adjoint, like any other by default.
    fn visit_one_step<M>(&mut self, scheme: M)
    where
        M: Scheme<S> + OneStep<Adjoint: Scheme<S>>,
    {
        self.visit(scheme);
    }
}

/// Visits one entry, `carries` if its step depends on more than the state or the state is not all it carries,
/// so that its adjoint is no scheme.
macro_rules! visit {
    ($visitor:ident, $scheme:expr) => {
        $visitor.visit_one_step($scheme)
    };
    ($visitor:ident, carries $scheme:expr) => {
        $visitor.visit($scheme)
    };
}

macro_rules! catalogue {
    (any { $($any:expr,)+ } unforced { $($(@$unforced_kind:ident)? $unforced:expr,)+ }
     split { $($split:expr,)+ } exact { $($(@$exact_kind:ident)? $exact:expr,)+ }
     separable { $($separable:expr,)+ } nystrom { $($nystrom:expr,)+ } quadratic { $($quadratic:expr,)+ }
     implicit { $($implicit:expr,)+ } energy { $($energy:expr,)+ } doubled { $($(@$doubled_kind:ident)? $doubled:expr,)+ }
     compensated { $($compensated:expr,)+ } transformed { $($transformed:expr,)+ }) => {
        /// The entries of all schemes, those for any H first.
        ///
        /// ```
        /// for entry in hamiltonian::schemes::author::catalogue() {
        ///     println!("{entry}, {}: order {}", entry.equations, entry.order);
        /// }
        /// ```
        #[inline]
        pub fn catalogue() -> impl Iterator<Item = Entry> {
            [$($unforced.entry(),)+ $($any.entry(),)+ $($split.entry(),)+ $($exact.entry(),)+ $($separable.entry(),)+
                $($nystrom.entry(),)+ $($quadratic.entry(),)+ $($implicit.entry(),)+ $($energy.entry(),)+ $($doubled.entry(),)+
                $($compensated.entry(),)+ $($transformed.entry(),)+]
                .into_iter()
        }

        /// The entries of all schemes, with what the bounds of their implementations require.
        #[cfg(test)]
        fn required() -> alloc::vec::Vec<(Entry, crate::schemes::scheme::Needs)> {
            alloc::vec![$(needs::required!($unforced),)+
                $(needs::required!($any),)+
                $(needs::required!($split),)+
                $(needs::required!($exact),)+
                $(needs::required!($separable),)+
                $(needs::required!($nystrom),)+
                $(needs::required!($quadratic),)+
                $(needs::required!($implicit),)+
                $(needs::required!($energy),)+
                $(needs::required!($doubled),)+
                $(needs::required!($compensated),)+
                $(needs::required!($transformed),)+]
        }

        /// Visits the schemes for any H, with forces.
        pub fn visit_any<S: System>(visitor: &mut impl Visitor<S>) {
            $(visit!(visitor, $any);)+
        }

        /// Visits the schemes that require the absence of forces.
        pub fn visit_unforced<S: System + Unforced>(visitor: &mut impl Visitor<S>) {
            $(visit!(visitor, $($unforced_kind)? $unforced);)+
        }

        /// Visits the schemes that require pieces.
        pub fn visit_split<S: Split>(visitor: &mut impl Visitor<S>) {
            $(visit!(visitor, $split);)+
        }

        /// Visits the schemes that require pieces with exact flows only.
        pub fn visit_exact<S: Split + Exact>(visitor: &mut impl Visitor<S>) {
            $(visit!(visitor, $($exact_kind)? $exact);)+
        }

        /// Visits the schemes that require H = T(p, t) + V(q, t).
        pub fn visit_separable<S: Separable>(visitor: &mut impl Visitor<S>) {
            $(visit!(visitor, $separable);)+
        }

        /// Visits the schemes that require H = A(q, p) + V(q, t), A at most quadratic in p.
        pub fn visit_nystrom<S: Nystrom>(visitor: &mut impl Visitor<S>) {
            $(visit!(visitor, $nystrom);)+
        }

        /// Visits the schemes with the stages of a quadrature, for any H, with forces.
        pub fn visit_implicit<S: System>(visitor: &mut impl Visitor<S>) {
            $(visit!(visitor, $implicit);)+
        }

        /// Visits the schemes that preserve H; they require the absence of forces.
        pub fn visit_energy<S: System + Unforced>(visitor: &mut impl Visitor<S>) {
            $(visit!(visitor, $energy);)+
        }

        /// Visits the schemes by tables on two copies.
        pub fn visit_doubled<S: System + Unforced>(visitor: &mut impl Visitor<S>) {
            $(visit!(visitor, $($doubled_kind)? $doubled);)+
        }

        /// Visits the compensated schemes.
        pub fn visit_compensated<S: Separable + Unforced>(
            visitor: &mut impl Visitor<S>,
        ) {
            $(visit!(visitor, $compensated);)+
        }

        /// Visits the schemes that require H = ½ pᵀM⁻¹p + V(q) in the time of a monitor function.
        pub fn visit_transformed<S, G>(visitor: &mut impl Visitor<TimeTransformed<S, G>>)
        where
            S: Separable + QuadraticKinetic + Unforced + Autonomous,
            G: System<Shape = S::Shape> + Unforced + Autonomous,
        {
            $(visit!(visitor, $transformed);)+
        }

        /// Visits the schemes that require H = ½ pᵀM⁻¹p + V(q, t) with constant M.
        pub fn visit_quadratic<S: Separable + QuadraticKinetic + Unforced>(
            visitor: &mut impl Visitor<S>,
        ) {
            $(visit!(visitor, $quadratic);)+
        }
    };
}

catalogue! {
any {
    ImplicitMidpoint::default(),
    RungeKutta4,
}
unforced {
    @carries TwoStepMidpoint::default().with_second_point(SecondPoint::Equal),
    @carries TwoStepMidpoint::default().with_second_point(SecondPoint::HalfEuler),
    @carries TwoStepMidpoint::default().with_second_point(SecondPoint::SecondOrder),
    @carries ConsecutiveSubTrajectories::default().with_second_point(SecondPoint::Equal),
    @carries ConsecutiveSubTrajectories::default().with_second_point(SecondPoint::HalfEuler),
    @carries ConsecutiveSubTrajectories::default().with_second_point(SecondPoint::SecondOrder),
    @carries IntersectingSubTrajectories::default().with_second_point(SecondPoint::Equal),
    @carries IntersectingSubTrajectories::default().with_second_point(SecondPoint::HalfEuler),
    @carries IntersectingSubTrajectories::default().with_second_point(SecondPoint::SecondOrder),
    Pihajoki::CoordinateFirst,
    Pihajoki::MomentumFirst,
}
split {
    Strang,
}
exact {
    Ruth3,
    Yoshida4,
    Suzuki4,
    BlanesMoan4,
    Yoshida6,
    KahanLi6,
    BlanesMoan6,
    McLachlan8,
    KahanLi8,
    SofroniouSpaletta8,
    SofroniouSpaletta10,
    Saba2,
    Saba3,
    Saba4,
    Aba104,
    Aba864,
    Aba1064,
    Processed4::default(),
    Processed6::default(),
    BlanesCasasMurua8::default(),
    @carries CheapProcessed4::default(),
    WisdomHolman3::default(),
    WisdomHolman5::default(),
    WisdomHolman7::default(),
    WisdomHolman11::default(),
    WisdomHolman17::default(),
}
separable {
    SymplecticEuler::KickDrift,
    SymplecticEuler::DriftKick,
    StormerVerlet::KickDriftKick,
    StormerVerlet::DriftKickDrift,
}
nystrom {
    Srkn6b,
    Srkn11b,
    Srkn14a,
    BlanesCasasEscorihuela8,
}
quadratic {
    GaussNystrom::<2>::default(),
}
implicit {
    Gauss::<2>::default(),
    Variational::<1, 2>::lobatto(),
    Variational::<2, 2>::lobatto(),
    MomentumVariational::<2>::default(),
}
energy {
    DiscreteGradient::default(),
}
doubled {
    Tao::default(),
    @carries Mixed::<Strang>::default(),
    @carries MidpointProjected::<Strang>::default(),
    Semiexplicit::<Strang>::default(),
}
compensated {
    Compensated(Strang),
}
transformed {
    TransformedVerlet::default(),
}
}

//! The schemes, each with its equation, order, coefficients and source, and the list of them.
//!
//! | scheme | equations | order | requires | preserves | work in a step |
//! |---|---|---|---|---|---|
//! | [`StormerVerlet`] | (27) | 2 | `Separable` | dq∧dp | 1 kick, 1 drift |
//! | [`SymplecticEuler`] | | 1 | `Separable` | dq∧dp | 1 kick, 1 drift |
//! | [`Strang`] | | 2 | `Split` | dq∧dp | 1 stage: each piece twice; adjacent flows of one piece merge |
//! | [`Ruth3`] | | 3 | `Split` | dq∧dp | 3 stages |
//! | [`Yoshida4`], [`Suzuki4`], [`BlanesMoan4`] | | 4 | `Split` | dq∧dp | 3, 5, 6 stages |
//! | [`Yoshida6`], [`KahanLi6`], [`BlanesMoan6`] | | 6 | `Split` | dq∧dp | 7, 9, 10 stages |
//! | [`McLachlan8`], [`KahanLi8`], [`SofroniouSpaletta8`] | | 8 | `Split` | dq∧dp | 15, 17, 21 stages |
//! | [`SofroniouSpaletta10`] | | 10 | `Split` | dq∧dp | 35 stages |
//! | [`Srkn6b`], [`Srkn11b`], [`Srkn14a`] | | 4, 6, 6 | `Nystrom` | dq∧dp | 6, 11, 14 kicks |
//! | [`BlanesCasasEscorihuela8`] | | 8 | `Nystrom` | dq∧dp | 19 kicks |
//! | [`Saba2`] … [`Saba4`] | | (4, 2) … (8, 2) | `Split`, small second piece | dq∧dp | 2 … 4 stages |
//! | [`Aba104`], [`Aba864`], [`Aba1064`] | | as named | `Split`, small second piece | dq∧dp | 7, 7, 8 stages |
//! | [`Processed4`], [`Processed6`], [`BlanesCasasMurua8`] | | 4, 6, 8 | `Split` | dq∧dp | 5, 8, 13 stages; a processor of 12, 24, 20 stages for each observed state |
//! | [`CheapProcessed4`] | | 4 | `Split` | dq∧dp of the carried value, not of the observed state | 5 stages; 2 × 2½ stages for each observed state |
//! | [`WisdomHolman3`] … [`WisdomHolman17`] | | (4, 2) … (18, 2) | `Split`, small second piece | dq∧dp | 1 stage; a processor of 2 … 16 stages for each observed state |
//! | [`Compensated`] | | that of its scheme | `Separable`, no forces | dq∧dp | that of its scheme, and low words |
//! | [`Pihajoki`] | (29), (30) | 2 | no forces | dq∧dp + dq̃∧dp̃ of the copies | 2 gradients |
//! | [`Mixed`] | | that of its scheme | no forces | nothing | that of its scheme on the copies |
//! | [`Tao`] | | 2 | no forces | dq∧dp + dq̃∧dp̃ of the copies | 3 gradients |
//! | [`MidpointProjected`] | | p, that of its scheme | no forces | dq∧dp to O(h^(2p+2)) | 2 gradients a stage |
//! | [`Semiexplicit`] | | that of its scheme | no forces | dq∧dp | 2 gradients a stage and iteration |
//! | [`TwoStepMidpoint`] | (25) | 2 | no forces | dq_a∧dp_b + dq_b∧dp_a | 1 gradient |
//! | [`ConsecutiveSubTrajectories`] | (26) | 2 | no forces | dq_a∧dp_b + dq_b∧dp_a | 2 gradients, **time advances by 2Δt** |
//! | [`IntersectingSubTrajectories`] | (33) | 2 | no forces | dq_a∧dp_b + dq_b∧dp_a | 2 gradients |
//! | [`ImplicitMidpoint`] | | 2 | | dq∧dp | 1 gradient an iteration |
//! | [`Gauss`] | | 2S | | dq∧dp | S gradients an iteration |
//! | [`GaussNystrom`] | | 2S | quadratic T, no forces | dq∧dp | S forces an iteration |
//! | [`Variational`] | (35) | 2·degree or that of the quadrature, whichever is less | | dq∧dp | a gradient a point and iteration |
//! | [`MomentumVariational`] | | 2S − 2 | | dq∧dp | S gradients an iteration |
//! | [`TransformedVerlet`] | | 2 | [`TimeTransformed`](crate::TimeTransformed), quadratic T, no forces | dq∧dp + dt∧dp_t | 1 ∂V/∂q |
//! | [`DiscreteGradient`] | | 2 | no forces | H | 1 gradient and H an iteration |
//! | [`RungeKutta4`] | | 4 | | nothing | 4 gradients |
//!
//! [`Composition`] makes schemes of higher order from any symmetric one, for example `KahanLi6.of(…)`. [`Paced`] gives
//! one-step schemes reversible steps of varying length. [`Adaptive`] takes the steps of [`Gauss`] and [`GaussNystrom`] from
//! a tolerance.
//!
//! With a second piece of size ε, an order (n, m) means the error O(εhⁿ + ε²hᵐ). That of `Aba1064` is
//! (10, 6, 4): O(εh¹⁰ + ε²h⁶ + ε³h⁴).
//!
//! What a scheme requires is a trait bound: a scheme on a system without the structure does not compile. A scheme with
//! nothing there takes any H with any force. Schemes that require `Split`, except [`Strang`], also require
//! [`Exact`](crate::Exact): a force that is not affine in the momenta has no exact flow. Equation numbers are those
//! of "Developing an explicit Hamiltonian variational integrator".
//!
//! A new scheme is a type with a [`Listed`](crate::schemes::author::Listed) entry and a
//! [`Scheme`](crate::Scheme) implementation. In this crate, it also has a line in `catalogue.rs`; the tests then
//! measure its order and the form that it preserves. A splitting of this crate is a table in [`tables`] and a line in
//! `tabulated.rs`.

/// A scheme that is its own adjoint: `symmetric!(Strang)`, `symmetric!(Gauss<S>, const S: usize)`.
macro_rules! symmetric {
    ($scheme:ty $(, $($generics:tt)*)?) => {
        impl<$($($generics)*)?> crate::schemes::scheme::OneStep for $scheme {
            type Adjoint = Self;
            fn adjoint(&self) -> Self {
                *self
            }
        }
        impl<$($($generics)*)?> crate::schemes::scheme::Symmetric for $scheme {}
    };
}

pub mod author;
#[doc(hidden)]
pub mod inside;
pub mod walk;

mod splitting;
pub mod tables;
mod zigzag;

mod cheap;
mod processed;
mod semiexplicit;
mod separable;
mod strang;
mod tabulated;

mod compensated;

mod extended;
mod projection;
mod tao;
mod trajectories;

mod bundles;
pub mod collocation;
mod gauss;
mod midpoint;
mod polynomial;
mod second_order;
mod staged;
mod stages;
mod variational;

mod discrete_gradient;
mod runge_kutta;
pub(crate) mod scheme;

mod adaptive;
mod composition;
mod paced;
mod transformed_verlet;

mod catalogue;

pub use adaptive::{Adaptive, Estimates, ToTolerance, Tolerance};
pub use cheap::{CheapProcessed, CheapProcessed4};
pub use compensated::Compensated;
pub use composition::{Adjoint, Composition};
pub use discrete_gradient::DiscreteGradient;
pub use extended::Pihajoki;
pub use gauss::Gauss;
pub use midpoint::ImplicitMidpoint;
pub use paced::{Density, Paced};
pub use processed::{
    BlanesCasasMurua8, Processed, Processed4, Processed6, WisdomHolman3, WisdomHolman5,
    WisdomHolman7, WisdomHolman11, WisdomHolman17,
};
pub use projection::{MidpointProjected, Mixed};
pub use runge_kutta::RungeKutta4;
pub use second_order::GaussNystrom;
pub use semiexplicit::Semiexplicit;
pub use separable::{StormerVerlet, SymplecticEuler};
pub use strang::Strang;
pub use tabulated::{
    Aba104, Aba864, Aba1064, BlanesCasasEscorihuela8, BlanesMoan4, BlanesMoan6, KahanLi6, KahanLi8,
    McLachlan8, Ruth3, Saba2, Saba3, Saba4, SofroniouSpaletta8, SofroniouSpaletta10, Srkn6b,
    Srkn11b, Srkn14a, Suzuki4, Yoshida4, Yoshida6,
};
pub use tao::Tao;
pub use trajectories::{
    ConsecutiveSubTrajectories, IntersectingSubTrajectories, SecondPoint, TwoStepMidpoint,
};
pub use transformed_verlet::TransformedVerlet;
pub use variational::{MomentumVariational, Variational};

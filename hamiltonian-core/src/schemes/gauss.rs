//! Gauss collocation with any number of stages.
//!
//! Input: any system. Output: [`Gauss`]. Invariant: a step is finished only when its equations hold
//! to rounding; otherwise it is an error.

use super::collocation::{Collocation, multiples};
use super::stages::{Carries, Collocated, at_rest, of_fixed_point};
use crate::flows::map::Step;
use crate::schemes::scheme::{Entry, Form, Listed, Needs, Scheme};
use crate::systems::state::State;
use crate::systems::system::{Description, Dynamics, System, VectorOf};
use core::fmt;
use hamiltonian_lanes::Real;

/// Gauss collocation with S = `STAGES` stages: order 2S, symplectic for every H, time-reversible. The number
/// of stages is always explicit, `Gauss::<2>::default()`.
///
/// ```text
/// Fᵢ = J∇H(z[n] + h Σ aᵢⱼ Fⱼ, t[n] + cᵢh);   z[n+1] = z[n] + h Σ bᵢ Fᵢ
/// ```
///
/// with Gauss' nodes c, weights b and aᵢⱼ = ∫₀^cᵢ ℓⱼ, for any S, from [`Collocation`]. Solved by
/// fixed-point iteration from the slopes of the step before, extrapolated, until the next change of the
/// slopes would be lost in their rounding, or the change is rounding and stops shrinking; if that fails, for
/// example for steps longer than the fastest motion, by Newton's method with the Hessian of H (up to 256
/// unknowns: all components of all stages). Where H is separable, an iteration computes the velocities, then the
/// forces at the coordinates that they lead to; it takes about half as many. From four stages on, the stages of a run over `f64` or
/// [`Dual`](crate::Dual) lie in the lanes of the CPU's registers, with the same bits
/// ([`Integrator::with_lanes`](crate::Integrator::with_lanes), [`Integrator::fused`](crate::Integrator::fused)). aᵢⱼ
/// enters as bⱼμᵢⱼ with μᵢⱼ + μⱼᵢ = 1 exactly, so that dq∧dp
/// and quadratic invariants drift by rounding alone, and the low words that rounding takes from
/// `z[n+1]` are carried to the next step (compensated summation). A force is part of the vector field. With one
/// stage it is the [`ImplicitMidpoint`](super::ImplicitMidpoint) rule.
///
/// Choice of S: an evaluation of J∇H is made S times an iteration. Two stages suit errors of 1e-6,
/// four to six those of 1e-12, eight and more `DoubleDouble`.
///
/// Source: J. C. Butcher, Math. Comp. 18 (1964) 50, doi:10.1090/S0025-5718-1964-0159424-9; E. Hairer,
/// C. Lubich, G. Wanner, Geometric Numerical Integration (2006), sections II.1.3 and VIII.6,
/// doi:10.1007/3-540-30666-8; M. Antoñana, J. Makazaga, A. Murua, Numer. Algorithms 76 (2017) 861,
/// doi:10.1007/s11075-017-0287-z.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, Gauss::<4>::default(), start, 0.5)?;
/// assert!((run.advance(20)?.q[0] - 10.0_f64.cos()).abs() < 1e-8);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, PartialEq)]
pub struct Gauss<const STAGES: usize> {
    pub(super) coefficients: Collocation<STAGES>,
    max_iterations: u32,
}

impl<const S: usize> Default for Gauss<S> {
    /// At most 100 iterations of each method.
    fn default() -> Self {
        Gauss::<S>::default()
    }
}

impl<const STAGES: usize> Gauss<STAGES> {
    /// Returns the scheme with at most 100 iterations of each method, as [`Default`] does.
    #[must_use]
    // If the number of stages is missing, rustc asks for it only if `default` is an inherent method.
    #[allow(clippy::should_implement_trait)]
    pub fn default() -> Self {
        Gauss {
            coefficients: Collocation::gauss(),
            max_iterations: 100,
        }
    }

    /// The number of iterations of the fixed point, and then of Newton's method, after which an unsolved step is an error;
    /// 100 by default.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// assert_eq!(Gauss::<2>::default(), Gauss::<2>::default().with_max_iterations(100));
    /// ```
    #[must_use]
    pub fn with_max_iterations(self, max_iterations: u32) -> Self {
        Gauss {
            max_iterations,
            ..self
        }
    }
}

/// The number of stages, in words.
pub(super) fn stages(count: usize) -> &'static str {
    const STAGES: [&str; 17] = [
        "",
        "1 stage",
        "2 stages",
        "3 stages",
        "4 stages",
        "5 stages",
        "6 stages",
        "7 stages",
        "8 stages",
        "9 stages",
        "10 stages",
        "11 stages",
        "12 stages",
        "13 stages",
        "14 stages",
        "15 stages",
        "16 stages",
    ];
    STAGES.get(count).copied().unwrap_or("more than 16 stages")
}

/// The coefficients follow from S.
impl<const S: usize> fmt::Debug for Gauss<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Gauss")
            .field("stages", &S)
            .field("max_iterations", &self.max_iterations)
            .finish()
    }
}

impl<const S: usize> Listed for Gauss<S> {
    fn entry(&self) -> Entry {
        Entry {
            name: "Gauss",
            variant: stages(S),
            equations: "",
            order: 2 * S as u32,
            duration: 1,
            needs: Needs::ANY,
            preserves: Form::OnePoint,
            source: "Hairer, Lubich, Wanner 2006, section II.1.3, doi:10.1007/3-540-30666-8",
        }
    }
}

symmetric!(Gauss<S>, const S: usize);

impl<S: System, const STAGES: usize> Scheme<S> for Gauss<STAGES> {
    type Carried = Carries<S::Shape, STAGES>;
    type Map<T: Real> = Collocated<T, S::Prepared<T>, STAGES, true>;
    fn times_of_jumps(&self, _: &Description) -> [f64; 2] {
        self.coefficients.ends()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let integrals = self.coefficients.symplectic();
        let weights = multiples(&self.coefficients.weights, step.h);
        Collocated {
            field: prepared.field(T::one()),
            dynamics: prepared.clone(),
            h: step.h,
            times: multiples(&self.coefficients.nodes, step.h),
            weights,
            spans: weights,
            // 1 − μⱼᵢ is μᵢⱼ.
            coordinates: integrals,
            momenta: integrals,
            modes: None,
            matrices: of_fixed_point(&self.coefficients, step, &weights, [integrals; 2]),
            limits: [self.max_iterations; 2],
            is_part: false,
        }
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Carries<VectorOf<S, T>, STAGES> {
        at_rest(state)
    }
}

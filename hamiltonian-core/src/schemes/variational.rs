//! Variational integrators: an action, a polynomial, a quadrature.
//!
//! Input: any system, the degree of the polynomial, a quadrature. Output: [`Variational`], and
//! [`Extremal`], the discrete action with its boundary momenta. Invariant: fewer points than the degree
//! do not compile.

use super::collocation::{Collocation, constant, multiples};
use super::stages::{Carries, Collocated, CollocatedWork, Modes, Stages, at_rest, of_fixed_point};
use crate::errors::{Error, SearchError, StartError};
use crate::flows::map::Step;
use crate::schemes::scheme::{Entry, Form, Listed, Needs, Scheme};
use crate::systems::state::{Point, State};
use crate::systems::system::{Dynamics, System, VectorOf};
use crate::systems::vector::{Vector, dot};
use core::fmt;
use core::ops::Range;
use hamiltonian_lanes::{DoubleDouble, Mask, Real};

/// The variational integrator of a polynomial path and a quadrature: symplectic for every H,
/// time-reversible.
///
/// The path of a step is a polynomial q(t) of degree `DEGREE`, and the action ∫ p·dq − H dt the sum
/// over the nodes cᵢ with the weights bᵢ,
///
/// ```text
/// S = h Σ bᵢ (Pᵢ·q̇(tᵢ) − H(Qᵢ, Pᵢ, tᵢ)),   Qᵢ = q(tᵢ),   tᵢ = t + cᵢh
/// ```
///
/// stationary in the coefficients of q and in the momenta Pᵢ. Its discrete Hamilton equations are
///
/// ```text
/// q̇(tᵢ) = ∂H/∂p(Qᵢ, Pᵢ, tᵢ)                                              for each node
/// Σ bᵢ φ(cᵢ) Pᵢ = p[n] ∫φ − h Σ bᵢ (∫φ − Φ(cᵢ)) ∂H/∂q(Qᵢ, Pᵢ, tᵢ)        for each φ
/// q[n+1] = q[n] + h ∫q̇,   p[n+1] = p[n] − h Σ bᵢ ∂H/∂q(Qᵢ, Pᵢ, tᵢ)
/// ```
///
/// with φ the polynomials of degree < `DEGREE` on [0, 1] and Φ = ∫₀φ: here ∂Qᵢ/∂(coefficient) =
/// hΦ(cᵢ) is the chain rule that (35) of the paper requires. The order is 2·`DEGREE` or that of the
/// quadrature, whichever is less:
///
/// | degree | quadrature | | order |
/// |---|---|---|---|
/// | 1 | midpoint | `<1, 1>::gauss()` | 2: [`ImplicitMidpoint`](super::ImplicitMidpoint) |
/// | 1 | trapezoid | `<1, 2>::lobatto()` | 2 |
/// | 2 | trapezoid | `<2, 2>::lobatto()` | 2: the generalised Störmer–Verlet method, Lobatto IIIA–IIIB |
/// | 2 | Simpson | `<2, 3>::lobatto()` | 4 |
/// | 3 | Simpson | `<3, 3>::lobatto()` | 4: Lobatto IIIA–IIIB with 3 stages |
/// | s | Gauss | `<s, s>::gauss()` | 2s: [`Gauss`](super::Gauss) |
/// | s | Lobatto, s + 1 points | `<s, {s + 1}>::lobatto()` | 2s |
///
/// With as many points as the degree, these equations exist for every H, and they are solved like
/// those of [`Gauss`](super::Gauss). With more points ∂H/∂p must determine p: then Pᵢ is the
/// momentum of the velocity q̇(tᵢ), the integrand the Lagrangian (type I), and the equations are
/// solved by Newton's method with the Hessian of H, for which all components of all points must not
/// be more than 256. With fewer points the action does not depend on a part of the path: such a
/// type does not compile.
///
/// ```compile_fail
/// // A parabola sampled at one point.
/// let _ = hamiltonian::schemes::Variational::<2, 1>::gauss();
/// ```
///
/// A force enters by the discrete Lagrange–d'Alembert principle, `δS + h Σ bᵢ f(Qᵢ, Pᵢ, tᵢ)·δQᵢ = 0`: f stands
/// beside −∂H/∂q in all equations.
///
/// The same map follows from the action as a function of `(q[n], q[n+1])`, type I, of `(q[n], p[n+1])`,
/// type II, and of `(q[n+1], p[n])`, type III, for they are Legendre transforms of each other:
/// [`Variational::extremal`] computes each.
///
/// Source: J. E. Marsden, M. West, Acta Numer. 10 (2001) 357, sections 2.2 and 3.2,
/// doi:10.1017/S096249290100006X; M. Leok, J. Zhang, IMA J. Numer. Anal. 31 (2011) 1497, section 3,
/// doi:10.1093/imanum/drq027; S. Ober-Blöbaum, N. Saake, Adv. Comput. Math. 41 (2015) 955,
/// doi:10.1007/s10444-014-9394-8.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::Variational;
///
/// // A parabola and Simpson's rule: order 4.
/// let start = State::new([1.0], [0.0]);
/// let scheme = Variational::<2, 3>::lobatto();
/// let mut run = Integrator::new(&Oscillator {}, scheme, start, 0.05)?;
/// assert!((run.advance(200)?.q[0] - 10.0_f64.cos()).abs() < 1e-6);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, PartialEq)]
pub struct Variational<const DEGREE: usize, const POINTS: usize> {
    coefficients: Collocation<POINTS>,
    quadrature: Quadrature,
    max_iterations: u32,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Quadrature {
    Gauss,
    Lobatto,
}

impl<const DEGREE: usize, const POINTS: usize> Variational<DEGREE, POINTS> {
    const DETERMINED: () = {
        assert!(DEGREE > 0, "a path needs a degree of 1 at least");
        assert!(
            POINTS >= DEGREE,
            "the quadrature has fewer points than the degree of the path: the action does not determine the path"
        );
    };

    /// Gauss' quadrature: one point is the midpoint rule. Exact to degree 2·`POINTS` − 1.
    pub fn gauss() -> Self {
        let () = Self::DETERMINED;
        Variational {
            coefficients: Collocation::gauss(),
            quadrature: Quadrature::Gauss,
            max_iterations: 100,
        }
    }

    /// Lobatto's quadrature, with both ends: two points are the trapezoid rule, three Simpson's. Exact
    /// to degree 2·`POINTS` − 3.
    pub fn lobatto() -> Self {
        let () = Self::DETERMINED;
        Variational {
            coefficients: Collocation::lobatto(),
            quadrature: Quadrature::Lobatto,
            max_iterations: 100,
        }
    }

    /// The number of iterations after which an unsolved step is an error; 100 by default. With as
    /// many points as the degree, they are those of the fixed point, then as many of Newton's
    /// method.
    #[must_use]
    pub fn with_max_iterations(self, max_iterations: u32) -> Self {
        Variational {
            max_iterations,
            ..self
        }
    }
}

/// The coefficients follow from the degree and the quadrature.
impl<const DEGREE: usize, const POINTS: usize> fmt::Debug for Variational<DEGREE, POINTS> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Variational")
            .field("degree", &DEGREE)
            .field("quadrature", &self.quadrature)
            .field("points", &POINTS)
            .field("max_iterations", &self.max_iterations)
            .finish()
    }
}

impl<const DEGREE: usize, const POINTS: usize> Listed for Variational<DEGREE, POINTS> {
    fn entry(&self) -> Entry {
        let (variant, exact) = match (DEGREE, POINTS, self.quadrature) {
            (1, 1, Quadrature::Gauss) => ("line, midpoint", 2),
            (1, 2, Quadrature::Lobatto) => ("line, trapezoid", 2),
            (2, 2, Quadrature::Lobatto) => ("parabola, trapezoid", 2),
            (2, 3, Quadrature::Lobatto) => ("parabola, Simpson", 4),
            (3, 3, Quadrature::Lobatto) => ("cubic, Simpson", 4),
            (_, _, Quadrature::Gauss) => ("Gauss' quadrature", 2 * POINTS),
            (_, _, Quadrature::Lobatto) => ("Lobatto's quadrature", 2 * POINTS - 2),
        };
        Entry {
            name: "Variational",
            variant,
            equations: "(35)",
            order: exact.min(2 * DEGREE) as u32,
            duration: 1,
            needs: Needs::ANY,
            preserves: Form::OnePoint,
            source: "Leok, Zhang 2011, section 3, doi:10.1093/imanum/drq027",
        }
    }
}

symmetric!(Variational<DEGREE, POINTS>, const DEGREE: usize, const POINTS: usize);

impl<S: System, const DEGREE: usize, const POINTS: usize> Scheme<S>
    for Variational<DEGREE, POINTS>
{
    type Carried = Carries<S::Shape, POINTS>;
    type Map<T: Real> = Collocated<T, S::Prepared<T>, POINTS, false>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let (nodal, momenta) = self.coefficients.pair(DEGREE);
        let map = Collocated {
            momenta,
            ..self.with_modes(prepared, step.h, 0..DEGREE)
        };
        if DEGREE < POINTS {
            map
        } else {
            let matrices = [nodal, momenta];
            Collocated {
                spans: map.weights,
                matrices: of_fixed_point(&self.coefficients, step, &map.weights, matrices),
                coordinates: nodal,
                modes: None,
                ..map
            }
        }
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Carries<VectorOf<S, T>, POINTS> {
        at_rest(state)
    }
}

/// The variational integrator of a polynomial p(t), the momenta's, of degree `S` and Lobatto's quadrature
/// with `S` points: Lobatto IIIB–IIIA, order 2S − 2, symplectic for every H, time-reversible.
///
/// [`Variational`] with coordinates and momenta exchanged, (q, p) → (p, −q): the action ∫ −q·dp − H dt is
/// the sum
///
/// ```text
/// S = h Σ bᵢ (−Qᵢ·ṗ(tᵢ) − H(Qᵢ, Pᵢ, tᵢ)),   Pᵢ = p(tᵢ),   tᵢ = t + cᵢh
/// ```
///
/// stationary in the coefficients of p and in the coordinates Qᵢ. With bᵢâᵢⱼ + bⱼaⱼᵢ = bᵢbⱼ, of which a is
/// Lobatto IIIA,
///
/// ```text
/// Qᵢ = q[n] + h Σ âᵢⱼ ∂H/∂p(Qⱼ, Pⱼ, tⱼ),   Pᵢ = p[n] − h Σ aᵢⱼ ∂H/∂q(Qⱼ, Pⱼ, tⱼ)
/// ```
///
/// With two points and H = T + V it is [`StormerVerlet::DriftKickDrift`](super::StormerVerlet), as
/// `Variational::<2, 2>::lobatto()` is `KickDriftKick`. With Gauss' quadrature both are
/// [`Gauss`](super::Gauss).
///
/// A force stands beside −∂H/∂q in all equations.
///
/// Source: M. Leok, J. Zhang, IMA J. Numer. Anal. 31 (2011) 1497, section 3, doi:10.1093/imanum/drq027; E.
/// Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), section IV.2.3,
/// doi:10.1007/3-540-30666-8.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::MomentumVariational;
///
/// let start = State::new([1.0], [0.0]);
/// let scheme = MomentumVariational::<3>::default();
/// let mut run = Integrator::new(&Oscillator {}, scheme, start, 0.05)?;
/// assert!((run.advance(200)?.q[0] - 10.0_f64.cos()).abs() < 1e-6);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MomentumVariational<const S: usize>(Variational<S, S>);

impl<const S: usize> Default for MomentumVariational<S> {
    /// At most 100 iterations.
    fn default() -> Self {
        MomentumVariational::<S>::default()
    }
}

impl<const S: usize> MomentumVariational<S> {
    /// Returns the scheme with at most 100 iterations of each method, as [`Default`] does.
    #[must_use]
    // If the number of stages is missing, rustc asks for it only if `default` is an inherent method.
    #[allow(clippy::should_implement_trait)]
    pub fn default() -> Self {
        MomentumVariational(Variational::lobatto())
    }

    /// A step that is not solved after so many iterations is an error; 100 unless said here.
    #[must_use]
    pub fn with_max_iterations(self, max_iterations: u32) -> Self {
        MomentumVariational(self.0.with_max_iterations(max_iterations))
    }
}

impl<const S: usize> Listed for MomentumVariational<S> {
    fn entry(&self) -> Entry {
        Entry {
            name: "MomentumVariational",
            equations: "",
            ..self.0.entry()
        }
    }
}

symmetric!(MomentumVariational<S>, const S: usize);

impl<S: System, const POINTS: usize> Scheme<S> for MomentumVariational<POINTS> {
    type Carried = Carries<S::Shape, POINTS>;
    type Map<T: Real> = Collocated<T, S::Prepared<T>, POINTS, false>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let map: Self::Map<T> = Scheme::<S>::prepare(&self.0, prepared, step);
        Collocated {
            coordinates: map.momenta,
            momenta: map.coordinates,
            matrices: map
                .matrices
                .map(|[coordinates, momenta]| [momenta, coordinates]),
            ..map
        }
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Carries<VectorOf<S, T>, POINTS> {
        at_rest(state)
    }
}

impl<const DEGREE: usize, const POINTS: usize> Variational<DEGREE, POINTS> {
    /// The equations in the coefficients of Legendre's polynomials, with `velocities` of them for
    /// dq/dt; the caller computes the matrix of the momenta.
    fn with_modes<T: Real, P: Dynamics<T>>(
        &self,
        prepared: &P,
        h: T,
        velocities: Range<usize>,
    ) -> Collocated<T, P, POINTS, false> {
        let polynomials = self.coefficients.polynomials();
        let zero = [[T::zero(); POINTS]; POINTS];
        let (mut coordinates, mut values) = (zero, zero);
        for (i, row) in polynomials.iter().enumerate() {
            for (j, (value, integral)) in row.iter().enumerate() {
                values[i][j] = constant(*value);
                if velocities.contains(&j) {
                    coordinates[i][j] = constant(*integral);
                }
            }
        }
        Collocated {
            field: prepared.field(T::one()),
            dynamics: prepared.clone(),
            h,
            times: multiples(&self.coefficients.nodes, h),
            weights: multiples(&self.coefficients.weights, h),
            spans: [h; POINTS],
            coordinates,
            momenta: zero,
            modes: Some(Modes { values, velocities }),
            matrices: [[zero; 2]; 2],
            limits: [self.max_iterations; 2],
            is_part: false,
        }
    }

    /// The stationary path of a step from time `t` to `t + h` between given ends, with its action and both
    /// its ends.
    ///
    /// The derivatives of the action as a function of the ends are the unknowns at the ends: the
    /// discrete form of the paper's (4), (5) and (18) to (21).
    ///
    /// ```text
    /// type I    S(q₀, q₁):              p₀ = −∂S/∂q₀,  p₁ = ∂S/∂q₁
    /// type II   S⁺(q₀, p₁) = p₁·q₁ − S:   q₁ = ∂S⁺/∂p₁,  p₀ = ∂S⁺/∂q₀
    /// type III  S⁻(q₁, p₀) = −p₀·q₀ − S:  q₀ = −∂S⁻/∂p₀, p₁ = −∂S⁻/∂q₁
    /// ```
    ///
    /// Two steps form one path if the momentum at the end of the first equals that at the beginning
    /// of the second, (6). A symmetry that moves q and preserves H preserves S too, so its momentum
    /// map is the same at both ends, for any ends: discrete Noether conservation. With a force, the
    /// momenta are those of the Lagrange–d'Alembert principle, and not derivatives of S.
    ///
    /// For [`Ends::Coordinates`] ∂H/∂p must determine p. Newton's method begins at rest, p = 0 or the
    /// momentum given.
    ///
    /// # Errors
    /// [`StartError::Step`] if h is zero or not finite, [`InputError::Shape`](crate::errors::InputError::Shape) if an
    /// end does not have the system's shape, [`SearchError::NoStationaryPath`] if no path was found.
    ///
    /// ```
    /// use hamiltonian::schemes::author::Ends;
    #[doc = include_str!("../doc/oscillator.md")]
    /// use hamiltonian::schemes::Variational;
    ///
    /// // From 0 to 1 in a quarter of a period, S = (p₁q₁ − p₀q₀)/2 = 0; in an eighth it is ½.
    /// let scheme = Variational::<4, 4>::gauss();
    /// let State { q, p, .. } = State::new([0.0], [1.0]);
    /// let eighth = core::f64::consts::FRAC_PI_4;
    /// let path = scheme.extremal(&Oscillator {}, 0.0, eighth, Ends::Coordinates(q, p))?;
    /// assert!((path.action - 0.5).abs() < 1e-7);
    /// assert!((path.start.p[0] - 2.0_f64.sqrt()).abs() < 1e-7);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn extremal<T: Real, S: System>(
        &self,
        system: &S,
        t: T,
        h: T,
        ends: Ends<VectorOf<S, T>>,
    ) -> Result<Extremal<VectorOf<S, T>>, Error> {
        let length = h.to_f64();
        if !h.is_finite() || length == 0.0 {
            return Err(StartError::Step { value: length }.into());
        }
        let shape = |q: &VectorOf<S, T>, p: &VectorOf<S, T>| {
            let (q, p) = (q.clone(), p.clone());
            system.check_shape(&State { t, q, p })
        };
        // The point from which the stages are measured.
        let (point, line) = match &ends {
            Ends::Coordinates(q0, q1) => {
                shape(q0, q0)?;
                shape(q1, q1)?;
                let (q, p) = (q0.clone(), q0.zeros_like());
                let mut line = q1.clone();
                line.accumulate(-T::one(), q0);
                line.scale(h.recip());
                (Point { q, p }, Some(line))
            }
            Ends::Right(q, p) | Ends::Left(p, q) => {
                shape(q, p)?;
                let (q, p) = (q.clone(), p.clone());
                (Point { q, p }, None)
            }
        };
        let prepared = system.prepare();
        let first = usize::from(line.is_some());
        let mut map = self.with_modes(&prepared, h, first..DEGREE);
        let integrals = self.coefficients.integrals_of(DEGREE);
        for (i, row) in map.momenta.iter_mut().enumerate() {
            for (j, momentum) in row.iter_mut().enumerate() {
                let of_start = match ends {
                    Ends::Coordinates(..) => self.coefficients.nodes[j],
                    Ends::Right(..) => DoubleDouble::from(0.0),
                    Ends::Left(..) => DoubleDouble::from(1.0),
                };
                *momentum = constant(of_start - integrals[j][i]);
            }
        }
        if matches!(ends, Ends::Left(..)) {
            // From the other end, the first polynomial, 1, is integrated backwards.
            for row in &mut map.coordinates {
                row[0] -= T::one();
            }
        }
        let mut unknowns = Stages(core::array::from_fn(|_| point.zeros_like()));
        let mut work = CollocatedWork::new(&point, &unknowns);
        let mut action = T::zero();
        let mut velocity = point.q.zeros_like();
        let outcome = map.solve_between(
            t,
            &point,
            line.as_ref(),
            &mut unknowns,
            &mut work,
            |equations, unknowns| {
                for i in 0..POINTS {
                    equations.stage(i, unknowns);
                    velocity.set_zero();
                    equations.less_velocity(i, unknowns, &mut velocity);
                    let Point { q, p } = &*equations.stage;
                    let energy = prepared.energy(t + map.times[i], q, p);
                    action -= map.weights[i] * (dot(p, &velocity) + energy);
                }
            },
        );
        if !outcome.solved.all() {
            let lane = (!outcome.solved).first().unwrap_or(0);
            return Err(SearchError::NoStationaryPath {
                time: t.to_f64(),
                length,
                residual: outcome.residual.lane(lane),
                iterations: outcome.iterations,
            }
            .into());
        }
        let increments = &work.increments.0;
        let (one, change) = (T::one(), &increments[0].q);
        let mut impulse = point.p.zeros_like();
        for increment in increments {
            impulse.accumulate(one, &increment.p);
        }
        let (mut start, mut end) = (point.clone(), point);
        match ends {
            Ends::Coordinates(_, q1) => {
                // The mean of the momentum, minus its changes up to this point.
                start.p.copy_from(&unknowns.0[0].q);
                for (increment, c) in increments.iter().zip(self.coefficients.nodes) {
                    start.p.accumulate(constant::<T>(c) - one, &increment.p);
                }
                end.q = q1;
                end.p.copy_from(&start.p);
                end.p.accumulate(one, &impulse);
            }
            Ends::Right(..) => {
                end.q.accumulate(one, change);
                start.p.accumulate(-one, &impulse);
            }
            Ends::Left(..) => {
                start.q.accumulate(-one, change);
                end.p.accumulate(one, &impulse);
            }
        }
        Ok(Extremal { action, start, end })
    }
}

/// Conditions at the ends of a path.
#[derive(Debug, Clone, PartialEq)]
pub enum Ends<V> {
    /// q₀ and q₁, type I.
    Coordinates(V, V),
    /// q₀ and p₁, type II.
    Right(V, V),
    /// p₀ and q₁, type III.
    Left(V, V),
}

/// A stationary path of one step: its discrete action and its ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Extremal<V: Vector> {
    /// S = h Σ bᵢ (Pᵢ·q̇(tᵢ) − H(Qᵢ, Pᵢ, tᵢ)), the discrete Lagrangian, of q₀ and q₁.
    pub action: V::Scalar,
    /// (q₀, p₀).
    pub start: Point<V>,
    /// (q₁, p₁).
    pub end: Point<V>,
}

impl<V: Vector> Extremal<V> {
    /// S⁺ = p₁·q₁ − S, the right discrete Hamiltonian, of q₀ and p₁.
    pub fn right(&self) -> V::Scalar {
        dot(&self.end.p, &self.end.q) - self.action
    }

    /// S⁻ = −p₀·q₀ − S, the left discrete Hamiltonian, of p₀ and q₁.
    pub fn left(&self) -> V::Scalar {
        -dot(&self.start.p, &self.start.q) - self.action
    }
}

//! Collocation: the coefficients of Gauss' and Lobatto's methods for any number of stages.
//!
//! Input: the number of stages. Output: [`Collocation`]: nodes, weights and integrals of Lagrange's
//! polynomials, in double-double, from Legendre's polynomials alone. Invariant: B(2s) (Gauss) or
//! B(2s − 2) (Lobatto) and C(s) hold to 1e-30, and nothing allocates.
//!
//! With the shifted Legendre polynomials P₀, P₁, … on [0, 1] and a quadrature that is exact for
//! degree 2s − 2, Lagrange's polynomials are `ℓⱼ(x) = bⱼ Σ (2k + 1) Pₖ(cⱼ) Pₖ(x)`, k = 0 … s − 1, and
//! `∫₀ˣ Pₖ = (Pₖ₊₁(x) − Pₖ₋₁(x))/(2(2k + 1))`. So `aᵢⱼ = bⱼ μᵢⱼ` with
//!
//! `μᵢⱼ = cᵢ + ½ Σ Pₖ(cⱼ) (Pₖ₊₁(cᵢ) − Pₖ₋₁(cᵢ))`, k = 1 … s − 1,
//!
//! without a division; for Lobatto's nodes, whose quadrature makes the norm of Pₛ₋₁ (2s − 1)/(s − 1)
//! times too large, the last term is that much smaller.

use core::f64::consts::PI;
use hamiltonian_lanes::{DoubleDouble, Real};

/// Nodes and coefficients of the collocation method with `S` stages.
///
/// # Source
/// E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2006, sections II.1.2 to II.1.4,
/// doi:10.1007/3-540-30666-8.
///
/// ```
/// use hamiltonian::schemes::collocation::Collocation;
/// // Two stages: c = ½ ∓ √3/6, b = ½.
/// let gauss = Collocation::<2>::gauss();
/// assert!((gauss.nodes[0].hi() - (0.5 - 3f64.sqrt() / 6.0)).abs() < 1e-15);
/// assert_eq!(gauss.weights[1].hi(), 0.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collocation<const S: usize> {
    /// The nodes c₁ < c₂ < … in [0, 1].
    pub nodes: [DoubleDouble; S],
    /// The weights b of the quadrature over [0, 1].
    pub weights: [DoubleDouble; S],
    /// `integrals[i][j] = aᵢⱼ/bⱼ`, where `aᵢⱼ` is the integral of ℓⱼ from 0 to cᵢ.
    pub integrals: [[DoubleDouble; S]; S],
    /// The quadrature's value of 1/⟨Pₛ₋₁, Pₛ₋₁⟩, in units of 2s − 1.
    last: DoubleDouble,
}

impl<const S: usize> Collocation<S> {
    /// Gauss' nodes, the zeros of the Legendre polynomial: order 2s, symplectic.
    pub fn gauss() -> Self {
        const { assert!(S > 0, "collocation needs a stage") };
        known(|eight| &eight.method).unwrap_or_else(Self::computed)
    }

    /// [`gauss`](Self::gauss).
    fn computed() -> Self {
        Self::at(
            |j| {
                let mut x = number(Real::cos(PI * (j as f64 + 0.75) / (S as f64 + 0.5)));
                for _ in 0..NEWTON {
                    let (here, slope) = Legendre::of(S, x);
                    x -= here / slope;
                }
                let (_, slope) = Legendre::of(S, x);
                (x, number(1.0) / ((number(1.0) - x * x) * slope * slope))
            },
            number(1.0),
        )
    }

    /// Lobatto's nodes, 0, 1 and the zeros between of the derivative of the Legendre polynomial of
    /// degree s − 1: order 2s − 2. Lobatto IIIA is `aᵢⱼ` and IIIB `bⱼ(1 − aⱼᵢ/bᵢ)`
    /// ([`Collocation::conjugate`]); the pair is symplectic.
    pub fn lobatto() -> Self {
        const { assert!(S > 1, "Lobatto's nodes are two at least") };
        let n = number((S - 1) as f64);
        let square = n * (n + number(1.0));
        Self::at(
            |j| {
                let mut x = number(Real::cos(PI * j as f64 / (S - 1) as f64));
                // (1 − x²)P′ has the derivative −n(n + 1)P, and its zero 1 stays where it is.
                for _ in 0..NEWTON {
                    let (here, slope) = Legendre::of(S - 1, x);
                    x += (number(1.0) - x * x) * slope / (square * here);
                }
                let (here, _) = Legendre::of(S - 1, x);
                (x, number(1.0) / (square * here * here))
            },
            number((S - 1) as f64) / number((2 * S - 1) as f64),
        )
    }

    /// The method at nodes x on [−1, 1] with their weights on [0, 1], given from the largest x down to
    /// the middle; `last` is the factor of the term k = s − 1.
    fn at(node: impl Fn(usize) -> (DoubleDouble, DoubleDouble), last: DoubleDouble) -> Self {
        let mut x = [number(0.0); S];
        let mut weights = [number(0.0); S];
        for j in 0..S / 2 {
            let (node, weight) = node(j);
            (x[S - 1 - j], x[j]) = (node, -node);
            (weights[S - 1 - j], weights[j]) = (weight, weight);
        }
        if S % 2 == 1 {
            // This is exactly zero.
            weights[S / 2] = node(S / 2).1;
        }
        let half = number(0.5);
        let nodes = x.map(|x| half + half * x);
        let mut integrals = nodes.map(|c| [c; S]);
        let mut polynomials = x.map(Legendre::new);
        for k in 1..S {
            polynomials = polynomials.map(Legendre::next);
            let factor = if k + 1 == S { half * last } else { half };
            for (row, at_i) in integrals.iter_mut().zip(&polynomials) {
                let rise = at_i.next().here.0 - at_i.before.0;
                for (integral, at_j) in row.iter_mut().zip(&polynomials) {
                    *integral += factor * at_j.here.0 * rise;
                }
            }
        }
        Collocation {
            nodes,
            weights,
            integrals,
            last,
        }
    }

    /// 1/⟨Pₖ, Pₖ⟩ by the quadrature: 2k + 1, but for Lobatto's nodes and k = s − 1.
    pub(super) fn norm(&self, k: usize) -> DoubleDouble {
        let odd = number((2 * k + 1) as f64);
        if k + 1 == S { odd * self.last } else { odd }
    }

    /// `polynomials[i][k]`: Pₖ at node i, and its integral from 0 to there.
    pub(super) fn polynomials(&self) -> [[(DoubleDouble, DoubleDouble); S]; S] {
        self.nodes.map(|c| {
            let mut polynomial = Legendre::new(c + c - number(1.0));
            let mut k = 0;
            [(); S].map(|()| {
                let here = polynomial;
                polynomial = here.next();
                let integral = if k == 0 {
                    c
                } else {
                    (polynomial.here.0 - here.before.0) / number((4 * k + 2) as f64)
                };
                k += 1;
                (here.here.0, integral)
            })
        })
    }

    /// `μᵢⱼ` where the slopes' polynomial has the degree `degree` − 1 and is the one nearest to the
    /// slopes in the sense of the quadrature: `Σ Pₖ(cⱼ) ∫₀^cᵢ Pₖ / ⟨Pₖ, Pₖ⟩`, k < `degree`. With `degree`
    /// = s that is [`integrals`](Self::integrals).
    pub(super) fn integrals_of(&self, degree: usize) -> [[DoubleDouble; S]; S] {
        if degree == S {
            return self.integrals;
        }
        let polynomials = self.polynomials();
        polynomials.map(|at_i| {
            polynomials.map(|at_j| {
                let mut sum = number(0.0);
                for k in 0..degree {
                    sum += self.norm(k) * at_j[k].0 * at_i[k].1;
                }
                sum
            })
        })
    }

    /// The coefficients in another scalar, `μᵢⱼ`, and `1 − μⱼᵢ` for the momenta, whose sum is
    /// exactly 1.
    pub(super) fn pair<T: Real>(&self, degree: usize) -> ([[T; S]; S], [[T; S]; S]) {
        let integrals = self.integrals_of(degree);
        let mut coordinates = integrals.map(|row| row.map(constant::<T>));
        let mut momenta = coordinates;
        for (j, row) in coordinates.iter_mut().enumerate() {
            for (i, here) in row.iter_mut().enumerate() {
                let there = number(1.0) - integrals[j][i];
                // One less the larger of the two is exact.
                if integrals[j][i].hi().abs() > there.hi().abs() {
                    momenta[i][j] = T::one() - *here;
                } else {
                    momenta[i][j] = constant(there);
                    *here = T::one() - momenta[i][j];
                }
            }
        }
        (coordinates, momenta)
    }

    /// The first and the last node.
    pub(super) fn ends(&self) -> [f64; 2] {
        [self.nodes[0].hi(), self.nodes[S - 1].hi()]
    }

    /// `aᵢⱼ`.
    pub fn a(&self, i: usize, j: usize) -> DoubleDouble {
        self.integrals[i][j] * self.weights[j]
    }

    /// `âᵢⱼ = bⱼ(1 − aⱼᵢ/bᵢ)`, with which `bᵢâᵢⱼ + bⱼaⱼᵢ = bᵢbⱼ`: the method for p that makes the one
    /// for q symplectic.
    pub fn conjugate(&self, i: usize, j: usize) -> DoubleDouble {
        (number(1.0) - self.integrals[j][i]) * self.weights[j]
    }

    /// `μᵢⱼ = aᵢⱼ/bⱼ` of Gauss' method in another scalar, with `μᵢⱼ + μⱼᵢ = 1` exactly.
    ///
    /// With this rounding, the method is symplectic in the arithmetic of the scalar too: M.
    /// Antoñana, J. Makazaga, A. Murua, Numer. Algorithms 76, 861 (2017), section 3,
    /// doi:10.1007/s11075-017-0287-z.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub fn symplectic<T: Real>(&self) -> [[T; S]; S] {
        let mut mu = [[T::constant(0.5, 0.0); S]; S];
        for (i, row) in mu.iter_mut().enumerate() {
            for (j, to) in row.iter_mut().enumerate() {
                let (here, there) = (self.integrals[i][j], self.integrals[j][i]);
                let (size, other) = (here.hi().abs(), there.hi().abs());
                // One less the larger of the two is exact.
                if i != j {
                    *to = if size > other || (size == other && i < j) {
                        constant(here)
                    } else {
                        T::one() - constant::<T>(there)
                    };
                }
            }
        }
        mu
    }
}

impl<const S: usize> Collocation<S> {
    /// cᵢh and νᵢⱼh with `νᵢⱼ = Σ μᵢₖbₖμₖⱼ = (A²)ᵢⱼ/bⱼ` of Gauss' method in another scalar, with
    /// `νᵢⱼh − νⱼᵢh = cᵢh − cⱼh` exactly and h − cᵢh without rounding.
    ///
    /// With this rounding, the Nyström method `Q = q + ch M⁻¹p + h M⁻¹ Σ νᵢⱼ kⱼ` with the kicks k
    /// of p and their parts 1 − c in q is symplectic in the arithmetic of the scalar too: E.
    /// Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), theorem IV.2.3,
    /// doi:10.1007/3-540-30666-8.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn symplectic_double<T: Real>(&self, h: T) -> ([T; S], [[T; S]; S]) {
        let mut times = [T::zero(); S];
        for (to, c) in times.iter_mut().zip(&self.nodes) {
            *to = whole_ulps(*c, h);
        }
        let exact = self.double_integrals();
        let mut double = [[T::zero(); S]; S];
        for i in 0..S {
            for j in 0..=i {
                double[i][j] = whole_ulps(exact[i][j], h);
                double[j][i] = double[i][j] - (times[i] - times[j]);
            }
        }
        (times, double)
    }

    /// νᵢⱼ for j ≤ i.
    fn double_integrals(&self) -> [[DoubleDouble; S]; S] {
        known(|eight| &eight.double).unwrap_or_else(|| self.computed_double())
    }

    #[inline(never)]
    fn computed_double(&self) -> [[DoubleDouble; S]; S] {
        let mut double = [[number(0.0); S]; S];
        for (i, row) in double.iter_mut().enumerate() {
            for (j, sum) in row.iter_mut().enumerate().take(i + 1) {
                for k in 0..S {
                    *sum += self.integrals[i][k] * self.weights[k] * self.integrals[k][j];
                }
            }
        }
        double
    }
}

impl<const S: usize> Collocation<S> {
    /// Weights of the stages in the last two coefficients of the slopes' polynomial, in Legendre's polynomials, and in its
    /// values at 0 and at 1, of Gauss' method.
    pub(super) fn of_slopes(&self) -> [[DoubleDouble; S]; 4] {
        known(|eight| &eight.of_slopes).unwrap_or_else(|| self.computed_of_slopes())
    }

    fn computed_of_slopes(&self) -> [[DoubleDouble; S]; 4] {
        let polynomials = self.polynomials();
        let mut rows = [[number(0.0); S]; 4];
        for i in 0..S {
            for k in 0..S {
                let weight = self.norm(k) * self.weights[i] * polynomials[i][k].0;
                if k + 2 >= S {
                    rows[S - 1 - k][i] = weight;
                }
                // Pₖ is 1 at 1 and (−1)ᵏ at 0.
                let sign = [1.0, -1.0][k % 2];
                rows[2][i] += number(sign) * weight;
                rows[3][i] += weight;
            }
        }
        rows
    }
}

/// The numbers of Gauss' method with eight stages, that of runs to a tolerance.
#[cfg_attr(not(feature = "std"), allow(dead_code))]
struct Eight {
    method: Collocation<8>,
    double: [[DoubleDouble; 8]; 8],
    of_slopes: [[DoubleDouble; 8]; 4],
}

/// Numbers that are computed once: each time, they would take longer than a hundred steps. `None` if `A` is the type of
/// those of another number of stages, and without the standard library.
#[cfg(feature = "std")]
fn known<A: Copy + 'static, B: 'static>(of: fn(&'static Eight) -> &'static B) -> Option<A> {
    static EIGHT: std::sync::OnceLock<Eight> = std::sync::OnceLock::new();
    if core::any::TypeId::of::<A>() != core::any::TypeId::of::<B>() {
        return None;
    }
    let eight = EIGHT.get_or_init(|| {
        let method = Collocation::computed();
        Eight {
            method,
            double: method.computed_double(),
            of_slopes: method.computed_of_slopes(),
        }
    });
    let numbers: &dyn core::any::Any = of(eight);
    numbers.downcast_ref().copied()
}

#[cfg(not(feature = "std"))]
fn known<A, B: 'static>(_: fn(&'static Eight) -> &'static B) -> Option<A> {
    None
}

/// `part·h` for a part from 0 to 1, rounded to a multiple of the last place of h: sums and differences of such
/// numbers up to h are exact.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn whole_ulps<T: Real>(part: DoubleDouble, h: T) -> T {
    (constant::<T>(part) * h + h) - h
}

/// From starts that are right to a few per cent, six steps of Newton's method double the digits to
/// more than 32; one is for safety.
const NEWTON: usize = 7;

fn number(value: f64) -> DoubleDouble {
    DoubleDouble::from(value)
}

/// Converts a number to another scalar.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn constant<T: Real>(x: DoubleDouble) -> T {
    T::constant(x.hi(), x.lo())
}

/// `numbers`·h.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn multiples<T: Real, const S: usize>(numbers: &[DoubleDouble; S], h: T) -> [T; S] {
    let mut all = [T::zero(); S];
    for (to, number) in all.iter_mut().zip(numbers) {
        *to = constant::<T>(*number) * h;
    }
    all
}

/// Legendre's polynomials at a point of [−1, 1] with their derivatives, one degree after another.
#[derive(Clone, Copy)]
struct Legendre {
    x: DoubleDouble,
    /// The number of calls of [`Legendre::next`].
    degree: usize,
    before: (DoubleDouble, DoubleDouble),
    /// Value and derivative.
    here: (DoubleDouble, DoubleDouble),
}

impl Legendre {
    /// P₀.
    fn new(x: DoubleDouble) -> Self {
        Legendre {
            x,
            degree: 0,
            before: (number(0.0), number(0.0)),
            here: (number(1.0), number(0.0)),
        }
    }

    /// Value and derivative of the polynomial of this degree.
    fn of(degree: usize, x: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
        let mut polynomial = Self::new(x);
        for _ in 0..degree {
            polynomial = polynomial.next();
        }
        polynomial.here
    }

    /// (k + 1)Pₖ₊₁ = (2k + 1)xPₖ − kPₖ₋₁ and P′ₖ₊₁ = P′ₖ₋₁ + (2k + 1)Pₖ.
    fn next(self) -> Self {
        let k = self.degree as f64;
        let odd = number(2.0 * k + 1.0);
        let value = (odd * self.x * self.here.0 - number(k) * self.before.0) / number(k + 1.0);
        Legendre {
            x: self.x,
            degree: self.degree + 1,
            before: self.here,
            here: (value, self.before.1 + odd * self.here.0),
        }
    }
}

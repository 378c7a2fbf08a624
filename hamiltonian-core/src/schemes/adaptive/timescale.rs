//! The time scale of an orbit at a point, from the derivatives of the orbit there.
//!
//! Input: J∇H and a point. Output: Q, the density of steps, and G = d ln Q/dt. Invariant: both are functions of the
//! point and of the size of τ, Q even and G odd under time reversal, to rounding.
//!
//! With dₖ = dᵏ/dt and norms over all coordinates and over all momenta,
//!
//! ```text
//! Q⁴ = (|d₃q|²|d₂p|² + |d₂q|²|d₃p|²)/(|d₂q|²|d₁p|² + |d₁q|²|d₂p|²)
//! ```
//!
//! For T = p²/2m it is (j⁴ + a²s²)/(a⁴ + v²j²) with velocity v, acceleration a, jerk j and snap s: ω for an oscillator at
//! all its points, and r^(−3/2) for Kepler's problem at both apsides, up to a factor. The timescale of Pham, Rein and
//! Spiegel (Open J. Astrophys. 7, 2024, doi:10.21105/astro.2401.02849, eq. 12) is √2·a/√(j² + a·s), which is 0 where a is.

use crate::systems::flow::VectorField;
use crate::systems::state::Point;
use crate::systems::vector::{Vector, dot};
use hamiltonian_lanes::{Mask, Real};

/// The derivatives of an orbit at a point, and scratch.
pub struct Derivatives<V> {
    /// The first to the fourth.
    of: [Point<V>; 4],
    near: Point<V>,
    slope: Point<V>,
}

/// An evaluation of J∇H, at `at`·τ on the Taylor polynomial of degree `degree`. `weight`/τⁿ times its value is a part of
/// derivative n + 1.
struct Difference {
    at: f64,
    degree: usize,
    n: usize,
    weight: f64,
}

const fn difference(at: f64, degree: usize, n: usize, weight: f64) -> Difference {
    Difference {
        at,
        degree,
        n,
        weight,
    }
}

/// Central differences. Each derivative is found along the polynomial of those before it.
const DIFFERENCES: [Difference; 9] = [
    difference(0.0, 0, 0, 1.0),
    difference(1.0, 1, 1, 0.5),
    difference(-1.0, 1, 1, -0.5),
    difference(1.0, 2, 2, 1.0),
    difference(-1.0, 2, 2, 1.0),
    difference(2.0, 3, 3, 0.5),
    difference(1.0, 3, 3, -1.0),
    difference(-1.0, 3, 3, 1.0),
    difference(-2.0, 3, 3, -0.5),
];

#[cfg_attr(not(unoptimised), inline(always))]
fn number<T: Real>(x: f64) -> T {
    T::constant(x, 0.0)
}

impl<V: Vector> Derivatives<V> {
    pub(super) fn like(point: &Point<V>) -> Self {
        Derivatives {
            of: [(); 4].map(|()| point.zeros_like()),
            near: point.zeros_like(),
            slope: point.zeros_like(),
        }
    }

    /// Finds Q⁴ and G at a point, with differences over τ. Where the orbit has no time scale, Q is 0 or NaN.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn scale<F: VectorField<V>>(
        &mut self,
        field: &F,
        t: V::Scalar,
        point: &Point<V>,
        tau: V::Scalar,
    ) -> [V::Scalar; 2] {
        let per = tau.recip();
        for of in &mut self.of {
            of.set_zero();
        }
        for difference in &DIFFERENCES {
            let x = tau * number(difference.at);
            self.near.copy_from(point);
            let mut factor = x;
            for (k, of) in self.of.iter().enumerate().take(difference.degree) {
                self.near.accumulate(factor, of);
                factor = factor * x / number((k + 2) as f64);
            }
            self.slope.set_zero();
            let Point { q, p } = &mut self.slope;
            field.add(t + x, &self.near.q, &self.near.p, q, p);
            let mut weight = number(difference.weight);
            for _ in 0..difference.n {
                weight *= per;
            }
            self.of[difference.n].accumulate(weight, &self.slope);
            if difference.n == 0 {
                // The middle of the second difference.
                self.of[2].accumulate(number::<V::Scalar>(-2.0) * per * per, &self.slope);
            }
        }
        let [mut q, mut p] = [[number(0.0); 4]; 2];
        let [mut q_rate, mut p_rate] = [[number(0.0); 4]; 2];
        for k in 0..3 {
            let (of, next) = (&self.of[k], &self.of[k + 1]);
            q[k] = dot(&of.q, &of.q);
            p[k] = dot(&of.p, &of.p);
            q_rate[k] = number::<V::Scalar>(2.0) * dot(&of.q, &next.q);
            p_rate[k] = number::<V::Scalar>(2.0) * dot(&of.p, &next.p);
        }
        let above = q[2] * p[1] + q[1] * p[2];
        let below = q[1] * p[0] + q[0] * p[1];
        let above_rate = q_rate[2] * p[1] + q[2] * p_rate[1] + q_rate[1] * p[2] + q[1] * p_rate[2];
        let below_rate = q_rate[1] * p[0] + q[1] * p_rate[0] + q_rate[0] * p[1] + q[0] * p_rate[1];
        let rate = number::<V::Scalar>(0.25) * (above_rate / above - below_rate / below);
        let none = !rate.finite();
        [above / below, V::Scalar::select(none, number(0.0), rate)]
    }

    /// The smaller and the larger of |q|/|q̇| and |p|/|ṗ| by the derivatives found last, of those that are positive numbers;
    /// `otherwise` if neither is.
    pub(super) fn times(&self, point: &Point<V>, otherwise: V::Scalar) -> [V::Scalar; 2] {
        let mut times = [otherwise.abs(); 2];
        let mut found = <V::Scalar as Real>::Mask::splat(false);
        let of = &self.of[0];
        for (x, slope) in [(&point.q, &of.q), (&point.p, &of.p)] {
            let time = (dot(x, x) / dot(slope, slope)).sqrt();
            let is_time = time.finite() & number::<V::Scalar>(0.0).lt(time);
            let [least, most] = times;
            let is_least = is_time & (!found | time.lt(least));
            let is_most = is_time & (!found | most.lt(time));
            times = [
                V::Scalar::select(is_least, time, least),
                V::Scalar::select(is_most, time, most),
            ];
            found = found | is_time;
        }
        times
    }
}

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
    /// The first to the fourth; 0 before they are found.
    of: [Point<V>; 4],
    /// Two points on the Taylor polynomial, at opposite times, and J∇H there.
    near: [Point<V>; 2],
    slopes: [Point<V>; 2],
}

#[cfg_attr(not(unoptimised), inline(always))]
fn number<T: Real>(x: f64) -> T {
    T::constant(x, 0.0)
}

/// J∇H at a point.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn slope_at<V: Vector, F: VectorField<V>>(
    field: &F,
    t: V::Scalar,
    point: &Point<V>,
    to: &mut Point<V>,
) {
    to.set_zero();
    field.add(t, &point.q, &point.p, &mut to.q, &mut to.p);
}

/// The velocity at momenta, where it depends on them alone.
#[cfg_attr(not(unoptimised), inline(always))]
fn velocity_at<V: Vector, F: VectorField<V>>(field: &F, t: V::Scalar, p: &V, to: &mut V) {
    to.set_zero();
    field.add_half::<false>(t, p, to);
}

/// The force at coordinates, where it depends on them alone.
#[cfg_attr(not(unoptimised), inline(always))]
fn force_at<V: Vector, F: VectorField<V>>(field: &F, t: V::Scalar, q: &V, to: &mut V) {
    to.set_zero();
    field.add_half::<true>(t, q, to);
}

/// The Taylor polynomial of three derivatives at x and at −x.
#[cfg_attr(not(unoptimised), inline(always))]
fn beside<X: Vector>(x: X::Scalar, at: &X, of: [&X; 3], [later, earlier]: [&mut X; 2]) {
    let square = number::<X::Scalar>(0.5) * x * x;
    let cube = number::<X::Scalar>(1.0 / 6.0) * x * x * x;
    for k in 0..X::PARTS {
        let (one, two, three) = (of[0].part(k), of[1].part(k), of[2].part(k));
        let (later, earlier) = (later.part_mut(k), earlier.part_mut(k));
        for (i, at) in at.part(k).iter().enumerate() {
            let even = *at + square * two[i];
            let odd = x * one[i] + cube * three[i];
            later[i] = even + odd;
            earlier[i] = even - odd;
        }
    }
}

/// `to += weight·(later + sign·earlier)`.
#[cfg_attr(not(unoptimised), inline(always))]
fn add<X: Vector>(weight: X::Scalar, sign: f64, [later, earlier]: [&X; 2], to: &mut X) {
    to.accumulate(weight, later);
    to.accumulate(weight * number(sign), earlier);
}

impl<V: Vector> Derivatives<V> {
    pub(super) fn like(point: &Point<V>) -> Self {
        Derivatives {
            of: [(); 4].map(|()| point.zeros_like()),
            near: [(); 2].map(|()| point.zeros_like()),
            slopes: [(); 2].map(|()| point.zeros_like()),
        }
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn take(&mut self) -> Self {
        let [first, second, third, fourth] = &mut self.of;
        let [near, slopes] = [&mut self.near, &mut self.slopes];
        Derivatives {
            of: [first.take(), second.take(), third.take(), fourth.take()],
            near: [near[0].take(), near[1].take()],
            slopes: [slopes[0].take(), slopes[1].take()],
        }
    }

    /// Finds J∇H at t + x and t − x on the Taylor polynomial of the derivatives found so far.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn evaluate_beside<F: VectorField<V>>(
        &mut self,
        field: &F,
        t: V::Scalar,
        point: &Point<V>,
        x: V::Scalar,
    ) {
        let [later, earlier] = &mut self.near;
        let [one, two, three, _] = &self.of;
        beside(x, point, [one, two, three], [later, earlier]);
        let [above, below] = &mut self.slopes;
        slope_at(field, t + x, later, above);
        slope_at(field, t - x, earlier, below);
    }

    /// Finds the forces there, where they depend on coordinates alone.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn evaluate_forces_beside<F: VectorField<V>>(
        &mut self,
        field: &F,
        t: V::Scalar,
        point: &Point<V>,
        x: V::Scalar,
    ) {
        let [later, earlier] = &mut self.near;
        let [one, two, three, _] = &self.of;
        let of = [&one.q, &two.q, &three.q];
        beside(x, &point.q, of, [&mut later.q, &mut earlier.q]);
        let [above, below] = &mut self.slopes;
        force_at(field, t + x, &later.q, &mut above.p);
        force_at(field, t - x, &earlier.q, &mut below.p);
    }

    /// Derivative `n` + 1 `+= weight`·(J∇H later + `sign`·J∇H earlier).
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add(&mut self, n: usize, weight: V::Scalar, sign: f64) {
        let [later, earlier] = &self.slopes;
        add(weight, sign, [later, earlier], &mut self.of[n]);
    }

    /// The same of the momenta.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add_forces(&mut self, n: usize, weight: V::Scalar, sign: f64) {
        let [later, earlier] = &self.slopes;
        add(weight, sign, [&later.p, &earlier.p], &mut self.of[n].p);
    }

    /// Finds the derivatives, each from the ones before.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn find<F: VectorField<V>>(
        &mut self,
        field: &F,
        t: V::Scalar,
        point: &Point<V>,
        tau: V::Scalar,
    ) {
        let (half, two) = (number::<V::Scalar>(0.5), number::<V::Scalar>(2.0));
        let per = tau.recip();
        let [square, cube] = [per * per, per * per * per];
        slope_at(field, t, point, &mut self.of[0]);
        self.evaluate_beside(field, t, point, tau);
        self.add(1, half * per, -1.0);
        self.evaluate_beside(field, t, point, tau);
        self.add(2, square, 1.0);
        let [first, _, third, _] = &mut self.of;
        third.accumulate(-two * square, first);
        self.evaluate_beside(field, t, point, tau);
        self.add(3, -cube, -1.0);
        self.evaluate_beside(field, t, point, two * tau);
        self.add(3, half * cube, -1.0);
    }

    /// Finds them for q̈ = −M⁻¹∂V/∂q: coordinates have a derivative more than momenta, so that two evaluations of forces
    /// follow one another in place of four.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn find_of_second_order<F: VectorField<V>>(
        &mut self,
        field: &F,
        t: V::Scalar,
        point: &Point<V>,
        tau: V::Scalar,
    ) {
        let (half, two) = (number::<V::Scalar>(0.5), number::<V::Scalar>(2.0));
        let per = tau.recip();
        let [square, cube] = [per * per, per * per * per];
        velocity_at(field, t, &point.p, &mut self.of[0].q);
        force_at(field, t, &point.q, &mut self.of[0].p);
        self.evaluate_forces_beside(field, t, point, tau);
        self.add_forces(1, half * per, -1.0);
        let [first, second, third, _] = &mut self.of;
        velocity_at(field, t, &first.p, &mut second.q);
        velocity_at(field, t, &second.p, &mut third.q);
        third.p.accumulate(-two * square, &first.p);
        self.evaluate_forces_beside(field, t, point, tau);
        self.add_forces(2, square, 1.0);
        self.add_forces(3, -cube, -1.0);
        self.evaluate_forces_beside(field, t, point, two * tau);
        self.add_forces(3, half * cube, -1.0);
        let [_, _, third, fourth] = &mut self.of;
        velocity_at(field, t, &third.p, &mut fourth.q);
    }

    /// Finds Q⁴ and G at a point, with central differences over τ. Where the orbit has no time scale, Q is 0 or NaN.
    ///
    /// `IS_QUADRATIC` says that H = ½pᵀM⁻¹p + V(q, t).
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn scale<F: VectorField<V>, const IS_QUADRATIC: bool>(
        &mut self,
        field: &F,
        t: V::Scalar,
        point: &Point<V>,
        tau: V::Scalar,
    ) -> [V::Scalar; 2] {
        // Moved out, they are variables of this function alone and may stay in registers.
        let mut here = self.take();
        for of in &mut here.of[1..] {
            of.set_zero();
        }
        if IS_QUADRATIC && field.has_halves() {
            here.find_of_second_order(field, t, point, tau);
        } else {
            here.find(field, t, point, tau);
        }
        let [mut q, mut p] = [[number(0.0); 4]; 2];
        let [mut q_rate, mut p_rate] = [[number(0.0); 4]; 2];
        for k in 0..3 {
            let (of, next) = (&here.of[k], &here.of[k + 1]);
            q[k] = dot(&of.q, &of.q);
            p[k] = dot(&of.p, &of.p);
            q_rate[k] = number::<V::Scalar>(2.0) * dot(&of.q, &next.q);
            p_rate[k] = number::<V::Scalar>(2.0) * dot(&of.p, &next.p);
        }
        *self = here;
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

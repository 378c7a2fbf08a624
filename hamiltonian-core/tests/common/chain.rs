//! A chain of sites by hand, of a size set at run time.

use super::systems::{Half, Moving, number};
use hamiltonian_core::private::DVector;
use hamiltonian_core::{
    Exact, Real, Separable, Split, System, Unforced,
    schemes::author::{Description, Dynamics, Flow, Group, Piece, Point, VectorField},
};
use hamiltonian_lanes::Pack;

/// A chain of n sites between fixed ends, sized at run time:
/// H = Σ p²/2 + Σ (q[i+1] − q[i])²/2 + Σ q⁴/4.
#[derive(Debug, Clone)]
pub struct Chain {
    pub n: usize,
}

const GROUPS: &[Group] = &[Group::array("q", "p", 1, 0, 1)];
const CHAIN: &Description = &Description::new("Chain", GROUPS);

/// A chain with a step coefficient.
#[derive(Debug, Clone)]
pub struct ScaledChain<T>(T);

impl System for Chain {
    type Shape = DVector<()>;
    type Prepared<T: Real> = Chain;
    fn description(&self) -> &Description {
        CHAIN
    }
    fn prepare<T: Real>(&self) -> Chain {
        self.clone()
    }
    fn zeros<T: Real>(&self) -> DVector<T> {
        DVector::from_element(self.n, T::zero())
    }
    fn gather<T: Real, P: Pack>(members: &[&Self::Prepared<T>]) -> Self::Prepared<T::Over<P>> {
        members[0].clone()
    }
    fn fits<T: Real>(_: &Self::Prepared<T>, _: &Self::Prepared<T>) -> bool {
        true
    }
    fn equals<T: Real>(_: &Self::Prepared<T>, _: &Self::Prepared<T>) -> bool {
        true
    }
}

impl Chain {
    fn force<T: Real>(q: &DVector<T>, i: usize) -> T {
        let left = if i > 0 { q[i] - q[i - 1] } else { q[i] };
        let right = if i + 1 < q.len() {
            q[i] - q[i + 1]
        } else {
            q[i]
        };
        left + right + q[i] * q[i] * q[i]
    }
}

impl<T: Real> Dynamics<T> for Chain {
    type Vector = DVector<T>;
    type Field = ScaledChain<T>;
    fn description(&self) -> &Description {
        CHAIN
    }
    fn energy(&self, _: T, q: &DVector<T>, p: &DVector<T>) -> T {
        let (half, quarter) = (number::<T>(0.5), number::<T>(0.25));
        let mut sum = half * q[self.n - 1] * q[self.n - 1];
        for i in 0..self.n {
            let left = if i > 0 { q[i] - q[i - 1] } else { q[i] };
            let square = q[i] * q[i];
            sum += half * (p[i] * p[i] + left * left) + quarter * square * square;
        }
        sum
    }
    fn gradient_q(&self, _: T, q: &DVector<T>, _: &DVector<T>, out: &mut DVector<T>) {
        for i in 0..self.n {
            out[i] = Chain::force(q, i);
        }
    }
    fn gradient_p(&self, _: T, _: &DVector<T>, p: &DVector<T>, out: &mut DVector<T>) {
        out.copy_from_slice(p.as_slice());
    }
    fn time_derivative(&self, _: T, _: &DVector<T>, _: &DVector<T>) -> T {
        T::zero()
    }
    fn hessian_vector(
        &self,
        _: T,
        q: &DVector<T>,
        _: &DVector<T>,
        vq: &DVector<T>,
        vp: &DVector<T>,
        out_q: &mut DVector<T>,
        out_p: &mut DVector<T>,
    ) {
        // Nothing may allocate here. The linear part of the force is that of the springs.
        for i in 0..self.n {
            let springs = Chain::force(vq, i) - vq[i] * vq[i] * vq[i];
            out_q[i] = springs + number::<T>(3.0) * q[i] * q[i] * vq[i];
            out_p[i] = vp[i];
        }
    }
    fn observable(&self, _: usize, _: T, _: &DVector<T>, _: &DVector<T>) -> T {
        T::zero()
    }
    fn field(&self, c: T) -> ScaledChain<T> {
        ScaledChain(c)
    }
}

impl<T: Real> ScaledChain<T> {
    fn kick(&self, q: &DVector<T>, p: &mut DVector<T>) {
        for i in 0..q.len() {
            p[i] -= self.0 * Chain::force(q, i);
        }
    }
    fn drift(&self, p: &DVector<T>, q: &mut DVector<T>) {
        for i in 0..p.len() {
            q[i] = self.0.fma(p[i], q[i]);
        }
    }
}

impl<T: Real> VectorField<DVector<T>> for ScaledChain<T> {
    fn add(
        &self,
        _: T,
        q: &DVector<T>,
        p: &DVector<T>,
        into_q: &mut DVector<T>,
        into_p: &mut DVector<T>,
    ) {
        self.drift(p, into_q);
        self.kick(q, into_p);
    }
}

impl<T: Real, const KICK: bool> Piece<T, Chain> for Half<KICK> {
    type Point = Point<DVector<T>>;
    type Flow = Moving<ScaledChain<T>, KICK>;
    fn flow(&self, _: &Chain, c: T) -> Self::Flow {
        Moving(ScaledChain(c))
    }
}

impl<T: Real, const KICK: bool> Flow<Point<DVector<T>>> for Moving<ScaledChain<T>, KICK> {
    const NAME: &'static str = if KICK { "V" } else { "T" };
    type Work = ();
    fn apply(&self, _: T, x: &mut Point<DVector<T>>, _: &mut ()) {
        if KICK {
            self.0.kick(&x.q, &mut x.p);
        } else {
            self.0.drift(&x.p, &mut x.q);
        }
    }
}

impl Separable for Chain {
    type Kick<T: Real> = Half<true>;
    type Drift<T: Real> = Half<false>;
    fn kick<T: Real>() -> Half<true> {
        Half
    }
    fn drift<T: Real>() -> Half<false> {
        Half
    }
}

impl Split for Chain {
    type Pieces<T: Real> = (Half<true>, Half<false>);
    fn pieces<T: Real>() -> Self::Pieces<T> {
        (Half, Half)
    }
}

impl Unforced for Chain {}
impl Exact for Chain {}

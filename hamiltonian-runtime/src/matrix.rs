//! The exact flow of a quadratic form, as a matrix of run time.
//!
//! Input: a function that adds the rates for a raised coefficient. Output: [`Matrix`]. Invariant: the operations of
//! core's `Exponential`, in their order, so that the bits are the same.

use crate::prepared::Flat;
use hamiltonian_core::private::{exponentiate, image};
use hamiltonian_core::schemes::author::Point;
use hamiltonian_lanes::Real;

/// z ← z + Fz + g, with the coordinates and behind them the momenta as one vector z.
#[derive(Debug, Clone)]
pub(crate) struct Matrix<T> {
    /// e^{cM} − 1, row after row.
    less_one: Vec<T>,
    /// The image of the origin.
    shift: Vec<T>,
}

impl<T: Real> Matrix<T> {
    /// The flow whose rates a function adds to a point, for so many degrees of freedom.
    pub(crate) fn new(width: usize, mut add: impl FnMut(&mut Point<Flat<T>>)) -> Self {
        let n = 2 * width;
        let vector = || vec![T::zero(); n];
        let matrix = || vec![T::zero(); n * n];
        let zeros = || Flat::from_element(width, T::zero());
        let (q, p) = (zeros(), zeros());
        let mut point = Point { q, p };
        let moves = |place: Option<usize>, column: &mut [T]| {
            let Point { q, p } = &mut point;
            let unit = |at| match Some(at) == place {
                true => T::one(),
                false => T::zero(),
            };
            let all = q.iter_mut().chain(p.iter_mut());
            all.enumerate().for_each(|(at, x)| *x = unit(at));
            add(&mut point);
            let all = point.q.iter().chain(&point.p);
            column.iter_mut().zip(all).for_each(|(to, x)| *to = *x);
        };
        let (mut less_one, mut shift) = (matrix(), vector());
        let [mut a, mut b, mut c] = [matrix(), matrix(), matrix()];
        let [mut u, mut v] = [vector(), vector()];
        let scratch = [&mut *a, &mut *b, &mut *c];
        exponentiate(
            moves,
            &mut less_one,
            &mut shift,
            scratch,
            [&mut *u, &mut *v],
        );
        Matrix { less_one, shift }
    }

    /// Moves a point, with scratch for it as one vector and for its image.
    pub(crate) fn apply(&self, x: &mut Point<Flat<T>>, [z, moved]: &mut [Vec<T>; 2]) {
        z.clear();
        z.extend(x.q.iter().chain(&x.p));
        moved.resize(z.len(), T::zero());
        image(&self.less_one, z, moved);
        let all = x.q.iter_mut().chain(x.p.iter_mut());
        for (i, to) in all.enumerate() {
            *to = z[i] + (moved[i] + self.shift[i]);
        }
    }
}

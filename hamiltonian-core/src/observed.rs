//! An observable of a system, as a function on phase space with all its derivatives.
//!
//! Input: a system and the name of a monitor of it. Output: [`Observed`], a system whose H is that monitor.
//! Invariant: derivatives are those of the observable's own code, over dual numbers.

use crate::error::Error;
use crate::flow::VectorField;
use crate::system::{Autonomous, Dynamics, Group, Observable, System, Unforced};
use crate::vector::Vector;
use alloc::string::ToString;
use core::fmt;
use hamiltonian_lanes::{Dual, Real};

/// A monitor (invariant, event) of a system as a Hamiltonian: its value for H.
///
/// It is a monitor function for [`TimeTransformed`](crate::TimeTransformed), and its flow is the symmetry
/// that an invariant generates. Derivatives are taken over dual numbers, once for each coordinate and
/// momentum, the second along a direction likewise.
///
/// ```
/// use hamiltonian::schemes::author::Observed;
#[doc = include_str!("doc/oscillator.md")]
///
/// // The oscillator declares none.
/// assert!(Observed::new(Oscillator {}, "height").is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observed<S> {
    system: S,
    index: usize,
}

impl<S: System<f64>> Observed<S> {
    /// The observable of that name: `height`, or `angular_momentum[2]` for a component.
    ///
    /// # Errors
    /// [`Error::Unknown`] where the system declares none, [`Error::Timed`] where time is in it.
    pub fn new(system: S, name: &str) -> Result<Self, Error> {
        let found = S::observable_index(name).and_then(|index| {
            let observable = S::OBSERVABLES.get(index)?;
            Some((index, observable))
        });
        match found {
            Some((index, observable)) if !observable.depends_on_time => {
                Ok(Observed { system, index })
            }
            Some((_, observable)) => Err(Error::Timed {
                name: observable.name,
                system: S::NAME,
            }),
            None => Err(Error::Unknown {
                name: name.to_string(),
                system: S::NAME,
            }),
        }
    }
}

impl<S> Unforced for Observed<S> {}
/// A monitor with time in it makes none.
impl<S> Autonomous for Observed<S> {}

/// The vectors of a system over a scalar.
type Of<S, T> = <S as System<T>>::Vector;

impl<T, S> System<T> for Observed<S>
where
    T: Real,
    S: System<T> + System<Dual<T>> + System<Dual<Dual<T>>>,
{
    type Vector = Of<S, T>;
    type Prepared = ReadyObserved<T, S>;
    const NAME: &'static str = <S as System<T>>::NAME;
    const GROUPS: &'static [Group] = <S as System<T>>::GROUPS;
    const OBSERVABLES: &'static [Observable] = &[];

    fn describe_parameters(&self, to: &mut dyn fmt::Write) -> fmt::Result {
        let observable = <S as System<T>>::OBSERVABLES.get(self.index);
        let name = observable.map_or("", |observable| observable.name);
        writeln!(to, "{name} of {}", <S as System<T>>::FORMULA)?;
        <S as System<T>>::describe_parameters(&self.system, to)
    }
    fn prepare(&self) -> ReadyObserved<T, S> {
        ReadyObserved {
            plain: <S as System<T>>::prepare(&self.system),
            first: ready::<_, Dual<T>>(&self.system),
            second: ready::<_, Dual<Dual<T>>>(&self.system),
            index: self.index,
        }
    }
    fn zeros(&self) -> Of<S, T> {
        <S as System<T>>::zeros(&self.system)
    }
}

/// A prepared system with zeros of its shape.
type Ready<S, T> = (<S as System<T>>::Prepared, Of<S, T>);

fn ready<S: System<T>, T: Real>(system: &S) -> Ready<S, T> {
    (system.prepare(), system.zeros())
}

/// [`Observed`], prepared.
pub struct ReadyObserved<T: Real, S: System<T> + System<Dual<T>> + System<Dual<Dual<T>>>> {
    plain: <S as System<T>>::Prepared,
    first: Ready<S, Dual<T>>,
    second: Ready<S, Dual<Dual<T>>>,
    index: usize,
}

impl<T: Real, S: System<T> + System<Dual<T>> + System<Dual<Dual<T>>>> Clone
    for ReadyObserved<T, S>
{
    fn clone(&self) -> Self {
        ReadyObserved {
            plain: self.plain.clone(),
            first: self.first.clone(),
            second: self.second.clone(),
            index: self.index,
        }
    }
}

impl<T, S> fmt::Debug for ReadyObserved<T, S>
where
    T: Real,
    S: System<T> + System<Dual<T>> + System<Dual<Dual<T>>>,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (f.debug_struct("ReadyObserved").field("plain", &self.plain))
            .field("index", &self.index)
            .finish_non_exhaustive()
    }
}

/// The components of `from`, each by a function, in a vector of the shape of `like`.
fn lifted<V: Vector, W: Vector>(
    like: &W,
    from: &V,
    of: impl Fn(usize, V::Scalar) -> W::Scalar,
) -> W {
    let mut lifted = like.clone();
    for i in 0..from.len() {
        *lifted.component_mut(i) = of(i, from.component(i));
    }
    lifted
}

impl<T, S> ReadyObserved<T, S>
where
    T: Real,
    S: System<T> + System<Dual<T>> + System<Dual<Dual<T>>>,
{
    /// The derivatives by all components of q, then of p: each is given to `of`.
    fn derivatives(&self, t: T, q: &Of<S, T>, p: &Of<S, T>, mut of: impl FnMut(bool, usize, T)) {
        let (prepared, zeros) = &self.first;
        let mut q = lifted(zeros, q, |_, x| Dual::fixed(x));
        let mut p = lifted(zeros, p, |_, x| Dual::fixed(x));
        let (t, one) = (Dual::fixed(t), T::one());
        for i in 0..q.len() {
            q.component_mut(i).eps = one;
            of(true, i, prepared.observable(self.index, t, &q, &p).eps);
            q.component_mut(i).eps = T::zero();
            p.component_mut(i).eps = one;
            of(false, i, prepared.observable(self.index, t, &q, &p).eps);
            p.component_mut(i).eps = T::zero();
        }
    }
}

impl<T, S> Dynamics<T> for ReadyObserved<T, S>
where
    T: Real,
    S: System<T> + System<Dual<T>> + System<Dual<Dual<T>>>,
{
    type Vector = Of<S, T>;
    type Field = FieldObserved<T, S>;

    #[inline(always)]
    fn energy(&self, t: T, q: &Self::Vector, p: &Self::Vector) -> T {
        self.plain.observable(self.index, t, q, p)
    }
    fn gradient_q(&self, t: T, q: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector) {
        self.derivatives(t, q, p, |of_q, i, x| {
            if of_q {
                *out.component_mut(i) = x;
            }
        });
    }
    fn gradient_p(&self, t: T, q: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector) {
        self.derivatives(t, q, p, |of_q, i, x| {
            if !of_q {
                *out.component_mut(i) = x;
            }
        });
    }
    fn gradient(
        &self,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        dq: &mut Self::Vector,
        dp: &mut Self::Vector,
    ) {
        self.derivatives(t, q, p, |of_q, i, x| {
            *if of_q { &mut *dq } else { &mut *dp }.component_mut(i) = x;
        });
    }
    fn time_derivative(&self, _: T, _: &Self::Vector, _: &Self::Vector) -> T {
        T::zero()
    }
    fn hessian_vector(
        &self,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        vq: &Self::Vector,
        vp: &Self::Vector,
        out_q: &mut Self::Vector,
        out_p: &mut Self::Vector,
    ) {
        let (prepared, zeros) = &self.second;
        let t = Dual::fixed(Dual::fixed(t));
        let along = |v: &Self::Vector, i, x| Dual::fixed(Dual::new(x, v.component(i)));
        let mut q = lifted(zeros, q, |i, x| along(vq, i, x));
        let mut p = lifted(zeros, p, |i, x| along(vp, i, x));
        for i in 0..q.len() {
            for (of_q, out) in [(true, &mut *out_q), (false, &mut *out_p)] {
                let mark = Dual::fixed(T::one());
                if of_q { &mut q } else { &mut p }.component_mut(i).eps = mark;
                let value = prepared.observable(self.index, t, &q, &p);
                *out.component_mut(i) = value.eps.eps;
                if of_q { &mut q } else { &mut p }.component_mut(i).eps = Dual::fixed(T::zero());
            }
        }
    }
    fn observable(&self, _: usize, t: T, q: &Self::Vector, p: &Self::Vector) -> T {
        self.energy(t, q, p)
    }
    fn field(&self, c: T) -> Self::Field {
        FieldObserved {
            ready: self.clone(),
            c,
        }
    }
}

/// c·J∇ of an observable.
pub struct FieldObserved<T: Real, S: System<T> + System<Dual<T>> + System<Dual<Dual<T>>>> {
    ready: ReadyObserved<T, S>,
    c: T,
}

impl<T: Real, S: System<T> + System<Dual<T>> + System<Dual<Dual<T>>>> Clone
    for FieldObserved<T, S>
{
    fn clone(&self) -> Self {
        FieldObserved {
            ready: self.ready.clone(),
            c: self.c,
        }
    }
}

impl<T, S> fmt::Debug for FieldObserved<T, S>
where
    T: Real,
    S: System<T> + System<Dual<T>> + System<Dual<Dual<T>>>,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (f.debug_struct("FieldObserved").field("ready", &self.ready))
            .field("c", &self.c)
            .finish()
    }
}

impl<T, S> VectorField<Of<S, T>> for FieldObserved<T, S>
where
    T: Real,
    S: System<T> + System<Dual<T>> + System<Dual<Dual<T>>>,
{
    fn add(&self, t: T, q: &Of<S, T>, p: &Of<S, T>, into_q: &mut Of<S, T>, into_p: &mut Of<S, T>) {
        self.ready.derivatives(t, q, p, |of_q, i, x| {
            if of_q {
                *into_p.component_mut(i) -= self.c * x;
            } else {
                *into_q.component_mut(i) += self.c * x;
            }
        });
    }
}

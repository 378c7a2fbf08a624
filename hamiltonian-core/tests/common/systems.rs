//! Systems by hand: code like that of the macro, without its care for speed.

pub use super::chain::Chain;
use hamiltonian_core::private::SVector;
use hamiltonian_core::systems::NamedPiece;
use hamiltonian_core::{
    Dual, Exact, Nystrom, Real, Separable, Split, System, Unforced,
    schemes::author::{
        Description, Dynamics, Flow, Group, Observable, ObservableKind, Piece, Point, VectorField,
    },
};
use hamiltonian_lanes::Pack;
use std::borrow::Cow;

/// H as a formula over any with N coordinates.
pub trait Formula<const N: usize>: Clone + std::fmt::Debug + Send + Sync + 'static {
    const NAME: &'static str;
    const GROUPS: &'static [Group];
    const OBSERVABLES: &'static [Observable] = &[];
    /// True if V jumps in time, and the same for T.
    const JUMPING: [bool; 2] = [false; 2];
    /// V and T.
    const PIECES: &'static [NamedPiece] = &[
        NamedPiece {
            name: Cow::Borrowed("V"),
            formula: Cow::Borrowed("V"),
            jumps: Self::JUMPING[0],
        },
        NamedPiece {
            name: Cow::Borrowed("T"),
            formula: Cow::Borrowed("T"),
            jumps: Self::JUMPING[1],
        },
    ];
    fn description(&self) -> &Description {
        const {
            &Description {
                name: Cow::Borrowed(Self::NAME),
                groups: Cow::Borrowed(Self::GROUPS),
                observables: Cow::Borrowed(Self::OBSERVABLES),
                pieces: Cow::Borrowed(Self::PIECES),
                jumps: Self::JUMPING,
                ..Description::NONE
            }
        }
    }
    fn energy<T: Real>(&self, t: T, q: &[T; N], p: &[T; N]) -> T;
    /// ∂H/∂q, ∂H/∂p; by dual numbers unless written out.
    fn gradient<T: Real>(&self, t: T, q: &[T; N], p: &[T; N]) -> ([T; N], [T; N]) {
        let (mut dq, mut dp) = ([T::zero(); N], [T::zero(); N]);
        let at = Dual::fixed(t);
        let (fq, fp) = (q.map(Dual::fixed), p.map(Dual::fixed));
        for i in 0..N {
            let mut moved = fq;
            moved[i] = Dual::variable(q[i]);
            dq[i] = self.energy(at, &moved, &fp).eps;
            let mut moved = fp;
            moved[i] = Dual::variable(p[i]);
            dp[i] = self.energy(at, &fq, &moved).eps;
        }
        (dq, dp)
    }
    fn observable<T: Real>(&self, _: usize, t: T, q: &[T; N], p: &[T; N]) -> T {
        self.energy(t, q, p)
    }
}

/// H = T(p, t) + V(q, t).
pub trait Halves<const N: usize>: Formula<N> {
    fn force<T: Real>(&self, t: T, q: &[T; N]) -> [T; N];
    fn velocity<T: Real>(&self, t: T, p: &[T; N]) -> [T; N];
}

/// A formula as a system.
#[derive(Debug, Clone)]
pub struct Hand<H, const N: usize>(pub H);

/// A formula, prepared, and with a step coefficient.
#[derive(Debug, Clone)]
pub struct Ready<H, const N: usize>(pub H);
#[derive(Debug, Clone)]
pub struct Scaled<H, T, const N: usize>(H, T);

fn array<T: Real, const N: usize>(v: &SVector<T, N>) -> &[T; N] {
    &v.data.0[0]
}

impl<H: Formula<N>, const N: usize> System for Hand<H, N> {
    type Shape = SVector<(), N>;
    type Prepared<T: Real> = Ready<H, N>;
    fn description(&self) -> &Description {
        self.0.description()
    }
    fn prepare<T: Real>(&self) -> Ready<H, N> {
        Ready(self.0.clone())
    }
    fn zeros<T: Real>(&self) -> SVector<T, N> {
        SVector::from_element(T::zero())
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

impl<T: Real, H: Formula<N>, const N: usize> Dynamics<T> for Ready<H, N> {
    type Vector = SVector<T, N>;
    type Field = Scaled<H, T, N>;
    fn description(&self) -> &Description {
        self.0.description()
    }
    fn energy(&self, t: T, q: &Self::Vector, p: &Self::Vector) -> T {
        self.0.energy(t, array(q), array(p))
    }
    fn gradient_q(&self, t: T, q: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector) {
        out.data.0[0] = self.0.gradient(t, array(q), array(p)).0;
    }
    fn gradient_p(&self, t: T, q: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector) {
        out.data.0[0] = self.0.gradient(t, array(q), array(p)).1;
    }
    fn gradient(
        &self,
        t: T,
        q: &Self::Vector,
        p: &Self::Vector,
        dq: &mut Self::Vector,
        dp: &mut Self::Vector,
    ) {
        (dq.data.0[0], dp.data.0[0]) = self.0.gradient(t, array(q), array(p));
    }
    fn time_derivative(&self, t: T, q: &Self::Vector, p: &Self::Vector) -> T {
        let (q, p) = (array(q).map(Dual::fixed), array(p).map(Dual::fixed));
        self.0.energy(Dual::variable(t), &q, &p).eps
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
        let (mut moved_q, mut moved_p) = ([Dual::fixed(T::zero()); N], [Dual::fixed(T::zero()); N]);
        for i in 0..N {
            moved_q[i] = Dual::new(q[i], vq[i]);
            moved_p[i] = Dual::new(p[i], vp[i]);
        }
        let (dq, dp) = self.0.gradient(Dual::fixed(t), &moved_q, &moved_p);
        for i in 0..N {
            out_q[i] = dq[i].eps;
            out_p[i] = dp[i].eps;
        }
    }
    fn observable(&self, index: usize, t: T, q: &Self::Vector, p: &Self::Vector) -> T {
        self.0.observable(index, t, array(q), array(p))
    }
    fn field(&self, c: T) -> Scaled<H, T, N> {
        Scaled(self.0.clone(), c)
    }
}

impl<T: Real, H: Formula<N>, const N: usize> VectorField<SVector<T, N>> for Scaled<H, T, N> {
    /// One copy for all schemes: tests are built in half the time.
    #[inline(never)]
    fn add(
        &self,
        t: T,
        q: &SVector<T, N>,
        p: &SVector<T, N>,
        into_q: &mut SVector<T, N>,
        into_p: &mut SVector<T, N>,
    ) {
        let (dq, dp) = self.0.gradient(t, array(q), array(p));
        for i in 0..N {
            into_q[i] = self.1.fma(dp[i], into_q[i]);
            into_p[i] = (-self.1).fma(dq[i], into_p[i]);
        }
    }
}

/// The flow of V where `KICK`, else of T.
#[derive(Debug, Clone)]
pub struct Moving<F, const KICK: bool>(pub F);

/// V where `KICK`, else T.
#[derive(Debug, Clone, Copy)]
pub struct Half<const KICK: bool>;

impl<T: Real, H: Halves<N>, const N: usize, const KICK: bool> Piece<T, Ready<H, N>> for Half<KICK> {
    type Point = Point<SVector<T, N>>;
    type Flow = Moving<Scaled<H, T, N>, KICK>;
    fn flow(&self, prepared: &Ready<H, N>, c: T) -> Self::Flow {
        Moving(Scaled(prepared.0.clone(), c))
    }
}

impl<T: Real, H: Halves<N>, const N: usize, const KICK: bool> Flow<Point<SVector<T, N>>>
    for Moving<Scaled<H, T, N>, KICK>
{
    const NAME: &'static str = if KICK { "V" } else { "T" };
    type Work = ();
    #[inline(never)]
    fn apply(&self, t: T, x: &mut Point<SVector<T, N>>, _: &mut ()) {
        let Scaled(system, c) = &self.0;
        if KICK {
            let force = system.force(t, array(&x.q));
            for (p, force) in x.p.iter_mut().zip(force) {
                *p = (-*c).fma(force, *p);
            }
        } else {
            let velocity = system.velocity(t, array(&x.p));
            for (q, velocity) in x.q.iter_mut().zip(velocity) {
                *q = c.fma(velocity, *q);
            }
        }
    }
}

impl<H: Halves<N>, const N: usize> Separable for Hand<H, N> {
    type Kick<T: Real> = Half<true>;
    type Drift<T: Real> = Half<false>;
    fn kick<T: Real>() -> Half<true> {
        Half
    }
    fn drift<T: Real>() -> Half<false> {
        Half
    }
}

/// Whatever T is: where it is not quadratic in p, this is the negative control.
impl<H: Halves<N>, const N: usize> Nystrom for Hand<H, N> {
    type Kick<T: Real> = Half<true>;
    type Quadratic<T: Real> = Half<false>;
    fn kick<T: Real>() -> Half<true> {
        Half
    }
    fn quadratic<T: Real>() -> Half<false> {
        Half
    }
}

impl<H: Halves<N>, const N: usize> Split for Hand<H, N> {
    type Pieces<T: Real> = (Half<true>, Half<false>);
    fn pieces<T: Real>() -> Self::Pieces<T> {
        (Half, Half)
    }
}

impl<H, const N: usize> Unforced for Hand<H, N> {}
impl<H, const N: usize> Exact for Hand<H, N> {}

pub fn number<T: Real>(x: f64) -> T {
    T::constant(x, 0.0)
}

/// Gives a separable formula the gradient its halves make.
macro_rules! gradient_of_halves {
    ($n:literal) => {
        fn gradient<T: Real>(&self, t: T, q: &[T; $n], p: &[T; $n]) -> ([T; $n], [T; $n]) {
            (self.force(t, q), self.velocity(t, p))
        }
    };
}

/// The paper's pendulum, with g, and with the zero of V at the bottom or at the pivot.
#[derive(Debug, Clone)]
pub struct Pendulum {
    pub m: f64,
    pub l: f64,
    pub g: f64,
    /// V = mgl(1 − cos q) instead of −mgl cos q.
    pub from_bottom: bool,
}

/// m = 1, l = 10 (the paper's), g = 9.81.
pub fn pendulum(from_bottom: bool) -> Hand<Pendulum, 1> {
    Hand(Pendulum {
        m: 1.0,
        l: 10.0,
        g: 9.81,
        from_bottom,
    })
}

impl Formula<1> for Pendulum {
    const NAME: &'static str = "Pendulum";
    const GROUPS: &'static [Group] = &[Group::scalar("theta", "p", 0)];
    const OBSERVABLES: &'static [Observable] =
        &[Observable::new(ObservableKind::Monitor, "height")];
    fn energy<T: Real>(&self, _: T, q: &[T; 1], p: &[T; 1]) -> T {
        let mgl = number::<T>(self.m) * number(self.g) * number(self.l);
        let inertia = number::<T>(self.m) * number(self.l) * number(self.l);
        let lift = if self.from_bottom { mgl } else { T::zero() };
        p[0] * p[0] / (number::<T>(2.0) * inertia) + (lift - mgl * q[0].cos())
    }
    gradient_of_halves!(1);
    fn observable<T: Real>(&self, _: usize, _: T, q: &[T; 1], _: &[T; 1]) -> T {
        -number::<T>(self.l) * q[0].cos()
    }
}

impl Halves<1> for Pendulum {
    fn force<T: Real>(&self, _: T, q: &[T; 1]) -> [T; 1] {
        [number::<T>(self.m) * number(self.g) * number(self.l) * q[0].sin()]
    }
    fn velocity<T: Real>(&self, _: T, p: &[T; 1]) -> [T; 1] {
        [p[0] / (number::<T>(self.m) * number(self.l) * number(self.l))]
    }
}

/// (34): H = ½(q² + 1)(p² + 1).
#[derive(Debug, Clone)]
pub struct Paper34;

impl Formula<1> for Paper34 {
    const NAME: &'static str = "Paper34";
    const GROUPS: &'static [Group] = &[Group::scalar("q", "p", 0)];
    fn energy<T: Real>(&self, _: T, q: &[T; 1], p: &[T; 1]) -> T {
        number::<T>(0.5) * (q[0] * q[0] + T::one()) * (p[0] * p[0] + T::one())
    }
    fn gradient<T: Real>(&self, _: T, q: &[T; 1], p: &[T; 1]) -> ([T; 1], [T; 1]) {
        (
            [q[0] * (p[0] * p[0] + T::one())],
            [p[0] * (q[0] * q[0] + T::one())],
        )
    }
}

/// H = (p_x² + p_y²)/2 + (x² + y²)/2 + x²y − y³/3.
#[derive(Debug, Clone)]
pub struct HenonHeiles;

impl Formula<2> for HenonHeiles {
    const NAME: &'static str = "HenonHeiles";
    const GROUPS: &'static [Group] = &[Group::scalar("x", "p_x", 0), Group::scalar("y", "p_y", 1)];
    fn energy<T: Real>(&self, _: T, [x, y]: &[T; 2], [px, py]: &[T; 2]) -> T {
        let (x, y, px, py) = (*x, *y, *px, *py);
        number::<T>(0.5) * (px * px + py * py + x * x + y * y) + x * x * y - y * y * y / number(3.0)
    }
    gradient_of_halves!(2);
}

impl Halves<2> for HenonHeiles {
    fn force<T: Real>(&self, _: T, [x, y]: &[T; 2]) -> [T; 2] {
        let (x, y) = (*x, *y);
        [x + number::<T>(2.0) * x * y, y + x * x - y * y]
    }
    fn velocity<T: Real>(&self, _: T, p: &[T; 2]) -> [T; 2] {
        *p
    }
}

/// H = √(1 + p²) − cos q + q⁴/10: separable, neither half quadratic.
#[derive(Debug, Clone)]
pub struct Relativistic;

impl Formula<1> for Relativistic {
    const NAME: &'static str = "Relativistic";
    const GROUPS: &'static [Group] = &[Group::scalar("q", "p", 0)];
    fn energy<T: Real>(&self, _: T, q: &[T; 1], p: &[T; 1]) -> T {
        let square = q[0] * q[0];
        (T::one() + p[0] * p[0]).sqrt() - q[0].cos() + square * square / number(10.0)
    }
    gradient_of_halves!(1);
}

impl Halves<1> for Relativistic {
    fn force<T: Real>(&self, _: T, q: &[T; 1]) -> [T; 1] {
        [q[0].sin() + number::<T>(0.4) * q[0] * q[0] * q[0]]
    }
    fn velocity<T: Real>(&self, _: T, p: &[T; 1]) -> [T; 1] {
        [p[0] / (T::one() + p[0] * p[0]).sqrt()]
    }
}

/// H = (1 + ½ sin 2t) √(1 + p²) + (1 + ½ cos 3t)(q²/2 + q⁴/4): both halves depend on time.
#[derive(Debug, Clone)]
pub struct Pumped;

impl Pumped {
    fn factors<T: Real>(t: T) -> (T, T) {
        let half = number::<T>(0.5);
        (
            T::one() + half * (number::<T>(2.0) * t).sin(),
            T::one() + half * (number::<T>(3.0) * t).cos(),
        )
    }
}

impl Formula<1> for Pumped {
    const NAME: &'static str = "Pumped";
    const GROUPS: &'static [Group] = &[Group::scalar("q", "p", 0)];
    fn energy<T: Real>(&self, t: T, q: &[T; 1], p: &[T; 1]) -> T {
        let (a, b) = Self::factors(t);
        let square = q[0] * q[0];
        a * (T::one() + p[0] * p[0]).sqrt()
            + b * (number::<T>(0.5) * square + number::<T>(0.25) * square * square)
    }
    gradient_of_halves!(1);
}

impl Halves<1> for Pumped {
    fn force<T: Real>(&self, t: T, q: &[T; 1]) -> [T; 1] {
        [Self::factors(t).1 * (q[0] + q[0] * q[0] * q[0])]
    }
    fn velocity<T: Real>(&self, t: T, p: &[T; 1]) -> [T; 1] {
        [Self::factors(t).0 * p[0] / (T::one() + p[0] * p[0]).sqrt()]
    }
}

/// The planar double pendulum, angles from the vertical; m₁ = m₂ = l₁ = l₂ = 1, g = 9.81.
#[derive(Debug, Clone)]
pub struct DoublePendulum;

impl Formula<2> for DoublePendulum {
    const NAME: &'static str = "DoublePendulum";
    const GROUPS: &'static [Group] = &[Group::scalar("a", "p_a", 0), Group::scalar("b", "p_b", 1)];
    fn energy<T: Real>(&self, _: T, [a, b]: &[T; 2], [pa, pb]: &[T; 2]) -> T {
        let (a, b, pa, pb) = (*a, *b, *pa, *pb);
        let (two, g) = (number::<T>(2.0), number::<T>(9.81));
        let (sin, cos) = (a - b).sin_cos();
        (pa * pa + two * pb * pb - two * pa * pb * cos) / (two * (T::one() + sin * sin))
            - g * (two * a.cos() + b.cos())
    }
}

/// H = p²/2 + q²/2, which counts how often each half moves a point.
pub mod counting {
    use super::*;
    use std::cell::Cell;

    thread_local! {
        static CALLS: Cell<(u64, u64)> = const { Cell::new((0, 0)) };
    }

    /// Forgets the counts of this thread.
    pub fn reset() {
        CALLS.set((0, 0));
    }

    /// Kicks and drifts since then.
    pub fn calls() -> (u64, u64) {
        CALLS.get()
    }

    #[derive(Debug, Clone)]
    pub struct Counted;

    impl Formula<1> for Counted {
        const NAME: &'static str = "Counted";
        const GROUPS: &'static [Group] = &[Group::scalar("q", "p", 0)];
        fn energy<T: Real>(&self, _: T, q: &[T; 1], p: &[T; 1]) -> T {
            number::<T>(0.5) * (q[0] * q[0] + p[0] * p[0])
        }
        gradient_of_halves!(1);
    }

    impl Halves<1> for Counted {
        fn force<T: Real>(&self, _: T, q: &[T; 1]) -> [T; 1] {
            let (kicks, drifts) = CALLS.get();
            CALLS.set((kicks + 1, drifts));
            *q
        }
        fn velocity<T: Real>(&self, _: T, p: &[T; 1]) -> [T; 1] {
            let (kicks, drifts) = CALLS.get();
            CALLS.set((kicks, drifts + 1));
            *p
        }
    }

    /// (34), which counts its gradients, ∂H/∂q and ∂H/∂p together, as kicks.
    #[derive(Debug, Clone)]
    pub struct Counted34;

    impl Formula<1> for Counted34 {
        const NAME: &'static str = Paper34::NAME;
        const GROUPS: &'static [Group] = Paper34::GROUPS;
        fn energy<T: Real>(&self, t: T, q: &[T; 1], p: &[T; 1]) -> T {
            Paper34.energy(t, q, p)
        }
        fn gradient<T: Real>(&self, t: T, q: &[T; 1], p: &[T; 1]) -> ([T; 1], [T; 1]) {
            let (gradients, drifts) = CALLS.get();
            CALLS.set((gradients + 1, drifts));
            Paper34.gradient(t, q, p)
        }
    }
}

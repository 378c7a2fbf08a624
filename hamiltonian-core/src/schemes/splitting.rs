//! The loop that all splittings into two pieces share.
//!
//! Input: two halves x and y of what is carried, each moved by the other, and a [`Table`] of
//! weights. Output: [`Splitting`]. Invariants: the closing piece of a step and the opening piece
//! of the next are one; what is carried after a step stands before that piece, and the
//! synchronised half is a copy.
//!
//! Störmer–Verlet: x and y are p and q, the pieces kick and drift. Pihajoki's scheme: x is the
//! crossed point (q, p̃), y is (q̃, p), and both pieces are flows of one H. The paper's intersecting
//! sub-trajectories: the same with x half a step behind y.

use crate::scheme::Clock;
use crate::state::{Pair, Point};
use crate::system::{Drift, Flow, Kick};
use crate::vector::Vector;
use core::fmt::Debug;
use hamiltonian_lanes::Real;

/// A coefficient in two words, `.0 + .1`, exact to 106 bits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weight(pub f64, pub f64);

impl Weight {
    #[inline(always)]
    fn to<T: Real>(self) -> T {
        T::constant(self.0, self.1)
    }
}

/// The weights of a splitting in units of the step: x is moved by `opening`; then in each stage y
/// by the first, x by the second number. The numbers of each piece sum to one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Table<const STAGES: usize> {
    /// The weight of the piece before the first stage.
    pub opening: Weight,
    /// The weights of the stages.
    pub stages: [(Weight, Weight); STAGES],
}

/// One half, x, moved by the other, y, for a fixed time.
pub trait Piece<X: Vector, Y: Vector>: Clone + Debug {
    /// `x += c·F(y, t)`, with c folded in.
    fn apply(&self, t: X::Scalar, y: &Y, x: &mut X);
}

/// A [`Kick`] as a piece: moves p by q.
#[derive(Debug, Clone)]
pub struct Kicking<K>(pub K);
/// A [`Drift`] as a piece: moves q by p.
#[derive(Debug, Clone)]
pub struct Drifting<D>(pub D);
/// A [`Flow`] as a piece: moves one point by J∇H at another.
#[derive(Debug, Clone)]
pub struct Flowing<F>(pub F);

impl<V: Vector, K: Kick<V>> Piece<V, V> for Kicking<K> {
    #[inline(always)]
    fn apply(&self, t: V::Scalar, q: &V, p: &mut V) {
        self.0.kick(t, q, p);
    }
}

impl<V: Vector, D: Drift<V>> Piece<V, V> for Drifting<D> {
    #[inline(always)]
    fn apply(&self, t: V::Scalar, p: &V, q: &mut V) {
        self.0.drift(t, p, q);
    }
}

impl<V: Vector, F: Flow<V>> Piece<Point<V>, Point<V>> for Flowing<F> {
    #[inline(always)]
    fn apply(&self, t: V::Scalar, y: &Point<V>, x: &mut Point<V>) {
        self.0.flow(t, &y.q, &y.p, &mut x.q, &mut x.p);
    }
}

/// One stage with its weights folded into the pieces.
#[derive(Debug, Clone)]
struct Stage<T, F, G> {
    /// Moves y by x, at `x_offset` after the beginning of the step.
    move_y: G,
    x_offset: T,
    /// Moves x by y, at `y_offset` after the beginning of the step; not used in the last stage,
    /// whose piece is fused with the next step's opening.
    move_x: F,
    y_offset: T,
}

/// Why what is carried is there: a block that moves it out puts it back.
const PRESENT: &str = "a piece panicked in an earlier call";

/// A splitting under way.
///
/// # Time
/// Where H depends on t, each half carries its own time, which advances when it is moved, and a
/// piece is evaluated at the time of the half it is evaluated at. (This is the autonomous
/// splitting of H(x, t_x) + H(y, t_y) with a pair of conjugate energies, so tables keep their
/// order.) Störmer–Verlet thus kicks at t and t + h and drifts at t + h/2.
#[derive(Debug, Clone)]
pub struct Splitting<X, Y, F, G, const STAGES: usize>
where
    X: Vector,
    Y: Vector<Scalar = X::Scalar>,
{
    clock: Clock<X::Scalar>,
    /// Always there but while a block runs.
    carried: Option<Pair<X, Y>>,
    opening: F,
    fused: F,
    closing: Option<F>,
    stages: [Stage<X::Scalar, F, G>; STAGES],
    synchronised: X,
}

impl<X, Y, F, G, const STAGES: usize> Splitting<X, Y, F, G, STAGES>
where
    X: Vector,
    Y: Vector<Scalar = X::Scalar>,
    F: Piece<X, Y>,
    G: Piece<Y, X>,
{
    /// Folds the table into the pieces. `lag` is how far x is behind y at the start, in units of
    /// the interval.
    pub fn new(
        table: &Table<STAGES>,
        clock: Clock<X::Scalar>,
        lag: f64,
        carried: Pair<X, Y>,
        move_x: impl Fn(X::Scalar) -> F,
        move_y: impl Fn(X::Scalar) -> G,
    ) -> Self {
        let h = clock.interval;
        let zero = X::Scalar::zero();
        let opening = table.opening.to::<X::Scalar>();
        let mut closing = zero;
        let mut x_time = opening - X::Scalar::constant(lag, 0.0);
        let mut y_time = zero;
        let stages = table.stages.map(|(for_y, for_x)| {
            let (for_y, for_x) = (for_y.to::<X::Scalar>(), for_x.to::<X::Scalar>());
            let x_offset = x_time * h;
            y_time += for_y;
            x_time += for_x;
            closing = for_x;
            Stage {
                move_y: move_y(for_y * h),
                x_offset,
                move_x: move_x(for_x * h),
                y_offset: y_time * h,
            }
        });
        Splitting {
            clock,
            opening: move_x(opening * h),
            fused: move_x((opening + closing) * h),
            closing: (closing != zero).then(|| move_x(closing * h)),
            stages,
            synchronised: carried.x.clone(),
            carried: Some(carried),
        }
    }

    /// What is carried: x before its closing piece, and y.
    #[inline(always)]
    pub fn carried(&self) -> &Pair<X, Y> {
        self.carried.as_ref().expect(PRESENT)
    }

    /// The same, mutable.
    #[inline(always)]
    pub fn carried_mut(&mut self) -> &mut Pair<X, Y> {
        self.carried.as_mut().expect(PRESENT)
    }

    /// Makes `n` steps after the first `made`.
    #[inline(always)]
    pub fn run(&mut self, made: u64, n: u64) {
        let end = made + n;
        // Moved out, the halves are variables of this block alone and stay in registers.
        let Pair { mut x, mut y } = self.carried.take().expect(PRESENT);
        // Counted down to zero, which costs one instruction less; the number of the step is only
        // computed where a system looks at the time.
        let mut left = n;
        if made == 0 && n > 0 {
            self.opening.apply(self.clock.at(0), &y, &mut x);
            self.stages(0, &mut x, &mut y);
            left -= 1;
        }
        while left != 0 {
            let k = end - left;
            self.fused.apply(self.clock.at(k), &y, &mut x);
            self.stages(k, &mut x, &mut y);
            left -= 1;
        }
        self.carried = Some(Pair { x, y });
    }

    /// All stages of the step after `k` but for the closing piece.
    #[inline(always)]
    fn stages(&self, k: u64, x: &mut X, y: &mut Y) {
        let t = self.clock.at(k);
        for i in 0..STAGES {
            let stage = &self.stages[i];
            stage.move_y.apply(t + stage.x_offset, x, y);
            if i + 1 < STAGES {
                stage.move_x.apply(t + stage.y_offset, y, x);
            }
        }
    }

    /// Both halves at the same time: a copy of x with its closing piece applied, and y.
    #[inline(always)]
    pub fn synchronise(&mut self, made: u64) -> (&X, &Y) {
        let Pair { x, y } = self.carried.as_ref().expect(PRESENT);
        self.synchronised.copy_from(x);
        if let Some(closing) = &self.closing
            && made > 0
        {
            closing.apply(self.clock.at(made), y, &mut self.synchronised);
        }
        self.synchronised()
    }

    /// Both halves as of the last [`Splitting::synchronise`].
    #[inline(always)]
    pub fn synchronised(&self) -> (&X, &Y) {
        (&self.synchronised, &self.carried().y)
    }
}

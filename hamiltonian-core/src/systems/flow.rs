//! Motions of a point: the vector field, exact flows of pieces of H, and splittings into pieces.
//!
//! Input: a prepared system and a step coefficient. Output: [`VectorField`], which accumulates
//! c·J∇H, and [`Flow`], the exact map of a piece of H over a fixed duration, which a [`Piece`] makes;
//! [`Pieces`] puts k of them together. Invariant: nothing here allocates but [`Scratch::like`].

use crate::systems::vector::Vector;
use core::fmt::Debug;
use hamiltonian_lanes::Real;

/// `c·J∇H`, and `c` times the force if the system has one, accumulating.
pub trait VectorField<V: Vector>: Clone + Debug {
    /// `into_q += c·∂H/∂p(q, p, t)`, `into_p += c·(f(q, p, t) − ∂H/∂q(q, p, t))`.
    fn add(&self, t: V::Scalar, q: &V, p: &V, into_q: &mut V, into_p: &mut V);
    /// True if ∂H/∂p depends on p and t alone and f − ∂H/∂q on q and t alone, and
    /// [`add_half`](VectorField::add_half) computes one without the other. Implicit schemes then compute the forces from
    /// the new velocities.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn has_halves(&self) -> bool {
        false
    }
    /// The part of [`add`](VectorField::add) that is added to the coordinates (`KICKS` is false) or to the momenta, from
    /// the other half of phase space, if the field has halves; otherwise nothing.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn add_half<const KICKS: bool>(&self, t: V::Scalar, from: &V, into: &mut V) {
        let _ = (t, from, into);
    }
}

/// Scratch memory of a flow or a map of `X`; its contents never matter: `()`, an `X`, or a struct
/// of such.
pub trait Scratch<X> {
    /// Makes scratch of the shape of `x`. This may allocate.
    fn like(x: &X) -> Self;
}

impl<X> Scratch<X> for () {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn like(_: &X) {}
}

impl<X: Vector> Scratch<X> for X {
    fn like(x: &X) -> Self {
        x.clone()
    }
}

impl<X, A: Scratch<X>, B: Scratch<X>> Scratch<X> for (A, B) {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn like(x: &X) -> Self {
        (A::like(x), B::like(x))
    }
}

/// The exact map of a piece of H over a fixed duration, with t frozen.
///
/// `X` is the space on which it acts: a [`Point`](crate::schemes::author::Point) of phase space, or
/// the value that a scheme carries. Outside its domain, a flow writes NaN into every component that
/// it moves, and the check of the block detects them.
pub trait Flow<X: Vector>: Clone + Debug {
    /// The piece in the author's notation.
    const NAME: &'static str;
    /// True if the map for c₁ followed by the map for c₂ is the map for c₁ + c₂. It is false if the
    /// piece is a loop over terms that do not commute: the map is then the exact flows of the terms
    /// one after the other.
    const MERGES: bool = true;
    /// True if the map moves coordinates, and the same for momenta.
    const MOVES: [bool; 2] = [true; 2];
    /// The scratch of the flow.
    type Work: Scratch<X>;

    /// Moves the point, by the terms of a loop in order.
    fn apply(&self, t: X::Scalar, x: &mut X, work: &mut Self::Work);
    /// Moves the point, by the terms of a loop in reverse order.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply_reversed(&self, t: X::Scalar, x: &mut X, work: &mut Self::Work) {
        self.apply(t, x, work);
    }
    /// Moves the point as [`apply`](Flow::apply) does, and returns the piece that made it not finite, if one did.
    #[cold]
    fn blame(&self, t: X::Scalar, x: &mut X, work: &mut Self::Work) -> Option<&'static str> {
        self.apply(t, x, work);
        (!x.is_finite()).then_some(Self::NAME)
    }
    /// Moves the point as [`apply_reversed`](Flow::apply_reversed) does, and returns the piece that made it not finite,
    /// if one did.
    #[cold]
    fn blame_reversed(
        &self,
        t: X::Scalar,
        x: &mut X,
        work: &mut Self::Work,
    ) -> Option<&'static str> {
        self.apply_reversed(t, x, work);
        (!x.is_finite()).then_some(Self::NAME)
    }
}

/// A piece of H as a value: a unit struct, or a struct with a setting.
pub trait Piece<T: Real, P>: Copy + Debug + Send + Sync + 'static {
    /// The space its flow acts on.
    type Point: Vector<Scalar = T>;
    /// Its flow.
    type Flow: Flow<Self::Point>;
    /// The flow for the duration `c`, with `c` folded into the prepared constants.
    fn flow(&self, prepared: &P, c: T) -> Self::Flow;
    /// True if flows of this piece merge, [`Flow::MERGES`]. A piece of run time, whose type does not decide it, has its own
    /// answer and flows whose `MERGES` is false.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn merges(&self, _prepared: &P) -> bool {
        <Self::Flow as Flow<Self::Point>>::MERGES
    }
}

/// Pieces of H in an order: a tuple of [`Piece`]s, the outermost first.
///
/// A stage of a splitting goes down through the pieces 1…k, each for a duration `down`, and up
/// again, each for a duration `up`. Equal neighbours are one flow: the innermost for `down + up`,
/// the outermost for `up` of a stage and `down` of the next.
pub trait Pieces<T: Real, P>: Copy + Debug + Send + Sync + 'static {
    /// The space the flows act on.
    type Point: Vector<Scalar = T>;
    /// The flow of the first piece.
    type Outer: Flow<Self::Point>;
    /// The flows of all others, down and up.
    type Inner: Flow<Self::Point>;
    /// The flow of the first piece.
    fn outer(&self, prepared: &P, c: T) -> Self::Outer;
    /// The flows of the pieces 2…k for `down` and k…2 for `up`.
    fn inner(&self, prepared: &P, down: T, up: T) -> Self::Inner;
    /// True if flows of the first piece merge, [`Piece::merges`].
    #[cfg_attr(not(unoptimised), inline(always))]
    fn merges(&self, _prepared: &P) -> bool {
        <Self::Outer as Flow<Self::Point>>::MERGES
    }
}

/// The flow of no piece, inside a splitting into one.
#[derive(Debug, Clone, Copy)]
pub struct Nothing;

impl<X: Vector> Flow<X> for Nothing {
    const NAME: &'static str = "";
    type Work = ();
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, _: X::Scalar, _: &mut X, _: &mut ()) {}
}

/// The innermost piece, down and up: one flow where it merges, two where it is a loop.
#[derive(Debug, Clone)]
pub struct Turn<F> {
    down: F,
    up: Option<F>,
}

impl<F> Turn<F> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn new<T, P, A>(piece: &A, prepared: &P, down: T, up: T) -> Self
    where
        T: Real,
        A: Piece<T, P, Flow = F>,
        F: Flow<A::Point>,
    {
        if piece.merges(prepared) {
            Turn {
                down: piece.flow(prepared, down + up),
                up: None,
            }
        } else {
            Turn {
                down: piece.flow(prepared, down),
                up: Some(piece.flow(prepared, up)),
            }
        }
    }
}

impl<X: Vector, F: Flow<X>> Flow<X> for Turn<F> {
    const NAME: &'static str = F::NAME;
    type Work = F::Work;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, t: X::Scalar, x: &mut X, work: &mut F::Work) {
        self.down.apply(t, x, work);
        if !F::MERGES
            && let Some(up) = &self.up
        {
            up.apply_reversed(t, x, work);
        }
    }
}

/// A piece around the inner pieces: down, the inner pieces, up.
#[derive(Debug, Clone)]
pub struct Sandwich<F, I> {
    down: F,
    inside: I,
    up: F,
}

impl<X: Vector, F: Flow<X>, I: Flow<X>> Flow<X> for Sandwich<F, I> {
    const NAME: &'static str = F::NAME;
    type Work = (F::Work, I::Work);
    #[cfg_attr(not(unoptimised), inline(always))]
    fn apply(&self, t: X::Scalar, x: &mut X, (work, inside): &mut Self::Work) {
        self.down.apply(t, x, work);
        self.inside.apply(t, x, inside);
        self.up.apply_reversed(t, x, work);
    }
    #[cold]
    fn blame(
        &self,
        t: X::Scalar,
        x: &mut X,
        (work, inside): &mut Self::Work,
    ) -> Option<&'static str> {
        (self.down.blame(t, x, work))
            .or_else(|| self.inside.blame(t, x, inside))
            .or_else(|| self.up.blame_reversed(t, x, work))
    }
}

impl<T: Real, P, A: Piece<T, P>> Pieces<T, P> for (A,) {
    type Point = A::Point;
    type Outer = A::Flow;
    type Inner = Nothing;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn outer(&self, prepared: &P, c: T) -> A::Flow {
        self.0.flow(prepared, c)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn merges(&self, prepared: &P) -> bool {
        self.0.merges(prepared)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn inner(&self, _: &P, _: T, _: T) -> Nothing {
        Nothing
    }
}

/// The tuple of pieces `$first, $second, …`; `(second, …)` is made of `$rest`.
macro_rules! pieces {
    ($first:ident $second:ident) => {
        impl<T, P, $first, $second> Pieces<T, P> for ($first, $second)
        where
            T: Real,
            $first: Piece<T, P>,
            $second: Piece<T, P, Point = $first::Point>,
        {
            type Point = $first::Point;
            type Outer = $first::Flow;
            type Inner = Turn<$second::Flow>;
            #[cfg_attr(not(unoptimised), inline(always))]
            fn outer(&self, prepared: &P, c: T) -> Self::Outer {
                self.0.flow(prepared, c)
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn merges(&self, prepared: &P) -> bool {
                self.0.merges(prepared)
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn inner(&self, prepared: &P, down: T, up: T) -> Self::Inner {
                Turn::new(&self.1, prepared, down, up)
            }
        }
    };
    ($first:ident $second:ident $($rest:ident $index:tt)+) => {
        impl<T, P, $first, $second, $($rest),+> Pieces<T, P> for ($first, $second, $($rest),+)
        where
            T: Real,
            $first: Piece<T, P>,
            $second: Piece<T, P, Point = $first::Point>,
            $($rest: Piece<T, P, Point = $first::Point>,)+
        {
            type Point = $first::Point;
            type Outer = $first::Flow;
            type Inner =
                Sandwich<$second::Flow, <($second, $($rest),+) as Pieces<T, P>>::Inner>;
            #[cfg_attr(not(unoptimised), inline(always))]
            fn outer(&self, prepared: &P, c: T) -> Self::Outer {
                self.0.flow(prepared, c)
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn merges(&self, prepared: &P) -> bool {
                self.0.merges(prepared)
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn inner(&self, prepared: &P, down: T, up: T) -> Self::Inner {
                Sandwich {
                    down: self.1.flow(prepared, down),
                    inside: (self.1, $(self.$index),+).inner(prepared, down, up),
                    up: self.1.flow(prepared, up),
                }
            }
        }
    };
}

pieces!(A B);
pieces!(A B C 2);
pieces!(A B C 2 D 3);
pieces!(A B C 2 D 3 E 4);
pieces!(A B C 2 D 3 E 4 F 5);
pieces!(A B C 2 D 3 E 4 F 5 G 6);
pieces!(A B C 2 D 3 E 4 F 5 G 6 H 7);

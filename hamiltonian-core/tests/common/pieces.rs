//! Systems split by hand: three, four pieces, and loops over terms that do not commute.

use super::systems::{Formula, Hand, Ready};
use hamiltonian_core::private::SVector;
use hamiltonian_core::{
    Real, Split,
    schemes::author::{Flow, Group, Piece, Point},
};

fn number<T: Real>(x: f64) -> T {
    T::constant(x, 0.0)
}

type Plane<T> = Point<SVector<T, 2>>;

/// Hénon–Heiles in polar coordinates, H = p_r²/2 + p_θ²/(2r²) + r²/2 + r³ sin(3θ)/3, in this many
/// pieces: no two of them commute but the last two of four.
#[derive(Debug, Clone)]
pub struct Polar<const PIECES: usize>;

impl<const PIECES: usize> Formula<2> for Polar<PIECES> {
    const NAME: &'static str = "Polar";
    const GROUPS: &'static [Group] = &[
        Group::scalar("r", "p_r", 0),
        Group::scalar("theta", "p_theta", 1),
    ];
    fn energy<T: Real>(&self, _: T, [r, theta]: &[T; 2], [pr, pt]: &[T; 2]) -> T {
        let (r, theta, pr, pt) = (*r, *theta, *pr, *pt);
        number::<T>(0.5) * (pr * pr + pt * pt / (r * r) + r * r)
            + r * r * r * (number::<T>(3.0) * theta).sin() / number(3.0)
    }
}

/// A piece of [`Polar`].
#[derive(Debug, Clone, Copy)]
pub struct PolarPiece<const WHICH: u8>;

/// p_r²/2.
const RADIAL: u8 = 0;
/// p_θ²/(2r²).
const ANGULAR: u8 = 1;
/// r²/2 + r³ sin(3θ)/3.
const POTENTIAL: u8 = 2;
/// r²/2.
const SQUARE: u8 = 3;
/// r³ sin(3θ)/3.
const CUBE: u8 = 4;

/// Its flow.
#[derive(Debug, Clone)]
pub struct PolarFlow<T, const WHICH: u8>(T);

impl<T: Real, const N: usize, const WHICH: u8> Piece<T, Ready<Polar<N>, 2>> for PolarPiece<WHICH> {
    type Point = Plane<T>;
    type Flow = PolarFlow<T, WHICH>;
    fn flow(&self, _: &Ready<Polar<N>, 2>, c: T) -> Self::Flow {
        PolarFlow(c)
    }
}

impl<T: Real, const WHICH: u8> Flow<Plane<T>> for PolarFlow<T, WHICH> {
    const NAME: &'static str = match WHICH {
        RADIAL => "p_r^2/2",
        ANGULAR => "p_theta^2/(2r^2)",
        POTENTIAL => "V",
        SQUARE => "r^2/2",
        _ => "r^3 sin(3theta)/3",
    };
    type Work = ();
    fn apply(&self, _: T, x: &mut Plane<T>, _: &mut ()) {
        let c = self.0;
        let (r, pt) = (x.q[0], x.p[1]);
        if WHICH == RADIAL {
            x.q[0] += c * x.p[0];
        }
        if WHICH == ANGULAR {
            x.q[1] += c * pt / (r * r);
            x.p[0] += c * pt * pt / (r * r * r);
        }
        if WHICH == SQUARE || WHICH == POTENTIAL {
            x.p[0] -= c * r;
        }
        if WHICH == CUBE || WHICH == POTENTIAL {
            let (sin, cos) = (number::<T>(3.0) * x.q[1]).sin_cos();
            x.p[0] -= c * r * r * sin;
            x.p[1] -= c * r * r * r * cos;
        }
    }
}

impl Split for Hand<Polar<3>, 2> {
    type Pieces<T: Real> = (
        PolarPiece<RADIAL>,
        PolarPiece<ANGULAR>,
        PolarPiece<POTENTIAL>,
    );
    fn pieces<T: Real>() -> Self::Pieces<T> {
        (PolarPiece, PolarPiece, PolarPiece)
    }
}

impl Split for Hand<Polar<4>, 2> {
    type Pieces<T: Real> = (
        PolarPiece<SQUARE>,
        PolarPiece<ANGULAR>,
        PolarPiece<RADIAL>,
        PolarPiece<CUBE>,
    );
    fn pieces<T: Real>() -> Self::Pieces<T> {
        (PolarPiece, PolarPiece, PolarPiece, PolarPiece)
    }
}

/// H = q₁p₂ − 0.6 q₂p₁ + Σ (q⁴/4 + p²/2): the first two terms are one piece, a loop; `PLACE` is where
/// it stands among the pieces, 0 outermost to 2 innermost. Where not `TURNS`, the loop claims to be an
/// exact flow and is never turned round: the control.
#[derive(Debug, Clone)]
pub struct Loops<const PLACE: usize, const TURNS: bool>;

impl<const PLACE: usize, const TURNS: bool> Formula<2> for Loops<PLACE, TURNS> {
    const NAME: &'static str = "Loops";
    const GROUPS: &'static [Group] = &[Group::scalar("x", "p_x", 0), Group::scalar("y", "p_y", 1)];
    fn energy<T: Real>(&self, _: T, [x, y]: &[T; 2], [px, py]: &[T; 2]) -> T {
        let (x, y, px, py) = (*x, *y, *px, *py);
        let fourth = |q: T| number::<T>(0.25) * q * q * q * q;
        x * py - number::<T>(0.6) * y * px
            + fourth(x)
            + fourth(y)
            + number::<T>(0.5) * (px * px + py * py)
    }
}

/// The loop where `WHICH` is 0, the kick where 1, the drift where 2.
#[derive(Debug, Clone, Copy)]
pub struct LoopPiece<const WHICH: u8, const TURNS: bool>;

/// Its flow.
#[derive(Debug, Clone)]
pub struct LoopFlow<T, const WHICH: u8, const TURNS: bool>(T);

impl<T: Real, const PLACE: usize, const WHICH: u8, const TURNS: bool>
    Piece<T, Ready<Loops<PLACE, TURNS>, 2>> for LoopPiece<WHICH, TURNS>
{
    type Point = Plane<T>;
    type Flow = LoopFlow<T, WHICH, TURNS>;
    fn flow(&self, _: &Ready<Loops<PLACE, TURNS>, 2>, c: T) -> Self::Flow {
        LoopFlow(c)
    }
}

impl<T: Real, const WHICH: u8, const TURNS: bool> LoopFlow<T, WHICH, TURNS> {
    /// The flow of q₁p₂.
    fn first(&self, x: &mut Plane<T>) {
        let (q, p) = (x.q[0], x.p[1]);
        x.q[1] += self.0 * q;
        x.p[0] -= self.0 * p;
    }
    /// The flow of −0.6 q₂p₁.
    fn second(&self, x: &mut Plane<T>) {
        let c = self.0 * number(-0.6);
        let (q, p) = (x.q[1], x.p[0]);
        x.q[0] += c * q;
        x.p[1] -= c * p;
    }
}

impl<T: Real, const WHICH: u8, const TURNS: bool> Flow<Plane<T>> for LoopFlow<T, WHICH, TURNS> {
    const NAME: &'static str = match WHICH {
        0 => "loop",
        1 => "kick",
        _ => "drift",
    };
    type Work = ();
    const MERGES: bool = WHICH != 0 || !TURNS;
    fn apply(&self, _: T, x: &mut Plane<T>, _: &mut ()) {
        let c = self.0;
        match WHICH {
            0 => {
                self.first(x);
                self.second(x);
            }
            1 => {
                for i in 0..2 {
                    x.p[i] -= c * x.q[i] * x.q[i] * x.q[i];
                }
            }
            _ => {
                for i in 0..2 {
                    x.q[i] += c * x.p[i];
                }
            }
        }
    }
    fn apply_reversed(&self, t: T, x: &mut Plane<T>, _: &mut ()) {
        if WHICH == 0 && TURNS {
            self.second(x);
            self.first(x);
        } else {
            self.apply(t, x, &mut ());
        }
    }
}

macro_rules! loops {
    ($place:literal, $a:literal $b:literal $c:literal) => {
        impl<const TURNS: bool> Split for Hand<Loops<$place, TURNS>, 2> {
            type Pieces<T: Real> = (
                LoopPiece<$a, TURNS>,
                LoopPiece<$b, TURNS>,
                LoopPiece<$c, TURNS>,
            );
            fn pieces<T: Real>() -> Self::Pieces<T> {
                (LoopPiece, LoopPiece, LoopPiece)
            }
        }
    };
}

loops!(0, 0 1 2);
loops!(1, 1 0 2);
loops!(2, 1 2 0);

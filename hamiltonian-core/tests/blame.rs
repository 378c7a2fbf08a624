//! The piece that the error of a failed run names is the one that left its domain in the run.
//!
//! Input: random pieces, some of them sweeps, whose terms have walls, and schemes of splittings. The flows themselves
//! note which of them left its domain first, so nothing is replayed. Control: flows that are replayed in the wrong order.

use crate::common::random::Random;
use crate::common::systems::{Formula, Hand, Ready};
use core::cell::Cell;
use hamiltonian_core::errors::StepError;
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::Composition;
use hamiltonian_core::schemes::author::{Flow, Group, OneStep, Piece, Point, Weight};
use hamiltonian_core::schemes::{Aba864, Adjoint, CheapProcessed4, Processed4, Ruth3};
use hamiltonian_core::{Error, Exact, Real, Scheme, Split, Vector};

type Plane<T> = Point<SVector<T, 2>>;

/// Adds `rate`·c times one component to another: component 0 is x, 1 is y, 2 is p_x, 3 is p_y. Beyond the wall the
/// result is NaN.
#[derive(Debug, Clone, Copy)]
struct Term {
    from: usize,
    to: usize,
    rate: f64,
    wall: f64,
}

/// `PIECES` pieces of three terms each; the bits of `SWEEPS` tell which are loops. Where not `HONEST`, a sweep is
/// replayed in the order of its terms: the control.
#[derive(Debug, Clone)]
struct Walls<const PIECES: usize, const SWEEPS: u16, const HONEST: bool>([[Term; 3]; PIECES]);

impl<const N: usize, const SWEEPS: u16, const HONEST: bool> Walls<N, SWEEPS, HONEST> {
    fn random(random: &mut Random) -> Self {
        Walls(core::array::from_fn(|_| {
            core::array::from_fn(|_| {
                let (from, other) = (random.next() as usize % 4, random.next() as usize % 3);
                Term {
                    from,
                    to: (from + 1 + other) % 4,
                    rate: random.between(-2.0, 2.0),
                    wall: random.between(0.8, 2.0),
                }
            })
        }))
    }
}

impl<const N: usize, const SWEEPS: u16, const HONEST: bool> Formula<2>
    for Walls<N, SWEEPS, HONEST>
{
    const NAME: &'static str = "Walls";
    const GROUPS: &'static [Group] = &[Group::scalar("x", "p_x", 0), Group::scalar("y", "p_y", 1)];
    fn energy<T: Real>(&self, _: T, _: &[T; 2], p: &[T; 2]) -> T {
        p[0] * p[0] + p[1] * p[1]
    }
}

#[derive(Debug, Clone, Copy)]
struct WallPiece<const WHICH: usize, const SWEEPS: u16, const HONEST: bool>;

#[derive(Debug, Clone)]
struct WallFlow<T, const WHICH: usize, const SWEEPS: u16, const HONEST: bool>(T, [Term; 3]);

impl<T: Real, const N: usize, const WHICH: usize, const SWEEPS: u16, const HONEST: bool>
    Piece<T, Ready<Walls<N, SWEEPS, HONEST>, 2>> for WallPiece<WHICH, SWEEPS, HONEST>
{
    type Point = Plane<T>;
    type Flow = WallFlow<T, WHICH, SWEEPS, HONEST>;
    fn flow(&self, ready: &Ready<Walls<N, SWEEPS, HONEST>, 2>, c: T) -> Self::Flow {
        WallFlow(c, ready.0.0[WHICH])
    }
}

thread_local! {
    /// The piece that left its domain first, since this was emptied.
    static FIRST: Cell<Option<&'static str>> = const { Cell::new(None) };
}

impl<T: Real, const WHICH: usize, const SWEEPS: u16, const HONEST: bool>
    WallFlow<T, WHICH, SWEEPS, HONEST>
{
    const NAMED: &'static str = ["0", "1", "2", "3", "4", "5", "6", "7"][WHICH];

    fn go(&self, x: &mut Plane<T>, terms: impl Iterator<Item = Term>) {
        for term in terms {
            let at = |x: &Plane<T>, i: usize| if i < 2 { x.q[i] } else { x.p[i - 2] };
            let rate = self.0 * T::constant(term.rate, 0.0);
            let before = at(x, term.to);
            let mut moved = rate.fma(at(x, term.from), before);
            // The walls are those of NaN, too.
            if moved.magnitude() > term.wall {
                if FIRST.get().is_none() {
                    FIRST.set(Some(Self::NAMED));
                }
                moved = T::constant(f64::NAN, 0.0);
            }
            *(if term.to < 2 {
                &mut x.q[term.to]
            } else {
                &mut x.p[term.to - 2]
            }) = moved;
        }
    }
}

impl<T: Real, const WHICH: usize, const SWEEPS: u16, const HONEST: bool> Flow<Plane<T>>
    for WallFlow<T, WHICH, SWEEPS, HONEST>
{
    const NAME: &'static str = Self::NAMED;
    const MERGES: bool = SWEEPS >> WHICH & 1 == 0;
    type Work = ();
    fn apply(&self, _: T, x: &mut Plane<T>, (): &mut ()) {
        self.go(x, self.1.into_iter());
    }
    fn apply_reversed(&self, t: T, x: &mut Plane<T>, (): &mut ()) {
        if <Self as Flow<Plane<T>>>::MERGES {
            self.apply(t, x, &mut ());
        } else {
            self.go(x, self.1.into_iter().rev());
        }
    }
    fn blame_reversed(&self, t: T, x: &mut Plane<T>, (): &mut ()) -> Option<&'static str> {
        if HONEST {
            self.apply_reversed(t, x, &mut ());
        } else {
            self.apply(t, x, &mut ());
        }
        (!x.is_finite()).then_some(Self::NAMED)
    }
}

macro_rules! walls {
    ($n:literal: $($which:literal)+) => {
        impl<const SWEEPS: u16, const HONEST: bool> Split
            for Hand<Walls<$n, SWEEPS, HONEST>, 2>
        {
            type Pieces<T: Real> = ($(WallPiece<$which, SWEEPS, HONEST>,)+);
            fn pieces<T: Real>() -> Self::Pieces<T> {
        ($(WallPiece::<$which, SWEEPS, HONEST>,)+)
    }
        }
    };
}

walls!(2: 0 1);
walls!(3: 0 1 2);
walls!(5: 0 1 2 3 4);

/// Counts of runs: those that failed, and those whose error names another piece.
#[derive(Default)]
struct Count {
    failed: u32,
    wrong: u32,
}

impl Count {
    /// Runs a scheme step by step, so that the state after each step is checked, until it fails.
    fn run<const N: usize, const SWEEPS: u16, const HONEST: bool>(
        &mut self,
        seed: u64,
        scheme: impl Scheme<Hand<Walls<N, SWEEPS, HONEST>, 2>>,
    ) {
        let mut random = Random(seed);
        let system = Hand(Walls::random(&mut random));
        let mut number = || random.between(-0.5, 0.5);
        let start = State::new([number(), number()], [number(), number()]);
        FIRST.set(None);
        let mut run = Integrator::new(&system, scheme, start, 0.2).expect("a good start");
        for _ in 0..100 {
            let Err(error) = run.advance(1) else {
                assert_eq!(FIRST.get(), None);
                continue;
            };
            let piece = match error {
                Error::Step(StepError::NotFinite { piece, .. }) => piece,
                // Equations of an adjoint that have no solution, inside all domains.
                Error::Step(StepError::Unsolved { .. }) if FIRST.get().is_none() => return,
                Error::Step(StepError::Unsolved { .. }) => None,
                error => panic!("{error}"),
            };
            self.failed += 1;
            self.wrong += u32::from(piece.as_deref() != FIRST.get());
            return;
        }
    }

    /// Runs many schemes.
    fn each<const N: usize, const SWEEPS: u16, const HONEST: bool>(
        seeds: core::ops::Range<u64>,
    ) -> Self
    where
        Hand<Walls<N, SWEEPS, HONEST>, 2>: Split + Exact,
    {
        let mut count = Count::default();
        for seed in seeds {
            count.run::<N, SWEEPS, HONEST>(seed, Strang);
            count.run::<N, SWEEPS, HONEST>(seed, Composition::yoshida(Strang));
            count.run::<N, SWEEPS, HONEST>(seed, Ruth3);
            count.run::<N, SWEEPS, HONEST>(seed, Ruth3.adjoint());
            count.run::<N, SWEEPS, HONEST>(seed, Adjoint(Ruth3));
            count.run::<N, SWEEPS, HONEST>(seed, Aba864);
            count.run::<N, SWEEPS, HONEST>(seed, Processed4::default());
            count.run::<N, SWEEPS, HONEST>(seed, CheapProcessed4::default());
            count.run::<N, SWEEPS, HONEST>(seed, Composition::yoshida(Aba864));
            // Its stages do not join.
            let half = || (Processed4::default(), Weight(0.5, 0.0));
            let halves = Composition::of([half(), half()], 4, "halves");
            count.run::<N, SWEEPS, HONEST>(seed, halves);
        }
        count
    }
}

#[test]
fn errors_name_the_piece_that_left_its_domain() {
    for count in [
        Count::each::<2, 0b01, true>(0..60),
        Count::each::<3, 0b010, true>(100..160),
        Count::each::<5, 0b01110, true>(200..260),
        Count::each::<5, 0b10101, true>(300..360),
    ] {
        assert!(count.failed > 300, "{}", count.failed);
        assert_eq!(count.wrong, 0, "of {}", count.failed);
    }
    let control = Count::each::<3, 0b010, false>(100..160);
    assert!(control.wrong > 3, "{}", control.wrong);
}

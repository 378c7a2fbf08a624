//! The functions under test, their bounds, and the arguments at which they are tested.

use std::marker::PhantomData;

use hamiltonian_lanes::{Cpu, DoubleDouble, Kernel, Level, Nf, Pack, Real, W, dispatch_at_most};

/// A stream of random bits: splitmix64 (Steele, Lea, Flood, 2014, doi:10.1145/2714064.2660195).
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Sources of arguments.
#[derive(Clone, Copy)]
pub enum Range {
    /// Uniform.
    Linear(f64, f64),
    /// Positive, uniform in the bits, so that every binade has its share; either sign.
    Binades(f64, f64),
    /// Positive, uniform in the bits.
    Positive(f64, f64),
    /// Doubles next to integer multiples of π/2, of any size.
    NearTurns,
    /// Within a few thousand units in the last place of a number.
    Near(f64),
    /// Any bits, every fourth time those of a special number.
    Any,
}
use Range::*;

impl Range {
    pub fn draw(self, random: &mut Random) -> f64 {
        match self {
            Linear(low, high) => low + (high - low) * random.unit(),
            Positive(low, high) => between(low, high, random),
            Binades(low, high) => {
                let size = between(low, high, random);
                if random.bits() & 1 == 0 { size } else { -size }
            }
            NearTurns => {
                let size = between(1.0, 1e308, random);
                let half_pi =
                    DoubleDouble::new(std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17);
                let n = DoubleDouble::from((size / half_pi.hi()).floor().min(9e15));
                (n * half_pi).hi()
            }
            Near(centre) => {
                let offset = (random.bits() % 8192) as i64 - 4096;
                f64::from_bits(centre.to_bits().wrapping_add_signed(offset))
            }
            Any => match random.bits() % 4 {
                0 => SPECIAL[random.bits() as usize % SPECIAL.len()],
                _ => f64::from_bits(random.bits()),
            },
        }
    }
}

/// Arguments at which functions have rules of their own.
const SPECIAL: [f64; 10] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    f64::MIN_POSITIVE,
    TINY,
    LARGEST,
];

fn between(low: f64, high: f64, random: &mut Random) -> f64 {
    let (low, high) = (low.to_bits(), high.to_bits());
    f64::from_bits(low + random.bits() % (high - low))
}

/// The arguments of one call: of functions of one number the second is not used.
type Ranges = &'static [(Range, Range)];

/// One function: where it is tested and how far it may be off.
pub struct Row {
    pub name: &'static str,
    /// The largest error allowed, in units in the last place.
    pub bound: f64,
    pub ranges: Ranges,
    pub f64: fn(f64, f64) -> f64,
    pub f32: fn(f32, f32) -> f32,
    pub exact: fn(DoubleDouble, DoubleDouble) -> DoubleDouble,
    /// The values at all arguments in the registers of a level; if asked for unfused, then two
    /// registers at a time.
    pub lanes: fn(Cpu, bool, &[f64], &[f64], &mut [f64]),
}

impl Row {
    /// Arguments number `k` of a sequence that takes the ranges in turn.
    pub fn draw(&self, k: usize, random: &mut Random) -> (f64, f64) {
        let (first, second) = self.ranges[k % self.ranges.len()];
        (first.draw(random), second.draw(random))
    }
}

/// A function written over every scalar.
trait Function {
    fn call<T: Real>(x: T, y: T) -> T;
}

/// A function's values on a level. Each function is a kernel of its own: all of them in one would
/// take the compiler minutes.
struct Values<'a, F> {
    function: PhantomData<F>,
    unfused: bool,
    x: &'a [f64],
    y: &'a [f64],
    out: &'a mut [f64],
}

impl<F: Function> Values<'_, F> {
    #[inline(always)]
    fn fill<P: Pack>(self) {
        let lanes = P::LANES as usize;
        let arguments = self.x.chunks(lanes).zip(self.y.chunks(lanes));
        for (out, (x, y)) in self.out.chunks_mut(lanes).zip(arguments) {
            F::call(P::load(x, 1.0), P::load(y, 1.0)).store(out);
        }
    }
}

impl<F: Function> Kernel for Values<'_, F> {
    type Output = ();
    #[inline(always)]
    fn run<L: Level>(self) {
        if self.unfused {
            self.fill::<Nf<W<L::Pack, 2>>>();
        } else {
            self.fill::<L::Pack>();
        }
    }
}

fn lanes<F: Function>(cpu: Cpu, unfused: bool, x: &[f64], y: &[f64], out: &mut [f64]) {
    let function = PhantomData::<F>;
    dispatch_at_most(
        cpu,
        Values {
            function,
            unfused,
            x,
            y,
            out,
        },
    );
}

macro_rules! rows {
    ($($name:ident $(($second:ident))? $bound:literal: $(($($range:expr),*))*;)*) => {
        $(
            #[allow(non_camel_case_types)]
            struct $name;
            impl Function for $name {
                #[inline(always)]
                fn call<T: Real>(x: T, y: T) -> T {
                    let _ = y;
                    x.$name($({ let $second = y; $second })?)
                }
            }
        )*
        /// Every function.
        pub const ROWS: &[Row] = &[$(Row {
            name: stringify!($name),
            bound: $bound,
            ranges: &[$(rows!(@pair $($range),*)),*],
            f64: $name::call,
            f32: $name::call,
            exact: $name::call,
            lanes: lanes::<$name>,
        }),*];
    };
    (@pair $first:expr) => { ($first, Linear(1.0, 1.0)) };
    (@pair $first:expr, $second:expr) => { ($first, $second) };
}

const TINY: f64 = 5e-324;
const LARGEST: f64 = f64::MAX;

rows! {
    sin 0.8: (Linear(-4.0, 4.0)) (Linear(-1e6, 1e6)) (Binades(TINY, LARGEST)) (NearTurns)
        (Near(1048576.0));
    cos 0.8: (Linear(-4.0, 4.0)) (Linear(-1e6, 1e6)) (Binades(TINY, LARGEST)) (NearTurns)
        (Near(1048576.0));
    tan 1.0: (Linear(-4.0, 4.0)) (Linear(-1e6, 1e6)) (Binades(TINY, LARGEST)) (NearTurns)
        (Near(1048576.0));
    exp 0.8: (Linear(-1.0, 1.0)) (Linear(-750.0, 711.0)) (Binades(TINY, 1.0)) (Near(708.0))
        (Near(-708.0)) (Near(709.782712893384)) (Near(-745.1332191019411));
    exp_m1 1.0: (Linear(-1.5, 1.5)) (Linear(-50.0, 710.0)) (Binades(TINY, 1.0)) (Near(708.0))
        (Near(0.34657359027997264)) (Near(-0.34657359027997264));
    ln 1.0: (Linear(0.5, 2.0)) (Positive(TINY, LARGEST)) (Near(1.0)) (Near(f64::MIN_POSITIVE))
        (Near(0.69)) (Near(1.38)) (Linear(1.25, 1.284));
    ln_1p 1.0: (Linear(-0.9, 2.0)) (Linear(-1.0, -0.9)) (Binades(TINY, 0.9))
        (Positive(TINY, LARGEST)) (Near(0.38));
    cbrt 1.0: (Linear(-8.0, 8.0)) (Binades(TINY, LARGEST)) (Near(1.0)) (Near(f64::MIN_POSITIVE));
    sinh 1.0: (Linear(-2.0, 2.0)) (Linear(-711.0, 711.0)) (Binades(TINY, 1.0)) (Near(708.0))
        (Near(0.34657359027997264));
    cosh 1.0: (Linear(-2.0, 2.0)) (Linear(-711.0, 711.0)) (Binades(TINY, 1.0)) (Near(708.0))
        (Near(0.34657359027997264));
    tanh 1.0: (Linear(-2.0, 2.0)) (Linear(-25.0, 25.0)) (Binades(TINY, LARGEST)) (Near(22.0))
        (Near(0.34657359027997264));
    asinh 1.0: (Linear(-2.0, 2.0)) (Binades(TINY, LARGEST)) (Binades(1e-17, 1.0))
        (Near(1.2676506002282294e30));
    acosh 1.0: (Linear(1.0, 2.0)) (Positive(1.0, LARGEST)) (Near(1.25)) (Positive(1.0, 1.0001))
        (Near(1.2676506002282294e30));
    atanh 1.0: (Linear(-1.0, 1.0)) (Binades(TINY, 1.0)) (Binades(1e-17, 1.0)) (Binades(0.999, 1.0));
    atan 1.0: (Linear(-3.0, 3.0)) (Binades(TINY, LARGEST)) (Near(0.41421356237309503))
        (Near(2.414213562373095)) (Near(1.0)) (Binades(1e-3, 1e3));
    asin 1.0: (Linear(-1.0, 1.0)) (Binades(TINY, 1.0)) (Near(0.5)) (Binades(0.999, 1.0));
    acos 1.0: (Linear(-1.0, 1.0)) (Binades(TINY, 1.0)) (Near(0.5)) (Binades(0.999, 1.0));
    erf 1.5: (Linear(-1.0, 1.0)) (Linear(-6.5, 6.5)) (Binades(TINY, LARGEST)) (Near(1.0))
        (Near(6.0));
    erfc 1.5: (Linear(-6.5, 6.5)) (Linear(0.0, 28.0)) (Binades(TINY, 1.0)) (Near(26.0)) (Near(1.0));
    sqrt 0.5: (Positive(TINY, LARGEST)) (Linear(0.0, 4.0));
    atan2 (y) 1.0: (Linear(-2.0, 2.0), Linear(-2.0, 2.0))
        (Binades(1e-160, 1e160), Binades(1e-160, 1e160))
        (Binades(TINY, LARGEST), Binades(TINY, LARGEST)) (Near(1.0), Near(1.0))
        (Near(1.0), Near(2.414213562373095)) (Near(1e-310), Near(1e-310));
    hypot (y) 1.0: (Linear(-2.0, 2.0), Linear(-2.0, 2.0))
        (Binades(1e-160, 1e160), Binades(1e-160, 1e160))
        (Binades(TINY, 1e308), Binades(TINY, 1e308)) (Near(3.0), Near(4.0))
        (Near(1e-310), Near(1e-310)) (Near(1e300), Near(1e290));
    pow (y) 1.5: (Linear(0.0, 4.0), Linear(-100.0, 100.0))
        (Positive(1e-300, 1e300), Linear(-1.0, 1.0)) (Positive(TINY, LARGEST), Linear(-3.0, 3.0))
        (Near(1.0), Linear(-1e12, 1e12)) (Linear(0.999, 1.001), Linear(-7e5, 7e5))
        (Linear(0.6, 1.6), Linear(-1500.0, 1500.0)) (Near(2.0), Near(1023.9));
}

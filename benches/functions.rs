//! The cost of an elementary function: nanoseconds a value for scalars and for the packs of every
//! level of this CPU, one register (`avx512`) and several in lock-step (`avx512-wide`), beside the
//! standard library and the crate `wide`, all in one process.
//!
//! `cargo bench --bench functions` prints a table; with `-- --json` one line a function and level:
//! `{"function":…, "level":…, "ns":…, "std_ns":…}`, and the latencies. `wide` chooses its
//! instructions when it is compiled: with `RUSTFLAGS="-C target-cpu=native"` it has those that the
//! levels here find at run time. (The crate `sleef` 0.3.3 needs a nightly compiler and is left out;
//! so are functions that neither `std` nor `wide` has.) Each number is the least of many short
//! rounds, which alternate between the rivals, so that only ratios within one line matter.
//!
//! With `-- --decades`, instead, what the decades of arguments from 1e-307 to 1e307 cost, of either sign
//! where the function is defined for both: the usual nanoseconds, those at 1 or 0.1, and each band of
//! decades in which a value takes more than four times as long. A star says that results there leave the
//! normal numbers.
//!
//! The last line is W1, the pendulum by Störmer–Verlet with one state: the same loop with the sine
//! of this library and with that of the standard library.

#![allow(clippy::type_complexity, clippy::redundant_closure)]

use std::hint::black_box;
use std::marker::PhantomData;
use std::time::Instant;

use hamiltonian_lanes::{Cpu, Kernel, Level, Pack, Real, dispatch_at_most};
use wide::f64x8;

/// Values a pass, a multiple of the lanes of every pack: their arguments stay in the first cache.
const COUNT: usize = 960;
/// Passes a round: reading the clock twice costs as much as a hundred values do.
const PASSES: usize = 16;
const ROUNDS: usize = 50;

/// One function as it is written over every scalar, and as its rivals have it.
trait Function {
    const NAME: &'static str;
    /// The range of arguments, drawn uniformly.
    const RANGE: (f64, f64);
    fn ours<T: Real>(x: T) -> T;
    /// `None` where the standard library has no such function.
    const STD: Option<fn(&[f64], &mut [f64])>;
    const STD_CHAIN: Option<fn(&[f64]) -> f64>;
    const WIDE: Option<fn(&[f64], &mut [f64])>;
}

/// The values of `$f` at all arguments, one after the other.
macro_rules! each {
    ($x:ident => $f:expr) => {
        |from: &[f64], into: &mut [f64]| {
            for (&$x, into) in from.iter().zip(into) {
                *into = $f;
            }
        }
    };
}

/// Values each of which waits for the one before: a product by 0 and a sum more than the function.
macro_rules! chain {
    ($x:ident => $f:expr) => {
        |from: &[f64]| {
            let zero = black_box(0.0);
            let mut last = 0.0;
            for &x in from {
                let $x = x + zero * last;
                last = $f;
            }
            last
        }
    };
}

macro_rules! functions {
    (@std $x:ident $std:expr) => {
        const STD: Option<fn(&[f64], &mut [f64])> = Some(each!($x => $std));
        const STD_CHAIN: Option<fn(&[f64]) -> f64> = Some(chain!($x => $std));
    };
    (@std $x:ident) => {
        const STD: Option<fn(&[f64], &mut [f64])> = None;
        const STD_CHAIN: Option<fn(&[f64]) -> f64> = None;
    };
    (@wide $x:ident $wide:expr) => {
        const WIDE: Option<fn(&[f64], &mut [f64])> = Some(|from, into| {
            for (from, into) in from.chunks_exact(8).zip(into.chunks_exact_mut(8)) {
                let $x = f64x8::new(<[f64; 8]>::try_from(from).unwrap());
                into.copy_from_slice(&$wide.to_array());
            }
        });
    };
    (@wide $x:ident) => { const WIDE: Option<fn(&[f64], &mut [f64])> = None; };
    ($($name:ident($x:ident) in $low:literal .. $high:literal:
        $ours:expr $(, std $std:expr)? $(, wide $wide:expr)?;)*) => {
        $(
            #[allow(non_camel_case_types)]
            struct $name;
            impl Function for $name {
                const NAME: &'static str = stringify!($name);
                const RANGE: (f64, f64) = ($low, $high);
                #[inline(always)]
                fn ours<T: Real>($x: T) -> T { $ours }
                functions!(@std $x $($std)?);
                functions!(@wide $x $($wide)?);
            }
        )*
        fn all(report: &mut Report) {
            $(report.function::<$name>();)*
        }
    };
}

functions! {
    sin(x) in -10.0 .. 10.0: x.sin(), std f64::sin(x), wide x.sin();
    cos(x) in -10.0 .. 10.0: x.cos(), std f64::cos(x), wide x.cos();
    // Both values are needed: their sum.
    sin_cos(x) in -10.0 .. 10.0: { let (s, c) = x.sin_cos(); s + c },
        std { let (s, c) = f64::sin_cos(x); s + c }, wide { let (s, c) = x.sin_cos(); s + c };
    tan(x) in -10.0 .. 10.0: x.tan(), std f64::tan(x), wide x.tan();
    exp(x) in -20.0 .. 20.0: x.exp(), std f64::exp(x), wide x.exp();
    exp_m1(x) in -2.0 .. 2.0: x.exp_m1(), std f64::exp_m1(x);
    ln(x) in 0.1 .. 100.0: x.ln(), std f64::ln(x), wide x.ln();
    ln_1p(x) in -0.5 .. 10.0: x.ln_1p(), std f64::ln_1p(x);
    pow(x) in 0.1 .. 10.0: x.pow(x), std f64::powf(x, x), wide x.powf_simd(x);
    cbrt(x) in -10.0 .. 10.0: x.cbrt(), std f64::cbrt(x);
    sinh(x) in -5.0 .. 5.0: x.sinh(), std f64::sinh(x);
    cosh(x) in -5.0 .. 5.0: x.cosh(), std f64::cosh(x);
    tanh(x) in -5.0 .. 5.0: x.tanh(), std f64::tanh(x);
    asinh(x) in -5.0 .. 5.0: x.asinh(), std f64::asinh(x);
    acosh(x) in 1.0 .. 10.0: x.acosh(), std f64::acosh(x);
    atanh(x) in -1.0 .. 1.0: x.atanh(), std f64::atanh(x);
    atan(x) in -5.0 .. 5.0: x.atan(), std f64::atan(x), wide x.atan();
    atan2(x) in -5.0 .. 5.0: x.atan2(T::one() - x), std f64::atan2(x, 1.0 - x),
        wide x.atan2(f64x8::ONE - x);
    asin(x) in -1.0 .. 1.0: x.asin(), std f64::asin(x), wide x.asin();
    acos(x) in -1.0 .. 1.0: x.acos(), std f64::acos(x), wide x.acos();
    hypot(x) in -5.0 .. 5.0: x.hypot(T::one() - x), std f64::hypot(x, 1.0 - x);
    erf(x) in -3.0 .. 3.0: x.erf();
    erfc(x) in -3.0 .. 3.0: x.erfc();
    floor(x) in -9.0 .. 9.0: Real::floor(x);
    round(x) in -9.0 .. 9.0: Real::round(x);
}

/// A level's way through the arguments.
#[derive(Clone, Copy)]
enum Shape {
    /// One register after the other.
    Pack,
    /// As many registers at once as the level holds to hide latencies.
    Wide,
    /// One argument after the other in all lanes of a register, each waiting for the last.
    Chain,
}

/// A function over all arguments.
struct Values<'a, F> {
    function: PhantomData<F>,
    from: &'a [f64],
    into: &'a mut [f64],
    shape: Shape,
}

#[inline(always)]
fn throughput<F: Function, P: Pack>(from: &[f64], into: &mut [f64]) {
    let lanes = P::LANES as usize;
    for (from, into) in (from.chunks_exact(lanes)).zip(into.chunks_exact_mut(lanes)) {
        F::ours(P::load(from, 0.0)).store(into);
    }
}

impl<F: Function> Kernel for Values<'_, F> {
    type Output = ();
    #[inline(always)]
    fn run<L: Level>(self) {
        match self.shape {
            Shape::Pack => throughput::<F, L::Pack>(self.from, self.into),
            Shape::Wide => throughput::<F, L::Wide>(self.from, self.into),
            Shape::Chain => {
                let zero = L::Pack::constant(black_box(0.0), 0.0);
                let mut last = zero;
                for &x in self.from {
                    last = F::ours(L::Pack::constant(x, 0.0) + zero * last);
                }
                last.store(self.into);
            }
        }
    }
}

fn on_level<F: Function>(cpu: Cpu, shape: Shape, from: &[f64], into: &mut [f64]) {
    let function = PhantomData::<F>;
    dispatch_at_most(
        cpu,
        Values {
            function,
            from,
            into,
            shape,
        },
    );
}

/// One rival: its name and one pass of its work.
struct Rival<'a> {
    name: String,
    chained: bool,
    pass: Box<dyn FnMut(&[f64], &mut [f64]) + 'a>,
    least: f64,
}

struct Report {
    json: bool,
    decades: bool,
    only: Vec<String>,
}

impl Report {
    fn function<F: Function>(&mut self) {
        if !self.only.is_empty() && !self.only.iter().any(|name| name == F::NAME) {
            return;
        }
        if self.decades {
            bands::<F>("scalar", &mut |from, into| {
                each!(x => F::ours(x))(from, into)
            });
            bands::<F>("pack", &mut |from, into| {
                on_level::<F>(Cpu::best(), Shape::Pack, from, into);
            });
            return;
        }
        let (low, high) = F::RANGE;
        // A stride that meets every part of the range in no order.
        let from: Vec<f64> = (0..COUNT)
            .map(|k| low + (high - low) * ((k * 389 % COUNT) as f64 + 0.37) / COUNT as f64)
            .collect();
        let mut into = vec![0.0; COUNT];
        let mut rivals = Vec::new();
        let mut add = |name: &str, chained, pass: Box<dyn FnMut(&[f64], &mut [f64])>| {
            let name = name.to_string();
            rivals.push(Rival {
                name,
                chained,
                pass,
                least: f64::INFINITY,
            });
        };
        if let (Some(values), Some(chain)) = (F::STD, F::STD_CHAIN) {
            add("std", false, Box::new(values));
            add(
                "std",
                true,
                Box::new(move |from, into| into[0] = chain(from)),
            );
        }
        if let Some(values) = F::WIDE {
            add("wide", false, Box::new(values));
        }
        add("scalar", false, Box::new(each!(x => F::ours(x))));
        add(
            "scalar",
            true,
            Box::new(|from, into| into[0] = chain!(x => F::ours(x))(from)),
        );
        for cpu in Cpu::available() {
            let name = format!("{cpu:?}").to_lowercase();
            let wide = format!("{name}-wide");
            for (name, shape) in [
                (&name, Shape::Pack),
                (&wide, Shape::Wide),
                (&name, Shape::Chain),
            ] {
                let chained = matches!(shape, Shape::Chain);
                let pass = move |from: &[f64], into: &mut [f64]| {
                    on_level::<F>(cpu, shape, from, into);
                };
                add(name, chained, Box::new(pass));
            }
        }
        for _ in 0..ROUNDS {
            for rival in &mut rivals {
                let start = Instant::now();
                for _ in 0..PASSES {
                    (rival.pass)(black_box(&from), black_box(&mut into));
                }
                let each = start.elapsed().as_secs_f64() * 1e9 / (COUNT * PASSES) as f64;
                rival.least = rival.least.min(each);
            }
        }
        self.lines(F::NAME, &rivals);
    }

    fn lines(&self, function: &str, rivals: &[Rival]) {
        let least = |name: &str, chained| {
            let found = rivals
                .iter()
                .find(|rival| rival.name == name && rival.chained == chained);
            found.map(|rival| rival.least)
        };
        let number =
            |value: Option<f64>| value.map_or("null".into(), |value| format!("{value:.3}"));
        if !self.json {
            print!("{function:8}");
        }
        for rival in rivals.iter().filter(|rival| !rival.chained) {
            let latency = least(&rival.name, true);
            if self.json {
                println!(
                    "{{\"function\":\"{function}\",\"level\":\"{}\",\"ns\":{:.3},\"std_ns\":{},\
                     \"latency_ns\":{},\"std_latency_ns\":{}}}",
                    rival.name,
                    rival.least,
                    number(least("std", false)),
                    number(latency),
                    number(least("std", true)),
                );
            } else {
                let ratio = least("std", false)
                    .map_or(String::new(), |std| format!(" ({:.1}×)", std / rival.least));
                print!("  {} {:.2}{ratio}", rival.name, rival.least);
            }
        }
        if !self.json {
            let scalar = least("scalar", true).unwrap_or(f64::NAN);
            let std = least("std", true).unwrap_or(f64::NAN);
            println!("  latency: scalar {scalar:.2}, std {std:.2}");
        }
    }
}

/// Values of a decade, a multiple of the lanes of every pack.
const DECADE: usize = 64;

/// Prints the decades of arguments that are dearer than the usual.
fn bands<F: Function>(name: &str, pass: &mut dyn FnMut(&[f64], &mut [f64])) {
    let mut into = [0.0; DECADE];
    let mut cost = |k: i32| {
        let scale: f64 = format!("1e{k}").parse().unwrap();
        let mut from = [0.0; DECADE];
        for (i, x) in from.iter_mut().enumerate() {
            let size = scale * (1.0 + 8.0 * (i * 37 % DECADE) as f64 / DECADE as f64);
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            // The other sign where the function is not defined for this one.
            let signed = [sign * size, -sign * size];
            *x = *signed.iter().find(|x| !F::ours(**x).is_nan())?;
        }
        let mut least = f64::INFINITY;
        for _ in 0..9 {
            let start = Instant::now();
            for _ in 0..PASSES {
                pass(black_box(&from), black_box(&mut into));
            }
            least = least.min(start.elapsed().as_secs_f64());
        }
        let leaves = into.iter().any(|y| !y.is_normal());
        Some((least * 1e9 / (DECADE * PASSES) as f64, leaves))
    };
    let usual = cost(0).or_else(|| cost(-1)).unwrap().0;
    let mut bands: Vec<(i32, i32, f64, bool)> = vec![];
    for k in -307..=307 {
        let Some((ns, leaves)) = cost(k) else {
            continue;
        };
        if ns <= 4.0 * usual {
            continue;
        }
        match bands.last_mut().filter(|band| band.1 == k - 1) {
            Some(band) => *band = (band.0, k, ns.max(band.2), leaves | band.3),
            None => bands.push((k, k, ns, leaves)),
        }
    }
    print!("{:8} {name:6} {usual:6.2} ns", F::NAME);
    for (low, high, ns, leaves) in bands {
        let star = if leaves { "*" } else { "" };
        print!("  1e{low} to 1e{high}: {:.0}×{star}", ns / usual);
    }
    println!();
}

/// W1: steps of a pendulum with the given sine, kick–drift form.
#[inline(always)]
fn pendulum(sine: impl Fn(f64) -> f64, start: (f64, f64), n: u32) -> (f64, f64) {
    let (kick, drift) = (black_box(9.81e-3), black_box(1e-3));
    let (mut q, mut p) = start;
    for _ in 0..n {
        p -= kick * sine(q);
        q += drift * p;
    }
    (q, p)
}

#[inline(never)]
fn pendulum_ours(start: (f64, f64), n: u32) -> (f64, f64) {
    pendulum(|q| Real::sin(q), start, n)
}

#[inline(never)]
fn pendulum_std(start: (f64, f64), n: u32) -> (f64, f64) {
    pendulum(f64::sin, start, n)
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let json = arguments.iter().any(|argument| argument == "--json");
    let decades = arguments.iter().any(|argument| argument == "--decades");
    let only = arguments
        .into_iter()
        .filter(|argument| !argument.starts_with("--"))
        .collect();
    let mut report = Report {
        json,
        decades,
        only,
    };
    all(&mut report);
    if decades {
        return;
    }

    let n = 2000;
    let mut least = [f64::INFINITY; 2];
    for _ in 0..ROUNDS {
        for (least, steps) in least.iter_mut().zip([pendulum_ours, pendulum_std]) {
            let start = Instant::now();
            black_box(steps(black_box((0.7, 3.0)), n));
            *least = least.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(n));
        }
    }
    let [ours, std] = least;
    if json {
        println!(
            "{{\"function\":\"pendulum step\",\"level\":\"scalar\",\"ns\":{ours:.3},\"std_ns\":{std:.3}}}"
        );
    } else {
        println!(
            "pendulum, one state: {ours:.2} ns a step, with std {std:.2}: {:.2}×",
            std / ours
        );
    }
}

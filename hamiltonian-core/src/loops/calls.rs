//! Independent calls of one function in an evaluation, such as the exponentials of a ring.
//!
//! Input: the arguments of up to eight calls. Output: the values, computed in the registers that each CPU of the
//! architecture has, so that no level is entered. Invariant: the bits are those of one call after the other.

use crate::systems::compiled::Compiled;
use hamiltonian_lanes::{AtHand, Cpu, Level, Nf, Pack, Real};

/// The most calls that are computed together.
const MAX_CALLS: usize = 8;

/// A function of one number.
pub trait Call {
    /// Its value, or values.
    type Value<T: Real>: Copy;
    /// The least number of calls that are faster together than one after the other.
    const LEAST: usize;
    /// Computes it.
    fn of<T: Real>(x: T) -> Self::Value<T>;
    /// The values in the lanes of a pack, up to eight.
    fn lanes<T: Real, P: Pack>(values: Self::Value<T::Over<P>>) -> [Self::Value<T>; MAX_CALLS];
}

/// Functions with one value, and from how many calls on these are faster together.
macro_rules! calls {
    ($($name:ident $method:ident $least:literal;)*) => {
        $(
            /// The function of that name.
            #[derive(Debug)]
            pub struct $name;

            impl Call for $name {
                type Value<T: Real> = T;
                const LEAST: usize = $least;
                #[cfg_attr(not(unoptimised), inline(always))]
                fn of<T: Real>(x: T) -> T {
                    x.$method()
                }
                #[cfg_attr(not(unoptimised), inline(always))]
                fn lanes<T: Real, P: Pack>(values: T::Over<P>) -> [T; MAX_CALLS] {
                    scattered::<T, P>(values)
                }
            }
        )*
    };
}

hamiltonian_lanes::computed_together!(calls);

/// Sine and cosine of one angle.
#[derive(Debug)]
pub struct SinCos;

impl Call for SinCos {
    type Value<T: Real> = (T, T);
    const LEAST: usize = 4;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn of<T: Real>(x: T) -> (T, T) {
        x.sin_cos()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn lanes<T: Real, P: Pack>((sines, cosines): (T::Over<P>, T::Over<P>)) -> [(T, T); MAX_CALLS] {
        let (sines, cosines) = (scattered::<T, P>(sines), scattered::<T, P>(cosines));
        let mut out = [(sines[0], cosines[0]); MAX_CALLS];
        let mut k = 1;
        while k < MAX_CALLS {
            out[k] = (sines[k], cosines[k]);
            k += 1;
        }
        out
    }
}

#[cfg_attr(not(unoptimised), inline(always))]
fn scattered<T: Real, P: Pack>(from: T::Over<P>) -> [T; MAX_CALLS] {
    let mut out = [T::default(); MAX_CALLS];
    T::scatter::<P>(from, &mut out[..P::LANES as usize]);
    out
}

/// Returns true if so many calls over `T` are computed together.
#[must_use]
#[cfg_attr(not(unoptimised), inline(always))]
pub const fn are_together<T: Real, C: Call>(count: usize) -> bool {
    // Plain code for two lanes gains nothing.
    let has_registers = !matches!(AtHand::CPU, Cpu::Portable);
    T::WIDENS && has_registers && count >= C::LEAST && count <= MAX_CALLS
}

/// The values of a function at `N` points. Written out where it is called, a function in four registers takes rustc a
/// tenth of a second each time, and a run some nanoseconds less.
#[cfg_attr(not(unoptimised), inline(always))]
#[must_use]
pub fn together<T: Real, C: Call, const N: usize, const WRITTEN_OUT: bool>(
    x: [T; N],
) -> [C::Value<T>; N] {
    let mut padded = [x[0]; MAX_CALLS];
    let mut k = 1;
    while k < N {
        padded[k] = x[k];
        k += 1;
    }
    let all = match N {
        0..=2 => in_pack::<T, C, Compiled<Nf<<AtHand as Level>::Pack>>, WRITTEN_OUT>(&padded),
        3..=4 => in_pack::<T, C, Compiled<Nf<<AtHand as Level>::Four>>, WRITTEN_OUT>(&padded),
        _ => in_pack::<T, C, Compiled<Nf<<AtHand as Level>::Eight>>, WRITTEN_OUT>(&padded),
    };
    let mut out = [all[0]; N];
    let mut k = 1;
    while k < N {
        out[k] = all[k];
        k += 1;
    }
    out
}

#[cfg_attr(not(unoptimised), inline(always))]
fn in_pack<T: Real, C: Call, P: Pack, const WRITTEN_OUT: bool>(
    x: &[T; MAX_CALLS],
) -> [C::Value<T>; MAX_CALLS] {
    let x = T::gather::<P>(&x[..P::LANES as usize]);
    C::lanes::<T, P>(match WRITTEN_OUT {
        true => C::of(x),
        false => out_of_line::<T::Over<P>, C>(x),
    })
}

#[inline(never)]
fn out_of_line<T: Real, C: Call>(x: T) -> C::Value<T> {
    C::of(x)
}

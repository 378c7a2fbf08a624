//! The levels, and the way into them.
//!
//! Input: a [`Kernel`] and the highest level it may run on. Output: the kernel's result. Invariant:
//! a level is entered only if [`Cpu::best`] reaches it, and a kernel that is inlined into its entry
//! is compiled with that level's instructions.

use core::fmt::Debug;

use crate::pack::{Pack, V, W};

/// Capabilities of a CPU, from the least on. Which levels exist depends on the architecture; the least
/// is on all of them.
///
/// | level | registers | one rounding for `fma` | where |
/// |---|---|---|---|
/// | `Portable` | 2 × `f64` in plain code | no | everywhere |
/// | `Sse2` | 2 × `f64` | no | x86-64, always there |
/// | `Neon` | 2 × `f64` | yes | aarch64, always there |
/// | `Avx2` | 4 × `f64` | yes | x86-64 with AVX2 and FMA |
/// | `Avx512` | 8 × `f64` | yes | x86-64 with AVX-512 F, DQ, CD, BW and VL |
///
/// ```
/// use hamiltonian_lanes::Cpu;
/// assert!(Cpu::available().any(|cpu| cpu == Cpu::Portable));
/// assert_eq!(Cpu::available().last(), Some(Cpu::best()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Cpu {
    /// Plain code for two lanes.
    Portable,
    /// SSE2: two lanes, nothing fuses.
    Sse2,
    /// NEON: two lanes, fused.
    Neon,
    /// AVX2 with FMA: four lanes, fused.
    Avx2,
    /// AVX-512: eight lanes, fused.
    Avx512,
}

/// Whether this CPU has a feature. Without `std` nobody asks the CPU: it has what the crate was
/// compiled for (`-C target-cpu`).
#[cfg(target_arch = "x86_64")]
macro_rules! has {
    ($($feature:tt)*) => {{
        #[cfg(feature = "std")]
        let has = $(std::arch::is_x86_feature_detected!($feature))&&*;
        #[cfg(not(feature = "std"))]
        let has = $(cfg!(target_feature = $feature))&&*;
        has
    }};
}

impl Cpu {
    /// The best level of the CPU that this runs on.
    #[inline]
    pub fn best() -> Cpu {
        #[cfg(target_arch = "x86_64")]
        {
            if !has!("avx2" "fma") {
                Cpu::Sse2
            } else if has!("avx512f" "avx512dq" "avx512cd" "avx512bw" "avx512vl") {
                Cpu::Avx512
            } else {
                Cpu::Avx2
            }
        }
        #[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
        {
            Cpu::Neon
        }
        #[cfg(not(any(
            target_arch = "x86_64",
            all(target_arch = "aarch64", target_feature = "neon")
        )))]
        {
            Cpu::Portable
        }
    }

    /// The levels this CPU has, from the least on.
    pub fn available() -> impl Iterator<Item = Cpu> {
        let best = Cpu::best();
        let on_x86 = cfg!(target_arch = "x86_64");
        [
            (Cpu::Portable, true),
            (Cpu::Sse2, on_x86),
            (Cpu::Neon, !on_x86),
            (Cpu::Avx2, on_x86),
            (Cpu::Avx512, on_x86),
        ]
        .into_iter()
        .filter(move |&(cpu, here)| here && cpu <= best)
        .map(|(cpu, _)| cpu)
    }
}

mod sealed {
    pub trait Sealed {}
}

/// A CPU level: the scalars of its registers. It is named only inside [`Kernel::run`], which is
/// entered only where the CPU has the level.
pub trait Level: sealed::Sealed + Copy + Debug + Default + Send + Sync + 'static {
    /// One number, with this level's fused products.
    type Scalar: Pack;
    /// One register.
    type Pack: Pack;
    /// As many registers in lock-step as hide the latency of their operations.
    type Wide: Pack;
    /// The level this is.
    const CPU: Cpu;

    /// Enters the level anew: `kernel.run::<Self>()` in a function that is compiled with this
    /// level's instructions and stands out of line. For large pieces of a kernel that should not be
    /// inlined.
    fn enter<K: Kernel>(kernel: K) -> K::Output;
}

/// Work written once for every level.
///
/// `run` and all that it calls in a loop must be `#[inline(always)]`: what is inlined into the
/// level's entry is compiled with its instructions, a call left in a lane loop costs a factor of a
/// hundred.
///
/// ```
/// use hamiltonian_lanes::{Kernel, Level, Pack, Real, dispatch};
///
/// /// q ← q + ½p for many trajectories.
/// struct Drift<'a> {
///     q: &'a mut [f64],
///     p: &'a [f64],
/// }
///
/// impl Kernel for Drift<'_> {
///     type Output = ();
///     #[inline(always)]
///     fn run<L: Level>(self) {
///         let lanes = L::Pack::LANES as usize;
///         let half = L::Pack::constant(0.5, 0.0);
///         for (q, p) in self.q.chunks_mut(lanes).zip(self.p.chunks(lanes)) {
///             // The last chunk may be shorter: the missing lanes are 0 and are not stored.
///             half.fma(L::Pack::load(p, 0.0), L::Pack::load(q, 0.0)).store(q);
///         }
///     }
/// }
///
/// let (mut q, p) = ([1.0; 13], [2.0; 13]);
/// dispatch(Drift { q: &mut q, p: &p });
/// assert_eq!(q, [2.0; 13]);
/// ```
pub trait Kernel {
    /// The computation.
    type Output;
    /// Computes it on level `L`.
    fn run<L: Level>(self) -> Self::Output;
}

/// Runs a kernel on the best level of this CPU.
#[inline]
pub fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    dispatch_at_most(Cpu::best(), kernel)
}

/// Runs a kernel on the best level of this CPU that is not above `limit`: the results of a smaller
/// CPU on a larger one.
///
/// ```
/// use hamiltonian_lanes::{Cpu, Kernel, Level, dispatch_at_most};
///
/// struct Which;
/// impl Kernel for Which {
///     type Output = Cpu;
///     fn run<L: Level>(self) -> Cpu {
///         L::CPU
///     }
/// }
/// assert_eq!(dispatch_at_most(Cpu::Portable, Which), Cpu::Portable);
/// assert_eq!(dispatch_at_most(Cpu::Avx512, Which), Cpu::best());
/// ```
#[inline]
pub fn dispatch_at_most<K: Kernel>(limit: Cpu, kernel: K) -> K::Output {
    match limit.min(Cpu::best()) {
        #[cfg(target_arch = "x86_64")]
        Cpu::Avx512 => Avx512::enter(kernel),
        #[cfg(target_arch = "x86_64")]
        Cpu::Avx2 => Avx2::enter(kernel),
        #[cfg(target_arch = "x86_64")]
        Cpu::Neon | Cpu::Sse2 => Sse2::enter(kernel),
        #[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
        Cpu::Neon => Neon::enter(kernel),
        _ => Portable::enter(kernel),
    }
}

/// One level: its type, its registers, how many of them are wide, its features.
macro_rules! level {
    ($(#[$where:meta])* $level:ident, $scalar:ty, $register:ty, $wide:literal $(, $features:literal)?) => {
        $(#[$where])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $level;

        $(#[$where])*
        impl sealed::Sealed for $level {}

        $(#[$where])*
        impl Level for $level {
            type Scalar = $scalar;
            type Pack = V<$register>;
            type Wide = W<V<$register>, $wide>;
            const CPU: Cpu = Cpu::$level;

            #[inline(always)]
            fn enter<K: Kernel>(kernel: K) -> K::Output {
                $(#[target_feature(enable = $features)])?
                #[inline(never)]
                fn entry<K: Kernel>(kernel: K) -> K::Output {
                    kernel.run::<$level>()
                }
                // SAFETY: `entry` asks for the features of the level alone. The level is private,
                // so this is called by `dispatch_at_most`, which has asked the CPU, or by a kernel
                // that runs on this level already.
                #[allow(unused_unsafe)]
                unsafe {
                    entry(kernel)
                }
            }
        }
    };
}

level!(Portable, f64, super::portable::Two, 4);
level!(
    #[cfg(target_arch = "x86_64")]
    Sse2,
    f64,
    core::arch::x86_64::__m128d,
    4
);
level!(
    #[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
    Neon,
    V<super::neon::One>,
    core::arch::aarch64::float64x2_t,
    8
);
level!(
    #[cfg(target_arch = "x86_64")]
    Avx2,
    V<super::avx2::One>,
    core::arch::x86_64::__m256d,
    6,
    "avx2,fma"
);
level!(
    #[cfg(target_arch = "x86_64")]
    Avx512,
    V<super::avx2::One>,
    core::arch::x86_64::__m512d,
    10,
    "avx512f,avx512dq,avx512cd,avx512bw,avx512vl,avx2,fma"
);

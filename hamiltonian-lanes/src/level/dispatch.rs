//! The levels, and the way into them.
//!
//! Input: a [`Kernel`] and the highest level it may run on. Output: the kernel's result. Invariant:
//! a level is entered only if [`Cpu::best`] reaches it, and a kernel that is inlined into its entry
//! is compiled with that level's instructions.

use core::fmt::Debug;
use core::sync::atomic::{AtomicU8, Ordering};

use super::pack::{Base, V, W};
use super::register::Register;

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
/// use hamiltonian::lanes::Cpu;
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

/// Returns true if this CPU has a feature. Without `std` the CPU is not queried: it has the
/// features for which the crate was compiled (`-C target-cpu`).
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

/// The highest level that [`Cpu::best`] returns, as a number; levels above it are hidden from the
/// process.
static LIMIT: AtomicU8 = AtomicU8::new(Cpu::Avx512 as u8);

impl Cpu {
    /// The best level of the CPU that this runs on, or the level of [`limit_to`](Cpu::limit_to) if that
    /// is lower.
    #[inline]
    pub fn best() -> Cpu {
        let limit = LIMIT.load(Ordering::Relaxed);
        let best = Cpu::detected();
        // The levels are in ascending order, and 32-bit x86 and aarch64 have their own least level.
        match limit {
            limit if limit >= best as u8 => best,
            limit if limit == Cpu::Avx2 as u8 => Cpu::Avx2,
            limit if limit == Cpu::Portable as u8 => Cpu::Portable,
            _ => best.min(Cpu::Sse2),
        }
    }

    /// Hides the levels above `limit` from the whole process: runs compute as on a CPU without
    /// them. For tests and measurements; current runs do not change.
    ///
    /// ```
    /// use hamiltonian::lanes::Cpu;
    /// Cpu::limit_to(Cpu::Portable);
    /// assert_eq!(Cpu::best(), Cpu::Portable);
    /// Cpu::limit_to(Cpu::Avx512); // hides nothing
    /// assert_eq!(Cpu::available().last(), Some(Cpu::best()));
    /// ```
    pub fn limit_to(limit: Cpu) {
        LIMIT.store(limit as u8, Ordering::Relaxed);
    }

    /// The best level that the CPU has.
    #[inline]
    fn detected() -> Cpu {
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
    type Scalar: Base;
    /// One register.
    type Pack: Base;
    /// As many registers in lock-step as hide the latency of their operations, for one or two numbers.
    type Wide: Base;
    /// Registers in lock-step for three or four numbers, and for numbers that do not fuse, whose functions have more
    /// intermediate results: as many as stay in registers.
    type Several: Base;
    /// Four numbers on every level, in the fastest registers for them: four lanes take half the time of eight
    /// where numbers are divided, and one chain of operations is as long in both.
    type Four: Base;
    /// Eight numbers, on every level, so that sums in lanes have the same order on all levels.
    type Eight: Base;
    /// The level as a value.
    const CPU: Cpu;
    /// True if its packs round a product and a sum together, once.
    const FUSES: bool;

    /// Enters the level anew: `kernel.run::<Self>()` in a function that is compiled with this
    /// level's instructions and stands out of line. For large pieces of a kernel that should not be
    /// inlined.
    fn enter<K: Kernel>(kernel: K) -> K::Output;
}

/// The level that each CPU of the architecture has: its packs need no way in.
///
/// ```
/// use hamiltonian::lanes::{AtHand, Level, Nf, Pack};
/// use hamiltonian::prelude::*;
///
/// let mut sines = [0.0; 4];
/// Nf::<<AtHand as Level>::Four>::load(&[0.0, 0.5, 1.0, 1.5], 0.0).sin().store(&mut sines);
/// assert_eq!(sines, [0.0, 0.5, 1.0, 1.5].map(<f64 as Real>::sin));
/// ```
#[cfg(target_arch = "x86_64")]
pub type AtHand = Sse2;
/// The level that each CPU of the architecture has: its packs need no way in.
#[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
pub type AtHand = Neon;
/// The level that each CPU of the architecture has: its packs need no way in.
#[cfg(not(any(
    target_arch = "x86_64",
    all(target_arch = "aarch64", target_feature = "neon")
)))]
pub type AtHand = Portable;

/// Work written once for every level.
///
/// `run` and all that it calls in a loop must be `#[inline(always)]`: code that is inlined into the
/// level's entry is compiled with its instructions, and a call in a lane loop costs a factor of a
/// hundred.
///
/// ```
/// use hamiltonian::lanes::{Kernel, Level, Pack, dispatch};
/// use hamiltonian::prelude::*;
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
    /// The best level that code is made for: a lower one than [`Cpu::Avx512`] where wider registers gain
    /// nothing. It exists on every architecture as the best of those that are not above it.
    const BEST: Cpu = Cpu::Avx512;
    /// The best level that this work runs on: [`BEST`](Kernel::BEST), or a lower one that its values ask for.
    #[inline(always)]
    fn best(&self) -> Cpu {
        Self::BEST
    }
    /// Computes it on level `L`.
    fn run<L: Level>(self) -> Self::Output;
}

/// Runs a kernel on the best level of this CPU; on x86-64, where SSE2 is always there, not on `Portable`,
/// of which no code is made then.
#[inline]
pub fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    match Cpu::best().min(kernel.best()) {
        #[cfg(target_arch = "x86_64")]
        Cpu::Avx512 if const { K::BEST as u8 >= Cpu::Avx512 as u8 } => Avx512::enter(kernel),
        #[cfg(target_arch = "x86_64")]
        Cpu::Avx512 | Cpu::Avx2 if const { K::BEST as u8 >= Cpu::Avx2 as u8 } => {
            Avx2::enter(kernel)
        }
        #[cfg(target_arch = "x86_64")]
        _ => Sse2::enter(kernel),
        #[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
        Cpu::Neon => Neon::enter(kernel),
        #[cfg(not(target_arch = "x86_64"))]
        _ => Portable::enter(kernel),
    }
}

/// Runs a kernel on the best level of this CPU that is not above `limit`: the results of a smaller
/// CPU on a larger one.
///
/// ```
/// use hamiltonian::lanes::{Cpu, Kernel, Level, dispatch_at_most};
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

/// One level: its visibility, its type, the module of its entries, its registers, how many of them are wide, are several, and hold
/// eight numbers, its features.
macro_rules! level {
    (
        $(#[$where:meta])* $visible:vis $level:ident in $module:ident, $scalar:ty, $register:ty,
        $wide:literal, $several:literal, $eight:literal, $four:ty
        $(, $features:literal)?
    ) => {
        $(#[$where])*
        #[derive(Clone, Copy, Debug, Default)]
        $visible struct $level;

        $(#[$where])*
        impl sealed::Sealed for $level {}

        $(#[$where])*
        impl Level for $level {
            type Scalar = $scalar;
            type Pack = V<$register>;
            type Wide = W<V<$register>, $wide>;
            type Several = W<V<$register>, $several>;
            type Eight = W<V<$register>, $eight>;
            type Four = $four;
            const CPU: Cpu = Cpu::$level;
            const FUSES: bool = <$register as Register>::FUSED;

            #[inline(always)]
            fn enter<K: Kernel>(kernel: K) -> K::Output {
                $module::enter(kernel)
            }
        }

        /// The entries stand in a module for each level, so that rustc compiles the levels at the same time: it
        /// divides generic code by modules.
        $(#[$where])*
        mod $module {
            use super::{Kernel, $level};

            // rustc ignores `inline(never)` on a function with features. This function has none, so a function with
            // features cannot be inlined into it.
            #[inline(never)]
            pub(super) fn enter<K: Kernel>(kernel: K) -> K::Output {
                $(#[target_feature(enable = $features)])?
                fn inside<K: Kernel>(kernel: K) -> K::Output {
                    kernel.run::<$level>()
                }
                // SAFETY: `inside` asks for the features of the level alone. The level is private, so this is called by
                // `dispatch_at_most`, which has queried the CPU, or by a kernel that already runs on this level.
                #[allow(unused_unsafe)]
                unsafe {
                    inside(kernel)
                }
            }
        }
    };
}

level!(
    pub Portable in portable,
    f64,
    super::portable::Two,
    4,
    4,
    4,
    W<V<super::portable::Two>, 2>
);
level!(
    #[cfg(target_arch = "x86_64")]
    pub Sse2 in sse2,
    f64,
    core::arch::x86_64::__m128d,
    4,
    4,
    4,
    W<V<core::arch::x86_64::__m128d>, 2>
);
level!(
    #[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
    pub Neon in neon,
    V<super::neon::One>,
    core::arch::aarch64::float64x2_t,
    8,
    8,
    4,
    W<V<core::arch::aarch64::float64x2_t>, 2>
);
level!(
    #[cfg(target_arch = "x86_64")]
    pub(crate) Avx2 in avx2,
    V<super::avx2::One>,
    core::arch::x86_64::__m256d,
    6,
    6,
    2,
    V<core::arch::x86_64::__m256d>,
    "avx2,fma"
);
level!(
    #[cfg(target_arch = "x86_64")]
    pub(crate) Avx512 in avx512,
    V<super::avx2::One>,
    core::arch::x86_64::__m512d,
    8,
    4,
    1,
    V<core::arch::x86_64::__m256d>,
    "avx512f,avx512dq,avx512cd,avx512bw,avx512vl,avx2,fma"
);

//! Operations of a register of numbers, from which every pack is built.
//!
//! Input: nothing. Output: [`Register`], and [`intrinsics!`] for its functions. Invariant:
//! lane by lane each function gives the bits of the same operation on `f64`, but for
//! [`Register::fma`], which rounds once where `FUSED`.

use core::fmt::Debug;

use hamiltonian_real::parts::{Rare, Word};

/// A register of `f64` lanes and the flags of its comparisons.
pub trait Register: Copy + Send + Sync + 'static {
    /// One flag a lane.
    type Flags: Copy + Send + Sync + 'static;
    /// The lanes in memory.
    type Array: Copy
        + Debug
        + Default
        + PartialEq
        + AsRef<[f64]>
        + AsMut<[f64]>
        + for<'a> TryFrom<&'a [f64]>;
    /// The number of lanes.
    const LANES: u32;
    /// True if [`fma`](Self::fma) rounds once.
    const FUSED: bool;

    fn splat(value: f64) -> Self;
    fn load(lanes: &Self::Array) -> Self;
    fn store(a: Self) -> Self::Array;

    fn add(a: Self, b: Self) -> Self;
    fn sub(a: Self, b: Self) -> Self;
    fn mul(a: Self, b: Self) -> Self;
    fn div(a: Self, b: Self) -> Self;
    /// `a·b + c`, rounded once where `FUSED`, else twice.
    fn fma(a: Self, b: Self, c: Self) -> Self;
    fn sqrt(a: Self) -> Self;

    /// The bits of both.
    fn and(a: Self, b: Self) -> Self;
    /// The bits of either.
    fn or(a: Self, b: Self) -> Self;
    /// The bits of one of them alone.
    fn xor(a: Self, b: Self) -> Self;
    /// The sum of the bits as integers, modulo 2⁶⁴.
    fn plus(a: Self, b: Self) -> Self;
    /// The difference of the bits as integers, modulo 2⁶⁴.
    fn minus(a: Self, b: Self) -> Self;
    /// The bits moved up by `K < 64`.
    fn shl<const K: u32>(a: Self) -> Self;
    /// The bits moved down by `K < 64`.
    fn shr<const K: u32>(a: Self) -> Self;
    /// The lanes whose lowest bit is set.
    fn odd(a: Self) -> Self::Flags;
    /// [`Word::scaled`](hamiltonian_real::parts::Word::scaled), where there is an instruction for it.
    #[inline(always)]
    fn scaled(_a: Self, _k: Self) -> Option<Self> {
        None
    }

    fn lt(a: Self, b: Self) -> Self::Flags;
    fn le(a: Self, b: Self) -> Self::Flags;
    fn equals(a: Self, b: Self) -> Self::Flags;
    fn select(flags: Self::Flags, yes: Self, no: Self) -> Self;
    /// [`Real::replaced`](hamiltonian_real::Real::replaced).
    #[inline(always)]
    fn replaced(flags: Self::Flags, new: Self, old: Self) -> Self {
        Self::select(flags, new, old)
    }

    fn flags(flag: bool) -> Self::Flags;
    fn both_flags(a: Self::Flags, b: Self::Flags) -> Self::Flags;
    fn either_flag(a: Self::Flags, b: Self::Flags) -> Self::Flags;
    fn not(a: Self::Flags) -> Self::Flags;
    /// Bit k is the flag of lane k; the bits above the last lane are 0.
    fn bits(a: Self::Flags) -> u32;

    /// Calls `f()` out of line, compiled with the instructions of the register.
    fn out_of_line<A>(f: impl FnOnce() -> A) -> A;
    /// `F::of` of each, likewise. `F` has no closure, which would be compiled without those instructions.
    fn rare<F: Rare<N, M>, W: Word, const N: usize, const M: usize, const K: usize>(
        x: &[[W; N]; K],
        values: &mut [[W; M]; K],
    );

    /// The columns of the table's rows that are numbered by the last ten bits of each lane.
    #[inline(always)]
    fn rows(bits: Self, table: &[[f64; 4]; 1024]) -> [Self; 4] {
        let bits = Self::store(bits);
        let mut columns = [Self::Array::default(); 4];
        let mut k = 0;
        while k < Self::LANES as usize {
            let row = &table[bits.as_ref()[k].to_bits() as usize & 1023];
            columns[0].as_mut()[k] = row[0];
            columns[1].as_mut()[k] = row[1];
            columns[2].as_mut()[k] = row[2];
            columns[3].as_mut()[k] = row[3];
            k += 1;
        }
        [
            Self::load(&columns[0]),
            Self::load(&columns[1]),
            Self::load(&columns[2]),
            Self::load(&columns[3]),
        ]
    }
}

/// Aligns the stack of the function that it is inlined into for registers of type `R`: LLVM stores registers that it runs
/// out of there, and aligns them only if a local variable is aligned so. A 512-bit register that is not crosses a cache
/// line.
#[inline(always)]
pub(super) fn align_stack<R>() {
    core::hint::black_box(&mut core::mem::MaybeUninit::<R>::uninit());
}

/// [`Register::out_of_line`] with these features.
macro_rules! out_of_line {
    ($($features:literal)?) => {
        #[inline(always)]
        fn out_of_line<A>(f: impl FnOnce() -> A) -> A {
            // As in `Level::enter`: `inline(never)` holds for functions without features alone.
            #[inline(never)]
            fn entry<R, A>(f: impl FnOnce() -> A) -> A {
                $(#[target_feature(enable = $features)])?
                fn inside<R, A>(f: impl FnOnce() -> A) -> A {
                    crate::level::register::align_stack::<R>();
                    f()
                }
                // SAFETY: `inside` asks for features of the level that names the register, and that
                // level is entered only on a CPU that has them (see the module).
                #[allow(unused_unsafe)]
                unsafe {
                    inside::<R, A>(f)
                }
            }
            entry::<Self, A>(f)
        }
        #[inline(always)]
        fn rare<F, W, const N: usize, const M: usize, const K: usize>(
            x: &[[W; N]; K],
            values: &mut [[W; M]; K],
        ) where
            F: hamiltonian_real::parts::Rare<N, M>,
            W: hamiltonian_real::parts::Word,
        {
            $(#[target_feature(enable = $features)])?
            #[cold]
            #[inline(never)]
            fn entry<F, W, const N: usize, const M: usize, const K: usize>(
                x: &[[W; N]; K],
                values: &mut [[W; M]; K],
            ) where
                F: hamiltonian_real::parts::Rare<N, M>,
                W: hamiltonian_real::parts::Word,
            {
                for (x, values) in x.iter().zip(values) {
                    *values = F::of(*x);
                }
            }
            // SAFETY: as in `out_of_line`.
            #[allow(unused_unsafe)]
            unsafe {
                entry::<F, W, N, M, K>(x, values)
            }
        }
    };
}
pub(super) use out_of_line;

/// Functions of a register whose bodies are intrinsics, written as ordinary functions.
#[allow(unused_macros)]
macro_rules! intrinsics {
    ($(fn $name:ident$(<const $K:ident: u32>)?($($argument:ident: $type:ty),*) -> $result:ty { $($body:tt)* })*) => {
        $(
            #[inline(always)]
            fn $name$(<const $K: u32>)?($($argument: $type),*) -> $result {
                // SAFETY: the instructions are of the level that names the register, and that level
                // is entered only on a CPU that has them (see the module). Memory is read and
                // written through arrays of as many numbers as the register has, by instructions
                // that take any alignment.
                #[allow(unused_unsafe)]
                unsafe { $($body)* }
            }
        )*
    };
}
#[allow(unused_imports)]
pub(super) use intrinsics;

//! CPU levels as types, entered by run-time dispatch, with their packs: the one module with unsafe
//! code.
//!
//! Input: a [`Kernel`], written once for every level. Output: its result, computed in the registers
//! of the best level that this CPU has. Invariant: the instructions of a level run only where
//! [`Cpu::best`] has found the CPU to have them.
//!
//! # Why this is sound
//! A register type (such as `__m512d`) does its arithmetic by instructions that only some CPUs
//! have; to run them on another is undefined behaviour. The functions of [`Register`] are
//! nevertheless safe to call, because no code can name a register type before the CPU was queried:
//!
//! - [`Register`], the register types behind packs, and the types that implement [`Level`] are in
//!   private modules and no signature of this crate gives one of them away: outside, a pack is
//!   always `L::Pack`, `L::Wide` or `L::Scalar` of some `L: Level`, and [`Level`] is sealed. Levels that not every CPU has
//!   are visible in this crate only, so that rustc rejects a public signature with one of them.
//! - [`AtHand`] is the level that each CPU of the architecture has.
//! - Any other `L` is chosen in one place, [`dispatch_at_most`], from the capabilities found in the CPU.
//!   rustc compiles generic code over a level for every level, and only the chosen one runs.
//! - Values that a kernel returns (a boxed pack, a pointer to one of its functions) stay in this
//!   process, on this CPU.
//!
//! Every `unsafe` block of this module names its part of that argument.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod dispatch;
#[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
mod neon;
#[deny(unsafe_code)]
mod pack;
mod portable;
mod register;
#[cfg(target_arch = "x86_64")]
mod sse2;

pub use dispatch::{AtHand, Cpu, Kernel, Level, dispatch, dispatch_at_most};
pub use pack::{Base, Called, Nf, W};

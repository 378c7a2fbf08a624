//! How a run is computed: lanes, fused products, threads.
//!
//! Input: a run. Output: the run, whose prepared system and map have the new arithmetic.

#[cfg(feature = "rayon")]
use super::threads::Threads;
use super::{Integrator, MapOf};
#[cfg(feature = "rayon")]
use crate::flows::map::Map;
use crate::flows::map::Step;
use crate::systems::system::{Arithmetic, Dynamics, System};
use hamiltonian_lanes::Real;

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// Turns computation in lanes off, or on again. It is on by default; turn it off to measure what lanes save.
    ///
    /// A lane is one number of a CPU register that holds several. In lanes, several stages of implicit schemes and
    /// iterations of loops over arrays are computed at a time; systems written by hand stay scalar. The bits are the
    /// same, unless the run is [`fused`](Integrator::fused).
    ///
    /// ```
    #[doc = include_str!("../../doc/oscillator.md")]
    ///
    /// let run = |lanes| {
    ///     let start = State::new([1.0], [0.0]);
    ///     let mut run = Integrator::new(&Oscillator {}, Gauss::<8>::default(), start, 0.5)?.with_lanes(lanes);
    ///     run.advance(100).cloned()
    /// };
    /// assert_eq!(run(true)?, run(false)?);
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn with_lanes(self, lanes: bool) -> Self {
        let now = self.prepared.arithmetic();
        self.computed(Arithmetic { lanes, ..now })
    }

    /// Turns on fused products in lanes, `a·b + c` rounded once. This is 20 to 50 % faster on CPUs that have them, and
    /// cannot be undone.
    ///
    /// The bits then differ from those of other CPUs and of a run without lanes. They also differ from those of an
    /// [`Ensemble`](crate::Ensemble), which fuses the products of every operation of a step, not only those of stages and
    /// loops.
    #[must_use]
    pub fn fused(self) -> Self {
        let now = self.prepared.arithmetic();
        self.computed(Arithmetic { fused: true, ..now })
    }

    /// Shares large loops of each step among threads (0 counts as 1); the default is one. The bits do not depend on the
    /// number. Use it for systems of tens of thousands of coordinates: a step that costs less than about 10 μs is not
    /// faster on several threads.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// hamiltonian! {
    ///     /// A chain of pendulums with springs.
    ///     pub struct Chain { n: usize }
    ///     H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 - cos(q[i]) + (q[(i + 1) % n] - q[i])^2/2 }
    /// }
    ///
    /// let end = |threads| {
    ///     let start = State::new(vec![0.5; 40_000], vec![0.0; 40_000]);
    ///     let system = Chain::new(40_000)?;
    ///     let mut run = Integrator::new(&system, StormerVerlet::default(), start, 0.1)?.with_threads(threads);
    ///     run.advance(10).cloned()
    /// };
    /// assert_eq!(end(1)?, end(2)?);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// In a rayon pool, the run has threads of the pool, at most this number, and starts none. If the operating system
    /// cannot start threads, the run has one. A resumed run has one until this is called again.
    ///
    /// # Loops that threads share
    /// - Loops over arrays in forces, drifts and fields, with 16384 iterations or more: rows of a lattice whose
    ///   iterations change elements of their own row alone, and chains. Polynomials of neighbours, such as
    ///   `(u[(i + 1) % n][j] - u[i][j])^2`, count as changes of the own row.
    /// - Forces of sums over the pairs of 4096 points or more, `sum(i in 0..n, j in 0..i)` or
    ///   `sum(i in 0..n, j in i + 1..n)`, if each iteration changes elements i and j alone.
    ///
    /// The rest of a step runs on one thread, for example sums over a whole array, such as energies. So do all loops
    /// without [`with_lanes`](Integrator::with_lanes), and chains with neighbours in a [`fused`](Integrator::fused) run.
    #[cfg(feature = "rayon")]
    #[must_use]
    pub fn with_threads(mut self, threads: usize) -> Self
    where
        R: Map<Work: Send> + Sync,
    {
        self.threads = Threads::new(threads);
        let now = self.prepared.arithmetic();
        let threads = self.threads.as_ref().map_or(1, Threads::number);
        self.computed(Arithmetic { threads, ..now })
    }

    /// Changes the arithmetic of the run.
    pub(crate) fn computed(mut self, arithmetic: Arithmetic) -> Self {
        self.prepared.set_arithmetic(arithmetic);
        self.map = self.recipe.prepare(&self.prepared, Step::of(self.step));
        self
    }
}

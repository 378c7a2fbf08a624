//! Processed splittings: a kernel that is repeated, and a processor around all of its steps.
//!
//! Input: a [`Split`] system, the tables of a kernel and of a processor. Output: [`Processed`].
//! Invariant: the carried value is the state before the processor, so that a step costs its kernel
//! alone; the post-processor is applied to the observed copy.

use super::splitting::{Durations, Negated, Reversed, Splitting};
use super::strang::Strang;
use super::tables::processed as tables;
use super::zigzag::{Zigzag, ZigzagOf};
use crate::flows::map::{Cause, Map, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, OneStep, Scheme};
use crate::systems::flow::{Flow, Pieces, Scratch};
use crate::systems::state::{Carried, Point, State};
use crate::systems::system::{Exact, Split, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// A kernel K between a processor π and its inverse, on pieces with exact flows:
///
/// ```text
/// Φ = π ∘ K ∘ π⁻¹,    Φⁿ = π ∘ Kⁿ ∘ π⁻¹
/// ```
///
/// A run applies π⁻¹ once at its start, then K in each step, and π to the copy of the state that an
/// observer or the caller sees. K has to satisfy only the order conditions that no change of
/// variables removes. It therefore needs fewer stages than a splitting of the same order, or has
/// smaller errors with as many. An observer of every step causes a processor in every step: observe less
/// often, by [`every`](crate::observers::every), or use a
/// [cheap post-processor](super::CheapProcessed).
///
/// Both K and π are compositions of the exact flows, so Φ preserves dq∧dp. Its adjoint is
/// π₋ₕ ∘ K* ∘ π₋ₕ⁻¹; π and π₋ₕ agree to the order of the scheme but not to the last bit, so Φ is symmetric to
/// that order only.
///
/// `K` and `P` are [`Splitting`]s; the durations of `P` sum to zero. The entry is that of the whole
/// scheme.
///
/// Source: J. C. Butcher, Lecture Notes in Mathematics 109 (1969) 133, doi:10.1007/BFb0060019; S. Blanes,
/// F. Casas, A. Murua, SIAM J. Sci. Comput. 27 (2006) 1817, doi:10.1137/030601223.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::schemes::Processed6;
///
/// let start = State::new([1.0], [0.0]);
/// let mut run = Integrator::new(&Oscillator {}, Processed6::default(), start, 0.1)?;
/// assert!((run.advance(10)?.q[0] - 1.0_f64.cos()).abs() < 1e-9);
/// // What is carried is another point: the kernel's.
/// assert!((run.carried().q[0] - 1.0_f64.cos()).abs() > 1e-6);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Processed<K, P> {
    /// The step that is repeated.
    kernel: K,
    /// π.
    processor: P,
}

impl<K, P> Processed<K, P> {
    /// Returns the scheme that repeats the step of `kernel` between `processor` and its inverse.
    #[must_use]
    pub fn new(kernel: K, processor: P) -> Self {
        Processed { kernel, processor }
    }

    /// The step that is repeated.
    #[must_use]
    pub fn kernel(&self) -> &K {
        &self.kernel
    }

    /// π.
    #[must_use]
    pub fn processor(&self) -> &P {
        &self.processor
    }
}

impl<K: Splitting, P: Splitting> Listed for Processed<K, P> {
    fn entry(&self) -> Entry {
        self.processor.entry()
    }
}

impl<K: Splitting + PartialEq, P: Splitting + PartialEq> OneStep for Processed<K, P> {
    type Adjoint = Processed<Reversed<K>, Negated<P>>;
    fn adjoint(&self) -> Self::Adjoint {
        Processed {
            kernel: Reversed(self.kernel),
            processor: Negated(self.processor),
        }
    }
}

impl<S, K, P> Scheme<S> for Processed<K, P>
where
    S: Split + Exact,
    K: Splitting,
    P: Splitting,
{
    type Carried = Point<S::Shape>;
    type Map<T: Real> = ProcessedMap<
        Point<VectorOf<S, T>>,
        <S::Pieces<T> as Pieces<T, S::Prepared<T>>>::Outer,
        <S::Pieces<T> as Pieces<T, S::Prepared<T>>>::Inner,
        K,
        P,
        ZigzagOf<T, S, S::Pieces<T>, P>,
    >;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let whole = Step::of(step.h);
        let post_processor = Zigzag::new(&self.processor, &S::pieces::<T>(), prepared, whole);
        ProcessedMap::new(self, post_processor, &S::pieces::<T>(), prepared, step)
    }
    /// Processors of different steps do not cancel.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn prepare_after<T: Real>(
        &self,
        before: &Self,
        prepared: &S::Prepared<T>,
        step: Step<T>,
    ) -> Option<Self::Map<T>>
    where
        Self: OneStep,
    {
        let joins = self == before && step.h.equals(step.before).all();
        joins.then(|| Scheme::<S>::prepare(self, prepared, step))
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Point<VectorOf<S, T>> {
        state.point()
    }
}

/// The map from the kernel's state to the observed one, at one time.
pub trait PostProcessor<X: Carried, W> {
    /// Scratch besides that of the kernel.
    type Work: Scratch<X>;
    /// Makes the observed state.
    fn post_process(&self, t: X::Scalar, z: &mut X, work: &mut (W, Self::Work));
    /// Repeats what led to a state that is not finite, and returns the cause.
    fn blame(&self, t: X::Scalar, z: &mut X, work: &mut (W, Self::Work)) -> Cause;
}

/// π itself.
impl<X: Carried, O: Flow<X>, I: Flow<X>, P: Splitting> PostProcessor<X, (O::Work, I::Work)>
    for Zigzag<X, O, I, P>
{
    type Work = ();

    #[cfg_attr(not(unoptimised), inline(always))]
    fn post_process(&self, t: X::Scalar, z: &mut X, (work, ()): &mut ((O::Work, I::Work), ())) {
        self.step(t, t, z, work);
    }

    #[cold]
    fn blame(&self, t: X::Scalar, z: &mut X, (work, ()): &mut ((O::Work, I::Work), ())) -> Cause {
        self.explain(t, t, true, z, work)
    }
}

/// The map of a processed scheme whose post-processor is `C`.
#[derive(Debug)]
pub struct ProcessedMap<X: Vector, O, I, K: Splitting, P: Splitting, C> {
    /// π⁻¹.
    unprocessor: Zigzag<X, O, I, Reversed<Negated<P>>>,
    kernel: Zigzag<X, O, I, K>,
    post_processor: C,
}

impl<X: Vector, O: Flow<X>, I: Flow<X>, K: Splitting, P: Splitting, C>
    ProcessedMap<X, O, I, K, P, C>
{
    /// Folds the tables into the flows.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn new<D, Q>(
        scheme: &Processed<K, P>,
        post_processor: C,
        pieces: &Q,
        prepared: &D,
        step: Step<X::Scalar>,
    ) -> Self
    where
        Q: Pieces<X::Scalar, D, Point = X, Outer = O, Inner = I>,
    {
        let unprocessing = Reversed(Negated(scheme.processor));
        ProcessedMap {
            unprocessor: Zigzag::new(&unprocessing, pieces, prepared, Step::of(step.h)),
            kernel: Zigzag::new(&scheme.kernel, pieces, prepared, step),
            post_processor,
        }
    }
}

/// A processor at one time, to which its clock returns, because the durations sum to zero.
///
/// It is long and rare, so it is compiled once, apart from the loop over steps. Its point is moved
/// there and back, so that the point of the loop stays in registers.
#[cfg_attr(not(unoptimised), inline(always))]
fn apart<X: Carried>(z: &mut X, processor: impl FnOnce(&mut X)) {
    let mut moved = z.take();
    X::Scalar::out_of_line(
        #[cfg_attr(not(unoptimised), inline(always))]
        || processor(&mut moved),
    );
    *z = moved;
}

impl<X, O, I, K, P, C> Map for ProcessedMap<X, O, I, K, P, C>
where
    X: Carried,
    O: Flow<X>,
    I: Flow<X>,
    K: Splitting,
    P: Splitting,
    C: PostProcessor<X, (O::Work, I::Work)>,
{
    type Carried = X;
    /// The scratch of the kernel, which the processors share, and more of the post-processor.
    type Work = ((O::Work, I::Work), C::Work);

    #[cfg_attr(not(unoptimised), inline(always))]
    fn open(&self, t: X::Scalar, z: &mut X, work: &mut Self::Work) {
        apart(
            z,
            #[cfg_attr(not(unoptimised), inline(always))]
            |moved| self.unprocessor.step(t, t, moved, &mut work.0),
        );
        self.kernel.open(t, z, &mut work.0);
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn body(&self, t: X::Scalar, end: X::Scalar, z: &mut X, work: &mut Self::Work) {
        self.kernel.body(t, end, z, &mut work.0);
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn close(&self, t: X::Scalar, z: &mut X, work: &mut Self::Work) {
        self.kernel.close(t, z, &mut work.0);
        apart(
            z,
            #[cfg_attr(not(unoptimised), inline(always))]
            |moved| self.post_processor.post_process(t, moved, work),
        );
    }

    #[cfg_attr(not(unoptimised), inline(always))]
    fn join(&self, t: X::Scalar, z: &mut X, work: &mut Self::Work) {
        self.kernel.join(t, z, &mut work.0);
    }

    #[cold]
    fn explain(
        &self,
        t: X::Scalar,
        end: X::Scalar,
        first: bool,
        z: &mut X,
        work: &mut Self::Work,
    ) -> Cause {
        if first {
            let cause = self.unprocessor.explain(t, t, true, z, &mut work.0);
            if !z.is_finite() {
                return cause;
            }
        }
        // This closes the kernel too.
        let cause = self.kernel.explain(t, end, first, z, &mut work.0);
        if !z.is_finite() {
            return cause;
        }
        self.post_processor.blame(end, z, work)
    }
}

/// The table `$part` of a processed one as a type.
macro_rules! weights {
    ($(#[$doc:meta])* $name:ident: $table:path, $part:ident, $stages:literal, $scheme:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
        pub struct $name;

        impl Listed for $name {
            fn entry(&self) -> Entry {
                Entry {
                    name: stringify!($scheme),
                    variant: "",
                    equations: "",
                    order: $table.order,
                    duration: 1,
                    needs: Needs::SPLIT.and(Needs::EXACT),
                    preserves: Form::OnePoint,
                    source: $table.source,
                }
            }
        }

        impl Splitting for $name {
            type Of<U> = [U; $stages];
            #[cfg_attr(not(unoptimised), inline(always))]
            fn stages(&self) -> [Durations; $stages] {
                $table.$part
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn filled<U: Clone>(&self, value: U) -> [U; $stages] {
                core::array::from_fn(|_| value.clone())
            }
        }
    };
}

pub(super) use weights;

/// The kernel `$kernel` and the processor `$processor` of a table, and the scheme `$scheme` of the two.
macro_rules! processed {
    ($($(#[$doc:meta])* $scheme:ident: $table:path, $kernel:ident $kernel_stages:literal,
       $processor:ident $stages:literal;)+) => {$(
        weights! {
            #[doc = concat!("The kernel of [`", stringify!($scheme), "`]: not a scheme of its order by itself.")]
            $kernel: $table, kernel, $kernel_stages, $scheme
        }
        processed! { @with_kernel $(#[$doc])* $scheme: $table, $kernel, $processor $stages }
    )+};
    (@with_kernel $(#[$doc:meta])* $scheme:ident: $table:path, $kernel:ident, $processor:ident $stages:literal) => {
        weights! {
            #[doc = concat!("The processor of [`", stringify!($scheme), "`].")]
            $processor: $table, processor, $stages, $scheme
        }

        $(#[$doc])*
        ///
        /// Preserves dq∧dp.
        ///
        /// ```
        #[doc = include_str!("../doc/oscillator.md")]
        #[doc = concat!("use hamiltonian::schemes::", stringify!($scheme), ";")]
        ///
        /// let start = State::new([1.0], [0.0]);
        #[doc = concat!("let mut run = Integrator::new(&Oscillator {}, ", stringify!($scheme), "::default(), start, 0.05)?;")]
        /// assert!((run.advance(20)?.q[0] - 1.0_f64.cos()).abs() < 1e-4);
        /// # Ok::<(), Error>(())
        /// ```
        pub type $scheme = Processed<$kernel, $processor>;
    };
}

macro_rules! corrected {
    ($($(#[$doc:meta])* $scheme:ident: $table:path, $processor:ident $stages:literal;)+) => {$(
        processed! { @with_kernel
            $(#[$doc])*
            ///
            /// Strang's splitting of H = A + εB with a small ε, A the first piece of `split { A = …; B = …; }`,
            /// and as processor Wisdom's corrector, which removes the errors linear in ε up to its order. A
            /// step costs one flow of A and one of B, as [`Strang`]'s does. Without a small piece it is a
            /// scheme of order 2.
            ///
            /// Source: J. Wisdom, M. Holman, Astron. J. 102 (1991) 1528, doi:10.1086/115978; J. Wisdom, Astron.
            /// J. 131 (2006) 2294, doi:10.1086/500829; H. Rein, D. Tamayo, G. Brown, Mon. Not. R. Astron. Soc.
            /// 489 (2019) 4632, doi:10.1093/mnras/stz2503.
            $scheme: $table, Strang, $processor $stages
        }
    )+};
}

processed! {
    /// A processed splitting: order 4 with 5 stages.
    ///
    /// Source: the kernel with the least error modulo conjugation that a search found, by the conditions of S.
    /// Blanes, F. Casas, A. Murua, SIAM J. Sci. Comput. 27 (2006) 1817, doi:10.1137/030601223.
    Processed4: tables::PROCESSED_4, Kernel4 5, Processor4 12;
    /// A processed splitting: order 6 with 8 stages.
    ///
    /// Source: the kernel with the least error modulo conjugation that a search found, by the conditions of S.
    /// Blanes, F. Casas, A. Murua, SIAM J. Sci. Comput. 27 (2006) 1817, doi:10.1137/030601223.
    Processed6: tables::PROCESSED_6, Kernel6 8, Processor6 24;
    /// Blanes, Casas and Murua's processed composition: order 8 with 13 stages.
    ///
    /// Source: S. Blanes, F. Casas, A. Murua, SIAM J. Sci. Comput. 27 (2006) 1817, doi:10.1137/030601223.
    BlanesCasasMurua8: tables::BLANES_CASAS_MURUA_8, BlanesCasasMurua8Kernel 13, BlanesCasasMurua8Processor 20;
}

corrected! {
    /// Wisdom and Holman's map with a corrector of order 3: error O(εh⁴ + ε²h²).
    WisdomHolman3: tables::WISDOM_HOLMAN_3, Corrector3 2;
    /// Wisdom and Holman's map with a corrector of order 5: error O(εh⁶ + ε²h²).
    WisdomHolman5: tables::WISDOM_HOLMAN_5, Corrector5 4;
    /// Wisdom and Holman's map with a corrector of order 7: error O(εh⁸ + ε²h²).
    WisdomHolman7: tables::WISDOM_HOLMAN_7, Corrector7 6;
    /// Wisdom and Holman's map with a corrector of order 11: error O(εh¹² + ε²h²).
    WisdomHolman11: tables::WISDOM_HOLMAN_11, Corrector11 10;
    /// Wisdom and Holman's map with a corrector of order 17: error O(εh¹⁸ + ε²h²).
    WisdomHolman17: tables::WISDOM_HOLMAN_17, Corrector17 16;
}

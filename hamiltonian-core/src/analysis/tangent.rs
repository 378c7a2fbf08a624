//! The derivative of the numerical map along an orbit, and quantities computed from it.
//!
//! Input: a system, a scheme, a start and a step. Output: [`Tangent`], the run with deviations from it;
//! Lyapunov exponents, [`megno()`], alignment indices, [`monodromy`] matrices. Invariants: deviations are exact
//! derivatives of the scheme's map (runs over [`Dual`]s), not solutions of other equations; taking
//! other deviations of the same span changes no bit of the orbit.

mod eigenvalues;
mod megno;

use crate::errors::{Error, StartError};
use crate::flows::map::Map;
use crate::runs::integrator::{Integrator, MapOf};
use crate::schemes::scheme::{CarriedBy, Scheme};
use crate::systems::state::State;
use crate::systems::system::{System, VectorOf, derivatives_are_free};
use crate::systems::vector::Vector;
use alloc::vec::Vec;
use hamiltonian_lanes::{Dual, Real};
use nalgebra::DMatrix;

pub(crate) use megno::Megno;

/// A run with deviations from its orbit: solutions of the linearised map along it.
///
/// A deviation is a derivative of the state with respect to its start in some direction. Each belongs to
/// a run over dual numbers, so it is the exact derivative of the numerical map, also of an implicit scheme. The
/// derivative of a symplectic scheme is a symplectic matrix. Each deviation costs about as much as three runs.
///
/// Deviations are the columns of [`matrix`](Tangent::matrix); its rows are the coordinates, then the
/// momenta, as they are stored. At the start, the deviations are the first unit vectors.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = State::new([1.0], [0.0]);
/// let mut tangent = Tangent::new(&Oscillator {}, RungeKutta4, start, 0.01, 2)?;
/// tangent.advance(100)?;
/// // A rotation by the angle t = 1.
/// let matrix = tangent.matrix();
/// assert!((matrix[(0, 1)] - 1f64.sin()).abs() < 1e-9);
/// assert!(symplectic_defect(&matrix) < 1e-9);
/// # Ok::<(), Error>(())
/// ```
pub struct Tangent<T: Real, S: System, R: MapOf<Dual<T>, S>> {
    /// The runs, one for each deviation; their values are those of the first.
    runs: Vec<Integrator<Dual<T>, S, R>>,
}

impl<T: Real, S: System, R: MapOf<Dual<T>, S>> Tangent<T, S, R> {
    /// Creates a run of `scheme` on `system` from `start` with the step size `step`, with `deviations` deviations.
    /// The whole derivative of the map needs as many as there are coordinates and momenta.
    ///
    /// # Errors
    /// Those of [`Integrator::new`]; [`StartError::Deviations`] for no deviation, or more than there are
    /// coordinates and momenta.
    pub fn new<M>(
        system: &S,
        scheme: M,
        start: State<VectorOf<S, T>>,
        step: T,
        deviations: usize,
    ) -> Result<Self, Error>
    where
        M: Scheme<S, Map<Dual<T>> = R>,
        R: Map<Carried = CarriedBy<M, S, Dual<T>>>,
    {
        let lifted = lifted::<T, S>(system, &start)?;
        check_deviations(deviations, lifted.q.len())?;
        let run = |deviation: usize| {
            let start = towards(&lifted, deviation);
            Integrator::new(system, scheme.clone(), start, Dual::fixed(step))
        };
        let runs = (0..deviations).map(run).collect::<Result<_, Error>>()?;
        Ok(Tangent { runs })
    }

    /// Makes `n` steps.
    ///
    /// # Errors
    /// Those of [`Integrator::advance`]. A deviation that overflows is
    /// [`StepError::NotFinite`](crate::errors::StepError::NotFinite): call
    /// [`orthonormalise`](Tangent::orthonormalise) more often.
    pub fn advance(&mut self, n: u64) -> Result<(), Error> {
        self.runs
            .iter_mut()
            .try_for_each(|run| run.advance(n).map(|_| ()))
    }

    /// The number of steps made.
    pub fn steps(&self) -> u64 {
        self.runs.first().map_or(0, Integrator::steps)
    }

    /// The current time.
    pub fn time(&self) -> T {
        self.runs.first().map_or(T::zero(), |run| run.time().re)
    }

    /// The current state; derivative parts are those of the first deviation.
    pub fn state(&self) -> &State<VectorOf<S, Dual<T>>> {
        self.runs[0].state()
    }

    /// The deviations, one a column: coordinates, then momenta.
    pub fn matrix(&self) -> DMatrix<T> {
        let mut matrix =
            DMatrix::from_element(2 * self.state().q.len(), self.runs.len(), T::zero());
        for (mut column, run) in matrix.column_iter_mut().zip(&self.runs) {
            let State { q, p, .. } = run.state();
            for (to, from) in column.iter_mut().zip(q.components().chain(p.components())) {
                *to = from.eps;
            }
        }
        matrix
    }

    /// Replaces the deviations by orthonormal ones of the same span, column by column. The orbit does not change.
    /// Returns the length of the part of each that is orthogonal to those before: the diagonal of R in QR.
    pub fn orthonormalise(&mut self) -> Vec<T> {
        let mut matrix = self.matrix();
        let mut lengths = alloc::vec![T::zero(); self.runs.len()];
        gram_schmidt(matrix.as_mut_slice(), &mut lengths, true, self);
        self.show();
        lengths
    }

    /// Scales every deviation to the length 1. Returns the lengths before.
    pub fn normalise(&mut self) -> Vec<T> {
        let mut matrix = self.matrix();
        let mut lengths = alloc::vec![T::zero(); self.runs.len()];
        gram_schmidt(matrix.as_mut_slice(), &mut lengths, false, self);
        self.show();
        lengths
    }

    /// Makes `steps` steps and returns the Lyapunov exponents over them, one for each deviation.
    ///
    /// The deviations are made orthonormal after each `every` steps. This must be so often that they neither
    /// overflow nor align, for example once in each unit of time.
    ///
    /// The results are mean rates of growth over these steps, in the order of the deviations. The sum of the first
    /// k is the rate of growth of the volume of the first k deviations; further deviations change none of them. With
    /// the number of steps they tend to the exponents, the greatest first. Rates that differ by less than the error
    /// of the mean, such as those of a regular orbit, may come in another order.
    ///
    /// Source: V. I. Oseledets, Trans. Moscow Math. Soc. 19 (1968) 197; G. Benettin, L. Galgani,
    /// A. Giorgilli, J.-M. Strelcyn, Meccanica 15 (1980) 9, doi:10.1007/BF02128236; I. Shimada,
    /// T. Nagashima, Prog. Theor. Phys. 61 (1979) 1605, doi:10.1143/PTP.61.1605.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let mut tangent = Tangent::new(&Oscillator {}, RungeKutta4, State::new([1.0], [0.0]), 0.1, 2)?;
    /// // Neighbours of an oscillator stay where they are.
    /// assert!(tangent.lyapunov(1_000, 10)?.iter().all(|rate| rate.abs() < 1e-5));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`StartError::NoSteps`] for 0 steps; those of [`advance`](Tangent::advance).
    pub fn lyapunov(&mut self, steps: u64, every: u64) -> Result<Vec<T>, Error> {
        let mut sums = alloc::vec![T::zero(); self.runs.len()];
        let begin = self.time();
        self.grow(steps, every, |_, lengths| {
            for (sum, length) in sums.iter_mut().zip(lengths) {
                *sum += length.ln();
            }
        })?;
        let time = self.time() - begin;
        Ok(sums.into_iter().map(|sum| sum / time).collect())
    }

    /// Makes steps, and orthonormalises the deviations after each stretch of them; `see` receives
    /// the first and last step of the stretch, counted from the first call, and the length of each
    /// deviation.
    fn grow(
        &mut self,
        steps: u64,
        every: u64,
        mut see: impl FnMut([u64; 2], &[T]),
    ) -> Result<(), Error> {
        if steps == 0 {
            return Err(StartError::NoSteps.into());
        }
        let mut made = 0;
        self.orthonormalise();
        while made < steps {
            let n = every.clamp(1, steps - made);
            self.advance(n)?;
            see([made, made + n], &self.orthonormalise());
            made += n;
        }
        Ok(())
    }

    /// GALI of all k deviations: the volume of the parallelepiped of their directions, between 0 and 1.
    /// On a chaotic orbit it falls like exp(−Σ(λ₁ − λᵢ)t). On a regular orbit it stays away from 0, for k up to
    /// the number of degrees of freedom. [`normalise`](Tangent::normalise) prevents an overflow of the deviations;
    /// [`orthonormalise`](Tangent::orthonormalise) would make GALI 1.
    ///
    /// Source: C. Skokos, T. Bountis, C. Antonopoulos, Physica D 231 (2007) 30, eq. 6,
    /// doi:10.1016/j.physd.2007.04.004.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let mut tangent = Tangent::new(&Oscillator {}, RungeKutta4, State::new([1.0], [0.0]), 0.01, 2)?;
    /// tangent.advance(100)?;
    /// assert!((tangent.gali() - 1.0).abs() < 1e-9);
    /// assert!((tangent.sali() - 2f64.sqrt()).abs() < 1e-9);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn gali(&self) -> T {
        volume(self.matrix().as_mut_slice(), self.runs.len())
    }

    /// SALI of the first two deviations, the smaller of |v̂₁ + v̂₂| and |v̂₁ − v̂₂|, between 0 and √2; GALI of
    /// the two is half the product of both (C. Skokos, J. Phys. A 34 (2001) 10029,
    /// doi:10.1088/0305-4470/34/47/309). With one deviation it is 0.
    pub fn sali(&self) -> T {
        let matrix = self.directions();
        let other = matrix.ncols().min(2) - 1;
        let length = |sign: f64| {
            let (first, second) = (matrix.column(0), matrix.column(other));
            let sum = first
                .iter()
                .zip(second.iter())
                .fold(T::zero(), |sum, (a, b)| {
                    let d = T::constant(sign, 0.0).fma(*b, *a);
                    d.fma(d, sum)
                });
            sum.sqrt()
        };
        length(1.0).min(length(-1.0))
    }

    /// The deviations with length 1.
    fn directions(&self) -> DMatrix<T> {
        let mut matrix = self.matrix();
        let mut lengths = alloc::vec![T::zero(); self.runs.len()];
        gram_schmidt(matrix.as_mut_slice(), &mut lengths, false, &mut ());
        matrix
    }

    /// Updates the observed states. All values are made those of the first run: solutions of
    /// implicit steps beside different deviations differ by rounding errors.
    fn show(&mut self) {
        let Some((first, others)) = self.runs.split_first_mut() else {
            return;
        };
        first.show_carried();
        for run in others {
            for index in 0..run.carried.len() {
                run.carried.component_mut(index).re = first.carried.component(index).re;
            }
            run.show_carried();
        }
    }
}

/// The whole carried value changes: its derivative parts are linear in the deviation.
impl<T: Real, S: System, R: MapOf<Dual<T>, S>> Columns<T> for Tangent<T, S, R> {
    fn combine(&mut self, to: usize, scale: T, less: Option<(usize, T)>) {
        let (before, run) = self.runs.split_at_mut(to);
        let carried = &mut run[0].carried;
        for index in 0..carried.len() {
            let component = carried.component_mut(index);
            component.eps *= scale;
            if let Some((from, along)) = less {
                component.eps -= along * before[from].carried.component(index).eps;
            }
        }
    }
}

/// A state without deviation.
pub(crate) fn lifted<T: Real, S: System>(
    system: &S,
    start: &State<VectorOf<S, T>>,
) -> Result<State<VectorOf<S, Dual<T>>>, Error> {
    derivatives_are_free::<T, S>();
    system.check_shape(start)?;
    let zeros = || system.zeros::<Dual<T>>();
    let mut lifted = State {
        t: Dual::fixed(start.t),
        q: zeros(),
        p: zeros(),
    };
    for (to, from) in [(&mut lifted.q, &start.q), (&mut lifted.p, &start.p)] {
        for index in 0..from.len() {
            *to.component_mut(index) = Dual::fixed(from.component(index));
        }
    }
    Ok(lifted)
}

/// A state whose deviation is the unit vector `deviation`: coordinates, then momenta.
pub(crate) fn towards<T: Real, V: Vector<Scalar = Dual<T>>>(
    lifted: &State<V>,
    deviation: usize,
) -> State<V> {
    let mut start = lifted.clone();
    let n = start.q.len();
    let (of, index) = match deviation < n {
        true => (&mut start.q, deviation),
        false => (&mut start.p, deviation - n),
    };
    of.component_mut(index).eps = T::one();
    start
}

/// A state with a deviation in a direction without symmetry: its components are 1 and the fractional parts of multiples
/// of the golden ratio.
pub(crate) fn aslant<T: Real, V: Vector<Scalar = Dual<T>>>(lifted: &State<V>) -> State<V> {
    /// 2⁶⁴ divided by the golden ratio.
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    let mut start = lifted.clone();
    let mut multiple = 0_u64;
    for part in [&mut start.q, &mut start.p] {
        for index in 0..part.len() {
            multiple = multiple.wrapping_add(GOLDEN);
            let fraction = (multiple >> 11) as f64 / (1_u64 << 53) as f64;
            part.component_mut(index).eps = T::constant(1.0 + fraction, 0.0);
        }
    }
    start
}

/// Returns an error for no deviation, or for more than a state of `n` coordinates has directions.
pub(crate) fn check_deviations(deviations: usize, n: usize) -> Result<(), StartError> {
    match deviations == 0 || deviations > 2 * n {
        false => Ok(()),
        true => Err(StartError::Deviations {
            most: 2 * n,
            found: deviations,
        }),
    }
}

/// Deviations that change as the columns of a matrix do.
pub(crate) trait Columns<T> {
    /// Deviation `to` becomes `scale` times itself, minus a multiple of an earlier one.
    fn combine(&mut self, to: usize, scale: T, less: Option<(usize, T)>);
}

/// The matrix alone.
impl<T> Columns<T> for () {
    fn combine(&mut self, _: usize, _: T, _: Option<(usize, T)>) {}
}

/// The volume that the directions of some columns span.
pub(crate) fn volume<T: Real>(matrix: &mut [T], columns: usize) -> T {
    let mut lengths = alloc::vec![T::zero(); columns];
    gram_schmidt(matrix, &mut lengths, false, &mut ());
    gram_schmidt(matrix, &mut lengths, true, &mut ());
    lengths
        .into_iter()
        .fold(T::one(), |volume, length| volume * length)
}

/// Normalises columns. If `orthogonal`, first makes each orthogonal to those before it, twice, to
/// remove rounding errors. `lengths` become their lengths before the last division. The matrix
/// stands column after column, and `with` receives every change of a column.
#[cfg_attr(not(unoptimised), inline(always))]
pub(crate) fn gram_schmidt<T: Real>(
    matrix: &mut [T],
    lengths: &mut [T],
    orthogonal: bool,
    with: &mut impl Columns<T>,
) {
    let rows = matrix.len() / lengths.len().max(1);
    for (j, grown) in lengths.iter_mut().enumerate() {
        let (before, column) = matrix.split_at_mut(j * rows);
        let column = &mut column[..rows];
        let passes = if orthogonal { 2 * j } else { 0 };
        for pass in 0..passes {
            let i = pass % j;
            let other = &before[i * rows..][..rows];
            let along = dot(other, column);
            for (to, from) in column.iter_mut().zip(other) {
                *to -= along * *from;
            }
            with.combine(j, T::one(), Some((i, along)));
        }
        let length = dot(column, column).sqrt();
        let scale = length.recip();
        for to in column {
            *to *= scale;
        }
        with.combine(j, scale, None);
        *grown = length;
    }
}

/// The scalar product of two columns.
#[cfg_attr(not(unoptimised), inline(always))]
fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    let mut sum = T::zero();
    for (a, b) in a.iter().zip(b) {
        sum = a.fma(*b, sum);
    }
    sum
}

/// The derivative of the state after `time` with respect to the start, computed in `steps` steps.
///
/// For a closed orbit with the period `time` it is the monodromy matrix. Rows and columns are the coordinates, then the
/// momenta.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
/// use hamiltonian::analysis::monodromy;
/// use std::f64::consts::TAU;
///
/// let matrix = monodromy(&Oscillator {}, RungeKutta4, State::new([1.0], [0.0]), TAU, 1_000)?;
/// assert!((matrix[(0, 0)] - 1.0).abs() < 1e-9 && matrix[(0, 1)].abs() < 1e-9);
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// Those of [`Tangent::new`] and [`Tangent::advance`].
pub fn monodromy<T, S, M>(
    system: &S,
    scheme: M,
    start: State<VectorOf<S, T>>,
    time: T,
    steps: u64,
) -> Result<DMatrix<T>, Error>
where
    T: Real,
    S: System,
    M: Scheme<S>,
{
    let size = 2 * start.q.len();
    let step = time / T::constant(steps as f64, 0.0);
    let mut tangent = Tangent::new(system, scheme, start, step, size)?;
    tangent.advance(steps)?;
    Ok(tangent.matrix())
}

/// MEGNO of an orbit, the mean exponential growth of nearby orbits, over `steps` steps of the size
/// `step`. The deviation is normalised after each `every` steps, which must be so often that it
/// does not overflow.
///
/// With the number of steps, MEGNO tends to 2 on a regular orbit, or to 0 if neighbouring orbits do
/// not separate, such as those of a harmonic oscillator. On a chaotic orbit it grows like λt/2,
/// where λ is the largest Lyapunov exponent.
///
/// It is the mean Ȳ(t) of Y(t) = (2/t) ∫₀ᵗ s d ln δ(s) (P. M. Cincotta, C. Simó, Astron. Astrophys.
/// Suppl. Ser. 147 (2000) 205, doi:10.1051/aas:2000108). Time is counted in steps, as for a map,
/// and both integrals are sums over the stretches of `every` steps, by the trapezoidal rule. δ
/// begins in a direction without symmetry, the same for every orbit: on a section of symmetry, a
/// unit vector can be a direction in which neighbouring orbits do not separate.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = State::new([1.0], [0.0]);
/// let megno = megno(&Oscillator {}, RungeKutta4, start, 0.1, 10_000, 10)?;
/// assert!(megno.abs() < 0.01);
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// [`StartError::NoSteps`] for 0 steps; those of [`Tangent::new`] and [`Tangent::advance`].
pub fn megno<T, S, M>(
    system: &S,
    scheme: M,
    start: State<VectorOf<S, T>>,
    step: T,
    steps: u64,
    every: u64,
) -> Result<T, Error>
where
    T: Real,
    S: System,
    M: Scheme<S>,
{
    let start = aslant(&lifted::<T, S>(system, &start)?);
    let run = Integrator::new(system, scheme, start, Dual::fixed(step))?;
    let mut tangent = Tangent {
        runs: alloc::vec![run],
    };
    let mut megno = Megno::new();
    tangent.grow(steps, every, |stretch, lengths| {
        megno.add(stretch, lengths[0].ln());
    })?;
    Ok(Megno::mean(megno.area(), steps))
}

/// max |MᵀJM − J|, with J = (0, 1; −1, 0) for coordinates, then momenta: 0 where M is symplectic.
///
/// ```
/// use hamiltonian::nalgebra::DMatrix;
/// use hamiltonian::prelude::*;
///
/// // A shear is symplectic, a stretching is not.
/// assert_eq!(symplectic_defect(&DMatrix::from_row_slice(2, 2, &[1.0, 3.0, 0.0, 1.0])), 0.0);
/// assert_eq!(symplectic_defect(&DMatrix::from_row_slice(2, 2, &[2.0, 0.0, 0.0, 1.0])), 1.0);
/// ```
pub fn symplectic_defect<T: Real>(matrix: &DMatrix<T>) -> f64 {
    let n = matrix.nrows() / 2;
    let mut worst = 0.0_f64;
    for i in 0..matrix.ncols() {
        for j in 0..i {
            let (a, b) = (matrix.column(i), matrix.column(j));
            let area = (0..n).fold(T::zero(), |sum, k| sum + b[k] * a[n + k] - b[n + k] * a[k]);
            let expected = T::constant(f64::from(u8::from(i == j + n)), 0.0);
            worst = worst.max((area - expected).magnitude());
        }
    }
    worst
}

/// The Floquet multipliers of a closed orbit, the eigenvalues of its [`monodromy`] matrix.
///
/// In a Hamiltonian system, 1/μ and the conjugates of both are multipliers if μ is. In an autonomous system, one pair is
/// 1: that of the deviations along the orbit and across the energy. It is a double eigenvalue and has only half of the
/// digits. An orbit with a multiplier of modulus above 1 is unstable.
///
/// ```
/// use hamiltonian::analysis::multipliers;
/// use hamiltonian::nalgebra::DMatrix;
///
/// let turn = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, -1.0, 0.0]);
/// assert!(multipliers(&turn).iter().all(|mu| mu.re == 0.0 && mu.im.abs() == 1.0));
/// ```
#[inline]
pub fn multipliers(matrix: &DMatrix<f64>) -> Vec<nalgebra::Complex<f64>> {
    eigenvalues::eigenvalues(matrix)
}

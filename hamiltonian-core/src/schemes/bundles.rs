//! Stages in bundles: one after the other over a scalar, or beside each other in the lanes of a pack.
//!
//! Input: numbers of each stage. Output: [`StageLayout`], sums over stages, and the fixed-point iteration of
//! all stages. Invariant: every layout adds in the same order, so that a step has the same bits in all
//! of them where products do not fuse. The lanes of the last bundle that are left repeat its last stage.

use crate::flows::iterate::Outcome;
use crate::systems::vector::Vector;
use core::marker::PhantomData;
use hamiltonian_lanes::{Base, Cpu, Level, Mask, Pack, Real};

/// The least number of stages that lie beside each other.
pub(super) const LEAST: usize = 4;

/// The most stages of a bundle.
const MAX_STAGES: usize = 8;

/// Bundles of `WIDTH` stages beside each other.
pub(super) struct Abreast<const WIDTH: usize>;

/// The pack of a bundle.
pub(super) trait Width {
    /// Each of its registers has four lanes on AVX2.
    type Pack<L: Level>: Base;
}

impl Width for Abreast<4> {
    type Pack<L: Level> = L::Four;
}

/// In lock-step, so that one register's operations fill the latencies of the other's.
impl Width for Abreast<8> {
    type Pack<L: Level> = L::Eight;
}

/// The least level and the best that bundles of [`Beside`] are compiled for. On SSE2 they took as long as stages
/// [`Apart`]. On AVX-512 their registers are as wide as on AVX2; eight problems took between 0.95 and 1.08 times
/// as long there, fused between 0.87 and 1.17 times (Zen 4).
pub(super) const LEVELS: [Cpu; 2] = [Cpu::Neon, Cpu::Avx2];

/// How the stages of a step lie in bundles.
pub(super) trait StageLayout<T: Real> {
    /// The scalar of a bundle.
    type Bundle: Real;
    /// The stages of a bundle as numbers.
    type Few: Copy + AsRef<[T]>;
    /// The stages of a bundle.
    const WIDTH: usize;
    /// A number of each stage of a bundle; the last fills what is left.
    fn gather(values: &[T]) -> Self::Bundle;
    /// One number for all stages.
    fn splat(value: T) -> Self::Bundle;
    /// The numbers of the stages.
    fn split(bundle: Self::Bundle) -> Self::Few;
    /// True if it holds for a stage.
    fn any(mask: <Self::Bundle as Real>::Mask) -> T::Mask;
    /// The largest of the stages' sizes, none of which is NaN.
    fn largest(size: <Self::Bundle as Real>::Size) -> T::Size;
    /// `to = from`, but for the lanes of `T` where the mask is set.
    fn copy_unless<X: Vector<Scalar = Self::Bundle>>(mask: T::Mask, from: &X, to: &mut X);
}

/// Each stage in a bundle of its own.
pub(super) struct Apart;

impl<T: Real> StageLayout<T> for Apart {
    type Bundle = T;
    type Few = [T; 1];
    const WIDTH: usize = 1;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gather(values: &[T]) -> T {
        values[0]
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn splat(value: T) -> T {
        value
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn split(bundle: T) -> [T; 1] {
        [bundle]
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn any(mask: T::Mask) -> T::Mask {
        mask
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn largest(size: T::Size) -> T::Size {
        size
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn copy_unless<X: Vector<Scalar = T>>(mask: T::Mask, from: &X, to: &mut X) {
        if T::LANES == 1 {
            // Nothing is copied after all is solved.
            to.copy_from(from);
        } else {
            to.copy_where(!mask, from);
        }
    }
}

/// As many stages beside each other as the pack `P` has lanes.
pub(super) struct Beside<P, const WIDTH: usize>(PhantomData<P>);

impl<T: Real, P: Pack, const WIDTH: usize> StageLayout<T> for Beside<P, WIDTH> {
    type Bundle = T::Over<P>;
    type Few = [T; WIDTH];
    const WIDTH: usize = WIDTH;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn gather(values: &[T]) -> Self::Bundle {
        const { assert!(P::LANES as usize == WIDTH && WIDTH <= MAX_STAGES) }
        T::gather::<P>(values)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn splat(value: T) -> Self::Bundle {
        value.spread::<P>()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn split(bundle: Self::Bundle) -> [T; WIDTH] {
        let mut few = [T::default(); WIDTH];
        T::scatter::<P>(bundle, &mut few);
        few
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn any(mask: <Self::Bundle as Real>::Mask) -> T::Mask {
        T::Mask::splat(mask.any())
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn largest(size: <Self::Bundle as Real>::Size) -> T::Size {
        let mut few = [0.0; WIDTH];
        for (lane, number) in (0..).zip(&mut few) {
            *number = size.lane(lane);
        }
        let mut count = WIDTH / 2;
        while count > 0 {
            for k in 0..count {
                few[k] = larger(few[k], few[k + count]);
            }
            count /= 2;
        }
        T::Size::constant(few[0], 0.0)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn copy_unless<X: Vector<Scalar = Self::Bundle>>(_: T::Mask, from: &X, to: &mut X) {
        to.copy_from(from);
    }
}

/// The number of bundles of `S` stages.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) const fn bundles<T: Real, L: StageLayout<T>, const S: usize>() -> usize {
    S.div_ceil(L::WIDTH)
}

/// A number of each stage, in bundles; those after the last bundle are 0.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn in_bundles<T: Real, L: StageLayout<T>, const S: usize>(
    values: &[T; S],
) -> [L::Bundle; S] {
    let mut all = [L::Bundle::zero(); S];
    for (bundle, few) in all.iter_mut().zip(values.chunks(L::WIDTH)) {
        *bundle = L::gather(few);
    }
    all
}

/// Lays a matrix with a row for each stage into bundles, `[bundle][j]`; those after the last bundle stay.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn lay_in_bundles<T: Real, L: StageLayout<T>, const S: usize>(
    matrix: &[[T; S]; S],
    to: &mut [[L::Bundle; S]; S],
) {
    for (bundle, to) in to.iter_mut().enumerate().take(bundles::<T, L, S>()) {
        let first = bundle * L::WIDTH;
        for (j, to) in to.iter_mut().enumerate() {
            let mut few = [matrix[first][j]; MAX_STAGES];
            for (k, number) in few.iter_mut().enumerate().take(L::WIDTH) {
                *number = matrix[(first + k).min(S - 1)][j];
            }
            *to = L::gather(&few[..L::WIDTH]);
        }
    }
}

/// `to = by·from`, number by number.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn resize<R: Real, const S: usize>(by: R, from: &[R; S], to: &mut [R; S]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from * by;
    }
}

/// The number of stage `j`.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn number<T: Real, L: StageLayout<T>, const S: usize>(few: &[L::Few; S], j: usize) -> T {
    few[j / L::WIDTH].as_ref()[j % L::WIDTH]
}

/// The sum of four partial sums, or of as many as there are stages.
#[cfg_attr(not(unoptimised), inline(always))]
fn joined<R: Real, const S: usize>(sums: [R; 4]) -> R {
    match S {
        1 => sums[0],
        2 => sums[0] + sums[1],
        3 => (sums[0] + sums[1]) + sums[2],
        _ => (sums[0] + sums[1]) + (sums[2] + sums[3]),
    }
}

/// `Σ matrix[j]·few[j]` for a bundle: partial sums of the stages with the same remainder modulo 4, joined.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn product<T: Real, L: StageLayout<T>, const S: usize>(
    matrix: &[L::Bundle; S],
    few: &[L::Few; S],
) -> L::Bundle {
    let mut sums = [L::Bundle::zero(); 4];
    for j in 0..S.min(4) {
        sums[j] = matrix[j] * L::splat(number::<T, L, S>(few, j));
    }
    let mut first = 4;
    while first + 4 <= S {
        for (k, sum) in sums.iter_mut().enumerate() {
            let j = first + k;
            *sum = matrix[j].fma(L::splat(number::<T, L, S>(few, j)), *sum);
        }
        first += 4;
    }
    if S > 4 {
        for (k, sum) in sums.iter_mut().enumerate().take(S % 4) {
            let j = S / 4 * 4 + k;
            *sum = matrix[j].fma(L::splat(number::<T, L, S>(few, j)), *sum);
        }
    }
    joined::<_, S>(sums)
}

/// `Σ few[j]` in the same order.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn sum<T: Real, L: StageLayout<T>, const S: usize>(few: &[L::Few; S]) -> T {
    let mut sums = [T::zero(); 4];
    for j in 0..S {
        let term = number::<T, L, S>(few, j);
        sums[j % 4] = if j < 4 { term } else { sums[j % 4] + term };
    }
    joined::<_, S>(sums)
}

/// A matrix of a method times `guess`, the matrix that takes the unknowns of the step before to a guess for
/// those of this one. Both are matrices of numbers that the weights have multiplied.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn of_the_guess<T: Real, const S: usize>(
    matrix: &[[T; S]; S],
    weights: &[T; S],
    guess: &[[T; S]; S],
) -> [[T; S]; S] {
    if S == 1 {
        // One unknown is its own guess.
        return *matrix;
    }
    let mut product = [[T::zero(); S]; S];
    for (row, to) in matrix.iter().zip(&mut product) {
        for (j, to) in to.iter_mut().enumerate() {
            let mut sum = T::zero();
            for (k, guess) in guess.iter().enumerate() {
                sum += row[k] * weights[k] * guess[j];
            }
            *to = sum / weights[j];
        }
    }
    product
}

/// Number `i` of part `k` of all stages, times `N` factors of each, one after the other.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn spread<T, L, Y, const N: usize, const S: usize>(
    factors: [&[L::Bundle; S]; N],
    unknowns: &[Y; S],
    k: usize,
    i: usize,
) -> [L::Few; S]
where
    T: Real,
    L: StageLayout<T>,
    Y: Vector<Scalar = L::Bundle>,
{
    let mut few = [L::split(L::Bundle::zero()); S];
    for bundle in 0..bundles::<T, L, S>() {
        let mut number = unknowns[bundle].part(k)[i];
        for factor in factors {
            number *= factor[bundle];
        }
        few[bundle] = L::split(number);
    }
    few
}

/// Copies the unknowns of all bundles.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn copy<T, L, X, const S: usize>(from: &[X; S], to: &mut [X; S])
where
    T: Real,
    L: StageLayout<T>,
    X: Vector<Scalar = L::Bundle>,
{
    for bundle in 0..bundles::<T, L, S>() {
        to[bundle].copy_from(&from[bundle]);
    }
}

/// Lays the unknowns of each stage into bundles.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn load<T, L, Y, X, const S: usize>(from: &[Y; S], to: &mut [X; S])
where
    T: Real,
    L: StageLayout<T>,
    Y: Vector<Scalar = T>,
    X: Vector<Scalar = L::Bundle>,
{
    for bundle in 0..bundles::<T, L, S>() {
        for k in 0..Y::PARTS {
            for i in 0..from[0].part(k).len() {
                let mut few = [T::zero(); MAX_STAGES];
                for (lane, number) in few.iter_mut().enumerate() {
                    *number = from[(bundle * L::WIDTH + lane).min(S - 1)].part(k)[i];
                }
                to[bundle].part_mut(k)[i] = L::gather(&few[..L::WIDTH]);
            }
        }
    }
}

/// Takes them out again.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn store<T, L, X, Y, const S: usize>(from: &[X; S], to: &mut [Y; S])
where
    T: Real,
    L: StageLayout<T>,
    Y: Vector<Scalar = T>,
    X: Vector<Scalar = L::Bundle>,
{
    for k in 0..Y::PARTS {
        for i in 0..to[0].part(k).len() {
            let few = spread::<T, L, X, 0, S>([], from, k, i);
            for (j, to) in to.iter_mut().enumerate() {
                to.part_mut(k)[i] = number::<T, L, S>(&few, j);
            }
        }
    }
}

/// Equations `y = g(y)` for an unknown of each stage.
pub(super) trait Equations<T: Real, L: StageLayout<T>, const S: usize> {
    /// The unknowns of a bundle, and the point at which they are evaluated.
    type Unknowns: Vector<Scalar = L::Bundle>;
    /// The number of groups of unknowns that an iteration computes one after the other, each from the new ones of those
    /// before it.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn groups(&self) -> usize {
        1
    }
    /// The points of all bundles that a group is computed from, by the matrices of this number: 0 where the unknowns are
    /// those of the step before and the points those of the guess that is made of them; 1 later.
    fn points(
        &self,
        group: usize,
        matrices: usize,
        unknowns: &[Self::Unknowns; S],
        points: &mut [Self::Unknowns; S],
    );
    /// Replaces a group of the unknowns of a bundle by the right-hand side, but for the lanes that are solved. Returns
    /// the size of the change.
    fn improve(
        &mut self,
        group_and_bundle: (usize, usize),
        solved: T::Mask,
        point: &mut Self::Unknowns,
        unknowns: &mut Self::Unknowns,
        next: &mut Self::Unknowns,
    ) -> <L::Bundle as Real>::Size;
    /// The size of the numbers that the unknowns of a stage are made of, besides their own.
    fn scale(&self) -> T::Size;
}

/// A change that no longer shrinks is rounding if it is at most this many ε of the numbers added:
/// evaluations of J∇H may lose three decimal digits by cancellation.
const ROUNDING: f64 = 1024.0;

/// The iteration ends when the next change would be less than this part of ε: what is left is then no
/// drift beside rounding, not even over 10⁷ steps.
const REST: f64 = 1.0 / 16.0;

/// The same for a step alone, which is half as long as the unknowns allow at most: the state then changes by two ε of what
/// a step changes it by.
const ALONE: f64 = 4.0;

/// Replaces unknowns by the next ones, but for the lanes that are solved. Returns the size of the change.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn replace<T: Real, L: StageLayout<T>, X: Vector<Scalar = L::Bundle>>(
    solved: T::Mask,
    next: &X,
    unknowns: &mut X,
) -> <L::Bundle as Real>::Size {
    let change = next.size_of_difference(unknowns);
    L::copy_unless(solved, next, unknowns);
    change
}

/// Iterates `y ← g(y)` of all stages, at most `limit` times, until the change, the largest of all stages,
/// - is 0,
/// - or would be lost the next time in the rounding of the unknowns, as foreseen from the last two
///   quotients of changes,
/// - or does not shrink any more and is rounding.
///
/// If `is_own`, the unknowns are a guess for this step, by the matrices of every iteration. The first change then counts,
/// and one quotient is enough to foresee a change below [`ALONE`] ε: no step follows, so nothing adds up.
///
/// A maximum is the same in any order, so that a step ends after as many iterations in every layout. The guess
/// itself is not computed, so the first change is that of the second iteration; one stage begins with its
/// unknown of the step before. A lane of `T` that is solved is not touched any more.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn solve<T: Real, L: StageLayout<T>, E: Equations<T, L, S>, const S: usize>(
    (limit, is_own): (u32, bool),
    equations: &mut E,
    unknowns: &mut [E::Unknowns; S],
    points: &mut [E::Unknowns; S],
    next: &mut E::Unknowns,
) -> Outcome<T> {
    let zero = T::Size::zero();
    let infinite = T::Size::constant(f64::INFINITY, 0.0);
    let (mut before, mut earlier, mut rest) = (infinite, infinite, zero);
    let mut solved = T::Mask::splat(false);
    let mut lost = T::Mask::splat(false);
    let mut iterations = 0;
    // Of numbers that the compiler knows it makes a choice between the entries of two matrices, one by one.
    let matrices = core::hint::black_box([0, 1]);
    while iterations < limit {
        let later = iterations > 0 || is_own;
        let first = (0, matrices[usize::from(later)]);
        let mut changes = improve(first, equations, solved, unknowns, points, next);
        if equations.groups() > 1 {
            // The first group already belongs to this step.
            let second = (1, matrices[1]);
            let others = improve(second, equations, solved, unknowns, points, next);
            for (change, other) in changes.iter_mut().zip(others) {
                *change += other;
            }
        }
        iterations += 1;
        if iterations == 1 {
            let share = if is_own { ALONE } else { REST };
            let part = T::Size::constant(share * T::epsilon(), 0.0);
            rest = part * largest_size::<T, L, _, S>(unknowns);
            rest = T::Size::select(rest.lt(infinite), rest, zero);
            if S > 1 && !is_own {
                continue;
            }
        }
        let change = largest::<T, L, S>(&changes);
        // Two quotients: one may be small by chance.
        let is_steady = match is_own {
            true => before.lt(infinite),
            false => (change * before).le(rest * earlier) & earlier.lt(infinite),
        };
        let foreseen = (change * change).le(rest * before) & is_steady;
        let mut now = change.equals(zero) | foreseen;
        if !(now | change.lt(before)).all() {
            // Strictly smaller than infinity: ∞ ≤ ∞ is no convergence.
            let stalls = before.le(change) & before.lt(infinite);
            let scale = equations.scale() + largest_size::<T, L, _, S>(unknowns);
            let floor = T::Size::constant(ROUNDING * T::epsilon(), 0.0) * scale;
            now = now | (stalls & change.lt(floor));
            for change in changes.iter().take(bundles::<T, L, S>()) {
                lost = lost | L::any(!change.equals(*change));
            }
        }
        solved = solved | (now & !lost);
        earlier = before;
        before = change;
        // A lane that is not a number stays one.
        if (solved | lost).all() {
            break;
        }
    }
    Outcome {
        solved,
        residual: before,
        iterations,
    }
}

/// Replaces a group of the unknowns of all bundles, from the points by the matrices of that number. Returns the changes.
///
/// The group is a number that the compiler knows, so that nothing of another one is computed or kept in memory.
#[cfg_attr(not(unoptimised), inline(always))]
fn improve<T: Real, L: StageLayout<T>, E: Equations<T, L, S>, const S: usize>(
    (group, matrices): (usize, usize),
    equations: &mut E,
    solved: T::Mask,
    unknowns: &mut [E::Unknowns; S],
    points: &mut [E::Unknowns; S],
    next: &mut E::Unknowns,
) -> [<L::Bundle as Real>::Size; S] {
    let mut changes = [<L::Bundle as Real>::Size::zero(); S];
    equations.points(group, matrices, unknowns, points);
    for bundle in 0..bundles::<T, L, S>() {
        let (point, of) = (&mut points[bundle], &mut unknowns[bundle]);
        changes[bundle] = equations.improve((group, bundle), solved, point, of, next);
    }
    changes
}

/// The larger of two numbers.
#[cfg_attr(not(unoptimised), inline(always))]
fn larger<R: Real>(a: R, b: R) -> R {
    R::select(a.lt(b), b, a)
}

/// The largest of the stages' sizes; infinity if one of them is not a number.
#[cfg_attr(not(unoptimised), inline(always))]
fn largest<T: Real, L: StageLayout<T>, const S: usize>(
    sizes: &[<L::Bundle as Real>::Size; S],
) -> T::Size {
    let infinite = <L::Bundle as Real>::Size::constant(f64::INFINITY, 0.0);
    let mut most = infinite;
    for (bundle, size) in sizes.iter().enumerate().take(bundles::<T, L, S>()) {
        // One instruction: the first if it is less, else the second.
        let size = <L::Bundle as Real>::Size::select(size.lt(infinite), *size, infinite);
        most = if bundle == 0 {
            size
        } else {
            larger(most, size)
        };
    }
    L::largest(most)
}

/// The largest size of the unknowns of a stage.
#[cfg_attr(not(unoptimised), inline(always))]
fn largest_size<T: Real, L: StageLayout<T>, Y: Vector<Scalar = L::Bundle>, const S: usize>(
    unknowns: &[Y; S],
) -> T::Size {
    let mut sizes = [<L::Bundle as Real>::Size::zero(); S];
    for (size, unknowns) in sizes.iter_mut().zip(unknowns).take(bundles::<T, L, S>()) {
        *size = unknowns.size();
    }
    largest::<T, L, S>(&sizes)
}

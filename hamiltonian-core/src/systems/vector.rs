//! Coordinates in the form that schemes use: contiguous slices of scalars, without shapes.
//!
//! Input: nalgebra storage (or a generated struct with one field per group). Output: [`Vector`],
//! [`IntoVector`]. Invariant: nothing here allocates except `clone` of a run-time size and
//! `zeros_like`.

use crate::systems::uneven::Uneven;
use alloc::vec::Vec;
use hamiltonian_lanes::{Mask, Real};
use nalgebra::{ArrayStorage, Const, DVector, Dyn, Matrix, OMatrix, SMatrix, SVector, VecStorage};

/// A vector of coordinates or of momenta over one scalar.
///
/// `[N]` is `SVector<T, N>`, `[N][3]` the N×3 column-major matrix (component `c` of body `i` at
/// `i + N·c`), run-time sizes `DVector` and `OMatrix<T, Dyn, Const<3>>`; coordinates whose last extent
/// is set at run time or more than 4 are a [`Lattice`](crate::Lattice), row after row; those of
/// mixed shape are a generated struct with one part per group. This is the order of `as_slice`, of
/// the parts and of the flat index. [`State::to_vec`](crate::State::to_vec) and its relatives have
/// the order of the declaration instead, row after row.
///
/// The provided methods are all the linear algebra that schemes need. They are loops over the
/// parts; the flat index runs through part 0, then part 1, and so on.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not store coordinates",
    label = "expected the coordinates or the momenta of a state",
    note = "write `State::new([0.5], [0.0])`, which converts arrays and `Vec`s; the fields of a `State` have other types"
)]
pub trait Vector: Clone + core::fmt::Debug + PartialEq + Send + Sync + 'static {
    /// The scalar of every component.
    type Scalar: Real;
    /// The shape, which has a vector over each scalar.
    type Shape: Shape;
    /// The zero vector of this shape over another scalar.
    fn zeros_over<U: Real>(&self) -> Over<Self, U>;
    /// The number of contiguous parts (1 except for mixed shapes).
    const PARTS: usize;
    /// Part `k < PARTS` as a slice.
    fn part(&self, k: usize) -> &[Self::Scalar];
    /// Part `k < PARTS` as a mutable slice.
    fn part_mut(&mut self, k: usize) -> &mut [Self::Scalar];
    /// The number of columns of part `k < PARTS`: the last extent of an array of rank 2, else 1.
    fn columns(&self, _k: usize) -> usize {
        1
    }
    /// The extents of part `k < PARTS` where its elements are stored in the order of their declaration, the
    /// last index fastest, as those of a [`Lattice`](crate::Lattice) are; empty where they are stored column
    /// after column.
    fn extents(&self, _k: usize) -> &[usize] {
        &[]
    }
    /// Two rows of different lengths in the nested lists that part `k < PARTS` was made of, if there are any.
    /// Then the part has no elements.
    fn uneven(&self, _k: usize) -> Option<&Uneven> {
        None
    }
    /// The same shape, all zero.
    fn zeros_like(&self) -> Self;
    /// Moves the value out without allocating. It leaves a valid vector of unspecified shape and
    /// values, to be overwritten.
    fn take(&mut self) -> Self;

    /// The number of components.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn len(&self) -> usize {
        let mut len = 0;
        for k in 0..Self::PARTS {
            len += self.part(k).len();
        }
        len
    }

    /// Returns true if there are no components at all.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns true if every part has as many components as the same part of `other`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn same_shape(&self, other: &Self) -> bool {
        for k in 0..Self::PARTS {
            if self.part(k).len() != other.part(k).len() {
                return false;
            }
        }
        true
    }

    /// Component `index` in flat order.
    ///
    /// # Panics
    /// If `index` is not below [`Vector::len`].
    #[cfg_attr(not(unoptimised), inline(always))]
    fn component(&self, index: usize) -> Self::Scalar {
        let mut rest = index;
        for k in 0..Self::PARTS {
            let part = self.part(k);
            if rest < part.len() {
                return part[rest];
            }
            rest -= part.len();
        }
        panic!("component {index} of a vector of {}", self.len());
    }

    /// Component `index` in flat order, mutable.
    ///
    /// # Panics
    /// If `index` is not below [`Vector::len`].
    #[cfg_attr(not(unoptimised), inline(always))]
    fn component_mut(&mut self, index: usize) -> &mut Self::Scalar {
        let mut rest = index;
        for k in 0..Self::PARTS {
            let len = self.part(k).len();
            if rest < len {
                return &mut self.part_mut(k)[rest];
            }
            rest -= len;
        }
        panic!("component {index} of a vector of {}", self.len());
    }

    /// All components in flat order.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn components(&self) -> impl Iterator<Item = Self::Scalar> {
        (0..Self::PARTS).flat_map(|k| self.part(k).iter().copied())
    }

    /// `self = other`, for equal shapes; unlike `clone_from` it never allocates.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn copy_from(&mut self, other: &Self) {
        for k in 0..Self::PARTS {
            for (to, from) in self.part_mut(k).iter_mut().zip(other.part(k)) {
                *to = *from;
            }
        }
    }

    /// `self += c·v`, fused where the scalar fuses.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn accumulate(&mut self, c: Self::Scalar, v: &Self) {
        for k in 0..Self::PARTS {
            for (to, from) in self.part_mut(k).iter_mut().zip(v.part(k)) {
                *to = c.fma(*from, *to);
            }
        }
    }

    /// `self *= c`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn scale(&mut self, c: Self::Scalar) {
        for k in 0..Self::PARTS {
            for to in self.part_mut(k) {
                *to *= c;
            }
        }
    }

    /// `self = 0`.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn set_zero(&mut self) {
        for k in 0..Self::PARTS {
            for to in self.part_mut(k) {
                *to = Self::Scalar::zero();
            }
        }
    }

    /// The maximum norm over all components, [`Real::magnitude`] of each; NaN if any is NaN.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn magnitude(&self) -> f64 {
        let mut largest = 0.0;
        for k in 0..Self::PARTS {
            for component in self.part(k) {
                largest = larger(largest, component.magnitude());
            }
        }
        largest
    }

    /// The maximum norm of `self − other`; NaN if any difference is NaN.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn distance(&self, other: &Self) -> f64 {
        let mut largest = 0.0;
        for k in 0..Self::PARTS {
            for (a, b) in self.part(k).iter().zip(other.part(k)) {
                largest = larger(largest, (*a - *b).magnitude());
            }
        }
        largest
    }

    /// The sum norm Σ [`size`](Real::size) of all components, lane by lane; NaN in a lane where any
    /// component is NaN. Norms of iterations are this one: it costs half of a maximum.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn size(&self) -> <Self::Scalar as Real>::Size {
        let mut sum = <<Self::Scalar as Real>::Size as Real>::zero();
        for k in 0..Self::PARTS {
            for component in self.part(k) {
                sum += component.size();
            }
        }
        sum
    }

    /// The sum norm of `self − other`, lane by lane.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn size_of_difference(&self, other: &Self) -> <Self::Scalar as Real>::Size {
        let mut sum = <<Self::Scalar as Real>::Size as Real>::zero();
        for k in 0..Self::PARTS {
            for (a, b) in self.part(k).iter().zip(other.part(k)) {
                sum += (*a - *b).size();
            }
        }
        sum
    }

    /// `self = other` in the lanes where the mask is set.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn copy_where(&mut self, mask: <Self::Scalar as Real>::Mask, other: &Self) {
        for k in 0..Self::PARTS {
            for (to, from) in self.part_mut(k).iter_mut().zip(other.part(k)) {
                *to = Self::Scalar::replaced(mask, *from, *to);
            }
        }
    }

    /// Writes NaN into every component in the lanes where the mask is set, to mark an exact flow
    /// that left its domain or an iteration that did not converge.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn poison(&mut self, mask: <Self::Scalar as Real>::Mask) {
        let nan = Self::Scalar::constant(f64::NAN, 0.0);
        for k in 0..Self::PARTS {
            for to in self.part_mut(k) {
                *to = Self::Scalar::replaced(mask, nan, *to);
            }
        }
    }

    /// The lanes in which every component is finite.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn finite(&self) -> <Self::Scalar as Real>::Mask {
        let mut finite = <<Self::Scalar as Real>::Mask as Mask>::splat(true);
        for k in 0..Self::PARTS {
            for component in self.part(k) {
                finite = finite & component.finite();
            }
        }
        finite
    }

    /// Returns true if every component is finite.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn is_finite(&self) -> bool {
        let mut finite = true;
        for k in 0..Self::PARTS {
            for component in self.part(k) {
                finite &= component.is_finite();
            }
        }
        finite
    }
}

/// A shape of coordinates: one type, with a vector over each scalar. The shape of a vector is named by the type of the
/// vector over `()`: that of `SVector<f64, 2>` is `SVector<(), 2>`.
pub trait Shape: 'static {
    /// The vector of this shape over a scalar.
    type Vector<T: Real>: Vector<Scalar = T, Shape = Self>;
}

/// The vector of the same shape as `V` over the scalar `U`.
pub type Over<V, U> = <<V as Vector>::Shape as Shape>::Vector<U>;

/// a·b.
#[cfg_attr(not(unoptimised), inline(always))]
pub(crate) fn dot<V: Vector>(a: &V, b: &V) -> V::Scalar {
    let mut sum = V::Scalar::zero();
    for k in 0..V::PARTS {
        for (a, b) in a.part(k).iter().zip(b.part(k)) {
            sum = a.fma(*b, sum);
        }
    }
    sum
}

/// The larger of two non-negative numbers, NaN if either is NaN (`f64::max` would drop it).
#[cfg_attr(not(unoptimised), inline(always))]
fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

impl<const R: usize, const C: usize> Shape for SMatrix<(), R, C> {
    type Vector<T: Real> = SMatrix<T, R, C>;
}

impl<T: Real, const R: usize, const C: usize> Vector for SMatrix<T, R, C> {
    type Scalar = T;
    type Shape = SMatrix<(), R, C>;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn zeros_over<U: Real>(&self) -> SMatrix<U, R, C> {
        SMatrix::from_element(U::zero())
    }
    const PARTS: usize = 1;
    fn columns(&self, _: usize) -> usize {
        C
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part(&self, _: usize) -> &[T] {
        self.as_slice()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part_mut(&mut self, _: usize) -> &mut [T] {
        self.as_mut_slice()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn zeros_like(&self) -> Self {
        SMatrix::from_element(T::zero())
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn take(&mut self) -> Self {
        *self
    }
}

impl<const C: usize> Shape for OMatrix<(), Dyn, Const<C>> {
    type Vector<T: Real> = OMatrix<T, Dyn, Const<C>>;
}

impl<T: Real, const C: usize> Vector for OMatrix<T, Dyn, Const<C>> {
    type Scalar = T;
    type Shape = OMatrix<(), Dyn, Const<C>>;
    fn zeros_over<U: Real>(&self) -> OMatrix<U, Dyn, Const<C>> {
        OMatrix::from_element_generic(Dyn(self.nrows()), Const, U::zero())
    }
    const PARTS: usize = 1;
    fn columns(&self, _: usize) -> usize {
        C
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part(&self, _: usize) -> &[T] {
        self.as_slice()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part_mut(&mut self, _: usize) -> &mut [T] {
        self.as_mut_slice()
    }
    fn zeros_like(&self) -> Self {
        OMatrix::from_element_generic(Dyn(self.nrows()), Const, T::zero())
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn take(&mut self) -> Self {
        // A vector of no elements takes no memory.
        let none = Matrix::from_data(VecStorage::new(Dyn(0), Const, Vec::new()));
        core::mem::replace(self, none)
    }
}

// Parameters with columns set at run time, and rows that may be.
macro_rules! wide {
    ($rows:ty, $($given:tt)*) => {
        impl<$($given)*> Shape for OMatrix<(), $rows, Dyn> {
            type Vector<T: Real> = OMatrix<T, $rows, Dyn>;
        }

        impl<T: Real, $($given)*> Vector for OMatrix<T, $rows, Dyn> {
            type Scalar = T;
            type Shape = OMatrix<(), $rows, Dyn>;
            fn zeros_over<U: Real>(&self) -> OMatrix<U, $rows, Dyn> {
                let (rows, columns) = self.shape_generic();
                OMatrix::from_element_generic(rows, columns, U::zero())
            }
            const PARTS: usize = 1;
            fn columns(&self, _: usize) -> usize {
                self.ncols()
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn part(&self, _: usize) -> &[T] {
                self.as_slice()
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn part_mut(&mut self, _: usize) -> &mut [T] {
                self.as_mut_slice()
            }
            fn zeros_like(&self) -> Self {
                self.zeros_over()
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn take(&mut self) -> Self {
                let (rows, _) = self.shape_generic();
                let none = VecStorage::new(rows, Dyn(0), Vec::new());
                core::mem::replace(self, Matrix::from_data(none))
            }
        }
    };
}

wide!(Dyn,);
wide!(Const<R>, const R: usize);

/// Arguments of [`State::new`](crate::State::new): arrays, vectors, and every [`Vector`] itself.
///
/// `[T; N]` becomes `SVector<T, N>`; `[[T; C]; N]`, one row a body, the N×C matrix; `Vec<T>` a
/// `DVector<T>`; `Vec<[T; C]>` the matrix with a run-time number of rows; `Vec<Vec<T>>` and `[Vec<T>; N]` the
/// [`Lattice`](crate::Lattice) of `u[n][m]`, and three or four levels of `Vec`s and arrays that of `u[n][m][k]` or
/// `u[n][m][k][l]`. References to arrays, slices and `Vec`s are copied. `M` distinguishes these cases and is always
/// inferred.
///
/// A run takes any of these as its start, and a definition as its parameter: a list whose length only the run time
/// knows is an error if it does not have the declared length.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no list of real numbers",
    label = "expected a list of real numbers",
    note = "write `1.0` instead of `1`: whole numbers are not converted",
    note = "write `[1.0]` for one coordinate, `[x, y]` for several, `[[x, y, z], …]` for bodies, a `Vec` of either where the size is set at run time",
    note = "`new` takes the sizes, then the parameters without a default, in the order of their declaration"
)]
pub trait IntoVector<M> {
    /// The storage of the result.
    type Vector: Vector;
    /// Converts the numbers to this storage.
    fn into_vector(self) -> Self::Vector;
}

/// The cases of [`IntoVector`].
pub mod shape {
    /// `[T; N]`
    #[derive(Debug, Clone, Copy)]
    pub struct Array;
    /// `[[T; C]; N]`
    #[derive(Debug, Clone, Copy)]
    pub struct ArrayOfRows;
    /// `Vec<T>`
    #[derive(Debug, Clone, Copy)]
    pub struct Sequence;
    /// `Vec<[T; C]>`
    #[derive(Debug, Clone, Copy)]
    pub struct SequenceOfRows;
    /// `Vec<Vec<T>>`, and more levels of `Vec`s and arrays
    #[derive(Debug, Clone, Copy)]
    pub struct Nested<const LEVELS: usize>;
    /// `&[T; N]`
    #[derive(Debug, Clone, Copy)]
    pub struct ArrayByReference;
    /// `&[[T; C]; N]`
    #[derive(Debug, Clone, Copy)]
    pub struct ArrayOfRowsByReference;
    /// `&[T]` and `&Vec<T>`
    #[derive(Debug, Clone, Copy)]
    pub struct Slice;
    /// `&[[T; C]]` and `&Vec<[T; C]>`
    #[derive(Debug, Clone, Copy)]
    pub struct SliceOfRows;
    /// A [`Vector`](crate::Vector) itself.
    #[derive(Debug, Clone, Copy)]
    pub struct Same;
}

impl<T: Real, const N: usize> IntoVector<shape::Array> for [T; N] {
    type Vector = SVector<T, N>;
    #[inline]
    fn into_vector(self) -> SVector<T, N> {
        Matrix::from_array_storage(ArrayStorage([self]))
    }
}

impl<T: Real, const N: usize, const C: usize> IntoVector<shape::ArrayOfRows> for [[T; C]; N] {
    type Vector = SMatrix<T, N, C>;
    fn into_vector(self) -> SMatrix<T, N, C> {
        SMatrix::from_fn(|row, column| self[row][column])
    }
}

impl<T: Real> IntoVector<shape::Sequence> for Vec<T> {
    type Vector = DVector<T>;
    fn into_vector(self) -> DVector<T> {
        let rows = Dyn(self.len());
        Matrix::from_data(VecStorage::new(rows, Const::<1>, self))
    }
}

impl<T: Real, const C: usize> IntoVector<shape::SequenceOfRows> for Vec<[T; C]> {
    type Vector = OMatrix<T, Dyn, Const<C>>;
    fn into_vector(self) -> OMatrix<T, Dyn, Const<C>> {
        OMatrix::from_fn_generic(Dyn(self.len()), Const, |row, column| self[row][column])
    }
}

impl<T: Real, const N: usize> IntoVector<shape::ArrayByReference> for &[T; N] {
    type Vector = SVector<T, N>;
    fn into_vector(self) -> SVector<T, N> {
        (*self).into_vector()
    }
}

impl<T: Real, const N: usize, const C: usize> IntoVector<shape::ArrayOfRowsByReference>
    for &[[T; C]; N]
{
    type Vector = SMatrix<T, N, C>;
    fn into_vector(self) -> SMatrix<T, N, C> {
        (*self).into_vector()
    }
}

impl<T: Real> IntoVector<shape::Slice> for &[T] {
    type Vector = DVector<T>;
    fn into_vector(self) -> DVector<T> {
        self.to_vec().into_vector()
    }
}

impl<T: Real> IntoVector<shape::Slice> for &Vec<T> {
    type Vector = DVector<T>;
    fn into_vector(self) -> DVector<T> {
        self.clone().into_vector()
    }
}

impl<T: Real, const C: usize> IntoVector<shape::SliceOfRows> for &[[T; C]] {
    type Vector = OMatrix<T, Dyn, Const<C>>;
    fn into_vector(self) -> OMatrix<T, Dyn, Const<C>> {
        self.to_vec().into_vector()
    }
}

impl<T: Real, const C: usize> IntoVector<shape::SliceOfRows> for &Vec<[T; C]> {
    type Vector = OMatrix<T, Dyn, Const<C>>;
    fn into_vector(self) -> OMatrix<T, Dyn, Const<C>> {
        self.clone().into_vector()
    }
}

impl<V: Vector> IntoVector<shape::Same> for V {
    type Vector = V;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn into_vector(self) -> V {
        self
    }
}

//! Arrays of one storage as those of another: a `Vec` for `[N]`, an array for a size that is set at run time.
//!
//! Input: what [`IntoVector`] makes of lists of numbers. Output: the storage that a definition declares. Invariant: a
//! length that only the run time knows is an error if it does not fit, and never a panic.

use crate::errors::{Error, InputError};
use crate::systems::lattice::{Lattice, check_axes, check_extents};
use crate::systems::uneven::{Uneven, named};
use crate::systems::vector::{IntoVector, Vector, shape};
use alloc::vec::Vec;
use hamiltonian_lanes::Real;
use nalgebra::{Const, Dim, Dyn, Matrix, OMatrix, RawStorage, SMatrix, VecStorage};

/// An array that fits storage of type `V`, as it is or if its length is right.
pub trait Fit<V: Vector>: Vector {
    /// The result of a method that stores the array: an `X` if the compiler checks the length, a `Result` otherwise.
    type Outcome<X>;
    /// The same numbers in that storage.
    ///
    /// # Errors
    /// [`InputError::Shape`], [`InputError::Row`] or [`InputError::Extent`] for other lengths.
    fn fit(self, name: &str) -> Result<V, Error>;
    /// Gives the same numbers in that storage to `set`, and returns its result.
    fn set<X>(self, name: &str, set: impl FnOnce(V) -> X) -> Self::Outcome<X>;
}

#[diagnostic::do_not_recommend]
impl<V: Vector> Fit<V> for V {
    type Outcome<X> = X;
    #[cfg_attr(not(unoptimised), inline(always))]
    fn fit(self, _: &str) -> Result<V, Error> {
        Ok(self)
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn set<X>(self, _: &str, set: impl FnOnce(V) -> X) -> X {
        set(self)
    }
}

/// An array that a method takes in the storage `V` of its parameter, in any form of [`IntoVector`].
///
/// It is a trait of its own for the sake of its message: if the forms of [`IntoVector`] do not lead to `V`, rustc would
/// show the types of both storages.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not fit this parameter",
    label = "expected an array of the declared extents",
    note = "one extent takes an array `[1.0, 2.0]`, a slice or a `Vec`; two extents take rows, `[[1.0, 2.0], [3.0, 4.0]]` or `vec![vec![1.0, 2.0]]`; with more extents each element is a list of such lists",
    note = "write `1.0` instead of `1`: whole numbers are not converted",
    note = "`new` takes the sizes, then functions, then the parameters without a default, in the order of their declaration"
)]
pub trait ListOf<K, V> {
    /// The result of a method that stores the array: an `X` if the compiler checks the length, a `Result` otherwise.
    type Outcome<X>;
    /// The same numbers in that storage.
    ///
    /// # Errors
    /// [`InputError`](crate::errors::InputError) for other extents.
    fn fit(self, name: &str) -> Result<V, Error>;
    /// Gives the same numbers in that storage to `set`, and returns its result.
    fn set<X>(self, name: &str, set: impl FnOnce(V) -> X) -> Self::Outcome<X>;
}

#[diagnostic::do_not_recommend]
impl<K, V: Vector, A: IntoVector<K, Vector: Fit<V>>> ListOf<K, V> for A {
    type Outcome<X> = <A::Vector as Fit<V>>::Outcome<X>;
    #[inline]
    fn fit(self, name: &str) -> Result<V, Error> {
        Fit::fit(self.into_vector(), name)
    }
    #[inline]
    fn set<X>(self, name: &str, set: impl FnOnce(V) -> X) -> Self::Outcome<X> {
        Fit::set(self.into_vector(), name, set)
    }
}

/// Storage of rows and columns.
trait Rectangle: Vector {
    /// The rows and columns that the type has.
    fn declared() -> [Option<usize>; 2];
    /// The array of these elements, of extents that agree with those of the type.
    fn of(extents: [usize; 2], at: impl Fn(usize, usize) -> Self::Scalar) -> Self;
}

/// Checks that the rows of the lists that an array was made of have one length.
pub(crate) fn even<W: Vector>(name: &str, from: &W) -> Result<(), InputError> {
    match from.uneven(0) {
        Some(Uneven([(_, expected), (at, found)])) => Err(InputError::Row {
            name: named(name, at).into(),
            expected: *expected,
            found: *found,
        }),
        None => Ok(()),
    }
}

/// The elements of an array in storage of another type, if its extents are those of the type.
fn fitted<W: Vector, V: Rectangle<Scalar = W::Scalar>>(
    name: &str,
    from: &W,
) -> Result<V, InputError> {
    even(name, from)?;
    let elements = from.part(0);
    let by_rows = !from.extents(0).is_empty();
    let found = match *from.extents(0) {
        [rows, columns] => [rows, columns],
        _ => {
            let columns = from.columns(0);
            [elements.len().checked_div(columns).unwrap_or(0), columns]
        }
    };
    let [rows, columns] = V::declared();
    let extents = [rows.unwrap_or(found[0]), columns.unwrap_or(found[1])];
    if by_rows && !elements.is_empty() && extents[1] != found[1] {
        return Err(InputError::Row {
            name: named(name, &[0]).into(),
            expected: extents[1],
            found: found[1],
        });
    }
    check_extents(name, extents, found)?;
    Ok(V::of(extents, |row, column| {
        elements[match by_rows {
            true => row * found[1] + column,
            false => row + found[0] * column,
        }]
    }))
}

impl<T: Real, const R: usize, const C: usize> Rectangle for SMatrix<T, R, C> {
    fn declared() -> [Option<usize>; 2] {
        [Some(R), Some(C)]
    }
    fn of(_: [usize; 2], at: impl Fn(usize, usize) -> T) -> Self {
        SMatrix::from_fn(at)
    }
}

impl<T: Real, const C: usize> Rectangle for OMatrix<T, Dyn, Const<C>> {
    fn declared() -> [Option<usize>; 2] {
        [None, Some(C)]
    }
    fn of([rows, _]: [usize; 2], at: impl Fn(usize, usize) -> T) -> Self {
        OMatrix::from_fn_generic(Dyn(rows), Const, at)
    }
}

/// A matrix with columns set at run time.
type Wide<T, R> = Matrix<T, R, Dyn, VecStorage<T, R, Dyn>>;

impl<T: Real, R: Dim> Rectangle for Wide<T, R>
where
    Self: Vector<Scalar = T>,
    VecStorage<T, R, Dyn>: RawStorage<T, R, Dyn>,
{
    fn declared() -> [Option<usize>; 2] {
        [R::try_to_usize(), None]
    }
    fn of([rows, columns]: [usize; 2], at: impl Fn(usize, usize) -> T) -> Self {
        let by_columns = (0..columns).flat_map(|column| (0..rows).map(move |row| (row, column)));
        let elements: Vec<T> = by_columns.map(|(row, column)| at(row, column)).collect();
        Matrix::from_data(VecStorage::new(R::from_usize(rows), Dyn(columns), elements))
    }
}

impl<T: Real> Rectangle for Lattice<T, 2> {
    fn declared() -> [Option<usize>; 2] {
        [None; 2]
    }
    fn of(extents: [usize; 2], at: impl Fn(usize, usize) -> T) -> Self {
        Lattice::from_fn(extents, |[row, column]| at(row, column))
    }
}

macro_rules! fit {
    (@ $generics:tt $from:ty => $($to:ty),+) => { $(fit! { one $generics $from => $to })+ };
    (one [$($generics:tt)*] $from:ty => $to:ty) => {
        #[diagnostic::do_not_recommend]
        impl<T: Real, $($generics)*> Fit<$to> for $from {
            type Outcome<X> = Result<X, Error>;
            fn fit(self, name: &str) -> Result<$to, Error> {
                Ok(fitted(name, &self)?)
            }
            fn set<X>(self, name: &str, set: impl FnOnce($to) -> X) -> Result<X, Error> {
                Ok(set(fitted(name, &self)?))
            }
        }
    };
    ($([$($generics:tt)*] $from:ty => $($to:ty),+;)*) => { $(fit! { @ [$($generics)*] $from => $($to),+ })* };
}

fit! {
    [const R: usize, const C: usize] SMatrix<T, R, C> => OMatrix<T, Dyn, Const<C>>, Lattice<T, 2>, OMatrix<T, Dyn, Dyn>;
    [const C: usize] OMatrix<T, Dyn, Const<C>> => Lattice<T, 2>, OMatrix<T, Dyn, Dyn>;
    [const R: usize, const C: usize] OMatrix<T, Dyn, Const<C>> => SMatrix<T, R, C>, OMatrix<T, Const<R>, Dyn>;
    [const R: usize, const C: usize, const S: usize] SMatrix<T, R, C> => OMatrix<T, Const<S>, Dyn>;
    [const R: usize, const C: usize] Lattice<T, 2> => SMatrix<T, R, C>;
    [const C: usize] Lattice<T, 2> => OMatrix<T, Dyn, Const<C>>, OMatrix<T, Const<C>, Dyn>;
    [] Lattice<T, 2> => OMatrix<T, Dyn, Dyn>;
}

/// A list of lists with `R` extents in its type, the field of a parameter.
pub trait Axes<const R: usize>: Sized {
    /// The type of its numbers.
    type Number: Real;
    /// The same numbers, if their extents are those of the type.
    ///
    /// # Errors
    /// [`InputError::Row`] or [`InputError::Extent`] for other lengths.
    fn of_lattice(name: &str, given: &Lattice<Self::Number, R>) -> Result<Self, Error>;
}

macro_rules! lists {
    ($rank:literal: $list:ty, [$($extent:ident)*], [$($index:ident)*]) => {
        impl<T: Real, $(const $extent: usize),*> Axes<$rank> for $list {
            type Number = T;
            fn of_lattice(name: &str, given: &Lattice<T, $rank>) -> Result<Self, Error> {
                check_axes(name, [$($extent),*], given)?;
                Ok(lists!(@ given [] $($index)*))
            }
        }
        #[diagnostic::do_not_recommend]
        impl<T: Real, $(const $extent: usize),*> ListOf<[shape::Array; $rank], $list> for $list {
            type Outcome<X> = X;
            fn fit(self, _: &str) -> Result<Self, Error> {
                Ok(self)
            }
            fn set<X>(self, _: &str, set: impl FnOnce(Self) -> X) -> X {
                set(self)
            }
        }
        #[diagnostic::do_not_recommend]
        impl<T: Real, L, $(const $extent: usize),*> ListOf<shape::Nested<$rank>, $list> for Vec<L>
        where
            Self: IntoVector<shape::Nested<$rank>, Vector = Lattice<T, $rank>>,
        {
            type Outcome<X> = Result<X, Error>;
            fn fit(self, name: &str) -> Result<$list, Error> {
                Axes::of_lattice(name, &self.into_vector())
            }
            fn set<X>(self, name: &str, set: impl FnOnce($list) -> X) -> Result<X, Error> {
                ListOf::fit(self, name).map(set)
            }
        }
    };
    (@ $given:ident [$($at:ident)*] $index:ident $($rest:ident)*) => {
        core::array::from_fn(|$index| lists!(@ $given [$($at)* $index] $($rest)*))
    };
    (@ $given:ident [$($at:ident)*]) => { $given[[$($at),*]] };
}

lists! { 3: [[[T; C]; B]; A], [A B C], [i j k] }
lists! { 4: [[[[T; D]; C]; B]; A], [A B C D], [i j k l] }

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::{String, ToString};
    use alloc::vec;
    use nalgebra::SVector;

    /// The array in storage like that of another.
    fn like<K, V: Vector>(_: &V, given: impl ListOf<K, V>) -> V {
        given.fit("m").expect("the same extents")
    }

    /// The message of an array that does not fit.
    fn refused<K, V: core::fmt::Debug>(given: impl ListOf<K, V>) -> String {
        given.fit("m").expect_err("another length").to_string()
    }

    #[test]
    fn lists_of_every_kind_fit_every_storage() {
        let rows = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
        let due = SMatrix::<f64, 2, 3>::from_fn(|i, c| rows[i][c]);
        macro_rules! all {
            ($due:expr; $($given:expr),* $(,)?) => { $(assert_eq!(like(&$due, $given), $due);)* };
        }
        let nested = || vec![vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]];
        all!(due; rows, &rows, rows.to_vec(), &rows[..], nested(), &nested(), &nested()[..]);
        let tall = OMatrix::<f64, Dyn, Const<3>>::from_fn_generic(Dyn(2), Const, |i, c| rows[i][c]);
        all!(tall; rows, &rows, rows.to_vec(), &rows[..], nested(), rows.map(Vec::from));
        let wide = OMatrix::<f64, Dyn, Dyn>::from_fn(2, 3, |i, c| rows[i][c]);
        all!(wide; rows, &rows, rows.to_vec(), nested(), &nested()[..]);
        let lattice = Lattice::from_fn([2, 3], |[i, c]| rows[i][c]);
        all!(lattice; rows, &rows, rows.to_vec(), nested(), &nested());
        let list = SVector::<f64, 3>::new(1.0, 2.0, 3.0);
        let one = [1.0, 2.0, 3.0];
        all!(list; one, &one, one.to_vec(), &one[..], &one.to_vec());
        let long = nalgebra::DVector::from_vec(one.to_vec());
        all!(long; one, &one, one.to_vec(), &one[..]);
    }

    #[test]
    fn lists_of_lists_fit_fields_of_three_and_four_extents() {
        let three = [[[1.0, 2.0]], [[3.0, 4.0]], [[5.0, 6.0]]];
        let set = |list: [[[f64; 2]; 1]; 3]| list;
        assert_eq!(three.set("w", set), three);
        let vectors = three.map(|rows| rows.map(Vec::from).to_vec()).to_vec();
        assert_eq!(vectors.set("w", set).unwrap(), three);
        let four = [[[[1.0, 2.0]], [[3.0, 4.0]]]];
        let set = |list: [[[[f64; 2]; 1]; 2]; 1]| list;
        assert_eq!(four.to_vec().set("w", set).unwrap(), four);
        let short = vec![vec![[1.0, 2.0]]; 2];
        assert_eq!(
            refused::<_, [[[f64; 2]; 1]; 3]>(short),
            "axis 0 of `m` must have the extent 3, found 2"
        );
    }

    #[test]
    fn other_lengths_are_errors() {
        type Flat = SVector<f64, 3>;
        type Rows = SMatrix<f64, 2, 3>;
        assert_eq!(
            refused::<_, Flat>(vec![1.0; 2]),
            "`m` must have 3 components, found 2"
        );
        assert_eq!(
            refused::<_, Rows>(vec![[1.0; 3]; 3]),
            "`m` must have 6 components, found 9"
        );
        assert_eq!(
            refused::<_, Rows>(vec![vec![1.0; 2]; 3]),
            "`m[0]` must have 3 elements, found 2"
        );
        let uneven = vec![vec![1.0; 3], vec![1.0; 2]];
        assert_eq!(
            refused::<_, Rows>(uneven),
            "`m[1]` must have 3 elements, found 2"
        );
        assert_eq!(
            refused::<_, Rows>(Vec::<Vec<f64>>::new()),
            "`m` must have 6 components, found 0"
        );
        let four = vec![[1.0; 2]; 4];
        assert_eq!(
            refused::<_, OMatrix<f64, Const<3>, Dyn>>(four),
            "`m` must have 6 components, found 8"
        );
    }
}

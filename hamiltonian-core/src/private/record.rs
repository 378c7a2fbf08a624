//! States and parameters for serde, with the feature `serde`.
//!
//! Input: the fields of a type, numbers or arrays. Output: `Serialize` and `Deserialize`: a struct with named fields,
//! whose arrays are lists in the order of the declaration. Invariant: what is read is checked as by a constructor; a
//! field that is missing or unknown, or a list of another length, is an error.

use super::SetByNew;
use crate::errors::InputError;
use crate::systems::fit::{Axes, Fit, even};
use crate::systems::lattice::{Lattice, lattice};
use crate::systems::state::{Gradient, State};
use crate::systems::uneven::same_part;
use crate::systems::vector::Vector;
use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;
use hamiltonian_lanes::Real;
use nalgebra::{Const, Dyn, OMatrix, SMatrix};
use serde_core::de::{DeserializeSeed, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_core::ser::Serializer;
use serde_core::{Deserialize, Serialize};

/// A value that is written as lists of numbers.
pub trait Saved: Sized {
    /// The type of its numbers.
    type Number;
    /// Writes the numbers in the order of the declaration.
    ///
    /// # Errors
    /// Those of the serializer.
    fn write<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error>
    where
        Self::Number: Serialize;
    /// Reads the value; `name` is that of its field.
    ///
    /// # Errors
    /// Those of the deserializer; a list of another length.
    fn read<'de, D: Deserializer<'de>>(from: D, name: &'static str) -> Result<Self, D::Error>
    where
        Self::Number: Deserialize<'de>;
}

/// A [`Saved`] value as one that serde writes.
#[derive(Debug)]
pub struct Written<'a, V>(pub &'a V);

impl<V: Saved<Number: Serialize>> Serialize for Written<'_, V> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.0.write(to)
    }
}

/// A struct that is read field by field.
pub trait Fielded<'de>: Sized {
    /// The name of the struct.
    const NAME: &'static str;
    /// The names of its fields.
    const FIELDS: &'static [&'static str];
    /// The fields read so far.
    type Read;
    /// No field.
    fn nothing() -> Self::Read;
    /// Reads a field.
    ///
    /// # Errors
    /// Those of the deserializer; a field that was read before.
    fn read<D: Deserializer<'de>>(
        into: &mut Self::Read,
        name: &'static str,
        from: D,
    ) -> Result<(), D::Error>;
    /// The struct.
    ///
    /// # Errors
    /// A field that is missing; values that do not go together.
    fn whole<E: serde_core::de::Error>(read: Self::Read) -> Result<Self, E>;
}

/// Reads a struct.
///
/// # Errors
/// Those of the deserializer, and of [`Fielded`].
pub fn read_record<'de, R: Fielded<'de>, D: Deserializer<'de>>(from: D) -> Result<R, D::Error> {
    from.deserialize_struct(R::NAME, R::FIELDS, Fields::<R>(PhantomData))
}

struct Fields<R>(PhantomData<R>);

impl<'de, R: Fielded<'de>> Visitor<'de> for Fields<R> {
    type Value = R;
    fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "struct {}", R::NAME)
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<R, A::Error> {
        let mut read = R::nothing();
        while let Some(name) = map.next_key_seed(FieldName::<R>(PhantomData))? {
            let into = &mut read;
            map.next_value_seed(Slot::<R> { into, name })?;
        }
        R::whole(read)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<R, A::Error> {
        let mut read = R::nothing();
        for name in R::FIELDS {
            let into = &mut read;
            let _: Option<()> = list.next_element_seed(Slot::<R> { into, name })?;
        }
        R::whole(read)
    }
}

/// The name of a field.
struct FieldName<R>(PhantomData<R>);

impl<'de, R: Fielded<'de>> DeserializeSeed<'de> for FieldName<R> {
    type Value = &'static str;
    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<&'static str, D::Error> {
        from.deserialize_identifier(self)
    }
}

impl<'de, R: Fielded<'de>> Visitor<'de> for FieldName<R> {
    type Value = &'static str;
    fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "a field of {}", R::NAME)
    }
    fn visit_str<E: serde_core::de::Error>(self, name: &str) -> Result<&'static str, E> {
        let known = R::FIELDS.iter().find(|known| **known == name);
        known
            .copied()
            .ok_or_else(|| E::unknown_field(name, R::FIELDS))
    }
    fn visit_bytes<E: serde_core::de::Error>(self, name: &[u8]) -> Result<&'static str, E> {
        self.visit_str(core::str::from_utf8(name).unwrap_or_default())
    }
    fn visit_u64<E: serde_core::de::Error>(self, at: u64) -> Result<&'static str, E> {
        let known = usize::try_from(at).ok().and_then(|at| R::FIELDS.get(at));
        known
            .copied()
            .ok_or_else(|| E::custom("the number of a field that is not there"))
    }
}

/// The place of a field.
struct Slot<'a, 'de, R: Fielded<'de>> {
    into: &'a mut R::Read,
    name: &'static str,
}

impl<'de, R: Fielded<'de>> DeserializeSeed<'de> for Slot<'_, 'de, R> {
    type Value = ();
    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        R::read(self.into, self.name, from)
    }
}

/// A list of numbers or of lists.
pub(super) struct Collected<I>(pub I);

impl<I: Iterator<Item: Serialize> + Clone> Serialize for Collected<I> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.0.clone())
    }
}

/// Writes an array column after column as a list of rows.
fn write_rows<S: Serializer, T: Serialize>(
    [rows, columns]: [usize; 2],
    at: impl Fn(usize, usize) -> T,
    to: S,
) -> Result<S::Ok, S::Error> {
    let at = &at;
    to.collect_seq((0..rows).map(|i| Collected((0..columns).map(move |j| at(i, j)))))
}

/// A list of another length as an error of the deserializer.
fn checked<V, E: serde_core::de::Error>(read: Result<V, impl fmt::Display>) -> Result<V, E> {
    read.map_err(E::custom)
}

impl Saved for usize {
    type Number = usize;
    fn write<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.serialize(to)
    }
    fn read<'de, D: Deserializer<'de>>(from: D, _: &'static str) -> Result<Self, D::Error> {
        usize::deserialize(from)
    }
}

impl<X: Saved> Saved for SetByNew<X> {
    type Number = X::Number;
    fn write<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error>
    where
        X::Number: Serialize,
    {
        (**self).write(to)
    }
    fn read<'de, D: Deserializer<'de>>(from: D, name: &'static str) -> Result<Self, D::Error>
    where
        X::Number: Deserialize<'de>,
    {
        X::read(from, name).map(SetByNew::new)
    }
}

// Arrays with one column are lists of numbers, others lists of rows. Their types have the number of columns.
macro_rules! saved {
    ($([$($generics:tt)*] $storage:ty, $is_flat:expr;)*) => { $(
        impl<T: Real, $($generics)*> Saved for $storage {
            type Number = T;
            fn write<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error>
            where
                T: Serialize,
            {
                match $is_flat {
                    true => to.collect_seq(self.as_slice()),
                    false => write_rows([self.nrows(), self.ncols()], |i, j| self[(i, j)], to),
                }
            }
            fn read<'de, D: Deserializer<'de>>(from: D, name: &'static str) -> Result<Self, D::Error>
            where
                T: Deserialize<'de>,
            {
                let rows = match $is_flat {
                    // A column is a lattice of one column.
                    true => Lattice::column(Vec::<T>::deserialize(from)?),
                    false => lattice(Vec::<Vec<T>>::deserialize(from)?),
                };
                checked(Fit::fit(rows, name))
            }
        }
    )* };
}

saved! {
    [const R: usize, const C: usize] SMatrix<T, R, C>, C == 1;
    [const C: usize] OMatrix<T, Dyn, Const<C>>, C == 1;
    [const R: usize] OMatrix<T, Const<R>, Dyn>, false;
    [] OMatrix<T, Dyn, Dyn>, false;
}

/// The elements of a lattice as nested lists.
struct Levels<'a, T> {
    extents: &'a [usize],
    elements: &'a [T],
}

impl<T: Serialize> Serialize for Levels<'_, T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Some((first, [_, ..])) = self.extents.split_first() else {
            return to.collect_seq(self.elements);
        };
        let (extents, size) = (&self.extents[1..], self.elements.len() / first.max(&1));
        to.collect_seq((0..*first).map(|i| Levels {
            extents,
            elements: &self.elements[i * size..][..size],
        }))
    }
}

macro_rules! nested {
    ($($rank:literal $list:ty;)*) => { $(
        impl<T: Real> Saved for Lattice<T, $rank> {
            type Number = T;
            fn write<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error>
            where
                T: Serialize,
            {
                let (extents, elements) = (&self.extents()[..], self.as_slice());
                Levels { extents, elements }.serialize(to)
            }
            fn read<'de, D: Deserializer<'de>>(from: D, name: &'static str) -> Result<Self, D::Error>
            where
                T: Deserialize<'de>,
            {
                let read = lattice(<$list>::deserialize(from)?);
                checked(even(name, &read))?;
                Ok(read)
            }
        }
    )* };
}

nested! {
    2 Vec<Vec<T>>;
    3 Vec<Vec<Vec<T>>>;
    4 Vec<Vec<Vec<Vec<T>>>>;
}

/// Reads a list of lists with its extents in the type.
///
/// # Errors
/// Those of the deserializer; a list of another length.
pub fn read_axes<'de, const R: usize, A: Axes<R>, D: Deserializer<'de>>(
    from: D,
    name: &'static str,
) -> Result<A, D::Error>
where
    Lattice<A::Number, R>: Saved<Number = A::Number>,
    A::Number: Deserialize<'de>,
{
    checked(A::of_lattice(name, &Saved::read(from, name)?))
}

/// `Serialize` and `Deserialize` of a struct: its generic parameters and their names, its type and name, the types that
/// serde has to know, a check of what is read, and the fields with the kind and type of each.
#[macro_export]
#[doc(hidden)]
macro_rules! __record {
    (
        [$($generics:tt)*] [$($arguments:tt)*] $type:ty, $name:literal, [$($known:ty),*], [$($check:path)?]
        { $($field:ident: $kind:ident $of:ty),* $(,)? }
    ) => {
        const _: () = {
            use $crate::private::serde as __serde;
            #[automatically_derived]
            impl<$($generics)*> __serde::Serialize for $type
            where
                $($known: __serde::Serialize,)*
            {
                fn serialize<__S: __serde::Serializer>(
                    &self,
                    _to: __S,
                ) -> $crate::private::Result<__S::Ok, __S::Error> {
                    const FIELDS: &[&$crate::private::str] = &[$($crate::private::core::stringify!($field)),*];
                    let mut _to = __serde::Serializer::serialize_struct(_to, $name, FIELDS.len())?;
                    $(__serde::ser::SerializeStruct::serialize_field(
                        &mut _to,
                        $crate::private::core::stringify!($field),
                        &$crate::__record!(@write $kind self.$field),
                    )?;)*
                    __serde::ser::SerializeStruct::end(_to)
                }
            }
            #[doc(hidden)]
            pub struct __Read<$($generics)*> {
                $($field: $crate::private::Option<$of>,)*
            }
            #[automatically_derived]
            impl<'de, $($generics)*> $crate::private::Fielded<'de> for $type
            where
                $($known: __serde::Deserialize<'de>,)*
            {
                const NAME: &'static $crate::private::str = $name;
                const FIELDS: &'static [&'static $crate::private::str] =
                    &[$($crate::private::core::stringify!($field)),*];
                type Read = __Read<$($arguments)*>;
                fn nothing() -> Self::Read {
                    __Read { $($field: $crate::private::Option::None),* }
                }
                fn read<__D: __serde::Deserializer<'de>>(
                    _into: &mut Self::Read,
                    _name: &'static $crate::private::str,
                    _from: __D,
                ) -> $crate::private::Result<(), __D::Error> {
                    $(if _name == $crate::private::core::stringify!($field) {
                        if _into.$field.is_some() {
                            return $crate::private::Result::Err(__serde::de::Error::duplicate_field(_name));
                        }
                        _into.$field = $crate::private::Option::Some($crate::__record!(@read $kind $of, _from, _name));
                        return $crate::private::Result::Ok(());
                    })*
                    $crate::private::Result::Err(__serde::de::Error::unknown_field(
                        _name,
                        <Self as $crate::private::Fielded<'de>>::FIELDS,
                    ))
                }
                fn whole<__E: __serde::de::Error>(_read: Self::Read) -> $crate::private::Result<Self, __E> {
                    let _whole = Self {
                        $($field: match _read.$field {
                            $crate::private::Option::Some(_value) => _value,
                            $crate::private::Option::None => {
                                return $crate::private::Result::Err(__E::missing_field(
                                    $crate::private::core::stringify!($field),
                                ));
                            }
                        },)*
                    };
                    $(let _whole = $check(_whole).map_err(__E::custom)?;)?
                    $crate::private::Result::Ok(_whole)
                }
            }
            #[automatically_derived]
            impl<'de, $($generics)*> __serde::Deserialize<'de> for $type
            where
                $($known: __serde::Deserialize<'de>,)*
            {
                fn deserialize<__D: __serde::Deserializer<'de>>(
                    _from: __D,
                ) -> $crate::private::Result<Self, __D::Error> {
                    $crate::private::read_record(_from)
                }
            }
        };
    };
    // Coordinates of mixed shape, the vector of a state.
    (
        vector [$($generics:tt)*] $arguments:tt $type:ty, $name:literal, [$number:ty], $($rest:tt)*
    ) => {
        $crate::__record! { [$($generics)*] $arguments $type, $name, [$number], $($rest)* }
        #[automatically_derived]
        impl<$($generics)*> $crate::private::Saved for $type {
            type Number = $number;
            fn write<__S: $crate::private::serde::Serializer>(
                &self,
                _to: __S,
            ) -> $crate::private::Result<__S::Ok, __S::Error>
            where
                $number: $crate::private::serde::Serialize,
            {
                $crate::private::serde::Serialize::serialize(self, _to)
            }
            fn read<'de, __D: $crate::private::serde::Deserializer<'de>>(
                _from: __D,
                _: &'static $crate::private::str,
            ) -> $crate::private::Result<Self, __D::Error>
            where
                $number: $crate::private::serde::Deserialize<'de>,
            {
                $crate::private::serde::Deserialize::deserialize(_from)
            }
        }
    };
    (@write number $value:expr) => { $value };
    (@write list $value:expr) => { $crate::private::Written(&$value) };
    // Lists of lists with three and four extents in the type.
    (@write three $value:expr) => { $crate::private::Written(&$crate::private::lattice::<_, 3>($value)) };
    (@write four $value:expr) => { $crate::private::Written(&$crate::private::lattice::<_, 4>($value)) };
    (@read three $of:ty, $from:ident, $name:ident) => {
        $crate::private::read_axes::<3, $of, _>($from, $name)?
    };
    (@read four $of:ty, $from:ident, $name:ident) => {
        $crate::private::read_axes::<4, $of, _>($from, $name)?
    };
    (@read number $of:ty, $from:ident, $name:ident) => {
        <$of as $crate::private::serde::Deserialize<'de>>::deserialize($from)?
    };
    (@read list $of:ty, $from:ident, $name:ident) => {
        <$of as $crate::private::Saved>::read($from, $name)?
    };
}

impl<V: Vector> State<V> {
    /// A state whose momenta have the shape of its coordinates.
    fn of_one_shape(self) -> Result<Self, InputError> {
        one_shape(&self.q, &self.p).map(|()| self)
    }
}

impl<V: Vector> Gradient<V> {
    /// A gradient whose parts have one shape.
    fn of_one_shape(self) -> Result<Self, InputError> {
        one_shape(&self.q, &self.p).map(|()| self)
    }
}

/// Checks that two vectors have one shape.
fn one_shape<V: Vector>(q: &V, p: &V) -> Result<(), InputError> {
    (0..V::PARTS).try_for_each(|k| {
        let [expected, found] = [q, p].map(|vector| (vector.extents(k), vector.part(k).len()));
        same_part("p", None, expected, found)
    })
}

__record! {
    [V: Vector + Saved<Number = <V as Vector>::Scalar>] [V] State<V>, "State", [V::Scalar], [Self::of_one_shape]
    { t: number V::Scalar, q: list V, p: list V }
}

__record! {
    [V: Vector + Saved<Number = <V as Vector>::Scalar>] [V] Gradient<V>, "Gradient", [V::Scalar], [Self::of_one_shape]
    { q: list V, p: list V }
}

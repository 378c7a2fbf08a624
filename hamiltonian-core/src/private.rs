//! The only paths that code emitted by `hamiltonian!` names.
//!
//! Input: nothing. Output: re-exports; [`Never`], the type of a structure that a system lacks; [`SetByNew`], a field
//! that only `new` sets; [`window`] and [`columns`], parts of slices; traits whose names and attributes word rustc's
//! messages ([`ArrayOf`], [`ListOf`], [`ParameterWithoutDefault`], [`AnyParameter`]); at the end the macros `__prepared`, `__gathers`,
//! `__computed_as_chosen`, `__each`, `__halves` and `__known`, which shorten emitted code. Invariant: these names may
//! be used by code in a crate that has neither this crate nor its dependencies in scope; if one is removed or renamed,
//! the macro is changed with it.

#[cfg(feature = "serde")]
mod functions;
mod never;
#[cfg(feature = "serde")]
mod record;
mod slices;
#[cfg(feature = "serde")]
mod tables;

pub extern crate alloc;
pub use alloc::borrow::Cow;
pub use alloc::sync::Arc;
pub use core;
pub use core::primitive::{bool, f64, str, usize};
pub use core::{
    clone::Clone, cmp::PartialEq, default::Default, fmt, fmt::Write, marker::Copy, option::Option,
    result::Result,
};

pub use hamiltonian_lanes::{Dual, Mask, Pack, Parameter, Real};
pub use nalgebra::{
    self, ArrayStorage, Const, DVector, Dyn, Matrix, OMatrix, SMatrix, SVector, VecStorage,
};

pub use crate::__record as record;
pub use crate::errors::Error;
pub use crate::flows::emitted::{
    Adds, Damped, DataOf, Drift, Emitted, FieldBody, FieldOf, FlowBody, Halves, Kick, Linear,
    Matrices, Moves, Numbered, OfGradient, Origin, Push, Pushed, Rates, SharedCode, Shift, Shifts,
    Stepped, Whole, WithData, add_field, gradient_by_field, hessian_by_gradient, slopes_by_kick,
    velocities_by_drift,
};
pub use crate::flows::exponential::{Exponential, exponentiate, image, raised};
pub use crate::flows::held::{Given, Held, LaneValue, gathered};
/// For maps of other crates.
pub use crate::flows::narrow::{Varied, fixed};
pub use crate::flows::push::{Coupled, SubStep};
pub use crate::loops::calls::*;
pub use crate::loops::pairs::{TILED, TileRow, Triangle, pairs};
pub use crate::loops::slabs::rows;
pub use crate::loops::stretch::{
    AddedTo, Body, Change, ColumnStore, InRing, LONG, Loop, Mode, Nest, OfStore, STRIDE, nest,
    total, worth, wrapped,
};
pub use crate::schemes::{Gauss, GaussNystrom, ToTolerance};
pub use crate::systems::fit::ListOf;
pub use crate::systems::function::Function;
use crate::systems::lattice::write_indices;
pub use crate::systems::lattice::{
    Lattice, check_extents, check_lattice, check_parameter, fits, lattice,
};
pub use crate::systems::reach::{Reach, product};
pub use crate::systems::state::{Gradient, Plain, Point, State};
pub use crate::systems::system::gather::{InPack, Kept, in_pack};
pub use crate::systems::system::{
    Arithmetic, Autonomous, Description, Dynamics, Exact, Group, NamedPiece, Nystrom, Observable,
    ObservableKind, ParameterText, QuadraticKinetic, Separable, Split, System, Text, Unforced,
    VectorOf, declared_energy_at, deepest,
};
pub use crate::systems::uneven::Uneven;
pub use crate::systems::vector::{IntoVector, Over, Shape, Vector};
pub use crate::{
    __computed_as_chosen as computed_as_chosen, __described as described, __each as each,
    __gathers as gathers, __halves as halves, __known as known, __prepared as prepared,
};
pub use never::Never;
#[cfg(feature = "serde")]
pub use record::{Fielded, Saved, Written, read_axes, read_record};
#[cfg(feature = "serde")]
pub use serde_core as serde;
pub use slices::{columns, columns_mut, columns_of, columns_of_mut};

/// A group of coordinates with its rank, part, offset and columns.
#[must_use]
pub const fn group(
    coordinate: &'static str,
    momentum: &'static str,
    [rank, part, offset, columns]: [usize; 4],
) -> Group {
    Group {
        coordinate: Cow::Borrowed(coordinate),
        momentum: Cow::Borrowed(momentum),
        rank,
        part,
        offset,
        columns,
    }
}

/// A component of an observable.
#[must_use]
pub const fn observable(
    kind: ObservableKind,
    name: &'static str,
    depends_on_time: bool,
    reads: [bool; 2],
) -> Observable {
    Observable {
        name: Cow::Borrowed(name),
        kind,
        depends_on_time,
        reads,
    }
}

/// A piece with its formula.
#[must_use]
pub const fn piece(name: &'static str, formula: &'static str, jumps: bool) -> NamedPiece {
    NamedPiece {
        name: Cow::Borrowed(name),
        formula: Cow::Borrowed(formula),
        jumps,
    }
}

/// `N` values from number `start` on, as an array that a pattern takes apart: rustc checks a
/// pattern in a hundredth of the time it takes to check as many indices. Emitted code knows that
/// the values are there.
#[inline(always)]
#[must_use]
pub fn window<T, const N: usize>(values: &[T], start: usize) -> &[T; N] {
    match values.get(start..).and_then(<[T]>::first_chunk) {
        Some(window) => window,
        None => panic!(
            "{N} values from number {start} on are not among {}",
            values.len()
        ),
    }
}

/// A captured value. A value of another type than those of parameters is an error at its name.
#[inline(always)]
pub fn captured<P: Parameter>(value: P) -> P {
    value
}

/// Writes the elements of a parameter, `m = 0.5`, `m[2] = 1.5` or `K[0][1] = 1.5`, each on a line. The last index of
/// `values` is the fastest.
///
/// # Errors
/// Those of the writer.
pub fn describe_parameter<T: fmt::Debug>(
    out: &mut dyn Write,
    name: &str,
    extents: &[usize],
    values: &[T],
) -> fmt::Result {
    let mut all = values.iter().enumerate();
    // Large arrays are saved: no text is made in between.
    all.try_for_each(|(at, value)| {
        out.write_str(name)?;
        write_indices(out, extents, at)?;
        out.write_str(" = ")?;
        write!(out, "{value:?}")?;
        out.write_str("\n")
    })
}

/// An array that `new` takes in the storage `V` of its parameter if the compiler checks the length. A `new` that returns
/// a `Result` takes a [`ListOf`] the numbers.
///
/// It is a trait of its own for the sake of its message: where the forms of [`IntoVector`] do not lead to
/// `V`, rustc would show the types of both storages.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not fit this parameter",
    label = "expected an array of the declared extents",
    note = "an extent that is a number or a const generic takes an array, `[1.0, 2.0]`; with two extents each element is a row, `[[1.0, 2.0], [3.0, 4.0]]`; a method `with_…` takes slices and `Vec`s too, and returns a `Result`",
    note = "write `1.0` instead of `1`: whole numbers are not converted",
    note = "`new` takes the sizes, then functions, then the parameters without a default, in the order of their declaration"
)]
pub trait ArrayOf<K, V> {
    /// The same numbers in that storage.
    fn into_array(self) -> V;
}

#[diagnostic::do_not_recommend]
impl<K, V: Vector, A: IntoVector<K, Vector = V>> ArrayOf<K, V> for A {
    #[inline]
    fn into_array(self) -> V {
        self.into_vector()
    }
}

/// A system without a `new`, since nothing must be given: `Name::new(…)` leads to a message.
///
/// The bound of its implementations, [`ParameterWithoutDefault`] or [`AnyParameter`], holds for no system. So a type
/// may have a `new` of its own, and one from a trait of the user's.
#[doc(hidden)]
pub trait EveryParameterHasADefault: Sized {
    /// Never called.
    fn new() -> Self {
        unreachable!("no system meets the bound")
    }
}

/// The bound of [`EveryParameterHasADefault`], which no system meets.
///
/// For `Name::<f64>::new` rustc shows the message. For `Name::new`, whose scalar is open, it shows the line of the
/// declaration instead, which therefore has a comment.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no `new`: each of its parameters has a default",
    label = "there is no `new`",
    note = "write `{Self} {{ parameter: 2.0, ..Default::default() }}` to change some parameters, `{Self}::default()` to change none"
)]
#[rustfmt::skip]
pub trait ParameterWithoutDefault: Sized { // Without `new`: `Name { parameter: 2.0, ..Default::default() }`
}

/// The bound of [`EveryParameterHasADefault`] for a system without parameters. The lifetime lets it stand on a type
/// without generic parameters.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no `new`: it has no parameters",
    label = "there is no `new`",
    note = "write `{Self} {{}}` or `{Self}::default()`"
)]
#[rustfmt::skip]
pub trait AnyParameter<'a>: Sized { // Without `new`: `Name {}`
}

/// A field that only the `new` of its type sets: a size, or an array that has it. The module of the
/// definition can read it too, and not replace it, so lengths that `new` checked stay right.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub struct SetByNew<X>(X);

impl<X> SetByNew<X> {
    /// The field.
    pub fn new(value: X) -> Self {
        SetByNew(value)
    }
}

impl<X> core::ops::Deref for SetByNew<X> {
    type Target = X;
    #[inline(always)]
    fn deref(&self) -> &X {
        &self.0
    }
}

impl<X: fmt::Debug> fmt::Debug for SetByNew<X> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

// A constant of the user's may have the name of a variable, which would then be a pattern: variables begin with `_`.

/// `Serialize` and `Deserialize` of a struct: nothing without the feature `serde`.
#[cfg(not(feature = "serde"))]
#[macro_export]
#[doc(hidden)]
macro_rules! __record {
    ($($tokens:tt)*) => {};
}

/// Declares a prepared system, a struct around the held values.
#[macro_export]
#[doc(hidden)]
macro_rules! __prepared {
    ([$visibility:vis struct $name:ident] [$($generics:tt)*] [$($arguments:tt)*] $data:ty; $($counts:literal),*) => {
        #[doc(hidden)]
        #[derive($crate::private::Clone, $crate::private::fmt::Debug)]
        $visibility struct $name $($generics)* ($crate::private::Held<T, $($counts,)* $data>);
        #[automatically_derived]
        impl $($generics)* $crate::private::WithData<T> for $name<$($arguments)* T> {
            type Data = $data;
            #[inline(always)]
            fn data(&self) -> &Self::Data {
                &self.0.data
            }
        }
    };
}

/// The field of a kind, and the methods of a prepared system whose data begins with how it is computed, in lanes where
/// there are some. The derivative by time of an H that does not depend on it is 0. A gradient that is not written out
/// comes from the kick and the drift, or from the field, and the Hessian from that gradient over dual numbers.
#[macro_export]
#[doc(hidden)]
macro_rules! __computed_as_chosen {
    (@timeless $scalar:ident $system:ty) => {
        #[inline(always)]
        fn time_derivative(&self, _: $scalar, _: &Self::Vector, _: &Self::Vector) -> $scalar {
            <$scalar as $crate::private::Real>::constant(0.0, 0.0)
        }
    };
    (@gradient_by_halves $scalar:ident $system:ty) => {
        #[inline(always)]
        fn gradient_q(&self, _t: $scalar, _q: &Self::Vector, _: &Self::Vector, _out: &mut Self::Vector) {
            $crate::private::slopes_by_kick(self, _t, _q, _out);
        }
        #[inline(always)]
        fn gradient_p(&self, _t: $scalar, _: &Self::Vector, _p: &Self::Vector, _out: &mut Self::Vector) {
            $crate::private::velocities_by_drift(self, _t, _p, _out);
        }
    };
    (@gradient_by_field $scalar:ident $system:ty) => {
        #[inline(always)]
        fn gradient(
            &self, _t: $scalar, _q: &Self::Vector, _p: &Self::Vector, _by_q: &mut Self::Vector, _by_p: &mut Self::Vector,
        ) {
            $crate::private::gradient_by_field(self, _t, [_q, _p], [_by_q, _by_p]);
        }
        #[inline(always)]
        fn gradient_q(&self, _t: $scalar, _q: &Self::Vector, _p: &Self::Vector, _out: &mut Self::Vector) {
            self.gradient(_t, _q, _p, _out, &mut $crate::private::Vector::zeros_like(_p));
        }
        #[inline(always)]
        fn gradient_p(&self, _t: $scalar, _q: &Self::Vector, _p: &Self::Vector, _out: &mut Self::Vector) {
            self.gradient(_t, _q, _p, &mut $crate::private::Vector::zeros_like(_q), _out);
        }
    };
    (@hessian_by_gradient $scalar:ident $system:ty) => {
        #[inline(always)]
        fn hessian_vector(
            &self, _t: $scalar, _q: &Self::Vector, _p: &Self::Vector, _vq: &Self::Vector, _vp: &Self::Vector,
            _oq: &mut Self::Vector, _op: &mut Self::Vector,
        ) {
            let _lifted: <$system as $crate::private::System>::Prepared<$crate::private::Varied<$scalar>> =
                __Prepared($crate::private::LaneValue::<$scalar>::lifted(&self.0));
            $crate::private::hessian_by_gradient(&_lifted, _t, [_q, _p], [_vq, _vp], [_oq, _op]);
        }
    };
    ($scalar:ident of $system:ty, $field:ty $(, $more:ident)*) => {
        $($crate::__computed_as_chosen! { @$more $scalar $system })*
        type Field = $crate::private::FieldOf<Self, $field, $scalar>;
        #[inline(always)]
        fn description(&self) -> &$crate::private::Description {
            __DESCRIPTION
        }
        #[inline(always)]
        fn field(&self, _c: $scalar) -> Self::Field {
            Self::Field::fold(self, _c)
        }
        #[inline(always)]
        fn add_field(
            &self, _c: $scalar, _t: $scalar, _q: &Self::Vector, _p: &Self::Vector, _into_q: &mut Self::Vector,
            _into_p: &mut Self::Vector,
        ) {
            let _held = $crate::private::FieldBody::<$field, $scalar>::fold(self, _c);
            let _data = $crate::private::WithData::data(self);
            $crate::private::add_field::<$field, $scalar, Self>(&_held, _data, _t, [_q, _p], [_into_q, _into_p]);
        }
        #[inline(always)]
        fn arithmetic(&self) -> $crate::private::Arithmetic {
            self.0.data.0
        }
        fn set_arithmetic(&mut self, _to: $crate::private::Arithmetic) {
            self.0.data.0 = _to;
        }
        #[inline(always)]
        fn in_pack<
            __P: $crate::private::Pack,
            __K: $crate::private::InPack<$scalar, Self::Vector, __P>,
        >(
            &self,
            _kept: &mut $crate::private::Kept,
            _kernel: __K,
        ) -> $crate::private::Option<__K::Output> {
            $crate::private::in_pack::<$scalar, $system, __P, __K>(self, _kept, _kernel)
        }
    };
}

/// The description of a system, the constant `__DESCRIPTION`. Lists are constants of their own, since their elements
/// have destructors.
#[macro_export]
#[doc(hidden)]
macro_rules! __described {
    (
        $name:literal, $formula:literal, $is_forced:literal, $is_autonomous:literal, $growth:expr, $jumps:expr, $time:expr;
        [$($group:expr),*] [$($observable:expr),*] [$($cyclic:literal),*] [$($piece:expr),*]
    ) => {
        const __DESCRIPTION: &$crate::private::Description = {
            const GROUPS: &[$crate::private::Group] = &[$($group),*];
            const OBSERVABLES: &[$crate::private::Observable] = &[$($observable),*];
            const CYCLIC: &[$crate::private::Text] = &[$($crate::private::Cow::Borrowed($cyclic)),*];
            const PIECES: &[$crate::private::NamedPiece] = &[$($piece),*];
            &$crate::private::Description {
                name: $crate::private::Cow::Borrowed($name),
                formula: $crate::private::Cow::Borrowed($formula),
                groups: $crate::private::Cow::Borrowed(GROUPS),
                observables: $crate::private::Cow::Borrowed(OBSERVABLES),
                cyclic: $crate::private::Cow::Borrowed(CYCLIC),
                pieces: $crate::private::Cow::Borrowed(PIECES),
                fictitious_time: $time,
                is_forced: $is_forced,
                is_autonomous: $is_autonomous,
                growth: $growth,
                jumps: $jumps,
                missing: $crate::private::Cow::Borrowed(&[]),
            }
        };
    };
}

/// The type of what a system prepares, its description, and its placement in lanes.
#[macro_export]
#[doc(hidden)]
macro_rules! __gathers {
    ($prepared:ident $($arguments:tt)*) => {
        type Prepared<T: $crate::private::Real> = $prepared $($arguments)*;
        const JUMPS: $crate::private::Option<[$crate::private::bool; 2]> =
            $crate::private::Option::Some(__DESCRIPTION.jumps);
        #[inline(always)]
        fn description(&self) -> &$crate::private::Description {
            __DESCRIPTION
        }
        #[inline(always)]
        fn gather<T: $crate::private::Real, __P: $crate::private::Pack>(
            _of: &[&Self::Prepared<T>],
        ) -> Self::Prepared<T::Over<__P>> {
            $prepared($crate::private::gathered::<T, __P, _, _>(_of, |_one| &_one.0))
        }
        fn fits<T: $crate::private::Real>(
            _a: &Self::Prepared<T>,
            _b: &Self::Prepared<T>,
        ) -> $crate::private::bool {
            $crate::private::LaneValue::<T>::fits(&_a.0, &_b.0)
        }
        fn equals<T: $crate::private::Real>(
            _a: &Self::Prepared<T>,
            _b: &Self::Prepared<T>,
        ) -> $crate::private::bool {
            $crate::private::LaneValue::<T>::fits(&_a.0, &_b.0)
                && $crate::private::LaneValue::<T>::equals(&_a.0, &_b.0)
        }
    };
}

/// The values of one function at several points.
#[macro_export]
#[doc(hidden)]
macro_rules! __each {
    ($scalar:ident, $name:ident $function:ident $written_out:literal: $($x:expr),*) => {
        if const { $crate::private::are_together::<$scalar, $crate::private::$name>([$(stringify!($x)),*].len()) } {
            $crate::private::together::<$scalar, $crate::private::$name, _, $written_out>([$($x),*])
        } else {
            [$($x.$function()),*]
        }
    };
}

/// The structures of a system that its kick and its drift make up.
#[macro_export]
#[doc(hidden)]
macro_rules! __halves {
    ($impl:tt $system:ty, $prepared:ty, $kick:ty: $($structure:ident)*) => {
        $($crate::__halves! { @$structure $impl $system, $crate::private::Emitted<$prepared, $kick>,
        $crate::private::Emitted<$prepared, $crate::private::Shifts<$crate::private::Drift>> })*
    };
    (@Separable [$($impl:tt)*] $system:ty, $kick:ty, $drift:ty) => {
        $($impl)* $crate::private::Separable for $system {
            type Kick<T: $crate::private::Real> = $kick;
            #[inline(always)]
            fn kick<T: $crate::private::Real>() -> $kick {
                $crate::private::Emitted::PIECE
            }
            type Drift<T: $crate::private::Real> = $drift;
            #[inline(always)]
            fn drift<T: $crate::private::Real>() -> $drift {
                $crate::private::Emitted::PIECE
            }
        }
    };
    // A piece that jumps in time is not first.
    (@DriftFirst $impl:tt $system:ty, $kick:ty, $drift:ty) => {
        $crate::__halves! { @Split $impl $system, $drift, $kick }
    };
    (@Split [$($impl:tt)*] $system:ty, $first:ty, $second:ty) => {
        $($impl)* $crate::private::Split for $system {
            type Pieces<T: $crate::private::Real> = ($first, $second);
            #[inline(always)]
            fn pieces<T: $crate::private::Real>() -> Self::Pieces<T> {
                ($crate::private::Emitted::PIECE, $crate::private::Emitted::PIECE)
            }
        }
    };
    (@Nystrom [$($impl:tt)*] $system:ty, $kick:ty, $drift:ty) => {
        $($impl)* $crate::private::Nystrom for $system {
            type Kick<T: $crate::private::Real> = $kick;
            #[inline(always)]
            fn kick<T: $crate::private::Real>() -> $kick {
                $crate::private::Emitted::PIECE
            }
            type Quadratic<T: $crate::private::Real> = $drift;
            #[inline(always)]
            fn quadratic<T: $crate::private::Real>() -> $drift {
                $crate::private::Emitted::PIECE
            }
        }
    };
}

/// The formula of H as `Display`, markers that hold without more to be said, and in item form the texts of the type and
/// its `Default`. A bound that no system meets instead of a marker is that of `new`, which then does not exist.
#[macro_export]
#[doc(hidden)]
macro_rules! __known {
    (@texts) => {};
    (@ [$($impl:tt)*] $system:ty: ParameterWithoutDefault) => {
        $($impl)* $crate::private::EveryParameterHasADefault for $system
        where $system: $crate::private::ParameterWithoutDefault {}
    };
    (@ [$($impl:tt)*] $system:ty: AnyParameter) => {
        $($impl)* $crate::private::EveryParameterHasADefault for $system
        where for<'a> $system: $crate::private::AnyParameter<'a> {}
    };
    (@ [$($impl:tt)*] $system:ty: $marker:ident) => {
        $($impl)* $crate::private::$marker for $system {}
    };
    (@ [$($impl:tt)*] $system:ty, $formula:literal) => {
        #[automatically_derived]
        $($impl)* $crate::private::fmt::Display for $system {
            fn fmt(&self, _f: &mut $crate::private::fmt::Formatter<'_>) -> $crate::private::fmt::Result {
                _f.write_str($formula)
            }
        }
    };
    (@texts $visibility:vis [$($impl:tt)*] $system:ty: $latex:literal, $equations:literal = $default:expr) => {
        $crate::__known! { @texts $visibility [$($impl)*] $system: $latex, $equations }
        #[automatically_derived]
        $($impl)* $crate::private::Default for $system {
            fn default() -> Self {
                $default
            }
        }
    };
    (@texts $visibility:vis [$($impl:tt)*] $system:ty: $latex:literal, $equations:literal $($names:ident)? ? $missing:ident) => {
        $crate::__known! { @texts $visibility [$($impl)*] $system: $latex, $equations $($names)? }
        #[automatically_derived]
        $($impl)* $crate::private::Default for $system
        where for<'a> &'a $system: $missing {
            fn default() -> Self {
                $crate::private::core::unreachable!("no system meets the bound")
            }
        }
    };
    // Over `f64`: nothing in the paths of these constants would tell the scalar.
    (@texts $visibility:vis [$($impl:tt)*] $system:ty: $latex:literal, $equations:literal) => {
        $($impl)* $system {
            /// H in LaTeX.
            $visibility const LATEX: &'static $crate::private::str = $latex;
            /// Hamilton's equations in LaTeX, one a line.
            $visibility const LATEX_EQUATIONS: &'static $crate::private::str = $equations;
        }
    };
    ($impl:tt $system:ty: $formula:literal; $($marker:ident)*; $($texts:tt)*) => {
        $crate::__known! { @ $impl $system, $formula }
        $($crate::__known! { @ $impl $system: $marker })*
        $crate::__known! { @texts $($texts)* }
    };
}

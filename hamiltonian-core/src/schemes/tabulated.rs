//! Splittings of higher order: one type for each table of coefficients.
//!
//! Input: a system with exact flows of its pieces. Output: `Yoshida4` and similar schemes on every
//! [`Split`] system; `Srkn6b` and similar ones on every [`Nystrom`] system; `Saba2` and similar
//! ones for a small second piece. Invariant: a type is its table, from `tables`, and the pieces
//! that it moves; the loop is [`Zigzag`]'s.

use super::composition::Composition;
use super::splitting::{Durations, Reversed, Splitting};
use super::tables::{Coefficients, general, near_integrable, nystrom};
use super::zigzag::{Zigzag, ZigzagOf};
use crate::flows::map::{Map, Step};
use crate::schemes::scheme::{Entry, Form, Listed, Needs, OneStep, Scheme, Symmetric};
use crate::systems::state::{Point, State};
use crate::systems::system::{Description, Exact, Nystrom, Split, VectorOf};
use hamiltonian_lanes::Real;

/// The line of a table in the catalogue.
fn entry<const S: usize>(name: &'static str, table: &Coefficients<S>, needs: Needs) -> Entry {
    Entry {
        name,
        variant: "",
        equations: "",
        order: table.order,
        duration: 1,
        needs,
        preserves: Form::OnePoint,
        source: table.source,
    }
}

/// The type `$name` of the table `$table` with its entry, which is `symmetric` or has the `reversed` table as its
/// adjoint.
macro_rules! tabulated {
    ($(#[$doc:meta])* $name:ident: $table:path, $stages:literal, $needs:expr, $adjoint:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
        pub struct $name;

        impl Listed for $name {
            fn entry(&self) -> Entry {
                entry(stringify!($name), &$table, $needs)
            }
        }

        impl Splitting for $name {
            type Of<U> = [U; $stages];
            #[cfg_attr(not(unoptimised), inline(always))]
            fn stages(&self) -> [Durations; $stages] {
                $table.stages
            }
            #[cfg_attr(not(unoptimised), inline(always))]
            fn filled<U: Clone>(&self, value: U) -> [U; $stages] {
                core::array::from_fn(|_| value.clone())
            }
        }

        tabulated!(adjoint $name $adjoint);
    };
    (adjoint $name:ident symmetric) => {
        symmetric!($name);
    };
    (adjoint $name:ident reversed) => {
        impl OneStep for $name {
            type Adjoint = Reversed<$name>;
            fn adjoint(&self) -> Reversed<$name> {
                Reversed(*self)
            }
        }
    };
}

/// The methods of a scheme that applies its table to `$pieces`.
macro_rules! on_pieces {
    ($pieces:expr, $of:ident, $jumping:expr) => {
        fn times_of_jumps(&self, $of: &Description) -> [f64; 2] {
            self.times_on($jumping)
        }
        #[cfg_attr(not(unoptimised), inline(always))]
        fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
            Zigzag::new(self, &$pieces, prepared, step)
        }
        #[cfg_attr(not(unoptimised), inline(always))]
        fn step<T: Real>(
            &self,
            prepared: &S::Prepared<T>,
            h: T,
            ends: [T; 2],
            z: &mut Point<VectorOf<S, T>>,
            work: &mut <Self::Map<T> as Map>::Work,
        ) {
            Zigzag::once(self, &$pieces, prepared, h, ends, z, work);
        }
        fn start<T: Real>(
            &self,
            _: &S::Prepared<T>,
            state: &State<VectorOf<S, T>>,
            _: T,
        ) -> Point<VectorOf<S, T>> {
            state.point()
        }
    };
}

/// The scheme of a table on the pieces of any splitting.
macro_rules! on_exact_pieces {
    ($name:ty) => {
        impl<S: Split + Exact> Scheme<S> for $name {
            type Carried = Point<S::Shape>;
            type Map<T: Real> = ZigzagOf<T, S, S::Pieces<T>, Self>;
            on_pieces!(S::pieces::<T>(), of, of.jumping_pieces());
        }
    };
}

macro_rules! general {
    ($($(#[$doc:meta])* $name:ident: $table:path, $stages:literal, $adjoint:ident;)+) => {$(
        tabulated! {
            $(#[$doc])*
            ///
            /// Each stage goes through the pieces 1 … k for `down` and back for `up`; on pieces with exact
            /// flows it is explicit. Preserves dq∧dp.
            ///
            /// ```
            #[doc = include_str!("../doc/oscillator.md")]
            #[doc = concat!("use hamiltonian::schemes::", stringify!($name), ";")]
            ///
            /// let start = State::new([1.0], [0.0]);
            #[doc = concat!("let mut run = Integrator::new(&Oscillator {}, ", stringify!($name), ", start, 0.05)?;")]
            /// assert!((run.advance(20)?.q[0] - 1.0_f64.cos()).abs() < 1e-5);
            /// # Ok::<(), Error>(())
            /// ```
            $name: $table, $stages, Needs::SPLIT.and(Needs::EXACT), $adjoint
        }
        on_exact_pieces!($name);
    )+};
}

on_exact_pieces!(Reversed<Ruth3>);

/// Compositions of any symmetric scheme by the weights of a table for symmetric maps.
macro_rules! of_symmetric {
    ($($name:ident: $table:path, $stages:literal;)+) => {$(
        impl $name {
            /// Steps of the sizes γ of any symmetric scheme of order 2: a scheme of the order of
            /// the table. A scheme that is not [`Symmetric`] is refused.
            ///
            /// ```
            #[doc = include_str!("../doc/oscillator.md")]
            #[doc = concat!("use hamiltonian::schemes::", stringify!($name), ";")]
            ///
            #[doc = concat!("let scheme = ", stringify!($name), ".of(ImplicitMidpoint::default());")]
            /// let mut run = Integrator::new(&Oscillator {}, scheme, State::new([1.0], [0.0]), 0.05)?;
            /// assert!((run.advance(20)?.q[0] - 1.0_f64.cos()).abs() < 1e-6);
            /// # Ok::<(), Error>(())
            /// ```
            pub fn of<M: Symmetric>(self, scheme: M) -> Composition<M, $stages> {
                Composition::of_table(scheme, &$table, stringify!($name))
            }
        }
    )+};
}

of_symmetric! {
    Yoshida4: general::YOSHIDA_4, 3;
    Suzuki4: general::SUZUKI_4, 5;
    Yoshida6: general::YOSHIDA_6, 7;
    KahanLi6: general::KAHAN_LI_6, 9;
    McLachlan8: general::MCLACHLAN_8, 15;
    KahanLi8: general::KAHAN_LI_8, 17;
    SofroniouSpaletta8: general::SOFRONIOU_SPALETTA_8, 21;
    SofroniouSpaletta10: general::SOFRONIOU_SPALETTA_10, 35;
}

general! {
    /// Ruth's scheme: order 3 with 3 stages, not symmetric.
    ///
    /// Source: R. D. Ruth, IEEE Trans. Nucl. Sci. 30 (1983) 2669, doi:10.1109/TNS.1983.4332919.
    Ruth3: general::RUTH_3, 3, reversed;
    /// The triple jump, the scheme of Forest and Ruth: order 4 with 3 stages.
    ///
    /// Steps γ₁h, γ₂h, γ₁h of Strang's splitting with γ₁ = 1/(2 − ∛2) and γ₂ = 1 − 2γ₁. Its errors
    /// are large; [`Suzuki4`] and [`BlanesMoan4`] are more accurate with as many flows.
    ///
    /// Source: H. Yoshida, Phys. Lett. A 150 (1990) 262, doi:10.1016/0375-9601(90)90092-3; E. Forest,
    /// R. D. Ruth, Physica D 43 (1990) 105, doi:10.1016/0167-2789(90)90019-L.
    Yoshida4: general::YOSHIDA_4, 3, symmetric;
    /// Suzuki's composition: order 4 with 5 stages.
    ///
    /// Steps γ₁h, γ₁h, γ₃h, γ₁h, γ₁h of Strang's splitting with γ₁ = 1/(4 − ∛4) and γ₃ = 1 − 4γ₁.
    ///
    /// Source: M. Suzuki, Phys. Lett. A 146 (1990) 319, doi:10.1016/0375-9601(90)90962-N.
    Suzuki4: general::SUZUKI_4, 5, symmetric;
    /// Blanes and Moan's S6: order 4 with 6 stages, the most accurate of order 4 here.
    ///
    /// Source: S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313,
    /// doi:10.1016/S0377-0427(01)00492-7.
    BlanesMoan4: general::BLANES_MOAN_4, 6, symmetric;
    /// Blanes and Moan's S10: order 6 with 10 stages, the most accurate of order 6 here.
    ///
    /// Source: S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313,
    /// doi:10.1016/S0377-0427(01)00492-7.
    BlanesMoan6: general::BLANES_MOAN_6, 10, symmetric;
    /// Yoshida's solution A: order 6 with 7 stages, the smallest number.
    ///
    /// Source: H. Yoshida, Phys. Lett. A 150 (1990) 262, doi:10.1016/0375-9601(90)90092-3.
    Yoshida6: general::YOSHIDA_6, 7, symmetric;
    /// Kahan and Li's composition: order 6 with 9 stages.
    ///
    /// Source: W. Kahan, R.-C. Li, Math. Comp. 66 (1997) 1089, doi:10.1090/S0025-5718-97-00873-9.
    KahanLi6: general::KAHAN_LI_6, 9, symmetric;
    /// Order 8 with 15 stages, the smallest number.
    ///
    /// Source: R. I. McLachlan, SIAM J. Sci. Comput. 16 (1995) 151, doi:10.1137/0916010.
    McLachlan8: general::MCLACHLAN_8, 15, symmetric;
    /// Kahan and Li's composition: order 8 with 17 stages.
    ///
    /// Source: W. Kahan, R.-C. Li, Math. Comp. 66 (1997) 1089, doi:10.1090/S0025-5718-97-00873-9.
    KahanLi8: general::KAHAN_LI_8, 17, symmetric;
    /// Sofroniou and Spaletta's composition: order 8 with 21 stages.
    ///
    /// Source: M. Sofroniou, G. Spaletta, Optim. Methods Softw. 20 (2005) 597,
    /// doi:10.1080/10556780500140664.
    SofroniouSpaletta8: general::SOFRONIOU_SPALETTA_8, 21, symmetric;
    /// Sofroniou and Spaletta's composition: order 10 with 35 stages.
    ///
    /// Source: M. Sofroniou, G. Spaletta, Optim. Methods Softw. 20 (2005) 597,
    /// doi:10.1080/10556780500140664.
    SofroniouSpaletta10: general::SOFRONIOU_SPALETTA_10, 35, symmetric;
}

/// `first` and `second` are the constants of [`Nystrom`] for the two pieces.
macro_rules! nystrom {
    (@jumping kick $of:ident) => {
        $of.jumps
    };
    (@jumping quadratic $of:ident) => {
        [$of.jumps[1], $of.jumps[0]]
    };
    ($($(#[$doc:meta])* $name:ident: $table:path, $stages:literal,
       $first:ident $first_piece:ident, $second:ident $second_piece:ident;)+) => {$(
        tabulated! {
            $(#[$doc])*
            ///
            /// Of Nyström type: it asks for H = A(q, p) + V(q, t), A at most quadratic in p and with an exact
            /// flow. Preserves dq∧dp.
            ///
            /// ```
            #[doc = include_str!("../doc/oscillator.md")]
            #[doc = concat!("use hamiltonian::schemes::", stringify!($name), ";")]
            ///
            /// let start = State::new([1.0], [0.0]);
            #[doc = concat!("let mut run = Integrator::new(&Oscillator {}, ", stringify!($name), ", start, 0.05)?;")]
            /// assert!((run.advance(20)?.q[0] - 1.0_f64.cos()).abs() < 1e-8);
            /// # Ok::<(), Error>(())
            /// ```
            $name: $table, $stages, Needs::NYSTROM, symmetric
        }

        impl<S: Nystrom> Scheme<S> for $name {
            type Carried = Point<S::Shape>;
            type Map<T: Real> = ZigzagOf<T, S, (S::$first_piece<T>, S::$second_piece<T>), Self>;
            on_pieces!((S::$first::<T>(), S::$second::<T>()), of, nystrom!(@jumping $first of));
        }
    )+};
}

nystrom! {
    /// Blanes and Moan's SRKN₆ᵇ: order 4 with 6 kicks.
    ///
    /// Source: S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313,
    /// doi:10.1016/S0377-0427(01)00492-7.
    Srkn6b: nystrom::SRKN_6B, 6, kick Kick, quadratic Quadratic;
    /// Blanes and Moan's SRKN₁₁ᵇ: order 6 with 11 kicks.
    ///
    /// Source: S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313,
    /// doi:10.1016/S0377-0427(01)00492-7.
    Srkn11b: nystrom::SRKN_11B, 11, kick Kick, quadratic Quadratic;
    /// Blanes and Moan's SRKN₁₄ᵃ: order 6 with 14 kicks.
    ///
    /// Source: S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313,
    /// doi:10.1016/S0377-0427(01)00492-7.
    Srkn14a: nystrom::SRKN_14A, 14, quadratic Quadratic, kick Kick;
    /// The scheme of Blanes, Casas and Escorihuela-Tomàs: order 8 with 19 kicks.
    ///
    /// Source: S. Blanes, F. Casas, A. Escorihuela-Tomàs, Appl. Numer. Math. 182 (2022) 14,
    /// doi:10.1016/j.apnum.2022.07.010.
    BlanesCasasEscorihuela8: nystrom::BLANES_CASAS_ESCORIHUELA_8, 19, quadratic Quadratic, kick Kick;
}

macro_rules! near_integrable {
    ($($(#[$doc:meta])* $name:ident: $table:path, $stages:literal;)+) => {$(
        tabulated! {
            $(#[$doc])*
            ///
            /// For H = A + εB with a small ε, A the first piece of `split { A = …; B = …; }`; without a
            /// small piece it is a scheme of the order in its entry. Preserves dq∧dp.
            ///
            /// ```
            #[doc = include_str!("../doc/oscillator.md")]
            #[doc = concat!("use hamiltonian::schemes::", stringify!($name), ";")]
            ///
            /// let start = State::new([1.0], [0.0]);
            #[doc = concat!("let mut run = Integrator::new(&Oscillator {}, ", stringify!($name), ", start, 0.05)?;")]
            /// assert!((run.advance(20)?.q[0] - 1.0_f64.cos()).abs() < 1e-4);
            /// # Ok::<(), Error>(())
            /// ```
            $name: $table, $stages, Needs::SPLIT.and(Needs::EXACT), symmetric
        }
        on_exact_pieces!($name);
    )+};
}

near_integrable! {
    /// Laskar and Robutel's SABA₂: error O(εh⁴ + ε²h²), 2 flows of B.
    ///
    /// Source: J. Laskar, P. Robutel, Celest. Mech. Dyn. Astron. 80 (2001) 39,
    /// doi:10.1023/A:1012098603882.
    Saba2: near_integrable::SABA_2, 2;
    /// Laskar and Robutel's SABA₃: error O(εh⁶ + ε²h²), 3 flows of B.
    ///
    /// Source: J. Laskar, P. Robutel, Celest. Mech. Dyn. Astron. 80 (2001) 39,
    /// doi:10.1023/A:1012098603882.
    Saba3: near_integrable::SABA_3, 3;
    /// Laskar and Robutel's SABA₄: error O(εh⁸ + ε²h²), 4 flows of B.
    ///
    /// Source: J. Laskar, P. Robutel, Celest. Mech. Dyn. Astron. 80 (2001) 39,
    /// doi:10.1023/A:1012098603882.
    Saba4: near_integrable::SABA_4, 4;
    /// ABA(10,4): error O(εh¹⁰ + ε²h⁴), 7 flows of B.
    ///
    /// Source: S. Blanes, F. Casas, A. Farrés, J. Laskar, J. Makazaga, A. Murua, Appl. Numer. Math. 68
    /// (2013) 58, doi:10.1016/j.apnum.2013.01.003.
    Aba104: near_integrable::ABA_104, 7;
    /// ABA(8,6,4): error O(εh⁸ + ε²h⁶ + ε³h⁴), 7 flows of B.
    ///
    /// Source: S. Blanes, F. Casas, A. Farrés, J. Laskar, J. Makazaga, A. Murua, Appl. Numer. Math. 68
    /// (2013) 58, doi:10.1016/j.apnum.2013.01.003.
    Aba864: near_integrable::ABA_864, 7;
    /// ABA(10,6,4): error O(εh¹⁰ + ε²h⁶ + ε³h⁴), 8 flows of B.
    ///
    /// Source: S. Blanes, F. Casas, A. Farrés, J. Laskar, J. Makazaga, A. Murua, Appl. Numer. Math. 68
    /// (2013) 58, doi:10.1016/j.apnum.2013.01.003.
    Aba1064: near_integrable::ABA_1064, 8;
}

//! The operation table: one row for each elementary function.
//!
//! Input: nothing. Output: [`Op`] with its name, parity, value at zero, LaTeX, regularity, derivative and
//! evaluation by the method of `Real` of that name. Parser, differentiation, printing, proofs and emission read
//! this table. Error bounds (`ball`), normal forms (`normal_form/functions`) and domain errors of the language
//! (`lower/domain`) match on [`Op`] themselves; a function that they do not list has an infinite error bound,
//! no identities of its own and no domain errors. Invariant: a row without one of its columns does not compile.

use super::{Dag, Node};
use crate::rational::Rational;
use hamiltonian_real::{OfNumbers, Real};

/// The parity of a function.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Parity {
    /// f(−x) = f(x)
    Even,
    /// f(−x) = −f(x)
    Odd,
    /// Neither.
    None,
}

/// The sign of a function's values, wherever it has one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ValueSign {
    /// Either sign.
    Any,
    /// f ≥ 0.
    NonNegative,
    /// f > 0.
    Positive,
    /// f ≥ 0 where the first argument is ≥ 0.
    OfBase,
}

/// A set of arguments at which a function is not analytic or not finite.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum SingularSet {
    /// x = 0
    Zero,
    /// x = 1
    One,
    /// x = −1
    MinusOne,
    /// x = 1 and x = −1
    PlusMinusOne,
    /// cos x = 0
    Cosine,
    /// x = y
    Equal,
    /// x = 0 and y = 0
    Origin,
    /// The negative half of an axis: y = 0, x ≤ 0.
    Cut,
    /// x is whole.
    Whole,
    /// x − ½ is whole.
    HalfWhole,
    /// x is a multiple of y, or y = 0.
    Multiple,
    /// x − y/2 is a multiple of y, or y = 0.
    HalfMultiple,
}

/// The set at which a function is not analytic though it has a value there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Break {
    /// Nowhere.
    Nowhere,
    /// It is continuous there.
    Kink(SingularSet),
    /// It is not continuous there.
    Jump(SingularSet),
}

/// The limit of a function as its argument grows beyond all bounds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Far {
    /// |f| → ∞ for both signs of the argument (for the one it is defined for).
    Infinite,
    /// A limit for each sign of the argument, and not the same.
    Limits,
    /// A limit for one sign of the argument, |f| → ∞ for the other.
    Mixed,
    /// Nothing, or it is not defined there.
    Nothing,
}

/// The domain of a function, poles aside.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NaturalDomain {
    /// Everywhere.
    All,
    /// x ≥ the number.
    From(i8),
    /// |x| ≤ 1
    UnitInterval,
    /// x ≥ 0, or y whole.
    Power,
}

/// The regularity of a function of real arguments.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Regularity {
    /// Its domain.
    pub domain: NaturalDomain,
    /// The sign of its values.
    pub range: ValueSign,
    /// The set at which it is not analytic.
    pub breaks: Break,
    /// The finite arguments at which |f| → ∞.
    pub pole: Option<SingularSet>,
    /// Its limit at infinity.
    pub far: Far,
    /// True if it is one analytic function of all complex numbers, poles aside.
    pub is_entire: bool,
}

/// Derivatives with respect to each argument: from the arena, the arguments and the value itself.
type Partials = fn(&mut Dag, &[Node], Node) -> Vec<Node>;

/// A row of the table.
#[derive(Debug)]
pub struct OpRow {
    /// The name in the language, which is also the method of `Real`.
    pub name: &'static str,
    /// Its arguments as they are written: `atan2(y, x)`.
    pub arguments: &'static [&'static str],
    /// Its parity.
    pub parity: Parity,
    /// Its exact value at 0 where that is an integer.
    pub at_zero: Option<i64>,
    /// Its name in LaTeX.
    pub latex: &'static str,
    /// Its regularity.
    pub regularity: Regularity,
    /// Its partial derivatives.
    pub partials: Partials,
}

macro_rules! operations {
    ($($variant:ident $name:ident($($arg:ident),+) $parity:ident $zero:expr, $latex:literal, [$($regularity:tt)+], |$d:ident, $x:ident, $f:ident| $partials:expr;)+) => {
        /// An elementary function.
        #[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
        #[repr(u8)]
        pub enum Op {
            $(#[doc = concat!("`", stringify!($name), "`")] $variant,)+
        }

        /// All rows, in the order of [`Op`].
        pub static TABLE: &[OpRow] = &[$(OpRow {
            name: stringify!($name),
            arguments: &[$(stringify!($arg)),+],
            parity: Parity::$parity,
            at_zero: $zero,
            latex: $latex,
            regularity: operations!(@regularity $($regularity)+),
            #[allow(unused_variables)]
            partials: |$d, $x, $f| $partials,
        },)+];

        const ALL: &[Op] = &[$(Op::$variant,)+];

        impl Op {
            /// The function's value.
            pub fn eval<T: Real>(self, arguments: &[T]) -> T {
                match (self, arguments) {
                    $((Op::$variant, &[$($arg),+]) => operations!(@call $name $($arg)+),)+
                    (op, arguments) => unreachable!("{op:?} of {} arguments", arguments.len()),
                }
            }

            /// The function's value, for code that runs in packs: each function is compiled apart, with the instructions
            /// of the pack, so that a caller is not as long as all of them together.
            #[inline(always)]
            pub fn eval_apart<T: Real>(self, arguments: &[T]) -> T {
                match (self, arguments) {
                    $((Op::$variant, &[$($arg),+]) => {
                        #[derive(Clone, Copy)]
                        struct Apart;
                        impl OfNumbers<{ [$(stringify!($arg)),+].len() }> for Apart {
                            #[inline(always)]
                            fn of<T: Real>(self, [$($arg),+]: [T; [$(stringify!($arg)),+].len()]) -> T {
                                operations!(@call $name $($arg)+)
                            }
                        }
                        if const { Op::$variant.is_short_or_frequent() } {
                            T::out_of_line(
                                #[inline(always)]
                                || Apart.of([$($arg),+]),
                            )
                        } else {
                            T::apart(Apart, [$($arg),+])
                        }
                    })+
                    (op, arguments) => unreachable!("{op:?} of {} arguments", arguments.len()),
                }
            }
        }
    };
    (@regularity $domain:ident $(($from:expr))?, $range:ident, $breaks:ident $(($at:ident))?, $pole:ident $(($of:ident))?, $far:ident, $kind:ident) => {
        Regularity {
            domain: NaturalDomain::$domain $(($from))?,
            range: ValueSign::$range,
            breaks: Break::$breaks $((SingularSet::$at))?,
            pole: $pole $((SingularSet::$of))?,
            far: Far::$far,
            is_entire: operations!(@$kind),
        }
    };
    (@Entire) => { true };
    (@Branched) => { false };
    (@call $name:ident $a:ident) => { $a.$name() };
    (@call $name:ident $a:ident $($b:ident)+) => { $a.$name($($b),+) };
}

operations! {
    Sqrt sqrt(x) None Some(0), "\\sqrt",
        [From(0), NonNegative, Kink(Zero), None, Infinite, Branched],
        |d, x, f| { let g = d.powi(f, -1); vec![d.scale(&Rational::new(1, 2), g)] };
    Cbrt cbrt(x) Odd Some(0), "\\sqrt[3]",
        [All, Any, Kink(Zero), None, Infinite, Branched],
        |d, x, f| { let g = d.powi(f, -2); vec![d.scale(&Rational::new(1, 3), g)] };
    Abs abs(x) Even Some(0), "\\operatorname{abs}",
        [All, NonNegative, Kink(Zero), None, Infinite, Branched],
        |d, x, f| vec![d.call(Op::Sign, x)];
    Sign sign(x) Odd Some(0), "\\operatorname{sign}",
        [All, Any, Jump(Zero), None, Limits, Branched],
        |d, x, f| vec![d.integer(0)];
    Sin sin(x) Odd Some(0), "\\sin",
        [All, Any, Nowhere, None, Nothing, Entire],
        |d, x, f| vec![d.call(Op::Cos, x)];
    Cos cos(x) Even Some(1), "\\cos",
        [All, Any, Nowhere, None, Nothing, Entire],
        |d, x, f| { let s = d.call(Op::Sin, x); vec![d.neg(s)] };
    Tan tan(x) Odd Some(0), "\\tan",
        [All, Any, Nowhere, Some(Cosine), Nothing, Entire],
        |d, x, f| { let s = d.powi(f, 2); let one = d.integer(1); vec![d.add(&[one, s])] };
    Asin asin(x) Odd Some(0), "\\arcsin",
        [UnitInterval, Any, Kink(PlusMinusOne), None, Nothing, Branched],
        |d, x, f| { let r = d.one_plus_square(x[0], -1); let r = d.call(Op::Sqrt, &[r]); vec![d.powi(r, -1)] };
    Acos acos(x) None None, "\\arccos",
        [UnitInterval, NonNegative, Kink(PlusMinusOne), None, Nothing, Branched],
        |d, x, f| { let r = d.one_plus_square(x[0], -1); let r = d.call(Op::Sqrt, &[r]); let r = d.powi(r, -1); vec![d.neg(r)] };
    Atan atan(x) Odd Some(0), "\\arctan",
        [All, Any, Nowhere, None, Limits, Branched],
        |d, x, f| { let r = d.one_plus_square(x[0], 1); vec![d.powi(r, -1)] };
    Sinh sinh(x) Odd Some(0), "\\sinh",
        [All, Any, Nowhere, None, Infinite, Entire],
        |d, x, f| vec![d.call(Op::Cosh, x)];
    Cosh cosh(x) Even Some(1), "\\cosh",
        [All, Positive, Nowhere, None, Infinite, Entire],
        |d, x, f| vec![d.call(Op::Sinh, x)];
    Tanh tanh(x) Odd Some(0), "\\tanh",
        [All, Any, Nowhere, None, Limits, Entire],
        |d, x, f| vec![d.one_plus_square(f, -1)];
    Asinh asinh(x) Odd Some(0), "\\operatorname{arsinh}",
        [All, Any, Nowhere, None, Infinite, Branched],
        |d, x, f| { let r = d.one_plus_square(x[0], 1); let r = d.call(Op::Sqrt, &[r]); vec![d.powi(r, -1)] };
    Acosh acosh(x) None None, "\\operatorname{arcosh}",
        [From(1), NonNegative, Kink(One), None, Infinite, Branched],
        |d, x, f| {
        // √(x−1)·√(x+1), because √(x²−1) would cancel near 1 and be real below −1.
        let (one, minus) = (d.integer(1), d.integer(-1));
        let (below, above) = (d.add(&[x[0], minus]), d.add(&[x[0], one]));
        let (below, above) = (d.call(Op::Sqrt, &[below]), d.call(Op::Sqrt, &[above]));
        let product = d.mul(&[below, above]);
        vec![d.powi(product, -1)]
    };
    Atanh atanh(x) Odd Some(0), "\\operatorname{artanh}",
        [UnitInterval, Any, Nowhere, Some(PlusMinusOne), Nothing, Branched],
        |d, x, f| { let r = d.one_plus_square(x[0], -1); vec![d.powi(r, -1)] };
    Exp exp(x) None Some(1), "\\exp",
        [All, Positive, Nowhere, None, Mixed, Entire],
        |d, x, f| vec![f];
    ExpM1 exp_m1(x) None Some(0), "\\operatorname{expm1}",
        [All, Any, Nowhere, None, Mixed, Entire],
        |d, x, f| vec![d.call(Op::Exp, x)];
    Ln ln(x) None None, "\\ln",
        [From(0), Any, Nowhere, Some(Zero), Infinite, Branched],
        |d, x, f| vec![d.powi(x[0], -1)];
    Ln1p ln_1p(x) None Some(0), "\\operatorname{log1p}",
        [From(-1), Any, Nowhere, Some(MinusOne), Infinite, Branched],
        |d, x, f| { let one = d.integer(1); let r = d.add(&[one, x[0]]); vec![d.powi(r, -1)] };
    Erf erf(x) Odd Some(0), "\\operatorname{erf}",
        [All, Any, Nowhere, None, Limits, Entire],
        |d, x, f| vec![bell(d, x[0], 2)];
    Erfc erfc(x) None Some(1), "\\operatorname{erfc}",
        [All, Positive, Nowhere, None, Limits, Entire],
        |d, x, f| vec![bell(d, x[0], -2)];
    Atan2 atan2(y, x) None None, "\\operatorname{atan2}",
        [All, Any, Jump(Cut), None, Nothing, Branched],
        |d, x, f| {
        let squares = d.sum_of_squares(&[x[1], x[0]]);
        let r = d.powi(squares, -1);
        let minus = d.mul(&[x[0], r]);
        vec![d.mul(&[x[1], r]), d.neg(minus)]
    };
    Hypot hypot(x, y) None None, "\\operatorname{hypot}",
        [All, NonNegative, Kink(Origin), None, Infinite, Branched],
        |d, x, f| {
        let r = d.powi(f, -1);
        vec![d.mul(&[x[0], r]), d.mul(&[x[1], r])]
    };
    Min min(x, y) None None, "\\min",
        [All, Any, Kink(Equal), None, Nothing, Branched],
        |d, x, f| {
        let first = d.less_equal(x[0], x[1]);
        let (zero, one) = (d.integer(0), d.integer(1));
        vec![d.select(first, one, zero), d.select(first, zero, one)]
    };
    Max max(x, y) None None, "\\max",
        [All, Any, Kink(Equal), None, Nothing, Branched],
        |d, x, f| {
        let first = d.less_equal(x[1], x[0]);
        let (zero, one) = (d.integer(0), d.integer(1));
        vec![d.select(first, one, zero), d.select(first, zero, one)]
    };
    Pow pow(x, y) None None, "\\operatorname{pow}",
        [Power, OfBase, Kink(Zero), Some(Zero), Infinite, Branched],
        |d, x, f| {
        // y·x^(y−1) from its own power, not from f/x, which is 0/0 at x = 0.
        let minus = d.integer(-1);
        let lower = d.add(&[x[1], minus]);
        let lower = d.pow(x[0], lower);
        // x^y·ln x → 0 as x → 0 from above, for y > 0.
        let (log, zero) = (d.call(Op::Ln, &[x[0]]), d.integer(0));
        let (vanished, slope) = (d.equal(f, zero), d.mul(&[f, log]));
        vec![d.mul(&[x[1], lower]), d.select(vanished, zero, slope)]
    };
    // The numbers of the functions above decide the starts of the orbits by which pieces are chosen (`space/labels`):
    // a new function stands at the end of this part.
    Floor floor(x) None Some(0), "\\operatorname{floor}",
        [All, Any, Jump(Whole), None, Infinite, Branched],
        |d, x, f| vec![d.integer(0)];
    Round round(x) Odd Some(0), "\\operatorname{round}",
        [All, Any, Jump(HalfWhole), None, Infinite, Branched],
        |d, x, f| vec![d.integer(0)];
    // `x % y`
    Modulo modulo(x, y) None None, "\\bmod",
        [All, NonNegative, Jump(Multiple), None, Nothing, Branched],
        |d, x, f| vec![d.integer(1), multiples(d, x, f)];
    Remainder remainder(x, y) None None, "\\operatorname{rem}",
        [All, Any, Jump(HalfMultiple), None, Nothing, Branched],
        |d, x, f| vec![d.integer(1), multiples(d, x, f)];
    // Functions from here on occur in exact flows alone. A function of the language goes above this line.
    Anomaly universal_anomaly(a, b, c) None None, "\\operatorname{y}",
        [All, Positive, Nowhere, None, Nothing, Branched],
        |d, x, f| underivable();
    Orbit orbit_remainder(b, c) None None, "\\operatorname{rem}",
        [All, Any, Nowhere, None, Nothing, Branched],
        |d, x, f| underivable();
    Stumpff2 stumpff_2(x) None None, "c_2",
        [All, NonNegative, Nowhere, None, Mixed, Entire],
        |d, x, f| underivable();
    Stumpff3 stumpff_3(x) None None, "c_3",
        [All, Positive, Nowhere, None, Mixed, Entire],
        |d, x, f| underivable();
}

macro_rules! list {
    ($($variant:ident $name:ident $least:literal;)*) => { &[$(Op::$variant),*] };
}

/// Functions whose independent calls are faster together.
pub const TOGETHER: &[Op] = hamiltonian_real::computed_together!(list);

/// The number of functions of the language; the rows after them occur in exact flows alone.
const LANGUAGE: usize = Op::Anomaly as usize;

/// The partial derivatives of functions that exact flows alone are made of: flows are carried
/// over dual numbers and never differentiated as expressions.
fn underivable() -> Vec<Node> {
    unreachable!("an exact flow is differentiated")
}

/// −n, where f = x − n·y with a whole number n. Rounding leaves the quotient near n.
fn multiples(dag: &mut Dag, x: &[Node], f: Node) -> Node {
    let part = dag.sub(f, x[0]);
    let quotient = dag.div(part, x[1]);
    dag.call(Op::Round, &[quotient])
}

/// k·exp(−x²)/√π
fn bell(dag: &mut Dag, x: Node, k: i64) -> Node {
    let square = dag.powi(x, 2);
    let minus = dag.neg(square);
    let pi = dag.pi();
    let root = dag.call(Op::Sqrt, &[pi]);
    let (bell, root) = (dag.call(Op::Exp, &[minus]), dag.powi(root, -1));
    let product = dag.mul(&[bell, root]);
    dag.scale(&Rational::integer(k), product)
}

impl Op {
    /// True if packs compute the function of all their registers in lock-step: it is a few operations, or is called so often
    /// that a sixth to a tenth of the time of a step is worth several times the code.
    const fn is_short_or_frequent(self) -> bool {
        use Op::{Abs, Cos, Exp, Floor, Ln, Max, Min, Round, Sign, Sin, Sqrt};
        matches!(
            self,
            Abs | Cos | Exp | Floor | Ln | Max | Min | Round | Sign | Sin | Sqrt
        )
    }
    /// The function's row.
    #[must_use]
    pub fn row(self) -> &'static OpRow {
        &TABLE[self as usize]
    }
    /// The function of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Op> {
        ALL.iter().copied().find(|op| op.row().name == name)
    }
    /// All functions of the language.
    #[must_use]
    pub fn all() -> &'static [Op] {
        &ALL[..LANGUAGE]
    }
    /// The exact value at 0.
    #[must_use]
    pub fn at_zero(self) -> Option<Rational> {
        self.row().at_zero.map(Rational::integer)
    }
}

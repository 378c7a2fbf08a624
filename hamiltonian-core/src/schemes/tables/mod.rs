//! The coefficients of splittings and compositions, as data.
//!
//! Input: published numbers, polished to more than 32 digits on the order conditions of their class
//! by `scripts/coefficients.py`. Output: [`Coefficients`], which hold a table's name, order, class,
//! weights and source together; [`all`] lists them. Invariant: a table satisfies every order
//! condition of its own class, which the tests check to 1e-24 in double-double.
//!
//! Every table is a zigzag: in each stage the pieces 1 … k for the duration `down`, then k … 1 for
//! the duration `up`. The constructors bring the published forms to this one:
//!
//! | published | here |
//! |---|---|
//! | γ₁ γ₂ … of a composition of symmetric maps | (γ₁/2, γ₁/2), (γ₂/2, γ₂/2), … |
//! | α₁ α₂ … of a map and its adjoint in turn | (α₁, α₂), (α₃, α₄), … |
//! | a₁ b₁ a₂ b₂ … of two flows in turn | (d₁, u₁), … with d₁ = a₁, d₁ + u₁ = b₁, u₁ + d₂ = a₂, … |

use super::splitting::{Durations, Weight};

pub mod general;
pub mod near_integrable;
pub mod nystrom;
pub mod processed;

/// The splittings on which a table has its order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Class {
    /// For any pieces, and for compositions of any one-step map and its adjoint.
    General,
    /// The kick is V(q, t) and the other piece is autonomous and at most quadratic in p.
    QuadraticKinetic {
        /// The piece of the first stroke.
        first: First,
    },
    /// For any pieces, and designed for H = A + εB, with the error O(ε h^r₁ + ε² h^r₂ + …).
    NearIntegrable {
        /// r₁, r₂, …; the last one applies to all higher powers of ε.
        orders: &'static [u32],
    },
}

/// The first piece in a table for kicks and drifts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum First {
    /// V(q, t), which moves p.
    Kick,
    /// The piece that is at most quadratic in p.
    Drift,
}

/// A table of `S` stages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients<const S: usize> {
    /// Its name in the field.
    pub name: &'static str,
    /// The order of convergence on splittings of its class.
    pub order: u32,
    /// The splittings it is for.
    pub class: Class,
    /// The durations of each stage, `(down, up)`, in units of the step.
    pub stages: [Durations; S],
    /// Author, journal or book, year, DOI.
    pub source: &'static str,
}

/// A table with any number of stages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Listing {
    /// Its name in the field.
    pub name: &'static str,
    /// The order of convergence on splittings of its class.
    pub order: u32,
    /// The splittings it is for.
    pub class: Class,
    /// The durations of each stage, `(down, up)`, in units of the step.
    pub stages: &'static [Durations],
    /// Author, journal or book, year, DOI.
    pub source: &'static str,
}

macro_rules! all {
    ($($module:ident { $($table:ident)+ })+) => {
        /// All tables.
        ///
        /// ```
        /// use hamiltonian::schemes::tables::{Class, all};
        /// for table in all().filter(|table| table.class == Class::General) {
        ///     println!("{}: order {}, {} stages", table.name, table.order, table.stages.len());
        /// }
        /// ```
        #[inline]
        pub fn all() -> impl Iterator<Item = Listing> {
            [$($(Listing {
                name: $module::$table.name,
                order: $module::$table.order,
                class: $module::$table.class,
                stages: const { &$module::$table.stages },
                source: $module::$table.source,
            },)+)+]
            .into_iter()
        }
    };
}

all! {
    general {
        RUTH_3
        YOSHIDA_4 SUZUKI_4 BLANES_MOAN_4
        YOSHIDA_6 KAHAN_LI_6 BLANES_MOAN_6
        MCLACHLAN_8 KAHAN_LI_8 SOFRONIOU_SPALETTA_8
        SOFRONIOU_SPALETTA_10
    }
    nystrom { SRKN_6B SRKN_11B SRKN_14A BLANES_CASAS_ESCORIHUELA_8 }
    near_integrable { SABA_1 SABA_2 SABA_3 SABA_4 ABA_104 ABA_864 ABA_1064 }
}

/// A processed table with any numbers of stages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProcessedListing {
    /// Its name in the field.
    pub name: &'static str,
    /// The order of convergence on splittings of its class.
    pub order: u32,
    /// The splittings it is for.
    pub class: Class,
    /// The durations of the stages of the kernel.
    pub kernel: &'static [Durations],
    /// The durations of the stages of the processor.
    pub processor: &'static [Durations],
    /// Author, journal or book, year, DOI.
    pub source: &'static str,
}

macro_rules! all_processed {
    ($($table:ident)+) => {
        /// All processed tables.
        ///
        /// ```
        /// for table in hamiltonian::schemes::tables::all_processed() {
        ///     println!("{}: {} stages a step", table.name, table.kernel.len());
        /// }
        /// ```
        #[inline]
        pub fn all_processed() -> impl Iterator<Item = ProcessedListing> {
            [$(ProcessedListing {
                name: processed::$table.name,
                order: processed::$table.order,
                class: processed::$table.class,
                kernel: const { &processed::$table.kernel },
                processor: const { &processed::$table.processor },
                source: processed::$table.source,
            },)+]
            .into_iter()
        }
    };
}

all_processed! {
    PROCESSED_4 PROCESSED_6 BLANES_CASAS_MURUA_8
    WISDOM_HOLMAN_3 WISDOM_HOLMAN_5 WISDOM_HOLMAN_7 WISDOM_HOLMAN_11 WISDOM_HOLMAN_17
}

/// γ₁ … of the middle, then mirrored, of a composition of a symmetric map.
const fn symmetric<const HALF: usize, const S: usize>(gammas: [Weight; HALF]) -> [Durations; S] {
    assert!(S + 1 == 2 * HALF, "the middle of a composition stands once");
    let mut stages = [(Weight(0.0, 0.0), Weight(0.0, 0.0)); S];
    let mut i = 0;
    while i < S {
        let half = gammas[if i < HALF { i } else { S - 1 - i }].half();
        stages[i] = (half, half);
        i += 1;
    }
    stages
}

/// α₁ … αₛ, then mirrored, of a map and its adjoint in turn.
const fn palindrome<const S: usize>(alphas: [Weight; S]) -> [Durations; S] {
    let mut stages = [(Weight(0.0, 0.0), Weight(0.0, 0.0)); S];
    let mut i = 0;
    while i < S {
        let (first, second) = (2 * i, 2 * i + 1);
        stages[i] = (
            alphas[if first < S { first } else { 2 * S - 1 - first }],
            alphas[if second < S {
                second
            } else {
                2 * S - 1 - second
            }],
        );
        i += 1;
    }
    stages
}

/// a₁ b₁ a₂ b₂ … bₛ of two flows in turn, with nothing after the last.
const fn strokes<const N: usize, const S: usize>(weights: [Weight; N]) -> [Durations; S] {
    assert!(N == 2 * S, "a table ends with the second flow");
    let mut stages = [(Weight(0.0, 0.0), Weight(0.0, 0.0)); S];
    let mut before = Weight(0.0, 0.0);
    let mut i = 0;
    while i < S {
        let down = difference(weights[2 * i], before);
        let up = difference(weights[2 * i + 1], down);
        stages[i] = (down, up);
        before = up;
        i += 1;
    }
    stages
}

/// a₁ b₁ a₂ … of two flows in turn up to the middle, then mirrored: `S` flows of the second kind.
const fn mirrored<const N: usize, const S: usize>(weights: [Weight; N]) -> [Durations; S] {
    assert!(
        S + 1 == N,
        "the middle stroke of a symmetric table stands once"
    );
    let mut stages = [(Weight(0.0, 0.0), Weight(0.0, 0.0)); S];
    let mut before = Weight(0.0, 0.0);
    let mut i = 0;
    while i < S {
        let (first, second) = (2 * i, 2 * i + 1);
        let a = weights[if first < N { first } else { 2 * S - first }];
        let b = weights[if second < N { second } else { 2 * S - second }];
        let down = difference(a, before);
        let up = difference(b, down);
        stages[i] = (down, up);
        before = up;
        i += 1;
    }
    stages
}

/// `a − b` to 106 bits (Joldes, Muller, Popescu, ACM Trans. Math. Softw. 44, 15, 2017, algorithm 6,
/// doi:10.1145/3121432).
const fn difference(a: Weight, b: Weight) -> Weight {
    let (high, rest) = two_sum(a.0, -b.0);
    let (low, least) = two_sum(a.1, -b.1);
    let (high, rest) = two_sum(high, rest + low);
    let (high, rest) = two_sum(high, least + rest);
    Weight(high, rest)
}

/// `a + b` and its rounding error.
const fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

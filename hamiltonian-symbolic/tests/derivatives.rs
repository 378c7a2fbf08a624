//! Values and derivatives of random expressions: the scheduled program over `f64` against dual
//! numbers over double-doubles that know nothing of the engine.
//!
//! If only one of the two is finite there is a reason: the program may drop what is multiplied by
//! 0 or divided by itself (a licence); the oracle lets an exact 0 absorb an infinite slope, so that
//! a factor 0 in front of √0 hides its derivative (absorbed). Both happen on edges alone, but for
//! licences that drop what left its domain.
//!
//! The bound on each output is 8·ε·Σ |∂out/∂node|·|node| over the program's own operations. Where
//! it passes 1e-3·|out| the point says nothing and is counted; at most 5 % may be. The default
//! runs a part; `HAMILTONIAN_HEAVY=1` runs 10⁵ expressions and 2·10⁴ Hessians.

use crate::common;
use crate::tape::{self, Traced};
use crate::tree::{PAIRS, PARAMETERS, Random, Region, TIME, Tree, VARIABLES, grow, region};
use hamiltonian_lanes::{DoubleDouble, Dual, Real};
use hamiltonian_symbolic::dag::{Array, Column, Side};
use hamiltonian_symbolic::interpret::{Point, run};
use hamiltonian_symbolic::pipeline::{NoProgram, derive};
use hamiltonian_symbolic::program::{Program, Purpose, Target};

const FIRST: [Purpose; 10] = [
    Purpose::Energy,
    Purpose::GradientQ,
    Purpose::GradientP,
    Purpose::Gradient,
    Purpose::EnergyAndGradient,
    Purpose::TimeDerivative,
    Purpose::ParameterGradient,
    Purpose::VectorField,
    Purpose::Kick,
    Purpose::Drift,
];
const SECOND: [Purpose; 1] = [Purpose::HessianVector];

/// The fates of the outputs compared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Tally {
    /// Within the bound.
    agree: usize,
    /// Bound too wide to say anything.
    wide: usize,
    /// Overflow or underflow on the way.
    range: usize,
    /// Finite in neither.
    neither: usize,
    /// Finite only in the program, by licence: `x/x = 1`, `0·x = 0`.
    licence: usize,
    /// On an edge, finite only in the oracle: its constant 0 absorbs an infinite slope.
    absorbed: usize,
    /// On a kink, where `|x|² = x²` has a second derivative and the oracle's 0 stands for none.
    kink: usize,
    /// Past the bound, or finite in one only.
    wrong: usize,
}

/// One point with everything the oracle says there.
struct Case {
    point: Vec<f64>,
    /// The step coefficient, the direction, and the vectors added to.
    coefficient: f64,
    direction: [f64; 2 * PAIRS],
    start: f64,
    exact: Numbers,
    /// Those where values that leave their domain are any function, if one does.
    licensed: Option<Numbers>,
    /// The largest number the oracle met, infinite where it left the range of `f64`.
    scale: f64,
    region: Region,
}

/// H and its derivatives.
struct Numbers {
    energy: DoubleDouble,
    /// By every variable.
    gradient: Vec<DoubleDouble>,
    /// Hessian times direction, by q and p.
    hessian: Vec<DoubleDouble>,
}

/// The numbers at a point. `licensed`: what leaves its domain is any function.
fn numbers(tree: &Tree, point: &[f64], direction: &[f64], second: bool, licensed: bool) -> Numbers {
    fn value<T: Real>(tree: &Tree, point: &[f64], variables: &[T], licensed: bool) -> T {
        match licensed {
            true => tree.licensed_value(point, variables),
            false => tree.value(variables),
        }
    }
    let exact: Vec<DoubleDouble> = point.iter().map(|x| DoubleDouble::from(*x)).collect();
    let gradient = (0..VARIABLES).map(|by| {
        if !tree.mentions(by) {
            return DoubleDouble::zero();
        }
        let seed = |(at, x): (usize, &DoubleDouble)| match at == by {
            true => Dual::variable(*x),
            false => Dual::fixed(*x),
        };
        let seeded: Vec<_> = exact.iter().enumerate().map(seed).collect();
        value(tree, point, &seeded, licensed).eps
    });
    let count = if second { 2 * PAIRS } else { 0 };
    let hessian = (0..count).map(|by| {
        if !tree.mentions(by) {
            return DoubleDouble::zero();
        }
        let seed = |(at, x): (usize, &DoubleDouble)| {
            let along = direction.get(at).copied().unwrap_or(0.0);
            let inner = Dual::new(*x, DoubleDouble::from(along));
            match at == by {
                true => Dual::variable(inner),
                false => Dual::fixed(inner),
            }
        };
        let seeded: Vec<_> = exact.iter().enumerate().map(seed).collect();
        value(tree, point, &seeded, licensed).eps.eps
    });
    Numbers {
        energy: value(tree, point, &exact, licensed),
        gradient: gradient.collect(),
        hessian: hessian.collect(),
    }
}

fn case(tree: &Tree, point: Vec<f64>, random: &mut Random, second: bool) -> Case {
    let mut number = || random.unit() * 4.0 - 2.0;
    let coefficient = number();
    let start = number();
    let direction = [number(), number(), number(), number()];
    let numbers = |licensed| numbers(tree, &point, &direction, second, licensed);
    let exact = numbers(false);
    let licensed = tree.leaves_domain(&point).then(|| numbers(true));
    let lifted: Vec<DoubleDouble> = point.iter().map(|x| DoubleDouble::from(*x)).collect();
    let scale = exact
        .gradient
        .iter()
        .chain(&exact.hessian)
        .map(|x: &DoubleDouble| x.magnitude())
        .chain(tree.values(&lifted).iter().map(|x| x.magnitude()))
        .filter(|x| !x.is_nan())
        .fold(1.0, f64::max);
    Case {
        scale,
        licensed,
        region: region(tree, &point),
        point,
        coefficient,
        direction,
        start,
        exact,
    }
}

/// The point as the interpreter reads it.
fn lifted<T: Real>(case: &Case, lift: impl Fn(f64) -> T) -> Point<T> {
    let mut point = Point::new();
    point.t = lift(case.point[TIME]);
    point.c = lift(case.coefficient);
    point.scalars = (0..PARAMETERS)
        .map(|at| lift(case.point[TIME + 1 + at]))
        .collect();
    for at in 0..2 * PAIRS {
        let side = if at < PAIRS { Side::Q } else { Side::P };
        let (group, column) = ((at % PAIRS) as u16, 0);
        point.arrays.insert(
            Array::Phase(Column {
                side,
                group,
                column,
            }),
            vec![vec![lift(case.point[at])]],
        );
        point.arrays.insert(
            Array::Direction(Column {
                side,
                group,
                column,
            }),
            vec![vec![lift(case.direction[at])]],
        );
        point
            .outputs
            .insert(phase(side, group), vec![vec![lift(case.start)]]);
    }
    for at in 0..PARAMETERS {
        point
            .outputs
            .insert(parameter(at), vec![vec![lift(case.start)]]);
    }
    point
}

fn phase(side: Side, group: u16) -> Target {
    Target::Phase(Column {
        side,
        group,
        column: 0,
    })
}

fn parameter(at: usize) -> Target {
    Target::Parameter(hamiltonian_symbolic::dag::Parameter(at as u16))
}

/// The outputs a purpose has, each with the oracle's value.
fn expected(
    purpose: Purpose,
    case: &Case,
    numbers: &Numbers,
) -> (Option<DoubleDouble>, Vec<(Target, DoubleDouble)>) {
    let q = |list: &[DoubleDouble]| -> Vec<_> {
        (0..PAIRS)
            .map(|at| (phase(Side::Q, at as u16), list[at]))
            .collect()
    };
    let p = |list: &[DoubleDouble]| -> Vec<_> {
        (0..PAIRS)
            .map(|at| (phase(Side::P, at as u16), list[PAIRS + at]))
            .collect()
    };
    let added = |side: Side, sign: f64| -> Vec<_> {
        (0..PAIRS)
            .map(|at| {
                let from = if side == Side::Q { PAIRS + at } else { at };
                let change = DoubleDouble::from(sign * case.coefficient) * numbers.gradient[from];
                (
                    phase(side, at as u16),
                    DoubleDouble::from(case.start) + change,
                )
            })
            .collect()
    };
    let g = &numbers.gradient;
    match purpose {
        Purpose::Energy => (Some(numbers.energy), vec![]),
        Purpose::GradientQ => (None, q(g)),
        Purpose::GradientP => (None, p(g)),
        Purpose::Gradient => (None, [q(g), p(g)].concat()),
        Purpose::EnergyAndGradient => (Some(numbers.energy), [q(g), p(g)].concat()),
        Purpose::TimeDerivative => (Some(g[TIME]), vec![]),
        Purpose::ParameterGradient => (
            None,
            (0..PARAMETERS)
                .map(|at| (parameter(at), g[TIME + 1 + at]))
                .collect(),
        ),
        Purpose::VectorField => (None, [added(Side::Q, 1.0), added(Side::P, -1.0)].concat()),
        Purpose::Kick => (None, added(Side::P, -1.0)),
        Purpose::Drift => (None, added(Side::Q, 1.0)),
        Purpose::HessianVector => (None, [q(&numbers.hessian), p(&numbers.hessian)].concat()),
        _ => (None, vec![]),
    }
}

/// Compares every output of every function; `distort` changes the values of the oracle.
fn judge(
    program: &Program,
    case: &Case,
    distort: impl Fn(DoubleDouble) -> DoubleDouble,
    tally: &mut Tally,
    mut report: impl FnMut(&str),
) {
    for function in &program.functions {
        tape::start();
        let traced = run(program, function, &lifted(case, Traced::input));
        let left_range = tape::left_range() || case.scale > 1e150;
        let plain = run(program, function, &lifted(case, |x| x));
        let (result, stored) = expected(function.purpose, case, &case.exact);
        let other = case.licensed.as_ref();
        let other = other.map(|numbers| expected(function.purpose, case, numbers));
        let (other_result, other_stored) = other.unwrap_or_default();
        let mut pairs = Vec::new();
        if let Some(value) = result {
            let (got, bits) = (traced.results[0], plain.results[0]);
            pairs.push(("result".to_owned(), got, bits, value, other_result));
        }
        for (at, (target, value)) in stored.into_iter().enumerate() {
            let (got, bits) = (&traced.outputs[&target], &plain.outputs[&target]);
            let licensed = other_stored.get(at).map(|(_, value)| *value);
            pairs.push((
                format!("{target:?}"),
                got[0][0],
                bits[0][0],
                value,
                licensed,
            ));
        }
        for (name, got, bits, want, licensed) in pairs {
            assert!(
                got.value.to_bits() == bits.to_bits() || (got.value.is_nan() && bits.is_nan()),
                "the tape changes nothing"
            );
            // If H is not finite, its derivatives are the values of the formulas.
            if !case.exact.energy.is_finite()
                && (name != "result" || function.purpose == Purpose::TimeDerivative)
            {
                continue;
            }
            let want = distort(want);
            let mut say = |what: &str| {
                report(&format!(
                    "{what}: {:?} {name}: {} for {}",
                    function.purpose, got.value, want
                ))
            };
            match (want.is_finite(), got.value.is_finite()) {
                (true, true) => {
                    // The oracle's own rounding is far below, but not 0.
                    let noise = 1e-18 * case.scale + f64::EPSILON / 16.0 * want.to_f64().abs();
                    let bound = 8.0 * f64::EPSILON * tape::sensitivity(got) + noise;
                    let error = (DoubleDouble::from(got.value) - want).to_f64().abs();
                    if error <= noise {
                        tally.agree += 1;
                    } else if left_range {
                        tally.range += 1;
                    } else if bound.is_nan() || bound > 1e-3 * want.to_f64().abs() {
                        tally.wide += 1;
                    } else if error <= bound {
                        tally.agree += 1;
                    } else if function.purpose == Purpose::HessianVector
                        && case.region == Region::Edge
                    {
                        tally.kink += 1;
                    } else {
                        tally.wrong += 1;
                        say(&format!("error {error:e} past {bound:e}"));
                    }
                }
                (false, false) => tally.neither += 1,
                _ if left_range && case.region == Region::Inside => tally.range += 1,
                (true, false) if case.region == Region::Edge => {
                    tally.absorbed += 1;
                }
                (false, true) if case.region == Region::Edge => tally.licence += 1,
                (false, true) if licensed.is_some_and(|value| close(got.value, value.to_f64())) => {
                    tally.licence += 1
                }
                _ => {
                    tally.wrong += 1;
                    say("finite in one only");
                }
            }
        }
    }
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * (a.abs() + b.abs())
}

/// Grows, derives and judges `count` expressions.
fn campaign(seed: u64, count: usize, wanted: &[Purpose]) -> (Tally, usize) {
    let second = wanted.contains(&Purpose::HessianVector);
    let mut random = Random(seed);
    let mut tally = Tally::default();
    let (mut undecided, mut finite, mut edges, mut too_large) = (0, 0, 0, 0);
    let mut shown = 0;
    for number in 0..count {
        let (tree, point) = grow(&mut random);
        let case = case(&tree, point, &mut random, second);
        if case.region == Region::Undecided {
            undecided += 1;
            continue;
        }
        finite += usize::from(case.exact.energy.is_finite());
        edges += usize::from(case.region == Region::Edge);
        let mut model = tree.model();
        let program = match derive(&mut model, wanted) {
            Err(NoProgram::OutOfRange { .. }) => {
                too_large += 1;
                continue;
            }
            result => result.unwrap(),
        };
        let before = tally;
        judge(
            &program,
            &case,
            |x| x,
            &mut tally,
            |what| {
                if shown < 20 {
                    println!("{number}: {what}");
                }
            },
        );
        if tally.wrong > before.wrong {
            shown += 1;
            if shown < 20 {
                println!("    H = {}\n    at {:?}", tree.text(), case.point);
            }
        }
    }
    println!(
        "{count} expressions: {finite} finite, {edges} on edges, {undecided} undecided by rounding, {too_large} past f64"
    );
    println!("outputs: {tally:?}");
    assert!(too_large * 1000 <= count, "{too_large} of {count} past f64");
    (tally, undecided)
}

fn accept(tally: Tally, undecided: usize, count: usize) {
    assert_eq!(tally.wrong, 0);
    let all = tally.agree + tally.wide + tally.range;
    let share = tally.wide as f64 / all as f64;
    println!(
        "bound too wide at {:.2} % of the finite outputs",
        100.0 * share
    );
    assert!(share <= 0.05);
    assert!(undecided * 50 <= count, "{undecided} of {count} undecided");
    assert!(tally.absorbed * 500 <= all && tally.licence * 500 <= all);
}

#[test]
fn first_derivatives_of_random_expressions() {
    let count = common::cases(3_000, 100_000);
    let (tally, undecided) = campaign(1, count, &FIRST);
    accept(tally, undecided, count);
}

#[test]
fn second_derivatives_of_random_expressions() {
    let count = common::cases(1_000, 20_000);
    let (tally, undecided) = campaign(2, count, &SECOND);
    accept(tally, undecided, count);
}

/// A derivative off by a part in 10⁹ is found wherever the bound lets it be.
#[test]
fn a_wrong_derivative_is_found() {
    let mut random = Random(3);
    let (mut found, mut judged) = (0, 0);
    for _ in 0..500 {
        let (tree, point) = grow(&mut random);
        let case = case(&tree, point, &mut random, false);
        if case.region != Region::Inside || !case.exact.energy.is_finite() {
            continue;
        }
        let program = derive(&mut tree.model(), &FIRST).unwrap();
        let mut tally = Tally::default();
        let off = |x: DoubleDouble| x + x * DoubleDouble::from(1e-9);
        judge(&program, &case, off, &mut tally, |_| {});
        judged += 1;
        found += usize::from(tally.wrong > 0);
    }
    println!("{found} of {judged} found");
    assert!(found * 20 > judged * 19);
}

/// On the edges of domains and on kinks, exactly, and beside them.
#[test]
fn edges_of_domains() {
    const INF: f64 = f64::INFINITY;
    const NAN: f64 = f64::NAN;
    let cases: &[(&str, f64, f64, [f64; 3])] = &[
        // H, q, p, then H, ∂H/∂q, ∂H/∂p
        ("sqrt(q)", 0.0, 0.0, [0.0, INF, 0.0]),
        ("sqrt(q)", -1.0, 0.0, [NAN, NAN, 0.0]),
        ("q^1.5", 0.0, 0.0, [0.0, 0.0, 0.0]),
        ("q^-0.5", 0.0, 0.0, [INF, -INF, 0.0]),
        ("q^0.3", 0.0, 0.0, [0.0, INF, 0.0]),
        ("q^2.3", 0.0, 0.0, [0.0, 0.0, 0.0]),
        ("abs(q)^2.5", 0.0, 0.0, [0.0, 0.0, 0.0]),
        (
            "abs(q)^1.5 + abs(q)^2.5 + abs(q)^6.5",
            0.0,
            0.0,
            [0.0, 0.0, 0.0],
        ),
        ("abs(q)^2.5", -4.0, 0.0, [32.0, -20.0, 0.0]),
        ("sqrt(abs(q))^5 + sqrt(q^2)^2.5", 0.0, 0.0, [0.0, 0.0, 0.0]),
        ("abs(cbrt(q))^4 + cbrt(q)^7", 0.0, 0.0, [0.0, 0.0, 0.0]),
        ("(q^2)^0.75", 0.0, 0.0, [0.0, 0.0, 0.0]),
        ("(q^2)^0.75", -4.0, 0.0, [8.0, -3.0, 0.0]),
        ("q^(1/3)", -1.0, 0.0, [NAN, NAN, 0.0]),
        ("cbrt(q)", -8.0, 0.0, [-2.0, 1.0 / 12.0, 0.0]),
        ("cbrt(q)", 0.0, 0.0, [0.0, INF, 0.0]),
        ("q^p", 0.0, 2.0, [0.0, 0.0, 0.0]),
        ("q^p", 0.0, 1.0, [0.0, 1.0, 0.0]),
        ("q^p", 0.0, 0.5, [0.0, INF, 0.0]),
        ("q^3*p^0", 2.0, 0.0, [8.0, 12.0, 0.0]),
        ("ln(q)", 0.0, 0.0, [-INF, INF, 0.0]),
        ("ln(q)", 1e-300, 0.0, [-690.775_527_898_213_7, 1e300, 0.0]),
        ("ln_1p(q)", -1.0, 0.0, [-INF, INF, 0.0]),
        ("acosh(q)", 1.0, 0.0, [0.0, INF, 0.0]),
        ("acosh(q)", 0.5, 0.0, [NAN, NAN, 0.0]),
        ("acosh(q)", -2.0, 0.0, [NAN, NAN, 0.0]),
        // 1 + 2⁻³⁰
        (
            "acosh(q)",
            1.000_000_000_931_322_6,
            0.0,
            [4.315_837_287_180_596e-5, 2.317_047_500_052_599_3e4, 0.0],
        ),
        ("asin(q)", 1.0, 0.0, [std::f64::consts::FRAC_PI_2, INF, 0.0]),
        ("acos(q)", -1.0, 0.0, [std::f64::consts::PI, -INF, 0.0]),
        ("atanh(q)", 1.0, 0.0, [INF, INF, 0.0]),
        // erf 1, erfc 1 and 2 e⁻¹/√π to 16 digits (Abramowitz and Stegun 1964, table 7.1).
        (
            "erf(q)",
            1.0,
            0.0,
            [0.842_700_792_949_714_9, 0.415_107_497_420_594_7, 0.0],
        ),
        (
            "erfc(q)",
            1.0,
            0.0,
            [0.157_299_207_050_285_13, -0.415_107_497_420_594_7, 0.0],
        ),
        ("erf(q)", INF, 0.0, [1.0, 0.0, 0.0]),
        ("erfc(q)", -INF, 0.0, [2.0, 0.0, 0.0]),
        ("abs(q)", 0.0, 0.0, [0.0, 0.0, 0.0]),
        ("abs(q)", -0.0, 0.0, [0.0, 0.0, 0.0]),
        ("abs(q)^3", -2.0, 0.0, [8.0, -12.0, 0.0]),
        ("sign(q)*p", 0.0, 3.0, [0.0, 0.0, 0.0]),
        ("min(q, p)", 2.0, 2.0, [2.0, 1.0, 0.0]),
        ("max(q, p)", 2.0, 2.0, [2.0, 1.0, 0.0]),
        ("max(q, p)^2", 1.0, 3.0, [9.0, 0.0, 6.0]),
        ("hypot(q, p)", 3.0, 4.0, [5.0, 0.6, 0.8]),
        ("hypot(q, p)", 0.0, 0.0, [0.0, NAN, NAN]),
        ("atan2(q, p)", 0.0, -1.0, [std::f64::consts::PI, -1.0, 0.0]),
        // The branch not taken shows nowhere.
        (
            "if q > 0 { sqrt(q) } else { q }",
            -1.0,
            0.0,
            [-1.0, 1.0, 0.0],
        ),
        ("if q > 0 { q*ln(q) } else { 0 }", 0.0, 0.0, [0.0, 0.0, 0.0]),
        (
            "if q > 0 { sin(q)/q } else { 1 + q*p }",
            0.0,
            5.0,
            [1.0, 5.0, 0.0],
        ),
        (
            "1/sqrt(if q > 0 { q } else { 1 }) + if q > 0 { 0 } else { 1/q }",
            -2.0,
            0.0,
            [0.5, -0.25, 0.0],
        ),
        (
            "if q > 0 { 1/sqrt(q) + 1/sqrt(q)^3 } else { 1/q }",
            -2.0,
            0.0,
            [-0.5, -0.25, 0.0],
        ),
        (
            "cbrt(if q > 0 { q } else { p })",
            0.0,
            8.0,
            [2.0, 0.0, 1.0 / 12.0],
        ),
        (
            "sqrt(if q > 0 { p } else { q + 1 })",
            -1.0,
            2.0,
            [0.0, INF, 0.0],
        ),
        (
            "if q > 0 && p > 0 { ln(q)*ln(p) } else { q - p }",
            1.0,
            -1.0,
            [2.0, 1.0, -1.0],
        ),
        (
            "if !(q == p) || q < 0 { (q - p)^-1 } else { q }",
            1.0,
            1.0,
            [1.0, 1.0, 0.0],
        ),
    ];
    for (text, q, p, want) in cases {
        let mut model = common::system("q; p", "", "", text);
        let program = derive(&mut model, &[Purpose::EnergyAndGradient]).unwrap();
        let mut point = Point::<f64>::new();
        for (side, x) in [(Side::Q, *q), (Side::P, *p)] {
            let (group, column) = (0, 0);
            let array = Array::Phase(Column {
                side,
                group,
                column,
            });
            point.arrays.insert(array, vec![vec![x]]);
            point.outputs.insert(phase(side, 0), vec![vec![0.0]]);
        }
        let outcome = run(&program, &program.functions[0], &point);
        let got = [
            outcome.results[0],
            outcome.outputs[&phase(Side::Q, 0)][0][0],
            outcome.outputs[&phase(Side::P, 0)][0][0],
        ];
        for (got, want) in got.iter().zip(want) {
            let same = got == want || got.is_nan() && want.is_nan();
            assert!(
                same || (got - want).abs() <= 1e-14 * want.abs(),
                "{text} at ({q}, {p}): {got} for {want}"
            );
        }
    }
}

//! Random expressions compiled through the macro, bit-equal to the interpreter.
//!
//! `compiled/expressions.rs` and `compiled/more.rs` are written by the generator here (a test asks for the files to be
//! what it makes). Each is compiled with this file into a binary of its own: the second, with most of the expressions,
//! is `generated`, which `cargo test` leaves out. The macro reads the text of a tree; the interpreter runs the program derived from
//! the same tree. Both go H → structure → program with the same purposes in the same order, so
//! every value computed ahead agrees, and every bit of an `f64` must.

mod generate;
mod interpret;

use crate::counting::counted::Called;
use crate::expressions::{FILE, NUMBERS, compiled};
use crate::tree;
use generate::{TESTS, file, trees};
use hamiltonian::private::SVector;
use hamiltonian::{
    Separable, System,
    schemes::author::{Dynamics, Flow, Piece, Point, Scratch, VectorField},
};
use interpret::Interpreted;
use std::path::Path;

/// An `f64` whose functions are calls: inlined, they would be most of what rustc
/// compiles here.
type Number = Called<false>;

/// Numbers of an array.
pub fn numbers<const N: usize>(values: [f64; N]) -> [Number; N] {
    values.map(Called)
}

/// The point of evaluation.
#[derive(Clone, Debug)]
pub struct At {
    /// Time.
    pub t: f64,
    /// Coordinates.
    pub q: [f64; 2],
    /// Momenta.
    pub p: [f64; 2],
    /// Values of a, b and c.
    pub parameters: [f64; 3],
    /// The step coefficient of flows.
    pub c: f64,
    /// The vector that the Hessian is multiplied with.
    pub direction: [[f64; 2]; 2],
    /// The vector that flows add to.
    pub into: [[f64; 2]; 2],
}

/// Named outputs.
pub type Outputs = Vec<(&'static str, f64)>;

fn two(outputs: &mut Outputs, name: &'static str, values: SVector<Number, 2>) {
    outputs.extend(values.iter().map(|value| (name, value.0)));
}

/// The outputs of every system, in the order of [`interpret`](interpret).
pub fn any<S: System<Shape = SVector<(), 2>>>(system: &S, at: &At) -> Outputs {
    let prepared = system.prepare();
    let (t, q, p) = (
        Called(at.t),
        SVector::from(numbers(at.q)),
        SVector::from(numbers(at.p)),
    );
    let zero = SVector::from(numbers([f64::NAN; 2]));
    let (mut a, mut b) = (zero, zero);
    let mut outputs = vec![("energy", prepared.energy(t, &q, &p).0)];
    let energy = prepared.energy_and_gradient(t, &q, &p, &mut a, &mut b);
    outputs.push(("energy with gradient", energy.0));
    two(&mut outputs, "gradient with energy, q", a);
    two(&mut outputs, "gradient with energy, p", b);
    outputs.push(("time derivative", prepared.time_derivative(t, &q, &p).0));
    let [vq, vp] = at.direction.map(|row| SVector::from(numbers(row)));
    (a, b) = (zero, zero);
    prepared.hessian_vector(t, &q, &p, &vq, &vp, &mut a, &mut b);
    two(&mut outputs, "Hessian, q", a);
    two(&mut outputs, "Hessian, p", b);
    (a, b) = (zero, zero);
    prepared.gradient_q(t, &q, &p, &mut a);
    two(&mut outputs, "gradient by q", a);
    prepared.gradient_p(t, &q, &p, &mut b);
    two(&mut outputs, "gradient by p", b);
    (a, b) = (zero, zero);
    prepared.gradient(t, &q, &p, &mut a, &mut b);
    two(&mut outputs, "gradient, q", a);
    two(&mut outputs, "gradient, p", b);
    [a, b] = at.into.map(|row| SVector::from(numbers(row)));
    prepared.field(Called(at.c)).add(t, &q, &p, &mut a, &mut b);
    two(&mut outputs, "flow, q", a);
    two(&mut outputs, "flow, p", b);
    outputs
}

/// The further outputs of separable systems.
pub fn separable<S>(system: &S, at: &At) -> Outputs
where
    S: Separable + System<Shape = SVector<(), 2>>,
{
    let mut outputs = any(system, at);
    let prepared = system.prepare();
    let [a, b] = at.into.map(|row| SVector::from(numbers(row)));
    let (q, p) = (SVector::from(numbers(at.q)), SVector::from(numbers(at.p)));
    let mut point = Point { q, p: b };
    let kick = S::kick::<Number>().flow(&prepared, Called(at.c));
    let mut work = Scratch::like(&point);
    kick.apply(Called(at.t), &mut point, &mut work);
    two(&mut outputs, "kick", point.p);
    let mut point = Point { q: a, p };
    let drift = S::drift::<Number>().flow(&prepared, Called(at.c));
    let mut work = Scratch::like(&point);
    drift.apply(Called(at.t), &mut point, &mut work);
    two(&mut outputs, "drift", point.q);
    outputs
}

/// `compiled(number)` evaluates that expression; made in the generated file.
macro_rules! list {
    ($($number:literal $name:ident $kind:ident)*) => {
        /// The evaluation of an expression as the macro compiled it.
        pub fn compiled(number: usize) -> fn(&crate::compiled::At) -> crate::compiled::Outputs {
            match number {
                $($number => |at| {
                    let [a, b, c] = at.parameters;
                    let system = $name { a, b, c };
                    let mut outputs = crate::compiled::$kind(&system, at);
                    let state = hamiltonian::State::over(
                        crate::compiled::numbers(at.q),
                        crate::compiled::numbers(at.p),
                    );
                    let state = state.at(crate::counting::counted::Called(at.t));
                    let gradient = system.parameter_gradient(&state);
                    let values = [gradient.a, gradient.b, gradient.c];
                    outputs.extend(values.map(|value| ("parameters", value.0)));
                    outputs
                },)*
                _ => unreachable!("there are no more"),
            }
        }
    };
}
pub(crate) use list;

/// The committed file is the one that the generator makes. `HAMILTONIAN_GENERATE=1` writes it.
#[test]
fn the_file_is_what_is_generated() {
    let made = file(FILE, NUMBERS);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("tests/compiled").join(FILE);
    if std::env::var_os("HAMILTONIAN_GENERATE").is_some_and(|value| value == "1") {
        std::fs::write(&path, &made).expect("the file can be written");
    }
    let committed = std::fs::read_to_string(&path).expect("the file is committed");
    assert!(made == committed, "run with HAMILTONIAN_GENERATE=1 once");
}

#[test]
fn bits_are_those_of_the_interpreter() {
    let mut random = tree::Random(0xB175);
    let (mut compared, mut finite, mut separated) = (0, 0, 0);
    let mut wrong = Vec::new();
    let trees = trees(NUMBERS.end);
    for number in NUMBERS {
        let (tree, kind) = &trees[number];
        let interpreted = Interpreted::of(tree);
        assert_eq!(
            interpreted.is_separable(),
            *kind == "separable",
            "{}",
            tree.text()
        );
        separated += usize::from(*kind == "separable");
        for _ in 0..TESTS {
            let at = point(&mut random);
            let expected = interpreted.evaluate(&at);
            let found = compiled(number)(&at);
            assert_eq!(found.len(), expected.len());
            for ((name, found), (same, expected)) in found.into_iter().zip(expected) {
                assert_eq!(name, same);
                compared += 1;
                finite += usize::from(expected.is_finite());
                let both = found.is_nan() && expected.is_nan();
                if !both && found.to_bits() != expected.to_bits() {
                    wrong.push(format!(
                        "{number} {name}: {found:e} is not {expected:e}: {} at {at:?}",
                        tree.text()
                    ));
                }
            }
        }
    }
    println!("{compared} outputs, {finite} finite, {separated} of {NUMBERS:?} separable");
    assert!((1..NUMBERS.len()).contains(&separated));
    assert!(
        wrong.is_empty(),
        "{} of {compared}:\n{}",
        wrong.len(),
        wrong[..wrong.len().min(20)].join("\n")
    );
    assert!(
        finite * 4 > compared * 3,
        "{finite} of {compared} say something"
    );
}

/// Mostly numbers of order 1 of either sign, now and then one on an edge.
fn point(random: &mut tree::Random) -> At {
    let edges = random.chance(0.1);
    let mut number = || {
        if edges && random.chance(0.5) {
            return random.one_of(&[0.0, -0.0, 1.0, -1.0, 0.5, 2.0]);
        }
        let size = 2.0 * random.unit() + 0.01;
        if random.chance(0.3) { -size } else { size }
    };
    let mut two = || [number(), number()];
    let (q, p, direction, into) = (two(), two(), [two(), two()], [two(), two()]);
    let [t, c] = two();
    let ([a, b], [third, _]) = (two(), two());
    At {
        t,
        q,
        p,
        parameters: [a, b, third],
        c,
        direction,
        into,
    }
}

hamiltonian::hamiltonian! {
    /// Always H = p + sin²q, but the condition reads both.
    pub struct Conditional { a = 1.0 }
    H = if a/(if q <= p { q } else { 2 }) == 3 { p + sin(q)^2 } else { p + 1 - cos(q)^2 }
}

/// A condition couples q and p without a derivative that does: the drift must not read q.
#[test]
fn conditions_couple_without_a_derivative() {
    let prepared = System::prepare::<f64>(&Conditional::default());
    let mut point = Point {
        q: SVector::from([0.5]),
        p: SVector::from([0.25]),
    };
    <Conditional as Separable>::drift::<f64>()
        .flow(&prepared, 2.0)
        .apply(0.0, &mut point, &mut ());
    assert_eq!(point.q[0], 2.5);
}

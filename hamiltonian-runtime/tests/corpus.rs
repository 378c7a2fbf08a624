//! Every definition of the repository has the errors, the markers and the description that the macro has, and functions with
//! the bits of the engine's interpreter.
//!
//! Input: definitions, numbers for their parameters and a point. Output: a panic with the first difference. Invariant: a definition that is left out is so by the name of a feature.

use crate::backend;
use crate::common::{definitions, numbers};
use crate::emitted::Statements;
use hamiltonian::schemes::author::{self, Dynamics, Flow, Piece, Pieces, Scratch, VectorField};
use hamiltonian::systems::function::{Function, Grid, Spline};
use hamiltonian::{Dual, Real, Separable, Split, State, System};
use hamiltonian_language::analyse::structure::Kick;
use hamiltonian_language::analyse::{self, Analysis, analyse};
use hamiltonian_language::checked::Checked;
use hamiltonian_language::{read, report::Report};
use hamiltonian_runtime::{Definition, Run, RuntimeSystem, SystemError, Value, Values};
use hamiltonian_symbolic::dag::{Array, Column, Parameter, Partial, Side};
use hamiltonian_symbolic::index::{Affine, Size};
use hamiltonian_symbolic::interpret::{Point, run};
use hamiltonian_symbolic::model::{ExactFlow, Shape};
use hamiltonian_symbolic::program::{Purpose, Target};
use proc_macro2::TokenStream;
use std::collections::BTreeMap;
use std::sync::OnceLock;

type Vector = hamiltonian::nalgebra::DVector<f64>;

/// The size that each name has.
pub const SIZE: usize = 5;

fn extent(form: &Affine, size: usize) -> usize {
    let value = form.value(&|_| unreachable!("extents have no loops"), &|_: Size| {
        size as i64
    });
    usize::try_from(value).expect("extents are not negative")
}

/// A definition as the macro has it, before its code.
fn read_by_macro(text: &str, report: &mut Report) -> Option<(Checked, Analysis)> {
    let checked = read(text.parse().expect("it lexes"), report).1?;
    let analysis = analyse(&checked, report)?;
    Some((checked, analysis))
}

/// The system for the engine's interpreter.
pub fn analysed(text: &str) -> Option<analyse::System> {
    read_by_macro(text, &mut Report::default()).map(|(_, analysis)| analysis.whole)
}

/// The statements of the macro's code.
fn stated(checked: &Checked, analysis: &Analysis) -> Statements {
    let mut report = Report::default();
    let code = backend::code(checked, analysis, &TokenStream::new(), &mut report);
    assert!(report.is_empty(), "the macro refuses what it analysed");
    Statements::of_code(code.expect("there is code without an error"))
}

/// The functions with data of one and of two numbers, which repeat.
fn functions() -> &'static (Spline, Grid) {
    static FUNCTIONS: OnceLock<(Spline, Grid)> = OnceLock::new();
    FUNCTIONS.get_or_init(|| {
        let spline = Spline::periodic(&[0.0, 0.5, 1.25, 2.0, 3.0], &[1.0, 0.3, 1.4, 0.7, 1.0]);
        let rows = [
            [1.0, 0.5, 0.8, 0.2],
            [0.4, 1.2, 0.6, 0.9],
            [0.7, 0.3, 1.1, 1.3],
        ];
        let grid = Grid::periodic([0.0; 2], [0.75; 2], &rows);
        (spline.expect("it has knots"), grid.expect("it has points"))
    })
}

/// A derivative of such a function, as emitted code takes it.
fn external(part: Partial, at: &[f64]) -> f64 {
    fn value<T: Real>(at: &[T]) -> T {
        let (spline, grid) = functions();
        match at {
            [x] => spline.value([*x]),
            _ => grid.value([at[0], at[1]]),
        }
    }
    fn along<T: Real>(at: &[T], i: u16) -> Vec<Dual<T>> {
        let dual = |(k, x): (usize, &T)| match k == usize::from(i) {
            true => Dual::variable(*x),
            false => Dual::fixed(*x),
        };
        at.iter().enumerate().map(dual).collect()
    }
    match part {
        Partial::Value => value(at),
        Partial::First(i) => value(&along(at, i)).eps,
        Partial::Second(i, j) => value(&along(&along(at, j), i)).eps.eps,
        Partial::Higher { .. } => panic!("no program has it"),
    }
}

/// The system, with functions for the parameters that are functions.
fn system_of(definition: &Definition, mut values: Values) -> Result<RuntimeSystem, SystemError> {
    for name in definition.functions() {
        values = values.with(name, functions().0.clone());
    }
    loop {
        match definition.system(values.clone()) {
            Err(SystemError::NoFunction {
                name, arguments: 2, ..
            }) => {
                values = values.with(&name, functions().1.clone());
            }
            made => return made,
        }
    }
}

/// Numbers for all parameters.
pub fn values(system: &analyse::System, size: usize) -> Values {
    let mut next = numbers(7);
    let mut values = Values::new();
    for name in &system.model.sizes {
        values = values.with(name, size);
    }
    for parameter in &system.model.parameters {
        let value = match &parameter.shape {
            Shape::Scalar => Value::Number(next()),
            Shape::Vector(rows) | Shape::Lattice(rows, _) => {
                Value::List((0..extent(rows, size)).map(|_| next()).collect())
            }
            Shape::Matrix(rows, columns) => {
                let count = extent(rows, size) * extent(columns, size);
                Value::List((0..count).map(|_| next()).collect())
            }
        };
        values = values.with(&parameter.name, value);
    }
    values
}

/// The point of the interpreter with the same numbers.
fn point(system: &analyse::System, size: usize, [q, p]: [&Vector; 2]) -> Point<f64> {
    let mut next = numbers(7);
    let mut point = Point::new();
    (point.t, point.c) = (0.3, 0.7);
    point.externals = vec![external; system.model.externals.len()];
    point.sizes = vec![size; system.model.sizes.len()];
    for (number, parameter) in (0..).zip(&system.model.parameters) {
        let array = Array::Parameter(Parameter(number));
        point.scalars.push(f64::NAN);
        match &parameter.shape {
            Shape::Scalar => point.scalars[usize::from(number)] = next(),
            Shape::Vector(rows) | Shape::Lattice(rows, _) => {
                let list = (0..extent(rows, size)).map(|_| next()).collect();
                point.arrays.insert(array, vec![list]);
            }
            Shape::Matrix(rows, columns) => {
                let (rows, columns) = (extent(rows, size), extent(columns, size));
                let mut lists = vec![vec![0.0; rows]; columns];
                for row in 0..rows {
                    lists.iter_mut().for_each(|column| column[row] = next());
                }
                point.arrays.insert(array, lists);
            }
        }
    }
    let mut first = 0;
    for (number, group) in (0..).zip(&system.model.groups) {
        let rows = group.shape.rows().map_or(1, |rows| extent(rows, size));
        for column in 0..group.shape.columns() {
            for (side, from) in [(Side::Q, q), (Side::P, p)] {
                let at = Column {
                    side,
                    group: number,
                    column,
                };
                let list = from.as_slice()[first..first + rows].to_vec();
                let directions = list.iter().map(|x| x * 1.25).collect();
                point.arrays.insert(Array::Phase(at), vec![list.clone()]);
                point.arrays.insert(Array::Direction(at), vec![directions]);
                point.outputs.insert(Target::Phase(at), vec![list]);
            }
            first += rows;
        }
    }
    point
}

/// The outputs of one side in flat order.
fn flat(system: &analyse::System, point: &Point<f64>, side: Side) -> Vec<f64> {
    let mut all = Vec::new();
    for (number, group) in (0..).zip(&system.model.groups) {
        for column in 0..group.shape.columns() {
            let at = Column {
                side,
                group: number,
                column,
            };
            all.extend(&point.outputs[&Target::Phase(at)][0]);
        }
    }
    all
}

/// True if both are equal bit for bit; all NaNs are one.
fn same(a: &[f64], b: &[f64]) -> bool {
    let equal = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
    a.len() == b.len() && a.iter().zip(b).all(equal)
}

/// Moves a point by a flow.
fn moved(flow: &impl Flow<author::Point<Vector>>, t: f64, q: &mut Vector, p: &mut Vector) {
    moved_by(flow, t, q, p, false);
}

/// Moves a point by a flow, or by its terms in the opposite order.
fn moved_by<F: Flow<author::Point<Vector>>>(
    flow: &F,
    t: f64,
    q: &mut Vector,
    p: &mut Vector,
    is_reversed: bool,
) {
    let mut point = author::Point {
        q: q.clone(),
        p: p.clone(),
    };
    let mut work = Scratch::like(&point);
    match is_reversed {
        true => flow.apply_reversed(t, &mut point, &mut work),
        false => flow.apply(t, &mut point, &mut work),
    }
    (*q, *p) = (point.q, point.p);
}

/// The end of three steps by the flows of the pieces, one after the other, from the time 0.3.
fn steps_by_flows(system: &RuntimeSystem, q: &mut Vector, p: &mut Vector, h: f64) {
    let prepared = system.prepare::<f64>();
    let pieces = <RuntimeSystem as Split>::pieces::<f64>();
    let [none, half, whole] = [0.0, 0.5 * h, h].map(|c| pieces.outer(&prepared, c));
    let inner = pieces.inner(&prepared, 0.5 * h, 0.5 * h);
    let at = |k: i32| h * f64::from(k) + 0.3;
    moved(&half, at(0), q, p);
    for k in 0..3 {
        moved(&inner, at(k) + 0.5 * h, q, p);
        if pieces.merges(&prepared) {
            moved(if k < 2 { &whole } else { &half }, at(k + 1), q, p);
        } else {
            moved_by(&half, at(k + 1), q, p, true);
            moved(if k < 2 { &half } else { &none }, at(k + 1), q, p);
        }
    }
}

/// A run by name against the flows of the pieces: it makes many steps in one code. Returns true if it ended.
fn compare_steps(text: &str, made: &RuntimeSystem) -> bool {
    const H: f64 = 0.01;
    let mut next = numbers(3);
    let mut vector = || Vector::from_fn(made.degrees_of_freedom(), |_, _| next());
    let (mut q, mut p) = (vector(), vector());
    let start = State::new(q.clone(), p.clone()).at(0.3);
    let Ok(mut run) = Run::new(made, "Strang", start, H) else {
        return false;
    };
    if run.advance(3).is_err() {
        return false;
    }
    steps_by_flows(made, &mut q, &mut p, H);
    assert!(same(run.q(), q.as_slice()), "steps of {text}");
    assert!(same(run.p(), p.as_slice()), "steps of {text}");
    true
}

/// The markers, the reasons for the others, and the description against those in the code of the macro.
fn compare_statements(text: &str, due: &Statements, made: &RuntimeSystem) {
    let found = Statements::of_system(made.description());
    assert_eq!(found, *due, "{text}");
}

/// The functions of a system against the interpreter; returns how many were compared.
fn compare(text: &str, system: &analyse::System, made: &RuntimeSystem, size: usize) -> usize {
    let mut next = numbers(3);
    let mut vector = || Vector::from_fn(made.degrees_of_freedom(), |_, _| next());
    let (q, p) = (vector(), vector());
    let point = point(system, size, [&q, &p]);
    let prepared = made.prepare::<f64>();
    let has = |marker: &str| {
        let mut missing = made.description().missing.iter();
        missing.all(|missing| missing.marker != marker)
    };
    let mut compared = 0;
    for function in &system.program.functions {
        // Inner pieces are compared in runs. Derivatives by parameters are not offered.
        let is_offered = match function.purpose {
            Purpose::Energy
            | Purpose::EnergyAndGradient
            | Purpose::TimeDerivative
            | Purpose::HessianVector
            | Purpose::Gradient
            | Purpose::GradientQ
            | Purpose::GradientP
            | Purpose::VectorField
            | Purpose::Observable(_) => true,
            Purpose::Kick => has("Separable") && matches!(system.structure.kick, Some(Kick::Plain)),
            // The kick is this alone.
            Purpose::Push => {
                has("Separable")
                    && matches!(system.structure.kick, Some(Kick::Damped { rest: false }))
            }
            Purpose::Drift => has("Separable"),
            // The function of a matrix exponential adds rates, and is not the flow.
            Purpose::Piece(0) => {
                has("Split") && system.model.pieces[0].flow != ExactFlow::Exponential
            }
            Purpose::Rates | Purpose::Linear => false,
            Purpose::Piece(_) | Purpose::Vector(_) | Purpose::ParameterGradient => false,
        };
        if !is_offered {
            continue;
        }
        let mut outcome = point.clone();
        let found = run(&system.program, function, &point);
        outcome.outputs = found.outputs;
        let [due_q, due_p] = [Side::Q, Side::P].map(|side| flat(system, &outcome, side));
        let (mut own_q, mut own_p) = (q.clone(), p.clone());
        let (t, v) = (point.t, [&q * 1.25, &p * 1.25]);
        let mut results = Vec::new();
        match function.purpose {
            Purpose::Energy => results.push(prepared.energy(t, &q, &p)),
            Purpose::EnergyAndGradient => {
                results.push(prepared.energy_and_gradient(t, &q, &p, &mut own_q, &mut own_p));
            }
            Purpose::TimeDerivative => results.push(prepared.time_derivative(t, &q, &p)),
            Purpose::HessianVector => {
                prepared.hessian_vector(t, &q, &p, &v[0], &v[1], &mut own_q, &mut own_p);
            }
            Purpose::Gradient => prepared.gradient(t, &q, &p, &mut own_q, &mut own_p),
            Purpose::GradientQ => prepared.gradient_q(t, &q, &p, &mut own_q),
            Purpose::GradientP => prepared.gradient_p(t, &q, &p, &mut own_p),
            Purpose::VectorField => {
                prepared
                    .field(point.c)
                    .add(t, &q, &p, &mut own_q, &mut own_p);
                let (mut x, mut y) = (q.clone(), p.clone());
                prepared.add_field(point.c, t, &q, &p, &mut x, &mut y);
                assert!(same(x.as_slice(), own_q.as_slice()), "{text}");
                assert!(same(y.as_slice(), own_p.as_slice()), "{text}");
            }
            Purpose::Observable(number) => {
                let before = &system.model.observables[..usize::from(number)];
                let before: usize = before.iter().map(|of| of.components.len()).sum();
                for k in 0..found.results.len() {
                    results.push(prepared.observable(before + k, t, &q, &p));
                }
            }
            Purpose::Kick | Purpose::Push => {
                let kick = <RuntimeSystem as Separable>::kick::<f64>();
                moved(&kick.flow(&prepared, point.c), t, &mut own_q, &mut own_p);
            }
            Purpose::Drift => {
                let drift = <RuntimeSystem as Separable>::drift::<f64>();
                moved(&drift.flow(&prepared, point.c), t, &mut own_q, &mut own_p);
            }
            Purpose::Piece(_) => {
                let pieces = <RuntimeSystem as Split>::pieces::<f64>();
                moved(&pieces.outer(&prepared, point.c), t, &mut own_q, &mut own_p);
            }
            _ => unreachable!("it is not offered"),
        }
        let purpose = function.purpose;
        assert!(same(&results, &found.results), "{purpose:?} of {text}");
        assert!(same(own_q.as_slice(), &due_q), "{purpose:?} of {text}");
        assert!(same(own_p.as_slice(), &due_p), "{purpose:?} of {text}");
        compared += 1;
    }
    compared
}

#[test]
fn definitions_have_the_statements_of_the_macro_and_the_bits_of_the_interpreter() {
    let definitions = definitions();
    assert!(definitions.len() > 800, "{} definitions", definitions.len());
    let (mut functions, mut systems, mut refused, mut runs) = (0, 0, 0, 0);
    let mut left_out: BTreeMap<String, usize> = BTreeMap::new();
    // The rest belongs to the long sweeps.
    let is_heavy = std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1");
    for text in definitions.iter().step_by(if is_heavy { 1 } else { 6 }) {
        let mut report = Report::default();
        let by_macro = read_by_macro(text, &mut report);
        let (definition, (checked, analysis)) = match (Definition::parse(text, "text"), by_macro) {
            (Ok(made), Some(by_macro)) => (made, by_macro),
            (Err(errors), None) => {
                let due = report.errors().iter().map(|error| error.text());
                let found = errors.list().iter();
                let found = found.map(|error| format!("{}\nhelp: {}", error.message, error.help));
                assert_eq!(found.collect::<Vec<_>>(), due.collect::<Vec<_>>(), "{text}");
                refused += 1;
                continue;
            }
            (made, _) => panic!("{made:?}: {text}"),
        };
        let statements = stated(&checked, &analysis);
        let due = analysis.whole;
        // Loops of 32 iterations and more sum in trees.
        for size in [SIZE, 37] {
            if size != SIZE && due.model.sizes.is_empty() {
                continue;
            }
            match system_of(&definition, values(&due, size)) {
                Ok(made) => {
                    compare_statements(text, &statements, &made);
                    functions += compare(text, &due, &made, size);
                    runs += usize::from(compare_steps(text, &made));
                    systems += 1;
                }
                Err(error @ SystemError::NotCarried { .. }) => {
                    let (_, feature) = error.to_string().split_once(": ").map_or_else(
                        || panic!("{error}"),
                        |(place, feature)| (place.to_owned(), feature.to_owned()),
                    );
                    let words: Vec<&str> = feature.split(' ').take(2).collect();
                    *left_out.entry(words.join(" ")).or_default() += 1;
                }
                // Sizes that do not fit each other.
                Err(SystemError::Input(_)) => {}
                Err(error) => panic!("{error}: {text}"),
            }
        }
    }
    println!(
        "{systems} systems, {functions} functions, {runs} runs, {refused} refused, left out: {left_out:?}"
    );
    assert!(
        systems > 150 && functions > 1000 && runs > 100,
        "{systems}, {functions}, {runs}"
    );
    let known = ["the function", "second derivatives"];
    for feature in left_out.keys() {
        assert!(known.contains(&feature.as_str()), "{feature}");
    }
}

#[test]
fn another_number_has_other_bits() {
    let text = "struct Pendulum { g = 9.81 } H(q; p) = p^2/2 - g*cos(q)";
    let (definition, due) = (Definition::parse(text, "text"), analysed(text));
    let (definition, due) = (definition.expect("it is one"), due.expect("it is one"));
    let g = numbers(7)();
    let made = definition
        .system([("g", g * (1.0 + f64::EPSILON))])
        .expect("it has all");
    let differs = std::panic::catch_unwind(|| compare(text, &due, &made, SIZE));
    assert!(differs.is_err());
}

#[test]
fn another_structure_has_other_statements() {
    let text = "struct Spring { k = 1.0 } H(q; p) = p^2/2 + k*q^4";
    let (checked, analysis) = read_by_macro(text, &mut Report::default()).expect("it is one");
    let due = stated(&checked, &analysis);
    for (other, is_equal) in [
        (text.to_owned(), true),
        // The force, the coupling and the time take markers; the pieces have other formulas and names.
        (format!("{text} + q*p^3"), false),
        (format!("{text}; force(q; p) = -p"), false),
        (text.replace("(q; p)", "(q; p; t)") + "*cos(t)", false),
        (text.replace("q^4", "q^6"), false),
        (format!("{text}; split {{ T = p^2/2; V = k*q^4 }}"), false),
        (format!("{text}; invariant total = p^2/2 + k*q^4"), false),
    ] {
        let definition =
            Definition::parse(&other, "text").unwrap_or_else(|errors| panic!("{errors}"));
        let made = definition.system(Values::new()).expect("it has all");
        let found = Statements::of_system(made.description());
        assert_eq!(found == due, is_equal, "{other}");
    }
}

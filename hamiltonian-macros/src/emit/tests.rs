//! Snapshots of emitted code, from models made by hand.

use super::{
    Definition, Field, Form, Item, ObservableItem, ParameterItem, Reason, SizeItem, Structure,
    Text, closed,
};
use hamiltonian_symbolic::dag::{Array, Column, Dag, Node, Side};
use hamiltonian_symbolic::index::{Affine, Index, Size};
use hamiltonian_symbolic::model::{
    Group, Model, Observable, ObservableKind, ParameterDeclaration, Shape,
};
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::pipeline;
use hamiltonian_symbolic::program::{Program, Purpose};
use hamiltonian_symbolic::rational::Rational;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// A model with scalar groups and parameters.
fn scalars(name: &str, groups: &[(&str, &str)], parameters: &[&str]) -> Model {
    Model {
        name: name.into(),
        groups: groups.iter().map(|(q, p)| Group::scalar(*q, *p)).collect(),
        parameters: parameters
            .iter()
            .map(|name| ParameterDeclaration {
                name: (*name).into(),
                shape: Shape::Scalar,
            })
            .collect(),
        ..Model::default()
    }
}

fn program(model: &mut Model, separable: bool) -> Program {
    let mut wanted = vec![
        Purpose::Energy,
        Purpose::GradientQ,
        Purpose::GradientP,
        Purpose::Gradient,
        Purpose::EnergyAndGradient,
        Purpose::TimeDerivative,
        Purpose::HessianVector,
        Purpose::VectorField,
    ];
    if !model.parameters.is_empty() {
        wanted.push(Purpose::ParameterGradient);
    }
    if separable {
        wanted.extend([Purpose::Kick, Purpose::Drift]);
    }
    wanted.extend((0..model.observables.len()).map(|at| Purpose::Observable(at as u16)));
    pipeline::derive(model, &wanted).unwrap()
}

fn item(model: &Model, defaults: &[&str], run_time: &[bool]) -> Item {
    let ident = |name: &str| Ident::new(name, Span::call_site());
    let sizes = model
        .sizes
        .iter()
        .zip(run_time)
        .map(|(name, run_time)| SizeItem {
            name: ident(name),
            run_time: *run_time,
            attributes: Vec::new(),
        });
    let parameters = model
        .parameters
        .iter()
        .enumerate()
        .map(|(at, parameter)| ParameterItem {
            name: ident(&parameter.name),
            attributes: Vec::new(),
            default: defaults.get(at).and_then(|digits| {
                let value = Rational::decimal(digits)?;
                let mut dag = Dag::new();
                let value = dag.constant(value);
                closed(&dag, value).map(|text| vec![text])
            }),
        });
    let run_time = run_time
        .iter()
        .enumerate()
        .filter(|(_, run_time)| **run_time);
    Item {
        attributes: vec![quote! { #[doc = " A system."] }],
        visibility: quote! { pub },
        name: ident(&model.name),
        whole: None,
        sizes: sizes.collect(),
        parameters: parameters.collect(),
        fields: run_time
            .map(|(at, _)| Field::Size(at))
            .chain((0..model.parameters.len()).map(Field::Parameter))
            .collect(),
    }
}

fn structure(separable: bool) -> Structure {
    let reason = Reason {
        message: "H is not separable: the term `0.5*q^2*p^2` couples q and p".into(),
        label: "needs H = T(p) + V(q)".into(),
        note: "use a scheme for any H".into(),
    };
    let verdict = if separable { Ok(()) } else { Err(reason) };
    Structure {
        halves: ["V".into(), "T".into()],
        separable: verdict.clone(),
        split: verdict.clone(),
        nystrom: (verdict.clone()).map(|()| super::Nystrom::Halves),
        quadratic_kinetic: verdict,
        unforced: Ok(()),
        exact: Ok(()),
        kick: separable.then_some(super::Kick::Plain),
        autonomous: Ok(()),
        cyclic: Vec::new(),
    }
}

fn emit(model: &mut Model, form: Form, separable: bool) -> TokenStream {
    let program = program(model, separable);
    let observables = model.observables.iter().map(|observable| ObservableItem {
        name: Ident::new(&observable.name, Span::call_site()),
        attributes: Vec::new(),
    });
    super::generate(&Definition {
        root: quote! { ::hamiltonian_core },
        observables: observables.collect(),
        model,
        program: &program,
        form,
        structure: structure(separable),
        text: Text {
            hamiltonian: "H = …".into(),
            ..Text::default()
        },
        functions: &[],
        vectors: Vec::new(),
        declared: None,
        pieces: Vec::new(),
        reaches: &[],
    })
}

fn half() -> Rational {
    Rational::new(1, 2)
}

pub fn pendulum() -> TokenStream {
    let mut model = scalars("Pendulum", &[("theta", "p")], &["m", "l", "g"]);
    let (q, p) = (model.scalar(Side::Q, 0), model.scalar(Side::P, 0));
    let d = &mut model.dag;
    let [m, l, g] = [0, 1, 2].map(|at| d.parameter(hamiltonian_symbolic::dag::Parameter(at)));
    let kinetic = d.product(&half(), &[(p, 2), (m, -1), (l, -2)]);
    let cos = d.call(Op::Cos, &[q]);
    let potential = d.mul(&[m, g, l, cos]);
    model.hamiltonian = Some(d.sub(kinetic, potential));
    let item = item(&model, &["1", "10", "981e-2"], &[]);
    emit(&mut model, Form::Item(item), true)
}

pub fn nonseparable() -> TokenStream {
    let mut model = scalars("HamiltonianValue", &[("q", "p")], &["a"]);
    let (q, p) = (model.scalar(Side::Q, 0), model.scalar(Side::P, 0));
    let d = &mut model.dag;
    let a = d.parameter(hamiltonian_symbolic::dag::Parameter(0));
    let one = d.integer(1);
    let plus = |d: &mut Dag, x: Node| {
        let square = d.powi(x, 2);
        d.add(&[square, one])
    };
    let (x, y) = (plus(d, q), plus(d, p));
    model.hamiltonian = Some(d.product(&half(), &[(a, 1), (x, 1), (y, 1)]));
    let captures = vec![Ident::new("a", Span::call_site())];
    emit(&mut model, Form::Expression(captures), false)
}

fn arrays(name: &str, shape: Shape<u16>, size: &str) -> Model {
    Model {
        name: name.into(),
        groups: vec![Group {
            velocity: None,
            coordinate: "q".into(),
            momentum: "p".into(),
            shape,
        }],
        sizes: vec![size.into()],
        ..Model::default()
    }
}

fn phase(side: Side, column: u16) -> Array {
    Array::Phase(Column {
        side,
        group: 0,
        column,
    })
}

pub fn toda() -> TokenStream {
    let n = Affine::size(Size(0));
    let mut model = arrays("Toda", Shape::Vector(n.clone()), "N");
    let d = &mut model.dag;
    let domain = d.domain(None, Affine::default(), n.clone());
    let i = Affine::variable(domain);
    let next = Index::wrapped(i.plus(1, &Affine::constant(1)), n);
    let here = Index::plain(i);
    let q0 = d.element(phase(Side::Q, 0), here.clone(), None);
    let q1 = d.element(phase(Side::Q, 0), next, None);
    let p = d.element(phase(Side::P, 0), here, None);
    let difference = d.sub(q0, q1);
    let exp = d.call(Op::Exp, &[difference]);
    let square = d.product(&half(), &[(p, 2)]);
    let body = d.add(&[square, exp]);
    let momentum = d.reduce(domain, p);
    model.hamiltonian = Some(d.reduce(domain, body));
    model.observables.push(Observable {
        name: "total_momentum".into(),
        kind: ObservableKind::Invariant,
        components: vec![momentum],
    });
    let item = item(&model, &[], &[false]);
    emit(&mut model, Form::Item(item), true)
}

pub fn gravity() -> TokenStream {
    let n = Affine::size(Size(0));
    let mut model = arrays("Gravity", Shape::Matrix(n.clone(), 3), "n");
    model.parameters = vec![
        ParameterDeclaration {
            name: "G".into(),
            shape: Shape::Scalar,
        },
        ParameterDeclaration {
            name: "m".into(),
            shape: Shape::Vector(n.clone()),
        },
    ];
    let d = &mut model.dag;
    let outer = d.domain(None, Affine::default(), n);
    let inner = d.domain(Some(outer), Affine::default(), Affine::variable(outer));
    let (i, j) = (Affine::variable(outer), Affine::variable(inner));
    let g = d.parameter(hamiltonian_symbolic::dag::Parameter(0));
    let mass = Array::Parameter(hamiltonian_symbolic::dag::Parameter(1));
    let element =
        |d: &mut Dag, array, index: &Affine| d.element(array, Index::plain(index.clone()), None);
    let (mi, mj) = (element(d, mass, &i), element(d, mass, &j));
    let momenta: Vec<Node> = (0..3).map(|c| element(d, phase(Side::P, c), &i)).collect();
    let squares = d.sum_of_squares(&momenta);
    let kinetic = d.product(&half(), &[(squares, 1), (mi, -1)]);
    let kinetic = d.reduce(outer, kinetic);
    let differences: Vec<Node> = (0..3)
        .map(|c| {
            let (a, b) = (
                element(d, phase(Side::Q, c), &i),
                element(d, phase(Side::Q, c), &j),
            );
            d.sub(a, b)
        })
        .collect();
    let squares = d.sum_of_squares(&differences);
    let distance = d.call(Op::Sqrt, &[squares]);
    let pair = d.product(&Rational::ONE, &[(mi, 1), (mj, 1), (distance, -1)]);
    let pair = d.reduce(inner, pair);
    let pairs = d.reduce(outer, pair);
    let potential = d.mul(&[g, pairs]);
    model.hamiltonian = Some(d.sub(kinetic, potential));
    let item = item(&model, &["1"], &[true]);
    emit(&mut model, Form::Item(item), true)
}

fn pretty(tokens: &TokenStream) -> String {
    prettyplease::unparse(&syn::parse2(tokens.clone()).unwrap())
}

#[test]
fn pendulum_is_emitted() {
    insta::assert_snapshot!(pretty(&pendulum()));
}

#[test]
fn expression_form_is_emitted() {
    let value = nonseparable();
    insta::assert_snapshot!(pretty(&quote! { fn value() { let value = #value; } }));
}

#[test]
fn loops_stay_loops() {
    insta::assert_snapshot!(pretty(&toda()));
}

#[test]
fn pair_sums_with_a_size_of_run_time() {
    insta::assert_snapshot!(pretty(&gravity()));
}

#[test]
fn emission_is_deterministic() {
    assert_eq!(pendulum().to_string(), pendulum().to_string());
    assert_eq!(gravity().to_string(), gravity().to_string());
}

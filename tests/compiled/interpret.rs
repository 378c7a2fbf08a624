//! The same trees through the engine and its interpreter, as the macro's back end drives it.

use super::{At, Outputs};
use crate::symbolic::PURPOSES;
use crate::tree::{PAIRS, PARAMETERS, Tree};
use hamiltonian_language::{lower::lower, read, report::Report};
use hamiltonian_symbolic::dag::{Array, Column, Dependence, Parameter, Side};
use hamiltonian_symbolic::interpret::{Outcome, Point, run};
use hamiltonian_symbolic::jumps::jumps;
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Program, Purpose, Target};
use hamiltonian_symbolic::{split, structure};

/// A tree as a program.
pub struct Interpreted {
    program: Program,
    is_separable: bool,
    has_momentum: bool,
}

impl Interpreted {
    /// Structure, then the program for all purposes, in the order of the back end.
    pub fn of(tree: &Tree) -> Interpreted {
        // The numbers of nodes decide the order of some sums: the model is read as the macro reads it.
        let mut model = read_as_text(tree).unwrap_or_else(|| tree.model());
        let has_momentum = model
            .hamiltonian
            .is_some_and(|h| model.dag.dependence(h).on(Dependence::P));
        let structure = structure::analyse(&mut model);
        let mut wanted = PURPOSES[..8].to_vec();
        if let Ok(split) = &structure.separable {
            if !split.as_written {
                model.hamiltonian = Some(model.dag.add(&[split.kinetic, split.potential]));
            }
            wanted.extend([Purpose::Kick, Purpose::Drift]);
        } else if let Ok(splitting) = split::find(&mut model) {
            model.pieces = splitting.pieces;
            let mut pieces = model.pieces.iter();
            let first = pieces.position(|piece| !jumps(&mut model.dag, piece.h));
            if let Some(first) = first {
                model.pieces[..=first].rotate_right(1);
            }
        }
        let h = model.h();
        if jumps(&mut model.dag, h) {
            let halves = structure.separable.iter();
            let halves = halves.flat_map(|split| [split.potential, split.kinetic]);
            let parts = halves.chain(model.pieces.iter().map(|piece| piece.h));
            for part in parts.collect::<Vec<_>>() {
                // The question makes nodes, as it does in the macro.
                let _ = jumps(&mut model.dag, part);
            }
        }
        wanted.push(Purpose::ParameterGradient);
        wanted.extend((0..model.pieces.len()).map(|at| Purpose::Piece(at as u16)));
        Interpreted {
            program: derive(&mut model, &wanted).expect("a program"),
            is_separable: structure.separable.is_ok(),
            has_momentum,
        }
    }

    /// True if H depends on momenta, of which some may cancel.
    pub fn has_momentum(&self) -> bool {
        self.has_momentum
    }

    pub fn is_separable(&self) -> bool {
        self.is_separable
    }

    /// Every output at a point.
    pub fn evaluate(&self, at: &At) -> Outputs {
        let mut outputs = Outputs::new();
        self.add(&mut outputs, at, Purpose::Energy, Some("energy"), &[]);
        let names = ["gradient with energy, q", "gradient with energy, p"];
        let energy = Some("energy with gradient");
        self.add(
            &mut outputs,
            at,
            Purpose::EnergyAndGradient,
            energy,
            &sides(names),
        );
        let time = Some("time derivative");
        self.add(&mut outputs, at, Purpose::TimeDerivative, time, &[]);
        let names = ["Hessian, q", "Hessian, p"];
        self.add(
            &mut outputs,
            at,
            Purpose::HessianVector,
            None,
            &sides(names),
        );
        let [by_q, by_p] = sides(["gradient by q", "gradient by p"]);
        self.add(&mut outputs, at, Purpose::GradientQ, None, &[by_q]);
        self.add(&mut outputs, at, Purpose::GradientP, None, &[by_p]);
        let names = ["gradient, q", "gradient, p"];
        self.add(&mut outputs, at, Purpose::Gradient, None, &sides(names));
        self.add(
            &mut outputs,
            at,
            Purpose::VectorField,
            None,
            &sides(["flow, q", "flow, p"]),
        );
        if self.is_separable {
            self.add(&mut outputs, at, Purpose::Kick, None, &[("kick", Side::P)]);
            self.add(
                &mut outputs,
                at,
                Purpose::Drift,
                None,
                &[("drift", Side::Q)],
            );
        }
        let outcome = self.outcome(at, Purpose::ParameterGradient);
        for number in 0..PARAMETERS {
            let target = Target::Parameter(Parameter(number as u16));
            outputs.push(("parameters", outcome.outputs[&target][0][0]));
        }
        outputs
    }

    /// The value and the stores of a purpose.
    fn add(
        &self,
        outputs: &mut Outputs,
        at: &At,
        purpose: Purpose,
        result: Option<&'static str>,
        stores: &[(&'static str, Side)],
    ) {
        let outcome = self.outcome(at, purpose);
        outputs.extend(result.map(|name| (name, outcome.results[0])));
        for (name, side) in stores {
            for group in 0..PAIRS as u16 {
                outputs.push((*name, outcome.outputs[&phase(*side, group)][0][0]));
            }
        }
    }

    fn outcome(&self, at: &At, purpose: Purpose) -> Outcome<f64> {
        let function = self.program.function(purpose).expect("it was asked for");
        let adds = matches!(
            purpose,
            Purpose::VectorField | Purpose::Kick | Purpose::Drift
        );
        run(&self.program, function, &point(at, adds))
    }
}

fn sides(names: [&'static str; 2]) -> [(&'static str, Side); 2] {
    [(names[0], Side::Q), (names[1], Side::P)]
}

fn phase(side: Side, group: u16) -> Target {
    Target::Phase(Column::first(side, group))
}

/// The point as the interpreter reads it; outputs that are not added to start as NaN.
fn point(at: &At, adds: bool) -> Point<f64> {
    let mut point = Point::new();
    (point.t, point.c) = (at.t, at.c);
    point.scalars = at.parameters.to_vec();
    for (number, side) in [Side::Q, Side::P].into_iter().enumerate() {
        for group in 0..PAIRS {
            let values = [at.q, at.p][number][group];
            let direction = at.direction[number][group];
            let into = if adds {
                at.into[number][group]
            } else {
                f64::NAN
            };
            let group = group as u16;
            let column = Column::first(side, group);
            point
                .arrays
                .insert(Array::Phase(column), vec![vec![values]]);
            point
                .arrays
                .insert(Array::Direction(column), vec![vec![direction]]);
            point.outputs.insert(phase(side, group), vec![vec![into]]);
        }
    }
    for number in 0..PARAMETERS {
        let target = Target::Parameter(Parameter(number as u16));
        point.outputs.insert(target, vec![vec![f64::NAN]]);
    }
    point
}

/// The model of a tree's text; `None` if the language refuses it, for example without momenta.
fn read_as_text(tree: &Tree) -> Option<Model> {
    let text = tree.text();
    let text = format!("pub struct Read {{ a, b, c }} H(x, y; px, py; t) = {text}");
    let mut report = Report::default();
    let (_, checked) = read(text.parse().ok()?, &mut report);
    Some(lower(&checked?, &mut report)?.model)
}

//! The code of a system at given sizes, with its description.
//!
//! Input: the analysis of a definition, the sizes. Output: [`Code`], which all scalars share. Invariant: a property that a
//! scheme may require is proven, or missing in the description with the reason.

use crate::flatten::{Kind, Places, Setting, computed, stage};
use crate::joined::Cycles;
use crate::op::{FunctionCode, Stage, To};
use crate::sizes::value;
use crate::unroll::{Straight, frames, straight};
use crate::variables::{Coordinates, Declared, coordinates};
use hamiltonian_core::schemes::author::{Description, Group, Observable, ObservableKind};
use hamiltonian_core::systems::{Missing, NamedPiece};
use hamiltonian_language::analyse::described::Described;
use hamiltonian_language::analyse::structure::{
    FieldSource, GradientSource, Kick, Nystrom, Reason, Verdicts,
};
use hamiltonian_language::analyse::{System, variables};
use hamiltonian_symbolic::dag::Side;
use hamiltonian_symbolic::halves::are_apart;
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::model::{self, ExactFlow, Model, Shape, VectorUse};
use hamiltonian_symbolic::program::{Function, Purpose, Target};
use std::sync::Arc;

/// The flow of a piece of H.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    /// V.
    Kick,
    /// T.
    Drift,
    /// A piece of the model, by number.
    Piece(usize),
}

/// The kind of the flow of a piece of the model.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FlowKind {
    /// The side that it reads, if it moves the other one alone.
    pub(crate) one_way: Option<Side>,
    /// Its function from the last term to the first, if terms do not commute.
    pub(crate) backward: Option<Arc<FunctionCode>>,
    /// True if the function adds rates, whose matrix is exponentiated.
    pub(crate) is_exponential: bool,
}

/// The purposes that steps ask for.
const OFTEN: [Purpose; 9] = [
    Purpose::Energy,
    Purpose::EnergyAndGradient,
    Purpose::Gradient,
    Purpose::GradientQ,
    Purpose::GradientP,
    Purpose::HessianVector,
    Purpose::VectorField,
    Purpose::Kick,
    Purpose::Drift,
];

/// The number of the function of a purpose.
fn position(functions: &[(Purpose, Arc<FunctionCode>)], purpose: Purpose) -> Option<usize> {
    functions.iter().position(|(known, _)| *known == purpose)
}

/// A system at given sizes.
#[derive(Debug, PartialEq)]
pub(crate) struct Code {
    pub(crate) sizes: Vec<usize>,
    pub(crate) size_names: Vec<String>,
    pub(crate) parameter_names: Vec<String>,
    pub(crate) function_names: Vec<String>,
    /// The extents of parameters; none of a number.
    pub(crate) extents: Vec<Vec<usize>>,
    pub(crate) description: Description,
    pub(crate) coordinates: Vec<Coordinates>,
    /// The variables in which the definition is written, if the system has others.
    pub(crate) declared: Option<Declared>,
    pub(crate) places: Places,
    pub(crate) prepare: Stage,
    pub(crate) functions: Vec<(Purpose, Arc<FunctionCode>)>,
    /// The numbers of the functions of [`OFTEN`].
    pub(crate) often: [Option<usize>; OFTEN.len()],
    pub(crate) gradient: GradientSource,
    /// True if the gradient is the two halves one after the other.
    pub(crate) gradient_is_apart: bool,
    pub(crate) field: FieldSource,
    /// The functions that the kick is made of.
    pub(crate) kick: Option<Kick>,
    /// The uses of the vector functions.
    pub(crate) vectors: Vec<VectorUse>,
    /// The pieces of `Split`, the outermost first; none if it is missing.
    pub(crate) pieces: Vec<Part>,
    /// Of each piece of the model the kind of its flow.
    pub(crate) flows: Vec<FlowKind>,
    /// The codes of its steps.
    pub(crate) cycles: Cycles,
    /// Those of `Nystrom`: the kick, and the piece that is at most quadratic in the momenta.
    pub(crate) nystrom: Option<[Part; 2]>,
}

impl Code {
    /// The code of a system, or the feature for which there is none.
    pub(crate) fn of(
        system: &System,
        declared: Option<&variables::Declared>,
        function_names: &[String],
        sizes: &[usize],
    ) -> Result<Code, String> {
        let System {
            model,
            program,
            structure,
            ..
        } = system;
        let (coordinates, len) = coordinates(&model.groups, sizes);
        let places = places(system, len, sizes);
        let setting = Setting {
            program,
            sizes,
            places: &places,
        };
        let prepared = &program.prepared;
        let (prepare, _) = stage(setting, Kind::Prepare, &program.prepare, &[], prepared)?;
        let (mut functions, mut flows) = (Vec::new(), Vec::new());
        for function in &program.functions {
            // Derivatives by parameters are not part of a run.
            if function.purpose != Purpose::ParameterGradient {
                let (code, flow) = of_function(setting, function)?;
                functions.push((function.purpose, code));
                flows.push(flow);
            }
        }
        for ((_, code), framed) in functions.iter_mut().zip(frames(places.len, flows)) {
            code.framed = framed;
        }
        let functions = functions.into_iter();
        let functions = functions.map(|(purpose, code)| (purpose, Arc::new(code)));
        let functions: Vec<_> = functions.collect();
        let halves = [Purpose::GradientQ, Purpose::GradientP];
        let flow_kind = |(number, piece): (usize, &model::Piece)| {
            let purpose = Purpose::Piece(number as u16);
            let function = program.function(purpose);
            let code = position(&functions, purpose).map(|at| &functions[at].1);
            let backward = code.filter(|_| !piece.flow.merges());
            FlowKind {
                one_way: function.and_then(|function| program.one_way(function)),
                backward: backward.map(|code| Arc::new(code.reversed())),
                is_exponential: piece.flow == ExactFlow::Exponential,
            }
        };
        let flow_kinds = model.pieces.iter().enumerate().map(flow_kind).collect();
        let described = Described::of(model, structure, &system.text);
        let mut description = description(model, structure, described, &places);
        let mut lack = |marker: &'static str, reason: Option<Reason>| {
            let missing = reason.map(|reason| Missing {
                marker: marker.into(),
                message: reason.message.into(),
                label: reason.label.into(),
                note: reason.note.into(),
            });
            description.missing.to_mut().extend(missing);
        };
        lack("Separable", structure.separable.clone().err());
        lack("Split", structure.split.clone().err());
        lack("Nystrom", structure.nystrom.clone().err());
        lack(
            "QuadraticKinetic",
            structure.quadratic_kinetic.clone().err(),
        );
        lack("Unforced", structure.unforced.clone().err());
        lack("Exact", structure.exact.clone().err());
        lack("Autonomous", structure.autonomous.clone().err());
        Ok(Code {
            sizes: sizes.to_vec(),
            size_names: model.sizes.clone(),
            parameter_names: model.parameters.iter().map(|of| of.name.clone()).collect(),
            function_names: function_names.to_vec(),
            extents: (model.parameters.iter().map(|of| extents(&of.shape, sizes))).collect(),
            description,
            prepare,
            often: OFTEN.map(|purpose| position(&functions, purpose)),
            functions,
            gradient: system.gradient,
            gradient_is_apart: are_apart(program, Purpose::Gradient, halves),
            field: system.field,
            kick: structure.kick,
            vectors: model.vectors.iter().map(|vector| vector.usage).collect(),
            declared: declared.map(|declared| Declared::of(declared, &coordinates, sizes)),
            coordinates,
            pieces: pieces(model, structure),
            flows: flow_kinds,
            cycles: Cycles::default(),
            nystrom: match &structure.nystrom {
                Err(_) => None,
                Ok(Nystrom::Halves) => Some([Part::Kick, Part::Drift]),
                Ok(Nystrom::Pieces(numbers)) => Some(numbers.map(Part::Piece)),
            },
            places,
        })
    }

    /// The purpose of the vector function with this use.
    pub(crate) fn vector(&self, usage: VectorUse) -> Option<Purpose> {
        let at = self.vectors.iter().position(|known| *known == usage);
        at.map(|at| Purpose::Vector(at as u16))
    }

    /// True if flows of a part for two durations are the flow for their sum.
    pub(crate) fn merges(&self, part: Part) -> bool {
        match part {
            Part::Kick => self.kick != Some(Kick::SubStep),
            Part::Drift => true,
            Part::Piece(number) => self.flows[number].backward.is_none(),
        }
    }

    /// The function of a purpose.
    pub(crate) fn function(&self, purpose: Purpose) -> Option<&Arc<FunctionCode>> {
        Some(&self.functions[self.number(purpose)?].1)
    }

    /// The number of the function of a purpose.
    #[inline(always)]
    pub(crate) fn number(&self, purpose: Purpose) -> Option<usize> {
        match purpose {
            Purpose::Energy => self.often[0],
            Purpose::EnergyAndGradient => self.often[1],
            Purpose::Gradient => self.often[2],
            Purpose::GradientQ => self.often[3],
            Purpose::GradientP => self.often[4],
            Purpose::HessianVector => self.often[5],
            Purpose::VectorField => self.often[6],
            Purpose::Kick => self.often[7],
            Purpose::Drift => self.often[8],
            _ => position(&self.functions, purpose),
        }
    }
}

/// The extents of a parameter.
fn extents(shape: &Shape, sizes: &[usize]) -> Vec<usize> {
    let extent = |form: &Affine| value(form, sizes).max(0) as usize;
    match shape {
        Shape::Scalar => Vec::new(),
        Shape::Vector(rows) => vec![extent(rows)],
        Shape::Matrix(rows, columns) => vec![extent(rows), extent(columns)],
        Shape::Lattice(_, axes) => axes.iter().map(extent).collect(),
    }
}

/// The places of coordinates and of arrays.
fn places(system: &System, len: usize, sizes: &[usize]) -> Places {
    let model = &system.model;
    let extent = |form: &Affine| value(form, sizes).max(0) as usize;
    let mut next = 0;
    let groups = model.groups.iter().map(|group| {
        let rows = group.shape.rows().map_or(1, extent);
        let first = next;
        next += rows * usize::from(group.shape.columns());
        (first, rows)
    });
    let groups = groups.collect();
    let mut data = 0;
    let parameters = model.parameters.iter().map(|parameter| {
        let (count, columns) = match &parameter.shape {
            Shape::Scalar => (0, 1),
            Shape::Vector(rows) | Shape::Lattice(rows, _) => (extent(rows), 1),
            Shape::Matrix(rows, columns) => (extent(rows) * extent(columns), extent(columns)),
        };
        let first = data;
        data += count;
        (first, columns)
    });
    let parameters = parameters.collect();
    let hoisted = system.program.hoisted.iter().map(|array| {
        let first = data;
        data += extent(&array.rows);
        first
    });
    let hoisted = hoisted.collect();
    Places {
        groups,
        len,
        parameters,
        hoisted,
        data,
    }
}

/// The code of a function, and that of a flow in a frame before its registers are numbered.
fn of_function(
    setting: Setting,
    function: &Function,
) -> Result<(FunctionCode, Option<Straight>), String> {
    let mut coefficients = Vec::new();
    computed(&function.coefficient, &mut coefficients);
    let kind = match function.purpose {
        Purpose::Piece(_) | Purpose::Push if setting.program.one_way(function).is_none() => {
            Kind::InPlace
        }
        _ => Kind::Plain,
    };
    let (steps, results) = (&function.evaluation, &function.results);
    let (mut evaluation, read) = stage(setting, kind, steps, &coefficients, results)?;
    let (coefficient, _) = stage(setting, Kind::Plain, &function.coefficient, &[], &read)?;
    let flow = match function.purpose {
        Purpose::Kick | Purpose::Drift | Purpose::Piece(_) if results.is_empty() => {
            straight(setting, kind, steps, &coefficients, &read)
        }
        _ => None,
    };
    let cleared = function.cleared.iter().map(|target| match target {
        Target::Phase(column) => {
            let to = match column.side {
                Side::Q => To::Q,
                Side::P => To::P,
            };
            let (first, rows) = setting.places.groups[usize::from(column.group)];
            let first = first + rows * usize::from(column.column);
            Ok((to, first, first + rows))
        }
        _ => Err("derivatives by parameters".to_owned()),
    });
    evaluation.cleared = cleared.collect::<Result<_, String>>()?;
    let code = FunctionCode {
        coefficient,
        evaluation,
        framed: None,
    };
    Ok((code, flow))
}

/// The pieces of the splitting; none if there is no splitting.
fn pieces(model: &Model, structure: &Verdicts) -> Vec<Part> {
    if structure.split.is_err() {
        return Vec::new();
    }
    if model.pieces.is_empty() {
        return match structure.is_drift_first() {
            true => vec![Part::Drift, Part::Kick],
            false => vec![Part::Kick, Part::Drift],
        };
    }
    let kick = structure.is_forced_apart().then_some(Part::Kick);
    let numbers = 0..model.pieces.len();
    numbers.map(Part::Piece).chain(kick).collect()
}

fn description(
    model: &Model,
    structure: &Verdicts,
    described: Described,
    places: &Places,
) -> Description {
    let groups = model.groups.iter().zip(&places.groups);
    let group = |(group, (first, _)): (&model::Group, &(usize, usize))| Group {
        coordinate: group.coordinate.clone().into(),
        momentum: group.momentum.clone().into(),
        rank: match &group.shape {
            Shape::Scalar => 0,
            Shape::Vector(_) => 1,
            Shape::Matrix(..) => 2,
            Shape::Lattice(_, axes) => axes.len(),
        },
        part: 0,
        offset: *first,
        columns: group.shape.columns().into(),
    };
    let observable =
        |one: hamiltonian_language::analyse::described::DescribedObservable| Observable {
            name: one.name.into(),
            kind: match one.kind {
                model::ObservableKind::Monitor => ObservableKind::Monitor,
                model::ObservableKind::Invariant => ObservableKind::Invariant,
                model::ObservableKind::Event => ObservableKind::Event,
            },
            depends_on_time: one.timed,
            reads: one.reads,
        };
    let piece = |one: hamiltonian_language::analyse::described::DescribedPiece| NamedPiece {
        name: one.name.into(),
        formula: one.formula.into(),
        jumps: one.jumps,
    };
    Description {
        name: model.name.clone().into(),
        formula: described.formula.into(),
        groups: groups.map(group).collect(),
        observables: described.observables.into_iter().map(observable).collect(),
        cyclic: structure
            .cyclic
            .iter()
            .map(|name| name.clone().into())
            .collect(),
        pieces: described.pieces.into_iter().map(piece).collect(),
        fictitious_time: model.evolution.clone().map(Into::into),
        is_forced: !model.force.is_empty(),
        is_autonomous: structure.autonomous.is_ok(),
        growth: structure.growth,
        jumps: described.jumps,
        missing: Vec::new().into(),
    }
}

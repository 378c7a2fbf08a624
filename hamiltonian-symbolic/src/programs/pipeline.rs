//! From H to a program: the passes in order.
//!
//! Input: a [`Model`] and the purposes wanted. Output: a [`Program`]. Invariant: the program depends on the
//! input alone, and contains only values that a function needs.

use crate::dag::{Dag, Kind, Map, Node, Partial, Stage, work};
use crate::hoist::Arrays;
use crate::model::Model;
use crate::overflow::OutOfRange;
use crate::program::{Program, Purpose, Step};
use crate::programs::balance::balance;
use crate::programs::factor::factor;
use crate::programs::request::request;
use crate::programs::saturate::{before_derivatives, saturate};
use crate::programs::share::share;
use crate::programs::support::support;
use crate::schedule::{Request, prepared, schedule};

/// The most operations a function may need after simplification.
pub const CAP: usize = 1 << 15;

/// Why there is no program.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum NoProgram {
    /// A function needs more than [`CAP`] operations.
    TooLarge {
        /// The number of operations.
        operations: usize,
    },
    /// A constant outside the range of `f64`.
    OutOfRange(OutOfRange),
    /// More than [`crate::index::LOOPS`] different loops.
    TooManyLoops,
    /// A fault of the engine.
    Internal {
        /// The fault of the program.
        fault: String,
    },
    /// A third, or higher, derivative of a Rust function, by name.
    ThirdDerivative {
        /// The purpose that needs it.
        purpose: Purpose,
        /// The function's name.
        function: String,
    },
}

/// H → supports → requests → saturated → hoisted → factored → shared → scheduled.
pub fn derive(model: &mut Model, wanted: &[Purpose]) -> Result<Program, NoProgram> {
    let mut functions = model.functions();
    support(&mut model.dag, &mut functions);
    before_derivatives(&mut model.dag, &mut functions);
    model.set_roots(&functions);
    let mut all = model.roots();
    balance(&mut model.dag, &mut all);
    model.set_roots(&all);
    let mut requests: Vec<Request> = Vec::with_capacity(wanted.len());
    let mut gradient = None;
    let mut arrays = Arrays::default();
    for &purpose in wanted {
        let mut request = request(model, purpose, &mut gradient).map_err(internal)?;
        let mut roots = request.roots();
        refuse(model, purpose, &roots)?;
        support(&mut model.dag, &mut roots);
        saturate(&mut model.dag, &mut roots);
        arrays.hoist(&mut model.dag, &model.parameters, &mut roots);
        factor(&mut model.dag, &mut roots);
        if let Some(number) = model.dag.out_of_range(&roots) {
            return Err(NoProgram::OutOfRange(number));
        }
        share(&mut model.dag, &mut roots, Stage::Evaluation);
        request.replace_roots(&roots);
        requests.push(request);
    }
    if model.dag.has_too_many_loops() {
        return Err(NoProgram::TooManyLoops);
    }
    let (wanted, images) = preparation(&mut model.dag, &mut requests);
    let mut program = schedule(&model.dag, &requests, (&wanted, &images), arrays.hoisted);
    program.parameters = model.parameters.len();
    program.validate().map_err(internal)?;
    for (function, request) in program.functions.iter().zip(&requests) {
        if stores(&function.evaluation) != request.stores.len() {
            return Err(internal(format!("{:?} loses a store", request.purpose)));
        }
        let operations = program.operations(function).total();
        if operations > CAP {
            return Err(NoProgram::TooLarge { operations });
        }
    }
    Ok(program)
}

/// The expressions that are prepared, with the expressions they are computed by. One that sharing
/// cancels to a number is replaced by it: numbers stand where they are used and are not handed on.
fn preparation(dag: &mut Dag, requests: &mut [Request]) -> (Vec<Node>, Vec<Node>) {
    loop {
        let wanted = prepared(dag, requests);
        let images = shared_preparation(dag, &wanted);
        let is_number = |image: &Node| matches!(dag.kind(*image), Kind::Constant(_) | Kind::Pi);
        let pairs = wanted.iter().copied().zip(images.iter().copied());
        let numbers: Map<Node, Node> = pairs.filter(|(_, image)| is_number(image)).collect();
        if numbers.is_empty() {
            return (wanted, images);
        }
        for request in requests.iter_mut() {
            let mut roots = request.roots();
            for root in &mut roots {
                *root = dag.substitute(*root, |_, node| numbers.get(&node).copied());
            }
            request.replace_roots(&roots);
        }
    }
}

/// The prepared expressions with shared parts, where that is less work.
fn shared_preparation(dag: &mut Dag, wanted: &[Node]) -> Vec<Node> {
    let mut images = wanted.to_vec();
    share(dag, &mut images, Stage::Parameters);
    match work(dag, &images) < work(dag, wanted) {
        true => images,
        false => wanted.to_vec(),
    }
}

fn internal(fault: String) -> NoProgram {
    NoProgram::Internal { fault }
}

/// The number of updates of outputs.
fn stores(steps: &[Step]) -> usize {
    let count = |step: &Step| match step {
        Step::Store(..) => 1,
        Step::Loop(nest) => stores(&nest.body),
        Step::Let(_) | Step::Accumulate(..) => 0,
    };
    steps.iter().map(count).sum()
}

fn refuse(model: &Model, purpose: Purpose, roots: &[Node]) -> Result<(), NoProgram> {
    if model.dag.has_too_many_loops() {
        return Err(NoProgram::TooManyLoops);
    }
    for node in model.dag.reachable(roots) {
        if let Kind::External(function, Partial::Higher { .. }, _) = model.dag.kind(node) {
            return Err(NoProgram::ThirdDerivative {
                purpose,
                function: model.externals[*function as usize].name.clone(),
            });
        }
    }
    Ok(())
}

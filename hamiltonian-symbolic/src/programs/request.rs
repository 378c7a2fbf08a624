//! The request of each purpose: the values to return and the outputs to write.
//!
//! Input: a [`Model`] and a [`Purpose`]. Output: a [`Request`], or the fault that prevents it. Invariant: stores set
//! each element of an output that is overwritten, or the output is cleared before they add to it.

use crate::dag::{Array, Dag, Dependence, Kind, Map, Node, Parameter, Side};
use crate::diff;
use crate::forces;
use crate::index::{Affine, Index};
use crate::list::IntoList;
use crate::model::{ExactFlow, Model, Motion, Piece, VectorEntry};
use crate::op::Op;
use crate::program::{Purpose, Target};
use crate::programs::saturate::before_derivatives;
use crate::programs::stencil::at_sites;
use crate::programs::support::support;
use crate::schedule::{Request, Store};
use crate::sort::Arrange;

/// The request of a purpose, or the fault that prevents it. Most requests consist of parts of `gradient`, which is
/// derived for the first of them and kept for the others.
pub(crate) fn request(
    model: &mut Model,
    purpose: Purpose,
    gradient: &mut Option<Vec<VectorEntry>>,
) -> Result<Request, String> {
    let h = model.h();
    let mut request = Request {
        purpose,
        results: Vec::new(),
        stores: Vec::new(),
        cleared: Vec::new(),
        pinned: None,
    };
    let mut along = |model: &mut Model, sides: (bool, bool)| {
        let entries = gradient.get_or_insert_with(|| model.partials(h));
        let is_wanted = |entry: &&VectorEntry| match entry.at.side {
            Side::Q => sides.0,
            Side::P => sides.1,
        };
        entries.iter().filter(is_wanted).cloned().into_list()
    };
    match purpose {
        Purpose::Energy => request.results.push(h),
        Purpose::GradientQ | Purpose::GradientP | Purpose::Gradient => {
            let sides = (purpose != Purpose::GradientP, purpose != Purpose::GradientQ);
            let entries = along(model, sides);
            vector(model, entries, sides, &mut request);
        }
        Purpose::EnergyAndGradient => {
            request.results.push(h);
            let entries = along(model, (true, true));
            vector(model, entries, (true, true), &mut request);
        }
        Purpose::TimeDerivative => {
            let adjoints = diff::gradient(&mut model.dag, h, Dependence::TIME);
            let zero = model.dag.integer(0);
            request
                .results
                .push(adjoints.first().map_or(zero, |(_, value)| *value));
        }
        Purpose::ParameterGradient => parameter_derivatives(model, h, &mut request),
        Purpose::HessianVector => {
            let along = diff::along_direction(&mut model.dag, h);
            let entries = model.partials(along);
            vector(model, entries, (true, true), &mut request);
        }
        Purpose::Observable(number) => {
            let observable = model.observables.get(usize::from(number));
            let missing = || format!("there is no observable {number}");
            request.results = observable.ok_or_else(missing)?.components.clone();
        }
        Purpose::Vector(number) => {
            let function = model.vectors.get(usize::from(number)).cloned();
            let missing = || format!("there is no vector function {number}");
            let function = function.ok_or_else(missing)?;
            vector(
                model,
                function.entries,
                function.usage.sides(),
                &mut request,
            );
        }
        Purpose::VectorField if !model.force.is_empty() => {
            let entries = along(model, (false, true));
            request.stores = sums(&mut model.dag, entries);
            let gradient = along(model, (true, false));
            request.stores.extend(driven(model, &gradient));
        }
        Purpose::Push | Purpose::Linear | Purpose::Kick if !model.force.is_empty() => {
            let missing = |_| "this force has no exact flow".to_owned();
            let entries = match (purpose, forces::kick_of(model).map_err(missing)?) {
                (Purpose::Push, forces::KickFlow::Single { damped, .. }) => damped,
                (Purpose::Kick, forces::KickFlow::Single { rest, .. }) => rest,
                (Purpose::Linear, forces::KickFlow::Coupled { linear }) => linear,
                (purpose, _) => return Err(format!("this force has no {purpose:?}")),
            };
            request.stores.extend(entries.into_iter().map(added));
        }
        Purpose::Rates if !model.force.is_empty() => {
            let gradient = forces::gradient_of_pieces(model);
            request.stores.extend(driven(model, &gradient));
        }
        Purpose::Push | Purpose::Linear | Purpose::Rates => {
            return Err("there is no force".to_owned());
        }
        Purpose::VectorField | Purpose::Kick | Purpose::Drift => {
            let sides = (purpose != Purpose::Drift, purpose != Purpose::Kick);
            let entries = along(model, sides);
            request.stores = sums(&mut model.dag, entries);
        }
        Purpose::Piece(number) => {
            let piece = model.pieces.get(usize::from(number)).cloned();
            let missing = || format!("there is no piece {number}");
            let piece = piece.ok_or_else(missing)?;
            request.stores = flow(model, &piece);
            request.pinned = piece.flow.innermost();
        }
    }
    Ok(request)
}

/// The stores that add c·(f − ∂H/∂q) with the force f, from ∂H/∂q.
fn driven(model: &mut Model, gradient: &[VectorEntry]) -> Vec<Store> {
    let c = model.dag.coefficient();
    let slopes = forces::slopes(model, gradient).into_iter();
    let scaled = |entry: VectorEntry| {
        let value = model.dag.mul(&[c, entry.value]);
        added(VectorEntry { value, ..entry })
    };
    let stores = slopes.map(scaled).into_list();
    at_sites(&mut model.dag, stores)
}

/// The stores that make the flow of a piece.
fn flow(model: &mut Model, piece: &Piece) -> Vec<Store> {
    match &piece.flow {
        ExactFlow::Linear | ExactFlow::Exponential => rates(model, piece.h),
        ExactFlow::Closed(motion, _) => updates(&mut model.dag, motion),
        ExactFlow::Loop { motions, .. } => {
            let each = motions.iter();
            each.flat_map(|motion| updates(&mut model.dag, motion))
                .into_list()
        }
    }
}

/// The updates of a program: one a variable, all values from the point before.
fn updates(dag: &mut Dag, motion: &Motion) -> Vec<Store> {
    let guard = motion
        .domain
        .split_first()
        .map(|(first, rest)| rest.iter().fold(*first, |all, next| dag.and(all, *next)));
    let minus = dag.integer(-1);
    let nan = dag.call(Op::Sqrt, &[minus]);
    let mut stores = Vec::with_capacity(motion.moves.len());
    for m in &motion.moves {
        let Some((column, row)) = dag.phase_place(m.leaf) else {
            continue;
        };
        let (target, row) = (Target::Phase(column), row.clone());
        stores.push(Store {
            target,
            row,
            column: None,
            value: match guard {
                Some(guard) => dag.select(guard, m.value, nan),
                None => m.value,
            },
            add: m.added,
        });
    }
    stores
}

/// The stores that add c·J∇h of an expression.
fn rates(model: &mut Model, h: Node) -> Vec<Store> {
    let mut h = [h];
    support(&mut model.dag, &mut h);
    before_derivatives(&mut model.dag, &mut h);
    let [h] = h;
    let entries = model.partials(h);
    sums(&mut model.dag, entries)
}

/// The stores that add c·J∇H, from the entries of ∇H.
fn sums(dag: &mut Dag, entries: Vec<VectorEntry>) -> Vec<Store> {
    let entries = entries.into_iter();
    let stores = entries.map(|entry| added(scaled(dag, entry))).into_list();
    at_sites(dag, stores)
}

/// The store that adds an entry.
fn added(entry: VectorEntry) -> Store {
    Store {
        target: Target::Phase(entry.at),
        row: entry.row,
        column: None,
        value: entry.value,
        add: true,
    }
}

/// Stores that overwrite the outputs on the `sides` with a vector.
fn vector(
    model: &mut Model,
    entries: Vec<VectorEntry>,
    sides: (bool, bool),
    request: &mut Request,
) {
    let mut outputs = Vec::new();
    for (side, wanted) in [(Side::Q, sides.0), (Side::P, sides.1)] {
        let columns = model.columns(side).into_iter().filter(|_| wanted);
        outputs.extend(columns.map(|(column, rows)| (Target::Phase(column), rows)));
    }
    let stores = entries.into_iter().map(added).into_list();
    let stores = at_sites(&mut model.dag, stores);
    overwritten(&mut model.dag, stores, outputs, request);
}

/// Stores that overwrite outputs, of which the rows are given where they are arrays, with the sums of
/// contributions to their elements.
fn overwritten(
    dag: &mut Dag,
    mut stores: Vec<Store>,
    outputs: Vec<(Target, Option<Affine>)>,
    request: &mut Request,
) {
    let mut places: Map<Target, Vec<usize>> = Map::default();
    for (at, store) in stores.iter().enumerate() {
        places.entry(store.target).or_default().push(at);
    }
    for (target, rows) in outputs {
        let own = places.get(&target).map_or(&[][..], Vec::as_slice);
        overwrite(dag, target, rows, own, &mut stores, request);
    }
    request.stores.append(&mut stores);
}

/// c·∂H/∂p goes to coordinates, −c·∂H/∂q to momenta.
fn scaled(dag: &mut Dag, entry: VectorEntry) -> VectorEntry {
    let c = dag.coefficient();
    let value = dag.mul(&[c, entry.value]);
    let value = match entry.at.side {
        Side::Q => dag.neg(value),
        Side::P => value,
    };
    VectorEntry {
        at: entry.at.conjugate(),
        value,
        ..entry
    }
}

/// Makes an output column, to which the stores at `own` belong, be overwritten: by one loop that
/// covers it all, by elements named one by one, else by clearing and adding.
fn overwrite(
    dag: &mut Dag,
    target: Target,
    rows: Option<Affine>,
    own: &[usize],
    stores: &mut Vec<Store>,
    request: &mut Request,
) {
    let Some(rows) = rows else {
        match own.first() {
            Some(&at) => stores[at].add = false,
            None => stores.push(Store {
                target,
                row: Index::constant(0),
                column: None,
                value: dag.integer(0),
                add: false,
            }),
        }
        return;
    };
    if let [at] = own {
        let store = &mut stores[*at];
        if let (None, Some(loops)) = (&store.column, dag.loops_of_rows(&store.row, &rows))
            && dag.variables(store.value).is_within(loops)
        {
            store.add = false;
            return;
        }
    }
    let element = |at: &usize| match &stores[*at] {
        Store {
            row,
            column: None,
            value,
            ..
        } if dag.variables(*value).is_empty() => row.as_constant(),
        _ => None,
    };
    let mut elements: Vec<i64> = own.iter().filter_map(element).into_list();
    elements.arrange();
    elements.dedup();
    if elements.len() == own.len() {
        own.iter().for_each(|at| stores[*at].add = false);
        if rows.as_constant() == Some(own.len() as i64) {
            return;
        }
    }
    request.cleared.push(target);
}

/// Stores that overwrite the outputs of all parameters with ∂/∂parameter.
fn parameter_derivatives(model: &mut Model, root: Node, request: &mut Request) {
    let adjoints = diff::gradient(&mut model.dag, root, Dependence::PARAMETER).into_iter();
    let store = |(leaf, value): (Node, Node)| {
        let (parameter, row, column) = match model.dag.kind(leaf).clone() {
            Kind::Scalar(parameter) => (parameter, Index::constant(0), None),
            Kind::Element(Array::Parameter(parameter), row, column) => {
                (parameter, row, column.map(|column| *column))
            }
            other => unreachable!("{other:?} is no parameter"),
        };
        Store {
            target: Target::Parameter(parameter),
            row,
            column,
            value,
            add: true,
        }
    };
    let stores = adjoints.map(store).into_list();
    let rows = model.parameters.iter().map(|p| p.shape.rows().cloned());
    let outputs = (0..).map(|number| Target::Parameter(Parameter(number)));
    let outputs = outputs.zip(rows).into_list();
    overwritten(&mut model.dag, stores, outputs, request);
}

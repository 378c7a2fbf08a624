//! Splittings of sums over arrays: a piece is a loop of exact flows of its terms.
//!
//! Input: H with loops. Output: its pieces, or the term without a flow. Invariant: a loop's body is
//! solved once, as a system of the few elements it names, which are proven to be different ones;
//! terms of one site are exact in any order, terms that join sites are swept one way down and the
//! other way up. Terms in which no column meets its conjugate move everything at a constant rate.

use super::space::Space;
use super::units::{Term, terms};
use super::{ExactFlow, Piece};
use super::{any_flow, search};
use crate::dag::{Array, Column, Dag, Dependence, Kind, Map, Node, Parameter, Side};
use crate::index::{Affine, Domain, Index};
use crate::model::{Group, Model, ParameterDeclaration, Shape};
use crate::print;
use crate::rational::Rational;

/// The terms over one chain of loops that name the same elements.
struct Site {
    chain: Vec<Domain>,
    rows: Vec<Index>,
    terms: Vec<Term>,
}

/// The pieces of H, or its first term without a flow.
pub(super) fn find(model: &mut Model, h: Node) -> Result<Vec<Piece>, Node> {
    let terms = terms(&mut model.dag, h);
    let mut easy = [Vec::new(), Vec::new()];
    let mut sites: Vec<Site> = Vec::new();
    let mut constants = Vec::new();
    for term in terms {
        let rows = rows(&model.dag, term.body);
        let site = |s: &&mut Site| s.chain == term.chain && s.rows == rows;
        match sites.iter_mut().find(site) {
            Some(site) => site.terms.push(term),
            None if rows.is_empty() => constants.push(term),
            None => sites.push(Site {
                chain: term.chain.clone(),
                rows,
                terms: vec![term],
            }),
        }
    }
    let mut pieces = Vec::new();
    let mut linear = Vec::new();
    for site in sites {
        let bodies: Vec<Node> = site.terms.iter().map(|term| term.body).collect();
        // In one site alone V and T need not be a loop of flows.
        let is_mixed = bodies.iter().any(|body| couples(&model.dag, *body));
        let joins = site.rows.len() > 1 && both_sides(&model.dag, &bodies);
        if is_mixed || joins {
            let body = model.dag.add(&bodies);
            if let Some(found) = solved(model, &site, body, false) {
                pieces.extend(found);
                continue;
            }
        }
        let mut hard = Vec::new();
        for term in &site.terms {
            match side(&model.dag, term.body) {
                Some(side) => easy[usize::from(side == Side::P)].push(term.clone()),
                None => hard.push(term.clone()),
            }
        }
        if let Some(first) = hard.first() {
            let (first, bodies) = (first.clone(), hard.iter().map(|term| term.body));
            let bodies: Vec<Node> = bodies.collect();
            let body = model.dag.add(&bodies);
            if let Some(found) = solved(model, &site, body, true) {
                pieces.extend(found);
                continue;
            }
            let is_linear = |term: &Term| is_linear(&columns(&model.dag, term.body));
            if !hard.iter().all(is_linear) {
                return Err(first.source);
            }
            linear.extend(hard);
        }
    }
    // A term of parameters alone moves nothing; it joins the piece that moves least.
    let [mut potential, kinetic] = easy;
    potential.extend(constants);
    let mut parts = vec![kinetic, potential];
    for term in linear {
        let own = columns(&model.dag, term.body);
        let fits = |part: &&mut Vec<Term>| {
            let others = part
                .iter()
                .flat_map(|other| columns(&model.dag, other.body));
            is_linear(&own.iter().copied().chain(others).collect::<Vec<_>>())
        };
        match parts.iter_mut().find(fits) {
            Some(part) => part.push(term),
            None => parts.push(vec![term]),
        }
    }
    for (at, terms) in parts.iter().enumerate() {
        let part = summed(&mut model.dag, terms);
        if !model.dag.is_zero(part) {
            let piece = Piece {
                h: part,
                name: print::text(model, part),
                flow: ExactFlow::Linear,
            };
            pieces.insert(at.min(pieces.len()), piece);
        }
    }
    Ok(pieces)
}

/// The flow of one expression with loops, as one loop of flows.
pub(super) fn one(model: &mut Model, h: Node) -> Option<ExactFlow> {
    let terms = terms(&mut model.dag, h);
    let first = terms.first()?.clone();
    let rows = rows(&model.dag, first.body);
    let mut bodies = Vec::new();
    let mut all = rows;
    for term in &terms {
        if term.chain != first.chain {
            return None;
        }
        bodies.push(term.body);
        for row in self::rows(&model.dag, term.body) {
            if !all.contains(&row) {
                all.push(row);
            }
        }
    }
    let site = Site {
        chain: first.chain,
        rows: all,
        terms: Vec::new(),
    };
    let body = model.dag.add(&bodies);
    let pieces = solved(model, &site, body, false)?;
    pieces.into_iter().next().map(|piece| piece.flow)
}

/// The elements of phase space that an expression names.
fn elements(dag: &Dag, root: Node) -> Vec<(Node, Column, Index)> {
    let mut found = Vec::new();
    for node in dag.reachable(&[root]) {
        if let Some((column, row)) = dag.phase_place(node) {
            found.push((node, column, row.clone()));
        }
    }
    found
}

/// The columns it names.
pub(super) fn columns(dag: &Dag, root: Node) -> Vec<Column> {
    elements(dag, root).into_iter().map(|e| e.1).collect()
}

/// Whether no column stands among these with its conjugate: then c·J∇h is constant along the flow.
pub(super) fn is_linear(columns: &[Column]) -> bool {
    !columns
        .iter()
        .any(|column| columns.contains(&column.conjugate()))
}

/// The rows it names, sorted.
fn rows(dag: &Dag, body: Node) -> Vec<Index> {
    let mut rows: Vec<Index> = elements(dag, body).into_iter().map(|e| e.2).collect();
    rows.sort_unstable();
    rows.dedup();
    rows
}

fn couples(dag: &Dag, node: Node) -> bool {
    side(dag, node).is_none()
}

/// The side an expression is of, if it is of one.
fn side(dag: &Dag, node: Node) -> Option<Side> {
    let dependence = dag.dependence(node);
    match (dependence.on(Dependence::Q), dependence.on(Dependence::P)) {
        (_, false) => Some(Side::Q),
        (false, true) => Some(Side::P),
        (true, true) => None,
    }
}

fn both_sides(dag: &Dag, bodies: &[Node]) -> bool {
    let on = |what: Dependence| bodies.iter().any(|body| dag.dependence(*body).on(what));
    on(Dependence::Q) && on(Dependence::P)
}

fn summed(dag: &mut Dag, terms: &[Term]) -> Node {
    let mut parts = Vec::new();
    for term in terms {
        parts.push((Rational::ONE, around(dag, &term.chain, term.body)));
    }
    dag.linear(&Rational::ZERO, &parts)
}

fn around(dag: &mut Dag, chain: &[Domain], body: Node) -> Node {
    let loops = chain.iter().rev();
    loops.fold(body, |body, domain| dag.reduce(*domain, body))
}

/// Whether the rows of a body are different ones in every iteration, where a condition holds: a
/// site alone, neighbours on a line or a ring, pairs j < i.
fn are_distinct(dag: &mut Dag, chain: &[Domain], rows: &[Index]) -> Option<Option<Node>> {
    let variable = |index: &Index| match index.affine.loops.as_slice() {
        [(domain, 1)] if index.affine.sizes.is_empty() => Some((*domain, index.affine.constant)),
        _ => None,
    };
    match (chain, rows) {
        // Elements given by number are different where their numbers are.
        ([], rows) => rows
            .iter()
            .all(|row| row.modulo.is_none() && row.affine.as_constant().is_some())
            .then_some(None),
        ([_], [row]) => variable(row).map(|_| None),
        ([_], [a, b]) => {
            let ((d, i), (e, j)) = (variable(a)?, variable(b)?);
            if d != e || (i - j).abs() != 1 {
                return None;
            }
            let modulo = a.modulo.clone().or_else(|| b.modulo.clone());
            match (modulo, &a.modulo, &b.modulo) {
                (None, ..) => Some(None),
                (Some(n), x, y) => {
                    let same = |m: &Option<Affine>| m.as_ref().is_none_or(|m| *m == n);
                    if !same(x) || !same(y) {
                        return None;
                    }
                    // On a ring of one the neighbour is the site itself.
                    match n.as_constant() {
                        Some(count) => (count > 1).then_some(None),
                        None => {
                            let (count, one) = (dag.affine(&n), dag.integer(1));
                            Some(Some(dag.less(one, count)))
                        }
                    }
                }
            }
        }
        ([outer, inner], [a, b]) => {
            let is_pair = |i: Option<(Domain, i64)>, j: Option<(Domain, i64)>| {
                i == Some((*outer, 0)) && j == Some((*inner, 0))
            };
            let plain = a.modulo.is_none() && b.modulo.is_none();
            let pair = is_pair(variable(a), variable(b)) || is_pair(variable(b), variable(a));
            let below = dag.range(*inner).end == Affine::variable(*outer);
            (plain && pair && below).then_some(None)
        }
        _ => None,
    }
}

/// The loops of flows that a body is; one, unless it `may_part`.
fn solved(model: &mut Model, site: &Site, body: Node, may_part: bool) -> Option<Vec<Piece>> {
    let condition = are_distinct(&mut model.dag, &site.chain, &site.rows)?;
    let (small, images) = scratch(model, body);
    let over = |dag: &mut Dag, root: Node, map: &Map<Node, Node>| {
        dag.substitute(root, |_, node| map.get(&node).copied())
    };
    let mut small = small;
    let small_body = over(&mut small.dag, body, &images);
    let mut space = Space::new(&small, &[small_body])?;
    space.has_exponentials = false;
    let found = match any_flow(&mut space, small_body) {
        Some(flow) => vec![(small_body, ExactFlow::from(flow))],
        None if may_part => {
            let parts = search(&mut space, small_body).ok()?.pieces.into_iter();
            parts.map(|piece| (piece.h, piece.flow)).collect()
        }
        None => return None,
    };
    model.dag = space.model.dag;
    let back: Map<Node, Node> = images.iter().map(|(leaf, image)| (*image, *leaf)).collect();
    let mut pieces = Vec::with_capacity(found.len());
    for (part, flow) in found {
        let part = over(&mut model.dag, part, &back);
        let h = around(&mut model.dag, &site.chain, part);
        let flow = match flow {
            ExactFlow::Closed(motion, rows) => {
                let mut motion = motion.map(|node| over(&mut model.dag, node, &back));
                motion.domain.splice(0..0, condition);
                match site.chain.last() {
                    Some(innermost) => ExactFlow::Loop {
                        motion,
                        rows,
                        innermost: *innermost,
                        merges: site.rows.len() == 1,
                    },
                    None => ExactFlow::Closed(motion, rows),
                }
            }
            flow => flow,
        };
        pieces.push(Piece {
            h,
            name: print::text(model, h),
            flow,
        });
    }
    Some(pieces)
}

/// A system of scalars in which every element that a body names is one of its own, and the
/// elements with the scalars that stand for them.
fn scratch(model: &Model, body: Node) -> (Model, Map<Node, Node>) {
    let mut small = model.clone();
    let mut images: Map<Node, Node> = Map::default();
    let mut places: Vec<(Column, Index)> = Vec::new();
    for (node, column, row) in elements(&model.dag, body) {
        let side = column.side;
        let place = (column.on(Side::Q), row.clone());
        let at = places.iter().position(|known| *known == place);
        let at = at.unwrap_or_else(|| {
            let number = places.len();
            let scalar = Group::scalar(format!("q{number}"), format!("p{number}"));
            small.groups.push(scalar);
            places.push(place);
            number
        });
        let own = model.groups.len() + at;
        images.insert(node, small.scalar(side, own));
        // The partner is an element too, whether it is named or not.
        let partner = small.dag.phase(column.conjugate(), row);
        let image = small.scalar(side.other(), own);
        images.insert(partner, image);
    }
    for node in model.dag.reachable(&[body]) {
        let is_given = matches!(
            model.dag.kind(node),
            Kind::Element(Array::Parameter(_), ..) | Kind::Variable(_)
        );
        if is_given {
            let number = small.parameters.len();
            small.parameters.push(ParameterDeclaration {
                name: format!("c{number}"),
                shape: Shape::Scalar,
            });
            let image = small.dag.parameter(Parameter(number as u16));
            images.insert(node, image);
        }
    }
    (small, images)
}

//! Splittings of sums over arrays: a piece is a loop of exact flows of its terms.
//!
//! Input: H with loops. Output: its pieces, or the term without a flow. Invariant: a loop's body is
//! solved once, as a system of the few elements it names, which are proven to be different ones;
//! iterations that are proven to commute are exact in any order, others are swept one way down and the
//! other way up. Several loops are one flow only if they are proven to have no element in common. Terms in which no column meets its conjugate move everything at a constant rate.

use super::{ExactFlow, Piece};
use super::{any_flow, search};
use crate::dag::{Array, Column, Dag, Dependence, Kind, Map, Node, Parameter, Side};
use crate::flows::limits::{BODY_ROWS, Limit, is_large};
use crate::flows::solve::units::{LoopedTerm, terms};
use crate::flows::space::Space;
use crate::index::{Domain, Index};
use crate::list::IntoList;
use crate::model::NamedMotion;
use crate::model::{Group, Model, ParameterDeclaration, Shape};
use crate::print;
use crate::ranges::Ranges;
use crate::rational::Rational;
use crate::sort::Arrange;

/// The terms over one chain of loops that name the same elements.
struct Site {
    chain: Vec<Domain>,
    rows: Vec<Index>,
    terms: Vec<LoopedTerm>,
}

/// The pieces of H, or its first term without a flow, and the limit at which the search for one ended.
pub(super) fn find(model: &mut Model, h: Node) -> Result<Vec<Piece>, (Node, Option<Limit>)> {
    let terms = terms(&mut model.dag, h);
    let mut one_sided = [Vec::new(), Vec::new()];
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
        let bodies: Vec<Node> = site.terms.iter().map(|term| term.body).into_list();
        // In one site alone V and T need not be a loop of flows.
        let is_mixed = bodies.iter().any(|body| couples(&model.dag, *body));
        let joins = site.rows.len() > 1 && both_sides(&model.dag, &bodies);
        if is_mixed || joins {
            let body = model.dag.add(&bodies);
            if let Ok(found) = solved(model, &site, body, false) {
                pieces.extend(found);
                continue;
            }
        }
        let mut mixed = Vec::new();
        for term in &site.terms {
            match side(&model.dag, term.body) {
                Some(side) => one_sided[usize::from(side == Side::P)].push(term.clone()),
                None => mixed.push(term.clone()),
            }
        }
        if let Some(first) = mixed.first() {
            let (first, bodies) = (first.clone(), mixed.iter().map(|term| term.body));
            let bodies: Vec<Node> = bodies.into_list();
            let body = model.dag.add(&bodies);
            let limit = match solved(model, &site, body, true) {
                Ok(found) => {
                    pieces.extend(found);
                    continue;
                }
                Err(limit) => limit,
            };
            let is_linear = |term: &LoopedTerm| is_linear(&columns(&model.dag, term.body));
            if !mixed.iter().all(is_linear) {
                return Err((first.source, limit));
            }
            linear.extend(mixed);
        }
    }
    // A term of parameters alone moves nothing; it joins the piece that moves least.
    let [mut potential, kinetic] = one_sided;
    potential.extend(constants);
    let mut parts = vec![kinetic, potential];
    for term in linear {
        let own = columns(&model.dag, term.body);
        let fits = |part: &&mut Vec<LoopedTerm>| {
            let others = part
                .iter()
                .flat_map(|other| columns(&model.dag, other.body));
            is_linear(&own.iter().copied().chain(others).into_list())
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

/// The flow of one expression with loops: one loop of flows, or several without common elements.
pub(super) fn one(model: &mut Model, h: Node) -> Result<ExactFlow, Option<Limit>> {
    let mut sites: Vec<Site> = Vec::new();
    for term in terms(&mut model.dag, h) {
        let rows = rows(&model.dag, term.body);
        match sites.iter_mut().find(|site| site.chain == term.chain) {
            Some(site) => {
                for row in rows {
                    if !site.rows.contains(&row) {
                        site.rows.push(row);
                    }
                }
                site.terms.push(term);
            }
            // A term of parameters alone moves nothing.
            None if rows.is_empty() => {}
            None => sites.push(Site {
                chain: term.chain.clone(),
                rows,
                terms: vec![term],
            }),
        }
    }
    let is_alone = sites.len() < 2;
    let are_apart = |(at, site): (usize, &Site)| {
        has_own_index(site)
            && sites[..at]
                .iter()
                .all(|other| are_apart(&model.dag, site, other))
    };
    if !is_alone && !sites.iter().enumerate().all(are_apart) {
        return Err(None);
    }
    let mut flow: Option<ExactFlow> = None;
    for site in &sites {
        let bodies: Vec<Node> = site.terms.iter().map(|term| term.body).into_list();
        let body = model.dag.add(&bodies);
        let parts = moved(model, site, body, false)?;
        let part = parts.into_iter().next().ok_or(None)?;
        let next = looped(&model.dag, site, part, is_alone);
        flow = Some(match flow {
            None => next,
            Some(flow) => joined(flow, next).ok_or(None)?,
        });
    }
    flow.ok_or(None)
}

/// Returns true if every element that a site names has the index of its innermost loop. Outside of loops there is
/// nothing to have.
fn has_own_index(site: &Site) -> bool {
    let is_own = |row: &Index| match site.chain.last() {
        Some(innermost) => row.affine.factor(*innermost) != 0,
        None => true,
    };
    site.rows.iter().all(is_own)
}

/// Returns true if two sites are proven to have no element of phase space in common.
fn are_apart(dag: &Dag, a: &Site, b: &Site) -> bool {
    let places = |site: &Site| -> Vec<(Column, Index)> {
        let bodies = site.terms.iter().map(|term| term.body);
        let all = bodies.flat_map(|body| elements(dag, body));
        all.map(|(_, column, row)| (column.on(Side::Q), row))
            .into_list()
    };
    let (own, others) = (places(a), places(b));
    own.iter().all(|(column, row)| {
        others.iter().all(|(other, there)| {
            column != other
                || dag
                    .differ(row, there)
                    .is_some_and(|unless| unless.is_empty())
        })
    })
}

/// Two flows of sites without common elements, as one.
fn joined(a: ExactFlow, b: ExactFlow) -> Option<ExactFlow> {
    let parts = |flow: ExactFlow| match flow {
        ExactFlow::Loop {
            motions,
            forms,
            merges,
            ..
        } => Some((motions, forms, merges)),
        ExactFlow::Closed(motion, forms) => Some((vec![motion], forms, true)),
        ExactFlow::Linear | ExactFlow::Exponential => None,
    };
    let ((mut motions, mut forms, merges), (more, names, others)) = (parts(a)?, parts(b)?);
    motions.extend(more);
    for name in names {
        if !forms.contains(&name) {
            forms.push(name);
        }
    }
    Some(ExactFlow::Loop {
        motions,
        forms,
        innermost: None,
        merges: merges && others,
    })
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
    elements(dag, root).into_iter().map(|e| e.1).into_list()
}

/// Returns true if no column stands among these with its conjugate: then c·J∇h is constant along the flow.
pub(super) fn is_linear(columns: &[Column]) -> bool {
    !columns
        .iter()
        .any(|column| columns.contains(&column.conjugate()))
}

/// The rows it names, sorted.
fn rows(dag: &Dag, body: Node) -> Vec<Index> {
    let mut rows: Vec<Index> = elements(dag, body).into_iter().map(|e| e.2).into_list();
    rows.arrange();
    rows.dedup();
    rows
}

fn couples(dag: &Dag, node: Node) -> bool {
    side(dag, node).is_none()
}

/// The side an expression is of, if it is of one.
pub(super) fn side(dag: &Dag, node: Node) -> Option<Side> {
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

fn summed(dag: &mut Dag, terms: &[LoopedTerm]) -> Node {
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

/// Conditions under which the rows of a body are different ones in every iteration.
///
/// # Errors
/// The limit of rows; `None` where it is not known that they differ.
fn are_distinct(dag: &mut Dag, rows: &[Index]) -> Result<Vec<Node>, Option<Limit>> {
    if rows.len() > BODY_ROWS {
        return Err(Some(Limit::BodyRows));
    }
    let mut conditions = Vec::new();
    for (at, a) in rows.iter().enumerate() {
        for b in &rows[..at] {
            for [one, other] in dag.differ(a, b).ok_or(None)? {
                let is_one = other.as_constant() == Some(1);
                let [one, other] = [one, other].map(|form| dag.affine(&form));
                let mut condition = dag.less(other, one);
                // A ring that has an iteration has a site.
                if !is_one {
                    let below = dag.less(one, other);
                    condition = dag.or(below, condition);
                }
                if !conditions.contains(&condition) {
                    conditions.push(condition);
                }
            }
        }
    }
    Ok(conditions)
}

/// The loops of flows that a body is; one, unless it `may_part`.
///
/// # Errors
/// The limit at which the search for flows ended.
fn solved(
    model: &mut Model,
    site: &Site,
    body: Node,
    may_part: bool,
) -> Result<Vec<Piece>, Option<Limit>> {
    let parts = moved(model, site, body, may_part)?;
    let mut pieces = Vec::with_capacity(parts.len());
    for part in parts {
        let h = around(&mut model.dag, &site.chain, part.0);
        pieces.push(Piece {
            h,
            name: print::text(model, h),
            flow: looped(&model.dag, site, part, true),
        });
    }
    Ok(pieces)
}

/// The flow of a part of a site; one that moves all at constant rates needs no loop if it `is_alone`.
fn looped(dag: &Dag, site: &Site, (part, flow): (Node, NamedMotion), is_alone: bool) -> ExactFlow {
    let NamedMotion { motion, forms } = flow;
    match site.chain.last() {
        _ if is_alone && is_linear(&columns(dag, part)) => ExactFlow::Linear,
        Some(innermost) => ExactFlow::Loop {
            motions: vec![motion],
            forms,
            innermost: Some(*innermost),
            merges: commute(dag, &site.chain, &site.rows, part),
        },
        None => ExactFlow::Closed(motion, forms),
    }
}

/// The parts of a body of a site with their motions in one iteration; one part, unless it `may_part`.
///
/// # Errors
/// The limit at which the search for flows ended.
fn moved(
    model: &mut Model,
    site: &Site,
    body: Node,
    may_part: bool,
) -> Result<Vec<(Node, NamedMotion)>, Option<Limit>> {
    if is_large(&model.dag, body) {
        return Err(Some(Limit::Subexpressions));
    }
    let conditions = are_distinct(&mut model.dag, &site.rows)?;
    let (mut small, images) = scratch(model, body);
    let over = |dag: &mut Dag, root: Node, map: &Map<Node, Node>| {
        dag.substitute(root, |_, node| map.get(&node).copied())
    };
    let small_body = over(&mut small.dag, body, &images);
    let mut space = Space::new(&small, &[small_body])?;
    space.has_exponentials = false;
    // The flow of a part as a motion: among scalars a shear moves all at constant rates, in a loop it
    // does so within one iteration.
    let parts: Vec<(Node, NamedMotion)> = match any_flow(&mut space, small_body) {
        Some(flow) => vec![(small_body, flow)],
        None if may_part => {
            search(&mut space, small_body)
                .map_err(|term| space.limit(term))?
                .flows
        }
        None => return Err(space.limit(small_body)),
    };
    model.dag = space.model.dag;
    let back: Map<Node, Node> = images.iter().map(|(leaf, image)| (*image, *leaf)).collect();
    let mut found = Vec::with_capacity(parts.len());
    for (part, NamedMotion { motion, forms }) in parts {
        let part = over(&mut model.dag, part, &back);
        let mut motion = motion.map(|node| over(&mut model.dag, node, &back));
        motion.domain.splice(0..0, conditions.iter().copied());
        found.push((part, NamedMotion { motion, forms }));
    }
    Ok(found)
}

/// Returns true if the flows of any two iterations are proven to commute, whatever the sizes: each iteration has
/// one site of its own, or iterations that share a site have the same body.
fn commute(dag: &Dag, chain: &[Domain], rows: &[Index], body: Node) -> bool {
    let ([domain], [row]) = (chain, rows) else {
        return false;
    };
    if row.affine.factor(*domain) == 0 {
        return false;
    }
    let is_own = |node: Node| match dag.kind(node) {
        Kind::Variable(_) => false,
        Kind::Element(_, index, column) => {
            let is_free = |index: &Index| index.variables().is_empty();
            (index == row || is_free(index)) && column.as_deref().is_none_or(is_free)
        }
        _ => true,
    };
    row.modulo.is_none() || dag.reachable(&[body]).into_iter().all(is_own)
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
            Kind::Element(Array::Parameter(_), ..) | Kind::Variable(_) | Kind::Count(_)
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

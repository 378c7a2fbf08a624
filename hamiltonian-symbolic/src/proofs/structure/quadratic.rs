//! The degree in the momenta: quadratic forms, and what is at most quadratic beside a kick.
//!
//! Input: parts of H. Output: nothing, or the first term of another degree. Invariant: degrees are read
//! off the expression as it stands, or multiplied out; no number decides.

use super::expand::MAX_TERMS;
use super::{expand, term_with};
use crate::dag::{Dag, Dependence, Kind, Map, Node};
use crate::list::IntoList;
use crate::model::Model;
use crate::print;
use crate::rational::Rational;

/// Checks that T is a quadratic form in the momenta with coefficients of parameters only.
pub(super) fn form(model: &mut Model, kinetic: Node) -> Result<(), String> {
    if let Some(text) = term_with_time(model, kinetic) {
        return Err(format!("the term `{text}` depends on time"));
    }
    if !model.dag.dependence(kinetic).on(Dependence::P) {
        return Err("no term depends on momenta".to_owned());
    }
    match outside(model, kinetic, |degrees| degrees == (2, 2)) {
        None => Ok(()),
        Some(Outside::Long(term)) => Err(too_long(model, term)),
        Some(Outside::Term(term)) => {
            let how = match degrees(&model.dag, term) {
                Some((1, 1)) => "is linear in the momenta",
                _ => "is not quadratic in the momenta",
            };
            Err(format!("the term `{}` {how}", print::text(model, term)))
        }
    }
}

/// The part of two of H that is a kick V(q, t) beside the other, A(q, p), at most quadratic in the
/// momenta: the numbers of V and of A. Tables of Nyström type have their order there, because
/// {V, {V, {V, A}}} = 0.
///
/// # Errors
/// The reason why neither is, a sentence without a full stop.
pub fn kick_beside(model: &mut Model, parts: [Node; 2]) -> Result<[usize; 2], String> {
    let mut reason = None;
    for [kick, other] in [[0, 1], [1, 0]] {
        if model.dag.dependence(parts[kick]).on(Dependence::P) {
            continue;
        }
        let why = if let Some(text) = term_with_time(model, parts[other]) {
            format!("the term `{text}` beside the kick depends on time")
        } else {
            match outside(model, parts[other], |(_, most)| most <= 2) {
                None => return Ok([kick, other]),
                Some(Outside::Long(term)) => too_long(model, term),
                Some(Outside::Term(term)) => {
                    let term = print::text(model, term);
                    format!("the term `{term}` is not a polynomial of degree 2 in the momenta")
                }
            }
        };
        reason.get_or_insert(why);
    }
    Err(reason.unwrap_or_else(|| {
        let [first, second] = parts.map(|part| print::text(model, part));
        format!("both pieces, `{first}` and `{second}`, depend on momenta")
    }))
}

/// The first term with time in it, as text.
fn term_with_time(model: &Model, part: Node) -> Option<String> {
    let has_time = |dag: &Dag, node: Node| dag.dependence(node).on(Dependence::TIME);
    term_with(&model.dag, part, has_time).map(|term| print::text(model, term))
}

/// A term whose degrees in the momenta are not of a kind.
enum Outside {
    /// The first such term, multiplied out.
    Term(Node),
    /// A term as it was written. Multiplied out it has too many terms, so its degrees are not known.
    Long(Node),
}

/// The reason if a term cannot be multiplied out.
fn too_long(model: &Model, term: Node) -> String {
    let term = print::text(model, term);
    format!(
        "the degree of the term `{term}` in the momenta is not known: multiplied out, it has more than {MAX_TERMS} terms"
    )
}

/// The first term, among those with momenta, whose degrees in them are not of a kind.
fn outside(model: &mut Model, part: Node, is_inside: fn((u32, u32)) -> bool) -> Option<Outside> {
    let is_fine = |dag: &Dag, node: Node| degrees(dag, node).is_some_and(is_inside);
    if is_fine(&model.dag, part) {
        return None;
    }
    // The source's grouping may hide it: p*(p + 1) - p.
    let terms = match expand(&mut model.dag, part) {
        Some(terms) if terms.is_empty() => return Some(Outside::Term(part)),
        Some(terms) => terms,
        None => {
            // Terms that are of the kind as they stand count towards no limit.
            let mut left = part;
            if let Kind::Sum(_, terms) = model.dag.kind(part).clone() {
                let others = terms
                    .into_iter()
                    .filter(|(_, term)| !is_fine(&model.dag, *term));
                let others: Vec<(Rational, Node)> = others.into_list();
                left = model.dag.linear(&Rational::ZERO, &others);
            }
            match expand(&mut model.dag, left) {
                Some(terms) => terms,
                None => return Some(Outside::Long(left)),
            }
        }
    };
    let mut nodes = Vec::with_capacity(terms.len());
    for term in &terms {
        nodes.push(term.node(&mut model.dag));
    }
    let mut others = nodes.into_iter().filter(|node| {
        model.dag.dependence(*node).on(Dependence::P) && !is_fine(&model.dag, *node)
    });
    others.next().map(Outside::Term)
}

/// The lowest and the highest degree in the momenta of the terms of a polynomial in them; `None` for
/// anything else. Terms that cancel count.
pub(crate) fn degrees(dag: &Dag, root: Node) -> Option<(u32, u32)> {
    let both = |a: (u32, u32), b: (u32, u32)| (a.0.min(b.0), a.1.max(b.1));
    let mut found: Map<Node, (u32, u32)> = Map::default();
    for node in dag.reachable(&[root]) {
        if !dag.dependence(node).on(Dependence::P) {
            found.insert(node, (0, 0));
            continue;
        }
        let degrees = match dag.kind(node) {
            Kind::Element(..) => Some((1, 1)),
            Kind::Sum(c, terms) => {
                let terms = terms.iter().map(|(_, term)| found.get(term).copied());
                let constant = (!c.is_zero()).then_some(Some((0, 0)));
                (terms.chain(constant))
                    .reduce(|a, b| Some(both(a?, b?)))
                    .flatten()
            }
            Kind::Product(_, factors) => {
                (factors.iter()).try_fold((0u32, 0u32), |sum, (factor, power)| {
                    match (*found.get(factor)?, *power) {
                        ((0, 0), _) => Some(sum),
                        ((least, most), power) => {
                            let power = u32::try_from(power).ok()?;
                            let least = sum.0.checked_add(least.checked_mul(power)?)?;
                            Some((least, sum.1.checked_add(most.checked_mul(power)?)?))
                        }
                    }
                })
            }
            Kind::Reduce(_, body) => found.get(body).copied(),
            Kind::Select(c, a, b) if !dag.dependence(*c).on(Dependence::P) => {
                (found.get(a).copied().zip(found.get(b).copied())).map(|(a, b)| both(a, b))
            }
            _ => None,
        };
        if let Some(degrees) = degrees {
            found.insert(node, degrees);
        }
    }
    found.get(&root).copied()
}

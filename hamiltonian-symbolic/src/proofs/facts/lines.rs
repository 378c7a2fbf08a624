//! Expressions of linear forms, such as 1/(x − y)² and 1/(x + y)², which move other degrees of freedom.
//!
//! Input: terms of H. Output: true if only the first one moves the linear form of the first. Invariant:
//! as for terms of different coordinates, after a linear change of the coordinates.

use crate::dag::{Array, Dag, Kind, Node, Side};
use crate::list::IntoList;
use crate::rational::Rational;

/// A linear form of coordinates, or of momenta: the elements with their factors.
type LinearForm = Vec<(Node, Rational)>;

/// Returns true if a term is a function of one linear form, of coordinates or of momenta, and the others together change
/// neither the form nor a momentum, or coordinate, along which it changes: where the first is infinite, so is that
/// momentum, whatever the others are.
pub fn are_along_other_lines(dag: &Dag, one: Node, others: &[Node]) -> bool {
    let (Some(own), Some(others)) = (forms(dag, &[one]), forms(dag, others)) else {
        return false;
    };
    let [(side, form)] = own.as_slice() else {
        return false;
    };
    let (beside, across): (Vec<_>, Vec<_>) = others.iter().partition(|(of, _)| of == side);
    // The bracket of the form with one of the other side.
    let changes = |(_, through): &&(Side, LinearForm)| {
        let products = form.iter().flat_map(|(a, k)| {
            let is_partner = |b: Node| partner(dag, *a) == place(dag, b);
            let pairs = through.iter().filter(move |(b, _)| is_partner(*b));
            pairs.map(|(_, l)| k.mul(l))
        });
        let bracket = products.fold(Rational::ZERO, |sum, product| sum.add(&product));
        !bracket.is_zero()
    };
    let beside: Vec<LinearForm> = beside.into_iter().map(|(_, form)| form.clone()).into_list();
    !across.iter().any(changes) && !is_spanned(form, beside)
}

/// Returns true if a form is a linear combination of others.
fn is_spanned(form: &LinearForm, others: Vec<LinearForm>) -> bool {
    let (mut rest, mut rows) = (form.clone(), others);
    while let Some(row) = rows.pop() {
        let Some((at, by)) = row.first().and_then(|(at, k)| Some((*at, k.recip()?))) else {
            continue;
        };
        // Gaussian elimination of the first element of the row.
        for other in rows.iter_mut().chain(std::iter::once(&mut rest)) {
            if let Some((_, k)) = other.iter().find(|(element, _)| *element == at) {
                let k = k.mul(&by).neg();
                add(other, &row, &k);
            }
        }
    }
    rest.is_empty()
}

/// Adds a multiple of another form.
fn add(form: &mut LinearForm, other: &LinearForm, by: &Rational) {
    for (element, k) in other {
        let k = k.mul(by);
        match form.iter_mut().find(|(own, _)| own == element) {
            Some((_, own)) => *own = own.add(&k),
            None => form.push((*element, k)),
        }
    }
    form.retain(|(_, k)| !k.is_zero());
}

/// The linear forms that expressions are functions of; `None` if one reads the time, or elements of loops.
fn forms(dag: &Dag, roots: &[Node]) -> Option<Vec<(Side, LinearForm)>> {
    let mut found: Vec<(Side, LinearForm)> = Vec::new();
    let mut left = roots.to_vec();
    while let Some(node) = left.pop() {
        if matches!(dag.kind(node), Kind::Time | Kind::Reduce(..)) {
            return None;
        }
        if let Some(form) = linear(dag, node) {
            if !found.contains(&form) {
                found.push(form);
            }
            continue;
        }
        if place(dag, node).is_some() {
            return None;
        }
        dag.for_children(node, |child| left.push(child));
    }
    Some(found)
}

/// A sum of elements at fixed indices, up to a number.
fn linear(dag: &Dag, node: Node) -> Option<(Side, LinearForm)> {
    let single = [(Rational::ONE, node)];
    let terms = match dag.kind(node) {
        Kind::Sum(_, terms) => terms.as_slice(),
        _ => &single,
    };
    let (side, ..) = place(dag, terms[0].1)?;
    let mut form = LinearForm::new();
    for (k, element) in terms {
        let (of, _, _, row) = place(dag, *element)?;
        if of != side || row.is_none() {
            return None;
        }
        form.push((*element, k.clone()));
    }
    Some((side, form))
}

/// Where an element of phase space is: its side, group, column and row.
fn place(dag: &Dag, node: Node) -> Option<(Side, u16, u16, Option<i64>)> {
    match dag.kind(node) {
        Kind::Element(Array::Phase(at), row, _) => {
            Some((at.side, at.group, at.column, row.as_constant()))
        }
        _ => None,
    }
}

/// The place of the momentum of a coordinate, or of the coordinate of a momentum.
fn partner(dag: &Dag, node: Node) -> Option<(Side, u16, u16, Option<i64>)> {
    let (side, group, column, row) = place(dag, node)?;
    Some((side.other(), group, column, row))
}

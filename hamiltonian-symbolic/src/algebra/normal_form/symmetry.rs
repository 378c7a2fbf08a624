//! Sums over loops brought to one form among all their re-indexings.
//!
//! Input: a polynomial with sums as atoms. Output: the same polynomial where sums that a
//! re-indexing turns into each other are one atom, and a sum that one turns into its own negative
//! is 0. Invariant: only bijections of a loop's range are used: shifts modulo its length, shifts of the
//! range itself, its reversal, the exchange of loops around each other, and the one that maps j > i onto j < i. A square
//! of iterations is its diagonal and two triangles ([`in_triangles`]), which takes its shifts away and is tried last.

use super::atoms::{Algebra, Key};
use super::polynomial::{Atom, Monomial, Poly, Undecided};
use crate::dag::{Dag, Kind, Node};
use crate::index::{Affine, Domain, Index, Loops};
use crate::list::IntoList;
use crate::ranges::Ranges;
use crate::rational::Rational;

/// The most re-indexings of one sum that are looked at.
pub(super) const MAX_REINDEXINGS: usize = 64;

/// A sum: its loops, outermost first, and its body.
#[derive(Clone, PartialEq, Debug)]
struct LoopSum {
    loops: Vec<Domain>,
    body: Node,
}

/// The polynomial with every sum in its first form.
pub(super) fn canonical(
    algebra: &mut Algebra,
    dag: &mut Dag,
    poly: &Poly,
) -> Result<Poly, Undecided> {
    let mut poly = poly.clone();
    for atom in poly.atoms() {
        if matches!(algebra.entry(atom).key, Key::Sum(..)) {
            let image = first_form(algebra, dag, atom)?;
            if image != Poly::atom(atom, 1) {
                poly = algebra.substituted(&poly, atom, &image)?;
            }
        }
    }
    Ok(poly)
}

/// Returns true if a polynomial is zero, or all sums over one loop together are sums of zeros.
pub(super) fn summands_vanish(algebra: &mut Algebra, poly: &Poly) -> Result<bool, Undecided> {
    let mut left = vec![poly.clone()];
    while let Some(poly) = left.pop() {
        let mut poly = algebra.numerator(&poly)?;
        if !poly.is_zero()
            && let Some(merged) = algebra.merged(&poly)?
        {
            poly = algebra.numerator(&merged)?;
        }
        if poly.is_zero() {
            continue;
        }
        // A product of several loops is not a sum over one of them.
        let mut summands: Vec<(Domain, Poly)> = Vec::new();
        for (monomial, k) in poly.terms() {
            let sums: Vec<_> = monomial
                .0
                .iter()
                .filter(|(atom, _)| matches!(algebra.entry(*atom).key, Key::Sum(..)))
                .into_list();
            let [(atom, 1)] = sums.as_slice() else {
                return Ok(false);
            };
            let Key::Sum(domain, body) = algebra.entry(*atom).key.clone() else {
                return Ok(false);
            };
            let term = Poly::term(k.clone(), monomial.without(*atom).mul(&body));
            match summands.iter_mut().find(|(d, _)| *d == domain) {
                Some((_, summand)) => *summand = summand.add(&term),
                None => summands.push((domain, term)),
            }
        }
        left.extend(summands.into_iter().map(|(_, summand)| summand));
    }
    Ok(true)
}

fn first_form(algebra: &mut Algebra, dag: &mut Dag, atom: Atom) -> Result<Poly, Undecided> {
    let Some(nest) = flattened(algebra, dag, atom) else {
        return Ok(Poly::atom(atom, 1));
    };
    let mut best: Option<(Vec<Domain>, Monomial, Rational)> = None;
    let (images, is_complete) = images(dag, nest);
    if !is_complete {
        algebra.left_out = Some(Undecided::Reindexings);
    }
    for candidate in images {
        if dag.has_too_many_loops() {
            return Err(Undecided::Loops);
        }
        let body = algebra.convert(dag, candidate.body)?;
        let body = algebra.canonical(&body)?;
        let Some((monomial, k)) = body.as_term().cloned() else {
            continue;
        };
        let better = match &best {
            None => true,
            Some((loops, other, sign)) => {
                match (&candidate.loops, &monomial).cmp(&(loops, other)) {
                    std::cmp::Ordering::Equal if *sign != k => return Ok(Poly::default()),
                    order => order.is_lt(),
                }
            }
        };
        if better {
            best = Some((candidate.loops, monomial, k));
        }
    }
    let Some((loops, monomial, k)) = best else {
        return Ok(Poly::atom(atom, 1));
    };
    let mut sum = Poly::term(k, monomial);
    for &domain in loops.iter().rev() {
        algebra.count_loop(dag, domain)?;
        sum = algebra.summed(dag, domain, &sum)?;
    }
    Ok(sum)
}

/// The loops of a sum of a sum; `None` where sums are multiplied inside, or stand inside
/// functions.
fn flattened(algebra: &Algebra, dag: &mut Dag, atom: Atom) -> Option<LoopSum> {
    let mut loops = Vec::new();
    let mut body = Monomial::atom(atom, 1);
    loop {
        let sums: Vec<(Atom, i32)> = body
            .0
            .iter()
            .filter(|(atom, _)| matches!(algebra.entry(*atom).key, Key::Sum(..)))
            .copied()
            .into_list();
        match sums.as_slice() {
            [] => break,
            [(sum, 1)] => {
                let Key::Sum(domain, inner) = &algebra.entry(*sum).key else {
                    return None;
                };
                loops.push(*domain);
                body = body.without(*sum).mul(inner);
            }
            _ => return None,
        }
    }
    let body = algebra.node(dag, &Poly::term(Rational::ONE, body));
    let is_loop = |kind: &Kind| matches!(kind, Kind::Reduce(..) | Kind::Count(_));
    (!dag.has(&[body], &is_loop)).then_some(LoopSum { loops, body })
}

/// All re-indexings of a nest in which each loop that may be shifted has an element at its bare index:
/// they are the same ones whichever of them the nest is. False if there are more.
fn images(dag: &mut Dag, nest: LoopSum) -> (Vec<LoopSum>, bool) {
    let nest = lower(dag, &nest).unwrap_or(nest);
    let nest = from_zero(dag, nest);
    let mut found = vec![nest];
    let mut at = 0;
    while at < found.len() && found.len() < MAX_REINDEXINGS {
        let nest = found[at].clone();
        at += 1;
        let mut images = shifts(dag, &nest);
        images.extend(reversals(dag, &nest));
        images.extend(exchanges(dag, &nest));
        for image in images {
            if !found.contains(&image) {
                found.push(image);
            }
        }
    }
    let is_complete = at == found.len();
    // A sum whose elements all have the index i is not run the other way round: of each such pair it is the first.
    let all_against = |nest: &LoopSum| -> usize {
        let loops = nest.loops.iter();
        loops.map(|domain| against(dag, nest.body, *domain)).sum()
    };
    let least = found.iter().map(all_against).min();
    found.retain(|nest| Some(all_against(nest)) == least);
    if found.iter().any(|nest| is_anchored(dag, nest)) {
        found.retain(|nest| is_anchored(dag, nest));
    }
    (found, is_complete)
}

/// Returns true if each loop over 0..N that is read modulo N is read bare, too.
fn is_anchored(dag: &Dag, nest: &LoopSum) -> bool {
    let nodes = dag.reachable(&[nest.body]);
    let indices: Vec<Index> = nodes
        .iter()
        .filter_map(|node| match dag.kind(*node) {
            Kind::Element(_, row, column) => Some(std::iter::once(row).chain(column.as_deref())),
            _ => None,
        })
        .flatten()
        .flat_map(Index::axes)
        .into_list();
    nest.loops.iter().all(|domain| {
        let end = &dag.range(*domain).end;
        let is_shifted =
            |index: &Index| index.affine.factor(*domain) == 1 && index.modulo.as_ref() == Some(end);
        let is_bare = |index: &Index| index.affine == Affine::variable(*domain);
        !indices.iter().any(is_shifted) || indices.iter().any(is_bare)
    })
}

/// Σ_i Σ_{j>i} f(i, j) as Σ_i Σ_{j<i} f(j, i).
fn lower(dag: &mut Dag, nest: &LoopSum) -> Option<LoopSum> {
    let [i, j] = *nest.loops.as_slice() else {
        return None;
    };
    let (outer, inner) = (dag.range(i).clone(), dag.range(j).clone());
    let after = |d: Domain| Affine::variable(d).plus(1, &Affine::constant(1));
    if inner.start != after(i) || inner.end != outer.end {
        return None;
    }
    let below = dag.domain(Some(i), outer.start, Affine::variable(i));
    let above = dag.domain(Some(below), after(below), outer.end);
    let body = dag.replace(nest.body, i, &Affine::variable(below));
    let body = dag.replace(body, above, &Affine::variable(i));
    Some(LoopSum {
        loops: vec![i, below],
        body,
    })
}

/// Loops that start elsewhere, whatever the loops around, as loops that start at 0; the outermost one inside those loops
/// alone that it needs.
fn from_zero(dag: &mut Dag, nest: LoopSum) -> LoopSum {
    let mut loops: Vec<Domain> = Vec::with_capacity(nest.loops.len());
    let mut shifted: Vec<(Domain, Affine)> = Vec::new();
    for &domain in &nest.loops {
        let image = |d: Domain| {
            let found = shifted.iter().find(|(old, _)| *old == d);
            found.map_or_else(|| Affine::variable(d), |(_, new)| new.clone())
        };
        let range = dag.range(domain).clone();
        let (start, end) = (range.start.substitute(&image), range.end.substitute(&image));
        let by = if start.loops.is_empty() {
            start.clone()
        } else {
            Affine::constant(0)
        };
        // The loop around that has a new name, if it has one.
        let around = nest.loops.iter().position(|d| Some(*d) == range.parent);
        let parent = match around {
            Some(at) => loops.get(at).copied(),
            // A sum that reads no loop around it is the same one in each of them.
            None if loops.is_empty() => {
                let own: Loops = nest.loops.iter().copied().collect();
                let read = dag.variables(nest.body).without(own);
                dag.deepest(read | range.start.variables() | range.end.variables())
            }
            None => range.parent,
        };
        let new = dag.domain(parent, start.plus(-1, &by), end.plus(-1, &by));
        loops.push(new);
        shifted.push((domain, Affine::variable(new).plus(1, &by)));
    }
    if loops == nest.loops {
        return nest;
    }
    // From the innermost out: the new indices name new loops only.
    let mut body = nest.body;
    for (domain, by) in shifted.iter().rev() {
        if *by != Affine::variable(*domain) {
            body = dag.replace(body, *domain, by);
        }
    }
    LoopSum { loops, body }
}

/// Each loop over 0..N shifted so that one of the elements modulo N has the bare index.
fn shifts(dag: &mut Dag, nest: &LoopSum) -> Vec<LoopSum> {
    let mut found = Vec::new();
    for &domain in &nest.loops {
        let range = dag.range(domain).clone();
        if range.start != Affine::constant(0) || !range.end.loops.is_empty() {
            continue;
        }
        let mut offsets: Vec<Affine> = Vec::new();
        for node in dag.reachable(&[nest.body]) {
            let Kind::Element(_, row, column) = dag.kind(node) else {
                continue;
            };
            let all = std::iter::once(row).chain(column.as_deref());
            for index in all.flat_map(Index::axes) {
                let offset = dag.rotation(&index, domain);
                offsets.extend(offset.filter(|offset| !offsets.contains(offset)));
            }
        }
        for offset in offsets {
            let by = Index::wrapped(
                Affine::variable(domain).plus(-1, &offset),
                range.end.clone(),
            );
            if let Some(body) = dag.reindexed(nest.body, domain, &by) {
                found.push(LoopSum {
                    loops: nest.loops.clone(),
                    body,
                });
            }
        }
    }
    found
}

/// The number of elements with the index `c - i` for the variable i of a loop.
fn against(dag: &Dag, body: Node, domain: Domain) -> usize {
    let is_against = |node: &Node| match dag.kind(*node) {
        Kind::Element(_, row, column) => {
            let indices = std::iter::once(row).chain(column.as_deref());
            let mut axes = indices.flat_map(Index::axes);
            axes.any(|axis| axis.affine.factor(domain) == -1)
        }
        _ => false,
    };
    let nodes = dag.reachable(&[body]);
    nodes.iter().filter(|node| is_against(node)).count()
}

/// Each loop run the other way round, if an element has the index `c - i`. No other range may depend on it.
fn reversals(dag: &mut Dag, nest: &LoopSum) -> Vec<LoopSum> {
    let mut found = Vec::new();
    for &domain in &nest.loops {
        let is_read = |other: &Domain| {
            let range = dag.range(*other);
            range.start.factor(domain) != 0 || range.end.factor(domain) != 0
        };
        if nest.loops.iter().any(is_read) {
            continue;
        }
        if against(dag, nest.body, domain) == 0 {
            continue;
        }
        let range = dag.range(domain);
        let last = range.start.plus(1, &range.end);
        let last = last.plus(-1, &Affine::constant(1));
        let by = last.plus(-1, &Affine::variable(domain));
        found.push(LoopSum {
            loops: nest.loops.clone(),
            body: dag.replace(nest.body, domain, &by),
        });
    }
    found
}

/// Each two loops, one directly inside the other, exchanged, if the range of the inner one does not depend on the outer
/// one.
fn exchanges(dag: &mut Dag, nest: &LoopSum) -> Vec<LoopSum> {
    let mut found = Vec::new();
    let is_inside = |pair: &[Domain]| dag.range(pair[1]).parent == Some(pair[0]);
    if !nest.loops.windows(2).all(is_inside) {
        return found;
    }
    for at in 1..nest.loops.len() {
        let (i, j) = (nest.loops[at - 1], nest.loops[at]);
        let (outer, inner) = (dag.range(i).clone(), dag.range(j).clone());
        if inner.start.factor(i) != 0 || inner.end.factor(i) != 0 {
            continue;
        }
        let first = dag.domain(outer.parent, inner.start.clone(), inner.end.clone());
        let second = dag.domain(Some(first), outer.start, outer.end);
        // The inner loop moves into `second`, and from there to `first`.
        let moved = dag.domain(Some(second), inner.start, inner.end);
        let body = dag.replace(nest.body, i, &Affine::variable(second));
        let body = dag.replace(body, moved, &Affine::variable(first));
        let mut loops = nest.loops[..at - 1].to_vec();
        loops.extend([first, second]);
        let image = |d: Domain| match d {
            d if d == i => Affine::variable(second),
            d if d == j => Affine::variable(first),
            d => Affine::variable(d),
        };
        let mut images: Vec<(Domain, Domain)> = Vec::new();
        for &deeper in &nest.loops[at + 1..] {
            let image = |d: Domain| {
                let known = images.iter().find(|(old, _)| *old == d);
                known.map_or_else(|| image(d), |(_, new)| Affine::variable(*new))
            };
            let range = dag.range(deeper).clone();
            let (start, end) = (range.start.substitute(&image), range.end.substitute(&image));
            let new = dag.domain(loops.last().copied(), start, end);
            images.push((deeper, new));
            loops.push(new);
        }
        // The values that move with the loops have moved.
        let inside = dag.variables(body);
        let is_left = |old: &Domain| inside.has(*old) && !loops.contains(old);
        if !nest.loops.iter().any(is_left) {
            found.push(LoopSum { loops, body });
        }
    }
    found
}

/// The polynomial with each sum over a square or a triangle with its diagonal, and each product of two sums over one
/// range, as the sum over the diagonal and that over the triangle below; `None` if there is none.
pub(super) fn in_triangles(
    algebra: &mut Algebra,
    dag: &mut Dag,
    poly: &Poly,
) -> Result<Option<Poly>, Undecided> {
    let (mut total, mut is_changed) = (Poly::default(), false);
    for (monomial, k) in poly.terms().to_vec() {
        let is_sum = |(atom, _): &&(Atom, i32)| matches!(algebra.entry(*atom).key, Key::Sum(..));
        let sums: Vec<(Atom, i32)> = monomial.0.iter().filter(is_sum).copied().into_list();
        let nests: Vec<LoopSum> = sums
            .iter()
            .filter_map(|(atom, _)| flattened(algebra, dag, *atom))
            .into_list();
        let square = match (sums.as_slice(), nests.as_slice()) {
            ([(_, 1)], [nest]) => Some(nest.clone()),
            ([(_, 2)], [nest]) => product(dag, nest, nest),
            ([(_, 1), (_, 1)], [a, b]) => product(dag, a, b),
            _ => None,
        };
        let parts = square.and_then(|square| parts(dag, &square));
        let Some(parts) = parts else {
            total = total.add(&Poly::term(k, monomial));
            continue;
        };
        is_changed = true;
        if dag.has_too_many_loops() {
            return Err(Undecided::Loops);
        }
        let sum = dag.add(&parts);
        algebra.count(dag, sum)?;
        let sum = algebra.convert(dag, sum)?;
        let sum = algebra.canonical(&sum)?;
        let others = sums
            .iter()
            .fold(monomial, |rest, (atom, _)| rest.without(*atom));
        total = total.add(&sum.times(&others).scale(&k));
    }
    Ok(is_changed.then_some(total))
}

/// The product of two sums over one range, as a sum over a square.
fn product(dag: &mut Dag, a: &LoopSum, b: &LoopSum) -> Option<LoopSum> {
    let ([i], [other]) = (a.loops.as_slice(), b.loops.as_slice()) else {
        return None;
    };
    let (range, there) = (dag.range(*i).clone(), dag.range(*other).clone());
    if (&range.start, &range.end) != (&there.start, &there.end) || range.parent.is_some() {
        return None;
    }
    let j = dag.domain(Some(*i), range.start, range.end);
    let inner = dag.replace(b.body, *other, &Affine::variable(j));
    Some(LoopSum {
        loops: vec![*i, j],
        body: dag.mul(&[a.body, inner]),
    })
}

/// The sums over the diagonal of a square, and over the triangle below it of what is below and of what is above; or a
/// sum over a triangle of what does not read the outer variable. `None` for other nests.
fn parts(dag: &mut Dag, nest: &LoopSum) -> Option<Vec<Node>> {
    let [i, j] = *nest.loops.as_slice() else {
        return None;
    };
    let (outer, inner) = (dag.range(i).clone(), dag.range(j).clone());
    let after = Affine::variable(i).plus(1, &Affine::constant(1));
    let from_first = inner.start == outer.start;
    let is_strict = from_first && inner.end == Affine::variable(i);
    if is_strict && !dag.variables(nest.body).has(i) {
        // Each j is met once for every i above it.
        let above = outer.end.plus(-1, &after);
        let above = dag.affine(&above);
        let body = dag.replace(nest.body, j, &Affine::variable(i));
        let body = dag.mul(&[above, body]);
        return Some(vec![dag.reduce(i, body)]);
    }
    let to_last = inner.end == outer.end;
    let (is_below, is_above) = match () {
        () if from_first && to_last => (true, true),
        () if from_first && inner.end == after => (true, false),
        () if to_last && inner.start == Affine::variable(i) => (false, true),
        () => return None,
    };
    if inner.parent != Some(i) {
        return None;
    }
    let diagonal = dag.replace(nest.body, j, &Affine::variable(i));
    let mut sums = vec![dag.reduce(i, diagonal)];
    let below = dag.domain(Some(i), outer.start.clone(), Affine::variable(i));
    let mut over = |dag: &mut Dag, body: Node| {
        let row = dag.reduce(below, body);
        sums.push(dag.reduce(i, row));
    };
    if is_below {
        let body = dag.replace(nest.body, j, &Affine::variable(below));
        over(dag, body);
    }
    if is_above {
        // As in `lower`: j moves into the loop `below`, and takes the place of i.
        let image = |d: Domain| Affine::variable(if d == i { below } else { d });
        let [start, end] = [&inner.start, &inner.end].map(|bound| bound.substitute(image));
        let above = dag.domain(Some(below), start, end);
        let body = dag.replace(nest.body, i, &Affine::variable(below));
        let body = dag.replace(body, above, &Affine::variable(i));
        over(dag, body);
    }
    Some(sums)
}

//! Substitution of coordinates with the simplification that makes it worth while.
//!
//! Input: expressions in old variables, the image of each, and the rules of the charts. Output: the
//! same expressions in new variables. Invariant: a sum is multiplied out only where that makes it
//! cheaper, by sin² + cos² = 1 or m_i = M_i − M_{i−1} on collected coefficients; a sum inside a
//! function or below a fraction line that is known to be ≥ 0 stays known to be so, because a
//! distance must not be computed by cancellation.

use crate::dag::{Dag, Kind, Map, Node, Sign, Stage, work};
use crate::list::IntoList;
use crate::op::Op;
use crate::product::{Factors, Product};
use crate::rational::Rational;
use crate::sort::Arrange;
use crate::structure::{Collected, expand_within};

/// The most terms of all sums together that are multiplied out: of more operations a system is refused.
const BUDGET: usize = 1 << 14;
/// The most terms of one operand that are multiplied out.
const LONGEST: usize = 1 << 12;
/// The largest power that is rewritten.
const HIGHEST: i32 = 16;

/// Identities that hold on the charts.
#[derive(Clone, Debug, Default)]
pub(super) struct Rules {
    /// Sines and cosines of one angle each.
    pub(super) angles: Vec<(Node, Node)>,
    /// Nodes that are > 0 on the chart.
    pub(super) positive: Vec<Node>,
    /// m, M, M′ with m = M − M′, all > 0.
    pub(super) masses: Vec<(Node, Node, Node)>,
}

/// The most operations that a substitution makes; the macro refuses systems of fewer.
pub(super) const OPERATIONS: usize = 1 << 17;

/// The roots with each node replaced that has an image; `None` where that makes more than
/// [`OPERATIONS`].
pub(super) fn substitute(
    dag: &mut Dag,
    roots: &[Node],
    images: &Map<Node, Node>,
    rules: &Rules,
) -> Option<Vec<Node>> {
    let order = dag.reachable(roots);
    let inside = inside(dag, &order);
    let mut operations = 0;
    let mut reducer = Reducer {
        rules,
        left: BUDGET,
    };
    let new = dag.try_map(order, |dag, node, new| {
        if let Some(image) = images.get(&node) {
            return Some(*image);
        }
        let mut changed = false;
        dag.for_children(node, |child| changed |= new[&child] != child);
        let image = if changed {
            let image = dag.rebuild(node, &|child| new[&child]);
            operations += match dag.kind(image) {
                Kind::Sum(_, terms) => terms.len(),
                Kind::Product(_, factors) => factors.len(),
                _ => 1,
            };
            if operations > OPERATIONS {
                return None;
            }
            let image = positive(dag, image, rules);
            reducer.reduce_node(dag, image, inside.contains_key(&node))
        } else {
            node
        };
        Some(image)
    });
    new.map(|new| roots.iter().map(|root| new[root]).into_list())
}

/// A node made of others that were reduced before.
pub(super) fn reduce(dag: &mut Dag, node: Node, rules: &Rules) -> Node {
    let mut reducer = Reducer {
        rules,
        left: BUDGET,
    };
    reducer.sum(dag, node, false)
}

/// The nodes that stand inside a function or below a fraction line.
fn inside(dag: &Dag, order: &[Node]) -> Map<Node, ()> {
    let mut inside: Map<Node, ()> = Map::default();
    for &node in order.iter().rev() {
        let all = inside.contains_key(&node)
            || !matches!(
                dag.kind(node),
                Kind::Sum(..) | Kind::Product(..) | Kind::Reduce(..)
            );
        if all {
            dag.for_children(node, |child| {
                inside.insert(child, ());
            });
        } else if let Kind::Product(_, factors) = dag.kind(node) {
            for (factor, _) in factors.iter().filter(|(_, n)| *n < 0) {
                inside.insert(*factor, ());
            }
        }
    }
    inside
}

/// |x| where x is positive on the chart is x.
fn positive(dag: &mut Dag, node: Node, rules: &Rules) -> Node {
    let bare = |dag: &mut Dag, node: Node| -> Option<Node> {
        let Kind::Call(Op::Abs, arguments) = dag.kind(node) else {
            return None;
        };
        let inner = arguments[0];
        let sign = |node: Node| match rules.positive.contains(&node) {
            true => Sign::POSITIVE,
            false => dag.sign(node),
        };
        let known = match dag.kind(inner) {
            Kind::Product(k, factors) => {
                Sign::of_product(k, factors.iter().map(|(f, n)| (sign(*f), *n)))
            }
            _ => sign(inner),
        };
        known.is_nonnegative().then_some(inner)
    };
    if let Some(inner) = bare(dag, node) {
        return inner;
    }
    let Kind::Product(k, factors) = dag.kind(node).clone() else {
        return node;
    };
    let mut changed = false;
    let mut images = Vec::with_capacity(factors.len());
    for (factor, n) in factors {
        let image = bare(dag, factor).unwrap_or(factor);
        changed |= image != factor;
        images.push((image, n));
    }
    if changed {
        dag.product(&k, &images)
    } else {
        node
    }
}

struct Reducer<'a> {
    rules: &'a Rules,
    left: usize,
}

impl Reducer<'_> {
    /// A rebuilt node, simplified at its own level.
    fn reduce_node(&mut self, dag: &mut Dag, node: Node, inside: bool) -> Node {
        match dag.kind(node).clone() {
            Kind::Sum(..) => self.sum(dag, node, inside),
            Kind::Call(Op::Hypot, arguments) => {
                let squares = dag.sum_of_squares(&arguments);
                let squares = self.sum(dag, squares, true);
                let root = dag.call(Op::Sqrt, &[squares]);
                let root = positive(dag, root, self.rules);
                if matches!(dag.kind(root), Kind::Call(Op::Sqrt, _)) {
                    node
                } else {
                    root
                }
            }
            _ => node,
        }
    }

    /// The sum with those of its operands multiplied out and collected that gain by it.
    fn sum(&mut self, dag: &mut Dag, node: Node, inside: bool) -> Node {
        let (mut constant, operands) = match dag.kind(node) {
            Kind::Sum(c, terms) => (c.clone(), terms.clone()),
            Kind::Product(..) => (Rational::ZERO, vec![(Rational::ONE, node)]),
            _ => return node,
        };
        let mut terms: Vec<Vec<Product>> = Vec::with_capacity(operands.len());
        for (k, operand) in &operands {
            let scaled = dag.scale(k, *operand);
            // The limit is known before anything is multiplied out.
            let Some(found) = expand_within(dag, scaled, self.left.min(LONGEST)) else {
                return node;
            };
            self.left -= found.len();
            terms.push(found);
        }
        let parts = connected(dag, &terms, self.rules);
        let mut picked: Vec<(Rational, Node)> = Vec::with_capacity(parts.len());
        for part in &parts {
            let own: Vec<(Rational, Node)> =
                part.iter().map(|at| operands[*at].clone()).into_list();
            let together: Vec<&Product> = part.iter().flat_map(|at| &terms[*at]).into_list();
            let better = self.cheaper(dag, &own, &together);
            // An operand that is a sum is continued: its terms were collected with the others.
            for (k, operand) in better.map_or(own, |better| vec![(Rational::ONE, better)]) {
                match dag.kind(operand) {
                    Kind::Sum(c, inner) if k.is_one() => {
                        constant = constant.add(c);
                        picked.extend(inner.iter().cloned());
                    }
                    _ => picked.push((k, operand)),
                }
            }
        }
        let reduced = dag.collected(&constant, &picked, false);
        if inside && dag.is_nonnegative(node) && !dag.is_nonnegative(reduced) {
            return node;
        }
        reduced
    }

    /// Some operands of a sum, multiplied out and collected, where that is cheaper.
    fn cheaper(
        &self,
        dag: &mut Dag,
        own: &[(Rational, Node)],
        together: &[&Product],
    ) -> Option<Node> {
        let kept = dag.linear(&Rational::ZERO, own);
        let mut best: Option<(u32, Node)> = None;
        for keeps_sines in [true, false] {
            let mut collected = Collected::default();
            let mut rewritten = false;
            for term in together {
                rewritten |= rewrite(term, self.rules, keeps_sines, &mut collected);
            }
            let terms = collected.terms();
            let (before, after) = (together.len(), terms.len());
            if after > before || after == before && !rewritten {
                continue;
            }
            let node = grouped(dag, &terms);
            let price = work(dag, &[node]);
            if best.is_none_or(|(least, _)| price < least) {
                best = Some((price, node));
            }
            if !rewritten {
                break;
            }
        }
        let (price, node) = best?;
        (price < work(dag, &[kept])).then_some(node)
    }
}

/// The operands that have a monomial in common, directly or through others, in order.
fn connected(dag: &Dag, terms: &[Vec<Product>], rules: &Rules) -> Vec<Vec<usize>> {
    let mut parts: Vec<(Vec<usize>, Map<Factors, ()>)> = Vec::new();
    for (at, own) in terms.iter().enumerate() {
        let mut collected = Collected::default();
        for term in own {
            rewrite(term, rules, true, &mut collected);
        }
        let mut monomials: Map<Factors, ()> = Map::default();
        for term in collected.terms() {
            let (_, mut factors) = parted(dag, &term);
            factors.arrange();
            monomials.insert(factors, ());
        }
        let mut part = vec![at];
        parts.retain_mut(|(others, known)| {
            let meets = monomials.keys().any(|factors| known.contains_key(factors));
            if meets {
                part.append(others);
                monomials.extend(std::mem::take(known));
            }
            !meets
        });
        part.arrange();
        parts.push((part, monomials));
    }
    let mut parts: Vec<Vec<usize>> = parts.into_iter().map(|(part, _)| part).into_list();
    parts.arrange();
    parts
}

/// The factors that are computed once per run, and those computed at every evaluation.
fn parted(dag: &Dag, term: &Product) -> (Factors, Factors) {
    term.factors
        .iter()
        .partition(|(node, _)| dag.stage(*node) < Stage::Evaluation)
}

/// Adds a term, rewritten by the rules, to a collection. Returns true if a rule applied.
fn rewrite(term: &Product, rules: &Rules, keeps_sines: bool, into: &mut Collected) -> bool {
    let mut terms = vec![term.clone()];
    let mut rewritten = false;
    for &(sin, cos) in &rules.angles {
        let (kept, gone) = match keeps_sines {
            true => (sin, cos),
            false => (cos, sin),
        };
        // gone² = 1 − kept²
        rewritten |= exchange(&mut terms, (gone, 2), |_, k| vec![(kept, 2 * k)]);
    }
    for &(mass, sum, before) in &rules.masses {
        // m = M − M′
        rewritten |= exchange(&mut terms, (mass, 1), |n, k| {
            vec![(sum, n - k), (before, k)]
        });
    }
    terms.into_iter().for_each(|term| into.add(term));
    rewritten
}

/// Writes powers of `gone`^`step` = a − b as powers of the difference, aⁿ⁻ᵏbᵏ being the powers that
/// are given for n and k. Returns true if there were any.
fn exchange(
    terms: &mut Vec<Product>,
    (gone, step): (Node, i32),
    powers: impl Fn(i32, i32) -> Factors,
) -> bool {
    let mut rewritten = false;
    for term in std::mem::take(terms) {
        let own = term.exponent(gone);
        if !(step..=HIGHEST).contains(&own) {
            terms.push(term);
            continue;
        }
        rewritten = true;
        let n = own / step;
        let mut binomial = Rational::ONE;
        for k in 0..=n {
            let mut by = Product::new(binomial.clone(), powers(n, k));
            by.multiply(gone, -step * n);
            terms.push(
                term.times(&by)
                    .expect("powers that are rewritten are small"),
            );
            let next = Rational::new(i64::from(k - n), i64::from(k + 1));
            binomial = binomial.mul(&next);
        }
    }
    rewritten
}

/// The sum of terms, those that differ in parameters only under one coefficient.
fn grouped(dag: &mut Dag, terms: &[Product]) -> Node {
    let mut place: Map<Factors, usize> = Map::default();
    let mut groups: Vec<(Factors, Vec<Product>)> = Vec::new();
    for term in terms {
        let (parameters, factors) = parted(dag, term);
        let mut key = factors.clone();
        key.arrange();
        let at = *place.entry(key).or_insert(groups.len());
        if at == groups.len() {
            groups.push((factors, Vec::new()));
        }
        let coefficient = Product::new(term.coefficient.clone(), parameters);
        groups[at].1.push(coefficient);
    }
    let mut operands = Vec::with_capacity(groups.len());
    for (factors, coefficients) in groups {
        let mut all = Product::new(Rational::ONE, factors);
        if let [coefficient] = coefficients.as_slice() {
            all.coefficient = coefficient.coefficient.clone();
            all.factors.extend(&coefficient.factors);
        } else {
            let parts = coefficients.into_iter().map(|part| part.split(dag));
            let parts = parts.into_list();
            all.multiply(dag.linear(&Rational::ZERO, &parts), 1);
        }
        operands.push((Rational::ONE, all.node(dag)));
    }
    dag.collected(&Rational::ZERO, &operands, false)
}

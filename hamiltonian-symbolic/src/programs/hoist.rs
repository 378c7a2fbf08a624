//! Expressions of one row of parameter arrays, which preparation computes once: `1/m[i]` is read where `p[i]/m[i]` is
//! written.
//!
//! Input: expressions of parameter arrays, before they are factored. Output: the same functions;
//! what takes a division or a function and depends on one row of parameter arrays alone is read
//! from an array that preparation fills. Invariant: an element is computed as it would have been
//! in the loop, from the same row.

use crate::dag::{Array, Dag, Kind, Map, Node, Stage};
use crate::index::{Affine, Domain, Index, LOOPS};
use crate::model::{ParameterDeclaration, Shape};
use crate::product::Factors;
use crate::rational::Rational;

/// An array that preparation fills: element k has the value that `value` has where the loop
/// `domain` is at k.
#[derive(Clone, PartialEq, Debug)]
pub struct Hoisted {
    /// The number of elements.
    pub rows: Affine,
    /// The loop over all of them.
    pub domain: Domain,
    /// The element, in terms of the loop.
    pub value: Node,
}

/// An index, and how many rows the arrays have that it is of.
type RowAccess = (Index, Affine);

/// The dependences of an expression.
#[derive(Clone, PartialEq)]
enum Reads {
    /// Scalars among the parameters.
    Scalars,
    /// One row of parameter arrays of equal length too.
    Access(Box<Index>, Affine),
    /// Anything else.
    More,
}

/// The arrays of a program.
#[derive(Default)]
pub(crate) struct Arrays {
    pub(crate) hoisted: Vec<Hoisted>,
    known: Map<Node, u16>,
}

impl Arrays {
    /// Rewrites the expressions the roots stand for.
    pub(crate) fn hoist(
        &mut self,
        dag: &mut Dag,
        parameters: &[ParameterDeclaration],
        roots: &mut [Node],
    ) {
        let order = dag.reachable(roots);
        let mut known: Map<Node, (Reads, bool)> = Map::default();
        for &node in &order {
            known.insert(node, describe(dag, parameters, node, &known));
        }
        let row = |node: Node| match &known[&node].0 {
            Reads::Access(row, rows) => Some(((**row).clone(), rows.clone())),
            Reads::Scalars | Reads::More => None,
        };
        let is_dear = |node: &Node| known[node].1;
        let new = dag.map(order, |dag, node, new| match dag.kind(node).clone() {
            _ if known[&node].0 != Reads::More => node,
            Kind::Product(k, factors) if !dag.is_sealed(node) => {
                let mut rest: Factors = Vec::new();
                let mut groups: Vec<(RowAccess, Factors)> = Vec::new();
                for (base, n) in factors {
                    match row(base) {
                        None => rest.push((new[&base], n)),
                        Some(row) => match groups.iter_mut().find(|(own, _)| *own == row) {
                            Some((_, group)) => group.push((base, n)),
                            None => groups.push((row, vec![(base, n)])),
                        },
                    }
                }
                for ((row, rows), group) in groups {
                    if let [(base, n @ ..=-1)] = group.as_slice() {
                        // Powers of a reciprocal share it.
                        let value = dag.product(&Rational::ONE, &[(*base, -1)]);
                        rest.push((self.element(dag, value, &row, rows), -n));
                    } else if group.iter().any(|(base, n)| *n < 0 || is_dear(base)) {
                        let value = dag.product(&Rational::ONE, &group);
                        rest.push((self.element(dag, value, &row, rows), 1));
                    } else {
                        rest.extend(group);
                    }
                }
                dag.product(&k, &rest)
            }
            _ => {
                let mut dear = Vec::new();
                dag.for_children(node, |child| dear.extend(Some(child).filter(is_dear)));
                for child in dear {
                    if let Some((row, rows)) = row(child) {
                        new.insert(child, self.element(dag, child, &row, rows));
                    }
                }
                dag.rebuild(node, &|child| new[&child])
            }
        });
        for root in roots {
            *root = match row(*root) {
                Some((row, rows)) if is_dear(root) => self.element(dag, *root, &row, rows),
                _ => new[root],
            };
        }
    }

    /// The element of the array that holds an expression of a row; the expression itself where
    /// there are as many loops as there may be.
    fn element(&mut self, dag: &mut Dag, value: Node, row: &Index, rows: Affine) -> Node {
        if dag.loop_count() == LOOPS {
            return value;
        }
        let domain = dag.domain(None, Affine::constant(0), rows.clone());
        let own = Index::of_loop(domain);
        let value = dag.substitute(value, |dag, node| match *dag.kind(node) {
            Kind::Element(array, ref at, None) if at == row => {
                Some(dag.element(array, own.clone(), None))
            }
            _ => None,
        });
        let next = self.hoisted.len() as u16;
        let number = *self.known.entry(value).or_insert(next);
        if number == next {
            self.hoisted.push(Hoisted {
                rows,
                domain,
                value,
            });
        }
        dag.element(Array::Hoisted(number), row.clone(), None)
    }
}

/// The dependences of a node, and whether it takes a division or a function to compute it from a row.
fn describe(
    dag: &Dag,
    parameters: &[ParameterDeclaration],
    node: Node,
    known: &Map<Node, (Reads, bool)>,
) -> (Reads, bool) {
    if dag.stage(node) > Stage::Parameters {
        return (Reads::More, false);
    }
    if dag.variables(node).is_empty() {
        return (Reads::Scalars, false);
    }
    let of_children = || {
        let (mut all, mut is_dear) = (Reads::Scalars, false);
        dag.for_children(node, |child| {
            is_dear |= known[&child].1;
            all = match (&all, &known[&child].0) {
                (Reads::Scalars, other) | (other, Reads::Scalars) => other.clone(),
                (one, other) if one == other => other.clone(),
                _ => Reads::More,
            };
        });
        (all, is_dear)
    };
    match dag.kind(node) {
        Kind::Element(Array::Parameter(parameter), row, None) => {
            match &parameters[usize::from(parameter.0)].shape {
                Shape::Vector(rows) => (Reads::Access(Box::new(row.clone()), rows.clone()), false),
                _ => (Reads::More, false),
            }
        }
        Kind::Sum(..) => of_children(),
        Kind::Product(_, factors) => {
            let (reads_of, is_dear) = of_children();
            let divides = |(base, n): &(Node, i32)| *n < 0 && known[base].0 != Reads::Scalars;
            (reads_of, is_dear || factors.iter().any(divides))
        }
        Kind::Call(..) => (of_children().0, true),
        _ => (Reads::More, false),
    }
}

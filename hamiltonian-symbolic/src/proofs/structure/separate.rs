//! H = T(p, t) + V(q, t), or the term that forbids it.
//!
//! Input: a model and its H. Output: [`Separation`] or [`Coupling`]. Invariant: a term that does not
//! couple stays as it was written; only those that do are multiplied out, and of these only those
//! that still do are replaced by what relations between functions (sin² + cos² = 1) leave of them.

use super::{Coupling, Separation, components, expand};
use crate::dag::{Dag, Dependence, Kind, Map, Node};
use crate::list::IntoList;
use crate::model::Model;
use crate::normal_form;
use crate::print;
use crate::rational::Rational;

const BOTH: Dependence = Dependence(Dependence::Q.0 | Dependence::P.0);

fn couples(dag: &Dag, node: Node) -> bool {
    let dependence = dag.dependence(node);
    dependence.on(Dependence::Q) && dependence.on(Dependence::P)
}

/// The split of H, or the first coupling term.
pub(super) fn split(model: &mut Model, h: Node) -> Result<Separation, Coupling> {
    let parts = apart(model, h);
    if model.dag.is_zero(parts.coupling) {
        return Ok(parts.split(true));
    }
    // Coupling terms may cancel, though not those of different degrees of freedom.
    match resolved(model, parts) {
        Ok(parts) => Ok(parts.split(false)),
        Err((term, limit)) => Err(Coupling {
            term,
            text: print::text(model, term),
            limit,
        }),
    }
}

/// T, V and what is neither: they add up to the whole.
#[derive(Clone, Copy)]
struct Separated {
    kinetic: Node,
    potential: Node,
    coupling: Node,
}

impl Separated {
    fn split(self, as_written: bool) -> Separation {
        Separation {
            as_written,
            kinetic: self.kinetic,
            potential: self.potential,
        }
    }

    /// The image of each part.
    fn map(self, mut f: impl FnMut(Node) -> Node) -> Separated {
        Separated {
            kinetic: f(self.kinetic),
            potential: f(self.potential),
            coupling: f(self.coupling),
        }
    }
}

/// The parts with what couples resolved, or the first term that couples all the same and the limit that
/// left it undecided. Each group of terms that have no degree of freedom in common with the others has
/// limits of its own.
fn resolved(model: &mut Model, parts: Separated) -> Result<Separated, (Node, Option<String>)> {
    let terms = match model.dag.kind(parts.coupling).clone() {
        Kind::Sum(_, terms) => {
            let terms = terms.iter().map(|(k, term)| model.dag.scale(k, *term));
            terms.into_list()
        }
        _ => vec![parts.coupling],
    };
    let mut found = vec![Separated {
        coupling: model.dag.integer(0),
        ..parts
    }];
    let groups = components(&model.dag, &terms);
    if groups.len() < 2 {
        found.extend(resolved_group(model, parts.coupling)?);
    } else {
        for group in groups {
            let coupling = model.dag.add(&group);
            found.extend(resolved_group(model, coupling)?);
        }
    }
    let kinetic: Vec<Node> = found.iter().map(|part| part.kinetic).into_list();
    let potential: Vec<Node> = found.iter().map(|part| part.potential).into_list();
    Ok(Separated {
        kinetic: model.dag.add(&kinetic),
        potential: model.dag.add(&potential),
        coupling: model.dag.integer(0),
    })
}

/// A coupling multiplied out, and what still couples related: parts that add up to it.
fn resolved_group(
    model: &mut Model,
    coupling: Node,
) -> Result<Vec<Separated>, (Node, Option<String>)> {
    let zero = model.dag.integer(0);
    let mut found = Vec::new();
    match expand(&mut model.dag, coupling) {
        Some(terms) => {
            for term in &terms {
                // A term may be a sum again inside a loop or an `if`.
                let term = term.node(&mut model.dag);
                found.push(apart(model, term));
            }
        }
        None => found.push(Separated {
            kinetic: zero,
            potential: zero,
            coupling,
        }),
    }
    let couplings: Vec<Node> = found.iter().map(|part| part.coupling).into_list();
    if let Some(first) = couplings.iter().find(|node| !model.dag.is_zero(**node)) {
        let coupling = model.dag.add(&couplings);
        let (kinetic, potential) =
            normal_form::separated(model, coupling).map_err(|limit| (*first, limit))?;
        for part in &mut found {
            part.coupling = zero;
        }
        found.push(Separated {
            kinetic,
            potential,
            coupling: zero,
        });
    }
    Ok(found)
}

/// The parts of a node by its own sums, each as it was written.
fn apart(model: &mut Model, root: Node) -> Separated {
    let zero = model.dag.integer(0);
    let nothing = Separated {
        kinetic: zero,
        potential: zero,
        coupling: zero,
    };
    let mut parts: Map<Node, Separated> = Map::default();
    for node in spine(&model.dag, root) {
        if !couples(&model.dag, node) {
            let one_sided = if model.dag.dependence(node).on(Dependence::P) {
                Separated {
                    kinetic: node,
                    ..nothing
                }
            } else {
                Separated {
                    potential: node,
                    ..nothing
                }
            };
            parts.insert(node, one_sided);
            continue;
        }
        let whole = Separated {
            coupling: node,
            ..nothing
        };
        let found = match model.dag.kind(node).clone() {
            Kind::Sum(c, terms) => {
                let mut sum = |constant: &Rational, part: fn(&Separated) -> Node| {
                    let terms = terms.iter().map(|(k, n)| (k.clone(), part(&parts[n])));
                    let terms: Vec<(Rational, Node)> = terms.into_list();
                    model.dag.linear(constant, &terms)
                };
                Separated {
                    kinetic: sum(&Rational::ZERO, |part| part.kinetic),
                    potential: sum(&c, |part| part.potential),
                    coupling: sum(&Rational::ZERO, |part| part.coupling),
                }
            }
            Kind::Product(k, mut factors) => {
                // One factor holds all the dependence; the others are distributed over its parts.
                let moving = |(n, _): &(Node, i32)| model.dag.dependence(*n).on(BOTH);
                let at = factors.iter().position(moving);
                match at {
                    Some(at) if factors[at].1 == 1 && !factors[at + 1..].iter().any(moving) => {
                        parts[&factors[at].0].map(|part| {
                            factors[at].0 = part;
                            model.dag.product(&k, &factors)
                        })
                    }
                    _ => whole,
                }
            }
            Kind::Reduce(domain, body) => parts[&body].map(|part| model.dag.reduce(domain, part)),
            Kind::Select(condition, yes, no) if !model.dag.dependence(condition).on(BOTH) => {
                let (yes, no) = (parts[&yes], parts[&no]);
                Separated {
                    kinetic: model.dag.select(condition, yes.kinetic, no.kinetic),
                    potential: model.dag.select(condition, yes.potential, no.potential),
                    coupling: model.dag.select(condition, yes.coupling, no.coupling),
                }
            }
            _ => whole,
        };
        parts.insert(node, found);
    }
    parts[&root]
}

/// The nodes that are looked into, children first: coupled ones, and their children.
fn spine(dag: &Dag, root: Node) -> Vec<Node> {
    dag.reached(&[root], &mut |node, ahead| match dag.kind(node) {
        _ if !couples(dag, node) => {}
        Kind::Sum(_, terms) => ahead.extend(terms.iter().map(|(_, n)| n)),
        Kind::Product(_, factors) => ahead.extend(factors.iter().map(|(n, _)| n)),
        Kind::Reduce(_, body) => ahead.add(*body),
        Kind::Select(_, yes, no) => ahead.extend([yes, no].into_iter()),
        _ => {}
    })
}

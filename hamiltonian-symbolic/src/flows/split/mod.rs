//! Exact splittings: H as a sum of few pieces, each with a flow in closed form.
//!
//! Input: a model. Output: a [`Decomposition`] found ([`find`]) or declared ([`declared`]), or the term
//! that has no flow. Invariant: the pieces are proven to add up to H, and each has an exact flow: it
//! is an instance of a form of [`FORMS`], or made of such by rules that are theorems.

mod cover;
mod join;
mod large;
mod rank;
mod sweep;

pub use crate::flows::limits::{EXPRESSIONS, Limit, PIECES};
pub use crate::flows::solve::forms::{FORMS, SolvableForm};

use crate::dag::{Dag, Kind, Node};
use crate::flows::limits::{MORE_PIECES, is_large};
use crate::flows::solve::forms::is_constant_form;
use crate::flows::solve::{self, units};
use crate::flows::space::Space;
use crate::list::IntoList;
use crate::model::{ExactFlow, Model, NamedMotion, Piece};
use crate::print;
use crate::rational::Rational;
use crate::sort::Arrange;
use crate::transform::check_split;

/// H as a sum of pieces, outermost first.
#[derive(Clone, PartialEq, Debug)]
pub struct Decomposition {
    /// The pieces.
    pub pieces: Vec<Piece>,
    /// The reasons of the choice; `None` for one by hand.
    pub choice: Option<Reasons>,
}

/// The reasons for a splitting.
#[derive(Clone, PartialEq, Debug)]
pub struct Reasons {
    /// max|H − H₀| of the composition of second order with step 1/10, the mean of four short orbits
    /// from points near unit size; NaN where none could be followed.
    pub error: f64,
    /// The number of splittings and orders that were compared.
    pub among: usize,
    /// True if every piece keeps every declared invariant (of which there is at least one).
    pub keeps_invariants: bool,
}

/// The term of H that no form takes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct NoFlow {
    /// The term, as it was written.
    pub node: Node,
    /// The text of the term.
    pub text: String,
    /// The limit that ended the search, if one did: the term may then have a flow.
    pub limit: Option<Limit>,
}

impl NoFlow {
    fn of(model: &Model, node: Node, limit: Option<Limit>) -> NoFlow {
        let text = print::text(model, node);
        NoFlow { node, text, limit }
    }
}

/// The exact flow of one expression; its nodes are in the model's arena.
pub fn exact_flow(model: &mut Model, h: Node) -> Option<ExactFlow> {
    flow_of(model, h).ok()
}

/// The exact flow of one expression, or the limit at which the search ended.
fn flow_of(model: &mut Model, h: Node) -> Result<ExactFlow, Option<Limit>> {
    let mut space = match Space::new(model, &[h]) {
        Ok(space) => space,
        Err(limit) => return looped(model, h).map_err(|own| own.or(limit)),
    };
    let found = any_flow(&mut space, h);
    let mut limit = space.limit(h);
    if found.is_none() && space.has_many_components {
        let is_form = |space: &mut Space| is_constant_form(space, h).then_some(Limit::Components);
        limit = limit
            .or_else(|| space.question(h, is_form))
            .or_else(|| space.limit(h));
    }
    model.dag = space.model.dag;
    if let Some(flow) = found {
        return Ok(flow.into());
    }
    // Groups without a common degree of freedom have budgets of their own.
    let groups = join::groups(model, h);
    if groups.len() > 1 {
        let mut flows = Vec::with_capacity(groups.len());
        for group in groups {
            let mut space = Space::new(model, &[group])?;
            let found = any_flow(&mut space, group);
            let limit = space.limit(group);
            model.dag = space.model.dag;
            flows.push(found.ok_or(limit)?);
        }
        let flow = join::flows(&mut model.dag, &flows);
        return flow.map(ExactFlow::from).ok_or(limit);
    }
    Err(limit)
}

/// The flow of an expression with loops.
fn looped(model: &mut Model, h: Node) -> Result<ExactFlow, Option<Limit>> {
    if sweep::is_linear(&sweep::columns(&model.dag, h)) {
        return Ok(ExactFlow::Linear);
    }
    sweep::one(model, h)
}

/// The flow of an expression as it stands, or multiplied out.
fn any_flow(space: &mut Space, h: Node) -> Option<NamedMotion> {
    let c = space.dag().coefficient();
    let closed = solve::flow(space, h, c).or_else(|| {
        units::refinements(space, h).into_iter().find_map(|units| {
            let nodes: Vec<Node> = units.units.iter().map(|unit| unit.node).into_list();
            let sum = space.dag().add(&nodes);
            // Most sums have none, which takes less than the proof that the sum is h.
            let found = (sum != h).then(|| solve::flow(space, sum, c))??;
            is_constant_apart(space, h, sum).then_some(found)
        })
    });
    closed.or_else(|| solve::exponential(space, h))
}

/// Returns true if two expressions are proven to differ by one that is free of every variable. Terms that both have
/// cancel first.
fn is_constant_apart(space: &mut Space, a: Node, b: Node) -> bool {
    let mut terms = summands(space.dag(), a, Rational::ONE);
    terms.extend(summands(space.dag(), b, Rational::MINUS_ONE));
    let rest = space.dag().linear(&Rational::ZERO, &terms);
    let set = space.set(rest);
    set.is_empty() || space.proves(|space| space.free(rest, set).is_some())
}

/// Parts of H with their flows, outermost first, and the reasons of the choice.
#[derive(Default)]
struct Parts {
    flows: Vec<(Node, NamedMotion)>,
    choice: Option<Reasons>,
}

/// The best splitting of the model's H that the forms give. Groups of terms that have no degree of freedom
/// in common are split apart.
///
/// # Errors
/// [`NoFlow`] with the term that no form takes.
pub fn find(model: &mut Model) -> Result<Decomposition, NoFlow> {
    let h = model.h();
    let groups = join::groups(model, h);
    let whole = Space::new(model, &[h]);
    let has_loops = join::has_loops(&model.dag, h);
    let parts = match whole {
        Err(limit) if has_loops || groups.len() < 2 => {
            return over_loops(model, h).map_err(|refusal| NoFlow {
                limit: refusal.limit.or(limit),
                ..refusal
            });
        }
        Ok(mut space) if groups.len() < 2 => searched(model, &mut space, h)?,
        whole => {
            let whole = whole.ok().filter(|_| !is_large(&model.dag, h));
            let together = whole.and_then(|mut space| {
                let flow = any_flow(&mut space, h)?;
                model.dag = space.model.dag;
                Some(flow)
            });
            match together {
                Some(flow) => Parts {
                    flows: vec![(h, flow)],
                    choice: None,
                },
                None => {
                    let mut found = Vec::with_capacity(groups.len());
                    for group in groups {
                        let mut space = Space::new(model, &[group])
                            .map_err(|limit| NoFlow::of(model, group, limit))?;
                        let label = space.label(group);
                        found.push((label, searched(model, &mut space, group)?));
                    }
                    found.arrange_by_key(|(label, _)| *label);
                    let found = found.into_iter().map(|(_, parts)| parts).into_list();
                    join::parts(model, h, found)
                }
            }
        }
    };
    if parts.flows.len() > PIECES {
        return Err(NoFlow::of(model, h, Some(Limit::Pieces)));
    }
    let pieces = parts.flows.into_iter().map(|(node, flow)| Piece {
        h: node,
        name: print::text(model, node),
        flow: flow.into(),
    });
    Ok(Decomposition {
        pieces: pieces.into_list(),
        choice: parts.choice,
    })
}

/// A splitting into loops of flows.
fn over_loops(model: &mut Model, h: Node) -> Result<Decomposition, NoFlow> {
    let pieces = sweep::find(model, h).map_err(|(term, limit)| NoFlow::of(model, term, limit))?;
    let parts: Vec<Node> = pieces.iter().map(|piece| piece.h).into_list();
    if pieces.len() > PIECES {
        return Err(NoFlow::of(model, h, Some(Limit::Pieces)));
    }
    if pieces.is_empty() || check_split(model, &parts).is_err() {
        return Err(NoFlow::of(model, h, None));
    }
    Ok(Decomposition {
        pieces,
        choice: None,
    })
}

/// The splitting of an expression in its space, whose arena becomes the model's.
fn searched(model: &mut Model, space: &mut Space, h: Node) -> Result<Parts, NoFlow> {
    if is_large(&model.dag, h) {
        return large::parts(model, h);
    }
    let found = search(space, h).map_err(|node| (node, space.limit(node)));
    model.dag = std::mem::take(&mut space.model.dag);
    found.map_err(|(node, limit)| NoFlow::of(model, node, limit))
}

fn search(space: &mut Space, h: Node) -> Result<Parts, Node> {
    let mut refused = None;
    let mut candidates = Vec::new();
    let mut constants = Vec::new();
    if let Some(flow) = any_flow(space, h) {
        return Ok(Parts {
            flows: vec![(h, flow)],
            choice: None,
        });
    }
    for units in units::refinements(space, h) {
        match cover::candidates(space, &units) {
            Ok(found) => candidates.extend(found),
            Err(term) => refused = refused.or(Some(term)),
        }
        constants = units.constant;
    }
    let fewest = candidates.iter().map(Vec::len).min().unwrap_or(0);
    if fewest > PIECES {
        space.meets(Limit::Pieces, h);
        return Err(h);
    }
    candidates.retain(|pieces| pieces.len() <= (fewest + MORE_PIECES).min(PIECES));
    // A number that stands in H is no piece; a sum that is right without it is proven with it. Numbers
    // refute wrong sums, and the chosen one is proven.
    let constant = space.dag().add(&constants);
    let rest = |space: &mut Space, pieces: &[cover::SolvedSum]| {
        let mut terms = summands(space.dag(), h, Rational::ONE);
        for node in pieces.iter().map(|piece| piece.node).chain([constant]) {
            terms.extend(summands(space.dag(), node, Rational::MINUS_ONE));
        }
        space.dag().linear(&Rational::ZERO, &terms)
    };
    candidates.retain(|pieces| {
        let rest = rest(space, pieces);
        !space.is_off(rest)
    });
    let invariants = space.model.invariants();
    // An orbit that ends is an error of the size of H, to which the constant would add.
    let energy = space.dag().sub(h, constant);
    let best = rank::best(space, energy, candidates, &invariants);
    let (chosen, reasons) = best.ok_or(refused.unwrap_or(h))?;
    let rest = rest(space, &chosen);
    let is_proven = |space: &mut Space| space.is_zero(rest).then_some(());
    space.question(h, is_proven).ok_or(h)?;
    let mut flows = Vec::with_capacity(chosen.len());
    for (at, solved) in chosen.into_iter().enumerate() {
        let node = match at {
            0 => space.dag().add(&[solved.node, constant]),
            _ => solved.node,
        };
        flows.push((node, solved.flow));
    }
    Ok(Parts {
        flows,
        choice: Some(reasons),
    })
}

/// The terms of k·h, those of sums in it by themselves, so that terms that stand in other sums cancel.
fn summands(dag: &mut Dag, h: Node, k: Rational) -> Vec<(Rational, Node)> {
    let one = dag.integer(1);
    let mut found = Vec::new();
    let mut left = vec![(k, h)];
    while let Some((k, node)) = left.pop() {
        match dag.kind(node) {
            Kind::Sum(c, terms) => {
                found.push((c.mul(&k), one));
                left.extend(terms.iter().map(|(own, node)| (own.mul(&k), *node)));
            }
            Kind::Product(own, factors)
                if !own.is_one() && matches!(factors.as_slice(), [(_, 1)]) =>
            {
                left.push((own.mul(&k), factors[0].0));
            }
            _ => found.push((k, node)),
        }
    }
    found
}

/// The splitting that the author declared: names with their parts of H, in his order.
///
/// # Errors
/// The number of the first part without a flow, with the first term of it that no form takes.
pub fn declared(
    model: &mut Model,
    parts: &[(String, Node)],
) -> Result<Decomposition, (usize, NoFlow)> {
    let mut pieces = Vec::with_capacity(parts.len());
    for (at, (name, h)) in parts.iter().enumerate() {
        let flow = match flow_of(model, *h) {
            Ok(flow) => flow,
            Err(limit) => {
                let node = blamed(model, *h);
                return Err((at, NoFlow::of(model, node, limit)));
            }
        };
        pieces.push(Piece {
            h: *h,
            name: name.clone(),
            flow,
        });
    }
    Ok(Decomposition {
        pieces,
        choice: None,
    })
}

/// The first term of an expression that has no flow; the whole where each has one.
fn blamed(model: &mut Model, h: Node) -> Node {
    let term = match Space::new(model, &[h]) {
        Ok(mut space) => {
            let refinements = units::refinements(&mut space, h);
            let mut refused = refinements
                .iter()
                .map(|units| cover::candidates(&mut space, units).err());
            let term = refused.find_map(|term| term);
            model.dag = space.model.dag;
            term
        }
        Err(_) => sweep::find(model, h).err().map(|(term, _)| term),
    };
    term.unwrap_or(h)
}

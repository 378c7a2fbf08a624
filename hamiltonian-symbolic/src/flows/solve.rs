//! The exact flow of an expression, or none: the forms, functions of an expression that has one,
//! several pairs, and sums of commuting parts.
//!
//! Input: h and the time s it acts for. Output: [`NamedMotion`]. Invariant: each step is proven: the
//! expression that a form takes has its pattern, parts of a sum commute, and s is constant along the flow.

pub(crate) mod forms;
pub(crate) mod growth;
pub(crate) mod units;

use crate::dag::{Kind, Map, Node, StandIn};
use crate::flows::limits::{COMMUTING, Limit, PARTS};
use crate::flows::space::{Space, Variables};
use crate::model::{EXPONENTIAL, Motion, NamedMotion};
use crate::rational::Rational;
use crate::sort::Arrange;
use forms::{Axes, FORMS, Moved, Solve, is_constant_form};

/// The flow of h for the time s; `None` where no form takes it, or where the budget of one question is spent.
pub(crate) fn flow(space: &mut Space, h: Node, s: Node) -> Option<NamedMotion> {
    known(space, h, s).unwrap_or_else(|| {
        let found = space.question(h, |space| sought(space, h, s));
        space.flows.insert((h, s), found.clone());
        found
    })
}

/// The flow of a part of the h in question, within its budget.
pub(crate) fn part(space: &mut Space, h: Node, s: Node) -> Option<NamedMotion> {
    known(space, h, s).unwrap_or_else(|| {
        let found = sought(space, h, s);
        // As a question of its own it may have a flow all the same.
        if !space.is_spent() {
            space.flows.insert((h, s), found.clone());
        }
        found
    })
}

/// The flow of h that takes no search, or the result of an earlier one.
fn known(space: &mut Space, h: Node, s: Node) -> Option<Option<NamedMotion>> {
    match space.active(h).is_empty() {
        true => Some(Some(constant_rates(space, h, s))),
        false => space.flows.get(&(h, s)).cloned(),
    }
}

fn sought(space: &mut Space, h: Node, s: Node) -> Option<NamedMotion> {
    whole(space, h, s)
        .or_else(|| function(space, h, s))
        .or_else(|| bare(space, h, s))
        .or_else(|| separated(space, h, s))
        .or_else(|| commuting(space, h, s))
}

/// The rates of a quadratic form, whose matrix is exponentiated when a run is prepared: of a whole
/// piece only, over a point of few components.
pub(crate) fn exponential(space: &mut Space, h: Node) -> Option<NamedMotion> {
    if !space.has_exponentials {
        return None;
    }
    space.question(h, |space| is_constant_form(space, h).then_some(()))?;
    let c = space.dag().coefficient();
    let rates = constant_rates(space, h, c);
    Some(rates.noted(&[EXPONENTIAL]))
}

/// The flow of an h in which no conjugate pair meets: everything moves at a constant rate.
pub(crate) fn constant_rates(space: &mut Space, h: Node, s: Node) -> NamedMotion {
    let mut motion = Motion::default();
    for one in space.set(h).members() {
        let variable = space.variable(one);
        let slope = space.derivative(h, variable);
        let value = space.dag().mul(&[s, slope]);
        space.push(&mut motion, one, value);
    }
    NamedMotion {
        motion,
        forms: Vec::new(),
    }
}

/// The forms that take all of h.
fn whole(space: &mut Space, h: Node, s: Node) -> Option<NamedMotion> {
    FORMS.iter().find_map(|form| match form.solve {
        Solve::Whole(solve) => solve(space, h, s).map(|motion| NamedMotion::of(motion, form.name)),
        Solve::Bare(_) | Solve::Pair(_) | Solve::Exponential => None,
    })
}

/// The forms that take all of h where it is no function of something smaller.
fn bare(space: &mut Space, h: Node, s: Node) -> Option<NamedMotion> {
    FORMS.iter().find_map(|form| match form.solve {
        Solve::Bare(solve) => solve(space, h, s).map(|motion| NamedMotion::of(motion, form.name)),
        Solve::Whole(_) | Solve::Pair(_) | Solve::Exponential => None,
    })
}

/// h = G(u, c) of one expression u in which all pairs meet: u's flow for the time s·∂G/∂u.
fn function(space: &mut Space, h: Node, s: Node) -> Option<NamedMotion> {
    let active = space.active(h);
    let u = dominator(space, h, Variables::of_pairs(&active))?;
    let rate = space.by_node(h, u);
    let time = space.dag().mul(&[s, rate]);
    let inner = whole(space, u, time)
        .or_else(|| bare(space, u, time))
        .or_else(|| separated(space, u, time))
        .or_else(|| commuting(space, u, time))?;
    // The factor beside u is a constant of the motion only where u's flow leaves it alone.
    let beside = variables_outside(space, h, u);
    if space.moved(&inner.motion).meets(beside) {
        return None;
    }
    let mut motion = Motion::default();
    for one in beside.members() {
        let variable = space.variable(one);
        let all = space.d(h, variable);
        let through = space.d(u, variable);
        let through = space.dag().mul(&[rate, through]);
        let own = match space.dag().is_zero(through) {
            true => all,
            false => partial(space, h, u, variable),
        };
        let value = space.dag().mul(&[s, own]);
        space.push(&mut motion, one, value);
    }
    let forms = inner.forms.clone();
    // A kick beside must not change the variables of u.
    if space.moved(&motion).meets(space.set(u)) {
        return None;
    }
    let motion = inner.motion.then(space.dag(), &motion);
    Some(NamedMotion { motion, forms })
}

/// ∂h/∂v with u held.
fn partial(space: &mut Space, h: Node, u: Node, variable: Node) -> Node {
    let place = space.dag().stand_in(StandIn::Held);
    let over = space
        .dag()
        .substitute(h, |_, node| (node == u).then_some(place));
    let slope = space.d(over, variable);
    space
        .dag()
        .substitute(slope, |_, node| (node == place).then_some(u))
}

/// The variables of h outside u.
fn variables_outside(space: &mut Space, h: Node, u: Node) -> Variables {
    let mut set = Variables::default();
    let mut seen: Map<Node, ()> = Map::default();
    let mut left = vec![h];
    while let Some(node) = left.pop() {
        let own = space.set(node);
        if node == u || own.is_within(set) || seen.insert(node, ()).is_some() {
            continue;
        }
        let dag = space.dag();
        let before = left.len();
        dag.for_children(node, |child| left.push(child));
        if left.len() == before {
            set |= own;
        }
    }
    set
}

/// The deepest node, other than h, through which h depends on all of some variables.
fn dominator(space: &mut Space, h: Node, set: Variables) -> Option<Node> {
    let nodes = space.model.dag.reachable(&[h]);
    for node in nodes {
        let is_condition = matches!(
            space.model.dag.kind(node),
            Kind::Compare(..) | Kind::Not(_) | Kind::And(..) | Kind::Or(..)
        );
        if node == h || is_condition || !set.is_within(space.set(node)) {
            continue;
        }
        let over = variables_outside(space, h, node);
        if !over.meets(set) {
            return Some(node);
        }
    }
    None
}

/// h = G(K₁, …, K_m, c), K_i a function of one pair that meets: each pair moves for its own time s·∂G/∂K_i.
fn separated(space: &mut Space, h: Node, s: Node) -> Option<NamedMotion> {
    let active = space.active(h);
    let own = Variables::of_pairs(&active);
    let mut flow = NamedMotion::default();
    for pair in active {
        let found = flow_of_pair(space, h, pair, s)?;
        flow.motion.moves.extend(found.motion.moves);
        flow.motion.domain.extend(found.motion.domain);
        flow = flow.noted(&found.forms);
    }
    for one in space.set(h).without(own).members() {
        let variable = space.variable(one);
        let slope = space.d(h, variable);
        let value = space.dag().mul(&[s, slope]);
        space.push(&mut flow.motion, one, value);
    }
    Some(flow)
}

/// The motion of one pair under h, all other variables held.
fn flow_of_pair(space: &mut Space, h: Node, pair: usize, s: Node) -> Option<NamedMotion> {
    let own = Variables::of_pairs(&[pair]);
    let u = dominator(space, h, own).unwrap_or(h);
    let outer = space.by_node(h, u);
    let (k, rate) = factor_of_pair(space, u, own)?;
    let time = space.dag().mul(&[s, outer, rate]);
    if let Some(known) = space.pair_flows.get(&(k, time)) {
        return known.clone();
    }
    let found = form_of(space, k, space.pairs[pair], time);
    if !space.is_spent() {
        space.pair_flows.insert((k, time), found.clone());
    }
    found
}

/// The first form that takes K of one pair.
fn form_of(space: &mut Space, k: Node, (q, p): (Node, Node), time: Node) -> Option<NamedMotion> {
    for form in FORMS {
        match form.solve {
            Solve::Pair(solve) => {
                for axes in Axes::both_ways(q, p) {
                    if let Some(moved) = solve(space, axes, k, time) {
                        return Some(NamedMotion::of(of_pair(space, axes, &moved), form.name));
                    }
                }
            }
            Solve::Exponential => {}
            Solve::Whole(solve) | Solve::Bare(solve) => {
                if let Some(motion) = solve(space, k, time) {
                    return Some(NamedMotion::of(motion, form.name));
                }
            }
        }
    }
    None
}

fn of_pair(space: &mut Space, axes: Axes, moved: &Moved) -> Motion {
    let mut motion = Motion::default();
    motion.set(axes.x, moved.x);
    let y = axes.signed(space, moved.y);
    motion.set(axes.leaf(), y);
    for &positive in &moved.domain {
        motion.asks(space.dag(), positive);
    }
    motion
}

/// u = rate·K + rest with K of one pair alone, rate and rest free of it.
fn factor_of_pair(space: &mut Space, u: Node, own: Variables) -> Option<(Node, Node)> {
    if space.set(u).is_within(own) {
        return Some((u, space.dag().integer(1)));
    }
    let (k, rate) = match space.model.dag.kind(u).clone() {
        Kind::Product(c, factors) => {
            let (mut inside, mut outside) = (Vec::new(), Vec::new());
            for factor in factors {
                let list = match space.set(factor.0).meets(own) {
                    true => &mut inside,
                    false => &mut outside,
                };
                list.push(factor);
            }
            let dag = space.dag();
            (
                dag.product(&Rational::ONE, &inside),
                dag.product(&c, &outside),
            )
        }
        // A constant, and terms that rest, move nothing of the pair.
        Kind::Sum(_, mut terms) => {
            terms.retain(|(_, term)| space.set(*term).meets(own));
            let k = space.dag().linear(&Rational::ZERO, &terms);
            (k, space.dag().integer(1))
        }
        _ => (u, space.dag().integer(1)),
    };
    if space.set(k).is_within(own) {
        return Some((k, rate));
    }
    // Other variables inside: held at numbers, if u is a multiple of the result.
    let others = space.set(k).without(own);
    let mut rise = |x: f64, y: f64| {
        let [from, to] = [0.0, x].map(|x| {
            let point = space.point_off(&[(own, x), (others, y)]);
            space.value_at(k, &point)
        });
        to - from
    };
    let (left, right) = (
        rise(1.0, 0.0) * rise(2.0, 1.0),
        rise(2.0, 0.0) * rise(1.0, 1.0),
    );
    if left.differs(right) {
        return None;
    }
    let held = space.section(k, others);
    let one = (own & space.set(held)).members().next()?;
    let variable = space.variable(one);
    let (a, b) = (space.d(k, variable), space.d(held, variable));
    let ratio = space.dag().div(a, b);
    let inner = space.section(ratio, own);
    let multiple = space.dag().mul(&[inner, held]);
    let rest = space.dag().sub(k, multiple);
    let section = space.section(rest, own);
    if !space.same(rest, section) {
        return None;
    }
    Some((held, space.dag().mul(&[rate, inner])))
}

/// A sum of parts that have flows and commute: one flow after the other.
fn commuting(space: &mut Space, h: Node, s: Node) -> Option<NamedMotion> {
    let mut terms = terms(space, h);
    // Parts grow term by term, those of few pairs first.
    terms.arrange_by_key(|term| space.set(*term).pairs().len());
    if terms.len() > COMMUTING {
        space.meets(Limit::Commuting, h);
    }
    if !(2..=COMMUTING).contains(&terms.len()) {
        return None;
    }
    let parts = apart(space, &terms).or_else(|| by_pairs(space, &terms))?;
    if parts.len() > PARTS {
        space.meets(Limit::Parts, h);
        return None;
    }
    let mut all = NamedMotion::default();
    // One composition rounds in another way than another.
    for at in space.in_order(&parts) {
        let next = part(space, parts[at], s)?;
        all = all.noted(&next.forms);
        all.motion = all.motion.then(space.dag(), &next.motion);
    }
    Some(all)
}

/// The terms of a sum, and of sums in it; numbers are left out.
fn terms(space: &mut Space, h: Node) -> Vec<Node> {
    let mut found = Vec::new();
    let mut left = vec![(Rational::ONE, h)];
    while let Some((k, node)) = left.pop() {
        match space.model.dag.kind(node).clone() {
            Kind::Sum(_, terms) => {
                let scaled = terms.into_iter().map(|(c, node)| (c.mul(&k), node));
                left.extend(scaled.rev());
            }
            Kind::Product(c, factors) if matches!(factors.as_slice(), [(_, 1)]) => {
                left.push((c.mul(&k), factors[0].0));
            }
            _ if space.set(node).is_empty() => {}
            _ => found.push(space.dag().scale(&k, node)),
        }
    }
    found
}

/// Parts that commute: terms that do not belong together.
fn apart(space: &mut Space, terms: &[Node]) -> Option<Vec<Node>> {
    let mut parts: Vec<Node> = Vec::new();
    for &term in terms {
        let mut joined = Vec::new();
        let mut others = Vec::new();
        for part in parts {
            match space.commute(part, term) {
                true => others.push(part),
                false => joined.push(part),
            }
        }
        joined.push(term);
        others.push(space.dag().add(&joined));
        parts = others;
    }
    if parts.len() < 2 {
        return None;
    }
    for (at, &a) in parts.iter().enumerate() {
        for &b in &parts[at + 1..] {
            if !space.commute(a, b) {
                return None;
            }
        }
    }
    Some(parts)
}

/// Two parts that commute: terms in one pair each, and terms that join pairs.
fn by_pairs(space: &mut Space, terms: &[Node]) -> Option<Vec<Node>> {
    let (mut single, mut joining) = (Vec::new(), Vec::new());
    for &term in terms {
        match space.set(term).pairs().len() {
            0 | 1 => single.push(term),
            _ => joining.push(term),
        }
    }
    if single.is_empty() || joining.is_empty() {
        return None;
    }
    let (single, joining) = (space.dag().add(&single), space.dag().add(&joining));
    space
        .commute(single, joining)
        .then(|| vec![single, joining])
}

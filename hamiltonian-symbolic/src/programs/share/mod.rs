//! Sharing parts of products and of sums, reciprocals, and grouping by binding time.
//!
//! Input: roots with common factors taken out. Output: the same functions where every product is
//! `±` a list of factors of which the first may be one prepared coefficient, at most one single
//! division is left in each, and pairs of factors (or of terms) that several products (or sums)
//! have in common are nodes of their own. Invariant: nothing here passes through the rules of
//! `simplify`, which would flatten it again.

mod products;
mod sums;

use crate::dag::{Dag, Kind, Map, Node, Numbers, Stage};
use crate::list::IntoList;
use crate::product::{Factors, Product};
use crate::programs::factor::{count_uses, is_known};
use crate::rational::Rational;
use products::{FactorPool, Item, Made, known_root, share_products};
use sums::{
    TermPair, TermPairs, Terms, gathered, known_multiple, known_start, raw_sum, share_terms,
};

/// Rewrites the expressions the roots stand for as stage `now` computes them. Values known before it
/// stay as they are.
pub fn share(dag: &mut Dag, roots: &mut [Node], now: Stage) {
    let order: Vec<Node> = dag.reachable(roots);
    let uses = count_uses(dag, roots, &order);
    let mut pool = FactorPool::new(now);
    let mut plan = Plan::of(dag, &mut pool, &order, &uses);
    share_products(dag, &mut pool, &mut plan.lists);
    let (pairs, paired) = share_terms(&order, &plan.plain);
    let mut build = Build {
        pool: &pool,
        plan: &plan,
        pairs: &pairs,
        paired,
        made: vec![None; pool.made.len()],
        terms: vec![None; pairs.len()],
    };
    let new = dag.map(order, |dag, node, new| build.image(dag, node, new));
    for root in roots {
        *root = new[root];
    }
}

/// The parts that products and sums are to be made of.
#[derive(Default)]
struct Plan {
    /// Products as lists.
    lists: Vec<Product<Item>>,
    /// The list of each product.
    product_at: Map<Node, usize>,
    /// The list of a term with its coefficient in a sum, by (sum, term).
    absorbed_at: Map<(Node, Node), usize>,
    /// The terms of each sum.
    sums: Map<Node, Terms>,
    /// The terms of each sum that have no coefficient, and whether they are subtracted.
    plain: Map<Node, Vec<(Node, bool)>>,
}

impl Plan {
    fn of(dag: &mut Dag, pool: &mut FactorPool, order: &[Node], uses: &Numbers) -> Plan {
        let mut plan = Plan::default();
        let mut roots: Map<Node, (Node, i32)> = Map::default();
        // Nodes that others than their parents use as they stand.
        let mut whole: Map<Node, ()> = Map::default();
        let order: Vec<Node> = order
            .iter()
            .copied()
            .filter(|node| !is_known(dag, *node, pool.now))
            .into_list();
        for &node in &order {
            match dag.kind(node) {
                Kind::Product(..) => {
                    if let Some(root) = known_root(dag, uses, node) {
                        roots.insert(node, root);
                        whole.insert(root.0, ());
                    }
                }
                Kind::Sum(c, terms) => {
                    let (mut c, mut terms) = (c.clone(), terms.clone());
                    if let Some((length, start)) = known_start(dag, uses, node) {
                        terms.splice(..length, [(Rational::ONE, start)]);
                        c = Rational::ZERO;
                    }
                    for term in &mut terms {
                        if let Some(multiple) = known_multiple(dag, uses, node, term) {
                            whole.insert(multiple.1, ());
                            *term = multiple;
                        }
                    }
                    plan.sums.insert(node, (c, terms));
                }
                _ => {}
            }
        }
        for node in order {
            match dag.kind(node).clone() {
                Kind::Product(k, factors) => {
                    let list = match roots.get(&node) {
                        Some(&(root, n)) => Product::power(Item::Node(root), n),
                        None => pool.grouped(dag, &k, &factors),
                    };
                    plan.product_at.insert(node, plan.lists.len());
                    plan.lists.push(list);
                }
                Kind::Sum(..) => plan.absorb(dag, pool, node, |term| {
                    uses.get(term) == Some(1) && !whole.contains_key(&term)
                }),
                _ => {}
            }
        }
        plan
    }

    /// A coefficient in front of a term goes into the term's own prepared coefficient, if the term
    /// is used here alone.
    fn absorb(
        &mut self,
        dag: &mut Dag,
        pool: &mut FactorPool,
        sum: Node,
        alone: impl Fn(Node) -> bool,
    ) {
        let mut plain = Vec::new();
        for (k, term) in &self.sums[&sum].1 {
            if is_known(dag, *term, pool.now) {
                continue;
            }
            if k.is_unit() {
                plain.push((*term, k.is_negative()));
                continue;
            }
            if let Kind::Product(c, factors) = dag.kind(*term).clone()
                && alone(*term)
                && factors.iter().any(|(n, _)| is_known(dag, *n, pool.now))
            {
                let at = self.product_at[term];
                self.lists[at] = pool.grouped(dag, &c.mul(k), &factors);
                self.absorbed_at.insert((sum, *term), at);
            }
        }
        self.plain.insert(sum, plain);
    }
}

fn sign(negative: bool) -> Rational {
    if negative {
        Rational::MINUS_ONE
    } else {
        Rational::ONE
    }
}

/// The rewritten expressions, children first.
struct Build<'a> {
    pool: &'a FactorPool,
    plan: &'a Plan,
    pairs: &'a [TermPair],
    paired: TermPairs,
    made: Vec<Option<Node>>,
    terms: Vec<Option<Node>>,
}

impl Build<'_> {
    fn image(&mut self, dag: &mut Dag, node: Node, new: &Map<Node, Node>) -> Node {
        if is_known(dag, node, self.pool.now) {
            return node;
        }
        match dag.kind(node).clone() {
            Kind::Product(..) => self.list(dag, self.plan.product_at[&node], new),
            Kind::Sum(..) => self.sum(dag, node, new),
            Kind::Reduce(domain, body) => dag.intern(Kind::Reduce(domain, new[&body])),
            Kind::Call(op, arguments) => {
                let arguments = arguments.iter().map(|n| new[n]).into_list();
                dag.intern(Kind::Call(op, arguments))
            }
            _ => dag.rebuild(node, &|child| new[&child]),
        }
    }

    fn sum(&mut self, dag: &mut Dag, node: Node, new: &Map<Node, Node>) -> Node {
        let (c, terms) = gathered(dag, self.pool.now, self.plan.sums[&node].clone());
        let mut list: Vec<(Rational, Node)> = Vec::with_capacity(terms.len());
        let mut paired = self.paired.take(&node).unwrap_or_default();
        for (k, term) in terms {
            if let Some(&at) = self.plan.absorbed_at.get(&(node, term)) {
                let image = self.list(dag, at, new);
                list.push((Rational::ONE, image));
            } else if let Some(pair) = paired.get_mut(&term) {
                if let Some((at, negative)) = pair.take() {
                    let image = self.pair(dag, at, new);
                    list.push((sign(negative), image));
                }
            } else {
                list.push((k, new.get(&term).copied().unwrap_or(term)));
            }
        }
        raw_sum(dag, c, list)
    }

    fn list(&mut self, dag: &mut Dag, at: usize, new: &Map<Node, Node>) -> Node {
        let list = &self.plan.lists[at];
        let mut factors: Factors = Vec::with_capacity(list.factors.len());
        for &(item, n) in &list.factors {
            let node = self.item(dag, item, new);
            match factors
                .iter_mut()
                .find(|(other, e)| *other == node && e.signum() == n.signum())
            {
                Some(entry) => entry.1 += n,
                None => factors.push((node, n)),
            }
        }
        let (prepared, others): (Vec<_>, Vec<_>) = factors
            .iter()
            .partition(|(node, _)| is_known(dag, *node, self.pool.now));
        if prepared.iter().map(|(_, n)| n.abs()).sum::<i32>() > 1 {
            // The rest of a power of a coefficient is a coefficient.
            let coefficient = dag.product(&Rational::ONE, &prepared);
            factors = [vec![(coefficient, 1)], others].concat();
        }
        match factors.as_slice() {
            [(node, 1)] if list.coefficient.is_one() => *node,
            _ => dag.intern(Kind::Product(list.coefficient.clone(), factors)),
        }
    }

    /// The node of an item, if what it is made of is there.
    fn ready(&self, item: Item, new: &Map<Node, Node>) -> Option<Node> {
        match item {
            // Prepared coefficients are no part of the input.
            Item::Node(node) => Some(new.get(&node).copied().unwrap_or(node)),
            Item::Made(at) => self.made[at as usize],
        }
    }

    fn item(&mut self, dag: &mut Dag, item: Item, new: &Map<Node, Node>) -> Node {
        // Made items name earlier ones only, so a stack of pending ones ends.
        let mut pending = vec![item];
        loop {
            if let Some(node) = self.ready(item, new) {
                return node;
            }
            let top = pending.last().copied().unwrap_or(item);
            let at = match top {
                Item::Made(at) if self.made[at as usize].is_none() => at as usize,
                _ => {
                    pending.pop();
                    continue;
                }
            };
            let factors = match &self.pool.made[at] {
                Made::Number(k) => {
                    self.made[at] = Some(dag.constant(k.clone()));
                    continue;
                }
                Made::Reciprocal(a) => vec![(*a, -1)],
                Made::Pair(a, b) if a == b => vec![(*a, 2)],
                Made::Pair(a, b) => vec![(*a, 1), (*b, 1)],
                Made::Quotient(a, b) => vec![(*a, 1), (*b, -1)],
            };
            let mut nodes = Vec::with_capacity(factors.len());
            for (item, n) in factors {
                match self.ready(item, new) {
                    Some(node) => nodes.push((node, n)),
                    None => pending.push(item),
                }
            }
            if pending.last() == Some(&top) {
                self.made[at] = Some(dag.intern(Kind::Product(Rational::ONE, nodes)));
            }
        }
    }

    fn pair(&mut self, dag: &mut Dag, at: usize, new: &Map<Node, Node>) -> Node {
        if let Some(node) = self.terms[at] {
            return node;
        }
        let pair = self.pairs[at];
        let list = vec![
            (Rational::ONE, new[&pair.first]),
            (sign(pair.opposite), new[&pair.second]),
        ];
        let node = raw_sum(dag, Rational::ZERO, list);
        self.terms[at] = Some(node);
        node
    }
}

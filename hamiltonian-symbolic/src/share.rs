//! Sharing parts of products and of sums, reciprocals, and grouping by binding time.
//!
//! Input: roots with common factors taken out. Output: the same functions where every product is
//! `±` a list of factors of which the first may be one prepared coefficient, at most one single
//! division is left in each, and pairs of factors (or of terms) that several products (or sums)
//! have in common are nodes of their own. Invariant: nothing here passes through the rules of
//! `simplify`, which would flatten it again.

use crate::dag::{Dag, Kind, Map, Node};
use crate::factor::{count_uses, is_prepared};
use crate::op::Op;
use crate::rational::Rational;
use std::collections::BinaryHeap;

/// Longer lists are not searched for pairs: the search is quadratic in the length of a list.
const LONGEST: usize = 96;

/// Something a list is made of: a node of the input, or made here.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
enum Item {
    Node(Node),
    Made(u32),
}

/// What is made here.
#[derive(Clone, Debug)]
enum Made {
    /// The product of two items.
    Pair(Item, Item),
    /// 1/item.
    Reciprocal(Item),
    /// A coefficient: a rational times a prepared node.
    Coefficient(Rational, Option<Node>),
}

/// A product `±Π item^n / Π divisor^n`.
#[derive(Clone, Debug, Default)]
struct Factors {
    negative: bool,
    items: Vec<(Item, u32)>,
    divisors: Vec<(Item, u32)>,
}

impl Factors {
    fn multiply(&mut self, item: Item, n: u32) {
        match self.items.iter_mut().find(|(known, _)| *known == item) {
            Some(entry) => entry.1 += n,
            None => self.items.push((item, n)),
        }
    }
}

#[derive(Default)]
struct Workshop {
    made: Vec<Made>,
    coefficients: Map<(Rational, Option<Node>), Item>,
    reciprocals: Map<Item, Item>,
    pairs: Map<(Item, Item), Item>,
}

impl Workshop {
    fn make(&mut self, made: Made) -> Item {
        self.made.push(made);
        Item::Made(self.made.len() as u32 - 1)
    }
    fn coefficient(&mut self, k: Rational, p: Option<Node>) -> Item {
        if let Some(&item) = self.coefficients.get(&(k.clone(), p)) {
            return item;
        }
        let item = self.make(Made::Coefficient(k.clone(), p));
        self.coefficients.insert((k, p), item);
        item
    }
    fn reciprocal(&mut self, of: Item) -> Item {
        if let Some(&item) = self.reciprocals.get(&of) {
            return item;
        }
        let item = self.make(Made::Reciprocal(of));
        self.reciprocals.insert(of, item);
        item
    }
    fn pair(&mut self, a: Item, b: Item) -> Item {
        if let Some(&item) = self.pairs.get(&(a, b)) {
            return item;
        }
        let item = self.make(Made::Pair(a, b));
        self.pairs.insert((a, b), item);
        item
    }
}

/// Rewrites the expressions the roots stand for.
pub fn share(dag: &mut Dag, roots: &mut [Node]) {
    let order: Vec<Node> = dag.reachable(roots);
    let uses = count_uses(dag, roots, &order);
    let mut shop = Workshop::default();
    let mut products: Map<Node, Factors> = Map::default();
    let mut sums: Map<Node, Vec<(Node, bool)>> = Map::default();
    let mut absorbed: Map<(Node, Node), Factors> = Map::default();

    // A coefficient in front of a term goes into the term's own prepared coefficient.
    for &node in &order {
        if is_prepared(dag, node) {
            continue;
        }
        match dag.kind(node).clone() {
            Kind::Product(k, factors) => {
                let list = grouped(dag, &mut shop, k, &factors);
                products.insert(node, list);
            }
            Kind::Sum(_, terms) => {
                for (k, term) in terms {
                    let unit = k.is_one() || k == Rational::MINUS_ONE;
                    if unit || is_prepared(dag, term) {
                        continue;
                    }
                    if let Kind::Product(c, factors) = dag.kind(term).clone() {
                        if uses[&term] == 1 && factors.iter().any(|(n, _)| is_prepared(dag, *n)) {
                            let list = grouped(dag, &mut shop, c.mul(&k), &factors);
                            products.remove(&term);
                            absorbed.insert((node, term), list);
                        }
                    }
                }
                let Kind::Sum(_, terms) = dag.kind(node) else {
                    continue;
                };
                let plain = terms.iter().filter(|(k, n)| {
                    (k.is_one() || *k == Rational::MINUS_ONE)
                        && !absorbed.contains_key(&(node, *n))
                        && !is_prepared(dag, *n)
                });
                sums.insert(node, plain.map(|(k, n)| (*n, k.is_negative())).collect());
            }
            _ => {}
        }
    }

    let mut lists: Vec<Factors> = Vec::new();
    let mut product_at: Map<Node, usize> = Map::default();
    let mut absorbed_at: Map<(Node, Node), usize> = Map::default();
    for &node in &order {
        if let Some(list) = products.remove(&node) {
            product_at.insert(node, lists.len());
            lists.push(list);
        }
        if let Kind::Sum(_, terms) = dag.kind(node) {
            for (_, term) in terms {
                if let Some(list) = absorbed.remove(&(node, *term)) {
                    absorbed_at.insert((node, *term), lists.len());
                    lists.push(list);
                }
            }
        }
    }
    share_reciprocals(dag, &mut shop, &mut lists);
    share_invariant_factors(dag, &mut shop, &mut lists);
    share_pairs(&mut shop, &mut lists);
    let mut sum_pairs: Vec<(Node, bool, Node, bool)> = Vec::new();
    let sum_lists = share_terms(&order, &sums, &mut sum_pairs);

    // Rebuild, children first.
    let mut build = Build {
        shop: &shop,
        new: Map::default(),
        made: vec![None; shop.made.len()],
        terms: vec![None; sum_pairs.len()],
        sum_pairs: &sum_pairs,
    };
    for &node in &order {
        let image = if is_prepared(dag, node) {
            node
        } else if let Some(&at) = product_at.get(&node) {
            build.product(dag, &lists[at])
        } else if let Kind::Sum(c, terms) = dag.kind(node).clone() {
            let (c, terms) = gathered(dag, c, terms);
            let mut list: Vec<(Rational, Node)> = Vec::with_capacity(terms.len());
            let mut shared = sum_lists.get(&node).cloned().unwrap_or_default();
            for (k, term) in terms {
                if let Some(&at) = absorbed_at.get(&(node, term)) {
                    let image = build.product(dag, &lists[at]);
                    list.push((Rational::ONE, image));
                } else if let Some(pair) = shared.get_mut(&term) {
                    if let Some((at, negative)) = pair.take() {
                        let image = build.term(dag, at);
                        list.push((
                            if negative {
                                Rational::MINUS_ONE
                            } else {
                                Rational::ONE
                            },
                            image,
                        ));
                    }
                } else {
                    list.push((k, build.new.get(&term).copied().unwrap_or(term)));
                }
            }
            raw_sum(dag, c, list)
        } else if let Kind::Reduce(domain, body) = dag.kind(node).clone() {
            dag.intern(Kind::Reduce(domain, build.new[&body]))
        } else if let Kind::Call(op, arguments) = dag.kind(node).clone() {
            let arguments = arguments.iter().map(|n| build.new[n]).collect();
            dag.intern(Kind::Call(op, arguments))
        } else {
            let new = &build.new;
            dag.rebuild(node, &|child| new[&child])
        };
        build.new.insert(node, image);
    }
    for root in roots {
        *root = build.new[root];
    }
}

/// A sum as it stands, negated products merged into signs.
fn raw_sum(dag: &mut Dag, c: Rational, list: Vec<(Rational, Node)>) -> Node {
    let mut terms: Vec<(Rational, Node)> = Vec::with_capacity(list.len());
    for (mut k, mut node) in list {
        if let Kind::Product(sign, factors) = dag.kind(node).clone() {
            if sign == Rational::MINUS_ONE {
                k = k.neg();
                node = if let [(single, 1)] = factors.as_slice() {
                    *single
                } else {
                    dag.intern(Kind::Product(Rational::ONE, factors))
                };
            }
        }
        match terms.iter_mut().find(|(_, n)| *n == node) {
            Some(entry) => entry.0 = entry.0.add(&k),
            None => terms.push((k, node)),
        }
    }
    terms.retain(|(k, _)| !k.is_zero());
    if let ([(k, node)], true) = (terms.as_slice(), c.is_zero()) {
        let (k, node) = (k.clone(), *node);
        return dag.scale(&k, node);
    }
    if terms.is_empty() {
        return dag.constant(c);
    }
    dag.intern(Kind::Sum(c, terms))
}

/// The prepared terms of a sum, its constant among them, as one prepared term where they first
/// stand.
fn gathered(
    dag: &mut Dag,
    c: Rational,
    terms: Vec<(Rational, Node)>,
) -> (Rational, Vec<(Rational, Node)>) {
    let prepared: Vec<_> = terms
        .iter()
        .filter(|(_, n)| is_prepared(dag, *n))
        .cloned()
        .collect();
    let Some(place) = terms.iter().position(|(_, n)| is_prepared(dag, *n)) else {
        return (c, terms);
    };
    if prepared.len() == 1
        && c.is_zero()
        && (prepared[0].0.is_one() || prepared[0].0 == Rational::MINUS_ONE)
    {
        return (c, terms);
    }
    let sum = dag.linear(&c, &prepared);
    let mut rest: Vec<_> = terms
        .iter()
        .filter(|(_, n)| !is_prepared(dag, *n))
        .cloned()
        .collect();
    rest.insert(place.min(rest.len()), (Rational::ONE, sum));
    (Rational::ZERO, rest)
}

/// A product's prepared factors and rational as one coefficient, its sign apart, negative powers
/// as divisors.
fn grouped(dag: &mut Dag, shop: &mut Workshop, k: Rational, factors: &[(Node, i32)]) -> Factors {
    let (prepared, rest): (Vec<_>, Vec<_>) =
        factors.iter().partition(|(n, _)| is_prepared(dag, *n));
    let mut list = Factors {
        negative: k.is_negative(),
        ..Factors::default()
    };
    let k = k.abs();
    if !prepared.is_empty() {
        let p = dag.product(&k, &prepared);
        list.items
            .push((shop.coefficient(Rational::ONE, Some(p)), 1));
    } else if !k.is_one() {
        list.items.push((shop.coefficient(k, None), 1));
    }
    for (node, n) in rest {
        let item = (Item::Node(node), n.unsigned_abs());
        if n > 0 {
            list.items.push(item)
        } else {
            list.divisors.push(item)
        }
    }
    list
}

/// Divisors used more than once, or in a deeper loop than their own, become one reciprocal. Powers of √x and of x share one division
/// where x ≥ 0 is known; where only (√x)⁻³ is needed the reciprocal is of x·√x.
fn share_reciprocals(dag: &Dag, shop: &mut Workshop, lists: &mut [Factors]) {
    let mut occurrences: Map<Item, Vec<u32>> = Map::default();
    for list in lists.iter() {
        for (item, n) in &list.divisors {
            occurrences.entry(*item).or_default().push(*n);
        }
    }
    // What a root was taken of, and the root of a divisor if that is a divisor too.
    let radicand = |item: Item| match item {
        Item::Node(node) => match dag.kind(node) {
            Kind::Call(Op::Sqrt, x) => Some(x[0]),
            _ => None,
        },
        Item::Made(_) => None,
    };
    let divides = |node: Node| occurrences.contains_key(&Item::Node(node));
    let root_of = |item: Item| match item {
        Item::Node(node) if dag.is_nonnegative(node) => dag
            .known(&Kind::Call(Op::Sqrt, vec![node]))
            .filter(|root| divides(*root)),
        _ => None,
    };
    let depth = |item: &Item| match item {
        Item::Node(node) => dag.path(dag.home(*node)).len(),
        Item::Made(_) => 0,
    };
    for list in lists.iter_mut() {
        let all = list.items.iter().chain(&list.divisors);
        let deepest = all.map(|(item, _)| depth(item)).max().unwrap_or(0);
        for (item, n) in std::mem::take(&mut list.divisors) {
            let powers = &occurrences[&item];
            let below = radicand(item);
            let with_square = below.is_some_and(|x| dag.is_nonnegative(x) && divides(x));
            if let Some(x) = below.filter(|x| !divides(*x) && powers.iter().all(|n| *n == 3)) {
                let cube = shop.pair(Item::Node(x).min(item), Item::Node(x).max(item));
                if powers.len() > 1 {
                    list.multiply(shop.reciprocal(cube), 1);
                } else {
                    list.divisors.push((cube, 1));
                }
            } else if let Some(root) = root_of(item) {
                list.multiply(shop.reciprocal(Item::Node(root)), 2 * n);
            } else if powers.len() > 1 || n > 1 || with_square || depth(&item) < deepest {
                list.multiply(shop.reciprocal(item), n);
            } else {
                list.divisors.push((item, n));
            }
        }
    }
}

/// Factors that live in an outer loop are multiplied with each other first.
fn share_invariant_factors(dag: &Dag, shop: &mut Workshop, lists: &mut [Factors]) {
    if dag.loop_count() == 0 {
        return;
    }
    let depths: Vec<usize> = shop.made.iter().map(|m| made_depth(dag, shop, m)).collect();
    let depth = |item: &Item| match item {
        Item::Node(node) => dag.path(dag.home(*node)).len(),
        Item::Made(at) => depths[*at as usize],
    };
    for list in lists.iter_mut() {
        let deepest = list
            .items
            .iter()
            .map(|(item, _)| depth(item))
            .max()
            .unwrap_or(0);
        let mut outer: Vec<(usize, Item, u32)> = list
            .items
            .iter()
            .map(|(i, n)| (depth(i), *i, *n))
            .filter(|(d, ..)| *d < deepest)
            .collect();
        if outer.iter().map(|(.., n)| n).sum::<u32>() < 2 {
            continue;
        }
        outer.sort_by_key(|(d, ..)| *d);
        let mut product: Option<Item> = None;
        for (_, item, n) in outer {
            for _ in 0..n {
                product = Some(product.map_or(item, |p| shop.pair(p, item)));
            }
        }
        list.items.retain(|(i, _)| depth(i) >= deepest);
        if let Some(product) = product {
            list.items.insert(0, (product, 1));
        }
    }
}

fn made_depth(dag: &Dag, shop: &Workshop, made: &Made) -> usize {
    let of = |item: &Item| match item {
        Item::Node(node) => dag.path(dag.home(*node)).len(),
        Item::Made(at) => made_depth(dag, shop, &shop.made[*at as usize]),
    };
    match made {
        Made::Pair(a, b) => of(a).max(of(b)),
        Made::Reciprocal(a) => of(a),
        Made::Coefficient(..) => 0,
    }
}

/// Greedily makes a node of the pair of factors that most products have in common.
fn share_pairs(shop: &mut Workshop, lists: &mut [Factors]) {
    let mut counts: Map<(Item, Item), i64> = Map::default();
    let mut holders: Map<Item, Vec<usize>> = Map::default();
    let mut heap = BinaryHeap::new();
    let tally = |list: &Factors,
                 sign: i64,
                 counts: &mut Map<(Item, Item), i64>,
                 touched: &mut Vec<(Item, Item)>| {
        if list.items.len() > LONGEST {
            return;
        }
        for (i, &(a, m)) in list.items.iter().enumerate() {
            if m > 1 {
                *counts.entry((a, a)).or_default() += sign * i64::from(m / 2);
                touched.push((a, a));
            }
            for &(b, n) in &list.items[i + 1..] {
                let key = (a.min(b), a.max(b));
                *counts.entry(key).or_default() += sign * i64::from(m.min(n));
                touched.push(key);
            }
        }
    };
    let mut touched = Vec::new();
    for (at, list) in lists.iter().enumerate() {
        tally(list, 1, &mut counts, &mut touched);
        for (item, _) in &list.items {
            holders.entry(*item).or_default().push(at);
        }
    }
    let offer = |heap: &mut BinaryHeap<(i64, std::cmp::Reverse<(Item, Item)>)>,
                 counts: &Map<(Item, Item), i64>,
                 touched: &mut Vec<(Item, Item)>| {
        for key in touched.drain(..) {
            let count = counts[&key];
            if count > 1 {
                heap.push((count, std::cmp::Reverse(key)));
            }
        }
    };
    offer(&mut heap, &counts, &mut touched);
    while let Some((count, std::cmp::Reverse((a, b)))) = heap.pop() {
        if counts[&(a, b)] != count {
            continue;
        }
        let pair = shop.pair(a, b);
        for at in holders.get(&a).cloned().unwrap_or_default() {
            let list = &mut lists[at];
            let power = |item: Item| {
                list.items
                    .iter()
                    .find(|(i, _)| *i == item)
                    .map_or(0, |(_, n)| *n)
            };
            let times = if a == b {
                power(a) / 2
            } else {
                power(a).min(power(b))
            };
            if times == 0 || list.items.len() > LONGEST {
                continue;
            }
            tally(list, -1, &mut counts, &mut touched);
            let place = list
                .items
                .iter()
                .position(|(i, _)| *i == a || *i == b)
                .unwrap_or(0);
            for (item, n) in &mut list.items {
                if *item == a {
                    *n -= times * if a == b { 2 } else { 1 };
                } else if *item == b {
                    *n -= times;
                }
            }
            match list.items.iter_mut().find(|(i, _)| *i == pair) {
                Some(entry) => entry.1 += times,
                None => {
                    list.items.insert(place, (pair, times));
                    let held = holders.entry(pair).or_default();
                    if held.last() != Some(&at) {
                        held.push(at);
                    }
                }
            }
            list.items.retain(|(_, n)| *n > 0);
            tally(list, 1, &mut counts, &mut touched);
        }
        offer(&mut heap, &counts, &mut touched);
    }
}

/// For each sum, its terms that stand in a shared pair: the first of the two carries the pair
/// (its number and whether it is subtracted), the second carries nothing.
type TermPairs = Map<Node, Map<Node, Option<(usize, bool)>>>;

/// Pairs of plain terms that several sums have in common, up to a common sign. One round: a pair
/// shared by two sums saves one addition.
fn share_terms(
    order: &[Node],
    sums: &Map<Node, Vec<(Node, bool)>>,
    pairs: &mut Vec<(Node, bool, Node, bool)>,
) -> TermPairs {
    let mut counts: Map<(Node, Node, bool), Vec<Node>> = Map::default();
    let mut keys = Vec::new();
    for node in order {
        let Some(terms) = sums.get(node) else {
            continue;
        };
        if terms.len() < 2 || terms.len() > LONGEST {
            continue;
        }
        for (i, &(a, sa)) in terms.iter().enumerate() {
            for &(b, sb) in &terms[i + 1..] {
                let key = (a.min(b), a.max(b), sa != sb);
                let list = counts.entry(key).or_default();
                if list.is_empty() {
                    keys.push(key);
                }
                list.push(*node);
            }
        }
    }
    keys.retain(|key| counts[key].len() > 1);
    keys.sort_by_key(|key| std::cmp::Reverse(counts[key].len()));
    let mut result: TermPairs = Map::default();
    for key in keys {
        let (a, b, opposite) = key;
        let free: Vec<Node> = counts[&key]
            .iter()
            .copied()
            .filter(|sum| {
                result
                    .get(sum)
                    .is_none_or(|taken| !taken.contains_key(&a) && !taken.contains_key(&b))
            })
            .collect();
        if free.len() < 2 {
            continue;
        }
        // The pair is written as it stands in the first sum, led by its positive term.
        let sign_of = |sum: &Node, node: Node| {
            sums[sum]
                .iter()
                .find(|(n, _)| *n == node)
                .is_some_and(|(_, s)| *s)
        };
        let a_first = !opposite || !sign_of(&free[0], a);
        let (x, y) = if a_first { (a, b) } else { (b, a) };
        pairs.push((x, false, y, opposite));
        for sum in free {
            let negative = sign_of(&sum, x);
            let taken = result.entry(sum).or_default();
            let first = sums[&sum]
                .iter()
                .find(|(n, _)| *n == a || *n == b)
                .map_or(a, |(n, _)| *n);
            taken.insert(first, Some((pairs.len() - 1, negative)));
            taken.insert(if first == a { b } else { a }, None);
        }
    }
    result
}

struct Build<'a> {
    shop: &'a Workshop,
    new: Map<Node, Node>,
    made: Vec<Option<Node>>,
    terms: Vec<Option<Node>>,
    sum_pairs: &'a [(Node, bool, Node, bool)],
}

impl Build<'_> {
    fn item(&mut self, dag: &mut Dag, item: Item) -> Node {
        // Made items name earlier ones only, so a stack of pending ones ends.
        let mut pending = vec![item];
        while let Some(&top) = pending.last() {
            let ready = |build: &Self, item: Item| match item {
                Item::Node(node) => Some(build.new.get(&node).copied().unwrap_or(node)),
                Item::Made(at) => build.made[at as usize],
            };
            let Item::Made(at) = top else {
                pending.pop();
                continue;
            };
            if self.made[at as usize].is_some() {
                pending.pop();
                continue;
            }
            let node = match self.shop.made[at as usize].clone() {
                Made::Coefficient(k, p) => Some(match p {
                    Some(p) => p,
                    None => dag.constant(k),
                }),
                Made::Reciprocal(of) => match ready(self, of) {
                    Some(of) => Some(dag.intern(Kind::Product(Rational::ONE, vec![(of, -1)]))),
                    None => {
                        pending.push(of);
                        None
                    }
                },
                Made::Pair(a, b) => match (ready(self, a), ready(self, b)) {
                    (Some(a), Some(b)) if a == b => {
                        Some(dag.intern(Kind::Product(Rational::ONE, vec![(a, 2)])))
                    }
                    (Some(a), Some(b)) => {
                        Some(dag.intern(Kind::Product(Rational::ONE, vec![(a, 1), (b, 1)])))
                    }
                    (None, _) => {
                        pending.push(a);
                        None
                    }
                    (_, None) => {
                        pending.push(b);
                        None
                    }
                },
            };
            if let Some(node) = node {
                self.made[at as usize] = Some(node);
                pending.pop();
            }
        }
        match item {
            Item::Node(node) => self.new.get(&node).copied().unwrap_or(node),
            Item::Made(at) => self.made[at as usize].unwrap_or(Node(0)),
        }
    }

    fn product(&mut self, dag: &mut Dag, list: &Factors) -> Node {
        let mut factors: Vec<(Node, i32)> =
            Vec::with_capacity(list.items.len() + list.divisors.len());
        let all = list
            .items
            .iter()
            .map(|(i, n)| (*i, *n as i32))
            .chain(list.divisors.iter().map(|(i, n)| (*i, -(*n as i32))));
        for (item, n) in all {
            let node = self.item(dag, item);
            match factors
                .iter_mut()
                .find(|(other, e)| *other == node && e.signum() == n.signum())
            {
                Some(entry) => entry.1 += n,
                None => factors.push((node, n)),
            }
        }
        let sign = if list.negative {
            Rational::MINUS_ONE
        } else {
            Rational::ONE
        };
        match factors.as_slice() {
            [(node, 1)] if !list.negative => *node,
            _ => dag.intern(Kind::Product(sign, factors)),
        }
    }

    fn term(&mut self, dag: &mut Dag, at: usize) -> Node {
        if let Some(node) = self.terms[at] {
            return node;
        }
        let (a, sa, b, sb) = self.sum_pairs[at];
        let sign = |negative: bool| {
            if negative {
                Rational::MINUS_ONE
            } else {
                Rational::ONE
            }
        };
        let list = vec![(sign(sa), self.new[&a]), (sign(sb), self.new[&b])];
        let node = raw_sum(dag, Rational::ZERO, list);
        self.terms[at] = Some(node);
        node
    }
}

//! Products as lists of powers, and what several of them have in common.
//!
//! Input: products of the arena. Output: products over [`Item`]s with the coefficient ±1, where
//! numbers, shared powers, pairs, quotients and reciprocals are items of their own. Invariant: every
//! list stands for the product it was made from; a made item names earlier items only.

use crate::dag::{Dag, Kind, Map, Node, Numbers, Stage};
use crate::list::IntoList;
use crate::op::Op;
use crate::product::Product;
use crate::programs::factor::is_known;
use crate::rational::Rational;
use crate::sort::Arrange;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Longer lists are not searched for pairs: the search is quadratic in the length of a list.
pub(super) const LONGEST: usize = 96;

/// Something a list is made of: a node of the input, or made here.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub(super) enum Item {
    Node(Node),
    Made(u32),
}

/// An item that is made here.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) enum Made {
    /// The product of two items.
    Pair(Item, Item),
    /// The quotient of two items.
    Quotient(Item, Item),
    /// 1/item.
    Reciprocal(Item),
    /// A number.
    Number(Rational),
}

/// Everything made, each with the depth of the loop it is computed in.
pub(super) struct FactorPool {
    /// The stage in which products are computed. Values known before it are coefficients.
    pub(super) now: Stage,
    pub(super) made: Vec<Made>,
    depths: Vec<usize>,
    known: Map<Made, Item>,
}

impl FactorPool {
    pub(super) fn new(now: Stage) -> FactorPool {
        FactorPool {
            now,
            made: Vec::new(),
            depths: Vec::new(),
            known: Map::default(),
        }
    }
    fn make(&mut self, dag: &Dag, made: Made) -> Item {
        if let Some(&item) = self.known.get(&made) {
            return item;
        }
        let depth = match &made {
            Made::Pair(a, b) | Made::Quotient(a, b) => self.depth(dag, *a).max(self.depth(dag, *b)),
            Made::Reciprocal(a) => self.depth(dag, *a),
            Made::Number(_) => 0,
        };
        let item = Item::Made(self.made.len() as u32);
        self.made.push(made.clone());
        self.depths.push(depth);
        self.known.insert(made, item);
        item
    }
    fn depth(&self, dag: &Dag, item: Item) -> usize {
        match item {
            Item::Node(node) => dag.depth(dag.home(node)),
            Item::Made(at) => self.depths[at as usize],
        }
    }

    /// A product's prepared factors and rational as one coefficient, its sign apart. Of a power
    /// of a product, the coefficient stays inside: c²x² is (c·x)², which may share c·x.
    pub(super) fn grouped(
        &mut self,
        dag: &mut Dag,
        k: &Rational,
        factors: &[(Node, i32)],
    ) -> Product<Item> {
        let common = if k.is_one() { common_power(factors) } else { 1 };
        let roots = factors.iter().map(|(node, n)| (*node, n / common));
        let (prepared, rest): (Vec<_>, Vec<_>) =
            roots.partition(|(n, _)| is_known(dag, *n, self.now));
        let mut list = Product::new(k.sign(), Vec::with_capacity(rest.len() + 1));
        let k = k.abs();
        if !prepared.is_empty() {
            let p = dag.product(&k, &prepared);
            list.factors.push((Item::Node(p), common));
        } else if !k.is_one() {
            let number = self.make(dag, Made::Number(k));
            list.factors.push((number, 1));
        }
        let powers = rest
            .into_iter()
            .map(|(node, n)| (Item::Node(node), n * common));
        list.factors.extend(powers);
        list
    }
}

/// The largest number that divides all exponents.
fn common_power(factors: &[(Node, i32)]) -> i32 {
    fn gcd(a: u32, b: u32) -> u32 {
        if b == 0 { a } else { gcd(b, a % b) }
    }
    factors.iter().fold(0, |g, (_, n)| gcd(g, n.unsigned_abs())) as i32
}

/// The product of which a product is a power, if that is computed before: (2xy)² from 2xy.
pub(super) fn known_root(dag: &Dag, uses: &Numbers, product: Node) -> Option<(Node, i32)> {
    let Kind::Product(k, factors) = dag.kind(product) else {
        return None;
    };
    let common = common_power(factors);
    (2..=common).filter(|d| common % d == 0).find_map(|d| {
        let root = match d {
            _ if k.is_one() => Rational::ONE,
            2 => k.sqrt()?,
            _ => return None,
        };
        let mut parts = factors.iter().map(|(f, n)| (*f, n / d)).into_list();
        parts.arrange();
        let root = dag.known(&Kind::Product(root, parts))?;
        (root < product && uses.has(root)).then_some((root, d))
    })
}

/// Makes items of what the lists have in common.
pub(super) fn share_products(dag: &Dag, pool: &mut FactorPool, lists: &mut [Product<Item>]) {
    merge_roots(dag, pool, lists);
    merge_companions(dag, pool, lists);
    // A reciprocal rounds once more; it pays where divisions are done again and again.
    if pool.now > Stage::Parameters {
        share_reciprocals(dag, pool, lists);
    }
    share_invariant_factors(dag, pool, lists);
    share_pairs(dag, pool, lists);
}

/// The places of each divisor and its powers there, in order of first appearance.
fn divisors(lists: &[Product<Item>]) -> Vec<(Item, Vec<(usize, i32)>)> {
    let mut all: Vec<(Item, Vec<(usize, i32)>)> = Vec::new();
    let mut place: Map<Item, usize> = Map::default();
    for (at, list) in lists.iter().enumerate() {
        for (item, n) in list.divisors() {
            let entry = *place.entry(item).or_insert_with(|| {
                all.push((item, Vec::new()));
                all.len() - 1
            });
            all[entry].1.push((at, n));
        }
    }
    all
}

/// Divisions by √x and by x ≥ 0 are divisions by powers of √x; where only (√x)⁻³ is needed the
/// divisor is x·√x.
fn merge_roots(dag: &Dag, pool: &mut FactorPool, lists: &mut [Product<Item>]) {
    let mut all = divisors(lists);
    let places: Map<Item, usize> = all.iter().enumerate().map(|(at, d)| (d.0, at)).collect();
    for at in 0..all.len() {
        let Item::Node(node) = all[at].0 else {
            continue;
        };
        let Kind::Call(Op::Sqrt, x) = dag.kind(node) else {
            continue;
        };
        let (root, x) = (Item::Node(node), x[0]);
        if let Some(&whole) = places.get(&Item::Node(x)) {
            if dag.is_nonnegative(x) {
                for &(list, n) in &all[whole].1 {
                    lists[list].replace(Item::Node(x), root, 2 * n);
                }
            }
        } else if all[at].1.iter().all(|(_, n)| *n == -3) {
            let x = Item::Node(x);
            let cube = pool.make(dag, Made::Pair(x.min(root), x.max(root)));
            for (list, _) in std::mem::take(&mut all[at].1) {
                lists[list].replace(root, cube, -1);
            }
        }
    }
}

/// Divisors that several products have together, and only together, are one divisor.
fn merge_companions(dag: &Dag, pool: &mut FactorPool, lists: &mut [Product<Item>]) {
    let mut first: Map<Vec<(usize, i32)>, Item> = Map::default();
    for (item, places) in divisors(lists) {
        if places.len() < 2 {
            continue;
        }
        let Some(&companion) = first.get(&places) else {
            first.insert(places, item);
            continue;
        };
        let both = pool.make(dag, Made::Pair(companion, item));
        for &(list, n) in &places {
            lists[list].factors.retain(|(i, _)| *i != item);
            lists[list].replace(companion, both, n);
        }
        first.insert(places, both);
    }
}

/// A divisor becomes a reciprocal where that leaves at least two products without a division, or
/// where it lives in an outer loop.
fn share_reciprocals(dag: &Dag, pool: &mut FactorPool, lists: &mut [Product<Item>]) {
    let all = divisors(lists);
    let mut inverted: Map<Item, bool> = Map::default();
    for (item, places) in &all {
        let depth = pool.depth(dag, *item);
        let outside = places.iter().any(|(list, _)| {
            let factors = &lists[*list].factors;
            factors.iter().any(|(i, _)| pool.depth(dag, *i) > depth)
        });
        inverted.insert(*item, outside || places.len() > 1);
        if outside {
            for (list, n) in places {
                let reciprocal = pool.make(dag, Made::Reciprocal(*item));
                lists[*list].replace(*item, reciprocal, -n);
            }
        }
    }
    // The number of divisors of a list that would remain.
    let remaining = |list: &Product<Item>, inverted: &Map<Item, bool>| {
        let kept = list.divisors().filter(|(item, _)| !inverted[item]);
        kept.count()
    };
    let mut kept: Vec<usize> = lists.iter().map(|l| remaining(l, &inverted)).into_list();
    let mut changed = true;
    while std::mem::take(&mut changed) {
        for (item, places) in &all {
            let freed = places.iter().filter(|(list, _)| kept[*list] == 0).count();
            if inverted[item] && freed < 2 {
                inverted.insert(*item, false);
                places.iter().for_each(|(list, _)| kept[*list] += 1);
                changed = true;
            }
        }
    }
    for (item, places) in &all {
        if inverted[item] {
            let reciprocal = pool.make(dag, Made::Reciprocal(*item));
            for (list, n) in places {
                lists[*list].replace(*item, reciprocal, -n);
            }
        }
    }
}

/// Products that live in an outer loop are multiplied with each other first.
fn share_invariant_factors(dag: &Dag, pool: &mut FactorPool, lists: &mut [Product<Item>]) {
    if dag.loop_count() == 0 {
        return;
    }
    for list in lists.iter_mut() {
        let depths: Vec<usize> = list
            .factors
            .iter()
            .map(|(i, _)| pool.depth(dag, *i))
            .into_list();
        let deepest = depths.iter().copied().max().unwrap_or(0);
        let outside = |at: usize, n: i32| n > 0 && depths[at] < deepest;
        let mut outer: Vec<(usize, Item, i32)> = Vec::new();
        let mut inner = Vec::new();
        for (at, &(item, n)) in list.factors.iter().enumerate() {
            if outside(at, n) {
                outer.push((depths[at], item, n));
            } else {
                inner.push((item, n));
            }
        }
        if outer.iter().map(|(.., n)| n).sum::<i32>() < 2 {
            continue;
        }
        outer.arrange_by_key(|(depth, ..)| *depth);
        let mut product: Option<Item> = None;
        for (_, item, n) in outer {
            for _ in 0..n {
                product = Some(match product {
                    Some(p) => pool.make(dag, Made::Pair(p, item)),
                    None => item,
                });
            }
        }
        list.factors = inner;
        if let Some(product) = product {
            list.multiply_at(0, product, 1);
        }
    }
}

/// Two items to be multiplied, or the first to be divided by the second.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
struct Couple(Item, Item, bool);

impl Couple {
    fn of((a, m): (Item, i32), (b, n): (Item, i32)) -> Couple {
        match (m > 0, n > 0) {
            (true, false) => Couple(a, b, true),
            (false, true) => Couple(b, a, true),
            _ => Couple(a.min(b), a.max(b), false),
        }
    }
    /// The number of times the couple stands in a product, negative below the line.
    fn times(self, list: &Product<Item>) -> i32 {
        let Couple(a, b, divided) = self;
        let (m, n) = (list.exponent(a), list.exponent(b));
        if a == b {
            m / 2
        } else if divided {
            m.min(-n).max(0)
        } else if m.signum() == n.signum() {
            m.signum() * m.abs().min(n.abs())
        } else {
            0
        }
    }
    fn made(self) -> Made {
        if self.2 {
            Made::Quotient(self.0, self.1)
        } else {
            Made::Pair(self.0, self.1)
        }
    }
}

/// The number of times each couple occurs, and the couples whose number changed.
#[derive(Default)]
struct Counts {
    counts: Map<Couple, i64>,
    touched: Vec<Couple>,
}

impl Counts {
    /// Counts the couples of a list in which an item is one of those asked for.
    fn tally(&mut self, list: &Product<Item>, sign: i64, is_asked: impl Fn(Item, i32) -> bool) {
        if list.factors.len() > LONGEST {
            return;
        }
        for (i, &(a, m)) in list.factors.iter().enumerate() {
            if !is_asked(a, m) {
                continue;
            }
            if m.abs() > 1 {
                self.add(Couple(a, a, false), sign * i64::from(m.abs() / 2));
            }
            for (j, &(b, n)) in list.factors.iter().enumerate() {
                // Two that are asked for are one couple.
                if j > i || j < i && !is_asked(b, n) {
                    let times = i64::from(m.abs().min(n.abs()));
                    self.add(Couple::of((a, m), (b, n)), sign * times);
                }
            }
        }
    }
    fn add(&mut self, couple: Couple, count: i64) {
        *self.counts.entry(couple).or_default() += count;
        self.touched.push(couple);
    }
    fn offer(&mut self, heap: &mut BinaryHeap<(i64, Reverse<Couple>)>) {
        self.touched.arrange();
        self.touched.dedup();
        for couple in self.touched.drain(..) {
            let count = self.counts[&couple];
            if count > 1 {
                heap.push((count, Reverse(couple)));
            }
        }
    }
}

/// Greedily makes an item of the couple that most products have in common.
fn share_pairs(dag: &Dag, pool: &mut FactorPool, lists: &mut [Product<Item>]) {
    let mut counts = Counts::default();
    let mut holders: Map<Item, Vec<usize>> = Map::default();
    for (at, list) in lists.iter().enumerate() {
        counts.tally(list, 1, |_, _| true);
        for (item, _) in &list.factors {
            holders.entry(*item).or_default().push(at);
        }
    }
    let mut heap = BinaryHeap::new();
    counts.offer(&mut heap);
    while let Some((count, Reverse(couple))) = heap.pop() {
        if counts.counts[&couple] != count {
            continue;
        }
        let among: Vec<usize> = holders[&couple.0]
            .iter()
            .copied()
            .filter(|at| lists[*at].factors.len() <= LONGEST && couple.times(&lists[*at]) != 0)
            .into_list();
        // A quotient costs a division; it must spare one.
        let last_division = |at: &usize| {
            let list = &lists[*at];
            list.divisors().count() == 1 && -list.exponent(couple.1) == couple.times(list)
        };
        if couple.2 && !among.iter().any(last_division) {
            continue;
        }
        let made = pool.make(dag, couple.made());
        // The whole list decides if a quotient spares a division.
        let changes = |item: Item, n: i32| n < 0 || [couple.0, couple.1, made].contains(&item);
        for at in among {
            let list = &mut lists[at];
            let times = couple.times(list);
            if times == 0 {
                continue;
            }
            counts.tally(list, -1, changes);
            let place = list
                .factors
                .iter()
                .position(|(i, _)| *i == couple.0 || *i == couple.1);
            for (item, n) in &mut list.factors {
                if *item == couple.0 {
                    *n -= times;
                }
                if *item == couple.1 {
                    *n -= if couple.2 { -times } else { times };
                }
            }
            if list.exponent(made) == 0 {
                let held = holders.entry(made).or_default();
                if held.last() != Some(&at) {
                    held.push(at);
                }
            }
            list.multiply_at(place.expect("it has the couple"), made, times);
            list.factors.retain(|(_, n)| *n != 0);
            counts.tally(list, 1, changes);
        }
        counts.offer(&mut heap);
    }
}

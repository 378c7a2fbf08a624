//! The constructors of expressions and the rules they apply.
//!
//! Input: nodes. Output: nodes in canonical form. Invariant: directional rules only: no rule adds
//! an operation, none introduces cancellation, and the domain changes only by `0·x = 0`,
//! `x/x = 1`, `√(x²) = |x|`. Half-integer powers are integer powers of a square root, so that
//! `√x·√x` keeps the domain of `√x`.

mod conditions;
mod leaves;

use crate::dag::{Dag, Kind, Map, Node, Partial};
use crate::list::IntoList;
use crate::op::{Op, Parity};
use crate::product::{Factors, Product};
use crate::rational::{LONGEST, Rational};
use crate::sort::Arrange;

/// The largest exponent of a factor. Past it a power of a power stays one, so that repeated squaring
/// grows by a node a level, and a literal exponent is left to `pow`.
const LARGEST_POWER: i32 = 1024;
/// The longest product that is taken apart where it is a factor of another.
pub(crate) const SHORT: usize = 8;

impl Dag {
    /// The value of a constant node.
    #[must_use]
    pub fn as_constant(&self, node: Node) -> Option<&Rational> {
        match self.kind(node) {
            Kind::Constant(value) => Some(value),
            _ => None,
        }
    }
    /// Returns true if the node is the number 0.
    #[must_use]
    pub fn is_zero(&self, node: Node) -> bool {
        self.as_constant(node).is_some_and(Rational::is_zero)
    }
    /// Returns true if the node is the number 1.
    #[must_use]
    pub fn is_one(&self, node: Node) -> bool {
        self.as_constant(node).is_some_and(Rational::is_one)
    }

    /// The rational factor of a node and the rest: `−2·x·y` is −2 and `x·y`.
    pub fn split_coefficient(&mut self, node: Node) -> (Rational, Node) {
        match self.kind(node) {
            Kind::Constant(value) => {
                let value = value.clone();
                (value, self.integer(1))
            }
            Kind::Product(k, factors) if !k.is_one() => {
                let (k, factors) = (k.clone(), factors.clone());
                let rest = self.bare_product(Rational::ONE, factors);
                (k, rest)
            }
            _ => (Rational::ONE, node),
        }
    }

    fn bare_product(&mut self, k: Rational, factors: Factors) -> Node {
        match factors.as_slice() {
            [] => self.constant(k),
            [(node, 1)] if k.is_one() => *node,
            _ if k.is_zero() => self.integer(0),
            _ => self.intern(Kind::Product(k, factors)),
        }
    }

    /// The sum of nodes.
    pub fn add(&mut self, nodes: &[Node]) -> Node {
        let terms = nodes.iter().map(|n| (Rational::ONE, *n)).into_list();
        self.linear(&Rational::ZERO, &terms)
    }
    /// The sum, a rational factor that all terms have in common up to sign put in front, where it
    /// can meet another: ½(a + b)·2x is (a + b)·x.
    pub(crate) fn add_with_content(&mut self, nodes: &[Node]) -> Node {
        let sum = self.add(nodes);
        let Kind::Sum(c, terms) = self.kind(sum) else {
            return sum;
        };
        let content = terms[0].0.abs();
        if content.is_one()
            || !(c.is_zero() || c.abs() == content)
            || terms.iter().any(|(k, _)| k.abs() != content)
        {
            return sum;
        }
        let constant = c.sign();
        let terms = terms.iter().map(|(k, n)| (k.sign(), *n)).into_list();
        let sum = self.collected(&constant, &terms, false);
        self.scale(&content, sum)
    }
    /// The difference.
    pub fn sub(&mut self, a: Node, b: Node) -> Node {
        self.linear(
            &Rational::ZERO,
            &[(Rational::ONE, a), (Rational::MINUS_ONE, b)],
        )
    }
    /// The negative.
    pub fn neg(&mut self, node: Node) -> Node {
        self.scale(&Rational::MINUS_ONE, node)
    }
    /// A rational multiple.
    pub fn scale(&mut self, k: &Rational, node: Node) -> Node {
        if k.is_one() {
            return node;
        }
        match self.kind(node) {
            Kind::Constant(value) => {
                let value = value.mul(k);
                self.constant(value)
            }
            Kind::Product(c, factors) if !self.is_sealed(node) => {
                let (c, factors) = (c.mul(k), factors.clone());
                self.bare_product(c, factors)
            }
            _ => self.bare_product(k.clone(), vec![(node, 1)]),
        }
    }

    /// `constant + Σ k·node`. A first operand that is itself a sum is continued (`a + b + c` is
    /// one sum); a later one stays a unit, because taking it apart could introduce cancellation.
    pub fn linear(&mut self, constant: &Rational, operands: &[(Rational, Node)]) -> Node {
        self.collected(constant, operands, true)
    }

    /// [`Dag::linear`], where a first operand that is a sum is continued only if asked.
    pub(crate) fn collected(
        &mut self,
        constant: &Rational,
        operands: &[(Rational, Node)],
        continued: bool,
    ) -> Node {
        let mut constant = constant.clone();
        let mut terms: Vec<(Rational, Node)> = Vec::with_capacity(operands.len());
        let mut places = Places::default();
        let mut push =
            |terms: &mut Vec<(Rational, Node)>, k: Rational, node: Node| match places.of(node) {
                Some(at) => terms[at].0 = terms[at].0.add(&k),
                None => terms.push((k, node)),
            };
        for (at, (k, node)) in operands.iter().enumerate() {
            if k.is_zero() {
                continue;
            }
            let (c, node) = self.split_coefficient(*node);
            let k = k.mul(&c);
            match self.kind(node) {
                Kind::Constant(value) => constant = constant.add(&k.mul(value)),
                Kind::Sum(c, inner) if continued && at == 0 && k.is_one() => {
                    constant = constant.add(c);
                    for (k, node) in inner.clone() {
                        push(&mut terms, k, node);
                    }
                }
                _ => push(&mut terms, k, node),
            }
        }
        terms.retain(|(k, _)| !k.is_zero());
        match terms.as_slice() {
            [] => self.constant(constant),
            [(k, node)] if constant.is_zero() => {
                let (k, node) = (k.clone(), *node);
                self.scale(&k, node)
            }
            _ => {
                // The negative of a known sum is that sum negated, so that a−b and b−a share.
                let mut negated = terms.iter().map(|(k, n)| (k.neg(), *n)).into_list();
                negated.arrange_by_key(|(_, n)| *n);
                match self.known(&Kind::Sum(constant.neg(), negated)) {
                    Some(known) => self.neg(known),
                    None => self.intern(Kind::Sum(constant, terms)),
                }
            }
        }
    }

    /// The product of nodes.
    pub fn mul(&mut self, nodes: &[Node]) -> Node {
        let factors = nodes.iter().map(|n| (*n, 1)).into_list();
        self.product(&Rational::ONE, &factors)
    }
    /// The quotient.
    pub fn div(&mut self, a: Node, b: Node) -> Node {
        self.product(&Rational::ONE, &[(a, 1), (b, -1)])
    }
    /// An integer power.
    pub fn powi(&mut self, node: Node, exponent: i32) -> Node {
        self.product(&Rational::ONE, &[(node, exponent)])
    }

    /// `k·Π node^n`.
    pub fn product(&mut self, k: &Rational, operands: &[(Node, i32)]) -> Node {
        let mut k = k.clone();
        let mut factors = ProductBuilder::default();
        for &(node, n) in operands {
            match self.kind(node).clone() {
                Kind::Constant(value) => match multiplied(&k, &value, n) {
                    Some(product) => k = product,
                    // 0 to a negative power is left to run time, a long number until the end, as a power of
                    // a number of at least 1.
                    None => match value.recip().filter(|_| value.abs() < Rational::ONE) {
                        Some(inverse) => {
                            let inverse = self.constant(inverse);
                            factors.multiply(self, inverse, -n);
                        }
                        None => factors.multiply(self, node, n),
                    },
                },
                Kind::Product(c, inner) if self.is_taken_apart(node, &inner, n) => {
                    match multiplied(&k, &c, n) {
                        Some(product) => k = product,
                        None => {
                            let c = self.constant(c);
                            factors.multiply(self, c, n);
                        }
                    }
                    for (node, m) in inner {
                        factors.multiply(self, node, m * n);
                    }
                }
                _ => factors.multiply(self, node, n),
            }
        }
        if k.is_zero() {
            return self.integer(0);
        }
        let mut product = Product::new(k, factors.list);
        let k = &mut product.coefficient;
        product.factors.retain(|(node, n)| {
            let value = self.as_constant(*node);
            match value.and_then(|value| multiplied(k, value, *n)) {
                Some(product) => *k = product,
                None => return true,
            }
            false
        });
        self.collect_roots(&mut product);
        self.collect_exponentials(&mut product);
        let product = product.simplified();
        self.bare_product(product.coefficient, product.factors)
    }

    /// Returns true if the n-th power of a product is the product of its factors' powers.
    fn is_taken_apart(&self, product: Node, factors: &[(Node, i32)], n: i32) -> bool {
        let is_small = |(_, m): &(Node, i32)| {
            m.checked_mul(n).is_some_and(|power| {
                n.unsigned_abs() == 1 || power.unsigned_abs() <= LARGEST_POWER as u32
            })
        };
        !self.is_sealed(product)
            && (factors.len() <= SHORT || n != 1)
            && factors.iter().all(is_small)
    }

    /// Powers of √x with x ≥ 0 known: x·√x is (√x)³, and an even power of √x is a power of x;
    /// |x| to an even power is x to that power.
    fn collect_roots(&self, product: &mut Product) {
        for at in 0..product.factors.len() {
            let (node, n) = product.factors[at];
            let Kind::Call(op, arguments) = self.kind(node) else {
                continue;
            };
            let inner = arguments[0];
            if *op == Op::Abs && n % 2 == 0 {
                product.factors[at].1 = 0;
                product.multiply(inner, n);
            } else if *op == Op::Sqrt && self.is_nonnegative(inner) {
                let whole = product.exponent(inner);
                product.multiply(inner, -whole);
                let total = n + 2 * whole;
                if total % 2 != 0 {
                    product.factors[at].1 = total;
                    continue;
                }
                product.factors[at].1 = 0;
                match self.kind(inner) {
                    // Only a bare product of powers may be taken apart without a constant.
                    Kind::Product(c, parts) if c.is_one() => {
                        for (part, m) in parts {
                            product.multiply(*part, m * (total / 2));
                        }
                    }
                    _ => product.multiply(inner, total / 2),
                }
            }
        }
    }

    /// Exponentials of numbers as one: each may be outside the range of `f64` though the product is not.
    fn collect_exponentials(&mut self, product: &mut Product) {
        let mut terms = Vec::new();
        for &(node, n) in &product.factors {
            if n != 0
                && let Some(exponent) = self.exponent_of_number(node)
            {
                terms.push((Rational::integer(i64::from(n)), exponent, node));
            }
        }
        if terms.len() < 2 {
            return;
        }
        let sum: Vec<_> = terms
            .iter()
            .map(|(n, exponent, _)| (n.clone(), *exponent))
            .into_list();
        let sum = self.linear(&Rational::ZERO, &sum);
        let all = self.call(Op::Exp, &[sum]);
        product
            .factors
            .retain(|(node, _)| terms.iter().all(|(_, _, other)| other != node));
        match self.as_constant(all) {
            Some(value) => product.coefficient = product.coefficient.mul(value),
            None => product.multiply(all, 1),
        }
    }

    /// x of exp(x) if x is made of numbers alone.
    fn exponent_of_number(&self, node: Node) -> Option<Node> {
        match self.kind(node) {
            Kind::Call(Op::Exp, x) if self.is_number(x[0]) => Some(x[0]),
            _ => None,
        }
    }

    /// ln or √ of a number that may be outside the range of `f64`.
    fn of_far_number(&mut self, op: Op, x: Node) -> Option<Node> {
        if let Some(exponent) = self.exponent_of_number(x) {
            return Some(match op {
                Op::Ln => exponent,
                _ => {
                    let half = self.scale(&Rational::new(1, 2), exponent);
                    self.call(Op::Exp, &[half])
                }
            });
        }
        let value = self
            .as_constant(x)
            .filter(|k| k.leaves_f64() && !k.is_negative())?;
        // value = part·2^2n
        let (part, n) = value.in_powers_of_four()?;
        let part = self.constant(part);
        let near = self.call(op, &[part]);
        let two = self.integer(2);
        Some(match op {
            Op::Ln => {
                let log = self.call(Op::Ln, &[two]);
                let k = Rational::integer(2 * i64::from(n));
                self.linear(&Rational::ZERO, &[(Rational::ONE, near), (k, log)])
            }
            _ => self.product(&Rational::ONE, &[(near, 1), (two, n)]),
        })
    }

    /// `a·b` as a product that none takes apart: long products are trees of such.
    pub(crate) fn seal(&mut self, a: Node, b: Node) -> Node {
        if a == b || self.as_constant(a).is_some() || self.as_constant(b).is_some() {
            return self.mul(&[a, b]);
        }
        let product = self.intern(Kind::Product(Rational::ONE, vec![(a, 1), (b, 1)]));
        self.close(product);
        product
    }

    /// `x^y`. Integer exponents are products, half-integer ones powers of the square root, thirds
    /// powers of the cube root where x ≥ 0 is known; otherwise the function `pow`, which at x < 0 has
    /// a value where y is an integer.
    pub fn pow(&mut self, x: Node, y: Node) -> Node {
        if self.is_one(x) {
            return x;
        }
        if let Some((n, d)) = self.as_constant(y).and_then(Rational::to_small)
            && let Some(n) = i32::try_from(n).ok()
            && (n.unsigned_abs() <= LARGEST_POWER as u32 || (d == 1 && self.is_number(x)))
        {
            match d {
                1 => return self.powi(x, n),
                2 => {
                    let root = self.call(Op::Sqrt, &[x]);
                    return self.powi(root, n);
                }
                3 if self.is_nonnegative(x) => {
                    let root = self.call(Op::Cbrt, &[x]);
                    return self.powi(root, n);
                }
                // (x²)^y is |x|^2y, whose derivative has a value at 0 from y = ½ on.
                _ => {
                    if let Some(root) = self.exact_root(x) {
                        let twice = self.scale(&Rational::integer(2), y);
                        return self.pow(root, twice);
                    }
                }
            }
        }
        // A whole number past 2⁵³ need not be an `f64`, whose neighbours are even.
        if let Some(exponent) = self.as_constant(y)
            && exponent.is_integer()
            && exponent.abs() > Rational::integer(1 << 53)
            && !self.is_nonnegative(x)
        {
            let is_odd = exponent.is_odd();
            let size = self.call(Op::Abs, &[x]);
            if !is_odd {
                return self.pow(size, y);
            }
            let minus = self.integer(-1);
            let less = self.add(&[y, minus]);
            let power = self.pow(size, less);
            return self.mul(&[x, power]);
        }
        self.intern(Kind::Call(Op::Pow, vec![x, y]))
    }

    /// An elementary function.
    pub fn call(&mut self, op: Op, arguments: &[Node]) -> Node {
        let x = arguments[0];
        match op {
            Op::Pow => return self.pow(x, arguments[1]),
            Op::Min | Op::Max if x == arguments[1] => return x,
            Op::Ln if self.is_one(x) => return self.integer(0),
            Op::Abs if self.is_nonnegative(x) => return x,
            Op::Sqrt | Op::Ln => {
                let root = (op == Op::Sqrt).then(|| self.exact_root(x)).flatten();
                if let Some(value) = root.or_else(|| self.of_far_number(op, x)) {
                    return value;
                }
            }
            _ => {}
        }
        if arguments.len() == 1 {
            if self.is_zero(x)
                && let Some(value) = op.at_zero()
            {
                return self.constant(value);
            }
            if let Some(value) = self.exact_value(op, x) {
                return value;
            }
            let parity = op.row().parity;
            if parity != Parity::None && self.is_negated(x) {
                let flipped = self.neg(x);
                let value = self.call(op, &[flipped]);
                return if parity == Parity::Odd {
                    self.neg(value)
                } else {
                    value
                };
            }
            if let Some(value) = self.as_constant(x) {
                let value = match op {
                    Op::Abs => Some(value.abs()),
                    // Negative numbers are above.
                    Op::Sign => Some(Rational::ONE),
                    Op::Floor => Some(value.floor()),
                    Op::Round => Some(value.round()),
                    _ => None,
                };
                if let Some(value) = value {
                    return self.constant(value);
                }
            }
        }
        if let (Op::Modulo | Op::Remainder, &[x, y]) = (op, arguments)
            && let (Some(x), Some(y)) = (self.as_constant(x), self.as_constant(y))
            && let Some(turns) = y.abs().recip().map(|per| x.mul(&per))
        {
            let multiple = match op {
                Op::Modulo => turns.floor(),
                _ => turns.round(),
            };
            let value = x.sub(&multiple.mul(&y.abs()));
            return self.constant(value);
        }
        self.intern(Kind::Call(op, arguments.to_vec()))
    }

    fn is_negated(&self, node: Node) -> bool {
        match self.kind(node) {
            Kind::Constant(value) => value.is_negative(),
            Kind::Product(k, _) => k.is_negative(),
            _ => false,
        }
    }

    /// The root of a perfect square: of a rational, or of a product of even powers.
    fn exact_root(&mut self, x: Node) -> Option<Node> {
        match self.kind(x) {
            Kind::Constant(value) => {
                let root = value.sqrt()?;
                Some(self.constant(root))
            }
            Kind::Product(k, factors) if factors.iter().all(|(_, n)| n % 2 == 0) => {
                let (root, factors) = (k.sqrt()?, factors.clone());
                let mut halves = Vec::with_capacity(factors.len());
                for (node, n) in factors {
                    let half = n / 2;
                    let base = if half % 2 == 0 {
                        node
                    } else {
                        self.call(Op::Abs, &[node])
                    };
                    halves.push((base, half));
                }
                Some(self.product(&root, &halves))
            }
            _ => None,
        }
    }

    /// `1 + x²` (sign 1) or `1 − x²` (sign −1); the latter as (1 − x)(1 + x) would cost one more
    /// operation, and the square's rounding matters only where the derivative is unbounded.
    pub(crate) fn one_plus_square(&mut self, x: Node, sign: i64) -> Node {
        let square = self.powi(x, 2);
        self.linear(&Rational::ONE, &[(Rational::integer(sign), square)])
    }
    /// `Σ x²`.
    pub fn sum_of_squares(&mut self, nodes: &[Node]) -> Node {
        let squares: Vec<_> = nodes
            .iter()
            .map(|n| (Rational::ONE, self.powi(*n, 2)))
            .into_list();
        self.linear(&Rational::ZERO, &squares)
    }

    /// A function written in Rust, or a derivative of it.
    pub fn external(&mut self, function: u16, part: Partial, arguments: &[Node]) -> Node {
        self.intern(Kind::External(function, part, arguments.to_vec()))
    }
}

/// `k·value^n` where it is a number of moderate length.
fn multiplied(k: &Rational, value: &Rational, n: i32) -> Option<Rational> {
    let power = value.pow(n)?;
    let is_long = !k.is_unit() && !power.is_unit() && k.bits() + power.bits() > LONGEST;
    (!is_long).then(|| k.mul(&power))
}

/// The factors of a product in the making, each once.
#[derive(Default)]
struct ProductBuilder {
    list: Factors,
    places: Places,
}

impl ProductBuilder {
    fn multiply(&mut self, dag: &mut Dag, node: Node, n: i32) {
        let Some(at) = self.places.of(node) else {
            self.list.push((node, n));
            return;
        };
        let m = self.list[at].1;
        // A long number may still be divided away.
        let most = match dag.is_number(node) {
            true => i32::MAX,
            false => LARGEST_POWER,
        };
        match m
            .checked_add(n)
            .filter(|sum| sum.abs() <= most.max(m.abs()))
        {
            Some(sum) => self.list[at].1 = sum,
            None => {
                let (higher, lower) = if m.abs() < n.abs() { (n, m) } else { (m, n) };
                let power = dag.intern(Kind::Product(Rational::ONE, vec![(node, higher)]));
                self.list[at].1 = lower;
                self.multiply(dag, power, 1);
            }
        }
    }
}

/// The places of nodes in a list without repetition.
#[derive(Default)]
struct Places {
    nodes: Vec<Node>,
    /// The places by node, once there are many: a few are searched faster in order.
    many: Map<Node, usize>,
}

impl Places {
    /// The most nodes that are looked through.
    const FEW: usize = 12;

    /// A node's place, if it is in the list already; else it is the list's next.
    fn of(&mut self, node: Node) -> Option<usize> {
        let nodes: &[Node] = &self.nodes;
        if nodes.len() <= Places::FEW {
            let mut at = 0;
            while at < nodes.len() {
                if nodes[at].0 == node.0 {
                    return Some(at);
                }
                at += 1;
            }
        } else {
            if self.many.is_empty() {
                let places = nodes.iter().enumerate();
                self.many = places.map(|(at, node)| (*node, at)).collect();
            }
            if let Some(&at) = self.many.get(&node) {
                return Some(at);
            }
            self.many.insert(node, nodes.len());
        }
        self.nodes.push(node);
        None
    }
}

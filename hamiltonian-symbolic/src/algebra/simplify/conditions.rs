//! The constructors of conditions and loops.
//!
//! Input: nodes. Output: nodes in canonical form. Invariant: that of the constructors of expressions.

use crate::dag::{Dag, Kind, Node, Relation};
use crate::index::{Affine, Domain, Loops};
use crate::rational::Rational;

impl Dag {
    /// The condition `a < b`.
    pub fn less(&mut self, a: Node, b: Node) -> Node {
        self.intern(Kind::Compare(Relation::Less, a, b))
    }
    /// The condition `a ≤ b`.
    pub fn less_equal(&mut self, a: Node, b: Node) -> Node {
        self.intern(Kind::Compare(Relation::LessEqual, a, b))
    }
    /// The condition `a = b`.
    pub fn equal(&mut self, a: Node, b: Node) -> Node {
        self.intern(Kind::Compare(Relation::Equal, a, b))
    }
    /// The condition `affine ≥ 0`, negative terms on the left: `1 <= k`, `k + 2 <= N`.
    pub(crate) fn at_least_zero(&mut self, affine: &Affine) -> Node {
        let mut above = affine.clone();
        above.constant = above.constant.max(0);
        above.loops.retain(|(_, n)| *n > 0);
        above.sizes.retain(|(_, n)| *n > 0);
        above.products.retain(|(_, n)| *n > 0);
        let below = above.plus(-1, affine);
        let (below, above) = (self.affine(&below), self.affine(&above));
        self.less_equal(below, above)
    }
    /// The condition `not a`.
    pub fn not(&mut self, a: Node) -> Node {
        match self.kind(a) {
            Kind::Not(inner) => *inner,
            _ => self.intern(Kind::Not(a)),
        }
    }
    /// The condition `a and b`.
    pub fn and(&mut self, a: Node, b: Node) -> Node {
        if a == b {
            a
        } else {
            self.intern(Kind::And(a, b))
        }
    }
    /// The condition `a or b`.
    pub fn or(&mut self, a: Node, b: Node) -> Node {
        if a == b {
            a
        } else {
            self.intern(Kind::Or(a, b))
        }
    }
    /// `yes` where the condition holds, `no` elsewhere.
    pub fn select(&mut self, condition: Node, yes: Node, no: Node) -> Node {
        let yes = match *self.kind(yes) {
            Kind::Select(inner, yes, _) if inner == condition => yes,
            _ => yes,
        };
        let no = match *self.kind(no) {
            Kind::Select(inner, _, no) if inner == condition => no,
            _ => no,
        };
        if yes == no {
            return yes;
        }
        match self.kind(condition) {
            Kind::Not(inner) => {
                let inner = *inner;
                return self.select(inner, no, yes);
            }
            Kind::Compare(relation, a, b) => {
                if let (Some(a), Some(b)) = (self.as_constant(*a), self.as_constant(*b)) {
                    let holds = match relation {
                        Relation::Less => a < b,
                        Relation::LessEqual => a <= b,
                        Relation::Equal => a == b,
                    };
                    return if holds { yes } else { no };
                }
            }
            _ => {}
        }
        self.intern(Kind::Select(condition, yes, no))
    }

    /// Σ of `body` over a loop. Factors that do not depend on the loop stand outside; a loop that
    /// does not depend on its parent is moved out of it.
    pub fn reduce(&mut self, domain: Domain, body: Node) -> Node {
        let range = self.range(domain).clone();
        if self.is_zero(body) {
            return body;
        }
        if !self.variables(body).has(domain) {
            let count = self.count(domain);
            return self.mul(&[count, body]);
        }
        if let (Some(start), Some(end)) = (range.start.as_constant(), range.end.as_constant())
            && end <= start
        {
            return self.integer(0);
        }
        if let Kind::Product(k, factors) = self.kind(body) {
            let (k, factors) = (k.clone(), factors.clone());
            let (inside, mut outside): (Vec<_>, Vec<_>) = factors
                .iter()
                .partition(|(n, _)| self.variables(*n).has(domain));
            if !outside.is_empty() || !k.is_one() {
                let inside = self.product(&Rational::ONE, &inside);
                let sum = self.reduce(domain, inside);
                outside.push((sum, 1));
                return self.product(&k, &outside);
            }
        }
        let needs = self.variables(body) | range.start.variables() | range.end.variables();
        let parent = self.deepest(needs.without(Loops::of(domain)));
        if parent != range.parent {
            let moved = self.domain(parent, range.start, range.end);
            let body = self.replace(body, domain, &Affine::variable(moved));
            return self.intern(Kind::Reduce(moved, body));
        }
        self.intern(Kind::Reduce(domain, body))
    }

    /// The number of times a loop runs.
    pub fn count(&mut self, domain: Domain) -> Node {
        let range = self.range(domain).clone();
        if let (Some(start), Some(end)) = (range.start.as_constant(), range.end.as_constant()) {
            return self.integer((end - start).max(0));
        }
        let needs = range.start.variables() | range.end.variables();
        let parent = self.deepest(needs);
        let domain = self.domain(parent, range.start, range.end);
        self.intern(Kind::Count(domain))
    }
}

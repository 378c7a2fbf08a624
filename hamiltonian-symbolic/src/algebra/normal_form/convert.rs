//! From nodes to polynomials and back.
//!
//! Input: nodes of one arena. Output: polynomials over the atoms of an [`Algebra`], and nodes made
//! from them. Invariant: bottom-up over the arena, each node once.

use super::atoms::{Algebra, Key, Scope};
use super::polynomial::{Atom, Monomial, Poly, Sum, Undecided};
use crate::dag::{Dag, Kind, Map, Node, Relation};
use crate::index::Domain;
use crate::list::IntoList;
use crate::op::Op;
use crate::rational::Rational;
use std::rc::Rc;

impl Algebra {
    /// The polynomial of a node.
    pub(crate) fn convert(&mut self, dag: &Dag, root: Node) -> Result<Poly, Undecided> {
        self.has_conditions |= dag.has(&[root], &|kind| match kind {
            Kind::Select(..) => true,
            Kind::Call(Op::Sign, _) => self.scope == Scope::Everywhere,
            _ => false,
        });
        let nodes = dag.reachable(&[root]);
        loop {
            let before = self.redefined;
            for &node in &nodes {
                if !self.converted.contains_key(&node) {
                    let poly = self.convert_one(dag, node)?;
                    self.converted.insert(node, Rc::new(poly));
                }
            }
            if self.redefined == before {
                return Ok(self.converted[&root].as_ref().clone());
            }
            // Arguments of functions were made of angles that are now multiples of smaller ones: the order
            // in which angles are met must not decide.
            self.converted = Map::default();
        }
    }

    fn of(&self, node: Node) -> Rc<Poly> {
        Rc::clone(&self.converted[&node])
    }

    fn all(&self, nodes: &[Node]) -> Vec<Poly> {
        let poly = |node: &Node| self.of(*node).as_ref().clone();
        nodes.iter().map(poly).into_list()
    }

    fn convert_one(&mut self, dag: &Dag, node: Node) -> Result<Poly, Undecided> {
        Ok(match dag.kind(node) {
            Kind::Constant(value) => Poly::constant(value.clone()),
            Kind::Pi
            | Kind::Scalar(_)
            | Kind::Time
            | Kind::Coefficient
            | Kind::Variable(_)
            | Kind::Extent(_)
            | Kind::StandIn(_)
            | Kind::Element(..) => Poly::atom(self.leaf(dag, node), 1),
            Kind::Sum(c, terms) => {
                let mut sum = Sum::default();
                sum.add(&Poly::constant(c.clone()), &Rational::ONE);
                for (k, child) in terms {
                    sum.add(&self.of(*child), k);
                }
                sum.finish(&self.budget)?
            }
            Kind::Product(k, factors) => {
                let mut product = Poly::constant(k.clone());
                for (child, n) in factors {
                    let factor = self.of(*child);
                    let factor = self.pow(&factor, *n)?;
                    product = self.mul(&product, &factor)?;
                }
                product
            }
            Kind::Call(op, arguments) => self.call(*op, &self.all(arguments))?,
            Kind::External(function, part, arguments) => {
                self.external(*function, *part, &self.all(arguments))?
            }
            Kind::Count(domain) => match self.runs.get(domain) {
                Some(runs) => runs.count.clone(),
                None => Poly::atom(self.leaf(dag, node), 1),
            },
            Kind::Reduce(domain, body) => {
                let body = self.of(*body);
                let body = self.canonical(&body)?;
                self.summed(dag, *domain, &body)?
            }
            Kind::Compare(relation, a, b) => {
                let (a, b) = (self.of(*a), self.of(*b));
                let sign = self.sign(&b.sub(&a))?;
                let half = Rational::new(1, 2);
                let square = self.mul(&sign, &sign)?;
                let square = self.canonical(&square)?;
                match relation {
                    // sign = 1
                    Relation::Less => square.add(&sign).scale(&half),
                    // not sign = −1
                    Relation::LessEqual => Poly::integer(1).sub(&square.sub(&sign).scale(&half)),
                    Relation::Equal => Poly::integer(1).sub(&square),
                }
            }
            Kind::Not(a) => Poly::integer(1).sub(&self.of(*a)),
            Kind::And(a, b) => {
                let (a, b) = (self.of(*a), self.of(*b));
                self.mul(&a, &b)?
            }
            Kind::Or(a, b) => {
                let (a, b) = (self.of(*a), self.of(*b));
                let both = self.mul(&a, &b)?;
                a.add(&b).sub(&both)
            }
            Kind::Select(c, yes, no) => {
                let (c, yes, no) = (self.of(*c), self.of(*yes), self.of(*no));
                self.any_guarded |= Algebra::is_divided(&yes) || Algebra::is_divided(&no);
                let difference = yes.sub(&no);
                let chosen = self.mul(&c, &difference)?;
                no.add(&chosen)
            }
        })
    }

    /// The sum of a polynomial over a loop: of each term, with the factors that do not depend on its variable outside.
    pub(super) fn summed(
        &mut self,
        dag: &Dag,
        domain: Domain,
        body: &Poly,
    ) -> Result<Poly, Undecided> {
        let mut sum = Sum::default();
        for (monomial, k) in body.terms() {
            let (inside, outside): (Vec<_>, Vec<_>) = monomial
                .0
                .iter()
                .partition(|(atom, _)| self.entry(*atom).variables.has(domain));
            let inside = Monomial(inside);
            if let Some(total) = self.power_sum(dag, domain, &inside)? {
                sum.add(&total.times(&Monomial(outside)), k);
                continue;
            }
            let looped = self.sum(dag, domain, inside);
            sum.add_term(Monomial(outside).mul(&Monomial::atom(looped, 1)), k.clone());
        }
        sum.finish(&self.budget)
    }

    /// A polynomial as a node.
    pub(crate) fn node(&self, dag: &mut Dag, poly: &Poly) -> Node {
        let atoms = self.nodes_of(dag, poly.atoms());
        assemble(dag, poly, &atoms)
    }

    /// The nodes of atoms and of all atoms they are made of, oldest first.
    fn nodes_of(&self, dag: &mut Dag, wanted: Vec<Atom>) -> Map<Atom, Node> {
        let mut nodes: Map<Atom, Node> = Map::default();
        for atom in self.needed(wanted) {
            let call = |dag: &mut Dag, op: Op, x: &Poly| {
                let x = assemble(dag, x, &nodes);
                dag.call(op, &[x])
            };
            let all = |dag: &mut Dag, polys: &[Poly]| -> Vec<Node> {
                polys.iter().map(|x| assemble(dag, x, &nodes)).into_list()
            };
            let node = match &self.entry(atom).key {
                Key::Leaf(node) => *node,
                Key::Cos(x) => call(dag, Op::Cos, x),
                Key::Sin(x) => call(dag, Op::Sin, x),
                Key::Exp(x) => call(dag, Op::Exp, x),
                Key::Root(2, x) => call(dag, Op::Sqrt, x),
                Key::Root(_, x) => call(dag, Op::Cbrt, x),
                Key::Ln(x) => {
                    let size = call(dag, Op::Abs, x);
                    dag.call(Op::Ln, &[size])
                }
                Key::Sign(x) => call(dag, Op::Sign, x),
                Key::Divisor(x) => assemble(dag, x, &nodes),
                Key::Function(op, arguments) => {
                    let arguments = all(dag, arguments);
                    dag.call(*op, &arguments)
                }
                Key::External(function, part, arguments) => {
                    let arguments = all(dag, arguments);
                    dag.external(*function, *part, &arguments)
                }
                Key::Sum(domain, body) => {
                    let body = assemble(dag, &Poly::term(Rational::ONE, body.clone()), &nodes);
                    dag.reduce(*domain, body)
                }
            };
            nodes.insert(atom, node);
        }
        nodes
    }
}

fn assemble(dag: &mut Dag, poly: &Poly, nodes: &Map<Atom, Node>) -> Node {
    let mut terms = Vec::with_capacity(poly.terms().len());
    for (monomial, k) in poly.terms() {
        let factors: Vec<(Node, i32)> = monomial
            .0
            .iter()
            .map(|(atom, n)| (nodes[atom], *n))
            .into_list();
        terms.push((k.clone(), dag.product(&Rational::ONE, &factors)));
    }
    dag.linear(&Rational::ZERO, &terms)
}

//! Phase space as the search sees it: pairs, derivatives, and the questions whether an expression
//! is zero and which variables it is free of.
//!
//! Input: a model whose H has no loops. Output: [`Space`]. Invariant: answers are proven: an
//! expression is zero where the normal form says so, refuted first by numbers, which are cheaper.
//! Each question ([`Space::question`]) has a budget of its own. Where that is spent, the answer is no, and nothing that
//! was found since is kept.

mod breaks;
mod budget;
mod labels;
pub(crate) mod tape;

use crate::algebra::ball::Ball;
use crate::dag::{Array, Column, Dag, Dependence, Kind, Map, Node, Side, Sign, StandIn};
use crate::diff;
use crate::flows::limits::{COMPONENTS, Limit, PAIRS, POINTS};
use crate::index::Index;
use crate::list::IntoList;
use crate::loops::{Sample, Values, next_random};
use crate::model::{Model, Motion, NamedMotion};
use crate::normal_form::{Answer, Effort, Undecided, answer_within, tidy, witness};
use crate::rational::Rational;
use crate::set::{Member, Set};
use crate::sort::Arrange;
use budget::Questions;
use labels::Labels;
use std::hash::{Hash, Hasher};
use tape::Tape;

/// A variable by its number: 2i is coordinate i, 2i + 1 its momentum.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Variable(pub(crate) usize);

impl Variable {
    /// The variables of a pair.
    pub(crate) fn pair(pair: usize) -> [Variable; 2] {
        [Variable(2 * pair), Variable(2 * pair + 1)]
    }
    pub(crate) fn is_coordinate(self) -> bool {
        self.0.is_multiple_of(2)
    }
    pub(crate) fn conjugate(self) -> Variable {
        Variable(self.0 ^ 1)
    }
}

impl Member for Variable {
    fn number(self) -> u32 {
        self.0 as u32
    }
    fn numbered(number: u32) -> Variable {
        Variable(number as usize)
    }
}

/// A set of variables.
pub(crate) type Variables = Set<Variable>;

impl Variables {
    /// All variables of some pairs.
    pub(crate) fn of_pairs(pairs: &[usize]) -> Variables {
        pairs
            .iter()
            .flat_map(|pair| Variable::pair(*pair))
            .collect()
    }
    /// The number of the one variable in it.
    pub(crate) fn number(self) -> usize {
        self.members().next().map_or(usize::MAX, |one| one.0)
    }
    /// The pairs with a variable in it.
    pub(crate) fn pairs(self) -> Vec<usize> {
        let mut pairs: Vec<usize> = self.members().map(|variable| variable.0 / 2).into_list();
        pairs.dedup();
        pairs
    }
    /// The pairs with both variables in it.
    pub(crate) fn whole_pairs(self) -> Vec<usize> {
        let mut pairs = self.pairs();
        pairs.retain(|pair| Variables::of_pairs(&[*pair]).is_within(self));
        pairs
    }
    /// True if there are coordinates in it, and the same for momenta.
    pub(crate) fn sides(self) -> (bool, bool) {
        let mut all = self.members();
        (
            all.clone().any(Variable::is_coordinate),
            !all.all(Variable::is_coordinate),
        )
    }
}

/// The bits of a point's numbers. A list would be hashed byte by byte.
#[derive(PartialEq, Eq)]
struct PointBits(Vec<u64>);

impl Hash for PointBits {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        for bits in &self.0 {
            hasher.write_u64(*bits);
        }
    }
}

/// Phase space with the known facts of expressions over it.
pub(crate) struct Space {
    /// The model, to whose arena the search adds.
    pub(crate) model: Model,
    /// Coordinates with their momenta, in the order of their labels.
    pub(crate) pairs: Vec<(Node, Node)>,
    /// The labels of leaves.
    labels: Labels,
    /// The values of parameters at points. They follow from the labels, so that a choice by numbers depends on
    /// neither names nor the order of declarations.
    parameters: Map<Node, Ball>,
    /// The variables of every node so far.
    sets: Vec<Variables>,
    derivatives: Map<Node, Map<Node, Node>>,
    zeros: Map<Node, bool>,
    /// Numbers of nodes, by which most comparisons are decided.
    values: [Values; 2],
    /// Numbers of nodes at points, each of which is made once.
    points: Map<PointBits, Values>,
    /// The flows that were sought, by the Hamiltonian and the time it acts for.
    pub(crate) flows: Map<(Node, Node), Option<NamedMotion>>,
    /// The flows of expressions of one pair.
    pub(crate) pair_flows: Map<(Node, Node), Option<NamedMotion>>,
    /// True if a piece may be a matrix exponential: the point has few components, all of them given.
    pub(crate) has_exponentials: bool,
    /// True if the point is given and has too many components for that.
    pub(crate) has_many_components: bool,
    /// The question that is answered, and the limits that were met.
    questions: Questions,
}

impl Space {
    /// The space of the pairs that stand in some expressions.
    ///
    /// # Errors
    /// The limit of pairs; `None` where elements are not given by number.
    pub(crate) fn new(model: &Model, roots: &[Node]) -> Result<Space, Option<Limit>> {
        let mut model = model.clone();
        let mut places: Vec<(u16, u16, i64)> = Vec::new();
        for node in model.dag.reachable(roots) {
            match model.dag.kind(node) {
                Kind::Element(Array::Phase(Column { group, column, .. }), row, None) => {
                    let row = row.as_constant().ok_or(None)?;
                    places.push((*group, *column, row));
                }
                Kind::Reduce(..) | Kind::Count(_) | Kind::Variable(_) => return Err(None),
                _ => {}
            }
        }
        places.arrange_by_key(|(group, column, row)| (*group, *row, *column));
        places.dedup();
        if places.len() > PAIRS {
            return Err(Some(Limit::Pairs));
        }
        let mut pairs = Vec::with_capacity(places.len());
        for (group, column, row) in places {
            let mut leaf = |side| {
                let array = Array::Phase(Column {
                    side,
                    group,
                    column,
                });
                let row = Index::constant(row);
                model.dag.element(array, row, None)
            };
            pairs.push((leaf(Side::Q), leaf(Side::P)));
        }
        let labels = Labels::new(&model.dag, roots, &mut pairs);
        let parameters = labels.parameters(&model.dag).into_iter();
        let parameters = parameters.map(|(leaf, mut label)| {
            // A multiple of 1/64 between 3/4 and 5/4: parameters differ, and none dominates.
            let size = 48 + next_random(&mut label) % 32;
            (leaf, Ball::exact(size as f64 / 64.0))
        });
        let parameters = parameters.collect();
        let components = model.components();
        Ok(Space {
            has_exponentials: components.is_some_and(|count| count <= COMPONENTS),
            has_many_components: components.is_some_and(|count| count > COMPONENTS),
            questions: Questions::new(&model.dag),
            model,
            pairs,
            labels,
            parameters,
            sets: Vec::new(),
            derivatives: Map::default(),
            zeros: Map::default(),
            values: [false, true].map(|signed| {
                Values::new(Sample {
                    seed: u64::from(signed),
                    signed,
                    ..Sample::default()
                })
            }),
            points: Map::default(),
            flows: Map::default(),
            pair_flows: Map::default(),
        })
    }

    /// The arena.
    pub(crate) fn dag(&mut self) -> &mut Dag {
        &mut self.model.dag
    }
    /// The places of expressions in an order that follows from H alone.
    pub(crate) fn in_order(&self, nodes: &[Node]) -> Vec<usize> {
        let labels = self.labels.of(&self.model.dag, nodes);
        let mut places: Vec<usize> = (0..nodes.len()).into_list();
        places.arrange_by_key(|at| labels[*at]);
        places
    }
    /// The label of an expression, whatever constant is added to it.
    pub(crate) fn label(&self, node: Node) -> u64 {
        self.labels.whole(&self.model.dag, node)
    }
    /// The node of a variable.
    pub(crate) fn variable(&self, variable: Variable) -> Node {
        let (q, p) = self.pairs[variable.0 / 2];
        if variable.is_coordinate() { q } else { p }
    }

    /// The variables an expression is written with.
    pub(crate) fn set(&mut self, root: Node) -> Variables {
        // Children have smaller numbers, so that each node is looked up once.
        for number in self.sets.len()..=root.0 as usize {
            let node = Node(number as u32);
            let mut set = Variables::default();
            if let Kind::Element(Array::Phase(_), ..) = self.model.dag.kind(node) {
                let at = |(q, p): &(Node, Node)| *q == node || *p == node;
                if let Some(pair) = self.pairs.iter().position(at) {
                    set |= Set::of(Variable::pair(pair)[usize::from(self.pairs[pair].1 == node)]);
                }
            }
            let sets = &self.sets;
            let dag = &self.model.dag;
            dag.for_children(node, |child| set |= sets[child.0 as usize]);
            self.sets.push(set);
        }
        self.sets[root.0 as usize]
    }
    /// The pairs both of whose variables stand in an expression.
    pub(crate) fn active(&mut self, root: Node) -> Vec<usize> {
        self.set(root).whole_pairs()
    }

    /// The variables that a motion moves.
    pub(crate) fn moved(&mut self, motion: &Motion) -> Variables {
        let none = Variables::default();
        (motion.moves.iter()).fold(none, |set, m| set | self.set(m.leaf))
    }

    /// ∂h/∂v of a variable v. If the budget is spent, a node in its place: no later answer is kept.
    pub(crate) fn d(&mut self, h: Node, variable: Node) -> Node {
        if self.is_spent() {
            return self.model.dag.stand_in(StandIn::Spent);
        }
        self.derivative(h, variable)
    }
    /// ∂h/∂v of a variable v, at any cost; of a sum term by term, as its terms stand in other sums too.
    pub(crate) fn derivative(&mut self, h: Node, variable: Node) -> Node {
        if !self.set(h).meets(self.set(variable)) {
            return self.model.dag.integer(0);
        }
        if let Kind::Sum(_, terms) = self.model.dag.kind(h)
            && terms.len() > 1
        {
            let known = self.derivatives.get(&h);
            if let Some(known) = known.and_then(|known| known.get(&variable)) {
                return *known;
            }
            let mut slopes = terms.clone();
            for (_, term) in &mut slopes {
                *term = self.derivative(*term, variable);
            }
            let slope = self.model.dag.linear(&Rational::ZERO, &slopes);
            self.derivatives
                .entry(h)
                .or_default()
                .insert(variable, slope);
            return slope;
        }
        if !self.derivatives.contains_key(&h) {
            let both = Dependence(Dependence::Q.0 | Dependence::P.0);
            let gradient = diff::gradient(&mut self.model.dag, h, both);
            self.derivatives.insert(h, gradient.into_iter().collect());
        }
        let known = self.derivatives[&h].get(&variable).copied();
        known.unwrap_or_else(|| self.model.dag.integer(0))
    }

    /// ∂h/∂u of a node u that stands in h, all else held.
    pub(crate) fn by_node(&mut self, h: Node, u: Node) -> Node {
        let dag = &mut self.model.dag;
        if h == u {
            return dag.integer(1);
        }
        let place = dag.stand_in(StandIn::Part);
        let over = dag.substitute(h, |_, node| (node == u).then_some(place));
        let slope = diff::gradient(dag, over, Dependence::PARAMETER)
            .into_iter()
            .find(|(leaf, _)| *leaf == place);
        let slope = slope.map_or_else(|| dag.integer(0), |(_, slope)| slope);
        dag.substitute(slope, |_, node| (node == place).then_some(u))
    }

    /// The terms of {a, b}: a sign, and the two derivatives that it stands before.
    fn bracket(&mut self, a: Node, b: Node) -> Vec<(Rational, [Node; 2])> {
        let (in_a, in_b) = (self.set(a), self.set(b));
        let mut terms = Vec::new();
        for pair in 0..self.pairs.len() {
            let (q, p) = self.pairs[pair];
            let [of_q, of_p] = Variable::pair(pair);
            if in_a.has(of_q) && in_b.has(of_p) {
                terms.push((Rational::ONE, [self.d(a, q), self.d(b, p)]));
            }
            if in_a.has(of_p) && in_b.has(of_q) {
                terms.push((Rational::MINUS_ONE, [self.d(a, p), self.d(b, q)]));
            }
        }
        terms
    }
    /// Returns true if the flows of a and b are proven to commute: {a, b} = 0, and neither crosses a set where
    /// the other is not smooth.
    pub(crate) fn commute(&mut self, a: Node, b: Node) -> bool {
        self.bracket(a, b).is_empty()
            || self.brackets_vanish(a, b) && self.stays_smooth(a, b) && self.stays_smooth(b, a)
    }
    /// Returns true if the flow of a part of H is proven to keep an invariant, a question of its own.
    pub(crate) fn is_kept(&mut self, invariant: Node, part: Node) -> bool {
        self.proves(|space| space.commute(invariant, part))
    }
    /// Returns true if {a, b} = 0 is proven wherever both have derivatives.
    pub(crate) fn brackets_vanish(&mut self, a: Node, b: Node) -> bool {
        let terms = self.bracket(a, b);
        // Numbers of the derivatives first, which are made once for all brackets.
        let mut numbers = [Vec::new(), Vec::new()];
        for (sign, [x, y]) in &terms {
            let (x, y) = (self.near(*x), self.near(*y));
            for (at, numbers) in numbers.iter_mut().enumerate() {
                let term = x[at] * y[at];
                numbers.push(if sign.is_negative() { -term } else { term });
            }
        }
        if numbers
            .into_iter()
            .any(|terms| Ball::sum(terms.into_iter()).is_nonzero())
        {
            return false;
        }
        let products = terms.into_iter();
        let products = products.map(|(sign, factors)| (sign, self.model.dag.mul(&factors)));
        let products: Vec<(Rational, Node)> = products.into_list();
        let bracket = self.model.dag.linear(&Rational::ZERO, &products);
        self.is_zero(bracket)
    }

    /// Returns true if numbers say that an expression is not 0.
    pub(crate) fn is_off(&mut self, node: Node) -> bool {
        self.near(node).iter().any(|near| near.is_nonzero())
    }
    /// Returns true if an expression is proven to be 0 wherever it has a value.
    pub(crate) fn is_zero(&mut self, node: Node) -> bool {
        if self.model.dag.is_zero(node) {
            return true;
        }
        if let Some(&known) = self.zeros.get(&node) {
            return known;
        }
        // Numbers of every node are at hand: most expressions that are not 0 end here.
        if self.is_off(node) {
            return false;
        }
        let compare = |space: &mut Space, left: &mut usize| match witness(
            &space.model,
            node,
            Effort::Glance,
            &[],
        ) {
            Some(_) => Answer::Other(None),
            None => answer_within(&mut space.model.dag, node, left),
        };
        let is_long = |answer: &Answer| *answer == Answer::Limit(Undecided::Budget);
        let Some(answer) = self.compared(compare, is_long) else {
            return false;
        };
        let is_zero = answer == Answer::Zero;
        self.zeros.insert(node, is_zero);
        is_zero
    }
    /// Returns true if two expressions are proven to be the same.
    pub(crate) fn same(&mut self, a: Node, b: Node) -> bool {
        let difference = self.model.dag.sub(a, b);
        self.is_zero(difference)
    }

    /// An expression with numbers in place of some variables.
    pub(crate) fn section(&mut self, node: Node, set: Variables) -> Node {
        let set = self.set(node) & set;
        if set.is_empty() {
            return node;
        }
        let values: Map<Node, Rational> = set
            .members()
            .map(|variable| (self.variable(variable), place_of(variable)))
            .collect();
        let sets = &self.sets;
        self.model.dag.substitute(node, |dag, node| {
            if let Some(value) = values.get(&node) {
                return Some(dag.constant(value.clone()));
            }
            (!sets[node.0 as usize].meets(set)).then_some(node)
        })
    }
    /// The expression written without some variables, if it is proven not to depend on them.
    pub(crate) fn free(&mut self, node: Node, set: Variables) -> Option<Node> {
        if !self.set(node).meets(set) {
            return Some(node);
        }
        let [here, there] = [0.0, 1.0].map(|step| self.point_off(&[(set, step)]));
        if self
            .value_at(node, &here)
            .differs(self.value_at(node, &there))
        {
            return None;
        }
        let section = self.section(node, set);
        if !self.same(node, section) {
            return None;
        }
        // The normal form knows that sin² + cos² = 1, which numbers in their place hide.
        match tidy(&mut self.model.dag, node) {
            Some(tidy) if !self.set(tidy).meets(set) => Some(tidy),
            _ => Some(section),
        }
    }
    /// An expression with others in place of variables.
    pub(crate) fn at(&mut self, node: Node, new: &[(Node, Node)]) -> Node {
        self.model.dag.substitute(node, |_, node| {
            let found = new.iter().find(|(leaf, _)| *leaf == node);
            found.map(|(_, image)| *image)
        })
    }

    /// Adds to a motion the kick of the conjugate of an inert variable v: `value` = ∂h/∂v·time.
    pub(crate) fn push(&mut self, motion: &mut Motion, variable: Variable, value: Node) {
        let conjugate = self.variable(variable.conjugate());
        let dag = &mut self.model.dag;
        let value = if variable.is_coordinate() {
            dag.neg(value)
        } else {
            value
        };
        motion.add(dag, conjugate, value);
    }

    /// The value at a point where all is positive.
    pub(crate) fn value(&mut self, node: Node) -> Ball {
        self.near(node)[0]
    }
    /// The values at two points: all leaves positive, and of both signs.
    fn near(&mut self, node: Node) -> [Ball; 2] {
        let model = &self.model;
        self.values.each_mut().map(|values| values.at(model, node))
    }
    /// A point, by variables' numbers, from which others are taken by changing some.
    pub(crate) fn point(&self) -> Vec<Ball> {
        // Multiples of 1/64 are exact, and so are steps between them.
        let start = |bit: usize| Ball::exact(0.90625 + ((bit * 5 + 3) % 7) as f64 / 16.0);
        (0..2 * self.pairs.len()).map(start).into_list()
    }
    /// The sample point with some variables moved by steps.
    pub(crate) fn point_off(&self, moved: &[(Variables, f64)]) -> Vec<Ball> {
        let mut point = self.point();
        for (set, step) in moved {
            for Variable(bit) in set.members() {
                let step = step * ((bit * 3 + 1) % 5 + 1) as f64 / 16.0;
                point[bit] = point[bit] + Ball::exact(step);
            }
        }
        point
    }
    /// A fraction that an expression of values may be, from the first of some points where it exists.
    pub(crate) fn fraction(
        &mut self,
        of: impl Fn(&mut Space, &[Ball]) -> Ball,
    ) -> Option<Rational> {
        let all: Variables = (0..2 * self.pairs.len()).map(Variable).collect();
        let values = [0.0, -2.0, -4.0, 2.0].into_iter().map(|step| {
            let point = self.point_off(&[(all, step)]);
            of(self, &point)
        });
        values
            .into_iter()
            .find(|value| value.is_defined())?
            .as_fraction()
    }
    /// Nodes as operations on variables; parameters and time have the values of a sample point.
    pub(crate) fn tape(&mut self, roots: &[Node]) -> Option<Tape> {
        for root in roots {
            self.set(*root);
        }
        let Space {
            model,
            sets,
            values: [values, _],
            parameters,
            ..
        } = self;
        let given = |node: Node| match parameters.get(&node) {
            Some(given) => given.value,
            None => values.at(model, node).value,
        };
        Tape::of(&model.dag, roots, |node| sets[node.0 as usize], given)
    }
    /// The value at a point; parameters and time have the values of a sample point.
    pub(crate) fn value_at(&mut self, node: Node, point: &[Ball]) -> Ball {
        let mut key = PointBits(Vec::with_capacity(2 * point.len()));
        for ball in point {
            key.0.push(ball.value.to_bits());
            key.0.push(ball.error.to_bits());
        }
        if self.points.len() > POINTS {
            self.points = Map::default();
        }
        let (model, pairs, parameters) = (&self.model, &self.pairs, &self.parameters);
        let values = self.points.entry(key).or_insert_with(|| {
            let leaves = pairs.iter().flat_map(|(q, p)| [*q, *p]);
            let parameters = parameters.iter().map(|(leaf, value)| (*leaf, *value));
            let given = leaves.zip(point.iter().copied()).chain(parameters);
            Values::with(Sample::default(), given)
        });
        values.at(model, node)
    }

    /// The integer n with a = n·b, if that is proven.
    pub(crate) fn ratio(&mut self, a: Node, b: Node) -> Option<i32> {
        let (a_value, b_value) = (self.value(a), self.value(b));
        let guess = (a_value.value / b_value.value).round();
        if (Ball::exact(guess) * b_value).differs(a_value) {
            return None;
        }
        let n = (guess.abs() <= 64.0).then_some(guess as i32)?;
        let multiple = self.model.dag.scale(&Rational::integer(i64::from(n)), b);
        self.same(a, multiple).then_some(n)
    }

    /// The sign of an expression where it is certain: +1, −1, 0, or nothing where parameters
    /// or the point decide.
    pub(crate) fn sign(&mut self, node: Node) -> Option<i32> {
        match self.model.dag.sign(node) {
            Sign::POSITIVE => Some(1),
            Sign::NEGATIVE => Some(-1),
            _ => self.is_zero(node).then_some(0),
        }
    }
}

/// The number that stands for a variable in sections: coordinates and momenta differ.
fn place_of(variable: Variable) -> Rational {
    let pair = variable.0 as i64 / 2;
    match variable.is_coordinate() {
        true => Rational::new(3 + pair, 3),
        false => Rational::new(1 + pair % 3, 2),
    }
}

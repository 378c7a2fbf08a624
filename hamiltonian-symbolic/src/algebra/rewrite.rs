//! Expressions made again over other children.
//!
//! Input: nodes, and replacements for some of them. Output: nodes through the constructors
//! of `simplify`, so in canonical form. Invariant: an expression that does not change keeps its node.

use crate::dag::{Dag, Kind, Map, Node};
use crate::index::{Affine, Domain};
use crate::list::IntoList;

/// Makes the image of a node, for which those of its children are there.
type Image<'a> = dyn FnMut(&mut Dag, Node, &mut Map<Node, Node>) -> Option<Node> + 'a;

impl Dag {
    /// The node over other children; the node itself if no child differs.
    pub fn rebuild(&mut self, node: Node, new: &dyn Fn(Node) -> Node) -> Node {
        let mut is_changed = false;
        self.for_children(node, |child| is_changed |= new(child) != child);
        match is_changed {
            true => self.made_again(node, new),
            false => node,
        }
    }

    fn made_again(&mut self, node: Node, new: &dyn Fn(Node) -> Node) -> Node {
        match self.kind(node) {
            Kind::Product(_, factors) if self.is_sealed(node) => {
                let (a, b) = (new(factors[0].0), new(factors[1].0));
                self.seal(a, b)
            }
            kind => self.construct(kind.clone(), new),
        }
    }

    /// The node of a kind whose children are nodes of this arena or become such by `new`.
    pub(crate) fn construct(&mut self, kind: Kind, new: &dyn Fn(Node) -> Node) -> Node {
        match kind {
            Kind::Sum(c, terms) => {
                let terms = terms.into_iter().map(|(k, n)| (k, new(n))).into_list();
                self.linear(&c, &terms)
            }
            Kind::Product(k, factors) => {
                let factors = factors.into_iter().map(|(n, e)| (new(n), e)).into_list();
                self.product(&k, &factors)
            }
            Kind::Call(op, arguments) => {
                let arguments = arguments.into_iter().map(new).into_list();
                self.call(op, &arguments)
            }
            Kind::External(function, part, arguments) => {
                let arguments = arguments.into_iter().map(new).into_list();
                self.external(function, part, &arguments)
            }
            Kind::Reduce(domain, body) => self.reduce(domain, new(body)),
            Kind::Compare(relation, a, b) => self.intern(Kind::Compare(relation, new(a), new(b))),
            Kind::Not(a) => self.not(new(a)),
            Kind::And(a, b) => self.and(new(a), new(b)),
            Kind::Or(a, b) => self.or(new(a), new(b)),
            Kind::Select(c, a, b) => self.select(new(c), new(a), new(b)),
            leaf => self.intern(leaf),
        }
    }

    /// The expression with some nodes replaced: `leaf` gives a node's replacement, or `None` to
    /// rebuild it from its children.
    pub fn substitute(
        &mut self,
        root: Node,
        mut leaf: impl FnMut(&mut Dag, Node) -> Option<Node>,
    ) -> Node {
        self.substituted(root, &mut leaf)
    }

    fn substituted(
        &mut self,
        root: Node,
        leaf: &mut dyn FnMut(&mut Dag, Node) -> Option<Node>,
    ) -> Node {
        let nodes = self.reachable(&[root]);
        self.map(nodes, |dag, node, new| match leaf(dag, node) {
            Some(image) => image,
            None => dag.rebuild(node, &|child| new[&child]),
        })[&root]
    }

    /// The image of each node. Children come before their parents, so that `image` finds theirs.
    pub(crate) fn map(
        &mut self,
        nodes: Vec<Node>,
        mut image: impl FnMut(&mut Dag, Node, &mut Map<Node, Node>) -> Node,
    ) -> Map<Node, Node> {
        self.mapped(nodes, &mut |dag, node, new| Some(image(dag, node, new)))
            .expect("every node has an image")
    }

    /// Maps nodes like [`map`](Dag::map); `None` if a node has no image.
    pub(crate) fn try_map(
        &mut self,
        nodes: Vec<Node>,
        mut image: impl FnMut(&mut Dag, Node, &mut Map<Node, Node>) -> Option<Node>,
    ) -> Option<Map<Node, Node>> {
        self.mapped(nodes, &mut image)
    }

    fn mapped(&mut self, nodes: Vec<Node>, image: &mut Image<'_>) -> Option<Map<Node, Node>> {
        let mut new = Map::default();
        for node in nodes {
            let made = image(self, node, &mut new)?;
            new.insert(node, made);
        }
        Some(new)
    }

    /// The expression with products of products, which differentiation keeps apart, as one.
    pub(crate) fn rebuilt(&mut self, root: Node) -> Node {
        let nodes = self.reachable(&[root]);
        self.map(nodes, |dag, node, new| {
            dag.made_again(node, &|child| new[&child])
        })[&root]
    }

    /// The expression with its sums inside the loop `here`, each in the sum it stands in: the
    /// loops lie on one path, and none of them is open twice.
    pub(crate) fn nested(&mut self, root: Node, here: Option<Domain>) -> Node {
        if here.is_none() || !self.has_loops(&[root]) {
            return root;
        }
        let mut new: Map<(Node, Option<Domain>), Node> = Map::default();
        let mut pending = vec![(root, here)];
        while let Some(&(node, here)) = pending.last() {
            let own = match *self.kind(node) {
                Kind::Reduce(domain, body) => {
                    let range = self.range(domain).clone();
                    let own = self.domain(here, range.start, range.end);
                    let body = self.replace(body, domain, &Affine::variable(own));
                    Some((own, body))
                }
                _ => None,
            };
            let mut children = Vec::new();
            match own {
                Some((own, body)) => children.push((body, Some(own))),
                None => self.for_children(node, |child| children.push((child, here))),
            }
            children.retain(|child| !new.contains_key(child));
            if !children.is_empty() {
                pending.extend(children);
                continue;
            }
            pending.pop();
            let image = match own {
                // As it is: the constructor would move the loop out again.
                Some((own, body)) => self.intern(Kind::Reduce(own, new[&(body, Some(own))])),
                None => self.rebuild(node, &|child| new[&(child, here)]),
            };
            new.insert((node, here), image);
        }
        new[&(root, here)]
    }
}

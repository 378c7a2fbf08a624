//! Exact flows as data: pieces of H, and where a flow takes each variable.
//!
//! Input: flows from `flows::solve`, pieces from `flows::split`. Output: [`Piece`], [`ExactFlow`], [`Motion`]. Invariant: values are functions
//! of the point before the motion; outside the conditions everything that moves becomes NaN.

use crate::dag::{Dag, Map, Node};
use crate::index::Domain;
use crate::list::IntoList;

/// A part of H with its flow.
#[derive(Clone, PartialEq, Debug)]
pub struct Piece {
    /// The part of H.
    pub h: Node,
    /// The part in the author's notation.
    pub name: String,
    /// Its flow.
    pub flow: ExactFlow,
}

/// A flow in closed form.
#[derive(Clone, PartialEq, Debug)]
pub enum ExactFlow {
    /// No conjugate pair meets: everything moves at a constant rate, c·J∇h.
    Linear,
    /// A quadratic form of a whole point of few components: c·J∇h is linear, and its matrix is
    /// exponentiated when a run is prepared.
    Exponential,
    /// The motion in the time of the step coefficient, and the names of the forms it is made of.
    Closed(Motion, Vec<&'static str>),
    /// A flow in every iteration of a loop, one after the other; or several such loops, which have no element in
    /// common.
    Loop {
        /// The motion of one iteration of each loop.
        motions: Vec<Motion>,
        /// The names of the forms.
        forms: Vec<&'static str>,
        /// The innermost loop; none for several loops, each with its own index in all its elements.
        innermost: Option<Domain>,
        /// True if iterations commute, so that their order does not matter.
        merges: bool,
    },
}

impl ExactFlow {
    /// The names of the forms it is made of; none where it is linear in time.
    #[must_use]
    pub fn forms(&self) -> &[&'static str] {
        match self {
            ExactFlow::Linear => &[],
            ExactFlow::Exponential => &[EXPONENTIAL],
            ExactFlow::Closed(_, forms) | ExactFlow::Loop { forms, .. } => forms,
        }
    }
    /// Returns true if the flow for one time after that for another is the flow for both.
    #[must_use]
    pub fn merges(&self) -> bool {
        match self {
            ExactFlow::Linear | ExactFlow::Exponential | ExactFlow::Closed(..) => true,
            ExactFlow::Loop { merges, .. } => *merges,
        }
    }
    /// The loop in which each iteration reads and writes a single point.
    pub(crate) fn innermost(&self) -> Option<Domain> {
        match self {
            ExactFlow::Linear | ExactFlow::Exponential | ExactFlow::Closed(..) => None,
            ExactFlow::Loop { innermost, .. } => *innermost,
        }
    }
}

/// A motion with the names of the forms it is made of; none for a motion linear in time.
#[derive(Clone, Default)]
pub(crate) struct NamedMotion {
    pub(crate) motion: Motion,
    pub(crate) forms: Vec<&'static str>,
}

impl NamedMotion {
    /// The motion of one form.
    pub(crate) fn of(motion: Motion, form: &'static str) -> NamedMotion {
        let forms = vec![form];
        NamedMotion { motion, forms }
    }
    /// The flow with further forms noted.
    pub(crate) fn noted(mut self, forms: &[&'static str]) -> NamedMotion {
        for form in forms {
            if !self.forms.contains(form) {
                self.forms.push(form);
            }
        }
        self
    }
}

impl From<NamedMotion> for ExactFlow {
    fn from(flow: NamedMotion) -> ExactFlow {
        match flow.forms.as_slice() {
            [] => ExactFlow::Linear,
            [EXPONENTIAL] => ExactFlow::Exponential,
            _ => ExactFlow::Closed(flow.motion, flow.forms),
        }
    }
}

/// The name of the form whose matrix is exponentiated when a run is prepared.
pub(crate) const EXPONENTIAL: &str = "matrix exponential";

/// A variable that moves.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Move {
    /// The element of coordinates or momenta.
    pub leaf: Node,
    /// The number added to it, or its new value.
    pub value: Node,
    /// True if the value is added.
    pub added: bool,
}

/// An exact flow.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Motion {
    /// One move of each variable that moves.
    pub moves: Vec<Move>,
    /// Conditions that hold where the flow exists for the whole time.
    pub domain: Vec<Node>,
}

impl Motion {
    /// Adds to the increment of a variable.
    pub(crate) fn add(&mut self, dag: &mut Dag, leaf: Node, value: Node) {
        if dag.is_zero(value) {
            return;
        }
        match self.moves.iter_mut().find(|m| m.leaf == leaf) {
            Some(known) => known.value = dag.add(&[known.value, value]),
            None => self.moves.push(Move {
                leaf,
                value,
                added: true,
            }),
        }
    }
    /// Sets a variable.
    pub(crate) fn set(&mut self, leaf: Node, value: Node) {
        self.moves.push(Move {
            leaf,
            value,
            added: false,
        });
    }
    /// Adds a condition.
    pub(crate) fn asks(&mut self, dag: &mut Dag, positive: Node) {
        let zero = dag.integer(0);
        let holds = dag
            .as_constant(positive)
            .is_some_and(|c| !c.is_negative() && !c.is_zero());
        if !holds {
            self.domain.push(dag.less(zero, positive));
        }
    }
    /// Every variable that moves, with its new value.
    #[must_use]
    pub fn images(&self, dag: &mut Dag) -> Vec<(Node, Node)> {
        let image = |m: &Move| match m.added {
            true => (m.leaf, dag.add(&[m.leaf, m.value])),
            false => (m.leaf, m.value),
        };
        self.moves.iter().map(image).into_list()
    }

    /// This motion, then another.
    pub(crate) fn then(mut self, dag: &mut Dag, other: &Motion) -> Motion {
        let images: Map<Node, Node> = self.images(dag).into_iter().collect();
        let at = |dag: &mut Dag, node| dag.substitute(node, |_, node| images.get(&node).copied());
        for next in &other.moves {
            let value = at(dag, next.value);
            match self.moves.iter_mut().find(|m| m.leaf == next.leaf) {
                Some(known) if next.added => {
                    known.value = dag.add(&[known.value, value]);
                }
                Some(known) => {
                    known.value = value;
                    known.added = false;
                }
                None => self.moves.push(Move { value, ..*next }),
            }
        }
        for &condition in &other.domain {
            let condition = at(dag, condition);
            if !self.domain.contains(&condition) {
                self.domain.push(condition);
            }
        }
        self
    }

    /// The motion in other variables.
    pub(crate) fn map(mut self, mut image: impl FnMut(Node) -> Node) -> Motion {
        for m in &mut self.moves {
            (m.leaf, m.value) = (image(m.leaf), image(m.value));
        }
        for condition in &mut self.domain {
            *condition = image(*condition);
        }
        self
    }
}

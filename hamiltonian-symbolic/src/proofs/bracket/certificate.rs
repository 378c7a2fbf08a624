//! Certificates: how an invariant was proven.
//!
//! Input: the rules of a proof with the places where the statement, H or the force may jump or have a pole.
//! Output: [`Certificate`], as text that documentation quotes and a checker reads. Invariant: each place is named
//! where something other than a derivative decides it, and each function in Rust whose formula is not known.

use crate::dag::{Kind, Node};
use crate::list::IntoList;
use crate::model::Model;
use crate::print;

/// The rules that carry "its derivative is 0" over places at which there is no derivative.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Rule {
    /// The normal form of the statement has its value wherever the statement has one.
    NormalForm,
    /// The statement and H are quotients of analytic functions, so that orbits are analytic curves.
    Continuation,
    /// The statement has continuous first derivatives everywhere.
    Smoothness,
    /// The statement is continuous into the line closed by one infinity: at every point, or under a continuous
    /// flow outside sets that almost no orbit meets.
    Continuity,
    /// An orbit of an H with steps is a limit of orbits of smooth ones.
    SmoothedSteps,
}

/// Why a statement does not jump at a place.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Reason {
    /// Orbits cross, and both sides have the same value, or are infinite.
    BothSidesAgree,
    /// H is conserved and infinite there, so that no orbit comes there.
    HIsInfinite,
    /// The expression is constant along orbits, so that no orbit crosses.
    Constant,
    /// H has a step there, and the statement none.
    StepOfH,
}

/// A place: where an expression is 0, or, if it is constant, each of its levels.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Place {
    /// The expression, as text.
    pub at: String,
    /// The loops that it stands in, such as `i in 0..n, j in 0..i`; empty outside loops.
    pub within: String,
    /// Why a statement does not jump there.
    pub reason: Reason,
}

impl Place {
    pub(super) fn of(model: &Model, node: Node, reason: Reason) -> Place {
        Place::named(model, &print::text(model, node), node, reason)
    }

    /// A place with other words than those of its node.
    pub(super) fn named(model: &Model, at: &str, node: Node, reason: Reason) -> Place {
        let loops = model.dag.path(model.dag.home(node)).into_iter();
        let loops: Vec<String> = loops.map(|domain| print::range(model, domain)).into_list();
        Place {
            at: at.to_owned(),
            within: loops.join(", "),
            reason,
        }
    }
}

/// A proof: the rules that were used, the places they carried it over, and what they assumed.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Certificate {
    /// The rules, in order.
    pub rules: Vec<Rule>,
    /// The places, in order.
    pub places: Vec<Place>,
    /// The functions in Rust that are assumed to be smooth: analytic, without jumps, kinks and poles, and
    /// with the derivatives that were given.
    pub functions: Vec<String>,
}

impl Certificate {
    pub(super) fn new(
        model: &Model,
        rules: Vec<Rule>,
        places: Vec<Place>,
        roots: &[Node],
    ) -> Certificate {
        let mut functions: Vec<String> = Vec::new();
        for node in model.dag.reachable(roots) {
            if let Kind::External(function, ..) = model.dag.kind(node)
                && let Some(external) = model.externals.get(usize::from(*function))
                && !functions.contains(&external.name)
            {
                functions.push(external.name.clone());
            }
        }
        let mut different: Vec<Place> = Vec::new();
        for place in places {
            let is_same = |other: &Place| (&other.at, &other.within) == (&place.at, &place.within);
            if !different.iter().any(is_same) {
                different.push(place);
            }
        }
        Certificate {
            rules,
            places: different,
            functions,
        }
    }
}

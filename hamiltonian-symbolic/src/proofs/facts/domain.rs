//! The domains of expressions, as text for documentation.

use super::{Facts, Given};
use crate::dag::{Dependence, Kind, Node};
use crate::model::Model;
use crate::op::{NaturalDomain, SingularSet};
use crate::print;

/// The conditions under which expressions have values, as text: "`q - a` is not 0".
#[must_use]
pub fn conditions(model: &Model, roots: &[Node]) -> Vec<String> {
    let dag = &model.dag;
    let facts = Facts::of(dag, roots, &Given::default());
    let mut found: Vec<String> = Vec::new();
    let mut note = |x: Node, is: &str| {
        let condition = format!("`{}` {is}", print::text(model, x));
        if dag.dependence(x).on(Dependence::MOVING) && !found.contains(&condition) {
            found.push(condition);
        }
    };
    for node in dag.reachable(roots) {
        match dag.kind(node) {
            Kind::Product(_, factors) => {
                let below = factors.iter().filter(|(_, n)| *n < 0);
                below
                    .filter(|(base, _)| !facts.get(*base).has_no_moving_zero)
                    .for_each(|(base, _)| note(*base, "is not 0"));
            }
            Kind::Call(op, x) => {
                let regularity = op.row().regularity;
                match regularity.domain {
                    NaturalDomain::From(least) if !(least <= 0 && dag.is_nonnegative(x[0])) => {
                        let is = if regularity.pole.is_some() {
                            ">"
                        } else {
                            "≥"
                        };
                        note(x[0], &format!("{is} {least}"));
                    }
                    NaturalDomain::UnitInterval => note(x[0], "is between -1 and 1"),
                    NaturalDomain::Power if !dag.is_nonnegative(x[0]) => {
                        match dag.as_constant(x[1]) {
                            Some(_) => note(x[0], "≥ 0"),
                            None => {
                                let exponent = print::text(model, x[1]);
                                note(x[0], &format!("≥ 0, or `{exponent}` is whole"));
                            }
                        }
                    }
                    _ => {}
                }
                if regularity.pole == Some(SingularSet::Cosine) {
                    note(x[0], "is no odd multiple of pi/2");
                }
            }
            _ => {}
        }
    }
    found
}

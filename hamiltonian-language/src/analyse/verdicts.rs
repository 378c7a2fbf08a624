//! Proven structure of H, and the reasons against the rest, in the words rustc will use.
//!
//! Input: the structure of a model. Output: the verdicts that emission turns into types. Invariant: a reason
//! names the term of the user's that is in the way.

use super::structure::Reason;
use super::structure::{Jumping, Kick, Nystrom, Verdicts};
use hamiltonian_symbolic::dag::{Array, Column, Kind, Node, Side};
use hamiltonian_symbolic::forces;
use hamiltonian_symbolic::jumps::{force_jumps, jumps};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::print;
use hamiltonian_symbolic::structure::{Coupling, Structure, kick_beside};

/// The schemes beside those that take no force.
const FORCED: &str = "where H is split, `Strang` and its compositions integrate a force; \
    `ImplicitMidpoint` and its compositions, `Gauss`, `Variational` and `RungeKutta4` take any H with any force";

/// The obstacle to a system being a kick beside a piece at most quadratic in the momenta.
enum Obstacle {
    H(String),
    Force(&'static str),
}

/// The verdicts.
pub fn verdicts(model: &mut Model, structure: &Structure, split: Result<(), Reason>) -> Verdicts {
    let name = subject(model);
    let (kick, exact) = kick(model, structure);
    let jumping = jumping(model, structure);
    let nystrom = nystrom(model, structure, kick).map_err(|obstacle| {
        let (what, why, label, note) = match obstacle {
            Obstacle::H(why) => (
                name.clone(),
                why,
                "needs H = A(q, p) + V(q, t), A at most quadratic in p and with an exact flow",
                "declare the two, `split { A = …; V = …; }`, or use a scheme for any pieces with exact \
                 flows: `BlanesMoan4`, `BlanesMoan6`, `KahanLi8`",
            ),
            Obstacle::Force(why) => {
                let label = "needs a system without such a force";
                (of(model), why.to_owned(), label, FORCED)
            }
        };
        Reason {
            message: format!(
                "{what} is no kick V(q, t) beside a piece at most quadratic in the momenta: {why}"
            ),
            label: label.into(),
            note: note.into(),
        }
    });
    Verdicts {
        separable: match &structure.separable {
            Ok(_) => Ok(()),
            Err(coupling) => Err(not_separable(model, &name, coupling)),
        },
        split,
        halves: match &structure.separable {
            Ok(split) => [split.potential, split.kinetic].map(|half| print::text(model, half)),
            Err(_) => ["force".into(), String::new()],
        },
        quadratic_kinetic: structure
            .quadratic_kinetic
            .as_ref()
            .map_err(|why| Reason {
                message: format!(
                    "the kinetic part of {name} is not a quadratic form of the momenta: {why}"
                ),
                label: "needs H = pᵀM⁻¹p/2 + V(q) with constant M".into(),
                note: "use a scheme for any separable H, or for any H".into(),
            })
            .copied(),
        nystrom,
        unforced: match model.force.is_empty() {
            true => Ok(()),
            false => Err(Reason {
                message: format!(
                    "a force acts on {}, and this scheme integrates H alone",
                    of(model)
                ),
                label: "needs a system without a force".into(),
                note: format!(
                    "{FORCED}; `dt = …*ds` in the definition takes it along into another time"
                ),
            }),
        },
        exact,
        kick,
        autonomous: structure
            .autonomous
            .as_ref()
            .map_err(|why| Reason {
                message: format!("{name} depends on time: {why}"),
                label: "needs H(q, p) without time".into(),
                note: "use a scheme that takes H(q, p, t)".into(),
            })
            .copied(),
        cyclic: structure
            .cyclic
            .iter()
            .map(|cyclic| cyclic.coordinate.clone())
            .into_list(),
        growth: structure.growth,
        jumping,
    }
}

/// The parts that jump at times that do not depend on the state.
fn jumping(model: &mut Model, structure: &Structure) -> Option<Jumping> {
    let h = model.h();
    let force: Vec<Node> = model.force.iter().map(|entry| entry.value).into_list();
    let force = force_jumps(&mut model.dag, &force);
    if !force && !jumps(&mut model.dag, h) {
        return None;
    }
    let halves = match &structure.separable {
        Ok(split) => [split.potential, split.kinetic].map(|half| jumps(&mut model.dag, half)),
        Err(_) => [false; 2],
    };
    let pieces = model
        .pieces
        .iter()
        .map(|piece| jumps(&mut model.dag, piece.h));
    Some(Jumping {
        halves: [halves[0] || force, halves[1]],
        pieces: pieces.chain([force]).into_list(),
    })
}

/// The kick V(q, t) and the piece at most quadratic in the momenta beside it: two pieces of the split,
/// or V and T; or the reason why not.
fn nystrom(
    model: &mut Model,
    structure: &Structure,
    kick: Option<Kick>,
) -> Result<Nystrom, Obstacle> {
    let of_h = Obstacle::H;
    let pieces = match model.pieces.as_slice() {
        [] => Err(of_h("it is not split into exact flows".to_owned())),
        _ if !model.force.is_empty() => Err(Obstacle::Force("a force acts beside the pieces of H")),
        pieces => match pieces.iter().find(|piece| !piece.flow.merges()) {
            Some(piece) => Err(of_h(format!(
                "the terms of its piece `{}` do not commute",
                piece.name
            ))),
            None => match *pieces {
                [ref first, ref second] => {
                    let parts = [first.h, second.h];
                    let beside = kick_beside(model, parts).map(Nystrom::Pieces);
                    beside.map_err(of_h)
                }
                [_] => Err(of_h(
                    "all of it is one exact flow, which `Strang` makes".to_owned(),
                )),
                _ => Err(of_h(format!("it is split into {} pieces", pieces.len()))),
            },
        },
    };
    let Ok(split) = &structure.separable else {
        return pieces;
    };
    pieces.or_else(|_| match kick {
        Some(Kick::Plain) => {
            let beside = kick_beside(model, [split.potential, split.kinetic]);
            beside.map(|_| Nystrom::Halves).map_err(of_h)
        }
        _ => Err(Obstacle::Force("its force depends on momenta")),
    })
}

/// The kick of V with the force, or of the force beside pieces of H, and whether that is exact.
fn kick(model: &mut Model, structure: &Structure) -> (Option<Kick>, Result<(), Reason>) {
    if model.force.is_empty() || (structure.separable.is_err() && model.pieces.is_empty()) {
        let kick = structure.separable.is_ok().then_some(Kick::Plain);
        return (kick, Ok(()));
    }
    let (kick, exact) = match forces::kick_of(model) {
        Ok(forces::KickFlow::Single { damped, .. }) if damped.is_empty() => (Kick::Plain, Ok(())),
        Ok(forces::KickFlow::Single { rest, .. }) => {
            let rest = !rest.is_empty();
            (Kick::Damped { rest }, Ok(()))
        }
        Ok(forces::KickFlow::Coupled { .. }) => (Kick::Coupled, Ok(())),
        Err(entry) => {
            let reason = Reason {
                message: format!(
                    "the force `{}` on {} is not affine in momenta: it has no exact flow",
                    print::text(model, entry.value),
                    of(model)
                ),
                label: "has its order with exact flows alone".into(),
                note:
                    "`StormerVerlet` and `Strang` integrate it by a symmetric sub-step of order 2; \
                       `ImplicitMidpoint` and its compositions take any force"
                        .into(),
            };
            (Kick::SubStep, Err(reason))
        }
    };
    (Some(kick), exact)
}

/// `` `Pendulum` ``, or `H`
fn of(model: &Model) -> String {
    match model.name.as_str() {
        "H" => "H".into(),
        name => format!("`{name}`"),
    }
}

/// ``H of `Pendulum` ``, or `H`
pub(super) fn subject(model: &Model) -> String {
    if model.name == "H" {
        "H".into()
    } else {
        format!("H of `{}`", model.name)
    }
}

/// The schemes that take any H: implicit ones, those on a doubled phase space, which take no force, and
/// one without a form.
pub(super) fn for_any_h(model: &Model) -> &'static str {
    match model.force.is_empty() {
        true => {
            "use a scheme for any H: `ImplicitMidpoint`, `Gauss`, `Tao`, `Semiexplicit`, `Pihajoki`, \
             `IntersectingSubTrajectories`, `RungeKutta4` (not symplectic)"
        }
        false => {
            "use a scheme for any H and any force: `ImplicitMidpoint` and its compositions, `Gauss`, \
             `Variational`, `RungeKutta4` (not symplectic)"
        }
    }
}

fn not_separable(model: &Model, name: &str, coupling: &Coupling) -> Reason {
    let why = match coupling.limit {
        Some(_) => coupling.to_string(),
        None => {
            let [q, p] = [Side::Q, Side::P].map(|side| first_name(model, coupling.term, side));
            format!("the term `{}` couples {q} and {p}", coupling.text)
        }
    };
    Reason {
        message: format!("{name} is not separable: {why}"),
        label: "needs H = T(p) + V(q)".into(),
        note: for_any_h(model).to_owned(),
    }
}

/// The first coordinate or momentum that a node depends on.
fn first_name(model: &Model, node: Node, wanted: Side) -> String {
    for leaf in model.dag.reachable(&[node]) {
        if let Kind::Element(Array::Phase(Column { side, group, .. }), ..) = model.dag.kind(leaf)
            && *side == wanted
        {
            let group = &model.groups[usize::from(*group)];
            return match wanted {
                Side::Q => group.coordinate.clone(),
                Side::P => group.momentum.clone(),
            };
        }
    }
    String::new()
}

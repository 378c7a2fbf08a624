//! H as a sum of pieces with exact flows: declared, or found, or the term that has none.
//!
//! Input: a model with its structure and the declared pieces. Output: the model's pieces, and the text
//! of docs and of rustc on them. Invariant: pieces that are kept are proven to add up to H,
//! each with an exact flow; V and T of a separable H need no search.

use super::Part;
use super::structure::Reason;
use super::surface::CLOCK;
use crate::checked::{self, Checked, NodeKind, Variable};
use crate::report::Report;
use hamiltonian_symbolic::dag::Node;
use hamiltonian_symbolic::jumps::jumps;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::{Model, Piece};
use hamiltonian_symbolic::split::{self, Decomposition, NoFlow, PIECES};
use hamiltonian_symbolic::structure::Structure;

/// The text on a splitting.
pub(super) struct SplitText {
    /// `Ok` if there is one, or the reason why not.
    pub verdict: Result<(), Reason>,
    /// The sentences of the docs.
    pub facts: Vec<String>,
}

impl SplitText {
    fn split(facts: Vec<String>) -> SplitText {
        SplitText {
            verdict: Ok(()),
            facts,
        }
    }
}

/// Splits the model's H, into the pieces that were declared where there are any.
pub(super) fn decide(
    checked: &Checked,
    model: &mut Model,
    structure: &Structure,
    part: &Part,
    report: &mut Report,
) -> SplitText {
    let declared = part.pieces;
    let is_separable = structure.separable.is_ok();
    let is_new = |node: &checked::Node| {
        matches!(
            node.kind,
            NodeKind::Phase(Variable::NewCoordinate | Variable::NewMomentum, _)
        )
    };
    let is_in_these = checked.charts.is_empty() || checked.nodes.iter().any(is_new);
    let is_written_so = is_in_these && checked.time_factor.is_none();
    let found = if declared.is_empty() {
        let alone = part.piece.is_some().then(|| alone(model));
        // V and T apart are no worse than a piece that moves only one of them.
        let is_closed =
            |found: &Decomposition| found.pieces.iter().any(|p| !p.flow.forms().is_empty());
        if is_separable && !matches!(&alone, Some(Ok(found)) if is_closed(found)) {
            return SplitText::split(Vec::new());
        }
        alone.unwrap_or_else(|| split::find(model).map_err(|refusal| (0, refusal)))
    } else {
        let parts = declared.iter().map(|(name, h)| (name.to_string(), *h));
        let parts: Vec<(String, Node)> = parts.into_list();
        split::declared(model, &parts)
    };
    let mut is_carried_over = false;
    if let Err((at, refusal)) = &found
        && let Some((name, _)) = declared.get(*at)
    {
        if is_written_so {
            let why = match refusal.limit {
                Some(limit) => format!(
                    "the search ended at its limit of {limit}, at its term `{}`",
                    refusal.text
                ),
                None => format!(
                    "the flow of its term `{}` is of no known closed form",
                    refusal.text
                ),
            };
            report.error(
                name.span(),
                format!("no exact flow is known for the piece `{name}`: {why}"),
                format!(
                    "split it further, or leave the term to a piece with which it is of such a form: {}",
                    exact_forms()
                ),
            );
        }
        is_carried_over = !is_written_so;
    }
    let is_forced = !model.force.is_empty();
    // The kick carries the force. In other variables than those it was written in, V and T still are
    // pieces.
    if is_separable && (is_forced || is_carried_over) {
        return SplitText::split(Vec::new());
    }
    match found {
        Ok(splitting) if splitting.pieces.len() + usize::from(is_forced) > PIECES => {
            if let Some((name, _)) = declared.get(PIECES) {
                let clock = if name == CLOCK {
                    " with that of `dt`"
                } else {
                    ""
                };
                report.error(
                    name.span(),
                    format!(
                        "the split has {} pieces{clock}, more than {PIECES}",
                        splitting.pieces.len()
                    ),
                    "join pieces whose sum is of one form, such as those of coordinates alone and those of momenta alone",
                );
            }
            let with = if is_forced { "with its force " } else { "" };
            refused(model, &format!("{with}it has more than {PIECES} pieces"))
        }
        Ok(mut splitting) => {
            // The flow of the first piece is evaluated at the ends of steps, where H(t) may jump.
            let mut pieces = splitting.pieces.iter();
            let first = pieces.position(|piece| !jumps(&mut model.dag, piece.h));
            if let Some(first) = first {
                splitting.pieces[..=first].rotate_right(1);
            }
            let mut facts = facts(&splitting);
            // In another time H has other terms than the definition.
            let is_found = declared.is_empty() && part.piece.is_none();
            if is_found && checked.time_factor.is_none() && splitting.pieces.len() > 1 {
                facts.push(declaration(model, &splitting.pieces));
            }
            if is_forced {
                facts.push("The force is a piece of its own, the innermost.".to_owned());
            }
            model.pieces = splitting.pieces;
            SplitText::split(facts)
        }
        Err((_, refusal)) => {
            let why = match refusal.limit {
                Some(limit) => format!(
                    "the search ended at its limit of {limit}, before it met an exact flow for the term"
                ),
                None => "no exact flow is known for the term".to_owned(),
            };
            refused(model, &format!("{why} `{}`", refusal.text))
        }
    }
}

/// The forms of [`split::FORMS`] in words of the language; their patterns have the notation of papers.
pub const WORDS: [(&str, &str); 12] = [
    ("quadratic form", "quadratic forms"),
    ("matrix exponential", "quadratic forms"),
    ("monomial", "c*q^a*p^b"),
    (
        "f(q)·p",
        "f(q)*p with f quadratic, exponential, trigonometric or hyperbolic",
    ),
    (
        "f(q)·p²",
        "f(q)*p^2 with f = a + b*q + c*q^2, a/q^2 + b + c*q^2 or a*q^2 + b*q^3 + c*q^4",
    ),
    ("shear", "G(p - A(q)) with a polynomial A"),
    ("free flight", "free motion in polar coordinates"),
    ("great circle", "free motion on a sphere in angles"),
    (
        "rotation",
        "functions of an angular momentum x*p_y - y*p_x and x^2 + y^2",
    ),
    ("Kepler", "Kepler's problem"),
    ("spin component", "components of a spin in angle and height"),
    (
        "body axis",
        "squares of angular momenta along body axes in Euler angles",
    ),
];

/// The forms of a piece with an exact flow: those linear in time, and those of the table.
fn exact_forms() -> String {
    let mut forms = vec!["V(q)", "T(p)"];
    for (_, form) in WORDS {
        if !forms.contains(&form) {
            forms.push(form);
        }
    }
    forms.join(", ")
}

/// A piece of a split by itself: one flow.
fn alone(model: &mut Model) -> Result<Decomposition, (usize, NoFlow)> {
    let h = model.h();
    let name = hamiltonian_symbolic::print::text(model, h);
    split::declared(model, &[(name, h)])
}

fn refused(model: &Model, why: &str) -> SplitText {
    let name = super::verdicts::subject(model);
    SplitText {
        verdict: Err(Reason {
            message: format!("{name} is not split into exact flows: {why}"),
            label: "needs H = A + B + … whose pieces have exact flows".into(),
            note: format!(
                "declare pieces by hand, `split {{ A = …; B = …; }}`, or {}",
                super::verdicts::for_any_h(model)
            ),
        }),
        facts: vec![format!("H is not split into exact flows: {why}.")],
    }
}

/// The statement that declares pieces which were found.
fn declaration(model: &Model, pieces: &[Piece]) -> String {
    const NAMES: [&str; PIECES] = [
        "First", "Second", "Third", "Fourth", "Fifth", "Sixth", "Seventh", "Eighth",
    ];
    let mut text = "Another version may find better pieces. This statement of the definition keeps these:\n\n```text\nsplit {\n".to_owned();
    for (name, piece) in NAMES.iter().zip(pieces) {
        let h = hamiltonian_symbolic::print::text(model, piece.h);
        text += &format!("    {name} = {h};\n");
    }
    text + "}\n```"
}

/// A splitting, and the reason for it.
fn facts(splitting: &Decomposition) -> Vec<String> {
    let piece = |piece: &Piece| match piece.flow.forms() {
        [] => format!("`{}`", piece.name),
        forms => format!("`{}` ({})", piece.name, forms.join(", ")),
    };
    let pieces: Vec<String> = splitting.pieces.iter().map(piece).into_list();
    let mut facts = match pieces.as_slice() {
        [] => return Vec::new(),
        [one] if splitting.pieces[0].flow.merges() => {
            vec![format!("The flow of all of H is exact: {one}.")]
        }
        [one] => vec![format!(
            "H is split into the terms of one loop, each with an exact flow, the first one first on the way down and last on the way up: {one}."
        )],
        all => vec![format!(
            "H is split into {} pieces with exact flows, outermost first: {}.",
            all.len(),
            all.join("; ")
        )],
    };
    if let Some(reasons) = &splitting.choice {
        if reasons.error.is_finite() {
            facts.push(format!(
                "This splitting was chosen among {} by its error times its cost: H is off by at most {:.1e} in short runs of second order with step 0.1 near unit size.",
                reasons.among, reasons.error
            ));
        }
        if reasons.keeps_invariants {
            facts.push("Every piece keeps every invariant.".to_owned());
        }
    }
    facts
}

//! H and Hamilton's equations as people read them.
//!
//! Input: a model with its structure. Output: the texts emission puts into docs, `Display` and
//! constants. Invariant: none of it is read by the program.

use super::proofs::Certificates;
use super::structure::Text;
use hamiltonian_symbolic::bracket::{Place, Reason};
use hamiltonian_symbolic::count::{self, Count, Operations};
use hamiltonian_symbolic::legendre::Readable;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::{Model, Shape};
use hamiltonian_symbolic::print::{self, Notation};
use hamiltonian_symbolic::program::{Program, Purpose};
use hamiltonian_symbolic::structure::Structure;

/// Formulas in MathML, at most: longer ones stay text, which is easier to search.
const MATH_BYTES: usize = 20 * 1024;

/// The texts; equations of motion only where H is not large. Of a Lagrangian, H as it is read.
pub fn text(
    model: &Model,
    structure: &Structure,
    readable: Option<&Readable>,
    large: bool,
) -> Text {
    let h = model.h();
    let notations = [Notation::Text, Notation::Latex];
    let [equations, latex_equations] = if large {
        notations.map(|_| Vec::new())
    } else {
        equations(model, readable, notations)
    };
    let signature = signature(model);
    let latex = match readable {
        Some(readable) => readable.latex(),
        None => format!("H = {}", print::latex(model, h)),
    };
    let [math, math_equations] = formulas(&latex, &latex_equations).unwrap_or_default();
    Text {
        hamiltonian: match readable {
            Some(readable) => readable.text(&signature),
            None => format!("{signature} = {}", print::text(model, h)),
        },
        equations,
        latex,
        latex_equations,
        math,
        math_equations,
        facts: facts(structure, !model.force.is_empty()),
        operations: Vec::new(),
    }
}

/// H and the rows of its equations in MathML; `None` where they are longer than 20 KB together.
fn formulas(latex: &str, equations: &[String]) -> Option<[String; 2]> {
    // MathML is about six times as long as LaTeX, and is not made to be thrown away.
    let length: usize = equations.iter().map(String::len).sum();
    if latex.len() + length > MATH_BYTES / 4 {
        return None;
    }
    let math = print::mathml(latex)?;
    let mut rows = String::new();
    for line in equations {
        let (left, right) = line.split_once(" = ")?;
        let (left, right) = (print::mathml(left)?, print::mathml(right)?);
        rows.push_str("<mtr><mtd style=\"text-align:right\">");
        rows.push_str(&left);
        rows.push_str("</mtd><mtd style=\"text-align:left\"><mo>=</mo>");
        rows.push_str(&right);
        rows.push_str("</mtd></mtr>\n");
    }
    (math.len() + rows.len() <= MATH_BYTES).then_some([math, rows])
}

/// Hamilton's equations one a line, in each notation.
fn equations<const N: usize>(
    model: &Model,
    readable: Option<&Readable>,
    notations: [Notation; N],
) -> [Vec<String>; N] {
    let mut derived = None;
    notations.map(|notation| {
        if let Some(equations) = readable.and_then(|readable| readable.equations(notation)) {
            return equations;
        }
        // Derived once for all notations.
        let equations = derived.get_or_insert_with(|| print::hamilton_equations(model));
        let lines = equations.written(notation).into_iter();
        lines
            .map(|(left, right)| format!("{left} = {right}"))
            .into_list()
    })
}

/// A table of the operations of value and gradient, one row a line. `#[max_ops]` limits the sum of the
/// rows of `energy_and_gradient`.
pub fn operations(model: &Model, program: &Program) -> Vec<String> {
    let mut rows = vec![
        "| | + − × | ÷ | √ | functions | together |".to_owned(),
        "|---|--:|--:|--:|--:|--:|".to_owned(),
    ];
    let has_gradient = program.function(Purpose::Gradient).is_some();
    for (method, purpose) in [
        ("`energy`", Purpose::Energy),
        ("`gradient`", Purpose::Gradient),
        ("kick", Purpose::Kick),
        ("drift", Purpose::Drift),
        ("field", Purpose::VectorField),
        ("`energy_and_gradient`", Purpose::EnergyAndGradient),
    ] {
        let is_part = matches!(
            purpose,
            Purpose::Kick | Purpose::Drift | Purpose::VectorField
        );
        let function = program.function(purpose);
        // The parts stand for a gradient that is made of them.
        let Some(function) = function.filter(|_| !(is_part && has_gradient)) else {
            continue;
        };
        let counts = count::operations(model, program, function);
        rows.extend(counts.iter().map(|count| row(method, count)));
    }
    rows
}

/// `| each i in 0..n | 6 | 1 | 0 | 0 | 7 |`
fn row(method: &str, count: &Count) -> String {
    let place = match count.place.as_str() {
        "" => method.to_owned(),
        place => format!("each {place}"),
    };
    let Operations {
        arithmetic,
        divisions,
        roots,
        functions,
    } = count.operations;
    let together = count.operations.total();
    format!("| {place} | {arithmetic} | {divisions} | {roots} | {functions} | {together} |")
}

/// `H(x, q[N]; p_x, p[N]; t)`
fn signature(model: &Model) -> String {
    let shape = |shape: &Shape<u16>| match shape {
        Shape::Scalar => String::new(),
        Shape::Vector(rows) => format!("[{}]", print::extent(model, rows)),
        Shape::Matrix(rows, columns) => format!("[{}][{columns}]", print::extent(model, rows)),
        Shape::Lattice(_, axes) => {
            let extents = axes.iter().map(|axis| print::extent(model, axis));
            extents.map(|extent| format!("[{extent}]")).collect()
        }
    };
    let list = |name: fn(&hamiltonian_symbolic::model::Group) -> &String| {
        let names = model
            .groups
            .iter()
            .map(|group| format!("{}{}", name(group), shape(&group.shape)));
        names.into_list().join(", ")
    };
    let (coordinates, momenta) = (
        list(|group| &group.coordinate),
        list(|group| &group.momentum),
    );
    let time = model
        .time
        .as_ref()
        .map_or_else(String::new, |time| format!("; {time}"));
    format!("H({coordinates}; {momenta}{time})")
}

/// The places of one kind that the documentation of an invariant lists, at most.
const PLACES: usize = 4;

/// The proofs of invariants in words, a sentence each: why nothing jumps, and what is assumed. `assumed` has the
/// invariants without a proof.
pub fn proofs(certificates: &Certificates, assumed: &[bool]) -> Vec<Vec<String>> {
    let each = certificates.iter().zip(assumed);
    each.map(|(components, is_assumed)| {
        if *is_assumed && components.is_empty() {
            return vec!["It is assumed to be conserved, without a proof.".to_owned()];
        }
        let places = components.iter().flat_map(|component| &component.places);
        let of = |reason: Reason| -> Option<String> {
            let mut found: Vec<String> = Vec::new();
            for place in places.clone().filter(|place| place.reason == reason) {
                let words = written(place);
                if !found.contains(&words) {
                    found.push(words);
                }
            }
            if found.len() > PLACES {
                found.truncate(PLACES);
                found.push("…".to_owned());
            }
            (!found.is_empty()).then(|| found.join(", "))
        };
        let mut sentences: Vec<String> = Vec::new();
        if let Some(list) = of(Reason::HIsInfinite) {
            sentences.push(format!(
                "It holds where H is finite: it is infinite at {list}, where no orbit comes."
            ));
        }
        if let Some(list) = of(Reason::Constant) {
            sentences.push(format!("No orbit crosses a level of {list}."));
        }
        if let Some(list) = of(Reason::BothSidesAgree) {
            sentences.push(format!("Orbits may cross {list}, where both sides agree."));
        }
        if let Some(list) = of(Reason::StepOfH) {
            sentences.push(format!("Orbits may cross the steps of H at {list}."));
        }
        let mut functions: Vec<String> = Vec::new();
        for name in components.iter().flat_map(|component| &component.functions) {
            let name = format!("`{name}`");
            if !functions.contains(&name) {
                functions.push(name);
            }
        }
        if let Some((last, others)) = functions.split_last() {
            let (names, are) = match others {
                [] => (last.clone(), "is"),
                _ => (format!("{} and {last}", others.join(", ")), "are"),
            };
            sentences.push(format!(
                "{names} {are} assumed to be smooth: analytic, without jumps, kinks and poles."
            ));
        }
        sentences
    })
    .into_list()
}

/// `` `q - 1` = 0 ``, or `` `q[i] - q[j]` = 0 (i in 0..n, j in 0..i) ``; of a constant without `= 0`
fn written(place: &Place) -> String {
    let within = match place.within.as_str() {
        "" => String::new(),
        within => format!(" ({within})"),
    };
    match place.reason {
        Reason::Constant => format!("`{}`{within}", place.at),
        _ => format!("`{}` = 0{within}", place.at),
    }
}

/// Facts of H, a sentence each.
fn facts(structure: &Structure, is_forced: bool) -> Vec<String> {
    let mut facts = Vec::new();
    facts.push(match (&structure.separable, &structure.quadratic_kinetic) {
        (Ok(_), Ok(())) => {
            "H is separable, and its kinetic part is a quadratic form of the momenta.".to_owned()
        }
        (Ok(_), Err(_)) => "H is separable.".to_owned(),
        (Err(coupling), _) if coupling.limit.is_some() => {
            format!("H is not separable: {coupling}.")
        }
        (Err(coupling), _) => format!("H is not separable: see the term `{}`.", coupling.text),
    });
    facts.push(match &structure.autonomous {
        Ok(()) if is_forced => "H does not depend on time; the force changes it.".to_owned(),
        Ok(()) => "H does not depend on time: it is conserved.".to_owned(),
        Err(why) => format!("H depends on time: {why}."),
    });
    for cyclic in &structure.cyclic {
        let (coordinate, momentum) = (&cyclic.coordinate, &cyclic.momentum);
        facts.push(match is_forced {
            true => {
                format!("`{coordinate}` does not appear in H: only the force changes `{momentum}`.")
            }
            false => format!("`{coordinate}` does not appear in H: `{momentum}` is conserved."),
        });
    }
    facts
}

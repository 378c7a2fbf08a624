//! A system that is written in another way keeps its structure and its pieces: other names, another order of
//! terms and of coordinates, a parameter that nothing reads, an added constant, another degree of freedom.
//! Scaled coordinates keep the structure.

use super::arrays::RINGS;
use super::forms::CASES;
use super::rewrite::{replaced, shuffle, terms, with_factors};
use super::table::{FOUND, REFUSED};
use crate::common;
use crate::judge::field::{Field, Layout, World, extents};
use crate::tree::Random;
use hamiltonian_lanes::{DoubleDouble as D, Real};
use hamiltonian_symbolic::dag::Side;
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::split::find;
use hamiltonian_symbolic::structure::analyse;

/// A system as text, and where the coordinates of the one it was made from stand.
#[derive(Clone, Debug)]
struct System {
    coordinates: Vec<String>,
    momenta: Vec<String>,
    time: String,
    parameters: Vec<String>,
    /// The values of the parameters.
    values: Vec<f64>,
    sizes: String,
    terms: Vec<String>,
    order: Vec<usize>,
}

/// What traits are made of: separable, a quadratic T, autonomous, the number of cyclic coordinates, and either
/// the number of pieces or the term that is refused.
type Structure = (bool, bool, bool, usize, Result<usize, String>);

/// The name of a degree of freedom that has nothing to do with the others.
const APART: [&str; 2] = ["apart", "p_apart"];

impl System {
    fn read(signature: &str, parameters: &str, h: &str) -> System {
        let mut parts = signature.split(';');
        let mut names = || {
            let part = parts.next().expect("there are coordinates and momenta");
            part.split(',').map(|name| name.trim().to_owned()).collect()
        };
        let (coordinates, momenta): (Vec<String>, Vec<String>) = (names(), names());
        let parameters: Vec<String> = parameters.split_whitespace().map(str::to_owned).collect();
        System {
            order: (0..coordinates.len()).collect(),
            values: (0..parameters.len())
                .map(|at| 0.4 + 0.3 * at as f64)
                .collect(),
            time: parts.next().unwrap_or("").to_owned(),
            parameters,
            // Arrays have a size of their own.
            sizes: if signature.contains("[n]") { "n" } else { "" }.to_owned(),
            terms: terms(h),
            coordinates,
            momenta,
        }
    }
    fn model(&self) -> Model {
        let (q, p) = (self.coordinates.join(", "), self.momenta.join(", "));
        let signature = match self.time.is_empty() {
            true => format!("{q}; {p}"),
            false => format!("{q}; {p}; {}", self.time),
        };
        let h = format!("0 {}", self.terms.join(" "));
        common::system(&signature, &self.sizes, &self.parameters.join(" "), &h)
    }

    fn renamed(&self) -> System {
        let mut names: Vec<(String, String)> = Vec::new();
        for (letter, list) in [
            ("zz", &self.coordinates),
            ("aa", &self.momenta),
            ("mm", &self.parameters),
        ] {
            for (at, name) in list.iter().enumerate() {
                let (name, _) = name.split_once('[').unwrap_or((name, ""));
                names.push((name.to_owned(), format!("{letter}{}", list.len() - at)));
            }
        }
        let all = |list: &[String]| list.iter().map(|text| replaced(text, &names)).collect();
        System {
            coordinates: all(&self.coordinates),
            momenta: all(&self.momenta),
            parameters: all(&self.parameters),
            terms: all(&self.terms),
            ..self.clone()
        }
    }
    /// In coordinates that are multiples of its own.
    fn scaled(&self) -> System {
        let mut names: Vec<(String, String)> = Vec::new();
        let factors = ["2", "(3/2)", "(1/3)"].into_iter().cycle();
        for ((q, p), k) in self.coordinates.iter().zip(&self.momenta).zip(factors) {
            names.push((q.clone(), format!("({k}*{q})")));
            names.push((p.clone(), format!("({p}/{k})")));
        }
        let terms = self.terms.iter().map(|text| replaced(text, &names));
        System {
            terms: terms.collect(),
            ..self.clone()
        }
    }
    /// With an oscillator beside it.
    fn with_another(&self) -> System {
        let mut other = self.clone();
        other.coordinates.insert(0, APART[0].to_owned());
        other.momenta.insert(0, APART[1].to_owned());
        other.order.insert(0, self.order.len());
        other.terms.insert(0, format!("+ {}^2/2", APART[0]));
        other.terms.push(format!("+ {}^2/2", APART[1]));
        other
    }
    fn reversed(&self) -> System {
        let mut other = self.clone();
        other.terms.reverse();
        other.coordinates.reverse();
        other.momenta.reverse();
        other.order.reverse();
        other
    }
    fn with_terms(&self, random: &mut Random) -> System {
        let mut other = self.clone();
        shuffle(&mut other.terms, random);
        other
    }
    /// With the factors of each term in another order.
    fn with_factors(&self, random: &mut Random) -> System {
        let terms = self.terms.iter().map(|term| with_factors(term, random));
        System {
            terms: terms.collect(),
            ..self.clone()
        }
    }
    fn with_coordinates(&self, random: &mut Random) -> System {
        let mut places: Vec<usize> = (0..self.order.len()).collect();
        shuffle(&mut places, random);
        System {
            coordinates: places
                .iter()
                .map(|at| self.coordinates[*at].clone())
                .collect(),
            momenta: places.iter().map(|at| self.momenta[*at].clone()).collect(),
            order: places.iter().map(|at| self.order[*at]).collect(),
            ..self.clone()
        }
    }
    fn with_parameter(&self) -> System {
        let mut other = self.clone();
        other.parameters.insert(0, "unused".to_owned());
        other.values.insert(0, 0.1);
        other
    }
    /// With its parameters declared in another order.
    fn with_parameters(&self, random: &mut Random) -> System {
        let mut both: Vec<(String, f64)> = self
            .parameters
            .iter()
            .cloned()
            .zip(self.values.iter().copied())
            .collect();
        shuffle(&mut both, random);
        let (parameters, values) = both.into_iter().unzip();
        System {
            parameters,
            values,
            ..self.clone()
        }
    }
    fn with_constant(&self) -> System {
        let mut other = self.clone();
        other.terms.insert(0, "+ 2.5".to_owned());
        other
    }
    fn with_parameter_added(&self) -> System {
        let mut other = self.with_parameter();
        other.terms.push("+ unused".to_owned());
        other
    }

    fn structure(&self) -> Structure {
        let mut model = self.model();
        let found = analyse(&mut model);
        let split = find(&mut model);
        (
            found.separable.is_ok(),
            found.quadratic_kinetic.is_ok(),
            found.autonomous.is_ok(),
            found.cyclic.len(),
            split.map(|split| split.pieces.len()).map_err(|refusal| {
                assert!(refusal.limit.is_none(), "{:?}: {self:?}", refusal.limit);
                refusal.text
            }),
        )
    }

    /// The values of the pieces at points of the system it was made from, less those at the first of them,
    /// in order of size.
    fn pieces(&self) -> Result<Vec<Vec<f64>>, String> {
        let mut model = self.model();
        let pieces = find(&mut model).map_err(|refusal| refusal.text)?.pieces;
        // Rings of four sites.
        let sizes = vec![4; usize::from(!self.sizes.is_empty())];
        let parameters = model.parameters.iter().zip(&self.values);
        let parameters = parameters.map(|(parameter, value)| {
            let (rows, columns) = extents(&parameter.shape, &sizes);
            let column = |_| (0..rows).map(|row| value + row as f64 / 8.0).collect();
            (0..columns).map(column).collect()
        });
        let world = World {
            parameters: parameters.collect(),
            sizes,
            t: 0.3,
        };
        let layout = Layout::of(&model, &world.sizes);
        let point = |k: usize| -> Vec<D> {
            let mut z = vec![D::from(0.0); 2 * layout.half];
            for (group, old) in self.order.iter().enumerate() {
                let (_, rows, columns) = layout.groups[group];
                // What stands apart rests.
                let k = if self.coordinates[group] == APART[0] {
                    0
                } else {
                    k
                };
                for (side, row) in [Side::Q, Side::P]
                    .into_iter()
                    .flat_map(|side| (0..rows).map(move |row| (side, row)))
                {
                    let momentum = usize::from(side == Side::P);
                    let place = ((2 * old + momentum) * 7 + row * 3 + k * 5) % 11;
                    let value = 0.9 - 0.6 * momentum as f64 + place as f64 / 32.0;
                    for column in 0..columns {
                        z[layout.place(side, group, column, row)] = D::from(value);
                    }
                }
            }
            z
        };
        let mut all = Vec::new();
        for piece in pieces {
            let field = Field::of(&model, piece.h, &world, &[]);
            let values: Vec<f64> = (0..4).map(|k| field.at(&point(k)).0.to_f64()).collect();
            all.push(values.iter().map(|value| value - values[0]).collect());
        }
        // A piece of what stands apart is constant.
        all.retain(|values: &Vec<f64>| values.iter().any(|value| *value != 0.0));
        all.sort_by(|a: &Vec<f64>, b| a[1].total_cmp(&b[1]));
        Ok(all)
    }
}

/// Systems beside those of the table: what their authors may list in another order.
const MORE: &[(&str, &str, &str)] = &[
    (
        "phi, theta, r, t; p_phi, p_theta, p_r, p_t",
        "",
        "(1 - 2/r)*p_r^2/2 + p_theta^2/(2*r^2) + p_phi^2/(2*r^2*sin(theta)^2) - p_t^2/(2*(1 - 2/r))",
    ),
    (
        "f, th, ps; pf, pt, pp",
        "A B C m",
        "((pf - pp*cos(th/2))*sin(ps)/sin(th/2) + 2*pt*cos(ps))^2/(2*A) + ((pf - pp*cos(th/2))*cos(ps)/sin(th/2) - 2*pt*sin(ps))^2/(2*B) + pp^2/(2*C) + m*cos(th/2)",
    ),
];

/// Definitions of the examples and the book.
const EXAMPLES: &[(&str, &str, &str)] = &[
    ("theta; p", "m l g", "p^2/(2*m*l^2) - m*g*l*cos(theta)"),
    ("q; p", "m l g", "p^2/(2*m*l^2) - m*g*l*cos(q) + p/l"),
    ("theta; p; t", "f", "p^2/2 - cos(theta) - f*theta*cos(t)"),
    ("theta; p; t", "a", "p^2/2 - (1 + a*cos(1.7*t))*cos(theta)"),
    (
        "x, y; p_x, p_y",
        "",
        "(p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3",
    ),
    (
        "x, y, z; p_x, p_y, p_z",
        "B E",
        "((p_x + B*y/2)^2 + (p_y - B*x/2)^2 + p_z^2)/2 - E*x",
    ),
    (
        "x, y, z; p_x, p_y, p_z",
        "B k",
        "((p_x + B*y/2)^2 + (p_y - B*x/2)^2 + p_z^2)/2 + k*(2*z^2 - x^2 - y^2)/2",
    ),
    (
        "x, y, z; p_x, p_y, p_z",
        "mu",
        "((p_x + mu*y/sqrt(x^2 + y^2 + z^2)^3)^2 + (p_y - mu*x/sqrt(x^2 + y^2 + z^2)^3)^2 + p_z^2)/2",
    ),
    (
        "a, b; p_a, p_b",
        "m1 m2 l1 l2 g",
        "(m2*l2^2*p_a^2 + (m1 + m2)*l1^2*p_b^2 - 2*m2*l1*l2*p_a*p_b*cos(a - b))/(2*m2*l1^2*l2^2*(m1 + m2*sin(a - b)^2)) - (m1 + m2)*g*l1*cos(a) - m2*g*l2*cos(b)",
    ),
    (
        "x, y; p_x, p_y",
        "omega v core b",
        "(p_x^2 + p_y^2)/2 - omega*(x*p_y - y*p_x) + v^2/2*ln(core^2 + x^2 + (y/b)^2)",
    ),
    (
        "x, y; p_x, p_y",
        "mu",
        "(p_x^2 + p_y^2)/2 + y*p_x - x*p_y - (1 - mu)/hypot(x + mu, y) - mu/hypot(x - (1 - mu), y)",
    ),
    (
        "phi, theta, psi; p_phi, p_theta, p_psi",
        "",
        "((p_phi - p_psi*cos(theta))*sin(psi)/sin(theta) + p_theta*cos(psi))^2/4 + ((p_phi - p_psi*cos(theta))*cos(psi)/sin(theta) - p_theta*sin(psi))^2/4 + p_psi^2/2 - sin(theta)*sin(psi)",
    ),
    (
        "x, y; p_x, p_y",
        "k",
        "(p_x^2 + p_y^2)/2 - k/sqrt(x^2 + y^2)",
    ),
    (
        "x, y; p_x, p_y",
        "D a",
        "(p_x^2 + p_y^2)/2 + D*(1 - exp(-a*x))^2 + x*y",
    ),
    ("S; P", "", "S*P*(1 - S) - P^2"),
];

/// Systems whose best splittings are close to each other, found by random rewriting.
const CLOSE: &[(&str, &str, &str)] = &[
    (
        "z, w; p_z, p_w",
        "a",
        "(1 + sin(w))*p_z^2 + p_w^2/2 + a*w^3 + 3*(z^2 + 1)*(p_z^2 + 1)",
    ),
    ("q; p", "k", "k*(q^2 + 1)*(p^2 + 1) + q*p/7 + p^2*q^2/6"),
    ("q; p", "", "q*p/7 + 4*(q^2 + 1)*(p^2 + 1)/3 + p^2*q^2/6"),
    ("q; p", "a", "a*q^3 + 8*(q^2 + 1)*(p^2 + 1)/3"),
    (
        "x; p",
        "",
        "sin(x)*p/8 + 61*x*p/35 + 8*x^2*p^2/7 + 15*p^2/4",
    ),
    (
        "x, z, w; p_x, p_z, p_w",
        "",
        "(z*p_w - w*p_z) + 7*w*p_x/5 + 4*x^2*p_x^2/7 + 2*cos(w - x) + 8*cos(x - z) + w*p_w/6",
    ),
    (
        "x, y, u, v; p_x, p_y, p_u, p_v",
        "a b c",
        "(y*p_x - x*p_y) + (5*p_x^2/2)/a + (3*x^4/13)/c + 5*p_y^2/2 + 2*x^2*p_x^2/7 + c*(6*cos(y - x)) + (y^2 + 1)*(p_y^2 + 1)/3 + (u^2 + 1)*(p_u^2 + 1)*b/2 + (v^2 + a)*(p_v^2 + 1)/3 + v*p_v",
    ),
    (
        "x, z; p_x, p_z",
        "a",
        "7*(x^2 + 1)*(p_x^2 + 1)/3 + a*(2*(z^2 + 1)*(p_z^2 + 1)/3)",
    ),
];

/// All systems of one component each.
fn systems() -> Vec<System> {
    let found = FOUND
        .iter()
        .map(|one| (one.signature, one.parameters, one.h));
    let cases = CASES
        .iter()
        .map(|one| (one.signature, one.parameters, one.h));
    let refused = REFUSED
        .iter()
        .map(|one| (one.signature, one.parameters, one.h));
    let all = found
        .chain(MORE.iter().copied())
        .chain(CLOSE.iter().copied())
        .chain(EXAMPLES.iter().copied());
    all.chain(cases)
        .chain(refused)
        .map(|(signature, parameters, h)| System::read(signature, parameters, h))
        .collect()
}

/// Systems of arrays.
fn rings() -> impl Iterator<Item = System> {
    let all = RINGS.iter();
    all.map(|ring| System::read(ring.signature, ring.parameters, ring.h))
}

/// The ways in which one system is written, each with its name; scaled coordinates have other pieces.
fn others(system: &System, random: &mut Random) -> Vec<(&'static str, System)> {
    let mut all = vec![
        ("names", system.renamed()),
        ("terms", system.with_terms(random)),
        ("factors", system.with_factors(random)),
        ("coordinates", system.with_coordinates(random)),
        ("both reversed", system.reversed()),
        ("parameter", system.with_parameter()),
        ("parameters", system.with_parameters(random)),
        ("constant", system.with_constant()),
        ("parameter added", system.with_parameter_added()),
        ("another", system.with_another()),
        (
            "all",
            system
                .renamed()
                .with_terms(random)
                .with_factors(random)
                .with_coordinates(random)
                .with_parameter()
                .with_parameters(random)
                .with_constant()
                .with_another(),
        ),
    ];
    for _ in 0..common::cases(0, 20) {
        all.push(("terms", system.with_terms(random)));
        all.push(("factors", system.with_factors(random)));
        all.push(("coordinates", system.with_coordinates(random)));
        all.push(("another", system.with_another().with_coordinates(random)));
    }
    all
}

/// The ways to write some systems that have other pieces, and the number of all ways.
fn with_other_pieces(systems: &[System], random: &mut Random) -> (Vec<String>, usize) {
    let (mut faults, mut count) = (Vec::new(), 0);
    for system in systems {
        let pieces = system.pieces();
        for (what, other) in others(system, random) {
            count += 1;
            let is_same = |own: &Vec<Vec<f64>>, pieces: &Vec<Vec<f64>>| {
                own.len() == pieces.len()
                    && own
                        .iter()
                        .flatten()
                        .zip(pieces.iter().flatten())
                        .all(|(a, b)| (a - b).abs() <= 1e-9 * (1.0 + a.abs() + b.abs()))
            };
            match (other.pieces(), &pieces) {
                (Ok(own), Ok(pieces)) if is_same(&own, pieces) => {}
                (Err(_), Err(_)) => {}
                (Ok(_), _) => faults.push(format!("{what}: other pieces: {other:?}")),
                (Err(term), _) => faults.push(format!("{what}: refused for {term}: {other:?}")),
            }
        }
    }
    (faults, count)
}

#[test]
fn the_same_systems_have_the_same_pieces() {
    let mut random = Random(19);
    let systems: Vec<System> = systems().into_iter().chain(rings()).collect();
    let (faults, count) = with_other_pieces(&systems, &mut random);
    println!("{count} ways to write {} systems", systems.len());
    assert!(systems.len() >= 50);
    assert!(
        faults.is_empty(),
        "{} of {count}: {faults:#?}",
        faults.len()
    );
}

/// Terms of random systems: `k` is a number, `x` and `y` are coordinates, `px` and `py` their momenta.
const TERMS: [&str; 14] = [
    "k*x^2*px^2/7",
    "k*(x^2 + 1)*(px^2 + 1)/3",
    "k*x*py/5",
    "k*px^2/2",
    "k*x^2*y^2/11",
    "sin(x)*py/k",
    "k*cos(x - y)",
    "k*px*py/4",
    "(x*py - y*px)/k",
    "px^2*y^2/k",
    "x*px/k",
    "a*x^3",
    "b*(k + sin(y))*px^2",
    "px^2/(2*a*(1 + y^2))",
];

/// A sum of some terms over three degrees of freedom.
fn random_system(random: &mut Random) -> System {
    let mut h = String::from("q0^2/9 + p0^2/3");
    for _ in 0..2 + random.below(5) {
        let (x, k) = (random.below(3), 1 + random.below(9));
        let y = (x + 1 + random.below(2)) % 3;
        let names = [("x", "q", x), ("y", "q", y), ("px", "p", x), ("py", "p", y)];
        let names = names.map(|(old, new, at)| (old.to_owned(), format!("{new}{at}")));
        let mut names = names.to_vec();
        names.push(("k".to_owned(), k.to_string()));
        h += &format!(" + {}", replaced(TERMS[random.below(TERMS.len())], &names));
    }
    System::read("q0, q1, q2; p0, p1, p2", "a b", &h)
}

#[test]
fn random_systems_have_the_same_pieces() {
    let mut random = Random(21);
    let systems: Vec<System> = (0..common::cases(25, 400))
        .map(|_| random_system(&mut random))
        .collect();
    let (faults, count) = with_other_pieces(&systems, &mut random);
    assert!(
        faults.is_empty(),
        "{} of {count}: {faults:#?}",
        faults.len()
    );
}

#[test]
fn the_same_systems_have_the_same_structure() {
    let mut random = Random(20);
    let (mut faults, mut count) = (Vec::new(), 0);
    for system in systems().into_iter().chain(rings()) {
        let own = system.structure();
        let mut all = others(&system, &mut random);
        // Elements of arrays are scaled by the tests of transformations.
        if system.sizes.is_empty() {
            all.push(("scaled", system.scaled()));
        }
        for (what, other) in all {
            count += 1;
            let new = other.structure();
            let traits = |of: &Structure| (of.0, of.1, of.2, of.3, of.4.is_ok());
            if traits(&own) != traits(&new) {
                faults.push(format!("{what}: {own:?} became {new:?}: {other:?}"));
            }
        }
    }
    println!("{count} systems");
    assert!(
        faults.is_empty(),
        "{} of {count}: {faults:#?}",
        faults.len()
    );
}

/// A term that no form takes, and whose normal form is large.
const HARD: &str = "sqrt((x^2 + u^2 + 1)*(y^2 + v^2 + 2) + (x + y + u + v)^6/(1 + (x*u - y*v)^4))";

#[test]
fn a_term_apart_spends_no_budget() {
    let alone = common::system("q; p", "", "", "0.5*(q^2 + 1)*(p^2 + 1)");
    let pieces = find(&mut alone.clone()).expect("it is split").pieces;
    // Oscillators of other frequencies, far more than the pairs and the terms of one search.
    let (mut q, mut p, mut h) = ("q".to_owned(), "p".to_owned(), String::new());
    for at in 0..40 {
        q += &format!(", x{at}");
        p += &format!(", y{at}");
        h += &format!(" + y{at}^2/2 + {}*x{at}^2 + x{at}^4", at + 1);
    }
    let h = format!("0.5*(q^2 + 1)*(p^2 + 1){h}");
    let mut together = common::system(&format!("{q}; {p}"), "", "", &h);
    let found = find(&mut together).expect("it is split as it is alone");
    assert_eq!(found.pieces.len(), pieces.len());
    // What is refused is the term apart, whichever comes first.
    for (signature, h) in [
        (
            "q, x, y; p, u, v",
            format!("0.5*(q^2 + 1)*(p^2 + 1) + {HARD}"),
        ),
        (
            "x, y, q; u, v, p",
            format!("{HARD} + 0.5*(q^2 + 1)*(p^2 + 1)"),
        ),
    ] {
        let refusal =
            find(&mut common::system(signature, "", "", &h)).expect_err("one has no flow");
        assert!(refusal.text.contains("x*u"), "{refusal:?}");
    }
}

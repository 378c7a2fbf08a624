//! What is the same system to its author has the same pieces: other names, another order of terms and of
//! coordinates, a parameter that nothing reads, an added constant.

use super::table::FOUND;
use crate::common;
use crate::judge::field::{Field, World};
use crate::tree::Random;
use hamiltonian_lanes::{DoubleDouble as D, Real};
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::split::find;

/// A system as text, and where the coordinates of the one it was made from stand.
#[derive(Clone, Debug)]
struct System {
    coordinates: Vec<String>,
    momenta: Vec<String>,
    time: String,
    parameters: Vec<String>,
    terms: Vec<String>,
    order: Vec<usize>,
}

impl System {
    fn read(signature: &str, parameters: &str, h: &str) -> System {
        let mut parts = signature.split(';');
        let mut names = || {
            let part = parts.next().expect("there are coordinates and momenta");
            part.split(',').map(|name| name.trim().to_owned()).collect()
        };
        let (coordinates, momenta): (Vec<String>, Vec<String>) = (names(), names());
        System {
            order: (0..coordinates.len()).collect(),
            time: parts.next().unwrap_or("").to_owned(),
            parameters: parameters.split_whitespace().map(str::to_owned).collect(),
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
        common::system(&signature, "", &self.parameters.join(" "), &h)
    }

    fn renamed(&self) -> System {
        let mut names: Vec<(String, String)> = Vec::new();
        for (letter, list) in [
            ("zz", &self.coordinates),
            ("aa", &self.momenta),
            ("mm", &self.parameters),
        ] {
            for (at, name) in list.iter().enumerate() {
                names.push((name.clone(), format!("{letter}{}", list.len() - at)));
            }
        }
        let other = |text: &String| {
            let mut out = String::new();
            let mut word = String::new();
            for c in text.chars().chain([' ']) {
                if c.is_alphanumeric() || c == '_' {
                    word.push(c);
                    continue;
                }
                let new = names.iter().find(|(old, _)| *old == word);
                out.push_str(new.map_or(&word, |(_, new)| new));
                word.clear();
                out.push(c);
            }
            out.trim_end().to_owned()
        };
        let all = |list: &Vec<String>| list.iter().map(other).collect();
        System {
            coordinates: all(&self.coordinates),
            momenta: all(&self.momenta),
            parameters: all(&self.parameters),
            terms: all(&self.terms),
            ..self.clone()
        }
    }
    fn with_terms(&self, random: &mut Random) -> System {
        let mut other = self.clone();
        shuffle(&mut other.terms, random);
        other
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
        other
    }
    fn with_constant(&self) -> System {
        let mut other = self.clone();
        other.terms.insert(0, "+ 2.5".to_owned());
        other
    }

    /// The values of the pieces at points of the system it was made from, less those at the first of them,
    /// in order of size.
    fn pieces(&self) -> Result<Vec<Vec<f64>>, String> {
        let mut model = self.model();
        let pieces = find(&mut model).map_err(|refusal| refusal.text)?.pieces;
        let unused = self
            .parameters
            .iter()
            .filter(|name| *name == "unused")
            .count();
        let number = |at: usize| vec![vec![0.4 + 0.3 * (at as f64 - unused as f64)]];
        let world = World {
            sizes: Vec::new(),
            parameters: (0..self.parameters.len()).map(number).collect(),
            t: 0.3,
        };
        let n = self.order.len();
        let point = |k: usize| -> Vec<D> {
            let value = |old: usize| {
                let place = (old * 7 + k * 5) % 11;
                let momentum = f64::from(u8::from(old % 2 == 1));
                D::from(0.9 - 0.6 * momentum + place as f64 / 32.0)
            };
            let q = self.order.iter().map(|old| value(2 * old));
            let p = self.order.iter().map(|old| value(2 * old + 1));
            let all: Vec<D> = q.chain(p).collect();
            assert_eq!(all.len(), 2 * n);
            all
        };
        let mut all = Vec::new();
        for piece in pieces {
            let field = Field::of(&model, piece.h, &world, &[]);
            let values: Vec<f64> = (0..4).map(|k| field.at(&point(k)).0.to_f64()).collect();
            all.push(values.iter().map(|value| value - values[0]).collect());
        }
        all.sort_by(|a: &Vec<f64>, b| a[1].total_cmp(&b[1]));
        Ok(all)
    }
}

/// The terms of a sum, each with its sign.
fn terms(h: &str) -> Vec<String> {
    let (mut terms, mut depth) = (Vec::new(), 0);
    let mut now = String::from("+ ");
    for c in h.chars() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            '+' | '-' if depth == 0 && now.trim_end().len() > 1 => {
                terms.push(now.trim_end().to_owned());
                now.clear();
            }
            '-' if depth == 0 => now.clear(),
            _ => {}
        }
        now.push(c);
    }
    terms.push(now);
    terms
}

fn shuffle<T>(list: &mut [T], random: &mut Random) {
    for at in (1..list.len()).rev() {
        list.swap(at, random.below(at + 1));
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

#[test]
fn the_same_systems_have_the_same_pieces() {
    let mut random = Random(19);
    let (mut others, mut count) = (Vec::new(), 0);
    let table = FOUND
        .iter()
        .map(|found| (found.signature, found.parameters, found.h));
    for (signature, parameters, h) in table.chain(MORE.iter().copied()) {
        let system = System::read(signature, parameters, h);
        let pieces = system.pieces().expect("it is split");
        let together = system
            .renamed()
            .with_terms(&mut random)
            .with_coordinates(&mut random);
        let mut perturbed = vec![
            ("names", system.renamed()),
            ("terms", system.with_terms(&mut random)),
            ("coordinates", system.with_coordinates(&mut random)),
            ("parameter", system.with_parameter()),
            ("constant", system.with_constant()),
            ("all", together.with_parameter().with_constant()),
        ];
        for _ in 0..common::cases(0, 20) {
            perturbed.push(("terms", system.with_terms(&mut random)));
            perturbed.push(("coordinates", system.with_coordinates(&mut random)));
        }
        for (what, other) in perturbed {
            count += 1;
            let is_same = |own: &Vec<Vec<f64>>| {
                own.len() == pieces.len()
                    && own
                        .iter()
                        .flatten()
                        .zip(pieces.iter().flatten())
                        .all(|(a, b)| (a - b).abs() <= 1e-9 * (1.0 + a.abs() + b.abs()))
            };
            match other.pieces() {
                Ok(own) if is_same(&own) => {}
                Ok(_) => others.push(format!("{what}: other pieces: {other:?}")),
                Err(term) => others.push(format!("{what}: refused for {term}: {other:?}")),
            }
        }
    }
    println!("{count} systems");
    assert!(count >= 50);
    assert!(
        others.is_empty(),
        "{} of {count}: {others:#?}",
        others.len()
    );
}

//! Proofs against orbits: what is proven does not change along any, and no orbit comes to a place that a
//! certificate says none comes to.
//!
//! Input: random definitions with walls in sums that may be empty, conditions whose sides have poles, and
//! functions in Rust. Output: panics with the definitions whose proof an orbit contradicts. Invariant: the
//! orbits come from [`Field`] and steps of their own, and share no code with the rules; seeds are fixed.
//!
//! That the orbits can contradict a proof is tested on the statements of which only the derivative is known to
//! vanish, and on functions that are not smooth.

mod make;

use crate::common::{cases, parse, system};
use crate::judge::field::{Field, Layout, World};
use crate::random_text::Random;
use hamiltonian_lanes::{DoubleDouble as D, Real};
use hamiltonian_symbolic::bracket::{Certificate, Place, Reason, Verdict, is_invariant};
use hamiltonian_symbolic::model::Model;
use make::{Definition, FUNCTIONS, ROUGH};

/// The accuracy of a step, relative to the point.
const TOLERANCE: f64 = 1e-9;
/// The change of the energy past which an orbit counts for nothing: a step led over a wall.
const DRIFT: f64 = 1e-6;
/// The most energy of an orbit, and the longest way of a step. With more a step leads over walls, which are
/// thin at a high energy.
const HIGHEST: f64 = 50.0;
const LONGEST: f64 = 0.2;
/// The most steps of an orbit.
const STEPS: usize = 300;

/// The points of an orbit, while its energy is kept.
fn orbit(h: &Field, start: Vec<f64>, time: f64) -> Vec<Vec<D>> {
    let mut z: Vec<D> = start.into_iter().map(D::from).collect();
    let energy = h.at(&z).0.to_f64();
    let mut points = vec![z.clone()];
    let (mut done, mut step) = (0.0, 0.01 * time);
    while done < time.abs() && points.len() < STEPS {
        let (next, error) = stepped(h, &z, step);
        let size = z.iter().fold(1.0, |m: f64, x| m.max(x.to_f64().abs()));
        let moved = z.iter().zip(&next).map(|(a, b)| (*a - *b).to_f64().abs());
        let way = moved.fold(0.0, f64::max) / LONGEST;
        let ratio = (error / (TOLERANCE * size)).max(way.powi(5));
        if ratio <= 1.0 {
            let now = h.at(&next).0.to_f64();
            let drift = (now - energy).abs() / (1.0 + energy.abs());
            if drift.is_nan() || drift > DRIFT {
                break;
            }
            done += step.abs();
            z = next;
            points.push(z.clone());
        }
        let factor = if ratio.is_finite() {
            0.9 * ratio.max(1e-8).powf(-0.2)
        } else {
            0.2
        };
        step *= factor.clamp(0.2, 4.0);
        if step.abs() < 1e-13 || step.is_nan() {
            break;
        }
    }
    points
}

/// A step of Dormand and Prince (J. Comput. Appl. Math. 6, 19, 1980) with its error.
fn stepped(h: &Field, z: &[D], step: f64) -> (Vec<D>, f64) {
    const A: [&[f64]; 6] = [
        &[1.0 / 5.0],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
        &[
            19372.0 / 6561.0,
            -25360.0 / 2187.0,
            64448.0 / 6561.0,
            -212.0 / 729.0,
        ],
        &[
            9017.0 / 3168.0,
            -355.0 / 33.0,
            46732.0 / 5247.0,
            49.0 / 176.0,
            -5103.0 / 18656.0,
        ],
        &[
            35.0 / 384.0,
            0.0,
            500.0 / 1113.0,
            125.0 / 192.0,
            -2187.0 / 6784.0,
            11.0 / 84.0,
        ],
    ];
    const E: [f64; 7] = [
        71.0 / 57600.0,
        0.0,
        -71.0 / 16695.0,
        71.0 / 1920.0,
        -17253.0 / 339200.0,
        22.0 / 525.0,
        -1.0 / 40.0,
    ];
    let mut slopes = vec![h.at(z).1];
    let mut end = z.to_vec();
    for row in A {
        end = z.to_vec();
        for (a, slope) in row.iter().zip(&slopes) {
            for (x, v) in end.iter_mut().zip(slope) {
                *x += D::from(step * a) * *v;
            }
        }
        slopes.push(h.at(&end).1);
    }
    let mut error = 0.0;
    for at in 0..z.len() {
        let each = E.iter().zip(&slopes);
        let off: f64 = each.map(|(e, slope)| step * e * slope[at].to_f64()).sum();
        error = if off.is_nan() {
            f64::NAN
        } else {
            f64::max(error, off.abs())
        };
    }
    (end, error)
}

/// An expression that is constant along orbits if a certificate is right about a place: the sign of what no
/// orbit brings to 0, or a constant itself; in loops a sum with weights.
fn kept(place: &Place) -> Option<String> {
    let value = match place.reason {
        Reason::HIsInfinite => format!("sign({})", place.at),
        Reason::Constant => format!("atan({})", place.at),
        Reason::BothSidesAgree | Reason::StepOfH => return None,
    };
    if place.within.is_empty() {
        return Some(value);
    }
    let names = place
        .within
        .split(", ")
        .map(|range| range.split(' ').next());
    let weights = names.flatten().zip(["0.317", "0.0731", "0.01973"]);
    let weight: Vec<String> = weights.map(|(name, k)| format!("{k}*{name}")).collect();
    Some(format!(
        "sum({}) {{ (1.1 + {})*({value}) }}",
        place.within,
        weight.join(" + ")
    ))
}

/// Starts, some of them in planes in which a pair rests at 0, and on the axes.
fn start(random: &mut Random, half: usize) -> Vec<f64> {
    let mut number = |n: usize| (random.below(n) as f64 + 0.37) / n as f64;
    let mut z: Vec<f64> = (0..2 * half)
        .map(|_| 5.0 * (number(1 << 20) - 0.5))
        .collect();
    for pair in 0..half {
        if half > 1 && number(4) < 0.25 {
            (z[pair], z[half + pair]) = (0.0, 0.0);
        }
    }
    z
}

/// The first orbit along which one of some expressions changes.
fn change(
    random: &mut Random,
    definition: &Definition,
    function: Option<&str>,
    expressions: &[String],
    orbits: usize,
) -> Option<String> {
    let with = |text: &str| make::with_functions(text, function);
    let mut model = definition.model(&with(&definition.h));
    let expressions: Vec<String> = expressions.iter().map(|text| with(text)).collect();
    let nodes: Vec<_> = expressions
        .iter()
        .map(|text| parse(&mut model, text))
        .collect();
    for size in definition.sizes() {
        for _ in 0..orbits {
            let parameter = [0.0, 1.0, -0.75][random.below(3)];
            let world = World {
                sizes: vec![*size],
                parameters: vec![vec![vec![parameter]]; model.parameters.len()],
                t: 0.0,
            };
            let half = Layout::of(&model, &world.sizes).half;
            let field = |node| Field::of(&model, node, &world, &[]);
            let h = field(model.h());
            let is_low = |z: &Vec<f64>| {
                let z: Vec<D> = z.iter().map(|x| D::from(*x)).collect();
                h.at(&z).0.to_f64().abs() < HIGHEST
            };
            let Some(z) = (0..20).map(|_| start(random, half)).find(is_low) else {
                continue;
            };
            let points: Vec<Vec<D>> = [3.0, -3.0]
                .into_iter()
                .flat_map(|time| orbit(&h, z.clone(), time))
                .collect();
            for (node, text) in nodes.iter().zip(&expressions) {
                let field = field(*node);
                let values = points.iter().map(|point| field.at(point).0.to_f64());
                let finite: Vec<f64> = values.filter(|value| value.is_finite()).collect();
                let Some(first) = finite.first() else {
                    continue;
                };
                let is_same = |value: &&f64| (**value - first).abs() > 1e-4 * (1.0 + first.abs());
                if let Some(other) = finite.iter().find(is_same) {
                    return Some(format!(
                        "{definition:?}: `{text}` goes from {first} to {other} for the size {size} and the parameter {parameter} from {z:?}"
                    ));
                }
            }
        }
    }
    None
}

fn verdict(definition: &Definition) -> Verdict {
    let mut model: Model = definition.model(&definition.h);
    let node = parse(&mut model, &definition.invariant);
    is_invariant(&model, node, None)
}

/// What the certificate of a statement says of orbits, with the statement.
fn claims(definition: &Definition, certificate: &Certificate) -> Vec<String> {
    let energy = |place: &Place| match place.at.as_str() {
        "H" => Place {
            at: definition.h.clone(),
            ..place.clone()
        },
        _ => place.clone(),
    };
    let places = certificate.places.iter().map(energy);
    let mut claims: Vec<String> = places.filter_map(|place| kept(&place)).collect();
    claims.push(definition.invariant.clone());
    claims
}

/// Follows orbits of definitions of a class. Of its statements at least `proven` in a hundred are to be proven,
/// and orbits are to contradict at least `caught` in a hundred of those of which the derivative vanishes.
fn follow(seed: u64, make: fn(&mut Random) -> Definition, proven: usize, caught: usize) {
    let mut random = Random(seed);
    let count = cases(200, 6000);
    let (mut right, mut contradicted, mut wrong) = (0, 0, Vec::new());
    for _ in 0..count {
        let definition = make(&mut random);
        match verdict(&definition) {
            Verdict::Proven(certificate) => {
                let claims = claims(&definition, &certificate);
                wrong.extend(change(&mut random, &definition, None, &claims, 4));
                right += 1;
            }
            Verdict::Jumps { .. } => {
                let claim = [definition.invariant.clone()];
                let found = change(&mut random, &definition, None, &claim, 3);
                contradicted += usize::from(found.is_some());
            }
            Verdict::Undecided { .. } => {}
            found => panic!("{definition:?}: {found:?}"),
        }
    }
    println!("{right} proven, {contradicted} changing, of {count}");
    assert!(wrong.is_empty(), "{} of {count}: {wrong:#?}", wrong.len());
    assert!(100 * right >= proven * count, "{right} proven of {count}");
    assert!(
        100 * contradicted >= caught * count,
        "{contradicted} of {count} are seen to change"
    );
}

#[test]
fn walls_in_sums_that_may_be_empty() {
    follow(41, make::wall, 15, 15);
}

#[test]
fn conditions_with_poles() {
    follow(42, make::condition, 15, 15);
}

/// What is proven of functions in Rust holds for smooth ones; it does not for others, so that
/// certificates name them.
#[test]
fn functions_in_rust() {
    let mut random = Random(43);
    let count = cases(200, 6000);
    let (mut proven, mut needed) = (0, 0);
    for _ in 0..count {
        let definition = make::function(&mut random);
        let Verdict::Proven(certificate) = verdict(&definition) else {
            continue;
        };
        proven += 1;
        assert_eq!(certificate.functions, ["V"], "{definition:?}");
        let claims = claims(&definition, &certificate);
        for _ in 0..2 {
            let smooth = random.pick(FUNCTIONS);
            let found = change(&mut random, &definition, Some(smooth), &claims, 2);
            assert_eq!(found, None);
        }
        let rough = random.pick(ROUGH);
        let statement = [definition.invariant.clone()];
        needed +=
            usize::from(change(&mut random, &definition, Some(rough), &statement, 4).is_some());
    }
    println!("{proven} proven of {count}, {needed} of them false for others");
    assert!(2 * proven > count, "{proven} proven of {count}");
    assert!(10 * needed > proven, "{needed} of {proven} need smoothness");
}

/// Statements that were proven and are false, each with the rule that was at fault.
#[test]
fn proofs_that_were_wrong_are_refused() {
    for (fault, [signature, sizes, parameters, h, invariant], force) in make::WRONG {
        let mut model = system(signature, sizes, parameters, h);
        make::force(&mut model, force);
        let node = parse(&mut model, invariant);
        let found = is_invariant(&model, node, None);
        assert!(matches!(found, Verdict::Jumps { .. }), "{fault}: {found:?}");
    }
    for (why, [signature, sizes, parameters, h, invariant]) in make::RIGHT {
        let mut model = system(signature, sizes, parameters, h);
        let node = parse(&mut model, invariant);
        let found = is_invariant(&model, node, None);
        assert!(found.is_proven(), "{why}: {found:?}");
    }
}

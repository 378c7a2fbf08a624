//! The choice of a splitting: its composition keeps H best for its cost.
//!
//! Input: candidates. Output: one of them, its pieces in order, outermost first. Invariant: the
//! error is measured, by the composition A(h/2)…Z(h)…A(h/2) along short orbits from points of both
//! signs near unit size; splittings whose pieces keep all declared invariants come before others.

use super::Reasons;
use super::cover::SolvedSum;
use crate::dag::{Map, Node};
use crate::flows::space::Space;
use crate::flows::space::tape::{LANES, Lanes, Tape};
use crate::list::IntoList;
use crate::model::EXPONENTIAL;
use crate::sort::Arrange;

/// The step, and how many there are.
const STEP: f64 = 0.1;
const STEPS: usize = 32;
/// The most orders that are tried.
const TRIALS: usize = 40;
/// The most operations of all runs together, each on all orbits: a run is not begun past them.
const OPERATIONS: usize = 100_000;
/// Past this an orbit has ended: rounding would decide what functions of such numbers are.
const FAR: f64 = 1e6;
/// Errors closer than this are a tie.
const TIE: f64 = 1.1;

/// A flow, ready for half a step and for a whole one.
struct Prepared {
    tape: Tape,
    half: Vec<Lanes>,
    whole: Vec<Lanes>,
    moved: Vec<usize>,
    /// True if the tape is that of z + c·J∇h, of a form h, whose exponential acts.
    is_exponential: bool,
}

/// The terms of an exponential: the flows act on points near unit size for a time of a tenth.
const TERMS: usize = 12;

impl Prepared {
    fn act(&mut self, z: &mut [Lanes], is_whole: bool) {
        if !self.is_exponential {
            self.step(z, is_whole);
            return;
        }
        // Δₖ = c·M·Δₖ₋₁/k, as differences of the affine map.
        let mut there = z.to_vec();
        self.step(&mut there, is_whole);
        let less = |a: &[Lanes], b: &[Lanes]| -> Vec<Lanes> {
            let pairs = a.iter().zip(b);
            let lanes = pairs.map(|(a, b)| std::array::from_fn(|lane| a[lane] - b[lane]));
            lanes.into_list()
        };
        let first = less(&there, z);
        let (start, mut term) = (z.to_vec(), first.clone());
        for k in 2..TERMS {
            let mut at = start.clone();
            for (x, step) in at.iter_mut().zip(&term) {
                for lane in 0..ORBITS {
                    x[lane] += step[lane];
                }
            }
            let mut next = at.clone();
            self.step(&mut next, is_whole);
            for (sum, step) in z.iter_mut().zip(&term) {
                for lane in 0..ORBITS {
                    sum[lane] += step[lane];
                }
            }
            term = less(&less(&next, &at), &first);
            for step in term.iter_mut().flatten() {
                *step /= k as f64;
            }
        }
    }

    fn step(&mut self, z: &mut [Lanes], is_whole: bool) {
        let Prepared {
            tape,
            half,
            whole,
            moved,
            ..
        } = self;
        let numbers = if is_whole { whole } else { half };
        tape.run(z, numbers);
        let (images, domain) = tape.results.split_at(moved.len());
        for lane in 0..ORBITS {
            let is_inside = domain.iter().all(|holds| numbers[*holds][lane] != 0.0);
            for (bit, image) in moved.iter().zip(images) {
                z[*bit][lane] = if is_inside {
                    numbers[*image][lane]
                } else {
                    f64::NAN
                };
            }
        }
    }
}

/// A candidate with its pieces in some order.
struct Trial {
    /// The number of the candidate.
    candidate: usize,
    order: Vec<usize>,
    /// The error times the cost of a step; infinite where no orbit could be followed.
    loss: f64,
    error: f64,
    /// True if the outermost piece moves momenta.
    kicks_outside: bool,
}

/// The best candidate, its pieces in order, and why it is. Among those that tie with the least loss the first is
/// chosen that does not kick outermost. Candidates come in an order that follows from H alone.
pub(crate) fn best(
    space: &mut Space,
    h: Node,
    candidates: Vec<Vec<SolvedSum>>,
    invariants: &[Node],
) -> Option<(Vec<SolvedSum>, Reasons)> {
    let mut energy = space.tape(&[h]).map(|tape| {
        let numbers = tape.prepared(0.0);
        (tape, numbers)
    });
    let (mut tried, mut least): (Vec<Trial>, f64) = (Vec::new(), f64::INFINITY);
    let (mut trials, mut operations, mut keep) = (0, 0, false);
    // Candidates share sums: each is made a piece once.
    let mut made: Vec<Prepared> = Vec::new();
    let mut numbers: Map<Node, Option<usize>> = Map::default();
    for (candidate, pieces) in candidates.iter().enumerate() {
        let keeps = keeps(space, pieces, invariants);
        if keep && !keeps {
            continue;
        }
        if keeps && !keep {
            (keep, least) = (true, f64::INFINITY);
            tried.clear();
        }
        let number = |solved: &SolvedSum| match numbers.get(&solved.node) {
            Some(known) => *known,
            None => {
                let number = piece(space, solved).map(|piece| {
                    made.push(piece);
                    made.len() - 1
                });
                numbers.insert(solved.node, number);
                number
            }
        };
        let own: Option<Vec<usize>> = pieces.iter().map(number).collect();
        for order in orders(space, pieces) {
            if (trials == TRIALS || operations > OPERATIONS) && !tried.is_empty() {
                break;
            }
            trials += 1;
            let cost = (2 * pieces.len() - 2).max(1) as f64;
            let error = match (&mut energy, &own) {
                (Some(energy), Some(own)) => {
                    let order: Vec<usize> = order.iter().map(|at| own[*at]).into_list();
                    let most = least * TIE / cost;
                    error(space, energy, &mut made, &order, most, &mut operations)
                }
                _ => f64::NAN,
            };
            // The least of a number and NaN is the number.
            let loss = (error * cost).min(f64::INFINITY);
            least = least.min(loss);
            let outer = space.set(pieces[order[0]].node);
            tried.push(Trial {
                candidate,
                order,
                loss,
                error,
                kicks_outside: outer.sides().0,
            });
        }
    }
    let ties = tried.iter().filter(|trial| trial.loss <= least * TIE);
    let chosen = ties.min_by_key(|trial| trial.kicks_outside)?;
    let pieces = &candidates[chosen.candidate];
    let ordered = chosen
        .order
        .iter()
        .map(|at| pieces[*at].clone())
        .into_list();
    let reasons = Reasons {
        error: chosen.error,
        among: trials,
        keeps_invariants: keep,
    };
    Some((ordered, reasons))
}

/// Returns true if all pieces keep all invariants.
fn keeps(space: &mut Space, pieces: &[SolvedSum], invariants: &[Node]) -> bool {
    !invariants.is_empty()
        && pieces.iter().all(|piece| {
            invariants
                .iter()
                .all(|invariant| space.is_kept(*invariant, piece.node))
        })
}

/// The orders worth trying: all of up to three pieces; of more, the two dearest outermost and
/// innermost, as all others act twice a step.
fn orders(space: &mut Space, pieces: &[SolvedSum]) -> Vec<Vec<usize>> {
    match pieces.len() {
        0 | 1 => vec![(0..pieces.len()).into_list()],
        2 => vec![vec![0, 1], vec![1, 0]],
        3 => [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ]
        .map(|order| order.to_vec())
        .to_vec(),
        count => {
            let mut by_cost: Vec<usize> = (0..count).into_list();
            let cost = |solved: &SolvedSum| {
                let roots: Vec<Node> = solved.flow.motion.moves.iter().map(|m| m.value).into_list();
                space.model.dag.reachable(&roots).len()
            };
            by_cost.arrange_by_key(|at| cost(&pieces[*at]));
            let (last, first) = (by_cost.pop(), by_cost.pop());
            let mut order: Vec<usize> = first.into_iter().into_list();
            order.extend(by_cost);
            order.extend(last);
            let mut reversed = order.clone();
            reversed.reverse();
            vec![order, reversed]
        }
    }
}

fn piece(space: &mut Space, solved: &SolvedSum) -> Option<Prepared> {
    let images = solved.flow.motion.images(space.dag());
    let mut roots: Vec<Node> = images.iter().map(|(_, image)| *image).into_list();
    roots.extend(&solved.flow.motion.domain);
    let moved = images.iter().map(|(leaf, _)| space.set(*leaf).number());
    let moved = moved.into_list();
    let tape = space.tape(&roots)?;
    Some(Prepared {
        half: tape.prepared(STEP / 2.0),
        whole: tape.prepared(STEP),
        is_exponential: solved.flow.forms == [EXPONENTIAL],
        tape,
        moved,
    })
}

/// The points orbits start from: (coordinates, momenta) by the number of the variable.
fn start(orbit: usize, bit: usize) -> f64 {
    let spread = ((bit * 7 + orbit * 3) % 11) as f64 / 22.0;
    let sign = if (bit + orbit * (1 + bit / 2)) % 3 == 1 {
        -1.0
    } else {
        1.0
    };
    match orbit {
        0 => 0.7 + spread,
        // Far out and slow: radii outside horizons and centres.
        3 if bit.is_multiple_of(2) => 4.0 + spread,
        3 => sign * 0.3 * (0.7 + spread),
        _ => sign * (0.7 + spread),
    }
}

/// The root of an error, so that the product over all orbits is their mean: of functions that round alike on every
/// platform.
fn root(error: f64, orbits: usize) -> f64 {
    match orbits {
        1 => error,
        2 => error.sqrt(),
        3 => hamiltonian_real::Real::cbrt(error),
        _ => error.sqrt().sqrt(),
    }
}

/// An orbit a lane.
const ORBITS: usize = LANES;

/// The mean error of H over the orbits; NaN where no orbit stays in all domains, and some number past
/// `most` where it is larger than that.
fn error(
    space: &Space,
    (energy, numbers): &mut (Tape, Vec<Lanes>),
    pieces: &mut [Prepared],
    order: &[usize],
    most: f64,
    operations: &mut usize,
) -> f64 {
    let lanes = |bit: usize| std::array::from_fn(|orbit| start(orbit, bit));
    let mut z: Vec<Lanes> = (0..2 * space.pairs.len()).map(lanes).into_list();
    let mut value = |z: &[Lanes]| {
        energy.run(z, numbers);
        numbers[energy.results[0]]
    };
    let first = value(&z);
    let count = first.iter().filter(|value| value.is_finite()).count();
    if count == 0 {
        return f64::NAN;
    }
    // An orbit that ends is an error of the size of H.
    let size = first.map(|first| first.abs() + 1.0);
    let mut largest = [1e-14; ORBITS];
    let mut mean = 0.0;
    let lengths = order.iter().map(|at| 2 * pieces[*at].tape.len());
    let a_step = lengths.sum::<usize>();
    let (last, outer) = (order[order.len() - 1], &order[..order.len() - 1]);
    for step in 0..STEPS {
        for at in outer {
            pieces[*at].act(&mut z, false);
        }
        pieces[last].act(&mut z, true);
        for at in outer.iter().rev() {
            pieces[*at].act(&mut z, false);
        }
        let now = value(&z);
        *operations += a_step;
        for orbit in 0..ORBITS {
            let off = (now[orbit] - first[orbit]).abs();
            let is_near = off.is_finite() && z.iter().all(|x| x[orbit].abs() < FAR);
            let off = if is_near { off } else { f64::INFINITY };
            largest[orbit] = off.max(largest[orbit]).min(size[orbit]);
        }
        // It only grows, so that one that is too large now is so at the end.
        if step % 2 == 1 {
            let orbits = (0..ORBITS).filter(|orbit| size[*orbit].is_finite());
            let is_largest = orbits.clone().all(|orbit| largest[orbit] == size[orbit]);
            mean = orbits.map(|orbit| root(largest[orbit], count)).product();
            if mean > most || is_largest {
                break;
            }
        }
    }
    mean
}

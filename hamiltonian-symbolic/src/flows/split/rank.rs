//! The choice of a splitting: its composition keeps H best for its cost.
//!
//! Input: candidates. Output: one of them, its pieces in order, outermost first. Invariant: the
//! error is measured, by the composition A(h/2)…Z(h)…A(h/2) along short orbits from points of both
//! signs near unit size; splittings whose pieces keep all declared invariants come before others.

use super::Reasons;
use super::cover::Block;
use crate::dag::{Map, Node};
use crate::flows::space::Space;
use crate::flows::space::tape::{LANES, Lanes, Tape};
use crate::model::EXPONENTIAL;
use crate::sort::Arrange;

/// The step, and how many there are.
const STEP: f64 = 0.1;
const STEPS: usize = 32;
/// The most orders that are tried.
const TRIALS: usize = 40;
/// The most operations of all runs together, each on all orbits: a run is not begun past them.
const OPERATIONS: usize = 100_000;
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
            lanes.collect()
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

/// The best candidate, its pieces in order, and why it is.
pub(crate) fn best(
    space: &mut Space,
    h: Node,
    candidates: Vec<Vec<Block>>,
    invariants: &[Node],
) -> Option<(Vec<Block>, Reasons)> {
    let mut energy = space.tape(&[h]).map(|tape| {
        let numbers = tape.prepared(0.0);
        (tape, numbers)
    });
    let mut chosen: Option<(f64, usize, Vec<Block>, Reasons)> = None;
    let (mut trials, mut operations) = (0, 0);
    // Candidates share blocks: each is made a piece once.
    let mut made: Vec<Prepared> = Vec::new();
    let mut numbers: Map<Node, Option<usize>> = Map::default();
    for pieces in candidates {
        let keeps = keeps(space, &pieces, invariants);
        let others_keep = chosen
            .as_ref()
            .map(|(.., reasons)| reasons.keeps_invariants);
        if others_keep == Some(true) && !keeps {
            continue;
        }
        let number = |block: &Block| match numbers.get(&block.node) {
            Some(known) => *known,
            None => {
                let number = piece(space, block).map(|piece| {
                    made.push(piece);
                    made.len() - 1
                });
                numbers.insert(block.node, number);
                number
            }
        };
        let own: Option<Vec<usize>> = pieces.iter().map(number).collect();
        for order in orders(space, &pieces) {
            if (trials == TRIALS || operations > OPERATIONS) && chosen.is_some() {
                break;
            }
            trials += 1;
            let cost = if pieces.len() == 1 {
                1
            } else {
                2 * pieces.len() - 2
            };
            let outer = space.set(pieces[order[0]].node);
            let mirrored = usize::from(outer.sides().0);
            // Below this it is better.
            let most = match &chosen {
                Some((best, other, _, reasons))
                    if best.is_finite() && reasons.keeps_invariants == keeps =>
                {
                    let factor = if mirrored < *other { TIE } else { 1.0 / TIE };
                    best * factor / cost as f64
                }
                _ => f64::INFINITY,
            };
            let error = match (&mut energy, &own) {
                (Some(energy), Some(own)) => {
                    let order: Vec<usize> = order.iter().map(|at| own[*at]).collect();
                    error(space, energy, &mut made, &order, most, &mut operations)
                }
                _ => f64::NAN,
            };
            let is_better = match &chosen {
                Some((.., reasons)) => reasons.keeps_invariants != keeps || error < most,
                None => true,
            };
            if is_better {
                let ordered = order.iter().map(|at| pieces[*at].clone()).collect();
                let reasons = Reasons {
                    error,
                    among: 0,
                    keeps_invariants: keeps,
                };
                chosen = Some((error * cost as f64, mirrored, ordered, reasons));
            }
        }
    }
    chosen.map(|(_, _, pieces, reasons)| {
        let among = trials;
        (pieces, Reasons { among, ..reasons })
    })
}

/// Returns true if all pieces keep all invariants.
fn keeps(space: &mut Space, pieces: &[Block], invariants: &[Node]) -> bool {
    !invariants.is_empty()
        && pieces.iter().all(|piece| {
            invariants
                .iter()
                .all(|invariant| space.commute(*invariant, piece.node))
        })
}

/// The orders worth trying: all of up to three pieces; of more, the two dearest outermost and
/// innermost, as all others act twice a step.
fn orders(space: &mut Space, pieces: &[Block]) -> Vec<Vec<usize>> {
    match pieces.len() {
        0 | 1 => vec![(0..pieces.len()).collect()],
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
            let mut by_cost: Vec<usize> = (0..count).collect();
            let cost = |block: &Block| {
                let roots: Vec<Node> = block.flow.motion.moves.iter().map(|m| m.value).collect();
                space.model.dag.reachable(&roots).len()
            };
            by_cost.arrange_by_key(|at| cost(&pieces[*at]));
            let (last, first) = (by_cost.pop(), by_cost.pop());
            let mut order: Vec<usize> = first.into_iter().collect();
            order.extend(by_cost);
            order.extend(last);
            let mut reversed = order.clone();
            reversed.reverse();
            vec![order, reversed]
        }
    }
}

fn piece(space: &mut Space, block: &Block) -> Option<Prepared> {
    let images = block.flow.motion.images(space.dag());
    let mut roots: Vec<Node> = images.iter().map(|(_, image)| *image).collect();
    roots.extend(&block.flow.motion.domain);
    let moved = images.iter().map(|(leaf, _)| space.set(*leaf).number());
    let moved = moved.collect();
    let tape = space.tape(&roots)?;
    Some(Prepared {
        half: tape.prepared(STEP / 2.0),
        whole: tape.prepared(STEP),
        is_exponential: block.flow.rows == [EXPONENTIAL],
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
    let mut z: Vec<Lanes> = (0..2 * space.pairs.len()).map(lanes).collect();
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
            let off = if off.is_finite() { off } else { f64::INFINITY };
            largest[orbit] = off.max(largest[orbit]).min(size[orbit]);
        }
        // It only grows, so that one that is too large now is so at the end.
        if step % 2 == 1 {
            let orbits = (0..ORBITS).filter(|orbit| size[*orbit].is_finite());
            let is_largest = orbits.clone().all(|orbit| largest[orbit] == size[orbit]);
            let sum: f64 = orbits.map(|orbit| largest[orbit].ln()).sum();
            mean = (sum / count as f64).exp();
            if mean > most || is_largest {
                break;
            }
        }
    }
    mean
}

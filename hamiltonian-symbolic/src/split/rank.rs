//! Which splitting is best: the one whose composition keeps H best for what it costs.
//!
//! Input: candidates. Output: one of them, its pieces in order, outermost first. Invariant: the
//! error is measured, by the composition A(h/2)…Z(h)…A(h/2) along short orbits from points of both
//! signs near unit size; splittings whose pieces keep all declared invariants come before others.

use super::cover::Block;
use super::space::Space;
use super::tape::Tape;
use crate::dag::Node;

/// The step, and how many there are.
const STEP: f64 = 0.1;
const STEPS: usize = 32;
/// The most orders that are tried.
const TRIALS: usize = 40;
/// The most operations of all runs together: a run is not begun past them.
const OPERATIONS: usize = 1_000_000;
/// Errors closer than this are a tie.
const TIE: f64 = 1.1;

/// A choice.
pub(crate) struct Choice {
    pub(crate) pieces: Vec<Block>,
    /// The mean of max|H − H₀| over the orbits.
    pub(crate) error: f64,
    /// Whether each piece keeps each declared invariant.
    pub(crate) keeps_invariants: bool,
    /// How many candidates with their orders there were.
    pub(crate) among: usize,
}

struct Piece {
    tape: Tape,
    moved: Vec<usize>,
}

/// The best candidate.
pub(crate) fn best(
    space: &mut Space,
    h: Node,
    candidates: Vec<Vec<Block>>,
    invariants: &[Node],
) -> Option<Choice> {
    let energy = Tape::of(space, &[h]);
    let mut chosen: Option<(f64, usize, Choice)> = None;
    let (mut trials, mut operations) = (0, 0);
    for pieces in candidates {
        let keeps = keeps(space, &pieces, invariants);
        let tapes: Option<Vec<Piece>> = pieces.iter().map(|b| piece(space, b)).collect();
        for order in orders(space, &pieces) {
            if (trials == TRIALS || operations > OPERATIONS) && chosen.is_some() {
                break;
            }
            trials += 1;
            let lengths = tapes.iter().flatten().map(|piece| piece.tape.len());
            operations += 2 * STEPS * ORBITS * lengths.sum::<usize>();
            let error = match (&energy, &tapes) {
                (Some(energy), Some(tapes)) => error(space, energy, tapes, &order),
                _ => f64::NAN,
            };
            let cost = if pieces.len() == 1 {
                1
            } else {
                2 * pieces.len() - 2
            };
            let price = error * cost as f64;
            let outer = space.set(pieces[order[0]].node);
            let mirrored = usize::from(outer & 0x5555_5555_5555_5555 != 0);
            let is_better = match &chosen {
                None => true,
                Some((best, other, choice)) => match (keeps, choice.keeps_invariants) {
                    (true, false) => true,
                    (false, true) => false,
                    _ if !price.is_finite() => false,
                    _ if !best.is_finite() => true,
                    _ if price < best / TIE => true,
                    _ => price < best * TIE && mirrored < *other,
                },
            };
            if is_better {
                let choice = Choice {
                    pieces: order.iter().map(|at| pieces[*at].clone()).collect(),
                    error,
                    keeps_invariants: keeps,
                    among: 0,
                };
                chosen = Some((price, mirrored, choice));
            }
        }
    }
    chosen.map(|(_, _, choice)| Choice {
        among: trials,
        ..choice
    })
}

/// Whether all pieces keep all invariants.
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
            by_cost.sort_by_key(|at| cost(&pieces[*at]));
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

fn piece(space: &mut Space, block: &Block) -> Option<Piece> {
    let images = block.flow.motion.images(space.dag());
    let mut roots: Vec<Node> = images.iter().map(|(_, image)| *image).collect();
    roots.extend(&block.flow.motion.domain);
    let moved = images
        .iter()
        .map(|(leaf, _)| space.set(*leaf).trailing_zeros() as usize);
    let moved = moved.collect();
    Some(Piece {
        tape: Tape::of(space, &roots)?,
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

const ORBITS: usize = 4;

/// The mean error of H over the orbits; NaN where no orbit stays in all domains.
fn error(space: &Space, energy: &Tape, pieces: &[Piece], order: &[usize]) -> f64 {
    let (mut numbers, mut results) = (Vec::new(), Vec::new());
    let mut sum = 0.0;
    let mut count = 0;
    for orbit in 0..ORBITS {
        let mut z: Vec<f64> = (0..2 * space.pairs.len())
            .map(|bit| start(orbit, bit))
            .collect();
        let mut value = |z: &[f64]| {
            energy.run(z, 0.0, &mut numbers, &mut results);
            results[0]
        };
        let first = value(&z);
        if !first.is_finite() {
            continue;
        }
        let mut largest: f64 = 0.0;
        let (mut scratch, mut out) = (Vec::new(), Vec::new());
        let mut act = |z: &mut Vec<f64>, at: usize, c: f64| {
            let piece = &pieces[at];
            piece.tape.run(z, c, &mut scratch, &mut out);
            let (images, domain) = out.split_at(piece.moved.len());
            let is_inside = domain.iter().all(|holds| *holds != 0.0);
            for (bit, image) in piece.moved.iter().zip(images) {
                z[*bit] = if is_inside { *image } else { f64::NAN };
            }
        };
        let (last, outer) = (order[order.len() - 1], &order[..order.len() - 1]);
        for _ in 0..STEPS {
            for at in outer {
                act(&mut z, *at, STEP / 2.0);
            }
            act(&mut z, last, STEP);
            for at in outer.iter().rev() {
                act(&mut z, *at, STEP / 2.0);
            }
            let off = (value(&z) - first).abs();
            if !off.is_finite() {
                largest = f64::INFINITY;
                break;
            }
            largest = largest.max(off);
        }
        // An orbit that ends is an error of the size of H.
        sum += largest.min(first.abs() + 1.0).max(1e-14).ln();
        count += 1;
    }
    if count == 0 {
        f64::NAN
    } else {
        (sum / f64::from(count)).exp()
    }
}

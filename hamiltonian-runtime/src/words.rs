//! Numbers over packs as words, lane by lane.
//!
//! Input: a number over a pack. Output: its words, the number of a lane, a function of each lane. Invariant: the bits are
//! those of single numbers; no pack has code of its own for these functions, which are long and are called seldom.

use hamiltonian_lanes::Real;

/// The most words of a number that is taken apart.
const WORDS: usize = 128;

/// True for numbers over a pack, of few words, with this number of dual numbers inside each other.
pub(crate) const fn is_pack<T: Real>(duals: u32) -> bool {
    T::LANES > 1 && T::DUALS == duals && (T::LANES as usize) << duals <= WORDS
}

/// The words of a number over a pack: the lanes of the value, then those of its derivative.
pub(crate) fn words_of<T: Real>(x: T) -> [f64; WORDS] {
    let (mut words, mut next) = ([0.0; WORDS], 0);
    x.write_words(&mut |word| {
        words[next % WORDS] = word;
        next += 1;
    });
    words
}

/// The number with these words.
pub(crate) fn of_words<T: Real>(words: &[f64]) -> T {
    let mut words = words.iter();
    T::read_words(&mut || words.next().copied().unwrap_or(f64::NAN))
}

/// The number of a lane.
pub(crate) fn lane_of<E: Real>(words: &[f64], lane: usize, lanes: usize) -> E {
    let mut parts = words.iter().skip(lane).step_by(lanes);
    E::read_words(&mut || parts.next().copied().unwrap_or(f64::NAN))
}

/// Writes the number of a lane.
pub(crate) fn set_lane<E: Real>(words: &mut [f64], lane: usize, lanes: usize, x: E) {
    let mut places = words.iter_mut().skip(lane).step_by(lanes);
    x.write_words(&mut |word| {
        if let Some(place) = places.next() {
            *place = word;
        }
    });
}

/// A function of two numbers over a pack by that of each lane, which are numbers `E`.
#[inline(always)]
pub(crate) fn of_two<T: Real, E: Real>(at: [T; 2], f: impl Fn([E; 2]) -> E) -> T {
    let lanes = T::LANES as usize;
    let at = at.map(words_of);
    let mut found = [0.0; WORDS];
    for lane in 0..lanes {
        let value = f(at.each_ref().map(|words| lane_of(words, lane, lanes)));
        set_lane(&mut found, lane, lanes, value);
    }
    of_words(&found)
}

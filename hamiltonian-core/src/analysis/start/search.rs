//! Solutions of H = E along one momentum.
//!
//! Input: H − E and its slope as functions of the momentum, a guess. Output: up to two roots on each side
//! of it, and the sample nearest to H = E. Invariant: a root is bracketed before it is refined.

use super::is_negative;
use hamiltonian_lanes::{Mask, Real};

/// H − E at one value of the momentum.
#[derive(Debug, Clone, Copy)]
pub(super) struct EnergySample<T> {
    pub(super) x: T,
    pub(super) f: T,
    pub(super) slope: T,
}

/// The largest number of samples of one walk; each doubles its step.
const LONGEST: usize = 400;
/// The largest number of refinements of one bracket: bisection alone needs 64, or 110 in
/// double-double.
pub(super) const FINEST: usize = 300;

/// A search for roots along the momentum.
pub(super) struct MomentumSearch<'a, T, F, G> {
    pub(super) at: &'a mut F,
    /// The size of the terms that cancel in H − E.
    pub(super) size: &'a mut G,
    /// At most the guess and two on each side.
    pub(super) roots: [Option<EnergySample<T>>; 5],
    pub(super) closest: EnergySample<T>,
}

impl<T: Real, F: FnMut(T) -> EnergySample<T>, G: FnMut(T) -> f64> MomentumSearch<'_, T, F, G> {
    pub(super) fn push(&mut self, root: EnergySample<T>) {
        if let Some(place) = self.roots.iter_mut().find(|place| place.is_none()) {
            *place = Some(root);
        }
    }

    /// Walks from the guess in one direction with doubling steps, and records up to two roots.
    pub(super) fn walk(&mut self, guess: EnergySample<T>, direction: T) {
        let mut last = guess;
        // At a root, the sign is that of the next value.
        let mut negative = sign_after(&last, direction);
        let newton = Real::abs((last.f / last.slope).to_f64());
        let default = Real::abs(last.x.to_f64()).max(1.0) / 1024.0;
        let mut step = if newton.is_finite() && newton > 0.0 {
            newton
        } else {
            default
        };
        let mut edge = 0;
        let mut count = 0;
        for _ in 0..LONGEST {
            let next = (self.at)(direction.fma(T::constant(step, 0.0), last.x));
            if next.x.equals(last.x).all() {
                return;
            }
            if !next.f.is_finite() || !next.slope.is_finite() {
                // At the edge of the domain of H, steps towards it decrease.
                edge += 1;
                step /= 4.0;
                if edge > 30 {
                    return;
                }
                continue;
            }
            self.note(next);
            if next.f.equals(T::zero()).all() {
                self.push(next);
                count += 1;
                negative = sign_after(&next, direction);
            } else if is_negative(next.f) != negative {
                let root = self.refine(last, next);
                self.push(root);
                count += 1;
                negative = !negative;
            } else {
                // The growth of |H − E| on the way.
                let rate = |s: &EnergySample<T>| {
                    let slope = s.slope * direction;
                    (if negative { -slope } else { slope }).to_f64()
                };
                let (before, after) = (rate(&last), rate(&next));
                if before < 0.0 && after > 0.0 {
                    let turn = self.turn(last, next, negative);
                    self.note(turn);
                    if turn.f.magnitude() <= 8.0 * T::epsilon() * (self.size)(turn.x) {
                        self.push(turn);
                    } else if is_negative(turn.f) != negative {
                        let (first, second) = (self.refine(last, turn), self.refine(turn, next));
                        self.push(first);
                        self.push(second);
                    }
                    return;
                }
                if before >= 0.0 && after >= before && after > 0.0 {
                    // The values move away from E, and no slower than before.
                    return;
                }
            }
            if count == 2 {
                return;
            }
            last = next;
            if edge == 0 {
                step *= 2.0;
            }
        }
    }

    fn note(&mut self, sample: EnergySample<T>) {
        if sample.f.magnitude() < self.closest.f.magnitude() {
            self.closest = sample;
        }
    }

    /// The root between two samples of different signs: Newton's iteration, bisection where that
    /// leaves the bracket or is slow.
    fn refine(&mut self, a: EnergySample<T>, b: EnergySample<T>) -> EnergySample<T> {
        let (mut low, mut high) = if is_negative(a.f) || is_negative(-b.f) {
            (a, b)
        } else {
            (b, a)
        };
        let mut best = if low.f.magnitude() < high.f.magnitude() {
            low
        } else {
            high
        };
        let mut width = Real::abs((high.x - low.x).to_f64());
        for _ in 0..FINEST {
            let newton = best.x - best.f / best.slope;
            let between = |x: T| {
                (low.x.lt(x).all() && x.lt(high.x).all())
                    || (high.x.lt(x).all() && x.lt(low.x).all())
            };
            let half = low.x + (high.x - low.x) * T::constant(0.5, 0.0);
            let now = Real::abs((high.x - low.x).to_f64());
            let x = if between(newton) && now <= width {
                newton
            } else {
                half
            };
            // Newton's steps must halve the bracket every other time on the average.
            width = 0.7 * width.min(now);
            if !between(x) {
                break;
            }
            let step = Real::abs((x - best.x).to_f64());
            let sample = (self.at)(x);
            let better = sample.f.magnitude() < best.f.magnitude();
            if is_negative(sample.f) {
                low = sample;
            } else {
                high = sample;
            }
            if better {
                best = sample;
            }
            let small = 0.5 * T::epsilon() * Real::abs(x.to_f64());
            if sample.f.equals(T::zero()).all() || (step <= small && !better) {
                break;
            }
        }
        best
    }

    /// The extremum between two samples with slopes of different signs, or a sample on the other
    /// side of E if one is met before.
    fn turn(&mut self, a: EnergySample<T>, b: EnergySample<T>, negative: bool) -> EnergySample<T> {
        let (mut a, mut b) = (a, b);
        let mut best = if a.f.magnitude() < b.f.magnitude() {
            a
        } else {
            b
        };
        for round in 0..FINEST {
            let secant = a.x - a.slope * (b.x - a.x) / (b.slope - a.slope);
            let half = a.x + (b.x - a.x) * T::constant(0.5, 0.0);
            let between =
                |x: T| (a.x.lt(x).all() && x.lt(b.x).all()) || (b.x.lt(x).all() && x.lt(a.x).all());
            let x = if round % 2 == 0 && between(secant) {
                secant
            } else {
                half
            };
            if !between(x) {
                break;
            }
            let sample = (self.at)(x);
            if sample.f.magnitude() < best.f.magnitude() {
                best = sample;
            }
            if is_negative(sample.f) != negative || sample.slope.equals(T::zero()).all() {
                return sample;
            }
            if is_negative(sample.slope) == is_negative(a.slope) {
                a = sample;
            } else {
                b = sample;
            }
        }
        best
    }
}

/// The root after one more step of Newton's iteration, which adds the derivative parts over duals;
/// without the step if it makes the root worse.
pub(super) fn polished<T: Real>(
    root: EnergySample<T>,
    mut at: impl FnMut(T) -> EnergySample<T>,
) -> T {
    let step = root.f / root.slope;
    let next = root.x - step;
    let small = 4.0 * T::epsilon() * Real::abs(root.x.to_f64());
    if !step.is_finite() {
        return root.x;
    }
    let gain = Real::abs(at(next).f.to_f64()) <= Real::abs(root.f.to_f64());
    if gain || Real::abs(step.to_f64()) <= small {
        next
    } else {
        root.x
    }
}

/// Returns true if H − E is negative just after a sample.
fn sign_after<T: Real>(sample: &EnergySample<T>, direction: T) -> bool {
    if sample.f.equals(T::zero()).all() {
        is_negative(sample.slope * direction)
    } else {
        is_negative(sample.f)
    }
}

//! Changes of members between two steps.
//!
//! Input: a member, and another state. Output: the value that the scheme carries from there. Invariant: a member whose
//! state stays has the bits of a run without changes.

use super::bound::ErasedScheme;
use super::guard::guard;
use crate::errors::Error;
use crate::flows::map::Clock;
use crate::observers::observe::Observer;
use crate::runs::integrator::{Part, Recipe, check_change};
use crate::schemes::scheme::Scheme;
use crate::systems::state::{Carried, State};
use crate::systems::system::{System, VectorOf};
use crate::systems::vector::Vector;
use alloc::vec::Vec;

/// A member between two steps.
pub(super) struct Standing<'a, S: System, M> {
    pub(super) scheme: &'a M,
    pub(super) prepared: &'a S::Prepared<f64>,
    pub(super) step: f64,
    pub(super) clock: Clock<f64>,
    /// The number of steps made.
    pub(super) made: u64,
}

impl<S: System, M: Scheme<S>> Standing<'_, S, M> {
    /// Lets a closure change the state, and returns the state from which the member goes on, if that is another one. Then
    /// `words` has the carried value there, and the observer has received the change. A change that is refused leaves
    /// `words` as they were.
    pub(super) fn change<O: Observer<f64, S>>(
        &self,
        state: &State<VectorOf<S>>,
        closure: impl FnOnce(&mut State<VectorOf<S>>),
        observer: &mut O,
        words: &mut Vec<f64>,
    ) -> Result<Option<State<VectorOf<S>>>, Error> {
        let mut to = state.clone();
        guard(|| closure(&mut to))?;
        if is_same(state, &to) {
            return Ok(None);
        }
        check_change::<f64, S>(self.prepared, state, &mut to)?;
        let mut carried = Vec::with_capacity(words.len());
        ErasedScheme::<S>::begin(self.scheme, self.prepared, &to, self.step, &mut carried)?;
        let [from, after] = [state, &to].map(|state| self.part(state));
        let [from, after] = [&from, &after].map(|part| part.view(self.made));
        guard(|| observer.change(&from, &after))?;
        words.clone_from(&carried);
        Ok(Some(to))
    }

    /// The member at a state between two steps.
    pub(super) fn part<'a>(
        &'a self,
        state: &'a State<VectorOf<S>>,
    ) -> Part<'a, f64, S, M::Map<f64>> {
        let recipe: &dyn Recipe<f64, S, M::Map<f64>> = self.scheme;
        let carried = recipe.start(self.prepared, state, self.step);
        Part {
            prepared: self.prepared,
            recipe,
            state,
            step: self.step,
            clock: self.clock,
            duration: carried.duration(self.clock.interval),
            last: None,
        }
    }
}

/// Returns true if all numbers of both are the same, bit by bit.
fn is_same<V: Vector<Scalar = f64>>(a: &State<V>, b: &State<V>) -> bool {
    let same = |a: &V, b: &V| {
        let bits = |v: &V, i| v.component(i).to_bits();
        a.len() == b.len() && (0..a.len()).all(|i| bits(a, i) == bits(b, i))
    };
    a.t.to_bits() == b.t.to_bits() && same(&a.q, &b.q) && same(&a.p, &b.p)
}

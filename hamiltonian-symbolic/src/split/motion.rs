//! Motions one after the other.
//!
//! Input: motions of a space. Output: their composition, and the variables they move. Invariant: values
//! are functions of the point before the first.

use super::space::{Set, Space};
use crate::flow::{Motion, Move};

impl Motion {
    /// The variables that move.
    pub(crate) fn moved(&self, space: &mut Space) -> Set {
        self.moves.iter().fold(0, |set, m| set | space.set(m.leaf))
    }

    /// This motion, then another.
    pub(crate) fn then(mut self, space: &mut Space, other: &Motion) -> Motion {
        let images = self.images(space.dag());
        for next in &other.moves {
            let value = space.at(next.value, &images);
            match self.moves.iter_mut().find(|m| m.leaf == next.leaf) {
                Some(known) if next.added => {
                    known.value = space.dag().add(&[known.value, value]);
                }
                Some(known) => {
                    known.value = value;
                    known.added = false;
                }
                None => self.moves.push(Move { value, ..*next }),
            }
        }
        for &condition in &other.domain {
            let condition = space.at(condition, &images);
            if !self.domain.contains(&condition) {
                self.domain.push(condition);
            }
        }
        self
    }
}

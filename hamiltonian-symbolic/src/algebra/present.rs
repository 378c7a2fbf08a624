//! Lower bounds on sizes from elements at fixed indices: a statement about q\[2\] is one about arrays of at least three
//! rows.
//!
//! Input: expressions of a statement. Output: its rooms. A room is the number of rows before or after an element at a
//! fixed index, a form over sizes that is not negative at all sizes the statement is about. For example, q\[2\] in an
//! array of N rows has the room N − 3 behind it. Invariant: only elements that are read for
//! all conditions and sizes count.

use crate::dag::{Array, Kind, Node};
use crate::index::Affine;
use crate::model::Model;
use std::borrow::Cow;

impl Model {
    /// The model with the [rooms](crate::ranges::Ranges::rooms) of the elements that some expressions read.
    pub(crate) fn with_rooms(&self, roots: &[Node]) -> Cow<'_, Model> {
        let read = self
            .dag
            .reached(roots, &mut |node, ahead| match self.dag.kind(node) {
                Kind::Reduce(..) | Kind::Select(..) => {}
                _ => self.dag.for_children(node, |child| ahead.add(child)),
            });
        let mut rooms: Vec<Affine> = Vec::new();
        for node in read {
            for room in self.rooms_of(node).into_iter().flatten() {
                let is_news = room.has_sizes() && !room.is_never_negative();
                if is_news && !rooms.contains(&room) {
                    rooms.push(room);
                }
            }
        }
        if rooms.is_empty() {
            return Cow::Borrowed(self);
        }
        let mut model = self.clone();
        model.dag.rooms = rooms;
        Cow::Owned(model)
    }

    /// The numbers of rows of an array before and after an element at a fixed index.
    fn rooms_of(&self, node: Node) -> Option<[Affine; 2]> {
        let Kind::Element(array, row, _) = self.dag.kind(node) else {
            return None;
        };
        let rows = match array {
            Array::Phase(at) => self.group_of(at.group).shape.rows(),
            Array::Parameter(parameter) => {
                let parameter = &self.parameters[usize::from(parameter.0)];
                parameter.shape.rows()
            }
            _ => None,
        };
        let is_plain = row.outer.is_none() && row.modulo.is_none() && row.variables().is_empty();
        let after = row.affine.room_below(rows.filter(|_| is_plain)?)?;
        Some([row.affine.clone(), after])
    }
}

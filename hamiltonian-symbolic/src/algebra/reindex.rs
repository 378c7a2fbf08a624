//! Loop variables replaced by indices.
//!
//! Input: an expression, one of its loop variables and the index that takes its place, which may be modulo
//! a size. Output: the expression in the new index. Invariant: loops inside that depend on the variable
//! move with it; a sum over the same loop binds the variable anew and stays.

use crate::dag::{Dag, Kind, Map, Node};
use crate::index::{Affine, Domain, Index, Loops};
use crate::ranges::Ranges;

/// The images of loops that have moved.
type LoopImages = Map<Domain, Domain>;

impl Dag {
    /// The expression with a loop variable replaced by an affine index.
    pub fn replace(&mut self, root: Node, variable: Domain, by: &Affine) -> Node {
        let image = self.reindexed(root, variable, &Index::plain(by.clone()));
        image.expect("an affine index can stand wherever a loop variable can")
    }

    /// The expression with a loop variable replaced by an index; `None` where that is modulo a size and the
    /// variable stands in an index or a range that cannot be shifted, or has several axes and the variable
    /// does more than be an index.
    pub(crate) fn reindexed(&mut self, root: Node, variable: Domain, by: &Index) -> Option<Node> {
        if by.outer.is_some() {
            return self.at_site(root, variable, by);
        }
        // All in one pass: a loop that moves may be one of `by`.
        let mut moved = LoopImages::default();
        let inside = self.inside(variable);
        let nodes = self.reachable(&[root]);
        let new = self.try_map(nodes, |dag, node, new| {
            let image = match dag.kind(node).clone() {
                _ if !dag.variables(node).meets(inside) => node,
                Kind::Variable(d) if d == variable => dag.variable_at(by)?,
                Kind::Variable(d) => {
                    let d = dag.moved(d, variable, &by.affine, &mut moved);
                    dag.variable(d)
                }
                Kind::Element(array, row, column) => {
                    let mut image = |index| dag.index_at(index, variable, by, &mut moved);
                    let row = image(row)?;
                    let column = match column {
                        Some(column) => Some(image(*column)?),
                        None => None,
                    };
                    dag.element(array, row, column)
                }
                Kind::Reduce(d, _) | Kind::Count(d) if !dag.can_move(d, variable, by) => {
                    return None;
                }
                Kind::Reduce(d, body) => {
                    let d = dag.moved(d, variable, &by.affine, &mut moved);
                    dag.reduce(d, new[&body])
                }
                Kind::Count(d) => {
                    let d = dag.moved(d, variable, &by.affine, &mut moved);
                    dag.count(d)
                }
                _ => dag.rebuild(node, &|child| new[&child]),
            };
            Some(image)
        });
        new.map(|new| new[&root])
    }

    /// The expression with a loop variable, the number of an element, replaced by the index of several axes
    /// that has this number.
    fn at_site(&mut self, root: Node, variable: Domain, by: &Index) -> Option<Node> {
        let own = Index::of_loop(variable);
        let inside = self.inside(variable);
        let nodes = self.reachable(&[root]);
        let new = self.try_map(nodes, |dag, node, new| {
            let image = match dag.kind(node).clone() {
                _ if !dag.variables(node).meets(inside) => node,
                Kind::Element(array, row, column) => {
                    let is_number = |index: &Index| index.variables().meets(inside);
                    if row != own || column.as_deref().is_some_and(is_number) {
                        return None;
                    }
                    dag.element(array, by.clone(), column.map(|column| *column))
                }
                Kind::Variable(_) | Kind::Reduce(..) | Kind::Count(_) => return None,
                _ => dag.rebuild(node, &|child| new[&child]),
            };
            Some(image)
        });
        new.map(|new| new[&root])
    }

    /// Returns true if the range of a loop has a form where the variable is replaced.
    fn can_move(&self, domain: Domain, variable: Domain, by: &Index) -> bool {
        let range = self.range(domain);
        let is_read = range.start.factor(variable) != 0 || range.end.factor(variable) != 0;
        by.modulo.is_none() || !is_read
    }

    /// The index with the variable replaced; `None` unless that is modulo one size.
    fn index_at(
        &mut self,
        index: Index,
        variable: Domain,
        by: &Index,
        moved: &mut LoopImages,
    ) -> Option<Index> {
        index.try_map(&mut |axis| self.axis_at(axis, variable, by, moved))
    }

    /// The index of one axis with a loop variable replaced.
    fn axis_at(
        &mut self,
        index: &Index,
        variable: Domain,
        by: &Index,
        moved: &mut LoopImages,
    ) -> Option<Index> {
        let image = index.substitute(|d| match d == variable {
            true => by.affine.clone(),
            false => Affine::variable(self.moved(d, variable, &by.affine, moved)),
        });
        let Some(modulo) = &by.modulo else {
            return Some(image);
        };
        match (index.affine.factor(variable), &index.modulo) {
            (0, _) => Some(image),
            (1, Some(own)) if own == modulo => Some(self.unwrapped(image)),
            // Without a modulus of its own the index is the variable itself.
            (1, None) if index.affine == Affine::variable(variable) => {
                Some(self.unwrapped(Index::wrapped(image.affine, modulo.clone())))
            }
            _ => None,
        }
    }

    /// An index as a real. `(variable + c) % modulo` is one where the loop stays in 0..modulo: it wraps
    /// around once at most, if c is −1, 0 or 1, or less than a modulus that is a number.
    fn variable_at(&mut self, index: &Index) -> Option<Node> {
        let Some(modulo) = &index.modulo else {
            return Some(self.affine(&index.affine));
        };
        let [(variable, 1)] = index.affine.loops.as_slice() else {
            return None;
        };
        let by = index.affine.shift(*variable)?.as_constant()?;
        let variable = Affine::variable(*variable);
        if !self.is_within(&variable, modulo) {
            return None;
        }
        let by = match modulo.as_constant() {
            Some(modulo) if modulo > 0 => by.rem_euclid(modulo),
            Some(_) => return None,
            None if by.abs() <= 1 => by,
            None => return None,
        };
        let inside = variable.plus(1, &Affine::constant(by));
        // Elements past either end come in at the other.
        let (bound, outside) = if by < 0 {
            (inside.clone(), inside.plus(1, modulo))
        } else {
            (inside.room_below(modulo)?, inside.plus(-1, modulo))
        };
        let holds = self.at_least_zero(&bound);
        let (inside, outside) = (self.affine(&inside), self.affine(&outside));
        Some(self.select(holds, inside, outside))
    }

    /// A loop and all loops inside it.
    fn inside(&self, variable: Domain) -> Loops {
        let all = (0..self.loop_count() as u32).map(Domain);
        all.filter(|d| self.path(Some(*d)).contains(&variable))
            .collect()
    }

    /// The image of a loop when `variable` is replaced.
    fn moved(
        &mut self,
        domain: Domain,
        variable: Domain,
        by: &Affine,
        moved: &mut LoopImages,
    ) -> Domain {
        if !self.path(Some(domain)).contains(&variable) || domain == variable {
            return domain;
        }
        if let Some(&known) = moved.get(&domain) {
            return known;
        }
        let range = self.range(domain).clone();
        let parent = match range.parent {
            Some(parent) if parent == variable => {
                let outer: Loops = self.range(variable).parent.into_iter().collect();
                self.deepest(by.variables() | outer)
            }
            Some(parent) => Some(self.moved(parent, variable, by, moved)),
            None => None,
        };
        let [start, end] = [range.start, range.end].map(|bound| {
            bound.substitute(|d| match d == variable {
                true => by.clone(),
                false => Affine::variable(self.moved(d, variable, by, moved)),
            })
        });
        let image = self.domain(parent, start, end);
        moved.insert(domain, image);
        image
    }
}

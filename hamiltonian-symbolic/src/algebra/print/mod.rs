//! Expressions as people read them: text in the language's own notation, LaTeX, and MathML of that LaTeX.
//!
//! Input: a model and a node of its arena. Output: text. Invariant: the language reads [`text`] of an
//! expression that it can say back as the same expression (up to the order of evaluation); sums and products keep the order they were written in.

mod equations;
mod latex;
mod layout;
mod mathml;
mod names;
mod text;

pub(crate) use equations::scalar_equation;
pub use equations::{Equations, hamilton_equations};
pub use mathml::mathml;
pub(crate) use names::is_taken;

use crate::dag::Node;
use crate::index::{Affine, Domain};
use crate::model::Model;

/// A notation to write.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Notation {
    /// The language's own: `p^2/(2*m) + k*x^2/2`.
    Text,
    /// LaTeX, without the dollar signs.
    Latex,
}

impl Notation {
    fn style(self) -> &'static layout::Style {
        match self {
            Notation::Text => &text::TEXT,
            Notation::Latex => &latex::LATEX,
        }
    }
}

/// A node in the language's own notation. Past some 16 000 characters the rest is written `…`.
#[must_use]
pub fn text(model: &Model, node: Node) -> String {
    write(model, node, Notation::Text)
}

/// A node in LaTeX, without the dollar signs. Past some 16 000 characters the rest is written
/// `\dots`.
#[must_use]
pub fn latex(model: &Model, node: Node) -> String {
    write(model, node, Notation::Latex)
}

/// A node in either notation.
#[must_use]
pub fn write(model: &Model, node: Node, notation: Notation) -> String {
    write_within(model, node, notation, &[])
}

/// An extent in the language's own notation: `3`, `N`.
#[must_use]
pub fn extent(model: &Model, extent: &Affine) -> String {
    layout::Writer::new(model, &text::TEXT, &[]).affine(extent)
}

/// A loop in the language's own notation: `i in 0..N`.
#[must_use]
pub(crate) fn range(model: &Model, domain: Domain) -> String {
    let writer = layout::Writer::new(model, &text::TEXT, &[]);
    let range = model.dag.range(domain);
    let (start, end) = (writer.affine(&range.start), writer.affine(&range.end));
    format!("{} in {start}..{end}", writer.variable(domain))
}

/// A node that stands inside loops whose variables have names already.
#[must_use]
pub(crate) fn write_within(
    model: &Model,
    node: Node,
    notation: Notation,
    bound: &[(Domain, &str)],
) -> String {
    layout::Writer::new(model, notation.style(), bound).write(node)
}

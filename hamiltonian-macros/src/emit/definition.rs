//! The input of emission.
//!
//! Input: the analysis of a definition. Output: [`Definition`], with the proven structure and the printed text. Invariant:
//! emission proves nothing and derives nothing.

use crate::emit::tokens::piece_type;
use hamiltonian_language::analyse::structure::{FieldSource, GradientSource, Text, Verdicts};
use hamiltonian_language::analyse::variables::Declared;
use hamiltonian_language::ast::Header;
use hamiltonian_language::checked::Checked;
use hamiltonian_symbolic::dag::Node;
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::program::Program;
use proc_macro2::{Ident, TokenStream};

/// All that emission reads.
#[derive(Debug)]
pub struct Definition<'a> {
    /// The path of the facade: `$crate`.
    pub root: &'a TokenStream,
    /// The user's tokens.
    pub checked: &'a Checked,
    /// The defaults of the parameters, number by number: expressions of the scalar `T`.
    pub defaults: &'a [Option<Vec<String>>],
    /// Of each observable the sentences about its proof.
    pub proofs: &'a [Vec<String>],
    /// The name of the piece of a split that is emitted; none for the whole system.
    pub piece: Option<&'a Ident>,
    /// The pieces that are types of their own.
    pub pieces: &'a [(Ident, Node)],
    /// The variables it was declared in, where it is integrated in others.
    pub declared: Option<&'a Declared>,
    /// The mathematics.
    pub model: &'a Model,
    /// The instructions.
    pub program: &'a Program,
    /// The source of the vector field.
    pub field: FieldSource,
    /// The source of the gradient.
    pub gradient: GradientSource,
    /// The proven structure.
    pub structure: &'a Verdicts,
    /// The printed text.
    pub text: &'a Text,
}

impl Definition<'_> {
    /// The name of the type.
    pub fn type_name(&self, item: &Header) -> Ident {
        match self.piece {
            Some(piece) => piece_type(item, piece),
            None => item.name.clone(),
        }
    }
}

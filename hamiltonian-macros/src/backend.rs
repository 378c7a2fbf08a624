//! From a checked definition to code: its analysis, then emission.
//!
//! Input: [`Checked`] and the path by which emitted code reaches the library. Output: items or an
//! expression, if they could be made; faults of the mathematics go into the report.
//! Invariant: if anything is reported, the result is dropped for the stub.

use crate::emit;
use hamiltonian_language::analyse::{Analysis, System, analyse};
use hamiltonian_language::checked::Checked;
use hamiltonian_language::report::Report;
use proc_macro2::{Ident, Span, TokenStream};

/// The code of a definition. `root` is the path of the library; emitted code names only
/// `#root::private`.
pub fn generate(checked: &Checked, root: &TokenStream, report: &mut Report) -> Option<TokenStream> {
    let analysis = analyse(checked, report)?;
    code(checked, &analysis, root, report)
}

/// The code of an analysed definition.
pub fn code(
    checked: &Checked,
    analysis: &Analysis,
    root: &TokenStream,
    report: &mut Report,
) -> Option<TokenStream> {
    let Some(defaults) = defaults(analysis) else {
        let at = Span::call_site();
        report.internal(at, "a default is not made of numbers alone");
        return None;
    };
    let frame = Frame {
        checked,
        root,
        defaults: &defaults,
        analysis,
    };
    let pieces = analysis.pieces.iter().zip(&analysis.of_pieces);
    let mut code: TokenStream = pieces
        .map(|((name, _), system)| emitted(&frame, system, Some(name)))
        .collect();
    code.extend(emitted(&frame, &analysis.whole, None));
    Some(code)
}

/// The defaults of the parameters, number by number, as expressions of the scalar `T`.
fn defaults(analysis: &Analysis) -> Option<Vec<Option<Vec<String>>>> {
    let texts = analysis.defaults.iter().map(|default| match default {
        None => Some(None),
        Some(default) => {
            let numbers = default.values.iter();
            let texts: Option<Vec<String>> = numbers
                .map(|value| emit::closed(&default.dag, *value))
                .collect();
            texts.map(Some)
        }
    });
    texts.collect()
}

/// The input that all systems of a definition share.
struct Frame<'a> {
    checked: &'a Checked,
    root: &'a TokenStream,
    defaults: &'a [Option<Vec<String>>],
    analysis: &'a Analysis,
}

/// The code of the whole system, or of a piece.
fn emitted(frame: &Frame, system: &System, piece: Option<&Ident>) -> TokenStream {
    let is_whole = piece.is_none();
    let analysis = frame.analysis;
    emit::generate(&emit::Definition {
        root: frame.root,
        checked: frame.checked,
        defaults: frame.defaults,
        proofs: &analysis.proofs,
        piece,
        pieces: if is_whole { &analysis.pieces } else { &[] },
        declared: analysis.declared.as_ref().filter(|_| is_whole),
        model: &system.model,
        program: &system.program,
        gradient: system.gradient,
        field: system.field,
        structure: &system.structure,
        text: &system.text,
    })
}

//! From a scheduled program to tokens.
//!
//! Input: [`Definition`]: a model, its program, its proven structure, and the tokens of the user. Output: the tokens of the
//! type (or the value), of everything it implements, and of its documentation. Invariants:
//!
//! - Emitted code names nothing of the user's but names the user wrote: paths begin with the
//!   private module of the facade, which is called `__h` inside; locals begin with an underscore,
//!   so that no constant of the user's can turn a binding into a pattern.
//! - Bodies are written as text and lexed once, which costs a tenth of building them token by
//!   token; the user's names, attributes and paths keep their own tokens and spans.
//! - The same definition gives the same tokens.
//!
//! | layer | input → output |
//! |---|---|
//! | `tokens` | text, and names of the user → tokens with the spans that rustc shows |
//! | `definition` | results of the back end → [`Definition`] |
//! | `names` | groups, parameters, indices, numbers → their text, and the types that store them |
//! | `steps` | steps of a program → what they read, which are written where they are used, in which order |
//! | `statements` | steps → Rust statements, loops as loops |
//! | `functions` | steps with inputs and results → bodies of functions, and the holders of their prepared values |
//! | `types` | fields → construction, storage, checks of indices, serde |
//! | `traits` | purposes → implementations of the traits of core |
//! | `items` | all of these → the item or the expression |
//!
//! Each layer reads those before it.

/// Writes a line to the text of a writer. Writing to a string does not fail.
macro_rules! line {
    ($writer:expr, $($text:tt)*) => {{
        let _ = writeln!($writer.out, $($text)*);
    }};
}

mod definition;
mod functions;
mod items;
mod names;
mod statements;
mod steps;
mod tokens;
mod traits;
mod types;

pub use definition::Definition;
pub use items::generate;
pub use names::number::closed;

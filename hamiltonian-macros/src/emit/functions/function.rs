//! Functions of a program, and their beginnings as function bodies.
//!
//! Input: steps with their inputs and results. Output: the text that binds what they read. Invariant:
//! sizes, slices and values computed earlier are bound before the first step.

use super::holder::Receiver;
use crate::emit::names::context::Context;
use crate::emit::names::layout::Slice;
use crate::emit::statements::block;
use crate::emit::steps::inline::Inlined;
use hamiltonian_symbolic::dag::{Array, Parameter};
use hamiltonian_symbolic::program::{Step, Target, Value};
use hamiltonian_symbolic::sort::Arrange;
use std::fmt::Write;

/// A function to be written.
#[derive(Debug, Clone, Copy)]
pub struct Body<'a> {
    /// Its name: parts are called after it.
    pub name: &'a str,
    /// The type it is a method of.
    pub receiver: Receiver<'a>,
    /// Its arguments after `self`: names and types.
    pub arguments: &'a [(&'static str, String)],
    /// Its body.
    pub steps: &'a [Step],
    /// Outputs that are set to 0 first.
    pub cleared: &'a [Target],
    /// Values it ends with.
    pub results: &'a [Value],
    /// Parameter arrays that are bound as slices although no step reads them.
    pub arrays: &'a [Slice],
}

/// Writes bodies, and gathers their parts.
#[derive(Debug)]
pub struct BodyWriter<'a> {
    /// Their context.
    pub context: Context<'a>,
    /// The parts of long ones: free functions.
    pub parts: String,
}

impl BodyWriter<'_> {
    /// Binds sizes and slices.
    pub(super) fn bind(&self, out: &mut String, receiver: Receiver, mut slices: Vec<Slice>) {
        let context = self.context;
        slices.arrange();
        slices.dedup();
        receiver.bind_sizes(out, context);
        receiver.bind_functions(out, context);
        context.bind(out, &slices);
        for slice in &slices {
            let name = slice.name();
            match slice {
                Slice::Read(Array::Parameter(_) | Array::Hoisted(_)) => {
                    receiver.bind_array(out, context, *slice);
                }
                Slice::Write(Target::Hoisted(number)) => {
                    let _ = writeln!(out, "let {name} = _held.{number}.as_mut_slice();");
                }
                Slice::Write(Target::Parameter(Parameter(number))) => {
                    let shape = &context.model.parameters[usize::from(*number)].shape;
                    let slice = match context.typed_axes(shape) {
                        Some(axes) => ".as_flattened_mut()".repeat(axes.len() - 1),
                        None => ".as_mut_slice()".to_owned(),
                    };
                    let _ = writeln!(out, "let {name} = _held.{number}{slice};");
                }
                _ => {}
            }
        }
    }

    /// Binds values computed earlier: by an earlier stage or, where they cost nothing, again.
    pub(super) fn read(
        &self,
        out: &mut String,
        receiver: Receiver,
        reads: &[Value],
        inlined: &mut Inlined,
    ) {
        for value in receiver.read(out, reads, inlined) {
            block::write(
                out,
                self.context,
                "",
                &[Step::Let(value)],
                Inlined::default(),
            );
        }
    }
}

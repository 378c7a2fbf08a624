//! The generic parameters of everything that is emitted.
//!
//! Input: the form of the definition and the model. Output: parameter lists and types as text.
//! Invariant: names made here differ from the name of the user's type; const generics and the
//! scalars are renamed inside bodies, so that no other name of the user's can be in their way.

use super::{Definition, Form};

/// The generic parameters of a definition.
#[derive(Debug)]
pub struct Generics {
    /// The name of the type.
    pub name: String,
    /// The name that those of the structs of its coordinates begin with.
    pub whole: String,
    /// The visibility of the type and of all that it brings along.
    pub visibility: String,
    /// Const generics as they are called in bodies, in declaration order.
    pub constants: Vec<String>,
    /// The scalars of the parameters: one for all in item form, one a capture in expression form.
    pub scalars: Vec<String>,
    /// The fields of the parameters.
    fields: Vec<String>,
    /// The fields of the sizes; const generics have none, and keep their place.
    pub sizes: Vec<String>,
    /// Whether there is one scalar for all parameters.
    shared: bool,
}

impl Generics {
    /// The generics of a definition.
    pub fn of(definition: &Definition) -> Generics {
        match &definition.form {
            Form::Item(item) => {
                let name = item.name.to_string();
                let constants = (0..item.sizes.iter().filter(|size| !size.run_time).count())
                    .map(|at| other_than(&name, &format!("N{at}")))
                    .collect();
                let scalars = if item.parameters.is_empty() {
                    Vec::new()
                } else {
                    vec![other_than(&name, "P")]
                };
                Generics {
                    constants,
                    scalars,
                    fields: item.parameters.iter().map(|p| p.name.to_string()).collect(),
                    sizes: item.sizes.iter().map(|s| s.name.to_string()).collect(),
                    shared: true,
                    visibility: item.visibility.to_string(),
                    whole: item.whole.as_ref().unwrap_or(&item.name).to_string(),
                    name,
                }
            }
            Form::Expression(captures) => Generics {
                name: "HamiltonianValue".into(),
                whole: "HamiltonianValue".into(),
                visibility: String::new(),
                constants: Vec::new(),
                scalars: (0..captures.len()).map(|at| format!("A{at}")).collect(),
                fields: (0..captures.len()).map(|at| format!("c{at}")).collect(),
                sizes: Vec::new(),
                shared: false,
            },
        }
    }

    /// `const N0: usize`, …
    pub fn constants_declared(&self) -> impl Iterator<Item = String> + '_ {
        self.constants
            .iter()
            .map(|name| format!("const {name}: __h::core::primitive::usize"))
    }

    /// The bound of a parameter scalar.
    fn bound(&self) -> &'static str {
        // Captures may be integers, which are no `Real`.
        if self.shared {
            "__h::Real"
        } else {
            "__h::core::marker::Copy"
        }
    }

    /// `<const N0: usize, P: Real>`
    pub fn declaration(&self) -> String {
        let scalars = self
            .scalars
            .iter()
            .map(|name| format!("{name}: {}", self.bound()));
        list(self.constants_declared().chain(scalars))
    }

    /// `<const N0: usize, P: Real, T: Real + Lift<P>>`
    pub fn declaration_with_scalar(&self) -> String {
        let scalars = self
            .scalars
            .iter()
            .map(|name| format!("{name}: {}", self.bound()));
        let state = [format!("T: {}", self.state_bound())];
        list(self.constants_declared().chain(scalars).chain(state))
    }

    /// The generics of a marker that asks nothing of the parameters: `<const N0: usize, P>`
    pub fn declaration_without_bounds(&self) -> String {
        list(
            self.constants_declared()
                .chain(self.scalars.iter().cloned()),
        )
    }

    /// `Real + Lift<P>`
    pub fn state_bound(&self) -> String {
        let lifts = self
            .scalars
            .iter()
            .map(|name| format!(" + __h::Lift<{name}>"));
        format!("__h::Real{}", lifts.collect::<String>())
    }

    /// `Name<N0, P>`
    pub fn system_type(&self) -> String {
        self.system_type_over(&self.scalars)
    }

    /// `Name<N0, T>`: item form over another scalar.
    pub fn system_type_over(&self, scalars: &[String]) -> String {
        let arguments = self.constants.iter().chain(scalars).cloned();
        format!("{}{}", self.name, list(arguments))
    }

    /// `<const N0: usize, T: Real>`
    pub fn holder_declaration(&self) -> String {
        list(self.constants_declared().chain(["T: __h::Real".to_owned()]))
    }

    /// `<N0, T>`
    pub fn holder_arguments(&self) -> String {
        list(self.constants.iter().cloned().chain(["T".to_owned()]))
    }

    /// A field of `_self` as a value of type `T`.
    pub fn lifted(&self, parameter: u16) -> String {
        format!(
            "<T as __h::Lift<{}>>::lift(_self.{})",
            self.scalar(parameter),
            self.field(parameter)
        )
    }

    /// An array field of `_self` over `T`.
    pub fn lifted_array(&self, parameter: u16) -> String {
        format!(
            "_self.{}.map(<T as __h::Lift<{}>>::lift)",
            self.field(parameter),
            self.scalar(parameter)
        )
    }

    /// The field of a parameter.
    pub fn field(&self, parameter: u16) -> &str {
        &self.fields[usize::from(parameter)]
    }

    fn scalar(&self, parameter: u16) -> &str {
        &self.scalars[if self.shared {
            0
        } else {
            usize::from(parameter)
        }]
    }
}

/// `<a, b>`, or nothing for an empty list.
pub fn list(parameters: impl Iterator<Item = String>) -> String {
    let parameters: Vec<String> = parameters.collect();
    if parameters.is_empty() {
        String::new()
    } else {
        format!("<{}>", parameters.join(", "))
    }
}

/// A name, changed if it is the type's own.
fn other_than(taken: &str, name: &str) -> String {
    if name == taken {
        format!("{name}_")
    } else {
        name.to_owned()
    }
}

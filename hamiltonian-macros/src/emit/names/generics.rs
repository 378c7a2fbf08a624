//! The generic parameters of everything that is emitted.
//!
//! Input: the definition. Output: parameter lists and types as text. Invariant: names made here
//! differ from the name of the user's type; const generics and the scalars are renamed inside
//! bodies, so that no other name of the user's can be in their way.

use crate::emit::definition::Definition;
use hamiltonian_symbolic::list::IntoList;

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
    /// The types of the functions that are parameters, each with its number of arguments.
    pub functions: Vec<(String, usize)>,
    /// All sizes as they are called in bodies.
    pub sizes: Vec<String>,
    /// True for each size that is set at run time.
    pub is_run_time: Vec<bool>,
    /// The fields of the parameters.
    fields: Vec<String>,
    /// The bound of a parameter scalar where a value is made: captures may be integers, which are no `Real`.
    bound: &'static str,
    /// Its bound where the value is used as a system.
    system_bound: &'static str,
}

impl Generics {
    /// The generics of a definition.
    pub fn of(definition: &Definition) -> Generics {
        let checked = definition.checked;
        let Some(item) = &checked.item else {
            let numbered =
                |letter| (0..checked.captures.len()).map(move |at| format!("{letter}{at}"));
            return Generics {
                name: "HamiltonianValue".into(),
                whole: "HamiltonianValue".into(),
                visibility: String::new(),
                constants: Vec::new(),
                functions: Vec::new(),
                scalars: numbered("A").into_list(),
                sizes: Vec::new(),
                is_run_time: Vec::new(),
                fields: numbered("c").into_list(),
                bound: "__h::Parameter",
                system_bound: "__h::Parameter",
            };
        };
        let name = definition.type_name(item).to_string();
        let (mut sizes, mut constants) = (Vec::new(), Vec::new());
        for (at, size) in checked.sizes.iter().enumerate() {
            sizes.push(match size.run_time {
                true => format!("_n{at}"),
                false => other_than(&name, &format!("N{}", constants.len())),
            });
            if !size.run_time {
                constants.push(sizes[at].clone());
            }
        }
        let functions = checked.functions.iter().filter(|f| f.value.is_none());
        let functions = functions.enumerate().map(|(at, function)| {
            let arity = function.arguments.len();
            (other_than(&name, &format!("F{at}")), arity)
        });
        let functions = functions.into_list();
        let is_run_time = checked.sizes.iter().map(|size| size.run_time);
        let scalar = (!checked.parameters.is_empty()).then(|| other_than(&name, "P"));
        Generics {
            constants,
            functions,
            scalars: scalar.into_iter().into_list(),
            sizes,
            is_run_time: is_run_time.into_list(),
            fields: checked
                .parameters
                .iter()
                .map(|p| p.name.to_string())
                .into_list(),
            bound: "__h::Real",
            system_bound: "__h::Real + __h::Parameter",
            visibility: item.visibility.to_string(),
            whole: item.name.to_string(),
            name,
        }
    }

    /// `<const N0: usize, …>` with more parameters after the constants.
    pub fn declared(&self, more: impl IntoIterator<Item = String>) -> String {
        let constants = self.constants.iter();
        let constants = constants.map(|name| format!("const {name}: __h::usize"));
        list(constants.chain(more))
    }

    /// `F0: Function<1>, …`
    pub fn bounded_functions(&self) -> impl Iterator<Item = String> + '_ {
        let functions = self.functions.iter();
        functions.map(|(name, arity)| format!("{name}: __h::Function<{arity}>"))
    }

    /// `<const N0: usize, F0: Function<1>, …>` with more parameters after them.
    fn declared_with_functions(&self, more: impl IntoIterator<Item = String>) -> String {
        self.declared(self.bounded_functions().chain(more))
    }

    fn bounded(&self, bound: &'static str) -> impl Iterator<Item = String> + '_ {
        let scalars = self.scalars.iter();
        scalars.map(move |name| format!("{name}: {bound}"))
    }

    /// `<const N0: usize, P: Real + Parameter>`
    pub fn declaration(&self) -> String {
        self.declared_with_functions(self.bounded(self.system_bound))
    }

    /// `<const N0: usize, P: Real + Parameter, T: Real>`
    pub fn declaration_with_scalar(&self) -> String {
        let state = "T: __h::Real".to_owned();
        self.declared_with_functions(self.bounded(self.system_bound).chain([state]))
    }

    /// The generics of a marker without bounds on the parameters: `<const N0: usize, P>`
    pub fn declaration_without_bounds(&self) -> String {
        self.declared_with_functions(self.scalars.iter().cloned())
    }

    /// `Name<N0, P>`
    pub fn system_type(&self) -> String {
        format!("{}{}", self.name, self.arguments())
    }

    /// `<N0, P>`
    pub fn arguments(&self) -> String {
        self.type_over("", self.scalars.iter().cloned())
    }

    /// `impl<const N0: usize, P: Real + Parameter> Name<N0, P>`
    pub fn header(&self) -> String {
        format!("impl{} {}", self.declaration(), self.system_type())
    }

    /// `impl<const N0: usize, P: Real> Name<N0, P>`, for what makes a value.
    pub fn header_of_values(&self) -> String {
        format!(
            "impl{} {}",
            self.declaration_of_values(),
            self.system_type()
        )
    }

    /// `<const N0: usize, P: Real>`
    pub fn declaration_of_values(&self) -> String {
        self.declared_with_functions(self.bounded(self.bound))
    }

    /// `Name<N0, T>`: item form over another scalar.
    pub fn system_type_over(&self, scalar: &str) -> String {
        self.type_over(&self.name, self.scalars.iter().map(|_| scalar.to_owned()))
    }

    /// `<const N0: usize>` and `Name<N0, f64>`, for items whose scalar cannot be inferred.
    pub fn over_f64(&self) -> (String, String) {
        let system = self.system_type_over("__h::core::primitive::f64");
        (self.declared_with_functions([]), system)
    }

    /// A type of some name with the constants, the functions and these scalars as its arguments.
    fn type_over(&self, name: &str, scalars: impl IntoIterator<Item = String>) -> String {
        let functions = self.functions.iter().map(|(name, _)| name.clone());
        let arguments = self.constants.iter().cloned().chain(functions);
        format!("{name}{}", list(arguments.chain(scalars)))
    }

    /// `<const N0: usize, T: Real>`
    pub fn vector_declaration(&self) -> String {
        self.declared(["T: __h::Real".to_owned()])
    }

    /// `Name<N0, T>` of the struct of coordinates, over a scalar.
    pub fn vector_type_over(&self, name: &str, scalar: &str) -> String {
        let arguments = self.constants.iter().cloned();
        format!("{name}{}", list(arguments.chain([scalar.to_owned()])))
    }

    /// `<const N0: usize, F0: Function<1>, T: Real>`
    pub fn holder_declaration(&self) -> String {
        self.declared_with_functions(["T: __h::Real".to_owned()])
    }

    /// The same without bounds, for the alias of a type.
    pub fn holder_declaration_without_bounds(&self) -> String {
        let functions = self.functions.iter().map(|(name, _)| name.clone());
        self.declared(functions.chain(["T".to_owned()]))
    }

    /// `Name<N0, F0, T>` of a holder.
    pub fn holder_type(&self, name: &str) -> String {
        self.type_over(name, ["T".to_owned()])
    }

    /// `N0, F0, `: what stands before the scalar of a holder.
    pub fn holder_arguments(&self) -> String {
        let functions = self.functions.iter().map(|(name, _)| name);
        let all = self.constants.iter().chain(functions);
        all.map(|name| format!("{name}, ")).collect()
    }

    /// A field of `_self` as a value of type `T`.
    pub fn lifted(&self, parameter: u16) -> String {
        format!(
            "__h::Parameter::into_real::<T>(_self.{})",
            self.field(parameter)
        )
    }

    /// A matrix field of `_self` over `T`, transposed: row after row.
    pub fn lifted_rows(&self, parameter: u16) -> String {
        let field = self.field(parameter);
        format!("_self.{field}.transpose().map(__h::Parameter::into_real::<T>)")
    }

    /// The field of a parameter.
    pub fn field(&self, parameter: u16) -> &str {
        &self.fields[usize::from(parameter)]
    }
}

/// `<a, b>`, or nothing for an empty list.
fn list(parameters: impl Iterator<Item = String>) -> String {
    let parameters: Vec<String> = parameters.into_list();
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

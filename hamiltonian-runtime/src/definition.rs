//! Definitions: read, checked, proven, and kept as mathematics.
//!
//! Input: a text. Output: [`Definition`], or the errors that the macro reports. Invariant: a definition has no tokens: it
//! may go to another thread.

use crate::code::Code;
use crate::diagnostics::{Diagnostic, Diagnostics, Place, place};
use crate::error::SystemError;
use crate::sizes::{self, Obligation};
use crate::system::RuntimeSystem;
use crate::tabulated::Tabulated;
use crate::values::{Value, Values};
use hamiltonian_language::analyse::variables::Declared;
use hamiltonian_language::analyse::{self, Analysis, analyse, surface};
use hamiltonian_language::checked::Checked;
use hamiltonian_language::read;
use hamiltonian_language::report::Report;
use hamiltonian_symbolic::dag::{Dag, Kind, Node};
use hamiltonian_symbolic::model::Shape;
use hamiltonian_symbolic::print;
use proc_macro2::{Span, TokenStream};
use std::fmt::{self, Display, Formatter};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError};

/// A parameter with its default.
#[derive(Debug, Clone)]
pub(crate) struct Parameter {
    pub(crate) name: String,
    pub(crate) shape: Shape,
    pub(crate) default: Option<Vec<f64>>,
}

/// A Hamiltonian that was read from a text, with everything that is proven of it.
///
/// ```
/// use hamiltonian_runtime::Definition;
///
/// let pendulum = Definition::parse(
///     "struct Pendulum { m = 1.0, l = 10.0, g = 9.81 }
///      H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)",
///     "pendulum.txt",
/// )?;
/// assert_eq!(pendulum.name(), "Pendulum");
/// assert_eq!(pendulum.parameters().collect::<Vec<_>>(), ["m", "l", "g"]);
/// assert_eq!(pendulum.to_string(), "H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)");
/// # Ok::<(), hamiltonian_runtime::Diagnostics>(())
/// ```
#[derive(Debug)]
pub struct Definition {
    pub(crate) system: Arc<analyse::System>,
    pub(crate) parameters: Vec<Parameter>,
    /// The variables in which it is written, if the system has others.
    declared: Option<Declared>,
    /// The functions with data: their names, and the number of their arguments.
    functions: Vec<(String, usize)>,
    obligations: Vec<Obligation>,
    /// What systems at run time do not have, with its place.
    not_carried: Option<(String, Place)>,
    /// The code for the sizes of the last system, which the next one shares.
    last: Mutex<Option<Arc<Code>>>,
}

impl Definition {
    /// Reads, checks and proves a definition in the language of `hamiltonian!`. `source` is the name of the text in
    /// errors.
    ///
    /// A name that nothing declares is a parameter without a default, if the definition does not begin with
    /// `struct Name { … }`. The text stays in the memory of the thread, since errors refer to it.
    ///
    /// # Errors
    /// [`Diagnostics`] with the messages of the macro: all errors of the first stage that has any.
    ///
    /// ```
    /// use hamiltonian_runtime::Definition;
    ///
    /// let text = "H(x; p) = p^2/2 + k*x^2/2;\ninvariant momentum = p";
    /// let errors = Definition::parse(text, "spring.txt").unwrap_err();
    /// assert!(errors.to_string().starts_with("error: `momentum` is not conserved"));
    /// assert_eq!(errors.list()[0].place.to_string(), "spring.txt:2:11");
    /// ```
    pub fn parse(text: &str, source: &str) -> Result<Definition, Diagnostics> {
        let tokens: TokenStream = text.parse().map_err(|error: proc_macro2::LexError| {
            let message = "the text cannot be read as words, numbers and signs";
            let help = "close each bracket and each quotation mark that is opened, in this order";
            let spans = error.span().into();
            Diagnostics(vec![Diagnostic::new(message, help, spans, text, source)])
        })?;
        let mut report = Report::default();
        let stages = || {
            let checked = read(tokens, &mut report).1?;
            let analysis = analyse(&checked, &mut report)?;
            Definition::of(&checked, analysis, source)
        };
        // The report is whole after each statement, and what a panic leaves half-made is read no more.
        let made = catch_unwind(AssertUnwindSafe(stages)).unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<String>().cloned();
            let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
            report.internal(Span::call_site(), &text.unwrap_or_default());
            None
        });
        if made.is_none() && report.is_empty() {
            let fault = "it ends without a system and without an error";
            report.internal(Span::call_site(), fault);
        }
        let errors = report.errors();
        match made {
            Some(made) if errors.is_empty() => Ok(made),
            _ => Err(Diagnostics::of(errors, text, source)),
        }
    }

    fn of(checked: &Checked, analysis: Analysis, source: &str) -> Option<Definition> {
        let defaults = analysis.defaults.iter().map(|default| match default {
            Some(default) => numbers(default).map(Some),
            None => Some(None),
        });
        let mut defaults = defaults.collect::<Option<Vec<_>>>()?.into_iter();
        let declared = analysis.whole.model.parameters.iter();
        let parameter = |declared: &hamiltonian_symbolic::model::ParameterDeclaration| Parameter {
            name: declared.name.clone(),
            shape: declared.shape.clone(),
            default: defaults.next().flatten(),
        };
        let parameters = declared.map(parameter).collect();
        let not_carried = not_carried(checked).map(|(what, at)| (what, place(at, source)));
        Some(Definition {
            parameters,
            obligations: checked.reaches.iter().map(Obligation::of).collect(),
            not_carried,
            declared: analysis.declared,
            functions: (checked.functions.iter())
                .map(|of| (of.name.to_string(), of.arguments.len()))
                .collect(),
            system: Arc::new(analysis.whole),
            last: Mutex::new(None),
        })
    }

    /// The name of the struct; `H` of a definition without one.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.system.model.name
    }

    /// The names of the parameters.
    pub fn parameters(&self) -> impl Iterator<Item = &str> {
        self.parameters.iter().map(|parameter| &*parameter.name)
    }

    /// The names of the sizes: `const` sizes and those of type `usize`. Both are values of a system here.
    pub fn sizes(&self) -> impl Iterator<Item = &str> {
        self.system.model.sizes.iter().map(String::as_str)
    }

    /// The names of the functions with data, `V: fn(r)`.
    pub fn functions(&self) -> impl Iterator<Item = &str> {
        self.functions.iter().map(|(name, _)| &**name)
    }

    /// The sentences on H that the documentation of a compiled definition has: its structure, its pieces.
    pub fn facts(&self) -> impl Iterator<Item = &str> {
        self.system.text.facts.iter().map(String::as_str)
    }

    /// H in LaTeX.
    #[must_use]
    pub fn latex(&self) -> &str {
        &self.system.text.latex
    }

    /// The system with these values of its parameters and sizes.
    ///
    /// # Errors
    /// [`SystemError`]: a value is missing or does not fit, or the definition has a feature that systems at run time do
    /// not have, which the error names with its place.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// use hamiltonian_runtime::{Definition, Values};
    ///
    /// let chain = "struct Chain { n: usize, k = 1.0 }
    ///     H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + k*(q[(i + 1) % n] - q[i])^2/2 }";
    /// let chain = Definition::parse(chain, "chain.txt")?;
    /// let system = chain.system([("n", 3)])?;
    /// let state = State::new(vec![1.0, 0.0, 0.0], vec![0.0, 0.0, 2.0]);
    /// assert_eq!(system.energy(&state), 3.0);
    ///
    /// let error = chain.system(Values::new().with("n", 3).with("kk", 2.0)).unwrap_err();
    /// assert_eq!(error.to_string(), "there is no parameter or size `kk`; there are `n`, `k`");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn system(&self, values: impl Into<Values>) -> Result<RuntimeSystem, SystemError> {
        self.system_of(&values.into())
    }

    fn system_of(&self, values: &Values) -> Result<RuntimeSystem, SystemError> {
        if let Some((feature, place)) = &self.not_carried {
            return Err(SystemError::NotCarried {
                feature: feature.clone(),
                place: place.clone(),
            });
        }
        let known = || {
            self.sizes()
                .chain(self.parameters())
                .chain(self.functions())
        };
        for (name, _) in &values.0 {
            if !known().any(|known| known == name) {
                return Err(SystemError::Unknown {
                    name: name.clone(),
                    known: known().map(str::to_owned).collect(),
                });
            }
        }
        let sizes = self.sizes().map(|name| size(name, values.get(name)));
        let sizes = sizes.collect::<Result<Vec<usize>, SystemError>>()?;
        for obligation in &self.obligations {
            obligation.check(&sizes)?;
        }
        let groups = self.system.model.groups.iter();
        for group in groups {
            sizes::elements(&group.coordinate, &group.shape.of_parameter(), &sizes)?;
        }
        let parameters = self.parameters.iter();
        let numbers = parameters.map(|parameter| filled(parameter, values, &sizes));
        let numbers = numbers.collect::<Result<Vec<Vec<f64>>, SystemError>>()?;
        let functions = self.functions.iter();
        let functions = functions.map(|(name, arguments)| function(name, *arguments, values));
        let functions = functions.collect::<Result<Vec<Tabulated>, SystemError>>()?;
        Ok(RuntimeSystem::new(self.code(&sizes)?, numbers, functions))
    }

    /// The code for these sizes.
    fn code(&self, sizes: &[usize]) -> Result<Arc<Code>, SystemError> {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(code) = last.as_ref().filter(|code| code.sizes == sizes) {
            return Ok(code.clone());
        }
        let names: Vec<String> = self.functions().map(str::to_owned).collect();
        let made = Code::of(&self.system, self.declared.as_ref(), &names, sizes);
        let made = made.map_err(|feature| SystemError::NotCarried {
            feature,
            place: Place {
                source: self.name().to_owned(),
                line: 1,
                column: 1,
            },
        })?;
        let made = Arc::new(made);
        *last = Some(made.clone());
        Ok(made)
    }
}

/// H in the author's notation.
impl Display for Definition {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let model = &self.system.model;
        match self.system.text.hamiltonian.as_str() {
            "" => f.write_str(&print::text(model, model.h())),
            text => f.write_str(text),
        }
    }
}

/// The first feature that systems at run time do not have, with its place.
fn not_carried(checked: &Checked) -> Option<(String, Span)> {
    let is_rust = |function: &&hamiltonian_language::ast::Function| {
        let is_derived = function.first.is_none() && function.second.is_none();
        function.value.is_some() || !is_derived
    };
    if let Some(function) = checked.functions.iter().find(is_rust) {
        let feature = format!("the function `{}`, which is written in Rust", function.name);
        return Some((feature, function.name.span()));
    }
    None
}

/// The value of a size.
fn size(name: &str, value: Option<&Value>) -> Result<usize, SystemError> {
    let name = name.to_owned();
    match value {
        None => Err(SystemError::NoValue { name }),
        Some(Value::Number(number)) if number.fract() == 0.0 && (0.0..9e15).contains(number) => {
            Ok(*number as usize)
        }
        Some(_) => Err(SystemError::NoNumber {
            name,
            expected: "a size, a whole number that is not negative",
        }),
    }
}

/// The value of a function with data.
fn function(name: &str, arguments: usize, values: &Values) -> Result<Tabulated, SystemError> {
    let name = name.to_owned();
    match values.get(&name) {
        None => Err(SystemError::NoValue { name }),
        Some(Value::Function(function)) if function.arity() == arguments => Ok(function.clone()),
        Some(_) => Err(SystemError::NoFunction { name, arguments }),
    }
}

/// The numbers of a parameter: those given, or the default.
fn filled(
    parameter: &Parameter,
    values: &Values,
    sizes: &[usize],
) -> Result<Vec<f64>, SystemError> {
    let Parameter {
        name,
        shape,
        default,
    } = parameter;
    let expected = sizes::elements(name, shape, sizes)?;
    let name = || name.clone();
    let numbers = match (values.get(&parameter.name), default) {
        (Some(Value::Number(number)), _) if *shape == Shape::Scalar => vec![*number],
        (Some(Value::List(list)), _) if *shape != Shape::Scalar => list.clone(),
        (Some(Value::Number(_)), _) => {
            let expected = "a list of numbers";
            return Err(SystemError::NoNumber {
                name: name(),
                expected,
            });
        }
        (Some(Value::List(_)), _) => {
            return Err(SystemError::NoNumber {
                name: name(),
                expected: "a number",
            });
        }
        (Some(Value::Function(_)), _) => {
            return Err(SystemError::NoFunction {
                name: name(),
                arguments: 0,
            });
        }
        (None, Some(default)) => default.clone(),
        (None, None) => return Err(SystemError::NoValue { name: name() }),
    };
    if numbers.len() != expected {
        return Err(SystemError::Length {
            name: name(),
            expected,
            found: numbers.len(),
        });
    }
    match numbers.iter().any(|number| number.is_nan()) {
        true => Err(SystemError::NaN { name: name() }),
        false => Ok(numbers),
    }
}

/// The numbers of a default, in the order of operations of emitted code.
fn numbers(default: &surface::Default) -> Option<Vec<f64>> {
    let values = default.values.iter();
    values.map(|value| number(&default.dag, *value)).collect()
}

fn number(dag: &Dag, node: Node) -> Option<f64> {
    Some(match dag.kind(node) {
        Kind::Constant(value) => value.to_words().0,
        Kind::Pi => std::f64::consts::PI,
        Kind::Sum(constant, terms) => {
            let mut sum = constant.to_words().0;
            for (factor, term) in terms {
                sum += factor.to_words().0 * number(dag, *term)?;
            }
            sum
        }
        Kind::Product(constant, factors) => {
            let mut product = constant.to_words().0;
            for (factor, power) in factors {
                let base = number(dag, *factor)?;
                for _ in 0..power.unsigned_abs() {
                    if *power > 0 {
                        product *= base;
                    } else {
                        product /= base;
                    }
                }
            }
            product
        }
        Kind::Call(op, arguments) => {
            let arguments = arguments.iter().map(|node| number(dag, *node));
            op.eval(&arguments.collect::<Option<Vec<f64>>>()?)
        }
        _ => return None,
    })
}

//! Systems whose H is known at run time alone.
//!
//! Input: code and numbers. Output: [`RuntimeSystem`]. Invariant: its type has every marker, so that every scheme takes it;
//! what is not proven of its H is in its description, and a run whose scheme requires it is refused.

use crate::code::{Code, Part};
use crate::error::SystemError;
use crate::flow::{Inside, PartFlow};
use crate::prepared::{Flat, Prepared};
use crate::tabulated::Tabulated;
use hamiltonian_core::nalgebra::{Const, Dyn, OMatrix};
use hamiltonian_core::private;
use hamiltonian_core::schemes::author::{Description, Needs, Piece, Pieces, Point};
use hamiltonian_core::schemes::{Gauss, ToTolerance};
use hamiltonian_core::{
    Autonomous, Exact, Nystrom, QuadraticKinetic, Separable, Split, System, Unforced,
};
use hamiltonian_lanes::{Pack, Real};
use std::any::{Any, TypeId};
use std::fmt::Write;
use std::sync::{Arc, OnceLock};

/// A system that was defined at run time.
///
/// Its coordinates are one vector of numbers, and so are its momenta: group after group in the order of the declaration,
/// an array `q[n][3]` column after column. It is a [`System`] as any other: all schemes, runs, ensembles and observers of
/// `hamiltonian` take it. A run whose scheme requires a structure that H is not proven to have is refused with the reason.
///
/// ```
/// use hamiltonian::prelude::*;
/// use hamiltonian_runtime::{Definition, Values};
///
/// let coupled = Definition::parse("struct Coupled {} H(q; p) = (q^2 + 1)*(p^2 + 1)/2 + sin(q*p)", "coupled.txt")?;
/// let system = coupled.system(Values::new())?;
/// let start = || State::new(vec![-3.0], vec![0.0]);
///
/// let mut run = Integrator::new(&system, Gauss::<3>::default(), start(), 0.01)?;
/// run.advance(10)?;
/// let end = Integrator::to_tolerance(&system, start(), 1e-12)?.advance_until(0.1)?;
/// assert!((end.q[0] - run.state().q[0]).abs() < 1e-9);
/// let error = Integrator::new(&system, StormerVerlet::default(), start(), 0.01).unwrap_err();
/// assert!(error.to_string().contains("`StormerVerlet` needs H = T(p) + V(q)"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct RuntimeSystem {
    pub(crate) code: Arc<Code>,
    /// The numbers of each parameter.
    parameters: Arc<Vec<Vec<f64>>>,
    /// The functions with data.
    functions: Arc<Vec<Tabulated>>,
    /// The parameter, and its element, by which dual numbers take derivatives.
    variable: Option<[usize; 2]>,
    /// The system prepared over `f64`, which the members of an ensemble share.
    prepared: Arc<OnceLock<Prepared<f64>>>,
}

impl RuntimeSystem {
    pub(crate) fn new(
        code: Arc<Code>,
        parameters: Vec<Vec<f64>>,
        functions: Vec<Tabulated>,
    ) -> Self {
        let (parameters, functions) = (Arc::new(parameters), Arc::new(functions));
        RuntimeSystem {
            code,
            parameters,
            functions,
            variable: None,
            prepared: Arc::default(),
        }
    }

    /// The system whose runs over [`Dual`] numbers have the derivative by a parameter: by a number, or by the element
    /// `element` of an array, row after row. A number has the element 0. Runs over other scalars are those of this system.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    /// use hamiltonian_runtime::Definition;
    ///
    /// let spring = Definition::parse("struct Spring { k = 4.0 } H(x; p) = p^2/2 + k*x^2/2", "spring.txt")?;
    /// let system = spring.system([("k", 4.0)])?.by_parameter("k", 0)?;
    /// let start = State::over(vec![Dual::fixed(1.0)], vec![Dual::fixed(0.0)]);
    /// let mut run = Integrator::new(&system, KahanLi8, start, Dual::fixed(0.01))?;
    /// // x = cos(√k t), ∂x/∂k = −t sin(√k t)/(2√k)
    /// let x = run.advance(100)?.q[0];
    /// assert!((x.eps + 2f64.sin()/4.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SystemError::Unknown`] if there is no such parameter, or it is a function; [`SystemError::NoElement`].
    ///
    /// [`Dual`]: hamiltonian_lanes::Dual
    pub fn by_parameter(&self, name: &str, element: usize) -> Result<RuntimeSystem, SystemError> {
        let names = &self.code.parameter_names;
        let at = names.iter().position(|known| known == name);
        let at = at.ok_or_else(|| SystemError::Unknown {
            name: name.to_owned(),
            known: names.clone(),
        })?;
        let count = self.parameters[at].len();
        if element >= count {
            let name = name.to_owned();
            return Err(SystemError::NoElement {
                name,
                element,
                count,
            });
        }
        Ok(RuntimeSystem {
            variable: Some([at, element]),
            ..self.clone()
        })
    }

    fn prepared<T: Real>(&self) -> Prepared<T> {
        let lift = |place, number| match self.variable == Some(place) {
            true => T::from_dual(number, 1.0),
            false => T::constant(number, 0.0),
        };
        Prepared::new(&self.code, &self.parameters, &self.functions, lift)
    }

    /// The number of coordinates, which is that of momenta.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        self.code.places.len
    }

    /// The name and the value of each size.
    pub fn sizes(&self) -> impl Iterator<Item = (&str, usize)> {
        let names = self.code.size_names.iter().map(String::as_str);
        names.zip(self.code.sizes.iter().copied())
    }

    /// The name, the extents and the numbers of each parameter, row after row. A number has no extents.
    ///
    /// ```
    /// use hamiltonian_runtime::{Definition, Values};
    ///
    /// let text = "struct Springs { k = 2.0, m: [n], n: usize } H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) + k*q[i]^2 }";
    /// let springs = Definition::parse(text, "springs.txt")?;
    /// let system = springs.system(Values::new().with("n", 2).with("m", [1.0, 3.0]))?;
    /// assert_eq!(system.sizes().collect::<Vec<_>>(), [("n", 2)]);
    /// let parameters: Vec<_> = system.parameters().collect();
    /// assert_eq!(parameters, [("k", &[][..], &[2.0][..]), ("m", &[2], &[1.0, 3.0])]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn parameters(&self) -> impl Iterator<Item = (&str, &[usize], &[f64])> {
        let names = self.code.parameter_names.iter().zip(&self.code.extents);
        let all = names.zip(&*self.parameters);
        all.map(|((name, extents), numbers)| {
            (name.as_str(), extents.as_slice(), numbers.as_slice())
        })
    }

    /// True if H is proven to have this structure.
    pub(crate) fn has(&self, needs: Needs) -> bool {
        let missing = |marker: &str| {
            let mut all = self.code.description.missing.iter();
            all.any(|one| one.marker == marker)
        };
        let mut needed = Needs::ALL.iter().filter(|(one, _)| needs.contains(*one));
        needed.all(|(_, marker)| !missing(marker))
    }
}

impl System for RuntimeSystem {
    type Shape = OMatrix<(), Dyn, Const<1>>;
    type Prepared<T: Real> = Prepared<T>;
    const INTERPRETED: bool = true;

    fn description(&self) -> &Description {
        &self.code.description
    }

    fn describe_parameters(&self, out: &mut dyn Write) -> std::fmt::Result {
        for (name, size) in self.code.size_names.iter().zip(&self.code.sizes) {
            writeln!(out, "{name} = {size}")?;
        }
        let parameters = self.code.parameter_names.iter().zip(&*self.parameters);
        for ((name, numbers), extents) in parameters.zip(&self.code.extents) {
            private::describe_parameter(out, name, extents, numbers)?;
        }
        for (name, function) in self.code.function_names.iter().zip(&*self.functions) {
            writeln!(out, "{name} = function {:016x}", function.fingerprint())?;
        }
        Ok(())
    }

    fn prepare<T: Real>(&self) -> Prepared<T> {
        if TypeId::of::<T>() == TypeId::of::<f64>() {
            let kept: &dyn Any = self.prepared.get_or_init(|| self.prepared());
            if let Some(kept) = kept.downcast_ref::<Prepared<T>>() {
                return kept.with_registers();
            }
        }
        self.prepared()
    }

    fn zeros<T: Real>(&self) -> Flat<T> {
        Flat::from_element(self.code.places.len, T::zero())
    }

    fn gather<T: Real, P: Pack>(members: &[&Prepared<T>]) -> Prepared<T::Over<P>> {
        Prepared::gathered::<P>(members)
    }

    fn fits<T: Real>(a: &Prepared<T>, b: &Prepared<T>) -> bool {
        a.fits(b)
    }

    fn equals<T: Real>(a: &Prepared<T>, b: &Prepared<T>) -> bool {
        a.equals(b)
    }
}

impl Unforced for RuntimeSystem {}
/// T is not known to be quadratic when this is compiled.
impl ToTolerance for RuntimeSystem {
    type Scheme = Gauss<8>;
}
impl Exact for RuntimeSystem {}
impl QuadraticKinetic for RuntimeSystem {}
impl Autonomous for RuntimeSystem {}

/// A piece by its use, which the prepared system has a flow for.
#[derive(Debug, Clone, Copy)]
pub enum RuntimePiece {
    /// V.
    Kick,
    /// T.
    Drift,
    /// The kick of Nyström schemes.
    NystromKick,
    /// The piece beside it, at most quadratic in the momenta.
    Quadratic,
}

impl<T: Real> Piece<T, Prepared<T>> for RuntimePiece {
    type Point = Point<Flat<T>>;
    type Flow = PartFlow<T>;

    fn flow(&self, prepared: &Prepared<T>, c: T) -> PartFlow<T> {
        PartFlow::new(prepared, self.part(prepared), c)
    }

    fn merges(&self, prepared: &Prepared<T>) -> bool {
        prepared.code.merges(self.part(prepared))
    }
}

impl RuntimePiece {
    fn part<T: Real>(self, prepared: &Prepared<T>) -> Part {
        // A run is refused before its flows are made, if they are not there.
        let [kick, quadratic] = prepared.code.nystrom.unwrap_or([Part::Kick, Part::Drift]);
        match self {
            RuntimePiece::Kick => Part::Kick,
            RuntimePiece::Drift => Part::Drift,
            RuntimePiece::NystromKick => kick,
            RuntimePiece::Quadratic => quadratic,
        }
    }
}

/// The pieces that a splitting moves, the outermost first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RuntimePieces {
    /// The pieces of H, as many as the definition has.
    All,
    /// V, then T.
    Kick,
    /// T, then V.
    Drift,
    /// The kick of Nyström schemes, then the piece at most quadratic in the momenta.
    NystromKick,
    /// That piece, then the kick.
    NystromDrift,
}

impl RuntimePieces {
    /// The first piece, and the others. A run is refused before its flows are made, if they are not there.
    fn parts<'a, T: Real>(&self, prepared: &'a Prepared<T>) -> (Part, &'a [Part]) {
        let of = |parts: &'a [Part]| match parts.split_first() {
            Some((first, rest)) => (*first, rest),
            None => (Part::Kick, parts),
        };
        let nystrom = prepared.code.nystrom.as_ref();
        let [kick, quadratic] = nystrom.unwrap_or(&[Part::Kick, Part::Drift]);
        match self {
            RuntimePieces::All => of(&prepared.code.pieces),
            RuntimePieces::Kick => (Part::Kick, &[Part::Drift]),
            RuntimePieces::Drift => (Part::Drift, &[Part::Kick]),
            RuntimePieces::NystromKick => (*kick, std::slice::from_ref(quadratic)),
            RuntimePieces::NystromDrift => (*quadratic, std::slice::from_ref(kick)),
        }
    }
}

impl<T: Real> Pieces<T, Prepared<T>> for RuntimePieces {
    type Point = Point<Flat<T>>;
    type Outer = PartFlow<T>;
    type Inner = Inside<T>;

    fn outer(&self, prepared: &Prepared<T>, c: T) -> PartFlow<T> {
        PartFlow::new(prepared, self.parts(prepared).0, c)
    }

    fn inner(&self, prepared: &Prepared<T>, down: T, up: T) -> Inside<T> {
        let Some((last, between)) = self.parts(prepared).1.split_last() else {
            return Inside(Vec::new());
        };
        let way_down = between
            .iter()
            .map(|part| PartFlow::new(prepared, *part, down));
        let turn = match prepared.code.merges(*last) {
            true => vec![PartFlow::new(prepared, *last, down + up)],
            false => {
                let [down, up] = [down, up].map(|c| PartFlow::new(prepared, *last, c));
                vec![down, up.reversed()]
            }
        };
        let way_up = between
            .iter()
            .rev()
            .map(|part| PartFlow::new(prepared, *part, up).reversed());
        Inside(way_down.chain(turn).chain(way_up).collect())
    }

    fn merges(&self, prepared: &Prepared<T>) -> bool {
        prepared.code.merges(self.parts(prepared).0)
    }
}

impl Split for RuntimeSystem {
    type Pieces<T: Real> = RuntimePieces;
    fn pieces<T: Real>() -> RuntimePieces {
        RuntimePieces::All
    }
}

impl Separable for RuntimeSystem {
    type Kick<T: Real> = RuntimePiece;
    type Drift<T: Real> = RuntimePiece;
    fn kick<T: Real>() -> RuntimePiece {
        RuntimePiece::Kick
    }
    fn drift<T: Real>() -> RuntimePiece {
        RuntimePiece::Drift
    }
}

impl Nystrom for RuntimeSystem {
    type Kick<T: Real> = RuntimePiece;
    type Quadratic<T: Real> = RuntimePiece;
    fn kick<T: Real>() -> RuntimePiece {
        RuntimePiece::NystromKick
    }
    fn quadratic<T: Real>() -> RuntimePiece {
        RuntimePiece::Quadratic
    }
}

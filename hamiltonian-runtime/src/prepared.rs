//! Prepared systems over any scalar.
//!
//! Input: code, the numbers of parameters. Output: [`Prepared`], which runs its functions.
//! Invariant: numbers that depend on parameters alone are computed once, those of a step coefficient once for each flow.

use crate::code::Code;
use crate::frame::in_frame;
use crate::machine::{Arrays, Given, run};
use crate::op::{Framed, FunctionCode, Held};
use crate::registers::{Home, Pool};
use crate::tabulated::Tabulated;
use hamiltonian_core::nalgebra::DVector;
use hamiltonian_core::private::{Varied, fixed as constant};
use hamiltonian_core::schemes::author::{Arithmetic, gather};
use hamiltonian_lanes::{Pack, Real};
use hamiltonian_language::analyse::structure::GradientSource;
use hamiltonian_symbolic::program::Purpose;
use std::any::Any;
use std::fmt;
use std::panic::AssertUnwindSafe;
use std::sync::{Arc, OnceLock};

/// The numbers that a function holds: those of its coefficient stage, and those of its evaluation.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HeldOf<T> {
    pub(crate) coefficient: Vec<T>,
    pub(crate) evaluation: Vec<T>,
    /// Those of its evaluation in a frame.
    pub(crate) framed: Vec<T>,
}

/// The systems of the lanes of a pack over numbers with derivatives, which are made when they are first needed and do not
/// change, so that a panic leaves them whole.
pub(crate) type KeptOnce = Arc<OnceLock<AssertUnwindSafe<Box<dyn Any + Send + Sync>>>>;

/// A system with all numbers that depend on its parameters alone.
#[derive(Clone)]
pub struct Prepared<T: Real> {
    pub(crate) code: Arc<Code>,
    /// Of each function what it holds.
    pub(crate) held: Arc<Vec<HeldOf<T>>>,
    /// The arrays of parameters, and those that preparation fills.
    pub(crate) data: Arc<Vec<T>>,
    pub(crate) functions: Arc<Vec<Tabulated>>,
    pub(crate) pool: Pool<T>,
    /// The kick for −1 and the drift for 1, or the field for −1, of which the gradient is made.
    pub(crate) unit: Arc<Vec<Vec<T>>>,
    pub(crate) arithmetic: Arithmetic,
    pub(crate) lanes: KeptOnce,
}

impl<T: Real> fmt::Debug for Prepared<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Prepared")
            .field("system", &self.code.description.name)
            .field("held", &self.held)
            .field("data", &self.data)
            .finish_non_exhaustive()
    }
}

/// What a stage holds.
fn held<T: Real>(held: &[Held], scalars: &[T], prepared: &[T], data: &[T]) -> Vec<T> {
    let number = |held: &Held| match *held {
        Held::Constant(hi, lo) => T::constant(hi, lo),
        Held::Scalar(number) => scalars[usize::from(number)],
        Held::Prepared(number) => prepared[number as usize],
        Held::Data(place) => data[place as usize],
    };
    held.iter().map(number).collect()
}

impl<T: Real> Prepared<T> {
    /// Prepares a system from the numbers of each parameter, which a function lifts: the number of the parameter, and that
    /// of its element.
    pub(crate) fn new(
        code: &Arc<Code>,
        parameters: &[Vec<f64>],
        functions: &Arc<Vec<Tabulated>>,
        lift: impl Fn([usize; 2], f64) -> T,
    ) -> Self {
        let mut scalars = vec![T::zero(); parameters.len()];
        let mut data = vec![T::constant(f64::NAN, 0.0); code.places.data];
        for (at, numbers) in parameters.iter().enumerate() {
            if !code.extents[at].is_empty() {
                let (first, _) = code.places.parameters[at];
                for (element, (to, number)) in data[first..].iter_mut().zip(numbers).enumerate() {
                    *to = lift([at, element], *number);
                }
            } else if let Some(number) = numbers.first() {
                scalars[at] = lift([at, 0], *number);
            }
        }
        let pool = Pool::new();
        let mut prepared = vec![T::zero(); code.prepare.results.len()];
        let given = held(&code.prepare.held, &scalars, &[], &[]);
        let mut arrays = Arrays {
            into_data: &mut data,
            ..Arrays::none()
        };
        run(
            &code.prepare,
            Given {
                numbers: &given,
                data: &[],
                functions,
            },
            Home::Pool(&pool),
            &mut arrays,
            &mut prepared,
        );
        let of = |all: &[Held]| held(all, &scalars, &prepared, &data);
        let of_function = |(_, function): &(Purpose, Arc<FunctionCode>)| HeldOf {
            coefficient: of(&function.coefficient.held),
            evaluation: of(&function.evaluation.held),
            framed: of(function.framed.as_ref().map_or(&[], |framed| &framed.held)),
        };
        let all = code.functions.iter().map(of_function).collect();
        Prepared::whole(
            code.clone(),
            all,
            data,
            functions.clone(),
            Arithmetic::default(),
        )
    }

    /// A system of its parts.
    fn whole(
        code: Arc<Code>,
        held: Vec<HeldOf<T>>,
        data: Vec<T>,
        functions: Arc<Vec<Tabulated>>,
        arithmetic: Arithmetic,
    ) -> Self {
        let mut made = Prepared {
            code,
            held: Arc::new(held),
            data: Arc::new(data),
            functions,
            pool: Pool::new(),
            unit: Arc::new(Vec::new()),
            arithmetic,
            lanes: KeptOnce::default(),
        };
        let unit = match made.code.gradient {
            GradientSource::Written => Vec::new(),
            GradientSource::Halves => {
                let (minus, one) = (-T::one(), T::one());
                vec![
                    made.folded(Purpose::Kick, minus),
                    made.folded(Purpose::Drift, one),
                ]
            }
            GradientSource::Field => vec![made.folded(Purpose::VectorField, -T::one())],
        };
        made.unit = Arc::new(unit);
        made
    }

    /// One system with a member in each lane.
    pub(crate) fn gathered<P: Pack>(members: &[&Self]) -> Prepared<T::Over<P>> {
        let first = members[0];
        let lanes = |len: usize, of: &dyn Fn(&Self, usize) -> T| -> Vec<T::Over<P>> {
            let one = |at| gather::number::<T, P, Self>(members, |member| of(member, at));
            (0..len).map(one).collect()
        };
        let functions = first.held.iter().enumerate();
        let held = functions.map(|(f, held)| HeldOf {
            coefficient: lanes(held.coefficient.len(), &|member, at| {
                member.held[f].coefficient[at]
            }),
            evaluation: lanes(held.evaluation.len(), &|member, at| {
                member.held[f].evaluation[at]
            }),
            framed: lanes(held.framed.len(), &|member, at| member.held[f].framed[at]),
        });
        let held = held.collect();
        let data = lanes(first.data.len(), &|member, at| member.data[at]);
        let functions = first.functions.clone();
        Prepared::whole(first.code.clone(), held, data, functions, first.arithmetic)
    }

    /// The system over numbers with derivatives, which are zero.
    pub(crate) fn lifted(&self) -> Prepared<Varied<T>> {
        self.mapped(|numbers| numbers.iter().copied().map(constant).collect())
    }

    /// The system over other numbers.
    pub(crate) fn mapped<U: Real>(&self, map: impl Fn(&[T]) -> Vec<U>) -> Prepared<U> {
        let held = self.held.iter().map(|held| HeldOf {
            coefficient: map(&held.coefficient),
            evaluation: map(&held.evaluation),
            framed: map(&held.framed),
        });
        Prepared::whole(
            self.code.clone(),
            held.collect(),
            map(&self.data),
            self.functions.clone(),
            self.arithmetic,
        )
    }

    /// The same with registers of its own.
    pub(crate) fn with_registers(&self) -> Self {
        Prepared {
            pool: Pool::new(),
            ..self.clone()
        }
    }

    pub(crate) fn fits(&self, other: &Self) -> bool {
        let is_same = Arc::ptr_eq(&self.code, &other.code) || self.code == other.code;
        is_same && self.functions == other.functions
    }

    pub(crate) fn equals(&self, other: &Self) -> bool {
        let is_same = Arc::ptr_eq(&self.held, &other.held) && Arc::ptr_eq(&self.data, &other.data);
        is_same || self.held == other.held && self.data == other.data
    }

    /// The numbers that a function is given for a step coefficient: those that it holds, and those of the coefficient.
    pub(crate) fn folded(&self, purpose: Purpose, c: T) -> Vec<T> {
        let Some(number) = self.code.number(purpose) else {
            return Vec::new();
        };
        let held = &self.held[number].evaluation;
        let count = self.code.functions[number].1.coefficient.results.len();
        let mut folded = vec![T::zero(); held.len() + count];
        self.fold(number, c, &mut folded);
        folded
    }

    #[inline(always)]
    fn fold(&self, number: usize, c: T, folded: &mut [T]) {
        let held = &self.held[number];
        let (first, rest) = folded.split_at_mut(held.evaluation.len());
        first.copy_from_slice(&held.evaluation);
        let stage = &self.code.functions[number].1.coefficient;
        let mut arrays = Arrays {
            c,
            ..Arrays::none()
        };
        let given = Given {
            numbers: &held.coefficient,
            data: &self.data,
            functions: &self.functions,
        };
        run(stage, given, Home::Pool(&self.pool), &mut arrays, rest);
    }

    /// Runs the evaluation of a function, with the numbers of a step coefficient or none.
    #[inline(always)]
    pub(crate) fn evaluate(
        &self,
        number: usize,
        folded: &[T],
        arrays: Arrays<'_, T>,
        results: &mut [T],
    ) {
        let numbers = match folded {
            [] => &self.held[number].evaluation,
            folded => folded,
        };
        let function = &self.code.functions[number].1;
        if const { T::DUALS == 0 }
            && results.is_empty()
            && function.evaluation.short.is_none()
            && let Some(framed) = &function.framed
        {
            return self.evaluate_framed(number, framed, numbers, arrays);
        }
        self.evaluate_in(Home::Pool(&self.pool), function, numbers, arrays, results);
    }

    /// Moves a point by a function that is not short, in a frame of the pool.
    #[inline(always)]
    fn evaluate_framed(
        &self,
        number: usize,
        framed: &Framed,
        numbers: &[T],
        arrays: Arrays<'_, T>,
    ) {
        T::out_of_line(
            #[inline(always)]
            || {
                let mut registers = self.pool.take();
                let (frame, has) = registers.framed();
                let held = &self.held[number].framed;
                if !has.contains(&number) {
                    frame.numbers[framed.first_held..][..held.len()].copy_from_slice(held);
                    has.push(number);
                }
                let of_coefficient = &numbers[numbers.len() - framed.coefficients..];
                frame.numbers[framed.first_coefficient..][..framed.coefficients]
                    .copy_from_slice(of_coefficient);
                let width = self.code.places.len;
                let (of_q, rest) = frame.numbers.split_at_mut(width);
                // An array that moves in place is both read and written.
                let sides = [
                    (of_q, arrays.q, &*arrays.into_q),
                    (rest, arrays.p, &*arrays.into_p),
                ];
                for (to, read, moved) in sides {
                    let from = if moved.is_empty() { read } else { moved };
                    to[..from.len()].copy_from_slice(from);
                }
                in_frame(&framed.ops, arrays.t, frame);
                let (of_q, rest) = frame.numbers.split_at(width);
                for (from, to) in [(of_q, arrays.into_q), (rest, arrays.into_p)] {
                    to.copy_from_slice(&from[..to.len()]);
                }
                self.pool.give(registers);
            },
        );
    }

    /// Runs an evaluation in these registers, with the numbers that it is given.
    #[inline(always)]
    pub(crate) fn evaluate_in(
        &self,
        home: Home<'_, T>,
        function: &FunctionCode,
        numbers: &[T],
        mut arrays: Arrays<'_, T>,
        results: &mut [T],
    ) {
        let given = Given {
            numbers,
            data: &self.data,
            functions: &self.functions,
        };
        run(&function.evaluation, given, home, &mut arrays, results);
    }

    /// The value of a function that returns one; compiled once, since runs of every scheme have it.
    #[inline(always)]
    pub(crate) fn value(&self, purpose: Purpose, arrays: Arrays<'_, T>) -> T {
        T::out_of_line(
            #[inline(always)]
            || {
                let mut results = [T::constant(f64::NAN, 0.0)];
                if let Some(number) = self.code.number(purpose) {
                    self.evaluate(number, &[], arrays, &mut results);
                }
                results[0]
            },
        )
    }

    /// Runs a function with a step coefficient, if it is there.
    #[inline(always)]
    pub(crate) fn call(&self, purpose: Purpose, folded: &[T], arrays: Arrays<'_, T>) -> bool {
        let number = self.code.number(purpose);
        if let Some(number) = number {
            self.evaluate(number, folded, arrays, &mut []);
        }
        number.is_some()
    }

    /// Adds what a function adds for a coefficient, whose numbers are on the stack where they are few.
    #[inline(always)]
    pub(crate) fn add(&self, purpose: Purpose, c: T, arrays: Arrays<'_, T>) {
        const FEW: usize = 64;
        let Some(number) = self.code.number(purpose) else {
            return;
        };
        let count = self.code.functions[number].1.coefficient.results.len();
        let count = self.held[number].evaluation.len() + count;
        if count <= FEW {
            let mut folded = [T::zero(); FEW];
            self.fold(number, c, &mut folded[..count]);
            self.evaluate(number, &folded[..count], arrays, &mut []);
        } else {
            let folded = self.folded(purpose, c);
            self.evaluate(number, &folded, arrays, &mut []);
        }
    }
}

/// The vector of coordinates, and that of momenta.
pub(crate) type Flat<T> = DVector<T>;

/// The arrays of an evaluation at a point.
#[inline(always)]
pub(crate) fn at<'a, T: Real>(t: T, q: &'a Flat<T>, p: &'a Flat<T>) -> Arrays<'a, T> {
    Arrays {
        t,
        q: q.as_slice(),
        p: p.as_slice(),
        ..Arrays::none()
    }
}

//! H and its derivatives, by the functions of flat code.
//!
//! Input: a prepared system. Output: its [`Dynamics`]. Invariant: a derivative is taken from the function from which
//! compiled code takes it, so that the bits agree.

use crate::flow::Field;
use crate::machine::Arrays;
use crate::prepared::{Flat, Prepared, at};
use crate::system::RuntimeSystem;
use hamiltonian_core::Vector;
use hamiltonian_core::schemes::author::{
    Arithmetic, Description, Dynamics, InPack, Kept, VectorField, gather,
};
use hamiltonian_lanes::{Pack, Real};
use hamiltonian_language::analyse::structure::{FieldSource, GradientSource};
use hamiltonian_symbolic::model::VectorUse;
use hamiltonian_symbolic::program::Purpose;

impl<T: Real> Dynamics<T> for Prepared<T> {
    type Vector = Flat<T>;
    type Field = Field<T>;
    /// Bits are those of compiled code that does not fuse.
    const FUSES: bool = false;

    fn description(&self) -> &Description {
        &self.code.description
    }

    #[inline(always)]
    fn energy(&self, t: T, q: &Flat<T>, p: &Flat<T>) -> T {
        self.value(Purpose::Energy, at(t, q, p))
    }

    #[inline(always)]
    fn gradient_q(&self, t: T, q: &Flat<T>, p: &Flat<T>, out: &mut Flat<T>) {
        match self.code.gradient {
            GradientSource::Halves => {
                out.set_zero();
                let arrays = Arrays {
                    into_p: out.as_mut_slice(),
                    ..at(t, q, p)
                };
                self.call(Purpose::Kick, &self.unit[0], arrays);
            }
            GradientSource::Field => self.gradient(t, q, p, out, &mut p.zeros_like()),
            GradientSource::Written => {
                let arrays = Arrays {
                    into_q: out.as_mut_slice(),
                    ..at(t, q, p)
                };
                if !self.call(Purpose::GradientQ, &[], arrays) {
                    let _ = self.energy_and_gradient(t, q, p, out, &mut p.zeros_like());
                }
            }
        }
    }

    #[inline(always)]
    fn gradient_p(&self, t: T, q: &Flat<T>, p: &Flat<T>, out: &mut Flat<T>) {
        match self.code.gradient {
            GradientSource::Halves => {
                out.set_zero();
                let arrays = Arrays {
                    into_q: out.as_mut_slice(),
                    ..at(t, q, p)
                };
                self.call(Purpose::Drift, &self.unit[1], arrays);
            }
            GradientSource::Field => self.gradient(t, q, p, &mut q.zeros_like(), out),
            GradientSource::Written => {
                let arrays = Arrays {
                    into_p: out.as_mut_slice(),
                    ..at(t, q, p)
                };
                if !self.call(Purpose::GradientP, &[], arrays) {
                    let _ = self.energy_and_gradient(t, q, p, &mut q.zeros_like(), out);
                }
            }
        }
    }

    #[inline(always)]
    fn gradient(&self, t: T, q: &Flat<T>, p: &Flat<T>, dq: &mut Flat<T>, dp: &mut Flat<T>) {
        match self.code.gradient {
            GradientSource::Field => {
                // −1·(∂H/∂p, −∂H/∂q)
                dq.set_zero();
                dp.set_zero();
                let arrays = Arrays {
                    into_q: dp.as_mut_slice(),
                    into_p: dq.as_mut_slice(),
                    ..at(t, q, p)
                };
                self.call(Purpose::VectorField, &self.unit[0], arrays);
                for place in dp.as_mut_slice() {
                    *place = -*place;
                }
            }
            GradientSource::Written if !self.code.gradient_is_apart => {
                let arrays = Arrays {
                    into_q: dq.as_mut_slice(),
                    into_p: dp.as_mut_slice(),
                    ..at(t, q, p)
                };
                if !self.call(Purpose::Gradient, &[], arrays) {
                    let _ = self.energy_and_gradient(t, q, p, dq, dp);
                }
            }
            GradientSource::Written | GradientSource::Halves => {
                self.gradient_q(t, q, p, dq);
                self.gradient_p(t, q, p, dp);
            }
        }
    }

    #[inline(always)]
    fn energy_and_gradient(
        &self,
        t: T,
        q: &Flat<T>,
        p: &Flat<T>,
        dq: &mut Flat<T>,
        dp: &mut Flat<T>,
    ) -> T {
        let arrays = Arrays {
            into_q: dq.as_mut_slice(),
            into_p: dp.as_mut_slice(),
            ..at(t, q, p)
        };
        self.value(Purpose::EnergyAndGradient, arrays)
    }

    #[inline(always)]
    fn time_derivative(&self, t: T, q: &Flat<T>, p: &Flat<T>) -> T {
        self.value(Purpose::TimeDerivative, at(t, q, p))
    }

    #[inline(always)]
    fn hessian_vector(
        &self,
        t: T,
        q: &Flat<T>,
        p: &Flat<T>,
        vq: &Flat<T>,
        vp: &Flat<T>,
        out_q: &mut Flat<T>,
        out_p: &mut Flat<T>,
    ) {
        let arrays = Arrays {
            direction: [vq.as_slice(), vp.as_slice()],
            into_q: out_q.as_mut_slice(),
            into_p: out_p.as_mut_slice(),
            ..at(t, q, p)
        };
        if !self.call(Purpose::HessianVector, &[], arrays) {
            self.hessian_by_gradient(t, [q, p], [vq, vp], [out_q, out_p]);
        }
    }

    fn force(&self, t: T, q: &Flat<T>, p: &Flat<T>, out: &mut Flat<T>) {
        let Some(force) = self.code.vector(VectorUse::Force) else {
            return out.set_zero();
        };
        let arrays = Arrays {
            into_p: out.as_mut_slice(),
            ..at(t, q, p)
        };
        self.call(force, &[], arrays);
    }

    #[inline(always)]
    fn observable(&self, index: usize, t: T, q: &Flat<T>, p: &Flat<T>) -> T {
        T::out_of_line(
            #[inline(always)]
            || self.component(index, at(t, q, p)),
        )
    }

    fn field(&self, c: T) -> Field<T> {
        Field::new(self, c)
    }

    #[inline(always)]
    fn add_field(
        &self,
        c: T,
        t: T,
        q: &Flat<T>,
        p: &Flat<T>,
        into_q: &mut Flat<T>,
        into_p: &mut Flat<T>,
    ) {
        match self.code.field {
            FieldSource::Halves => {
                let arrays = Arrays {
                    into_p: into_p.as_mut_slice(),
                    ..at(t, q, p)
                };
                self.add(Purpose::Kick, c, arrays);
                let arrays = Arrays {
                    into_q: into_q.as_mut_slice(),
                    ..at(t, q, p)
                };
                self.add(Purpose::Drift, c, arrays);
            }
            FieldSource::Whole => {
                let arrays = Arrays {
                    into_q: into_q.as_mut_slice(),
                    into_p: into_p.as_mut_slice(),
                    ..at(t, q, p)
                };
                self.add(Purpose::VectorField, c, arrays);
            }
            FieldSource::OfGradient => self.field(c).add(t, q, p, into_q, into_p),
        }
    }

    #[inline(always)]
    fn arithmetic(&self) -> Arithmetic {
        self.arithmetic
    }

    fn set_arithmetic(&mut self, arithmetic: Arithmetic) {
        self.arithmetic = arithmetic;
    }

    #[inline(always)]
    fn in_pack<P: Pack, K: InPack<T, Flat<T>, P>>(
        &self,
        kept: &mut Kept,
        kernel: K,
    ) -> Option<K::Output> {
        gather::in_pack::<T, RuntimeSystem, P, K>(self, kept, kernel)
    }
}

impl<T: Real> Prepared<T> {
    /// A component of the observables.
    #[inline(always)]
    fn component(&self, index: usize, arrays: Arrays<'_, T>) -> T {
        let mut before = 0;
        for (number, (purpose, function)) in self.code.functions.iter().enumerate() {
            if !matches!(purpose, Purpose::Observable(_)) {
                continue;
            }
            let components = function.evaluation.results.len();
            if index < before + components {
                // Values of a vector have few components.
                let mut results = [T::zero(); 64];
                self.evaluate(number, &[], arrays, &mut results);
                return match results.get(index - before) {
                    Some(value) => *value,
                    None => T::constant(f64::NAN, 0.0),
                };
            }
            before += components;
        }
        panic!("observable {index} of {before}")
    }
}

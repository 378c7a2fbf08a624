//! Orders and forms.

use crate::common::measures::{defect, off_order, tangent};
use crate::common::systems::{Hand, Relativistic};
use crate::common::walk::{Sample, everywhere};
use hamiltonian_core::schemes::author::Form;
use hamiltonian_core::schemes::walk::{Visitor, visit_exact};
use hamiltonian_core::{DoubleDouble, Dual, Scheme};

/// From coarse steps for schemes of high order.
struct Orders {
    missed: Vec<String>,
}

impl<S: Sample<DoubleDouble>> Visitor<S> for Orders {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        let steps = match scheme.entry().order {
            0..=4 => 32,
            5..=8 => 16,
            _ => 4,
        };
        let off = off_order(&S::sample(), &scheme, &S::begin(), 2.0, steps);
        // False for NaN.
        let meets = off <= 0.1;
        if !meets {
            self.missed.push(format!("{:?}: {off}", scheme.entry()));
        }
    }
}

#[test]
fn every_scheme_has_its_order() {
    let mut orders = Orders { missed: Vec::new() };
    everywhere(&mut orders);
    assert!(orders.missed.is_empty(), "{:#?}", orders.missed);
}

/// The form each scheme says it preserves, over three steps; the forms of two points are measured on the
/// carried values, at the root of the workspace.
struct Forms {
    missed: Vec<String>,
}

impl<S: Sample<Dual<f64>>> Visitor<S> for Forms {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        let entry = scheme.entry();
        let defect = defect::<f64>(&tangent(&S::sample(), &scheme, &S::begin(), 0.05, 3));
        println!(
            "{} {} on {}: {defect:.1e}",
            entry.name,
            entry.variant,
            S::sample().description().name
        );
        let right = match entry.preserves {
            Form::OnePoint => defect <= 3e-13,
            // Of the observed state, whatever is carried.
            _ => defect > 1e-11,
        };
        if !right {
            self.missed.push(format!("{entry:?}: {defect:e}"));
        }
    }
}

#[test]
fn every_scheme_preserves_its_form() {
    let mut forms = Forms { missed: Vec::new() };
    everywhere(&mut forms);
    assert!(forms.missed.is_empty(), "{:#?}", forms.missed);
}

/// H = √(1 + p²) − cos q + q⁴/10.
#[test]
fn tables_have_their_order_where_neither_half_is_quadratic() {
    let mut orders = Orders { missed: Vec::new() };
    visit_exact::<Hand<Relativistic, 1>>(&mut orders);
    assert!(orders.missed.is_empty(), "{:#?}", orders.missed);
}

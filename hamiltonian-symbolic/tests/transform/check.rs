//! The check of H in new coordinates: it sees slips, wherever H has values.

use super::{bodies, polar};
use crate::common::{parse, system};
use hamiltonian_symbolic::model::{Observable, ObservableKind};
use hamiltonian_symbolic::transform::{Chart, NoTransform, Transformed, apply, check};

/// The verdict on the same H with a term that it does not have.
fn with_term(mut new: Transformed, term: &str) -> Result<usize, NoTransform> {
    let (h, term) = (new.model.h(), parse(&mut new.model, term));
    new.model.hamiltonian = Some(new.model.dag.add(&[h, term]));
    check(&new)
}

#[test]
fn the_check_sees_a_wrong_hamiltonian() {
    let mut new = polar("p_x^2/2 + x*y", "");
    assert_eq!(check(&new), Ok(3));
    new.model.hamiltonian = Some(parse(&mut new.model, "p_r^2/2 + r^2*sin(phi)*cos(phi)"));
    match check(&new) {
        Err(NoTransform::Unverified { point, old, new }) => {
            assert!(!point.is_empty() && old != new);
        }
        other => panic!("{other:?}"),
    }
}

/// A slip that shows for negative parameters only; and a parameter that has a root.
#[test]
fn the_check_compares_at_negative_parameters_too() {
    let of = |h: &str, slip: &str| {
        let new = polar(h, "a b");
        assert_eq!(check(&new), Ok(3));
        with_term(new, slip)
    };
    for (h, slip) in [
        ("a*x*y + p_x^2/2", "(abs(a) - a)*r"),
        ("sqrt(a)*x*y + p_x^2/2 + b", "r/64"),
        ("sqrt(a)*x*y + p_x^2/2 + sqrt(b)", "r/64"),
    ] {
        assert!(
            matches!(of(h, slip), Err(NoTransform::Unverified { .. })),
            "{h}"
        );
    }
}

#[test]
fn the_check_compares_where_every_index_is_in_range() {
    let chart = [Chart::Heliocentric(bodies())];
    let kinetic = "sum(i in 0..n) { p[i]^2/(2*m[i]) }";
    for (sizes, more) in [
        ("n", "(q[4] - q[0])^2"),
        ("n", "q[40]^2"),
        ("n k", "sum(i in 0..k) { q[i]^2 }"),
        ("k n", "sum(i in 0..k) { q[i + 2]^2 }"),
        ("n k", "sum(i in 0..2*k) { q[i]^2 }"),
        ("n", "sqrt(q[0] - 20)"),
        ("n", "sqrt(1/20 - q[0]^2)"),
    ] {
        let h = format!("{kinetic} + {more}");
        let new = apply(&system("q[n]; p[n]", sizes, "m[n]", &h), &chart).unwrap();
        assert!(check(&new).unwrap() > 0, "{h}");
        let wrong = with_term(new, "p_heliocentric[n - 1]/64");
        assert!(matches!(wrong, Err(NoTransform::Unverified { .. })));
    }
    // Nowhere a value, or no sizes that fit: nothing is compared, nor called checked.
    for (sizes, h, why) in [
        ("n", "sqrt(-1 - q[0]^2)", "H has no value"),
        ("n", "q[4]*q[5000]", "no sizes"),
        ("n k", "sum(i in 0..k + 1) { q[n - k + i] }", "no sizes"),
    ] {
        let model = system("q[n]; p[n]", sizes, "m[n]", h);
        match apply(&model, &chart) {
            Err(NoTransform::Uncompared { reason }) => assert!(reason.contains(why), "{reason}"),
            other => panic!("{h}: {other:?}"),
        }
    }
    // Another function of the same system that has values says nothing of H.
    let mut model = system("q[n]; p[n]", "n", "m[n]", "ln(-1 - q[0]^2)");
    let components = vec![parse(&mut model, "q[0]")];
    model.observables.push(Observable {
        name: "first".to_owned(),
        kind: ObservableKind::Monitor,
        components,
    });
    assert!(matches!(
        apply(&model, &chart),
        Err(NoTransform::Uncompared { .. })
    ));
}

#[test]
fn the_check_asks_for_eight_digits_where_there_are_as_many() {
    // A slip of 1e-7 beside numbers whose rounding is far below it.
    let wrong = with_term(polar("p_x^2/2 + 1/(x^2 + y^2)^3", ""), "1/10000000");
    assert!(matches!(wrong, Err(NoTransform::Unverified { .. })));
    // Rounding that leaves fewer is not a slip.
    let new = polar("(x*10^9 + 1)^2 - x^2*10^18 - 2*x*10^9 + p_x", "");
    assert!(check(&new).is_ok());
    // But the digits left must agree.
    let wrong = with_term(new, "10^15*r^2");
    assert!(matches!(wrong, Err(NoTransform::Unverified { .. })));
}

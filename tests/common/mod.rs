//! Shared by the tests: the systems, a reference solution, and checks that are generic over
//! system and scheme.

pub mod bits;
pub mod canonical;
pub mod case;
pub mod derivatives;
pub mod geometry;
pub mod order;
pub mod reference;
pub mod systems;

use hamiltonian::VectorOf;
use hamiltonian::lanes::Cpu;
use hamiltonian::schemes::author::catalogue;
use hamiltonian::{Real, State, System, Vector, schemes::author::Needs};

/// A point in any scalar.
pub fn state<T: Real, S: System>(
    system: &S,
    t: T,
    q: impl IntoIterator<Item = T>,
    p: impl IntoIterator<Item = T>,
) -> State<VectorOf<S, T>> {
    let fill = |values: &mut dyn Iterator<Item = T>| {
        let mut vector = system.zeros();
        for at in 0..vector.len() {
            *vector.component_mut(at) = values.next().expect("as many values as components");
        }
        assert!(values.next().is_none(), "more values than components");
        vector
    };
    State {
        t,
        q: fill(&mut q.into_iter()),
        p: fill(&mut p.into_iter()),
    }
}

/// The number of schemes of the catalogue that are measured on systems the macro makes. The others differ from
/// these by tables and by the equations they solve, not by the code that is emitted: they are
/// measured on systems written by hand, in the tests of their crate.
pub fn measured_here() -> usize {
    const BY_HAND: [&str; 10] = [
        "Compensated",
        "DiscreteGradient",
        "Gauss",
        "MidpointProjected",
        "Mixed",
        "MomentumVariational",
        "Semiexplicit",
        "Tao",
        "TransformedVerlet",
        "Variational",
    ];
    let by_table = |needs: Needs| {
        let of_tables = [Needs::EXACT, Needs::NYSTROM, Needs::QUADRATIC_KINETIC];
        of_tables.iter().any(|one| needs.contains(*one))
    };
    (catalogue())
        .filter(|entry| !by_table(entry.needs) && !BY_HAND.contains(&entry.name))
        .count()
}

/// Returns true if `value` rounds to `quoted`, a number given to so many significant digits.
#[track_caller]
pub fn assert_digits(what: &str, value: f64, quoted: f64, digits: i32) {
    let unit = 10f64.powi(quoted.abs().log10().floor() as i32 - digits + 1);
    // Half a unit for the rounding of the quoted number, and no more.
    assert!(
        (value - quoted).abs() <= 0.5 * unit,
        "{what}: {value:e}, quoted {quoted:e}"
    );
}

/// Returns true if the long versions of the tests were asked for.
pub fn is_heavy() -> bool {
    std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1")
}

/// The levels whose loops differ: in code that is not optimised, products that do not fuse have one.
pub fn levels() -> Vec<Cpu> {
    let all = Cpu::available();
    if is_heavy() {
        all.collect()
    } else {
        all.last().into_iter().collect()
    }
}

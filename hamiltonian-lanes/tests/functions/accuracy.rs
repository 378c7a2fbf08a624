//! Errors in units in the last place, in scalars and on every level, against double-double.

use hamiltonian_lanes::{Cpu, DoubleDouble};

use super::points::{ROWS, Random, Row};

/// The number of points a function.
pub fn points() -> usize {
    if std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1") {
        10_000_000
    } else {
        50_000
    }
}

const CHUNK: usize = 2048;

/// The spacing of doubles around a value, that of subnormals below the normal ones.
fn unit(x: f64) -> f64 {
    let field = (x.abs().to_bits() >> 52).max(1);
    let place = |k: u64| f64::from_bits(if k > 52 { (k - 52) << 52 } else { 1 << (k - 1) });
    place(field)
}

/// The error of `value` in units in the last place of the exact one.
pub fn error(value: f64, exact: DoubleDouble) -> f64 {
    if value.is_nan() != exact.hi().is_nan() {
        return f64::INFINITY;
    }
    if value == exact.hi() && (value.is_infinite() || exact.lo() == 0.0) || value.is_nan() {
        return 0.0;
    }
    if value.is_infinite() || exact.hi().is_infinite() {
        // Rounded up to infinity from half a unit above the largest number.
        let (value, exact) = (
            value.clamp(f64::MIN, f64::MAX),
            exact.hi().clamp(f64::MIN, f64::MAX),
        );
        return if value == exact { 0.5 } else { f64::INFINITY };
    }
    if exact.hi().abs() < 1e-290 {
        // The second word is subnormal: the exact value lies within half a unit of the first, and
        // an error is what is more than that.
        return ((value - exact.hi()).abs() / unit(exact.hi()) - 0.5).max(0.0);
    }
    // A power of two belongs to the binade below it.
    let around = if exact.lo() != 0.0 && (exact.hi() > 0.0) == (exact.lo() < 0.0) {
        f64::from_bits(exact.hi().to_bits() - 1)
    } else {
        exact.hi()
    };
    let difference = (value - exact.hi()) - exact.lo();
    (difference / unit(around)).abs()
}

/// The scalar and every level.
fn columns() -> Vec<Option<Cpu>> {
    std::iter::once(None)
        .chain(Cpu::available().map(Some))
        .collect()
}

#[derive(Default)]
struct Worst {
    error: f64,
    at: (f64, f64),
}

/// The largest errors of one function in the scalar and on every level.
fn measure(row: &Row, random: &mut Random) -> Vec<Worst> {
    let columns = columns();
    let mut worst: Vec<Worst> = columns.iter().map(|_| Worst::default()).collect();
    let mut out = vec![0.0; CHUNK];
    for _ in 0..points().div_ceil(CHUNK) {
        let (x, y): (Vec<f64>, Vec<f64>) = (0..CHUNK).map(|k| row.draw(k, random)).unzip();
        let exact: Vec<DoubleDouble> = (x.iter().zip(&y))
            .map(|(&x, &y)| (row.exact)(DoubleDouble::from(x), DoubleDouble::from(y)))
            .collect();
        for (column, worst) in columns.iter().zip(&mut worst) {
            match column {
                None => {
                    for (out, (&x, &y)) in out.iter_mut().zip(x.iter().zip(&y)) {
                        *out = (row.f64)(x, y);
                    }
                }
                Some(cpu) => (row.lanes)(*cpu, false, &x, &y, &mut out),
            }
            for k in 0..CHUNK {
                let error = error(out[k], exact[k]);
                if error > worst.error {
                    let at = (x[k], y[k]);
                    *worst = Worst { error, at };
                }
            }
        }
    }
    worst
}

#[test]
fn errors_stay_within_their_bounds() {
    let mut random = Random(11);
    let mut failed = Vec::new();
    print!("{:8} {:>5} {:>8}", "function", "bound", "f64");
    for cpu in Cpu::available() {
        print!(" {:>8}", format!("{cpu:?}"));
    }
    println!();
    for row in ROWS {
        let worst = measure(row, &mut random);
        print!("{:8} {:5.1}", row.name, row.bound);
        for worst in &worst {
            print!(" {:8.4}", worst.error);
            if worst.error > row.bound {
                failed.push(format!("{}{:?}: {} ulp", row.name, worst.at, worst.error));
            }
        }
        println!("   f64 worst at {:?}", worst[0].at);
    }
    assert!(
        failed.is_empty(),
        "beyond their bounds:\n{}",
        failed.join("\n")
    );
}

#[test]
fn an_error_of_one_unit_is_seen() {
    let one = DoubleDouble::from(1.0);
    assert_eq!(error(1.0 + f64::EPSILON, one), 1.0);
    assert_eq!(error(1.0, DoubleDouble::new(1.0, f64::EPSILON / 4.0)), 0.25);
    assert_eq!(error(5e-324, DoubleDouble::from(0.0)), 0.5);
    assert_eq!(error(1e-323, DoubleDouble::from(0.0)), 1.5);
    assert_eq!(error(f64::NAN, one), f64::INFINITY);
    assert_eq!(error(f64::INFINITY, one), f64::INFINITY);
}

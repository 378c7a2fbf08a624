//! No argument is slow: between a normal argument and a normal value no operation meets a subnormal
//! number, which on many CPUs takes it a hundred times as long.
//!
//! Read from the flags of the CPU, which remember that an operand was subnormal or a result below
//! the normal numbers: a clock would tell the same only on CPUs that are slow there.
#![cfg(target_arch = "x86_64")]

use core::arch::asm;
use std::hint::black_box;

use hamiltonian_lanes::Cpu;

use super::points::{ROWS, Row};

/// Arguments a decade and sign.
const EACH: usize = 24;

/// Returns true if an operation of `f` had a subnormal operand, or a rounded result below the normal numbers.
fn meets_subnormal(f: impl FnOnce()) -> bool {
    const DENORMAL: u32 = 1 << 1;
    const UNDERFLOW: u32 = 1 << 4;
    let mut control = 0_u32;
    // SAFETY: the control word is read, and written with no bit changed but those flags, which
    // nothing else looks at.
    unsafe {
        asm!("stmxcsr [{}]", in(reg) &mut control);
        control &= !(DENORMAL | UNDERFLOW);
        asm!("ldmxcsr [{}]", in(reg) &control);
    }
    f();
    // SAFETY: as above.
    unsafe { asm!("stmxcsr [{}]", in(reg) &mut control) };
    control & (DENORMAL | UNDERFLOW) != 0
}

/// Arguments of one decade, of both signs.
fn decade(k: i32) -> Vec<f64> {
    let scale: f64 = format!("1e{k}").parse().expect("a number");
    let spread = |i: usize| 1.0 + 8.0 * i as f64 / EACH as f64;
    (0..EACH)
        .flat_map(|i| [scale * spread(i), -scale * spread(i)])
        .filter(|x| x.is_normal())
        .collect()
}

/// The arguments of a function of two numbers beside those of a decade.
const SECOND: [f64; 3] = [1.0, 0.7, 300.0];

/// Returns true if a value is below the normal numbers, or next to them, or leaves them: it has slow terms.
fn is_out_of_range(value: f64) -> bool {
    value.abs() < 64.0 * f64::MIN_POSITIVE || !value.is_finite()
}

/// Returns true if lanes leave their common path, which then computes something else in passing. As the
/// documentation of `Real` lists them.
fn is_rare_in_lanes(name: &str, x: f64, y: f64) -> bool {
    let ((size, large), small) = ((x.abs(), x.abs().max(y)), x.abs().min(y));
    let apart = |limit: i32| large > 2_f64.powi(limit) || large < 2_f64.powi(-limit);
    match name {
        "asinh" | "acosh" => size > 2_f64.powi(100),
        "atan2" => apart(381) || small < large / 2_f64.powi(381),
        _ => false,
    }
}

fn single(row: &Row, x: f64, y: f64) -> bool {
    let mut value = 0.0;
    let meets = meets_subnormal(|| value = black_box((row.f64)(black_box(x), black_box(y))));
    meets && !is_out_of_range(value)
}

#[test]
fn the_flags_see_subnormal_numbers() {
    let square = |x: f64| meets_subnormal(|| _ = black_box(black_box(x) * black_box(x)));
    assert!(square(1e-160) && square(1e-320) && !square(1e-150) && !square(1.0));
}

#[test]
fn no_decade_of_arguments_is_slow() {
    let mut slow: Vec<String> = vec![];
    for row in ROWS {
        for &y in &SECOND {
            for k in -308..=308 {
                let x = decade(k);
                if let Some(x) = x.iter().find(|&&x| single(row, x, y)) {
                    slow.push(format!("{}({x:e}, {y})", row.name));
                }
                let y = vec![y; x.len()];
                let mut values = vec![0.0; x.len()];
                for cpu in Cpu::available() {
                    for unfused in [false, true] {
                        let meets = meets_subnormal(|| {
                            (row.lanes)(cpu, unfused, black_box(&x), black_box(&y), &mut values);
                        });
                        let listed = (x.iter().zip(&y).zip(&values)).any(|((&x, &y), &value)| {
                            is_out_of_range(value) || is_rare_in_lanes(row.name, x, y)
                        });
                        if meets && !listed {
                            slow.push(format!("{}(1e{k}, {}), {cpu:?} {unfused}", row.name, y[0]));
                        }
                    }
                }
            }
        }
    }
    assert!(slow.is_empty(), "{}: {slow:#?}", slow.len());
}

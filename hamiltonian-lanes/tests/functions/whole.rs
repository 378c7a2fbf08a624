//! Whole numbers and remainders: the exact values in scalars and in lanes of every level, with and without fusing.

use hamiltonian_lanes::{Cpu, DoubleDouble, Kernel, Level, Nf, Pack, Real, W, dispatch_at_most};

use super::points::{Random, Range};

/// The four functions, of all pairs of arguments.
struct Values<'a> {
    unfused: bool,
    x: &'a [f64],
    y: &'a [f64],
    out: &'a mut [[f64; 4]],
}

impl Values<'_> {
    #[inline(always)]
    fn fill<P: Pack>(self) {
        let lanes = P::LANES as usize;
        let arguments = self.x.chunks(lanes).zip(self.y.chunks(lanes));
        for (out, (x, y)) in self.out.chunks_mut(lanes).zip(arguments) {
            let (x, y) = (P::load(x, 1.0), P::load(y, 1.0));
            let values = [x.floor(), x.round(), x.modulo(y), x.remainder(y)];
            for (k, out) in (0..).zip(out) {
                for (to, value) in out.iter_mut().zip(&values) {
                    *to = value.lane(k);
                }
            }
        }
    }
}

impl Kernel for Values<'_> {
    type Output = ();
    #[inline(always)]
    fn run<L: Level>(self) {
        if self.unfused {
            self.fill::<Nf<W<L::Pack, 2>>>();
        } else {
            self.fill::<L::Pack>();
        }
    }
}

/// The exact values, from `%` of the standard library, which is exact. The parity of a quotient is that of the
/// remainder by twice the divisor.
fn expected(x: f64, y: f64) -> [f64; 4] {
    let size = y.abs();
    let rest = x % size;
    let modulo = match rest < 0.0 {
        // A sum that rounds to the divisor is 0.
        true if rest + size < size || size.is_infinite() => rest + size,
        true => 0.0,
        false => rest + 0.0,
    };
    let rest = rest.abs();
    let is_odd = size <= f64::MAX / 2.0 && x.abs() % (size + size) >= size;
    // Compared with `rest` by a difference, which is exact from half of the divisor on.
    let above = size - rest;
    let is_up = rest > above || rest == above && is_odd;
    let size_of_remainder = match is_up {
        true => rest - size,
        false => rest,
    };
    let is_small = size.is_infinite() && x.is_finite();
    let remainder = match is_small {
        true => x,
        false if x < 0.0 || x == 0.0 && x.is_sign_negative() => -size_of_remainder,
        false => size_of_remainder,
    };
    [x.floor(), x.round_ties_even(), modulo, remainder]
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

#[test]
fn values_are_exact_in_scalars_and_lanes() {
    use Range::{Any, Binades, Linear, Near};
    let ranges = [
        (Linear(-10.0, 10.0), Linear(-3.0, 3.0)),
        (Linear(-1e9, 1e9), Linear(-3.0, 3.0)),
        (Binades(1e-3, 1e25), Binades(1e-3, 1e3)),
        (Binades(5e-324, f64::MAX), Binades(5e-324, f64::MAX)),
        (Near(4503599627370496.0), Near(2.0)),
        (Near(33554432.0), Near(1.0)),
        (Near(2.5), Near(1.0)),
        (Near(1e300), Near(1e293)),
        (Binades(1e-320, 1e-270), Binades(1e-320, 1e-270)),
        (Any, Any),
    ];
    let mut random = Random(17);
    let (mut x, mut y) = (Vec::new(), Vec::new());
    for k in 0..60_000 {
        let (first, second) = ranges[k % ranges.len()];
        let (a, b) = (first.draw(&mut random), second.draw(&mut random));
        // Multiples and halves of multiples, and their neighbours, are where values jump.
        let halves = (a / b * 2.0).round();
        let near = match k / ranges.len() % 4 {
            0 => halves * b / 2.0,
            1 => (halves * b / 2.0).next_up(),
            _ => a,
        };
        x.push(near);
        y.push(b);
    }
    for k in -9..=9 {
        for size in [2.0, 0.5, 1.5, -1.0] {
            x.push(f64::from(k) * size / 2.0);
            y.push(size);
        }
    }
    let wanted: Vec<[f64; 4]> = x.iter().zip(&y).map(|(x, y)| expected(*x, *y)).collect();
    let check = |found: &[[f64; 4]], what: &str| {
        for (k, (found, wanted)) in found.iter().zip(&wanted).enumerate() {
            for (name, (a, b)) in ["floor", "round", "modulo", "remainder"]
                .iter()
                .zip(found.iter().zip(wanted))
            {
                let (x, y) = (x[k], y[k]);
                assert!(
                    same(*a, *b),
                    "{what}: {name} of {x:e}, {y:e}: {a:e}, expected {b:e}"
                );
            }
        }
    };
    let alone: Vec<[f64; 4]> = x
        .iter()
        .zip(&y)
        .map(|(&x, &y)| [Real::floor(x), Real::round(x), x.modulo(y), x.remainder(y)])
        .collect();
    check(&alone, "f64");
    for cpu in Cpu::available() {
        for unfused in [false, true] {
            let mut out = vec![[0.0; 4]; x.len()];
            let (x, y, out_of) = (&x[..], &y[..], &mut out[..]);
            dispatch_at_most(
                cpu,
                Values {
                    unfused,
                    x,
                    y,
                    out: out_of,
                },
            );
            check(&out, &format!("{cpu:?}, unfused: {unfused}"));
        }
    }
    // The references differ from each other: a method that rounds ties away, and one that truncates, are seen.
    let away = x
        .iter()
        .zip(&wanted)
        .any(|(x, wanted)| x.round() != wanted[1]);
    let truncated = x
        .iter()
        .zip(&y)
        .zip(&wanted)
        .any(|((x, y), wanted)| x % y != wanted[2]);
    assert!(away && truncated);
}

#[test]
fn other_scalars_agree() {
    let mut random = Random(18);
    for _ in 0..20_000 {
        let (x, y) = (
            Range::Linear(-20.0, 20.0).draw(&mut random),
            Range::Linear(-3.0, 3.0).draw(&mut random),
        );
        let wanted = expected(x, y);
        let [a, b] = [x, y].map(DoubleDouble::from);
        let found = [a.floor(), a.round(), a.modulo(b), a.remainder(b)];
        for (found, wanted) in found.iter().zip(wanted) {
            assert!(
                (found.hi() - wanted).abs() <= 1e-15 * (x.abs() + y.abs()),
                "{x:e}, {y:e}"
            );
        }
        let (a, b) = (x as f32, y as f32);
        assert!((0.0..b.abs()).contains(&a.modulo(b)), "{a:e} % {b:e}");
    }
    let whole = |hi: f64, lo: f64| DoubleDouble::new(hi, lo);
    // The trailing word decides, and breaks ties.
    assert_eq!(whole(3.0, -1e-20).floor(), whole(2.0, 0.0));
    assert_eq!(whole(2.5, 1e-20).round(), whole(3.0, 0.0));
    assert_eq!(whole(2.5, -1e-20).round(), whole(2.0, 0.0));
    assert_eq!(whole(3.5, -1e-20).round(), whole(3.0, 0.0));
    assert_eq!(
        whole(4503599627370497.0, 0.5).round(),
        whole(4503599627370498.0, 0.0)
    );
    assert_eq!(
        whole(4503599627370496.0, 0.5).round(),
        whole(4503599627370496.0, 0.0)
    );
    assert_eq!((-1e-20f32).modulo(1.0), 0.0);
}

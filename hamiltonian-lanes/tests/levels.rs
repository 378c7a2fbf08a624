//! Packs of every level this machine has, lane by lane against `f64`.

use hamiltonian_lanes::{
    Called, Cpu, Dual, Kernel, Level, Mask, Nf, Pack, Real, W, dispatch, dispatch_at_most,
};

/// Runs `$check::<P>()` for the packs `P` that are listed, on every level.
macro_rules! on_every_level {
    ($check:ident: $($pack:ty),*) => {{
        struct All;
        impl Kernel for All {
            type Output = ();
            #[inline(always)]
            fn run<L: Level>(self) {
                $($check::<$pack>();)*
            }
        }
        for cpu in Cpu::available() {
            dispatch_at_most(cpu, All);
        }
    }};
    ($check:ident) => {
        on_every_level!($check: L::Scalar, L::Pack, L::Wide, Nf<L::Wide>, W<Nf<L::Pack>, 3>, Called<L::Wide>);
        $check::<f64>();
        $check::<W<f64, 5>>();
    };
}

/// Numbers that decide signs, roundings and exceptions.
const SPECIAL: [f64; 20] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1.5,
    -2.5,
    0.1,
    3.0,
    -7.0,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    f64::MIN_POSITIVE,
    -f64::MIN_POSITIVE,
    5e-324,
    f64::MAX,
    f64::MIN,
    1.0 + f64::EPSILON,
    1e300,
    -1e-300,
];

/// Number `i` of a fixed sequence of numbers, special ones and others of every magnitude.
fn number(i: u64) -> f64 {
    // The finaliser of splitmix64 (Steele, Lea, Flood 2014).
    let mut x = i.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^= x >> 31;
    match x % 4 {
        0 => SPECIAL[(x >> 8) as usize % SPECIAL.len()],
        1 => (x >> 11) as f64 / (1u64 << 50) as f64 - 4.0,
        2 => (x >> 11) as f64 / (1u64 << 46) as f64 - 64.0,
        _ => f64::from_bits(x),
    }
}

/// `LANES` numbers from number `start` on.
fn numbers<P: Pack>(start: u64) -> Vec<f64> {
    (0..u64::from(P::LANES))
        .map(|k| number(start + k))
        .collect()
}

/// The bits, with all NaN the same.
fn bits(x: f64) -> u64 {
    if x.is_nan() {
        f64::NAN.to_bits()
    } else {
        x.to_bits()
    }
}

fn lanes<P: Pack>(x: P) -> Vec<f64> {
    let mut lanes = vec![0.0; P::LANES as usize];
    x.store(&mut lanes);
    lanes
}

/// Returns true if `P` rounds `a·b + c` once.
fn fuses<P: Pack>() -> bool {
    let x = P::constant(0.1, 0.0);
    x.fma(x, -(x * x)).lane(0) != 0.0
}

/// Every operation but the elementary functions, by name.
fn operations<T: Real>(x: T, y: T, z: T) -> Vec<(&'static str, T)> {
    let mut sum = x;
    sum += y;
    let mut difference = x;
    difference -= y;
    let mut product = x;
    product *= y;
    let mut quotient = x;
    quotient /= y;
    vec![
        ("+", x + y),
        ("-", x - y),
        ("*", x * y),
        ("/", x / y),
        ("+=", sum),
        ("-=", difference),
        ("*=", product),
        ("/=", quotient),
        ("negation", -x),
        ("sqrt", x.sqrt()),
        ("abs", x.abs()),
        ("sign", x.sign()),
        ("recip", x.recip()),
        ("min", x.min(y)),
        ("max", x.max(y)),
        ("mul_absorbing", x.mul_absorbing(y)),
        ("select <", T::select(x.lt(y), z, x)),
        ("select <=", T::select(x.le(y), z, x)),
        ("select =", T::select(x.equals(y), z, x)),
        ("select finite", T::select(x.finite(), y, z)),
        ("select &", T::select(x.lt(y) & y.lt(z), x, z)),
        ("select |", T::select(x.lt(y) | y.lt(z), x, z)),
        ("select !", T::select(!x.lt(y), x, z)),
        ("zero", T::zero()),
        ("one", T::one()),
        ("constant", T::constant(0.1, 1e-18)),
        ("lift", T::lift(-0.0)),
    ]
}

fn operations_are_those_of_f64<P: Pack>() {
    for round in 0..400 {
        let start = round * 1000;
        let (x, y, z) = (
            numbers::<P>(start),
            numbers::<P>(start + 300),
            numbers::<P>(start + 600),
        );
        let pack = |numbers: &[f64]| P::load(numbers, 0.0);
        let packed = operations(pack(&x), pack(&y), pack(&z));
        let fma = lanes(pack(&x).fma(pack(&y), pack(&z)));
        let fused = fuses::<P>();
        for k in 0..P::LANES as usize {
            let alone = operations(x[k], y[k], z[k]);
            for ((name, packed), (_, alone)) in packed.iter().zip(&alone) {
                assert_eq!(
                    bits(packed.lane(k as u32)),
                    bits(*alone),
                    "{name} of {}, {}, {} in lane {k}: {packed:?}, not {alone}",
                    x[k],
                    y[k],
                    z[k]
                );
            }
            let expected = if fused {
                x[k].mul_add(y[k], z[k])
            } else {
                x[k] * y[k] + z[k]
            };
            assert_eq!(bits(fma[k]), bits(expected), "{} {} {}", x[k], y[k], z[k]);
        }
    }
}

#[test]
fn every_operation_is_that_of_f64_lane_by_lane() {
    on_every_level!(operations_are_those_of_f64);
}

fn masks_are_flags<P: Pack>() {
    for round in 0..200 {
        let (x, y) = (numbers::<P>(round * 500), numbers::<P>(round * 500 + 250));
        let (a, b) = (P::load(&x, 0.0), P::load(&y, 0.0));
        let flags: Vec<bool> = x.iter().zip(&y).map(|(x, y)| x < y).collect();
        let mask = a.lt(b);
        for (k, flag) in flags.iter().enumerate() {
            assert_eq!(mask.lane(k as u32), *flag);
            assert_eq!((!mask).lane(k as u32), !*flag);
            assert_eq!(a.le(b).lane(k as u32), x[k] <= y[k]);
            assert_eq!(a.equals(b).lane(k as u32), x[k] == y[k]);
            assert_eq!(a.finite().lane(k as u32), x[k].is_finite());
        }
        assert_eq!(mask.all(), flags.iter().all(|flag| *flag));
        assert_eq!(mask.any(), flags.iter().any(|flag| *flag));
        let first = flags.iter().position(|flag| *flag);
        assert_eq!(mask.first(), first.map(|k| k as u32));
        assert_eq!(a.is_finite(), x.iter().all(|x| x.is_finite()));
        assert_eq!(a == b, x == y);
        let same = P::load(&x, 0.0);
        assert_eq!(a == same, !x.iter().any(|x| x.is_nan()));
    }
    for flag in [true, false] {
        let mask = P::Mask::splat(flag);
        assert_eq!((mask.all(), mask.any()), (flag, flag));
        assert_eq!(((!mask).all(), (!mask).any()), (!flag, !flag));
        assert_eq!(mask.first(), flag.then_some(0));
        assert!(!mask.lane(P::LANES) && !mask.lane(u32::MAX));
    }
    for n in 0..P::LANES + 3 {
        let mask = P::below(n);
        for k in 0..P::LANES + 3 {
            assert_eq!(mask.lane(k), k < n.min(P::LANES));
        }
        // The last lane alone is found, too.
        let rest = P::below(P::LANES) & !P::below(n);
        assert_eq!(rest.first(), (n < P::LANES).then_some(n));
    }
}

#[test]
fn masks_are_one_flag_a_lane() {
    on_every_level!(masks_are_flags);
}

fn remainders_are_padded<P: Pack>() {
    let all = P::LANES as usize;
    for len in 0..all + 4 {
        let from: Vec<f64> = (0..len).map(|k| 1.0 + k as f64).collect();
        let x = P::load(&from, -3.0);
        for k in 0..all {
            let expected = from.get(k).copied().unwrap_or(-3.0);
            assert_eq!(x.lane(k as u32), expected);
        }
        assert!(x.lane(P::LANES).is_nan());
        assert_eq!(x.to_f64(), x.lane(0));
        // Nothing beyond the slice or beyond the lanes is written.
        let mut into = vec![7.0; len];
        (x + x).store(&mut into);
        for (k, value) in into.iter().enumerate() {
            assert_eq!(*value, if k < all { 2.0 * from[k] } else { 7.0 });
        }
    }
}

#[test]
fn slices_of_any_length_are_loaded_and_stored() {
    on_every_level!(remainders_are_padded);
}

fn sizes_are_told_lane_by_lane<P: Pack>() {
    for round in 0..100 {
        let x = numbers::<P>(round * 200);
        let pack = P::load(&x, 0.0);
        let size = pack.size();
        for (k, x) in x.iter().enumerate() {
            assert_eq!(bits(size.lane(k as u32)), bits(x.abs()));
        }
        let magnitude = x.iter().fold(0.0, |a, x| Real::max(a, x.abs()));
        assert_eq!(bits(pack.magnitude()), bits(magnitude));
        let dual = Dual::new(pack, pack + pack);
        for (k, x) in x.iter().enumerate() {
            let expected = x.abs() + (x + x).abs();
            assert_eq!(bits(dual.size().lane(k as u32)), bits(expected));
            assert_eq!(dual.finite().lane(k as u32), (x + x).is_finite());
        }
    }
    assert_eq!(<Dual<P> as Real>::LANES, P::LANES);
    assert_eq!(P::epsilon(), f64::EPSILON);
    assert_eq!(lanes(P::default()), vec![0.0; P::LANES as usize]);
    assert_eq!(P::lift(3u32).lane(P::LANES - 1), 3.0);
}

#[test]
fn sizes_and_the_finite_lanes() {
    on_every_level!(sizes_are_told_lane_by_lane);
}

/// The functions whose derivatives decide lane by lane.
fn functions_of_two<T: Real>(x: T, y: T) -> Vec<(&'static str, T)> {
    vec![
        ("atan2", x.atan2(y)),
        ("hypot", x.hypot(y)),
        ("pow", x.pow(y)),
        ("tanh", x.tanh()),
        ("ln", x.ln()),
    ]
}

fn duals_are_those_of_f64<P: Pack>() {
    for round in 0..50 {
        let at = |k: u64| numbers::<P>(round * 400 + 100 * k);
        let (x, dx, y, dy) = (at(0), at(1), at(2), at(3));
        let pack = |numbers: &[f64]| P::load(numbers, 0.0);
        let a = Dual::new(pack(&x), pack(&dx));
        let b = Dual::new(pack(&y), pack(&dy));
        let packed = [operations(a, b, a), functions_of_two(a, b)].concat();
        for k in 0..P::LANES as usize {
            let (a, b) = (Dual::new(x[k], dx[k]), Dual::new(y[k], dy[k]));
            let alone = [operations(a, b, a), functions_of_two(a, b)].concat();
            for ((name, packed), (_, alone)) in packed.iter().zip(&alone) {
                let lane = (packed.re.lane(k as u32), packed.eps.lane(k as u32));
                assert_eq!(
                    (bits(lane.0), bits(lane.1)),
                    (bits(alone.re), bits(alone.eps)),
                    "{name} of {a:?}, {b:?} in lane {k}"
                );
            }
        }
    }
}

#[test]
fn duals_of_packs_have_the_bits_of_duals() {
    on_every_level!(duals_are_those_of_f64: Nf<L::Pack>, Called<Nf<L::Pack>>);
}

/// A function of up to three numbers.
type Function<T> = fn(T, T, T) -> T;

/// The functions of a scalar beside [`operations`] and [`functions_of_two`]. The numbers may be outside of their domain.
fn functions<T: Real>() -> [Function<T>; 30] {
    [
        |x, _, _| x.cbrt(),
        |x, _, _| x.floor(),
        |x, _, _| x.round(),
        |x, _, _| x.sin(),
        |x, _, _| x.cos(),
        |x, _, _| x.tan(),
        |x, _, _| x.asin(),
        |x, _, _| x.acos(),
        |x, _, _| x.atan(),
        |x, _, _| x.sinh(),
        |x, _, _| x.cosh(),
        |x, _, _| x.asinh(),
        |x, _, _| x.acosh(),
        |x, _, _| x.atanh(),
        |x, _, _| x.exp(),
        |x, _, _| x.exp_m1(),
        |x, _, _| x.ln_1p(),
        |x, _, _| x.erf(),
        |x, _, _| x.erfc(),
        |x, _, _| x.stumpff_2(),
        |x, _, _| x.stumpff_3(),
        |x, _, _| x.sin_cos().0,
        |x, _, _| x.sin_cos().1,
        |x, _, _| T::look_up([x], |[x]| [2.0 * x])[0],
        |x, y, _| T::out_of_line(|| x + y),
        |x, y, _| x.modulo(y),
        |x, y, _| x.remainder(y),
        |x, y, _| x.orbit_remainder(y),
        |x, y, z| x.universal_anomaly(y, z),
        |x, y, z| x.fma(y, z),
    ]
}

fn calls_are_the_pack<P: Pack>() {
    for (which, (called, inlined)) in functions::<Called<P>>()
        .iter()
        .zip(functions::<P>())
        .enumerate()
    {
        for round in 0..200 {
            let at = |k: u64| P::load(&numbers::<P>(round * 400 + 100 * k), 0.0);
            let (x, y, z) = (at(0), at(1), at(2));
            let found = lanes(called(Called(x), Called(y), Called(z)));
            for (found, expected) in found.into_iter().zip(lanes(inlined(x, y, z))) {
                assert_eq!(
                    bits(found),
                    bits(expected),
                    "{which} of {x:?}, {y:?}, {z:?}"
                );
            }
            assert_eq!(Called(x).is_finite(), x.is_finite());
        }
    }
}

#[test]
fn calls_have_the_bits_of_the_pack() {
    on_every_level!(calls_are_the_pack: L::Pack, Nf<L::Pack>);
}

struct Which;
impl Kernel for Which {
    type Output = (Cpu, u32, bool);
    fn run<L: Level>(self) -> Self::Output {
        (L::CPU, L::Pack::LANES, fuses::<L::Pack>())
    }
}

#[test]
fn features_can_be_hidden() {
    assert_eq!(dispatch(Which).0, Cpu::best());
    assert!(Cpu::available().is_sorted());
    for limit in Cpu::available() {
        let (cpu, lanes, fused) = dispatch_at_most(limit, Which);
        assert_eq!(cpu, limit);
        let expected = match cpu {
            Cpu::Avx512 => (8, true),
            Cpu::Avx2 => (4, true),
            Cpu::Neon => (2, true),
            _ => (2, false),
        };
        assert_eq!((lanes, fused), expected);
    }
    // A limit above the machine's level gives no more than the machine has.
    assert!(dispatch_at_most(Cpu::Avx512, Which).0 <= Cpu::best());
    assert_eq!(dispatch_at_most(Cpu::Portable, Which).0, Cpu::Portable);
}

/// A kernel that enters its own level again, out of line.
struct Twice(f64);
impl Kernel for Twice {
    type Output = f64;
    #[inline(always)]
    fn run<L: Level>(self) -> f64 {
        struct Square(f64);
        impl Kernel for Square {
            type Output = f64;
            #[inline(always)]
            fn run<L: Level>(self) -> f64 {
                let x = L::Wide::constant(self.0, 0.0);
                x.fma(x, L::Wide::one()).lane(L::Wide::LANES - 1)
            }
        }
        L::enter(Square(L::enter(Square(self.0))))
    }
}

#[test]
fn a_kernel_enters_its_level_again() {
    for cpu in Cpu::available() {
        assert_eq!(dispatch_at_most(cpu, Twice(3.0)), 101.0);
    }
}

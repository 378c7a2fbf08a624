//! The same bits in a scalar and in the lanes of every level that does not fuse, on every machine and
//! with every optimisation: hashes over random arguments, compared with `bits.txt`, which
//! `HAMILTONIAN_RECORD=1` writes.

use hamiltonian_lanes::Cpu;

use super::points::{ROWS, Random, Range::Any};

/// The arguments of a recorded hash.
const RECORDED: usize = 4_096;
/// As many of any bits beside them.
const ANY: usize = 4_096;

fn count() -> usize {
    if std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1") {
        1_000_000
    } else {
        RECORDED
    }
}

/// FNV-1a over the bits of values (G. Fowler, L. C. Noll, K.-P. Vo, 1991); all NaN are one.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Hash(u64);

impl Hash {
    fn add(&mut self, value: f64) {
        let bits = if value.is_nan() {
            f64::NAN.to_bits()
        } else {
            value.to_bits()
        };
        for byte in bits.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

const START: Hash = Hash(0xcbf2_9ce4_8422_2325);

fn hash(values: impl IntoIterator<Item = f64>) -> Hash {
    let mut hash = START;
    values.into_iter().for_each(|value| hash.add(value));
    hash
}

#[test]
fn lanes_have_the_bits_of_scalars() {
    let (mut random, mut others) = (Random(3), Random(4));
    let mut made = String::new();
    for row in ROWS {
        // After the ranges of the function anything, so that some lanes are rare and some are not.
        let (x, y): (Vec<f64>, Vec<f64>) = (0..count())
            .map(|k| row.draw(k, &mut random))
            .chain((0..ANY).map(|_| (Any.draw(&mut others), Any.draw(&mut others))))
            .unzip();
        let scalar = hash(x.iter().zip(&y).map(|(&x, &y)| (row.f64)(x, y)));
        made += &format!("{:8} {:016x}\n", row.name, scalar.0);
        println!("{:8} {:016x}", row.name, scalar.0);
        for cpu in Cpu::available() {
            let lanes = |unfused| {
                let mut out = vec![0.0; x.len()];
                (row.lanes)(cpu, unfused, &x, &y, &mut out);
                hash(out)
            };
            assert_eq!(lanes(true), scalar, "{}, {cpu:?} unfused", row.name);
            if matches!(cpu, Cpu::Portable | Cpu::Sse2) {
                assert_eq!(lanes(false), scalar, "{}, {cpu:?}", row.name);
            }
        }
    }
    if std::env::var_os("HAMILTONIAN_RECORD").is_some_and(|value| value == "1") {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/functions/bits.txt");
        std::fs::write(path, &made).expect("the file can be written");
    } else if count() == RECORDED {
        let recorded: Vec<&str> = include_str!("bits.txt").lines().collect();
        assert_eq!(made.lines().collect::<Vec<_>>(), recorded);
    }
}

//! Bounds of indices, against running the loops.

use hamiltonian_core::errors::InputError;
use hamiltonian_core::private::Reach;

/// A repeatable source of small integers.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: i64) -> i64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as i64 % limit
    }
    fn form(&mut self, length: usize) -> Vec<i64> {
        (0..length).map(|_| self.below(5) - 2).collect()
    }
}

fn value(form: &[i64], variables: &[i64]) -> i64 {
    let terms = form[1..].iter().zip(variables);
    form[0]
        + terms
            .map(|(factor, variable)| factor * variable)
            .sum::<i64>()
}

/// Every value the index takes.
fn run(loops: &[[Vec<i64>; 2]], index: &[i64], variables: &mut Vec<i64>, found: &mut Vec<i64>) {
    let Some(([lower, upper], inner)) = loops.split_first() else {
        found.push(value(index, variables));
        return;
    };
    for i in value(lower, variables)..value(upper, variables) {
        variables.push(i);
        run(inner, index, variables, found);
        variables.pop();
    }
}

fn compare<const LOOPS: usize>(random: &mut Random) -> (bool, bool) {
    let sizes = [random.below(7) as usize, random.below(7) as usize];
    let loops: [[Vec<i64>; 2]; LOOPS] =
        std::array::from_fn(|level| [(); 2].map(|()| random.form(3 + level)));
    let index = random.form(3 + LOOPS);
    let reach: Reach<LOOPS> = Reach {
        sizes: &sizes,
        loops: std::array::from_fn(|level| [&loops[level][0][..], &loops[level][1][..]]),
        index: &index,
    };
    let mut found = Vec::new();
    let mut variables = sizes.map(|size| size as i64).to_vec();
    run(&loops, &index, &mut variables, &mut found);
    let (least, greatest) = (found.iter().min().copied(), found.iter().max().copied());
    for extent in 0..30 {
        let expected = match (least, greatest) {
            (Some(least), _) if least < 0 => Some(least),
            (_, Some(greatest)) if greatest >= extent => Some(greatest),
            _ => None,
        };
        assert_eq!(reach.escape(extent as usize), expected, "{reach:?}");
    }
    (found.is_empty(), least < greatest)
}

#[test]
fn extremes_are_those_of_the_loops_run() {
    let mut random = Random(7);
    let (mut empty, mut spread) = (0, 0);
    for _ in 0..20_000 {
        for (is_empty, has_spread) in [
            compare::<0>(&mut random),
            compare::<1>(&mut random),
            compare::<2>(&mut random),
            compare::<3>(&mut random),
        ] {
            empty += usize::from(is_empty);
            spread += usize::from(has_spread);
        }
    }
    // All kinds occur.
    assert!(empty > 10_000 && spread > 10_000, "{empty} {spread}");
}

#[test]
fn loops_that_are_never_empty_cost_nothing_however_long_or_many() {
    // i in 0..n, j in i + 1..i + 3, k in j + 1..j + 3, l in k..n + 5: q[l + k - j - i].
    const N: usize = 1 << 40;
    const NEST: [[&[i64]; 2]; 4] = [
        [&[0, 0], &[0, 1]],
        [&[1, 0, 1], &[3, 0, 1]],
        [&[1, 0, 0, 1], &[3, 0, 0, 1]],
        [&[0, 0, 0, 0, 1], &[5, 1]],
    ];
    // At most l = n + 4, k - j = 2, i = 0.
    const REACH: Reach<4> = Reach {
        sizes: &[N],
        loops: NEST,
        index: &[0, 0, -1, -1, 1, 1],
    };
    const { assert!(REACH.is_within(N + 7)) };
    const { assert!(!REACH.is_within(N + 6)) };
    assert_eq!(REACH.escape(N + 6), Some(N as i64 + 6));
    // No iteration, no value.
    assert_eq!(
        Reach {
            sizes: &[0],
            ..REACH
        }
        .escape(0),
        None
    );
}

#[test]
fn two_loops_cost_nothing_however_long() {
    // i in 0..n, j in i + 1..n: q[j] and q[j + 1].
    const N: usize = usize::MAX;
    const PAIR: [[&[i64]; 2]; 2] = [[&[0, 0], &[0, 1]], [&[1, 0, 1], &[0, 1, 0]]];
    const INSIDE: bool = Reach {
        sizes: &[N],
        loops: PAIR,
        index: &[0, 0, 0, 1],
    }
    .is_within(N);
    const { assert!(INSIDE) };
    let outside = Reach {
        sizes: &[5],
        loops: PAIR,
        index: &[1, 0, 0, 1],
    };
    let error = outside.check("q[j + 1]", 5).unwrap_err();
    assert!(matches!(
        error,
        InputError::Index {
            reached: 5,
            extent: 5,
            ..
        }
    ));
    assert_eq!(
        error.to_string(),
        "`q[j + 1]` reaches 5, but the extent is 5: the sizes do not fit"
    );
    let range = Reach {
        sizes: &[2],
        loops: [],
        index: &[-3, 1],
    };
    let error = range.check_range("i in n - 3..n").unwrap_err();
    assert_eq!(
        error.to_string(),
        "`i in n - 3..n` begins at -1, but ranges begin at 0 or above: the sizes do not fit"
    );
}

//! Coefficients against the conditions they claim to satisfy, in double-double.
//!
//! Input: every table and the collocation methods. Output: the largest defect of each. Invariant: a
//! table satisfies the conditions of its class up to its order, and not one order further.

use hamiltonian_core::schemes::CheapProcessed4;
use hamiltonian_core::schemes::author::{Splitting, Weight};
use hamiltonian_core::schemes::collocation::Collocation;
use hamiltonian_core::schemes::tables::{
    Class, First, Listing, ProcessedListing, all, all_processed,
};
use hamiltonian_core::{DoubleDouble, Real};

type Number = DoubleDouble;

fn number(value: f64) -> Number {
    DoubleDouble::from(value)
}

fn weight(Weight(hi, lo): Weight) -> Number {
    DoubleDouble::new(hi, lo)
}

/// A word: its letters as numbers from 0, and where to find it without its first letters.
struct Word {
    letters: Vec<usize>,
    /// The number of letters of the second kind, for near-integrable tables.
    perturbations: usize,
    weight: u32,
    /// The words that are this one without its last 1, 2, … letters.
    prefixes: Vec<usize>,
}

/// All words over letters of the given weights whose prefixes `keep` allows.
fn words(weights: &[u32], keep: impl Fn(&Word) -> bool) -> Vec<Word> {
    let mut found = vec![Word {
        letters: vec![],
        perturbations: 0,
        weight: 0,
        prefixes: vec![],
    }];
    let mut next = 0;
    while next < found.len() {
        for (letter, weight) in weights.iter().enumerate() {
            let word = &found[next];
            let mut prefixes = vec![next];
            prefixes.extend(&word.prefixes);
            let longer = Word {
                letters: [&word.letters[..], &[letter]].concat(),
                perturbations: word.perturbations + usize::from(letter == 1),
                weight: word.weight + weight,
                prefixes,
            };
            if keep(&longer) {
                found.push(longer);
            }
        }
        next += 1;
    }
    found
}

/// `series · exp(Σ factors[letter]·letter)` in the words given.
fn times_exponential(words: &[Word], series: &[Number], factors: &[Number]) -> Vec<Number> {
    let product = |(i, word): (usize, &Word)| {
        let mut sum = series[i];
        let mut tail = number(1.0);
        for (m, prefix) in word.prefixes.iter().enumerate() {
            let letter = word.letters[word.letters.len() - 1 - m];
            tail = tail * factors[letter] / number((m + 1) as f64);
            sum += series[*prefix] * tail;
        }
        sum
    };
    words.iter().enumerate().map(product).collect()
}

/// The product of exponentials.
fn composed(words: &[Word], product: &[Vec<Number>]) -> Vec<Number> {
    let unit = (words.iter())
        .map(|word| number(f64::from(u8::from(word.letters.is_empty()))))
        .collect();
    (product.iter()).fold(unit, |series, factors| {
        times_exponential(words, &series, factors)
    })
}

/// The largest difference, over all words, between the product of exponentials and exp(target).
fn defect(words: &[Word], product: &[Vec<Number>], target: &[Number]) -> f64 {
    let (made, exact) = (
        composed(words, product),
        composed(words, &[target.to_vec()]),
    );
    (made.iter().zip(&exact))
        .map(|(made, exact)| (*made - *exact).magnitude())
        .fold(0.0, f64::max)
}

/// The exponents of any map exp(hY₁ + h²Y₂ + …) and its adjoint exp(hY₁ − h²Y₂ + …), stage by stage.
fn maps_and_adjoints(stages: &[(Weight, Weight)], order: u32) -> Vec<Vec<Number>> {
    // ±(±h)ᵏ
    let powers = |duration: Number, sign: Number| {
        let mut power = sign;
        let mut next = |_| {
            power = power * duration * sign;
            power
        };
        (1..=order).map(&mut next).collect()
    };
    (stages.iter())
        .flat_map(|(down, up)| {
            [
                powers(weight(*down), number(1.0)),
                powers(weight(*up), number(-1.0)),
            ]
        })
        .collect()
}

/// A composition of any map and its adjoint.
fn general(stages: &[(Weight, Weight)], order: u32) -> f64 {
    let letters: Vec<u32> = (1..=order).collect();
    let product = maps_and_adjoints(stages, order);
    let target: Vec<_> = (letters.iter())
        .map(|letter| number(f64::from(u8::from(*letter == 1))))
        .collect();
    let words = words(&letters, |word| word.weight <= order);
    defect(&words, &product, &target)
}

/// The strokes of the two pieces in turn.
fn strokes(stages: &[(Weight, Weight)]) -> Vec<Number> {
    let mut strokes = vec![number(0.0)];
    for (down, up) in stages {
        *strokes.last_mut().expect("never empty") += weight(*down);
        strokes.push(weight(*down) + weight(*up));
        strokes.push(weight(*up));
    }
    strokes
}

/// H = A + εB: words with k letters B up to the length `orders[k − 1]`.
fn near_integrable(stages: &[(Weight, Weight)], orders: &[u32]) -> f64 {
    let longest = |perturbations: usize| match perturbations {
        0 => orders[0],
        k => orders[k.min(orders.len()) - 1],
    };
    let words = words(&[1, 1], |word| word.weight <= longest(word.perturbations));
    let product: Vec<_> = (strokes(stages).into_iter().enumerate())
        .map(|(i, stroke)| {
            let zero = number(0.0);
            if i % 2 == 0 {
                vec![stroke, zero]
            } else {
                vec![zero, stroke]
            }
        })
        .collect();
    defect(&words, &product, &[number(1.0), number(1.0)])
}

/// A tree of Nyström's methods for q̈ = f(q): f differentiated, with velocities and trees in it.
#[derive(Clone, PartialEq)]
struct Tree {
    /// The exponent of time in its exact value.
    size: u32,
    velocities: u32,
    subtrees: Vec<Tree>,
}

/// All trees with an exponent up to `largest`, by size.
fn trees(largest: u32) -> Vec<Tree> {
    fn choose(
        left: u32,
        smaller: &[Tree],
        from: usize,
        chosen: &[Tree],
        size: u32,
        found: &mut Vec<Tree>,
    ) {
        found.push(Tree {
            size,
            velocities: left,
            subtrees: chosen.to_vec(),
        });
        for (i, tree) in smaller.iter().enumerate().skip(from) {
            if tree.size + 2 <= left {
                let chosen = [chosen, std::slice::from_ref(tree)].concat();
                choose(left - tree.size - 2, smaller, i, &chosen, size, found);
            }
        }
    }
    let mut found = vec![];
    for size in 0..=largest {
        let smaller = found.clone();
        choose(size, &smaller, 0, &[], size, &mut found);
    }
    found
}

/// Nyström's conditions for q and p up to the order.
fn nystrom(stages: &[(Weight, Weight)], first: First, order: u32) -> f64 {
    let mut now = number(0.0);
    let mut kicks = vec![];
    for (i, stroke) in strokes(stages).into_iter().enumerate() {
        if (i % 2 == 0) == (first == First::Drift) {
            now += stroke;
        } else {
            kicks.push((now, stroke));
        }
    }
    /// The tree's value at each kick, and C where its exact value is C·t^size.
    fn value(tree: &Tree, kicks: &[(Number, Number)]) -> (Vec<Number>, Number) {
        let mut values: Vec<_> = (kicks.iter())
            .map(|(time, _)| (0..tree.velocities).fold(number(1.0), |power, _| power * *time))
            .collect();
        let mut exact = number(1.0);
        for subtree in &tree.subtrees {
            let (inner, constant) = value(subtree, kicks);
            for i in 0..kicks.len() {
                let mut sum = number(0.0);
                for j in 0..i {
                    sum += kicks[j].1 * (kicks[i].0 - kicks[j].0) * inner[j];
                }
                values[i] *= sum;
            }
            exact = exact * constant / number(f64::from((subtree.size + 1) * (subtree.size + 2)));
        }
        (values, exact)
    }
    let mut largest = (now - number(1.0)).magnitude();
    for tree in trees(order - 1) {
        let (values, exact) = value(&tree, &kicks);
        let (mut of_p, mut of_q) = (number(0.0), number(0.0));
        for ((time, kick), value) in kicks.iter().zip(values) {
            of_p += *kick * value;
            of_q += *kick * (number(1.0) - *time) * value;
        }
        let size = f64::from(tree.size);
        largest = largest.max((of_p - exact / number(size + 1.0)).magnitude());
        if tree.size + 2 <= order {
            let exact = exact / number((size + 1.0) * (size + 2.0));
            largest = largest.max((of_q - exact).magnitude());
        }
    }
    largest
}

/// The largest defect of the table's own conditions, and that with one order more.
fn defects(table: &Listing) -> (f64, f64) {
    match table.class {
        Class::General => (
            general(table.stages, table.order),
            general(table.stages, table.order + 1),
        ),
        Class::QuadraticKinetic { first } => (
            nystrom(table.stages, first, table.order),
            nystrom(table.stages, first, table.order + 1),
        ),
        Class::NearIntegrable { orders } => {
            let further: Vec<_> = orders.iter().map(|order| order + 1).collect();
            (
                near_integrable(table.stages, orders),
                near_integrable(table.stages, &further),
            )
        }
    }
}

#[test]
fn tables_satisfy_the_conditions_of_their_class_and_no_more() {
    for table in all() {
        let (defect, further) = defects(&table);
        println!(
            "{}: {defect:.1e}, one order further {further:.1e}",
            table.name
        );
        assert!(defect <= 1e-24, "{}: {defect:e}", table.name);
        assert!(further > 1e-9, "{}: {further:e}", table.name);
    }
}

/// π⁻¹, the kernel and π one after the other.
fn whole(table: &ProcessedListing) -> Vec<(Weight, Weight)> {
    let undone = |(down, up): &(Weight, Weight)| (up.negated(), down.negated());
    let unprocessor = table.processor.iter().rev().map(undone);
    let stages = unprocessor.chain(table.kernel.iter().copied());
    stages.chain(table.processor.iter().copied()).collect()
}

#[test]
fn processed_tables_satisfy_the_conditions_of_their_class_and_their_kernels_do_not() {
    for table in all_processed() {
        let of = |stages: &[(Weight, Weight)]| {
            let stages = Listing {
                name: table.name,
                order: table.order,
                class: table.class,
                stages: stages.to_vec().leak(),
                source: table.source,
            };
            defects(&stages)
        };
        let (defect, further) = of(&whole(&table));
        let (kernel, _) = of(table.kernel);
        println!(
            "{}: {defect:.1e}, one order further {further:.1e}, the kernel alone {kernel:.1e}",
            table.name
        );
        assert!(defect <= 1e-24, "{}: {defect:e}", table.name);
        assert!(further > 1e-9, "{}: {further:e}", table.name);
        assert!(kernel > 1e-6, "{}: {kernel:e}", table.name);
        let durations = table.processor.iter().flat_map(|(down, up)| [down, up]);
        let sum = durations.fold(number(0.0), |sum, duration| sum + weight(*duration));
        assert!(sum.magnitude() <= 1e-30, "{}: {sum:?}", table.name);
    }
}

/// The mean of ρ(h) and ρ(−h) has the even words of ρ.
#[test]
fn the_mean_of_the_cheap_post_processor_has_the_even_words_of_the_processor() {
    let scheme = CheapProcessed4::default();
    let letters: Vec<u32> = (1..=6).collect();
    let words = words(&letters, |word| word.weight <= 6);
    let of = |stages: &[(Weight, Weight)]| composed(&words, &maps_and_adjoints(stages, 6));
    let (cheap, whole) = (
        of(&scheme.mean_of().stages()),
        of(&scheme.processed().processor().stages()),
    );
    let mut largest = [0.0_f64; 7];
    for (word, (a, b)) in words.iter().zip(cheap.iter().zip(&whole)) {
        let at = &mut largest[word.weight as usize];
        *at = at.max((*a - *b).magnitude());
    }
    println!("{largest:?}");
    assert!(largest[1] <= 1e-24, "{largest:?}");
    assert!(largest[2] <= 1e-24 && largest[4] <= 1e-24, "{largest:?}");
    // Not one order further, and ρ alone is another map.
    assert!(largest[6] > 1e-6 && largest[3] > 1e-6, "{largest:?}");
}

#[test]
fn near_integrable_orders_are_exact_one_by_one() {
    for table in all() {
        if let Class::NearIntegrable { orders } = table.class {
            assert_eq!(
                table.order,
                *orders.last().expect("not empty"),
                "{}",
                table.name
            );
            for i in 0..orders.len() {
                // Only this one further; those after it are bounded by it anyway.
                let mut further = orders.to_vec();
                further[i] += 1;
                let defect = near_integrable(table.stages, &further);
                assert!(defect > 1e-13, "{} at ε^{}: {defect:e}", table.name, i + 1);
            }
        }
    }
}

#[test]
fn compositions_of_symmetric_maps_sum_odd_powers_to_zero() {
    let mut found = 0;
    for table in all() {
        if table.class != Class::General || table.stages.iter().any(|(down, up)| down != up) {
            continue;
        }
        found += 1;
        let mut power = 1;
        while power < table.order {
            let sum = (table.stages.iter()).fold(number(0.0), |sum, (half, _)| {
                let gamma = weight(*half) + weight(*half);
                sum + (0..power).fold(number(1.0), |product, _| product * gamma)
            });
            let expected = number(if power == 1 { 1.0 } else { 0.0 });
            let defect = (sum - expected).magnitude();
            assert!(
                defect <= 1e-28,
                "{}: Σγ^{power} off by {defect:e}",
                table.name
            );
            power += 2;
        }
    }
    assert!(found >= 8, "{found} compositions");
}

/// The kick first and the drift first are two different splittings for Nyström tables.
#[test]
fn nystrom_tables_ask_for_their_first_piece() {
    for table in all() {
        if let Class::QuadraticKinetic { first } = table.class {
            let other = match first {
                First::Kick => First::Drift,
                First::Drift => First::Kick,
            };
            let swapped = nystrom(table.stages, other, table.order);
            // If kick first and drift first are both of order 4, there is nothing to lose.
            let general = general(table.stages, table.order);
            println!(
                "{}: swapped {swapped:.1e}, general {general:.1e}",
                table.name
            );
            assert!(general > 1e-9 || table.order == 4, "{}", table.name);
            assert!(swapped > 1e-9 || table.order == 4, "{}", table.name);
        }
    }
}

fn collocation_defect<const S: usize>(method: &Collocation<S>, quadrature: usize) -> f64 {
    let mut largest = 0f64;
    let mut powers = [number(1.0); S];
    for k in 1..=quadrature {
        let k = k as f64;
        let sum = (0..S).fold(number(0.0), |sum, j| sum + method.weights[j] * powers[j]);
        largest = largest.max((sum - number(1.0) / number(k)).magnitude());
        if k <= S as f64 {
            for i in 0..S {
                let sum = (0..S).fold(number(0.0), |sum, j| sum + method.a(i, j) * powers[j]);
                let exact = powers[i] * method.nodes[i] / number(k);
                largest = largest.max((sum - exact).magnitude());
            }
        }
        for (power, node) in powers.iter_mut().zip(&method.nodes) {
            *power *= *node;
        }
    }
    largest
}

fn gauss<const S: usize>() {
    let method = Collocation::<S>::gauss();
    let defect = collocation_defect(&method, 2 * S);
    println!("Gauss {S}: B({}) and C({S}) to {defect:.1e}", 2 * S);
    assert!(defect <= 1e-30, "{S} stages: {defect:e}");
    assert!(collocation_defect(&method, 2 * S + 1) > 1e-20, "{S} stages");
    let double = method.symplectic::<f64>();
    let twice = method.symplectic::<DoubleDouble>();
    for i in 0..S {
        for j in 0..S {
            assert_eq!(double[i][j] + double[j][i], 1.0, "μ {i} {j} of {S}");
            assert_eq!(twice[i][j] + twice[j][i], number(1.0), "μ {i} {j} of {S}");
            assert!((twice[i][j] - method.integrals[i][j]).magnitude() < 1e-30);
        }
    }
}

#[test]
fn gauss_collocation_satisfies_its_conditions() {
    gauss::<1>();
    gauss::<2>();
    gauss::<3>();
    gauss::<4>();
    gauss::<6>();
    gauss::<8>();
    gauss::<16>();
}

fn lobatto<const S: usize>() -> Collocation<S> {
    let method = Collocation::<S>::lobatto();
    let defect = collocation_defect(&method, 2 * S - 2);
    println!("Lobatto {S}: {defect:.1e}");
    assert!(defect <= 1e-30, "{S} stages: {defect:e}");
    assert!(collocation_defect(&method, 2 * S - 1) > 1e-15, "{S} stages");
    for i in 0..S {
        for j in 0..S {
            let (b, a) = (method.weights, method.a(j, i));
            let form = b[i] * method.conjugate(i, j) + b[j] * a - b[i] * b[j];
            assert!(form.magnitude() <= 1e-31);
        }
    }
    method
}

/// The tables of Hairer, Lubich and Wanner, tables II.1.1 and II.1.2, for 2 and 3 stages.
#[test]
fn lobatto_pairs_are_those_of_the_books() {
    let near = |made: DoubleDouble, over_24: f64| {
        let exact = number(over_24) / number(24.0);
        assert!((made - exact).magnitude() <= 1e-31, "{over_24}/24");
    };
    let two = lobatto::<2>();
    let three = lobatto::<3>();
    lobatto::<4>();
    lobatto::<7>();
    let a = [[0.0, 0.0], [12.0, 12.0]];
    let conjugate = [[12.0, 0.0], [12.0, 0.0]];
    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        near(two.a(i, j), a[i][j]);
        near(two.conjugate(i, j), conjugate[i][j]);
    }
    let a = [[0.0, 0.0, 0.0], [5.0, 8.0, -1.0], [4.0, 16.0, 4.0]];
    let conjugate = [[4.0, -4.0, 0.0], [4.0, 8.0, 0.0], [4.0, 20.0, 0.0]];
    for i in 0..3 {
        for j in 0..3 {
            near(three.a(i, j), a[i][j]);
            near(three.conjugate(i, j), conjugate[i][j]);
        }
    }
}

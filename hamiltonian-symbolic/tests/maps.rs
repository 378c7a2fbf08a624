//! Maps and sorts of the engine against those of the standard library.

use hamiltonian_symbolic::dag::Map;
use hamiltonian_symbolic::sort::Arrange;
use std::collections::HashMap;

/// Repeatable numbers below a bound (a linear congruence).
fn numbers(below: u64) -> impl Iterator<Item = u64> {
    let next = |x: &u64| Some(x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1));
    std::iter::successors(Some(7), next).map(move |x| (x >> 33) % below)
}

#[test]
fn maps_have_the_entries_of_the_standard_library() {
    for below in [2, 7, 50, 3000] {
        let (mut own, mut known) = (Map::default(), HashMap::new());
        for (key, value) in numbers(below).zip(0u64..).take(4000) {
            assert_eq!(own.insert(key, value), known.insert(key, value));
            *own.entry(key + 1).or_default() += 1;
            *known.entry(key + 1).or_default() += 1;
        }
        own.retain(|key| key % 3 != 0);
        known.retain(|key, _| key % 3 != 0);
        assert_eq!(own.len(), known.len());
        for key in 0..below + 2 {
            assert_eq!(own.get(&key), known.get(&key));
        }
    }
}

#[test]
fn equal_elements_keep_their_places() {
    for below in [1, 3, 1000] {
        let list = || numbers(below).zip(0..200).collect::<Vec<_>>();
        let (mut own, mut known) = (list(), list());
        own.arrange_by_key(|(key, _)| *key);
        known.sort_by_key(|(key, _)| *key);
        assert_eq!(own, known);
    }
}

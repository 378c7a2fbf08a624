//! Products of powers, Π bᵢ^nᵢ, as lists in the order of first use.
//!
//! Input and output: lists of bases with their exponents. Invariant: each base stands in a list once. An
//! exponent may be 0 until [`product`] or the owner of the list removes it.

use crate::dag::Node;

/// Nodes with their exponents.
pub type Factors = Vec<(Node, i32)>;

/// The exponent of a base, 0 if it is no factor.
pub fn power<B: PartialEq>(factors: &[(B, i32)], base: &B) -> i32 {
    let found = factors.iter().find(|(other, _)| other == base);
    found.map_or(0, |(_, n)| *n)
}

/// Multiplies by base^n; a new base is inserted at `place`.
pub fn multiply_at<B: PartialEq>(factors: &mut Vec<(B, i32)>, place: usize, base: B, n: i32) {
    match factors.iter_mut().find(|(other, _)| *other == base) {
        Some((_, m)) => *m += n,
        None => factors.insert(place, (base, n)),
    }
}

/// Multiplies by base^n; a new base comes last.
pub fn multiply<B: PartialEq>(factors: &mut Vec<(B, i32)>, base: B, n: i32) {
    multiply_at(factors, factors.len(), base, n);
}

/// The product of two lists without factors to the power 0; `None` if an exponent overflows.
pub fn product(a: &[(Node, i32)], b: &[(Node, i32)]) -> Option<Factors> {
    let mut all = a.to_vec();
    for &(node, n) in b {
        power(&all, &node).checked_add(n)?;
        multiply(&mut all, node, n);
    }
    all.retain(|(_, n)| *n != 0);
    Some(all)
}

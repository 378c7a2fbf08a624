//! Index arithmetic as source text, in `usize`.
//!
//! Input: affine indices and bounds. Output: expressions over `_i0` (loop variables), `N0` (const
//! generics) and `_n0` (run-time sizes). Invariant: positive terms are added before negative ones
//! are subtracted, so that no index that is in range overflows on its way.

use hamiltonian_symbolic::index::{Affine, Domain, Index, Size};
use hamiltonian_symbolic::list::IntoList;

/// The names of sizes in the function being written.
#[derive(Debug, Clone, Copy)]
pub struct Indices<'a> {
    /// The name of each size.
    pub sizes: &'a [String],
}

/// A product of sizes. It fits, but it may be 0 where that of some of them does not fit.
fn product(names: &[&str]) -> String {
    let [first, others @ ..] = names else {
        return "1usize".to_owned();
    };
    let times = others.iter().map(|name| format!(".wrapping_mul({name})"));
    (*first).to_owned() + &times.collect::<String>()
}

/// The name of a loop variable.
pub fn variable(domain: Domain) -> String {
    format!("_i{}", domain.0)
}

impl Indices<'_> {
    /// The name of a size.
    pub fn size(&self, size: Size) -> &str {
        &self.sizes[usize::from(size.0)]
    }

    /// The sum of the positive terms, and the negated negative ones.
    fn halves(&self, affine: &Affine) -> (String, Vec<String>) {
        let (mut plus, mut minus) = (String::new(), Vec::new());
        let mut push = |factor: i64, name: String| {
            let term = match factor.unsigned_abs() {
                1 => name,
                k => format!("{k} * {name}"),
            };
            if factor < 0 {
                minus.push(term);
            } else if plus.is_empty() {
                plus = term;
            } else {
                plus = format!("{plus} + {term}");
            }
        };
        for &(domain, factor) in &affine.loops {
            push(factor, variable(domain));
        }
        for &(size, factor) in &affine.sizes {
            push(factor, self.size(size).to_owned());
        }
        for (sizes, factor) in &affine.products {
            let names: Vec<&str> = sizes.iter().map(|size| self.size(*size)).into_list();
            push(*factor, product(&names));
        }
        if affine.constant != 0 {
            push(
                affine.constant.signum(),
                format!("{}usize", affine.constant.unsigned_abs()),
            );
        }
        if plus.is_empty() {
            plus = "0usize".to_owned();
        }
        (plus, minus)
    }

    /// The sum of the positive terms, and that of the negated negative ones; the second may be empty.
    fn joined(&self, affine: &Affine) -> (String, String) {
        let (plus, minus) = self.halves(affine);
        (plus, minus.join(" + "))
    }

    /// An index, or a bound that is not negative.
    pub fn plain(&self, affine: &Affine) -> String {
        let (plus, minus) = self.halves(affine);
        minus.iter().fold(plus, |text, term| text + " - " + term)
    }

    /// The value, or 0 where it is negative.
    pub fn saturating(&self, affine: &Affine) -> String {
        let (plus, minus) = self.joined(affine);
        if minus.is_empty() {
            plus
        } else {
            format!("({plus}).saturating_sub({minus})")
        }
    }

    /// The first value of a loop; nothing is in range where it is negative.
    pub fn start(&self, affine: &Affine) -> String {
        let (plus, minus) = self.joined(affine);
        if minus.is_empty() {
            plus
        } else {
            format!("({plus}).checked_sub({minus}).expect(\"a sum starts at a negative index\")")
        }
    }

    /// `affine % modulo`, Euclidean.
    pub fn wrapped(&self, affine: &Affine, modulo: &Affine) -> String {
        let (plus, minus) = self.joined(affine);
        let n = self.modulus(modulo);
        if minus.is_empty() {
            format!("__h::wrapped({plus}, {n})")
        } else {
            format!(
                "__h::wrapped(__h::wrapped({plus}, {n}) + ({n} - __h::wrapped({minus}, {n})), {n})"
            )
        }
    }

    /// The modulus, ready to stand in a product.
    pub fn modulus(&self, modulo: &Affine) -> String {
        let text = self.plain(modulo);
        if text.contains(' ') {
            format!("({text})")
        } else {
            text
        }
    }

    /// An index wherever it stands.
    pub fn index(&self, index: &Index) -> String {
        let last = match &index.modulo {
            Some(modulo) => self.wrapped(&index.affine, modulo),
            None => self.plain(&index.affine),
        };
        self.in_row(index, &last)
    }

    /// The number of an element whose place on the last axis is given.
    pub fn in_row(&self, index: &Index, last: &str) -> String {
        match &index.outer {
            Some(outer) => {
                let (row, extent) = (self.index(&outer.index), self.modulus(&outer.extent));
                format!("({row}) * {extent} + {last}")
            }
            None => last.to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positive_terms_come_first() {
        let sizes = vec!["N0".to_owned()];
        let indices = Indices { sizes: &sizes };
        let i = Affine::variable(Domain(2));
        let n = Affine::size(Size(0));
        let below = Affine::constant(-1).plus(1, &i);
        assert_eq!(indices.plain(&below), "_i2 - 1usize");
        assert_eq!(indices.plain(&n.plus(-2, &i)), "N0 - 2 * _i2");
        assert_eq!(
            indices.saturating(&Affine::constant(-2).plus(1, &n)),
            "(N0).saturating_sub(2usize)"
        );
        assert_eq!(indices.wrapped(&i, &n), "__h::wrapped(_i2, N0)");
        assert_eq!(
            indices.wrapped(&below, &n),
            "__h::wrapped(__h::wrapped(_i2, N0) + (N0 - __h::wrapped(1usize, N0)), N0)"
        );
    }
}

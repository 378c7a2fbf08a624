//! How often loops run, and sums of powers of their variables.
//!
//! Input: loops and their ranges. Output: polynomials over sizes and the variables of loops around. Invariant: the
//! number of iterations is `end − start` only where that is proven to be nowhere negative, for all sizes; a loop that
//! may be empty the other way round has a number of its own.

use super::atoms::{Algebra, Key, Runs};
use super::polynomial::{Monomial, Poly, Undecided};
use crate::dag::{Dag, Kind, Node};
use crate::index::Domain;
use crate::ranges::Ranges;
use crate::rational::Rational;

/// The largest power of a loop variable that is summed.
const MAX_SUMMED_POWER: i32 = 6;

impl Algebra {
    /// Takes note of how often the loops of an expression run.
    pub(super) fn count(&mut self, dag: &mut Dag, root: Node) -> Result<(), Undecided> {
        for node in dag.reachable(&[root]) {
            let (Kind::Reduce(domain, _) | Kind::Count(domain)) = *dag.kind(node) else {
                continue;
            };
            self.count_loop(dag, domain)?;
        }
        Ok(())
    }

    /// Takes note of how often a loop runs.
    pub(super) fn count_loop(&mut self, dag: &mut Dag, domain: Domain) -> Result<(), Undecided> {
        if self.runs.contains_key(&domain) {
            return Ok(());
        }
        let range = dag.range(domain).clone();
        let length = range.end.checked_plus(-1, &range.start);
        let is_exact = length.is_some_and(|length| dag.is_never_negative(&length));
        let ends = match is_exact {
            true => {
                let ends = [&range.start, &range.end].map(|end| dag.affine(end));
                let [start, end] = ends.map(|end| self.convert(dag, end));
                Some([start?, end?])
            }
            false => None,
        };
        let count = match &ends {
            Some([start, end]) => end.sub(start),
            None => {
                let count = dag.count(domain);
                Poly::atom(self.leaf(dag, count), 1)
            }
        };
        self.runs.insert(domain, Runs { count, ends });
        Ok(())
    }

    /// The sum of a power of the variable of a loop; `None` for other terms, and where it is not known how often the
    /// loop runs.
    pub(super) fn power_sum(
        &mut self,
        dag: &Dag,
        domain: Domain,
        term: &Monomial,
    ) -> Result<Option<Poly>, Undecided> {
        let Some(runs) = self.runs.get(&domain).cloned() else {
            return Ok(None);
        };
        let power = match term.0.as_slice() {
            [] => return Ok(Some(runs.count)),
            [(atom, power)] => {
                let is_variable = match self.entry(*atom).key {
                    Key::Leaf(node) => *dag.kind(node) == Kind::Variable(domain),
                    _ => false,
                };
                if !is_variable || !(1..=MAX_SUMMED_POWER).contains(power) {
                    return Ok(None);
                }
                *power
            }
            _ => return Ok(None),
        };
        let Some([start, end]) = runs.ends else {
            return Ok(None);
        };
        Ok(Some(
            self.sum_below(&end, power)?
                .sub(&self.sum_below(&start, power)?),
        ))
    }

    /// The polynomial that is Σ iᵏ over i in 0..m for m ≥ 0, and whose difference of two values is the sum between
    /// them: mᵏ⁺¹ = Σ_{j ≤ k} (k + 1 over j)·Σ iʲ.
    fn sum_below(&mut self, m: &Poly, power: i32) -> Result<Poly, Undecided> {
        let mut sums: Vec<Poly> = Vec::new();
        for k in 0..=i64::from(power) {
            let mut sum = self.pow(m, k as i32 + 1)?;
            let mut choose = 1;
            for (j, lower) in sums.iter().enumerate() {
                sum = sum.sub(&lower.scale(&Rational::integer(choose)));
                choose = choose * (k + 1 - j as i64) / (j as i64 + 1);
            }
            sums.push(sum.scale(&Rational::new(1, k + 1)));
        }
        Ok(sums.pop().unwrap_or_default())
    }
}

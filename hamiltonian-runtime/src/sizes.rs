//! Arrays and indices at given sizes.
//!
//! Input: shapes and forms over sizes, the sizes. Output: numbers of elements, or the error. Invariant: an index of a
//! system that is made stays in range, so that nothing panics.

use crate::error::SystemError;
use hamiltonian_core::errors::InputError;
use hamiltonian_core::private;
use hamiltonian_language::checked::{Bound, Reach};
use hamiltonian_symbolic::index::{Affine, Domain, Size};
use hamiltonian_symbolic::model::Shape;

/// An index that is in range for some sizes only.
#[derive(Debug)]
pub(crate) struct Obligation {
    shown: String,
    loops: Vec<(Domain, [Affine; 2])>,
    form: Affine,
    limit: Bound,
}

impl Obligation {
    pub(crate) fn of(reach: &Reach) -> Obligation {
        Obligation {
            shown: reach.shown.clone(),
            loops: reach.loops.clone(),
            form: reach.form.clone(),
            limit: reach.limit,
        }
    }

    /// Returns an error if the index leaves its range.
    pub(crate) fn check(&self, sizes: &[usize]) -> Result<(), SystemError> {
        macro_rules! by_loops {
            ($($loops:literal)*) => {
                match self.loops.len() {
                    $($loops => self.check_in::<$loops>(sizes),)*
                    _ => Err(SystemError::Memory { name: self.shown.clone() }),
                }
            };
        }
        by_loops!(0 1 2 3 4 5 6 7 8)
    }

    fn check_in<const LOOPS: usize>(&self, sizes: &[usize]) -> Result<(), SystemError> {
        // The sizes are put in, so that forms are over loops alone.
        let form = |form: &Affine, loops: &[(Domain, [Affine; 2])]| -> Vec<i64> {
            let constant = value(form, sizes);
            let factors = loops.iter().map(|(domain, _)| form.factor(*domain));
            std::iter::once(constant).chain(factors).collect()
        };
        let ranges = self.loops.iter().enumerate().map(|(level, (_, range))| {
            let before = &self.loops[..level];
            range.each_ref().map(|end| form(end, before))
        });
        let ranges: Vec<[Vec<i64>; 2]> = ranges.collect();
        let index = form(&self.form, &self.loops);
        let reach = private::Reach::<LOOPS> {
            sizes: &[],
            loops: std::array::from_fn(|level| ranges[level].each_ref().map(Vec::as_slice)),
            index: &index,
        };
        let checked: Result<(), InputError> = match self.limit {
            Bound::Extent(extent) => {
                let extent = value(&extent.affine(), sizes).max(0) as usize;
                reach.check(&self.shown, extent)
            }
            Bound::Nothing => reach.check_range(&self.shown),
            Bound::Memory => reach.check_memory(&self.shown),
        };
        Ok(checked?)
    }
}

/// The value of a form at 0 of all loops. It saturates: a size too large is found where memory is reserved.
pub(crate) fn value(form: &Affine, sizes: &[usize]) -> i64 {
    let size = |size: Size| i64::try_from(sizes[usize::from(size.0)]).unwrap_or(i64::MAX);
    let mut sum = form.constant;
    for (of, factor) in &form.sizes {
        sum = sum.saturating_add(factor.saturating_mul(size(*of)));
    }
    for (of, factor) in &form.products {
        let product = of
            .iter()
            .fold(1_i64, |product, of| product.saturating_mul(size(*of)));
        sum = sum.saturating_add(factor.saturating_mul(product));
    }
    sum
}

/// The number of elements of an array, or an error if they do not fit into memory: an allocation that fails later ends
/// the process.
pub(crate) fn elements(name: &str, shape: &Shape, sizes: &[usize]) -> Result<usize, SystemError> {
    /// 8 TB of numbers.
    const MOST: i64 = 1 << 40;
    let extent = |form: &Affine| value(form, sizes).max(0);
    let count = match shape {
        Shape::Scalar => 1,
        Shape::Vector(rows) | Shape::Lattice(rows, _) => extent(rows),
        Shape::Matrix(rows, columns) => extent(rows).saturating_mul(extent(columns)),
    };
    let fits = |count: &usize| Vec::<f64>::new().try_reserve_exact(*count).is_ok();
    match usize::try_from(count) {
        Ok(count) if (count as i64) < MOST && fits(&count) => Ok(count),
        _ => Err(SystemError::Memory {
            name: name.to_owned(),
        }),
    }
}

//! The variables of a system, and those in which its definition is written.
//!
//! Input: groups and placements of an analysis, the sizes. Output: [`Coordinates`], [`Declared`]. Invariant: a map between
//! both kinds of variables only moves numbers here; its mathematics is a function of the program.

use crate::sizes::value;
use hamiltonian_language::analyse::variables;
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::model::{Group, Shape};

/// A coordinate or an array of coordinates, with its momenta: its names, its extents and its place in a state.
///
/// ```
/// use hamiltonian_runtime::{Definition, Values};
///
/// let text = "struct Bodies {} H(x, q[2][3]; e, p[2][3]) = e^2 + x^2 + sum(i in 0..2) { norm_squared(p[i])/2 }";
/// let system = Definition::parse(text, "bodies.txt")?.system(Values::new())?;
/// let [x, q] = system.coordinates() else { panic!("there are two") };
/// assert_eq!((x.name(), x.momentum(), x.extents()), ("x", "e", &[][..]));
/// assert_eq!((q.name(), q.momentum(), q.extents()), ("q", "p", &[2, 3][..]));
/// // q[0][0], q[0][1], q[0][2], q[1][0], …
/// assert_eq!(q.places().collect::<Vec<_>>(), [1, 3, 5, 2, 4, 6]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinates {
    name: String,
    momentum: String,
    velocity: Option<String>,
    extents: Vec<usize>,
    first: usize,
    /// The number of columns that are stored one after the other; 1 if elements are stored row after row.
    columns: usize,
}

impl Coordinates {
    /// The name of the coordinates.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The name of the momenta.
    #[must_use]
    pub fn momentum(&self) -> &str {
        &self.momentum
    }

    /// The name of the velocities, of a Lagrangian.
    #[must_use]
    pub fn velocity(&self) -> Option<&str> {
        self.velocity.as_deref()
    }

    /// The extents of the array; none of a number.
    #[must_use]
    pub fn extents(&self) -> &[usize] {
        &self.extents
    }

    /// The places of the elements in the vectors of a state, with the last index fastest.
    pub fn places(&self) -> impl ExactSizeIterator<Item = usize> + '_ {
        let count: usize = self.extents.iter().product();
        let rows = count / self.columns.max(1);
        let place = move |number| self.first + number % self.columns * rows + number / self.columns;
        (0..count).map(place)
    }
}

/// The coordinates of groups, and the number of all.
pub(crate) fn coordinates(groups: &[Group], sizes: &[usize]) -> (Vec<Coordinates>, usize) {
    let extent = |form: &Affine| value(form, sizes).max(0) as usize;
    let mut len = 0;
    let mut all = Vec::with_capacity(groups.len());
    for group in groups {
        let extents = match &group.shape {
            Shape::Scalar => Vec::new(),
            Shape::Vector(rows) => vec![extent(rows)],
            Shape::Matrix(rows, columns) => vec![extent(rows), usize::from(*columns)],
            Shape::Lattice(_, axes) => axes.iter().map(extent).collect(),
        };
        let first = len;
        len += extents.iter().product::<usize>();
        all.push(Coordinates {
            name: group.coordinate.clone(),
            momentum: group.momentum.clone(),
            velocity: group.velocity.clone(),
            extents,
            first,
            columns: usize::from(group.shape.columns()),
        });
    }
    (all, len)
}

/// The variables in which a definition is written, if its system has others.
#[derive(Debug, PartialEq)]
pub(crate) struct Declared {
    pub(crate) coordinates: Vec<Coordinates>,
    pub(crate) len: usize,
    /// Places here and places in the system, with the number of neighbours that move together.
    moved: Vec<(usize, usize, usize)>,
    /// The place of the time among the coordinates of the system, if it has another time.
    pub(crate) time: Option<usize>,
}

impl Declared {
    pub(crate) fn of(declared: &variables::Declared, own: &[Coordinates], sizes: &[usize]) -> Self {
        let (coordinates, len) = coordinates(&declared.groups, sizes);
        let place = |placement: &hamiltonian_symbolic::transform::Placement| {
            let (group, row) = placement.old;
            let group = &coordinates[usize::from(group)];
            let count = match row {
                None => group.extents.iter().product(),
                Some(_) => 1,
            };
            let first = group.first + row.unwrap_or_default() as usize;
            (first, own[usize::from(placement.new)].first, count)
        };
        Declared {
            moved: declared.places.iter().map(place).collect(),
            time: declared.time.map(|group| own[usize::from(group)].first),
            coordinates,
            len,
        }
    }

    /// Moves declared numbers to their places in the system.
    pub(crate) fn enter<T: Copy>(&self, declared: &[T], own: &mut [T]) {
        for (from, to, count) in &self.moved {
            own[*to..to + count].copy_from_slice(&declared[*from..from + count]);
        }
    }

    /// Moves numbers of the system to their declared places.
    pub(crate) fn leave<T: Copy>(&self, own: &[T], declared: &mut [T]) {
        for (to, from, count) in &self.moved {
            declared[*to..to + count].copy_from_slice(&own[*from..from + count]);
        }
    }
}

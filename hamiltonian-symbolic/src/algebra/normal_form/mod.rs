//! The normal form: expressions as polynomials over algebraically independent atoms, and the
//! question whether an expression is identically zero.
//!
//! Input: nodes. Output: [`Proof`]. Invariant: deterministic, and never past a budget; an
//! expression said to be zero is zero wherever it is defined; one said not to be is not at the point
//! given.
//!
//! Atoms are variables, parameters and functions of normal forms. Relations that are known:
//! sin² + cos² = 1 and sums and multiples of angles, hyperbolic functions and powers as
//! exponentials, e^a·e^b = e^(a+b), e^(n ln x) = xⁿ, (√x)² = x, logarithms of products, |x| = x·sign x,
//! min, max and `if` as signs (−1, 0 or 1: the cube is the sign, the square is not 1), polynomials
//! below fraction lines brought over a common denominator.
//! A loop is an atom for each product it sums, the same one for all re-indexings of the loop; sums of powers of its
//! variable are polynomials over the ends of its range.

mod angles;
mod atoms;
mod convert;
mod count;
mod functions;
mod merge;
mod polynomial;
mod reduce;
mod symmetry;
mod telescope;

pub(crate) use atoms::{Algebra, Key, Scope};
pub(crate) use polynomial::{Atom, Budget, Monomial, Poly, Undecided, terms_of_power};

use crate::dag::{Dag, Dependence, Kind, Node};
use crate::index::{Affine, LOOPS, Size, TRIED};
use crate::list::IntoList;
use crate::loops::{Sample, SamplePoint, Signs, sample, unroll_nodes};
use crate::model::Model;
use crate::op::Op;
use crate::ranges::Ranges;
use angles::{LARGEST_MULTIPLE, LONGEST_ANGLE};
use functions::MOST_ARGUMENTS;
use reduce::PASSES;
use symmetry::MAX_REINDEXINGS as REINDEXINGS;

/// The budget of one expansion.
pub(crate) const BUDGET: Budget = Budget {
    terms: 20_000,
    products: 400_000,
};

/// The budget of an expansion that every definition makes.
pub(crate) const SMALL_BUDGET: Budget = Budget {
    terms: 4_000,
    products: 40_000,
};

/// The answer to the question if an expression is identically zero.
#[derive(Clone, PartialEq, Debug)]
pub enum Proof {
    /// It is.
    Zero,
    /// It is not: its value at a point.
    NonZero {
        /// The names of what it depends on with their values; sizes included.
        point: SamplePoint,
        /// Its value there.
        value: f64,
    },
    /// Neither was shown.
    Undecided,
}

/// Decides if a node is identically zero. With sizes that are not literal, zero means for all sizes,
/// and not zero for some small one.
#[must_use]
pub fn is_zero(model: &Model, node: Node) -> Proof {
    is_zero_where(model, node, &[])
}

/// Decides if a node is identically zero where other nodes have values.
#[must_use]
pub(crate) fn is_zero_where(model: &Model, node: Node, others: &[Node]) -> Proof {
    if model.dag.is_zero(node) {
        return Proof::Zero;
    }
    let model = &*model.with_rooms(&[&[node], others].concat());
    // Two points usually decide; the others are for what the normal form does not decide.
    if let Some((point, value)) = witness(model, node, Effort::Glance, others) {
        return Proof::NonZero { point, value };
    }
    let mut dag = model.dag.clone();
    if vanishes(&mut dag, node, Scope::Everywhere) {
        return Proof::Zero;
    }
    // Loops over literal ranges are sums like any other.
    if model.sizes.is_empty()
        && model.dag.has_loops(&[node])
        && let Ok((mut written, images)) = unroll_nodes(model, &[], &[node])
        && vanishes(&mut written.dag, images[0], Scope::Everywhere)
    {
        return Proof::Zero;
    }
    match witness(model, node, Effort::Search, others) {
        Some((point, value)) => Proof::NonZero { point, value },
        None => Proof::Undecided,
    }
}

/// The verdict of the normal form on a node.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Answer {
    /// It is identically zero.
    Zero,
    /// No rule makes it zero; a limit may have left one out.
    Other(Option<Undecided>),
    /// A limit stopped the rules.
    Limit(Undecided),
}

impl Answer {
    /// Why there is no other answer: a clause.
    pub(crate) fn why(self) -> String {
        let no_rule = "no rule shows that it is 0, and no point was found where it is not";
        match self {
            Answer::Zero | Answer::Other(None) => no_rule.to_owned(),
            Answer::Other(Some(limit)) => format!("{no_rule}; {}", limit.why(BUDGET)),
            Answer::Limit(limit) => limit.why(BUDGET),
        }
    }
}

impl Undecided {
    /// The limit, of an expansion with a budget: a clause on the expression.
    pub(crate) fn why(self, budget: Budget) -> String {
        match self {
            Undecided::Budget => format!(
                "multiplied out, it has more than {} terms or takes more than {} products",
                budget.terms, budget.products
            ),
            Undecided::Passes => {
                format!("relations between its functions still apply after {PASSES} passes")
            }
            Undecided::Numbers => "it has numbers that are too long".to_owned(),
            Undecided::Zero => "it divides by 0".to_owned(),
            Undecided::Conditions => {
                "its fractions under a condition have no common denominator".to_owned()
            }
            Undecided::Loops => format!("it has more than {LOOPS} loops"),
            Undecided::Angle => {
                format!("an angle of more than {LONGEST_ANGLE} terms is not taken apart")
            }
            Undecided::Multiple => format!(
                "angles are compared up to {LARGEST_MULTIPLE} times, and down to 1/{LARGEST_MULTIPLE} of, one another"
            ),
            Undecided::Arguments => {
                format!("of the arguments of its functions only {MOST_ARGUMENTS} are compared")
            }
            Undecided::Reindexings => {
                format!("of the re-indexings of a sum only {REINDEXINGS} are compared")
            }
        }
    }
}

/// Returns true if the normal form says that a node is identically zero.
pub(crate) fn vanishes(dag: &mut Dag, node: Node, scope: Scope) -> bool {
    answer(dag, node, scope) == Answer::Zero
}

/// The verdict at all points, at the expense of a number of products for many questions.
pub(crate) fn answer_within(dag: &mut Dag, node: Node, products: &mut usize) -> Answer {
    let mut budget = BUDGET;
    budget.products = budget.products.min(*products);
    let before = budget.products;
    let mut algebra = Algebra::new(budget, Scope::Everywhere);
    let answer = answer_in(&mut algebra, dag, node);
    *products -= before - algebra.budget.products;
    answer
}

/// The expression as its normal form writes it.
pub(crate) fn tidy(dag: &mut Dag, node: Node) -> Option<Node> {
    let mut algebra = Algebra::new(BUDGET, Scope::Everywhere);
    let poly = algebra.convert(dag, node).ok()?;
    let poly = algebra.canonical(&poly).ok()?;
    Some(algebra.node(dag, &poly))
}

/// The verdict of the normal form on a node, loops re-indexed where that helps.
pub(crate) fn answer(dag: &mut Dag, node: Node, scope: Scope) -> Answer {
    answer_in(&mut Algebra::new(BUDGET, scope), dag, node)
}

fn answer_in(algebra: &mut Algebra, dag: &mut Dag, node: Node) -> Answer {
    if dag.is_zero(node) {
        return Answer::Zero;
    }
    let mut decided = decide(algebra, dag, node);
    if decided == Ok(false)
        && let Some(node) = telescope::telescoped(dag, node)
    {
        // Terms that are written out, and cancel, may have elements that the statement does not read.
        algebra.has_unread = true;
        decided = decide(algebra, dag, node);
    }
    match decided {
        Err(undecided) => Answer::Limit(undecided),
        Ok(_) if dag.has_too_many_loops() => Answer::Limit(Undecided::Loops),
        Ok(true) => Answer::Zero,
        Ok(false) => Answer::Other(algebra.left_out),
    }
}

/// Returns true if a node is identically zero by the rules for polynomials and for the loops as they are.
fn decide(algebra: &mut Algebra, dag: &mut Dag, node: Node) -> Result<bool, Undecided> {
    algebra.count(dag, node)?;
    let poly = algebra.convert(dag, node)?;
    if symmetry::summands_vanish(algebra, &poly)? {
        return Ok(true);
    }
    if !dag.has_loops(&[node]) {
        return Ok(false);
    }
    let poly = symmetry::canonical(algebra, dag, &poly)?;
    if symmetry::summands_vanish(algebra, &poly)? {
        return Ok(true);
    }
    let Some(poly) = symmetry::in_triangles(algebra, dag, &poly)? else {
        return Ok(false);
    };
    let poly = symmetry::canonical(algebra, dag, &poly)?;
    symmetry::summands_vanish(algebra, &poly)
}

/// The sizes at which a statement about all sizes is tried: small ones, one past every index that
/// is given by number, and, where there are several sizes, different ones, some twice as large as others. Each is raised
/// until the elements at fixed indices exist; none is left where they exist at no sizes up to [`TRIED`].
pub(crate) fn trials(model: &Model, roots: &[Node]) -> Vec<Vec<i64>> {
    let count = model.sizes.len();
    if count == 0 {
        return vec![Vec::new()];
    }
    let mut last = 0;
    for node in model.dag.reachable(roots) {
        if let Kind::Element(_, row, _) = model.dag.kind(node) {
            for axis in row.axes() {
                last = last.max(axis.affine.constant.saturating_abs());
            }
        }
    }
    let mut trials: Vec<Vec<i64>> = [3, 2, 4, 1, 7].iter().map(|n| vec![*n; count]).into_list();
    if (4..TRIED - 3).contains(&last) {
        trials.push(vec![last + 3; count]);
    }
    if count > 1 {
        trials.push((3..).take(count).into_list());
        trials.push((3..3 + count as i64).rev().into_list());
        trials.push((1..).map(|n| 2 << n).take(count).into_list());
        trials.push((1..=count).rev().map(|n| 2 << n).into_list());
    }
    let mut fitting: Vec<Vec<i64>> = Vec::new();
    for sizes in trials {
        if let Some(sizes) = with_room(model.dag.rooms(), sizes)
            && !fitting.contains(&sizes)
        {
            fitting.push(sizes);
        }
    }
    fitting
}

/// The sizes, raised one by one until no room is negative.
fn with_room(rooms: &[Affine], mut sizes: Vec<i64>) -> Option<Vec<i64>> {
    let value =
        |room: &Affine, sizes: &[i64]| room.value(&|_| 0, &|size: Size| sizes[usize::from(size.0)]);
    while let Some(room) = rooms.iter().find(|room| value(room, &sizes) < 0) {
        let before = value(room, &sizes);
        let raised = (0..sizes.len()).find_map(|at| {
            let mut more = sizes.clone();
            more[at] += 1;
            (more[at] <= TRIED && value(room, &more) > before).then_some(more)
        });
        sizes = raised?;
    }
    Some(sizes)
}

/// The effort of a search for a point.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Effort {
    /// Two points at the first of the sizes tried, and one where parameters are negative.
    Glance,
    /// Eight points at each of the sizes tried, seven where parameters are negative, and 64 where
    /// exponents may be whole.
    Search,
}

/// A point where a node is certainly not zero. Where parameters or the time are negative, which
/// they often cannot be, the others must have values there.
#[must_use]
pub(crate) fn witness(
    model: &Model,
    node: Node,
    effort: Effort,
    others: &[Node],
) -> Option<(SamplePoint, f64)> {
    let mut trials = trials(model, &[node]);
    let (seeds, ways) = match effort {
        Effort::Glance => (2, 1),
        Effort::Search => (8, 7),
    };
    if effort == Effort::Glance {
        trials.truncate(1);
    }
    let witnessed = |sizes: &[i64], how: Sample, others: &[Node]| {
        let (values, mut point) = sample(model, &[node], sizes, how, &[])?;
        if !values[0].is_nonzero() {
            return None;
        }
        let (around, _) = sample(model, &[&[node], others].concat(), sizes, how, &[])?;
        let is_defined = around.iter().all(|other| other.is_defined());
        point.splice(0..0, named(model, sizes));
        is_defined.then_some((point, values[0].value))
    };
    let usual = || {
        (0..seeds).map(|seed| Sample {
            seed,
            signed: seed % 2 == 1,
            ..Sample::default()
        })
    };
    let first = |sizes: &Vec<i64>| usual().find_map(|how| witnessed(sizes, how, &[]));
    if let Some(found) = trials.iter().find_map(first) {
        return Some(found);
    }
    let given = Dependence(Dependence::PARAMETER.0 | Dependence::TIME.0);
    if !model.dag.dependence(node).on(given) {
        return None;
    }
    let negative = |seed: u64, signs: Signs| Sample {
        seed,
        signed: true,
        signs,
        ..Sample::default()
    };
    let is_power = |kind: &Kind| matches!(kind, Kind::Call(Op::Pow, _));
    if effort == Effort::Search && model.dag.has(&[node], &is_power) {
        let signs = std::iter::once(Signs::default()).chain(Signs::negative());
        let found = (0..64).zip(signs.cycle()).find_map(|(seed, signs)| {
            let how = Sample {
                halves: true,
                ..negative(seed, signs)
            };
            witnessed(trials.first()?, how, others)
        });
        if found.is_some() {
            return found;
        }
    }
    trials.iter().find_map(|sizes| {
        let mut signs = Signs::negative().take(ways);
        signs.find_map(|signs| witnessed(sizes, negative(1, signs), others))
    })
}

/// Sizes with their names, as the beginning of a point.
pub(crate) fn named(model: &Model, sizes: &[i64]) -> SamplePoint {
    let names = model.sizes.iter().cloned();
    names.zip(sizes.iter().map(|n| *n as f64)).into_list()
}

/// T and V of an expression that its normal form separates; not where they would be made of the
/// signs that conditions are there: a NaN of the branch not taken would reach the value.
///
/// # Errors
/// The limit that left it undecided, as a clause; `None` where a term couples all the same.
pub(crate) fn separated(model: &mut Model, h: Node) -> Result<(Node, Node), Option<String>> {
    let mut algebra = Algebra::new(SMALL_BUDGET, Scope::Everywhere);
    let poly = algebra
        .convert(&model.dag, h)
        .and_then(|poly| algebra.canonical(&poly))
        .map_err(|undecided| match undecided {
            Undecided::Conditions | Undecided::Zero => None,
            limit => Some(limit.why(SMALL_BUDGET)),
        })?;
    let (mut kinetic, mut potential) = (Poly::default(), Poly::default());
    for (monomial, k) in poly.terms() {
        let dependence = algebra.dependence(monomial);
        let term = Poly::term(k.clone(), monomial.clone());
        match (dependence.on(Dependence::Q), dependence.on(Dependence::P)) {
            (true, true) => {
                return Err(algebra.left_out.map(|limit| limit.why(SMALL_BUDGET)));
            }
            (_, true) => kinetic = kinetic.add(&term),
            _ => potential = potential.add(&term),
        }
    }
    let (kinetic, potential) = (
        algebra.node(&mut model.dag, &kinetic),
        algebra.node(&mut model.dag, &potential),
    );
    let is_condition = |kind: &Kind| matches!(kind, Kind::Select(..));
    let is_sign = |kind: &Kind| matches!(kind, Kind::Call(Op::Sign, _));
    let dag = &model.dag;
    match dag.has(&[h], &is_condition) && dag.has(&[kinetic, potential], &is_sign) {
        true => Err(None),
        false => Ok((kinetic, potential)),
    }
}

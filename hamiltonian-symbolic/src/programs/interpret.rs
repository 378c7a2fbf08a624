//! The interpreter of programs, over any scalar: the reference of what emitted code computes.
//!
//! Input: a program and a point. Output: what a function returns and stores. Invariant: the same operations in
//! the same order as emitted code, so that over `f64` the bits agree. Code for another target that computes what
//! [`run`] computes is right: the values of `prepare`, of the step coefficient and of the evaluation, in order; loops
//! in the order of their variables; sums of innermost loops of 32 iterations or more as eight strided partial sums
//! and a tree; loops over [`Pairs`] of 4096 rows or more tile by tile. In the flows of pieces, which
//! read what they write, there are neither trees nor tiles.
//!
//! The kick of H = ½p² − cos q with the step coefficient ½: p − ½·sin q.
//! ```
//! use hamiltonian_symbolic::dag::{Array, Column, Side};
//! use hamiltonian_symbolic::interpret::{Point, run};
//! use hamiltonian_symbolic::model::{Group, Model};
//! use hamiltonian_symbolic::op::Op;
//! use hamiltonian_symbolic::pipeline::derive;
//! use hamiltonian_symbolic::program::{Purpose, Target};
//!
//! let mut model = Model::default();
//! model.groups.push(Group::scalar("q", "p"));
//! let [q, p] = [Side::Q, Side::P].map(|side| model.scalar(side, 0));
//! let (square, two) = (model.dag.powi(p, 2), model.dag.integer(2));
//! let (kinetic, cosine) = (model.dag.div(square, two), model.dag.call(Op::Cos, &[q]));
//! model.hamiltonian = Some(model.dag.sub(kinetic, cosine));
//! let program = derive(&mut model, &[Purpose::Energy, Purpose::Kick]).expect("it is small");
//!
//! let [of_q, of_p] = [Side::Q, Side::P].map(|side| Column::first(side, 0));
//! let mut point = Point::<f64>::new();
//! point.c = 0.5;
//! point.arrays.insert(Array::Phase(of_q), vec![vec![0.3]]);
//! point.arrays.insert(Array::Phase(of_p), vec![vec![2.0]]);
//! point.outputs.insert(Target::Phase(of_p), vec![vec![2.0]]);
//! let of = |purpose| run(&program, program.function(purpose).expect("it was asked for"), &point);
//! assert_eq!(of(Purpose::Energy).results, [2.0 - 0.3_f64.cos()]);
//! assert_eq!(of(Purpose::Kick).outputs[&Target::Phase(of_p)], [[2.0 - 0.5 * 0.3_f64.sin()]]);
//! ```

use crate::PI_LOW;
use crate::dag::{Array, Map, Partial, Relation};
use crate::index::{Affine, Domain, Index};
use crate::list::IntoList;
use crate::pairs::{self, Pairs, Triangle, pairs};
use crate::program::{Function, Instruction, Loop, Program, Purpose, Step, Target, Update, Value};
use hamiltonian_real::Real;

/// A function written in Rust: the part asked for, at its arguments.
pub type ExternalFunction<T> = fn(Partial, &[T]) -> T;

/// A point at which a program is evaluated.
#[derive(Clone, Debug)]
pub struct Point<T> {
    /// Time.
    pub t: T,
    /// The step coefficient.
    pub c: T,
    /// Sizes by number.
    pub sizes: Vec<usize>,
    /// Scalar parameters by number (anything for the others).
    pub scalars: Vec<T>,
    /// Arrays, by columns.
    pub arrays: Map<Array, Vec<Vec<T>>>,
    /// Outputs, by columns: their shape, and what is added to.
    pub outputs: Map<Target, Vec<Vec<T>>>,
    /// Functions written in Rust.
    pub externals: Vec<ExternalFunction<T>>,
}

impl<T: Real> Point<T> {
    /// An empty point at t = 0 with step coefficient 1.
    #[must_use]
    pub fn new() -> Point<T> {
        Point {
            t: T::zero(),
            c: T::one(),
            sizes: Vec::new(),
            scalars: Vec::new(),
            arrays: Map::default(),
            outputs: Map::default(),
            externals: Vec::new(),
        }
    }
}

impl<T: Real> Default for Point<T> {
    fn default() -> Point<T> {
        Point::new()
    }
}

/// The results of a function, returned and stored.
#[derive(Clone, Debug)]
pub struct Outcome<T> {
    /// The values returned.
    pub results: Vec<T>,
    /// The outputs, by columns.
    pub outputs: Map<Target, Vec<Vec<T>>>,
}

/// Runs a function of a program at a point, all stages.
///
/// # Panics
/// If the point has no array, size or function that the program reads, or an index leaves it.
#[must_use]
pub fn run<T: Real>(program: &Program, function: &Function, point: &Point<T>) -> Outcome<T> {
    run_in_order(program, function, point, false, [pairs::LEAST, pairs::TILE])
}

/// Runs a program with all loops over [`Pairs`] in tiles of so many rows and columns, however few rows there are: a
/// test of what [`run`] does from 4096 rows on.
///
/// # Panics
/// As for [`run`], and if a tile has no rows.
#[must_use]
pub fn run_in_tiles<T: Real>(
    program: &Program,
    function: &Function,
    point: &Point<T>,
    rows: usize,
) -> Outcome<T> {
    run_in_order(program, function, point, false, [1, rows])
}

/// Runs a program with the iterations of every loop of the evaluation in reverse order.
///
/// # Panics
/// As for [`run`].
#[must_use]
pub fn run_reversed<T: Real>(
    program: &Program,
    function: &Function,
    point: &Point<T>,
) -> Outcome<T> {
    run_in_order(program, function, point, true, [usize::MAX, 1])
}

fn run_in_order<T: Real>(
    program: &Program,
    function: &Function,
    point: &Point<T>,
    reversed: bool,
    [least, tile]: [usize; 2],
) -> Outcome<T> {
    let mut machine = Machine {
        program,
        point,
        numbers: vec![T::zero(); program.instructions.len()],
        masks: Map::default(),
        variables: Map::default(),
        outputs: point.outputs.clone(),
        is_in_place: matches!(function.purpose, Purpose::Piece(_) | Purpose::Push),
        reversed: false,
        has_trees: true,
        is_inside: false,
        least,
        tile,
        strides: Map::default(),
        iteration: 0,
    };
    for target in &function.cleared {
        for column in machine.outputs.get_mut(target).into_iter().flatten() {
            column.fill(T::zero());
        }
    }
    for (hoisted, number) in program.hoisted.iter().zip(0..) {
        let rows = machine.affine(&hoisted.rows).max(0) as usize;
        let empty = vec![vec![T::constant(f64::NAN, 0.0); rows]];
        machine.outputs.insert(Target::Hoisted(number), empty);
    }
    machine.steps(&program.prepare);
    machine.steps(&function.coefficient);
    machine.reversed = reversed;
    // A flow that reads one side and moves the other is emitted as one that is apart.
    machine.has_trees = !machine.is_in_place || program.one_way(function).is_some();
    machine.steps(&function.evaluation);
    let results = function
        .results
        .iter()
        .map(|v| machine.number(*v))
        .into_list();
    Outcome {
        results,
        outputs: machine.outputs,
    }
}

struct Machine<'a, T: Real> {
    program: &'a Program,
    point: &'a Point<T>,
    numbers: Vec<T>,
    masks: Map<Value, T::Mask>,
    variables: Map<Domain, i64>,
    outputs: Map<Target, Vec<Vec<T>>>,
    is_in_place: bool,
    reversed: bool,
    /// True if sums of long loops are partial sums and a tree: not in the flows of pieces.
    has_trees: bool,
    /// True inside of a loop.
    is_inside: bool,
    /// The least number of rows of a triangle that is made in tiles.
    least: usize,
    /// The number of rows, and of columns, of a tile.
    tile: usize,
    /// The partial sums of the innermost loop under way, if it is long.
    strides: Map<Value, [T; STRIDE]>,
    /// The number of its iteration.
    iteration: usize,
}

/// The least extent of a loop whose sums are trees.
const LONG: i64 = 32;
/// The number of their partial sums.
const STRIDE: usize = 8;

impl<T: Real> Machine<'_, T> {
    /// The columns an array's elements are read from.
    fn columns(&self, array: &Array) -> &Vec<Vec<T>> {
        match *array {
            Array::Phase(column) if self.is_in_place => &self.outputs[&Target::Phase(column)],
            Array::Hoisted(number) => &self.outputs[&Target::Hoisted(number)],
            _ => &self.point.arrays[array],
        }
    }
    fn number(&self, value: Value) -> T {
        self.numbers[value.0 as usize]
    }
    fn affine(&self, affine: &Affine) -> i64 {
        affine.value(&|d| self.variables[&d], &|s| {
            self.point.sizes[s.0 as usize] as i64
        })
    }
    fn index(&self, index: &Index) -> usize {
        let value = index.value(&|d| self.variables[&d], &|s| {
            self.point.sizes[s.0 as usize] as i64
        });
        usize::try_from(value).expect("an index is not negative")
    }

    fn steps(&mut self, steps: &[Step]) {
        for step in steps {
            match step {
                Step::Let(value) => self.compute(*value),
                Step::Accumulate(accumulator, term) => {
                    let term = self.number(*term);
                    match self.strides.get_mut(accumulator) {
                        Some(strides) => strides[self.iteration % STRIDE] += term,
                        None => self.numbers[accumulator.0 as usize] += term,
                    }
                }
                Step::Store(target, row, column, update) => {
                    let (row, column) = (
                        self.index(row),
                        column.as_ref().map_or(0, |c| self.index(c)),
                    );
                    let old = self.outputs[target][column][row];
                    let new = match *update {
                        Update::Set(v) => self.number(v),
                        Update::Add(v) => old + self.number(v),
                        Update::Sub(v) => old - self.number(v),
                        Update::AddProduct(a, b) => self.number(a).fma(self.number(b), old),
                        Update::SubProduct(a, b) => (-self.number(a)).fma(self.number(b), old),
                    };
                    let columns = self.outputs.get_mut(target);
                    columns.expect("it was read above")[column][row] = new;
                }
                Step::Loop(l) => {
                    let (start, end) = (self.affine(&l.start), self.affine(&l.end));
                    let is_outermost = !std::mem::replace(&mut self.is_inside, true);
                    let is_large = usize::try_from(end).is_ok_and(|end| end >= self.least);
                    let may_tile = is_outermost && is_large && self.has_trees && !self.reversed;
                    match may_tile.then(|| pairs(l, self.program)).flatten() {
                        Some(pairs) => self.tiles(l, &pairs, end as usize),
                        None => self.range(l, start, end, LONG),
                    }
                    self.is_inside = !is_outermost;
                }
            }
        }
    }

    /// The iterations of a loop in a range, whose sums are trees if it has as many as are given.
    fn range(&mut self, l: &Loop, start: i64, end: i64, long: i64) {
        for accumulator in &l.accumulators {
            self.numbers[accumulator.0 as usize] = T::zero();
        }
        if self.has_trees && end - start >= long {
            self.open(&l.body);
        }
        for k in 0..(end - start).max(0) {
            self.iteration = k as usize;
            let i = if self.reversed {
                end - 1 - k
            } else {
                start + k
            };
            self.variables.insert(l.domain, i);
            self.steps(&l.body);
        }
        for (sum, s) in std::mem::take(&mut self.strides) {
            let tree = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
            self.numbers[sum.0 as usize] += tree;
        }
    }

    /// The iterations over the pairs of a triangle, tile by tile: rows of tiles one after the other.
    fn tiles(&mut self, outer: &Loop, pairs: &Pairs, n: usize) {
        let size = self.tile;
        let count = n.div_ceil(size);
        let tile = |k: usize| k * size..((k + 1) * size).min(n);
        for rows in 0..count {
            let columns = match pairs.triangle {
                Triangle::Below => 0..rows + 1,
                Triangle::Above => rows..count,
            };
            for columns in columns {
                for i in tile(rows) {
                    let all = tile(columns);
                    let range = match pairs.triangle {
                        _ if rows != columns => all,
                        Triangle::Below => all.start..i,
                        Triangle::Above => i + 1..all.end,
                    };
                    self.variables.insert(outer.domain, i as i64);
                    for (at, step) in outer.body.iter().enumerate() {
                        match step {
                            Step::Loop(inner) => {
                                self.range(inner, range.start as i64, range.end as i64, 0);
                            }
                            _ if rows != columns && pairs.once.contains(&at) => {}
                            _ => self.steps(std::slice::from_ref(step)),
                        }
                    }
                }
            }
        }
    }

    /// Opens the partial sums of a loop, if it is an innermost one.
    fn open(&mut self, body: &[Step]) {
        if body.iter().any(|step| matches!(step, Step::Loop(_))) {
            return;
        }
        for step in body {
            if let Step::Accumulate(sum, _) = step {
                self.strides.insert(*sum, [T::zero(); STRIDE]);
            }
        }
    }

    fn compute(&mut self, value: Value) {
        let n = |v: &Value| self.numbers[v.0 as usize];
        let real = |x: i64| T::constant(x as f64, 0.0);
        let result = match self.program.instruction(value) {
            Instruction::Constant(rational) => {
                let (hi, lo) = rational.to_words();
                T::constant(hi, lo)
            }
            Instruction::Pi => T::constant(core::f64::consts::PI, PI_LOW),
            Instruction::Scalar(parameter) => self.point.scalars[parameter.0 as usize],
            Instruction::Time => self.point.t,
            Instruction::Coefficient => self.point.c,
            Instruction::StandIn(_) => T::constant(f64::NAN, 0.0),
            Instruction::Variable(domain) => real(self.variables[domain]),
            Instruction::Extent(size) => real(self.point.sizes[size.0 as usize] as i64),
            Instruction::Count(start, end) => real((self.affine(end) - self.affine(start)).max(0)),
            Instruction::Load(array, row, column) => {
                let column_number = column.as_ref().map_or(0, |c| self.index(c));
                let row = self.index(row);
                self.columns(array)[column_number][row]
            }
            Instruction::Accumulator => T::zero(),
            Instruction::Neg(a) => -n(a),
            Instruction::Add(a, b) => n(a) + n(b),
            Instruction::Sub(a, b) => n(a) - n(b),
            Instruction::Mul(a, b) => n(a) * n(b),
            Instruction::MulAdd(a, b, c) => n(a).fma(n(b), n(c)),
            Instruction::MulSub(a, b, c) => n(a).fma(n(b), -n(c)),
            Instruction::NegMulAdd(a, b, c) => (-n(a)).fma(n(b), n(c)),
            Instruction::Div(a, b) => n(a) / n(b),
            Instruction::Recip(a) => n(a).recip(),
            Instruction::Call(op, arguments) => {
                let arguments: Vec<T> = arguments.iter().map(n).into_list();
                op.eval(&arguments)
            }
            Instruction::PairedSin(a) => n(a).sin_cos().0,
            Instruction::PairedCos(sin) => match self.program.instruction(*sin) {
                Instruction::PairedSin(a) => n(a).sin_cos().1,
                other => unreachable!("{other:?} is no sine of a pair"),
            },
            Instruction::External(function, part, arguments) => {
                let arguments: Vec<T> = arguments.iter().map(n).into_list();
                self.point.externals[*function as usize](*part, &arguments)
            }
            Instruction::Select(mask, a, b) => T::select(self.masks[mask], n(a), n(b)),
            Instruction::Compare(relation, a, b) => {
                let mask = match relation {
                    Relation::Less => n(a).lt(n(b)),
                    Relation::LessEqual => n(a).le(n(b)),
                    Relation::Equal => n(a).equals(n(b)),
                };
                self.masks.insert(value, mask);
                return;
            }
            Instruction::Not(a) => {
                self.masks.insert(value, !self.masks[a]);
                return;
            }
            Instruction::And(a, b) => {
                self.masks.insert(value, self.masks[a] & self.masks[b]);
                return;
            }
            Instruction::Or(a, b) => {
                self.masks.insert(value, self.masks[a] | self.masks[b]);
                return;
            }
        };
        self.numbers[value.0 as usize] = result;
    }
}

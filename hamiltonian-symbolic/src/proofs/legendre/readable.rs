//! H and Hamilton's equations of a system that was given by its Lagrangian.
//!
//! Input: the model after the Legendre transform, and how it was made. Output: [`Readable`].
//! Invariants: the formulas are equal to those computed, but for reading: common denominators,
//! determinants and the rows that elimination leaves have names of their own; where the mass matrix depends
//! on coordinates, dp/dt is ∂L/∂q in the velocities, as one would write it. Nothing here is
//! computed with.

use super::{Legendre, Mass};
use crate::dag::{Array, Column, Dag, Dependence, Kind, Map, Node, Parameter, Side};
use crate::diff;
use crate::list::IntoList;
use crate::model::{Model, ParameterDeclaration, Shape};
use crate::print::{
    self, Equations, Notation, hamilton_equations, is_taken, latex, scalar_equation, text,
};
use crate::product::Product;
use crate::rational::Rational;
use crate::sort::Arrange;

/// The form of the equations of motion.
#[derive(Debug)]
enum EquationForm {
    /// q̇ and ṗ of each coordinate, where ∂H/∂q would read worse than ∂L/∂q.
    Lagrange(Vec<(Node, Node)>),
    /// From H with its abbreviations.
    Hamilton(Box<Equations>),
    /// From the H that is computed.
    Computed,
}

/// Formulas with abbreviations.
#[derive(Debug)]
pub struct Readable {
    /// The model with its abbreviations as further parameters.
    model: Model,
    /// Names of parts of H, each with its expression, in the order they are needed.
    names: Vec<(Node, Node)>,
    /// H.
    hamiltonian: Node,
    motion: EquationForm,
}

impl Readable {
    /// The formulas of a system.
    #[must_use]
    pub fn of(model: &Model, legendre: &Legendre) -> Readable {
        let mut readable = Readable {
            model: model.clone(),
            names: Vec::new(),
            hamiltonian: legendre.hamiltonian,
            motion: EquationForm::Computed,
        };
        let (mut kinetic, mut rates) = (Vec::new(), Map::default());
        for mass in &legendre.masses {
            kinetic.extend(readable.kinetic(mass, &mut rates));
        }
        let dag = &mut readable.model.dag;
        let (constant, potential) = &legendre.potential;
        let kinetic = kinetic.iter().map(|part| (Rational::ONE, *part));
        let terms: Vec<(Rational, Node)> = kinetic.chain(potential.iter().cloned()).into_list();
        readable.hamiltonian = dag.linear(constant, &terms);
        let varies = |node: &Node| dag.dependence(*node).on(Dependence::Q);
        let entries = || {
            legendre
                .masses
                .iter()
                .flat_map(|m| m.matrix.iter().flatten())
        };
        let varies = entries().any(varies);
        let hides = readable.hides_variables();
        let lagrange = if varies || hides {
            readable.motion(legendre, &rates)
        } else {
            None
        };
        readable.motion = match lagrange {
            Some(motion) => EquationForm::Lagrange(motion),
            None if hides => EquationForm::Computed,
            None => {
                readable.model.hamiltonian = Some(readable.hamiltonian);
                EquationForm::Hamilton(Box::new(hamilton_equations(&readable.model)))
            }
        };
        readable
    }

    /// Returns true if a name stands for something that has derivatives.
    fn hides_variables(&self) -> bool {
        let both = Dependence(Dependence::Q.0 | Dependence::P.0);
        let mut values = self.names.iter().map(|(_, value)| *value);
        values.any(|value| self.model.dag.dependence(value).on(both))
    }

    /// H in the language, each abbreviation a `let` on a line before it; `signature` stands left of
    /// the equals sign.
    #[must_use]
    pub fn text(&self, signature: &str) -> String {
        let mut lines = String::new();
        for (name, value) in &self.names {
            let (name, value) = (text(&self.model, *name), text(&self.model, *value));
            lines.push_str(&format!("let {name} = {value};\n"));
        }
        let hamiltonian = text(&self.model, self.hamiltonian);
        format!("{lines}{signature} = {hamiltonian}")
    }

    /// H in LaTeX, followed by its abbreviations.
    #[must_use]
    pub fn latex(&self) -> String {
        let mut formula = format!("H = {}", latex(&self.model, self.hamiltonian));
        for line in self.abbreviations(Notation::Latex) {
            formula.push_str(",\\quad ");
            formula.push_str(&line);
        }
        formula
    }

    /// The names in H with their expressions, one a line.
    fn abbreviations(&self, notation: Notation) -> Vec<String> {
        let write = |node| print::write(&self.model, node, notation);
        let lines = self.names.iter();
        lines
            .map(|(name, value)| format!("{} = {}", write(*name), write(*value)))
            .into_list()
    }

    /// Hamilton's equations one a line, then the expressions of the names in them. `None` where they
    /// read no better than from the H that is computed.
    #[must_use]
    pub fn equations(&self, notation: Notation) -> Option<Vec<String>> {
        let line = |(left, right): (String, String)| format!("{left} = {right}");
        let motion = match &self.motion {
            EquationForm::Lagrange(motion) => motion,
            EquationForm::Hamilton(equations) => {
                let lines = equations.written(notation).into_iter().map(line);
                return Some(lines.chain(self.shown(notation)).into_list());
            }
            EquationForm::Computed => return None,
        };
        let mut lines = Vec::new();
        let scalar =
            |side, group, value| line(scalar_equation(&self.model, side, group, notation, value));
        for (group, (rate, _)) in motion.iter().enumerate() {
            lines.push(scalar(Side::Q, group, *rate));
        }
        for (group, (_, force)) in motion.iter().enumerate() {
            lines.push(scalar(Side::P, group, *force));
        }
        lines.extend(self.shown(notation));
        let roots: Vec<Node> = motion.iter().flat_map(|(q, p)| [*q, *p]).into_list();
        let used = self.model.dag.reachable(&roots);
        for group in 0..self.model.groups.len() {
            let own = Array::Velocity(Column::first(Side::Q, group as u16));
            let is_own = |node: &&Node| matches!(self.model.dag.kind(**node), Kind::Element(array, ..) if *array == own);
            if let Some(velocity) = used.iter().find(is_own) {
                let name = print::write(&self.model, *velocity, notation);
                let (left, _) = scalar_equation(&self.model, Side::Q, group, notation, *velocity);
                lines.push(match notation {
                    Notation::Text => format!("where {name} = {left}"),
                    Notation::Latex => format!("{name} = {left}"),
                });
            }
        }
        Some(lines)
    }

    /// The abbreviations of H among the equations: in text they stand as `let` beside H.
    fn shown(&self, notation: Notation) -> Vec<String> {
        match notation {
            Notation::Text => Vec::new(),
            Notation::Latex => self.abbreviations(notation),
        }
    }

    /// The parts of ½wᵀM⁻¹w, and v = M⁻¹w by element.
    fn kinetic(&mut self, mass: &Mass, rates: &mut Map<Node, Node>) -> Vec<Node> {
        let parts = coupled(&self.model.dag, &mass.matrix);
        let is_plain = parts.iter().all(|part| part.len() == 1);
        let is_named = mass.domain.is_none()
            && (mass.order.is_some() || parts.iter().all(|part| part.len() <= 2));
        if !is_plain && !is_named {
            return vec![over(&mut self.model.dag, mass, mass.energy)];
        }
        let mut energies = Vec::new();
        let mut equal: Vec<(Node, Vec<Node>)> = Vec::new();
        for part in &parts {
            match part.as_slice() {
                [i] => {
                    let (m, w) = (mass.matrix[*i][*i], mass.right[*i]);
                    let rate = self.model.dag.div(w, m);
                    rates.insert(mass.elements[*i], rate);
                    match equal.iter_mut().find(|(other, _)| *other == m) {
                        Some((_, with)) => with.push(w),
                        None => equal.push((m, vec![w])),
                    }
                }
                [i, j] => energies.push(self.pair(mass, *i, *j, rates)),
                _ => energies.extend(self.eliminated(mass, part, rates)),
            }
        }
        let dag = &mut self.model.dag;
        for (m, with) in equal.iter().rev() {
            let half = Rational::new(1, 2);
            let energy = match with.as_slice() {
                [w] => dag.product(&half, &[(*w, 2), (*m, -1)]),
                all => {
                    let squares = dag.sum_of_squares(all);
                    dag.product(&half, &[(squares, 1), (*m, -1)])
                }
            };
            energies.insert(0, energy);
        }
        let over = |energy| over(dag, mass, energy);
        energies.into_iter().map(over).into_list()
    }

    /// Two coupled coordinates: by the inverse of their matrix, its determinant by name.
    fn pair(&mut self, mass: &Mass, i: usize, j: usize, rates: &mut Map<Node, Node>) -> Node {
        let (a, b, c) = (mass.matrix[i][i], mass.matrix[i][j], mass.matrix[j][j]);
        let (x, y) = (mass.right[i], mass.right[j]);
        let dag = &mut self.model.dag;
        let (diagonal, square) = (dag.mul(&[a, c]), dag.powi(b, 2));
        let determinant = dag.sub(diagonal, square);
        let determinant = self.named("D", determinant);
        let dag = &mut self.model.dag;
        let energy = {
            let first = dag.product(&Rational::ONE, &[(c, 1), (x, 2)]);
            let mixed = dag.product(&Rational::integer(-2), &[(b, 1), (x, 1), (y, 1)]);
            let second = dag.product(&Rational::ONE, &[(a, 1), (y, 2)]);
            dag.add(&[first, mixed, second])
        };
        let mut rate = |m: Node, own: Node, other: Node| {
            let (own, other) = (dag.mul(&[m, own]), dag.mul(&[b, other]));
            let numerator = dag.sub(own, other);
            quotient(dag, &Rational::ONE, numerator, determinant)
        };
        rates.insert(mass.elements[i], rate(c, x, y));
        rates.insert(mass.elements[j], rate(a, y, x));
        quotient(dag, &Rational::new(1, 2), energy, determinant)
    }

    /// Three and more coordinates: the rows that elimination leaves have names.
    fn eliminated(
        &mut self,
        mass: &Mass,
        part: &[usize],
        rates: &mut Map<Node, Node>,
    ) -> Vec<Node> {
        let (mut matrix, mut right) = (mass.matrix.clone(), mass.right.clone());
        let order = mass.order.iter().flatten().copied();
        let order: Vec<usize> = order.filter(|i| part.contains(i)).into_list();
        let mut energies = Vec::new();
        for (at, &i) in order.iter().enumerate() {
            let suffix = self.suffix(mass.elements[i]);
            if at > 0 {
                matrix[i][i] = self.named(&format!("D_{suffix}"), matrix[i][i]);
                right[i] = self.named(&format!("u_{suffix}"), right[i]);
            }
            let half = Rational::new(1, 2);
            let dag = &mut self.model.dag;
            let square = dag.powi(right[i], 2);
            energies.push(quotient(dag, &half, square, matrix[i][i]));
            for (next, &j) in order.iter().enumerate().skip(at + 1) {
                let dag = &mut self.model.dag;
                let factor = quotient(dag, &Rational::ONE, matrix[i][j], matrix[i][i]);
                let product = dag.mul(&[factor, right[i]]);
                right[j] = dag.sub(right[j], product);
                for &k in &order[next..] {
                    let dag = &mut self.model.dag;
                    let product = dag.mul(&[factor, matrix[i][k]]);
                    let entry = dag.sub(matrix[j][k], product);
                    (matrix[j][k], matrix[k][j]) = (entry, entry);
                }
            }
            // The rest of the next row is used often: its entries get names now.
            if let Some((&j, after)) = order.get(at + 1).map(|j| (j, &order[at + 2..])) {
                for &k in after {
                    let name = format!(
                        "C_{}_{}",
                        self.suffix(mass.elements[j]),
                        self.suffix(mass.elements[k])
                    );
                    let entry = self.named(&name, matrix[j][k]);
                    (matrix[j][k], matrix[k][j]) = (entry, entry);
                }
            }
        }
        for (at, &i) in order.iter().enumerate() {
            let mut rest = vec![(Rational::ONE, right[i])];
            for &k in &order[at + 1..] {
                let dag = &mut self.model.dag;
                let velocity = dag.substitute(mass.elements[k], velocity_of);
                let product = dag.mul(&[matrix[i][k], velocity]);
                rest.push((Rational::MINUS_ONE, product));
            }
            let dag = &mut self.model.dag;
            let numerator = dag.linear(&Rational::ZERO, &rest);
            let rate = quotient(dag, &Rational::ONE, numerator, matrix[i][i]);
            rates.insert(mass.elements[i], rate);
        }
        energies
    }

    /// q̇ and ṗ = ∂L/∂q of scalar coordinates.
    fn motion(
        &mut self,
        legendre: &Legendre,
        rates: &Map<Node, Node>,
    ) -> Option<Vec<(Node, Node)>> {
        if self.model.groups.iter().any(|g| g.shape != Shape::Scalar) {
            return None;
        }
        let slopes = diff::gradient(&mut self.model.dag, legendre.lagrangian, Dependence::Q);
        let mut motion = Vec::new();
        for group in 0..self.model.groups.len() {
            let coordinate = self.model.scalar(Side::Q, group);
            let momentum = self.model.scalar(Side::P, group);
            let slope = slopes.iter().find(|(leaf, _)| *leaf == coordinate);
            let slope = match slope {
                Some((_, slope)) => *slope,
                None => self.model.dag.integer(0),
            };
            let force = self.model.dag.substitute(slope, velocity_of);
            let force = self.model.dag.rebuilt(force);
            motion.push((*rates.get(&momentum)?, force));
        }
        Some(motion)
    }

    /// A sum by a name of its own, its common factors beside it; other things as they are.
    fn named(&mut self, name: &str, value: Node) -> Node {
        let (mut product, rest) = content(&mut self.model.dag, value);
        if !matches!(self.model.dag.kind(rest), Kind::Sum(..)) {
            return value;
        }
        let mut free = name.to_owned();
        let mut count = 1;
        while is_taken(&self.model, &free) {
            count += 1;
            free = format!("{name}{count}");
        }
        let name = self.parameter(free);
        self.names.push((name, rest));
        product.multiply(name, 1);
        product.node(&mut self.model.dag)
    }

    /// A further parameter of the model.
    fn parameter(&mut self, name: String) -> Node {
        let parameter = Parameter(self.model.parameters.len() as u16);
        self.model.parameters.push(ParameterDeclaration {
            name,
            shape: Shape::Scalar,
        });
        self.model.dag.parameter(parameter)
    }

    /// The suffix of names that belong to an element.
    fn suffix(&self, element: Node) -> String {
        let Some((column, row)) = self.model.dag.phase_place(element) else {
            return String::new();
        };
        let group = &self.model.groups[usize::from(column.group)];
        let (name, row) = (&group.coordinate, row.affine.constant);
        match group.shape {
            Shape::Scalar => name.clone(),
            Shape::Vector(_) | Shape::Lattice(..) => format!("{name}_{row}"),
            Shape::Matrix(..) => format!("{name}_{row}_{}", column.column),
        }
    }
}

/// The velocity in the place of a momentum.
fn velocity_of(dag: &mut Dag, element: Node) -> Option<Node> {
    let (column, row) = dag.phase_place(element)?;
    let row = row.clone();
    let velocity = Array::Velocity(column.on(Side::Q));
    (column.side == Side::P).then(|| dag.element(velocity, row, None))
}

/// The rows of a matrix in groups that nothing couples, each in order.
fn coupled(dag: &Dag, matrix: &[Vec<Node>]) -> Vec<Vec<usize>> {
    let mut parts: Vec<Vec<usize>> = Vec::new();
    for (i, row) in matrix.iter().enumerate() {
        let mut own = vec![i];
        parts.retain(|part| {
            let meets = part.iter().any(|j| !dag.is_zero(row[*j]));
            if meets {
                own.extend(part);
            }
            !meets
        });
        own.arrange();
        parts.push(own);
    }
    parts.arrange();
    parts
}

/// Summed over the elements of arrays.
fn over(dag: &mut Dag, mass: &Mass, energy: Node) -> Node {
    match mass.domain {
        Some(domain) => dag.reduce(domain, energy),
        None => energy,
    }
}

/// `k·above/below` in lowest terms, as far as factors show.
fn quotient(dag: &mut Dag, k: &Rational, above: Node, below: Node) -> Node {
    let ((mut product, numerator), (divisor, denominator)) =
        (content(dag, above), content(dag, below));
    let inverse = divisor.pow(-1).map(|inverse| inverse.scaled(k));
    product.multiply(numerator, 1);
    match inverse.and_then(|inverse| product.times(&inverse)) {
        Some(mut quotient) => {
            quotient.multiply(denominator, -1);
            quotient.node(dag)
        }
        None => dag.product(k, &[(above, 1), (below, -1)]),
    }
}

/// A node as product·rest: a sum with the factors and denominators that its terms share taken out.
fn content(dag: &mut Dag, node: Node) -> (Product, Node) {
    let Kind::Sum(constant, terms) = dag.kind(node).clone() else {
        return (Product::of(dag, node), dag.integer(1));
    };
    let mut parts = Vec::with_capacity(terms.len() + 1);
    for (k, term) in terms {
        parts.push(Product::of(dag, term).scaled(&k));
    }
    if !constant.is_zero() {
        parts.push(Product::constant(constant));
    }
    let mut shared = Product::constant(Rational::ONE);
    for (factor, _) in parts.iter().flat_map(|part| &part.factors) {
        if shared.factors.iter().any(|(known, _)| known == factor) {
            continue;
        }
        let least = parts.iter().map(|part| part.exponent(*factor)).min();
        shared.multiply(*factor, least.unwrap_or(0));
    }
    let shared = shared.simplified();
    let mut rest = Vec::with_capacity(parts.len());
    for mut part in parts {
        for (node, n) in &shared.factors {
            part.multiply(*node, -n);
        }
        rest.push(part.split(dag));
    }
    (shared, dag.linear(&Rational::ZERO, &rest))
}

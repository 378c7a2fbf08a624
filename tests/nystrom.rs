//! Tables of Nyström type where a kick V(q, t) stands beside any piece at most quadratic in p, and
//! where their bound forbids them.

use crate::common::order::{Order, slope};
use crate::common::reference::difference;
use crate::common::systems::Relativistic;
use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::schemes::{BlanesCasasEscorihuela8, Srkn11b};
use hamiltonian::schemes::{
    author::{Zigzag, ZigzagOf},
    walk::Visitor,
};
use hamiltonian::{
    DoubleDouble, Nystrom, Scheme, Split, Vector, hamiltonian,
    schemes::author::{Entry, Listed, Point, Step},
};

hamiltonian! {
    /// A charge in a uniform magnetic field and a well.
    pub struct Uniform { B = 1.3 }
    H(x, y; p_x, p_y) = ((p_x + B*y/2)^2 + (p_y - B*x/2)^2)/2 + (x^2 + 2*y^2)^2/4
}

hamiltonian! {
    /// Zeeman's effect on a softened hydrogen atom in light.
    pub struct Zeeman { B = 0.8 }
    H(x, y, z; p_x, p_y, p_z; t) = (p_x^2 + p_y^2 + p_z^2)/2 + B*(x*p_y - y*p_x)/2
        - 1/sqrt(1 + x^2 + y^2 + z^2) + x*cos(t)/3;
    split {
        Free = (p_x^2 + p_y^2 + p_z^2)/2 + B*(x*p_y - y*p_x)/2;
        V = -1/sqrt(1 + x^2 + y^2 + z^2) + x*cos(t)/3;
    }
}

hamiltonian! {
    /// A rotating frame, the potential first.
    pub struct Rotating { omega = 0.9 }
    let V(x, y) = -1/sqrt(1 + (x - 1/2)^2 + y^2);
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + omega*(y*p_x - x*p_y) + V(x, y);
    split {
        Potential = V(x, y);
        Rest = (p_x^2 + p_y^2)/2 + omega*(y*p_x - x*p_y);
    }
}

hamiltonian! {
    /// The same, the potential last.
    pub struct Turned { omega = 0.9 }
    let V(x, y) = -1/sqrt(1 + (x - 1/2)^2 + y^2);
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + omega*(y*p_x - x*p_y) + V(x, y);
    split {
        Rest = (p_x^2 + p_y^2)/2 + omega*(y*p_x - x*p_y);
        Potential = V(x, y);
    }
}

hamiltonian! {
    /// A mass that depends on the coordinate.
    pub struct Wire {}
    H = (1 + q^2)*p^2/2 - cos(q)
}

hamiltonian! {
    /// A force without a potential, which depends on place and time alone.
    pub struct Pushed {}
    H(x, y; p_x, p_y; t) = (p_x^2 + p_y^2)/2 + p_x + x^4/4;
    force(x, y; p_x, p_y) = [sin(2*t) - y, x*cos(t)]
}

/// The slopes of tables of order 6 and 8.
fn orders<S: Nystrom>(system: S, q: &[f64], p: &[f64]) {
    let mut order = Order::new(system, q, p, 2.0, 0.2);
    order.visit(Srkn11b);
    order.visit(BlanesCasasEscorihuela8);
    let slopes: Vec<f64> = order.measured.iter().map(|(_, slope)| *slope).collect();
    println!("{}: {slopes:.3?}", order.system.description().name);
    assert_eq!(slopes.len(), 2);
}

#[test]
fn order_is_kept_beside_any_piece_at_most_quadratic_in_momenta() {
    orders(Uniform::default(), &[0.7, -0.4], &[0.3, 0.8]);
    orders(Zeeman::default(), &[0.7, -0.4, 0.5], &[0.3, 0.8, -0.2]);
    orders(Rotating::default(), &[0.7, -0.4], &[0.3, 0.8]);
    orders(Wire::default(), &[0.7], &[0.8]);
}

/// Against a general composition of order 8.
#[test]
fn order_is_kept_under_a_force_without_momenta() {
    fn end<M: Scheme<Pushed>>(scheme: M, steps: u64) -> StateOf<Pushed, DoubleDouble> {
        let numbers = |v: [f64; 2]| v.map(DoubleDouble::from);
        let start = State::over(numbers([0.7, -0.4]), numbers([0.3, 0.8]));
        let h = DoubleDouble::from(2.0 / steps as f64);
        let run = Integrator::new(&Pushed::default(), scheme, start, h);
        let end = run.expect("a good start").advance(steps).cloned();
        end.expect("good steps")
    }
    let exact = end(KahanLi8, 1024);
    let points = [16, 32, 64, 128].map(|steps| {
        let error = difference(&end(Srkn11b, steps), &exact);
        (2.0 / steps as f64, error)
    });
    let slope = slope(&points);
    println!("{slope:.3}");
    assert!((slope - 6.0).abs() <= 0.1, "{slope}, {points:?}");
}

/// The kick is the first stroke of the table, wherever it stands among the pieces.
#[test]
fn the_kick_is_found_in_either_place() {
    fn end<S: Nystrom>(system: &S) -> Vec<f64> {
        let start = crate::common::state(system, 0.0, [0.7, -0.4], [0.3, 0.8]);
        let run = Integrator::new(system, Srkn11b, start, 0.25);
        let end = run.expect("a good start").advance(40).cloned();
        let end = end.expect("good steps");
        end.q.components().chain(end.p.components()).collect()
    }
    let (rotating, turned) = (Rotating::default(), Turned::default());
    assert_eq!(
        rotating.description().pieces[0].formula,
        turned.description().pieces[1].formula
    );
    let ends = [end(&rotating), end(&turned)];
    assert_eq!(ends[0], ends[1]);
}

/// A table of Nyström type on the pieces of a split, whatever they are.
#[derive(Debug, Clone)]
struct OnPieces(Srkn11b);

impl Listed for OnPieces {
    fn entry(&self) -> Entry {
        Entry {
            order: 4,
            ..self.0.entry()
        }
    }
}

impl<S: Split> Scheme<S> for OnPieces {
    type Carried = Point<S::Shape>;
    type Map<T: Real> = ZigzagOf<T, S, S::Pieces<T>, Srkn11b>;
    fn prepare<T: Real>(&self, prepared: &S::Prepared<T>, step: Step<T>) -> Self::Map<T> {
        Zigzag::new(&self.0, &S::pieces::<T>(), prepared, step)
    }
    fn start<T: Real>(
        &self,
        _: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        _: T,
    ) -> Point<VectorOf<S, T>> {
        state.point()
    }
}

hamiltonian! {
    /// (34), both pieces quadratic in p.
    pub struct Squares {}
    H = (q^2 + 1)*(p^2 + 1)/2;
    split { Oscillator = (q^2 + p^2 + 1)/2; Product = q^2*p^2/2; }
}

/// Pairings that rustc refuses lose two orders: `tests/ui/rustc/nystrom.rs`.
#[test]
fn order_is_lost_where_the_bound_forbids_it() {
    Order::new(Squares::default(), &[0.8], &[-0.5], 2.0, 0.2).visit(OnPieces(Srkn11b));
    Order::new(Relativistic::default(), &[0.9], &[0.4], 2.0, 0.2).visit(OnPieces(Srkn11b));
}

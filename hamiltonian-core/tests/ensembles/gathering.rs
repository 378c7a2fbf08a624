//! Parameters of each member, from every way to define a system.

use super::members::agrees;
use super::*;
use hamiltonian::Unforced;
use hamiltonian::lanes::{Mask, Pack};
use hamiltonian::private::SVector;
use hamiltonian::schemes::author::{Description, Dynamics, Group, VectorField, gather};

hamiltonian! {
    /// Oscillators, each with its spring.
    pub struct Springs { k: [3], c = 0.1, d: [2][1][3] }
    H(q[3]; p[3]) = sum(i in 0..3) { p[i]^2/2 + k[i]*q[i]^2/2 + d[1][0][i]*q[i]^4 } + c*q[0]^2*q[1]
}

hamiltonian! {
    /// A chain of masses, whose length is set at run time, in the well of a matrix.
    pub struct Masses { n: usize, m: [n], w: [n][n], d: [n][2][n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) }
        + sum(i in 0..n, j in 0..n) { w[i][j]*q[i]*q[j] + d[i][1][j]*q[i]^2*q[j]^2 }
}

#[test]
fn captures_of_each_member() {
    let swing = |member: Member| {
        let at = part(member.index);
        let (l, g) = (1.0 + at, 2.0 - at);
        let system = hamiltonian! { H(q; p) = p^2/(2*l^2) - g*l*cos(q) };
        (system, State::new([at - 0.3], [0.2]))
    };
    agrees(swing, StormerVerlet::default());
}

#[test]
fn arrays_of_each_member() {
    let springs = |member: Member| {
        let at = part(member.index);
        let springs = Springs {
            k: [1.0, 2.0 - at, at].into(),
            c: 0.1 * at,
            d: [[[0.0; 3]], [[0.1, at, 0.2]]],
        };
        (springs, State::new([at, 0.3, -at], [0.2, at, 0.1]))
    };
    agrees(springs, StormerVerlet::default());
    let masses = |member: Member| {
        let at = part(member.index);
        let w = vec![vec![0.3, 0.1 * at, 0.0], vec![0.2; 3], vec![at, 0.1, 0.5]];
        let d = vec![[[0.0; 3], [0.1, 0.2 * at, 0.3]]; 3];
        let masses = Masses::new(3, vec![1.0, 1.0 + at, 2.0 - at], w, d).expect("three masses");
        (masses, State::new(vec![at, 0.3, -at], vec![0.2, at, 0.1]))
    };
    agrees(masses, StormerVerlet::default());
}

/// H = ½(p² + ω²q²), by hand; it describes no parameters.
struct Spring {
    omega: f64,
}

const GROUPS: &[Group] = &[Group::scalar("theta", "p", 0)];
const SPRING: &Description = &Description::new("Spring", GROUPS);

/// It, prepared.
#[derive(Debug, Clone)]
struct Ready<T> {
    omega_squared: T,
}

/// It, with a step.
#[derive(Debug, Clone)]
struct Scaled<T>(T, T);

impl Unforced for Spring {}

impl System for Spring {
    type Shape = SVector<(), 1>;
    type Prepared<T: Real> = Ready<T>;
    fn description(&self) -> &Description {
        SPRING
    }
    fn prepare<T: Real>(&self) -> Ready<T> {
        Ready {
            omega_squared: T::constant(self.omega * self.omega, 0.0),
        }
    }
    fn zeros<T: Real>(&self) -> SVector<T, 1> {
        SVector::from_element(T::zero())
    }
    #[inline(always)]
    fn gather<T: Real, P: Pack>(members: &[&Ready<T>]) -> Ready<T::Over<P>> {
        Ready {
            omega_squared: gather::number::<T, P, _>(members, |one| one.omega_squared),
        }
    }
    fn fits<T: Real>(_: &Self::Prepared<T>, _: &Self::Prepared<T>) -> bool {
        true
    }
    fn equals<T: Real>(a: &Ready<T>, b: &Ready<T>) -> bool {
        Mask::all(a.omega_squared.equals(b.omega_squared))
    }
}

impl<T: Real> Dynamics<T> for Ready<T> {
    type Vector = SVector<T, 1>;
    type Field = Scaled<T>;
    fn description(&self) -> &Description {
        SPRING
    }
    #[inline(always)]
    fn energy(&self, _: T, q: &Self::Vector, p: &Self::Vector) -> T {
        T::constant(0.5, 0.0) * (p[0] * p[0] + self.omega_squared * q[0] * q[0])
    }
    #[inline(always)]
    fn gradient_q(&self, _: T, q: &Self::Vector, _: &Self::Vector, out: &mut Self::Vector) {
        out[0] = self.omega_squared * q[0];
    }
    #[inline(always)]
    fn gradient_p(&self, _: T, _: &Self::Vector, p: &Self::Vector, out: &mut Self::Vector) {
        out[0] = p[0];
    }
    fn time_derivative(&self, _: T, _: &Self::Vector, _: &Self::Vector) -> T {
        T::zero()
    }
    fn hessian_vector(
        &self,
        _: T,
        _: &Self::Vector,
        _: &Self::Vector,
        vq: &Self::Vector,
        vp: &Self::Vector,
        out_q: &mut Self::Vector,
        out_p: &mut Self::Vector,
    ) {
        (out_q[0], out_p[0]) = (self.omega_squared * vq[0], vp[0]);
    }
    fn observable(&self, _: usize, t: T, q: &Self::Vector, p: &Self::Vector) -> T {
        self.energy(t, q, p)
    }
    #[inline(always)]
    fn field(&self, c: T) -> Scaled<T> {
        Scaled(self.omega_squared, c)
    }
}

impl<T: Real> VectorField<SVector<T, 1>> for Scaled<T> {
    #[inline(always)]
    fn add(
        &self,
        _: T,
        q: &SVector<T, 1>,
        p: &SVector<T, 1>,
        into_q: &mut SVector<T, 1>,
        into_p: &mut SVector<T, 1>,
    ) {
        into_q[0] += self.1 * p[0];
        into_p[0] -= self.1 * (self.0 * q[0]);
    }
}

fn spring(member: Member) -> (Spring, StateOf<Spring>) {
    let at = part(member.index);
    let omega = 1.0 + at;
    (Spring { omega }, State::new([at], [0.5]))
}

#[test]
fn a_system_by_hand() {
    agrees(spring, RungeKutta4);
}

#[test]
fn stores_of_systems_by_hand_recognise_parameters() {
    let _level = one_level();
    let path = place("hand");
    let sweep = |faster: f64| {
        let make = move |member: Member| {
            let (system, start) = spring(member);
            let omega = faster * system.omega;
            (Spring { omega }, start)
        };
        Sweep::new(40, make, RungeKutta4, 0.01)
            .with_steps(10)
            .with_chunk(20)
            .record(["q"], |end| [end.state.q[0]])
    };
    assert!(sweep(1.0).store(&path).expect("a store").is_complete());
    assert!(
        sweep(1.0)
            .completeness(&path)
            .expect("a store")
            .is_complete()
    );
    let other = sweep(1.5)
        .completeness(&path)
        .expect_err("other parameters");
    assert!(other.to_string().contains("chunk 0"), "{other}");
    std::fs::remove_dir_all(&path).expect("it is there");
}

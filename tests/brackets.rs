//! Poisson brackets over arrays, against the gradients of their two sides.

use hamiltonian::prelude::*;

hamiltonian! {
    /// Point masses, how many is known at run time.
    pub struct Bodies { n: usize, G = 1.0, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    let L = sum(i in 0..n) { cross(q[i], p[i]) };
    let by_bracket = [bracket(L[1], L[2]), bracket(L[2], L[0]), bracket(L[0], L[1])];
    invariant angular_momentum = L;
    /// {L_y, L_z} = L_x, and so on around.
    invariant of_brackets = by_bracket;
    /// The virial: d/dt Σ q·p
    monitor virial = bracket(sum(i in 0..n) { dot(q[i], p[i]) }, H);
    monitor kinetic = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
}

hamiltonian! {
    /// A ring with two observables that read neighbours, pairs and the whole of it.
    pub struct Ring<const N: usize> {}
    let a = sum(i in 0..N) { (i + 1)*q[i]^2*p[(i + 1) % N] } + exp(q[0]/4);
    let b = sqrt(1 + sum(i in 0..N) { p[i]^2 }) + sum(i in 0..N, j in 0..i) { q[i]*q[j]*p[j] };
    let c = sum(i in 1..N) { sin(q[i - 1])*p[i] };
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) };
    monitor first = a;
    monitor second = b;
    monitor third = c;
    monitor a_b = bracket(a, b);
    monitor b_a = bracket(b, a);
    monitor a_c = bracket(a, c);
    monitor c_b = bracket(c, b);
    let d = sum(i in 0..N) { q[i]*p[i]^2 };
    monitor jacobi = bracket(a, bracket(c, d)) + bracket(c, bracket(d, a)) + bracket(d, bracket(a, c));
    monitor one_of_three = bracket(a, bracket(c, d))
}

hamiltonian! {
    /// H itself a bracket: {Σ q²/2, Σ q·p²/2} = Σ q·q·p, as an H of its own.
    pub struct Squeezed<const N: usize> {}
    let generator = bracket(sum(i in 0..N) { q[i]^2/2 }, sum(i in 0..N) { q[i]*p[i]^2/2 });
    H(q[N]; p[N]) = generator + norm_squared(p)/2
}

hamiltonian! {
    /// Velocities in a bracket are functions of momenta.
    pub struct Chain { n: usize, m: [n], k = 2.0 }
    L(q[n]; v[n]) = sum(i in 0..n) { m[i]*v[i]^2/2 } - sum(i in 1..n) { k*(q[i] - q[i - 1])^2/2 };
    monitor inverse_mass = bracket(q[1], v[1]);
    monitor first_moment = bracket(sum(i in 0..n) { q[i] }, sum(i in 0..n) { v[i] });
    /// Row 2 of an array with rows 0 … n − 2 is 0 where n is 3: nothing past the end is read.
    monitor third_row = bracket(q[2], sum(i in 0..n - 1) { m[i + 1]*q[i + 1]*p_q[i] });
    /// Row i − 1 of nothing.
    monitor shifted = bracket(sum(i in 0..n) { q[i] }, sum(i in 1..n) { m[i - 1]*q[i - 1]*p_q[i] })
}

hamiltonian! {
    /// Sums that meet at indices which cannot be solved for each other, of literal length.
    pub struct Literal {}
    let a = sum(i in 0..2, j in 0..3) { q[(i*2 + j) % 3]^2*p[j] };
    let b = sum(i in 0..4) { (i + 1)*p[2*i % 3]*q[(3 - i) % 3] };
    H(q[3]; p[3]) = norm_squared(p)/2;
    monitor first = a;
    monitor second = b;
    monitor both = bracket(a, b)
}

hamiltonian! {
    /// Beside a bracket, formulas under a condition stay as they are: nothing reads past ends.
    pub struct Conditional { n: usize }
    let last = if p[0] < q[0] { sum(i in n - 1..n) { p[i] } } else { q[0]^2 };
    H(q[n]; p[n]) = norm_squared(p)/2 + last;
    monitor bound = last;
    monitor along = bracket(q[0], last)
}

hamiltonian! {
    /// A formula that a bracket made first, and the author wrote after it, stays as it is written.
    pub struct Again { n: usize, w = 2.0, m: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/m[i] }/2;
    monitor rate = bracket(sum(i in n - 1..n) { q[i] }, norm_squared(p)/2) + bracket(q[0], norm_squared(p)/2);
    monitor last = if w > 1 { sum(i in n - 1..n) { 2*w*p[i] } } else { 0 };
    split {
        Free = sum(i in 0..n) { p[i]^2/m[i] }/2 - if w > 1 { p[0] } else { 0 };
        First = if w > 1 { p[0] } else { 0 }
    }
}

/// Σ ∂a/∂q·∂b/∂p − ∂a/∂p·∂b/∂q
fn contracted(a: (&[f64], &[f64]), b: (&[f64], &[f64])) -> f64 {
    let products = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    products(a.0, b.1) - products(a.1, b.0)
}

fn close(value: f64, expected: f64) {
    assert!(
        (value - expected).abs() <= 1e-13 * (1.0 + expected.abs()),
        "{value} is not {expected}"
    );
}

#[test]
fn components_of_angular_momentum() {
    for n in [1, 2, 3, 7] {
        let masses: Vec<f64> = (0..n).map(|i| 1.0 + 0.1 * i as f64).collect();
        let bodies = Bodies::new(n, masses).unwrap();
        let (mut q, mut p) = (System::zeros::<f64>(&bodies), System::zeros::<f64>(&bodies));
        for i in 0..n {
            for c in 0..3 {
                let x = (3 * i + c) as f64;
                q[(i, c)] = 2.0 * (1.7 * x).cos();
                p[(i, c)] = 0.3 * (2.3 * x).sin();
            }
        }
        let state = State { t: 0.0, q, p };
        let (l, other) = (bodies.angular_momentum(&state), bodies.of_brackets(&state));
        for c in 0..3 {
            assert!(l[c].abs() > 1e-3);
            close(other[c], l[c]);
        }
        // For a potential of degree −1: d/dt Σ q·p = 2T + V.
        let kinetic: f64 = bodies.kinetic(&state);
        close(bodies.virial(&state), kinetic + bodies.energy(&state));
    }
}

fn ring<const N: usize>() {
    let ring = Ring::<N> {};
    let q: [f64; N] = core::array::from_fn(|i| (1.3 * i as f64 + 0.4).sin());
    let p: [f64; N] = core::array::from_fn(|i| (2.1 * i as f64 + 0.2).cos());
    let state = State::new(q, p);
    let gradients = [
        ring.first_gradient(&state),
        ring.second_gradient(&state),
        ring.third_gradient(&state),
    ];
    let of = |x: usize, y: usize| {
        contracted(
            (gradients[x].q.as_slice(), gradients[x].p.as_slice()),
            (gradients[y].q.as_slice(), gradients[y].p.as_slice()),
        )
    };
    close(ring.a_b(&state), of(0, 1));
    close(ring.b_a(&state), of(1, 0));
    close(ring.a_c(&state), of(0, 2));
    close(ring.c_b(&state), of(2, 1));
    let jacobi: f64 = ring.jacobi(&state);
    assert!(jacobi.abs() < 1e-11, "{jacobi:e}");
    assert!(ring.one_of_three(&state).abs() > 1e-3 || N == 1);
    assert!(of(0, 1).abs() > 1e-3, "{N}: a bracket of 0 shows nothing");
}

#[test]
fn neighbours_pairs_and_the_whole() {
    ring::<1>();
    ring::<2>();
    ring::<3>();
    ring::<8>();
}

#[test]
fn h_from_a_bracket() {
    let state = State::new([0.3, -0.4, 0.5], [1.0, 2.0, 3.0]);
    let h: f64 = Squeezed::<3> {}.energy(&state);
    close(h, 0.09 + 0.16 * 2.0 + 0.25 * 3.0 + 7.0);
}

#[test]
fn indices_that_cannot_be_solved() {
    let state = State::new([0.3, -0.4, 0.5], [1.0, 2.0, -0.7]);
    let system = Literal {};
    let (a, b) = (
        system.first_gradient(&state),
        system.second_gradient(&state),
    );
    let expected = contracted(
        (a.q.as_slice(), a.p.as_slice()),
        (b.q.as_slice(), b.p.as_slice()),
    );
    close(system.both(&state), expected);
    assert!(expected.abs() > 1e-3);
}

#[test]
fn conditions_beside_a_bracket() {
    for n in [1, 3] {
        let system = Conditional::new(n).unwrap();
        let state = State::new(vec![0.5; n], vec![0.25; n]);
        let kinetic = n as f64 / 32.0;
        close(system.energy(&state), kinetic + 0.25);
        close(system.bound(&state), 0.25);
        close(system.along(&state), f64::from(u8::from(n == 1)));
    }
}

#[test]
fn what_a_bracket_made_first_is_written_as_it_is() {
    let system = Again::new(3, vec![1.0, 2.0, 4.0]).unwrap();
    let state = State::new(vec![0.0; 3], vec![0.5, 0.25, 0.125]);
    close(system.rate(&state), 0.625);
    close(system.last(&state), 0.5);
    close(system.piece_first().energy(&state), 0.5);
    assert!(!system.piece_first().to_string().contains('%'));
}

#[test]
fn velocities() {
    let chain = Chain::new(3, vec![0.5, 2.0, 4.0]).unwrap();
    let state = State::new(vec![0.1, 0.2, 0.3], vec![1.0, 2.0, 3.0]);
    close(chain.inverse_mass(&state), 0.5);
    close(chain.first_moment(&state), 2.0 + 0.5 + 0.25);
    close(chain.third_row(&state), 0.0);
    close(chain.shifted(&state), 0.5 * 0.1 + 2.0 * 0.2);
    let chain = Chain::new(4, vec![0.5, 2.0, 4.0, 3.0]).unwrap();
    let state = State::new(vec![0.1, 0.2, 0.3, 0.4], vec![1.0, 2.0, 3.0, 4.0]);
    close(chain.third_row(&state), 3.0 * 0.4);
}

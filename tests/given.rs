//! Parameters and states from arrays, slices and `Vec`s, without nalgebra.

use hamiltonian::prelude::*;

hamiltonian! {
    /// Two bodies on coupled springs.
    pub struct Springs { m: [2] = [1.0, 2.0], K: [2][2] = [[2, -1], [-1, 2]] }
    H(q[2]; p[2]) = sum(i in 0..2) { p[i]^2/(2*m[i]) } + dot(q, K*q)/2
}

hamiltonian! {
    /// Bodies in space with a const generic for their number.
    pub struct Bodies<const N: usize> { m: [N], w: [2][1][2] }
    H(q[N][3]; p[N][3]) = sum(i in 0..N) { norm_squared(p[i])/(2*m[i]) + norm_squared(q[i])/2 }
        + sum(i in 0..2, j in 0..2) { w[i][0][j] }
}

hamiltonian! {
    /// Sizes set at run time.
    pub struct Crystal { n: usize, a: [2] = [1, 2], m: [n], K: [n][n], B: [n][3], w: [n][2][n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) + (a[0] + a[1]*B[i][2])*q[i]^2 } + dot(q, K*q)/2
        + sum(i in 0..n, j in 0..n) { w[i][0][j]*w[j][1][i]*q[i]^2 }
}

hamiltonian! {
    /// A membrane, whose rows are long.
    pub struct Membrane<const N: usize> {}
    H(u[N][8]; v[N][8]) = sum(i in 0..N, j in 0..8) { v[i][j]^2/2 + (u[i][j] - u[i][(j + 1) % 8])^2/2 }
}

hamiltonian! {
    /// Names that methods `with_…` would have.
    pub struct Taken { with_b: usize, a: [2] = [1, 2], b: [2] = [3, 4], c: [2] = [5, 6], defaults: [2] = [7, 8] }
    H(q[with_b]; p[with_b]) = norm_squared(p)/2 + norm_squared(q)*(dot(a, b) + dot(c, defaults));
    monitor with_a = q[0]
}

/// The message of an error.
fn message<X>(result: Result<X, Error>) -> String {
    result.err().expect("it does not fit").to_string()
}

#[test]
fn arrays_of_literal_sizes_are_set_by_any_list() -> Result<(), Error> {
    let springs = Springs::default().with_m([3.0, 4.0]);
    assert_eq!(springs.m.as_slice(), [3.0, 4.0]);
    let list = vec![5.0, 6.0];
    assert_eq!(springs.clone().with_m(&[5.0, 6.0]).m.as_slice(), list);
    assert_eq!(springs.clone().with_m(&list[..])?.m.as_slice(), list);
    assert_eq!(springs.clone().with_m(&list)?.m.as_slice(), list);
    assert_eq!(springs.clone().with_m(list.clone())?.m.as_slice(), list);
    let short = springs.clone().with_m(vec![1.0]);
    assert_eq!(message(short), "`m` must have 2 components, found 1");

    let rows = [[2.0, 0.5], [0.25, 3.0]];
    let due = springs.clone().with_K(rows).K;
    assert_eq!(
        (due[(0, 1)], due[(1, 0)], springs.m.as_slice()),
        (0.5, 0.25, &[3.0, 4.0][..])
    );
    assert_eq!(springs.clone().with_K(&rows).K, due);
    assert_eq!(springs.clone().with_K(rows.to_vec())?.K, due);
    assert_eq!(springs.clone().with_K(&rows[..])?.K, due);
    let nested: Vec<Vec<f64>> = rows.iter().map(|row| row.to_vec()).collect();
    assert_eq!(springs.clone().with_K(&nested)?.K, due);
    assert_eq!(springs.clone().with_K(nested)?.K, due);
    let uneven = springs.with_K(vec![vec![1.0, 2.0], vec![3.0]]);
    assert_eq!(message(uneven), "`K[1]` must have 2 elements, found 1");
    Ok(())
}

#[test]
fn arrays_of_const_generic_sizes_are_set_by_any_list() -> Result<(), Error> {
    let w = [[[1.0, 2.0]], [[3.0, 4.0]]];
    let bodies = Bodies::<2>::new(&[1.0, 2.0], w).with_m(vec![3.0, 4.0])?;
    assert_eq!(bodies.m.as_slice(), [3.0, 4.0]);
    let w = [[[5.0, 6.0]], [[7.0, 8.0]]];
    assert_eq!(bodies.clone().with_w(w).w, w);
    assert_eq!(bodies.clone().with_w(w.to_vec())?.w, w);
    let three = bodies.with_w(vec![[[1.0, 2.0]]; 3]);
    assert_eq!(
        message(three),
        "axis 0 of `w` must have the extent 2, found 3"
    );
    Ok(())
}

#[test]
fn arrays_of_run_time_sizes_keep_them() -> Result<(), Error> {
    let (rows, layers) = ([[1.0, 2.0], [3.0, 4.0]], [[[1.0, 2.0], [3.0, 4.0]]; 2]);
    let crystal = Crystal::new(2, [1.0, 2.0], rows, [[1.0; 3]; 2], layers)?;
    let same = Crystal::new(
        2,
        vec![1.0, 2.0],
        vec![vec![1.0, 2.0], vec![3.0, 4.0]],
        vec![[1.0; 3]; 2],
        layers.to_vec(),
    )?;
    assert_eq!(crystal.K(), same.K());
    let other = crystal
        .with_m([3.0, 4.0])?
        .with_K(vec![vec![5.0, 6.0]; 2])?;
    assert_eq!(other.m().as_slice(), [3.0, 4.0]);
    assert_eq!(other.K()[(1, 0)], 5.0);
    assert_eq!(other.clone().with_a([7.0, 8.0]).a.as_slice(), [7.0, 8.0]);
    let wide = other.clone().with_B(&[[9.0; 3]; 2])?;
    assert_eq!(wide.B().as_slice(), [9.0; 6]);
    let refused = |result: Result<Crystal, Error>| message(result);
    let copy = || other.clone();
    assert_eq!(
        refused(copy().with_m([1.0; 3])),
        "`m` must have 2 components, found 3"
    );
    assert_eq!(
        refused(copy().with_K([[1.0; 2]; 3])),
        "`K` must have 4 components, found 6"
    );
    assert_eq!(
        refused(copy().with_B(vec![vec![1.0; 2]; 3])),
        "`B[0]` must have 3 elements, found 2"
    );
    assert_eq!(
        refused(copy().with_w([[[1.0; 3]; 2]; 2])),
        "axis 2 of `w` must have the extent 2, found 3"
    );
    let nan = refused(copy().with_m([1.0, f64::NAN]));
    assert!(nan.contains("`m[1]`"), "{nan}");
    Ok(())
}

#[test]
fn names_of_the_definition_win() -> Result<(), Error> {
    let taken = Taken::new(2)?.with_c([0.0, 1.0]);
    assert_eq!(taken.with_b(), 2);
    assert_eq!(taken.with_a(&State::new(vec![3.0, 0.0], vec![0.0; 2])), 3.0);
    Ok(())
}

#[test]
fn starts_fit_by_length() -> Result<(), Error> {
    let springs = Springs::default();
    let due = State::new([0.5, 1.0], [0.0, 2.0]);
    let start = State::new(vec![0.5, 1.0], vec![0.0, 2.0]).at(3.0);
    let run = Integrator::new(&springs, StormerVerlet::default(), start, 0.1)?;
    assert_eq!(*run.state(), due.at(3.0));
    let long = State::new(&[0.0; 2][..], &[1.0; 3][..]);
    let run = Integrator::new(&springs, StormerVerlet::default(), long, 0.1);
    assert_eq!(message(run), "`p` must have 2 components, found 3");

    let bodies = Bodies::<2>::new([1.0; 2], [[[0.0; 2]; 1]; 2]);
    let rows = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
    let nested = || rows.map(Vec::from).to_vec();
    let run = Integrator::new(&bodies, RungeKutta4, State::new(nested(), nested()), 0.1)?;
    assert_eq!(*run.state(), State::new(rows, rows));
    let start = State::new(rows.to_vec(), rows.to_vec());
    let mut run = Integrator::new(&bodies, RungeKutta4, start, 0.1)?;
    run.set_state(State::new(&[[7.0; 3]; 2][..], &[[8.0; 3]; 2][..]))?;
    assert_eq!(*run.state(), State::new([[7.0; 3]; 2], [[8.0; 3]; 2]));
    let change = run.set_state(State::new(vec![[7.0; 3]; 3], vec![[8.0; 3]; 3]));
    assert_eq!(message(change), "`q` must have 6 components, found 9");

    let membrane = Membrane::<2> {};
    let rows = [[1.0; 8], [2.0; 8]];
    let run = Integrator::new(&membrane, RungeKutta4, State::new(rows, rows), 0.1)?;
    assert_eq!(run.state().to_vec()[8], 2.0);
    let wide = State::new([[1.0; 9]; 2], [[1.0; 9]; 2]);
    let run = Integrator::new(&membrane, RungeKutta4, wide, 0.1);
    assert_eq!(
        message(run),
        "axis 1 of `u` must have the extent 8, found 9"
    );
    Ok(())
}

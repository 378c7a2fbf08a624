//! What a run or a system is refused for.

use hamiltonian::Error;
use hamiltonian::errors::StartError;
use hamiltonian::prelude::*;
use hamiltonian::schemes::Srkn6b;
use hamiltonian_runtime::{Definition, RuntimeSystem, SystemError, Values};

fn system(text: &str) -> RuntimeSystem {
    let definition = Definition::parse(text, "text").unwrap_or_else(|errors| panic!("{errors}"));
    definition
        .system(Values::new())
        .unwrap_or_else(|error| panic!("{error}"))
}

/// The error of a run with this scheme.
fn refused<M: Scheme<RuntimeSystem>>(system: &RuntimeSystem, scheme: M) -> (String, String) {
    let n = system.degrees_of_freedom();
    let start = State::new(vec![0.5; n], vec![0.25; n]);
    match Integrator::new(system, scheme, start, 0.1)
        .map(|_| ())
        .unwrap_err()
    {
        Error::Start(error) => match *Box::new(error) {
            StartError::Structure {
                ref marker,
                ref message,
                ..
            } => ((**marker).to_owned(), (**message).to_owned()),
            ref other => panic!("{other}"),
        },
        other => panic!("{other}"),
    }
}

#[test]
fn schemes_that_do_not_fit_are_refused_with_the_words_of_the_macro() {
    let coupled = system("struct Coupled {} H(q; p) = p^2/2 + q^4 + 1/(2 + sin(q)*cos(p))");
    let (marker, message) = refused(&coupled, StormerVerlet::default());
    assert_eq!(marker, "Separable");
    assert!(
        message.starts_with("H of `Coupled` is not separable: the term `"),
        "{message}"
    );
    assert!(message.ends_with("` couples q and p"), "{message}");
    let (marker, message) = refused(&coupled, BlanesMoan4);
    assert_eq!(marker, "Split");
    assert!(
        message.contains("is not split into exact flows"),
        "{message}"
    );
    let (marker, _) = refused(&coupled, Srkn6b);
    assert_eq!(marker, "Nystrom");

    // The negative control: the same schemes run the same H without the term.
    let free = system("struct Free {} H(q; p) = p^2/2 + q^4");
    let start = || State::new(vec![0.5], vec![0.25]);
    assert!(Integrator::new(&free, StormerVerlet::default(), start(), 0.1).is_ok());
    assert!(Integrator::new(&free, BlanesMoan4, start(), 0.1).is_ok());
    assert!(Integrator::new(&free, Srkn6b, start(), 0.1).is_ok());
}

#[test]
fn what_is_not_carried_is_named_with_its_place() {
    let text = "struct A {}\nfn f(x) = sin, (cos);\nH = p^2/2 + f(q)";
    let definition = Definition::parse(text, "text").unwrap_or_else(|errors| panic!("{errors}"));
    let error = definition.system(Values::new()).map(|_| ()).unwrap_err();
    let shown = error.to_string();
    assert!(matches!(error, SystemError::NotCarried { .. }), "{shown}");
    assert!(shown.starts_with("text:2:4: the function `f`"), "{shown}");
}

#[test]
fn a_function_has_the_place_of_a_function() {
    let text = "struct A { V: fn(r), W: fn(x, y), k = 1.0 } H(q; p) = p^2/2 + k*V(q) + W(q, q)";
    let definition = Definition::parse(text, "text").unwrap_or_else(|errors| panic!("{errors}"));
    let spline = Spline::natural(&[0.0, 1.0, 2.0], &[0.0, 1.0, 4.0]).unwrap();
    let grid = Grid::natural([0.0; 2], [1.0; 2], &[[0.0; 3], [1.0; 3], [4.0; 3]]).unwrap();
    let refused = |values: Values| definition.system(values).unwrap_err().to_string();
    let own = Values::new().with("V", spline.clone());
    assert!(
        definition
            .system(own.clone().with("W", grid.clone()))
            .is_ok()
    );
    assert_eq!(refused(own.clone()), "`W` has no default: give it a value");
    let swapped = own.clone().with("W", spline.clone());
    assert_eq!(
        refused(swapped),
        "`W` must be a function of two numbers: a `Grid`"
    );
    let number = own.with("W", grid).with("k", spline);
    assert_eq!(
        refused(number),
        "`k` is a function, and must be a number or a list"
    );
}

#[test]
fn definitions_and_systems_go_to_other_threads() {
    fn goes<T: Send + Sync>() {}
    goes::<Definition>();
    goes::<RuntimeSystem>();
}

#[test]
fn parameters_are_described_as_those_of_compiled_systems() {
    let text = "struct A { k = 2, w: [2][2] } H(q[2]; p[2]) = norm_squared(p)/2 + k*w[0][1]*q[0]^2 + w[1][0]*q[1]^2";
    let definition = Definition::parse(text, "text").unwrap_or_else(|errors| panic!("{errors}"));
    let system = definition.system([("w", [1.0, 0.5, 0.25, 2.0])]).unwrap();
    let mut described = String::new();
    system.describe_parameters(&mut described).unwrap();
    let due = "k = 2.0\nw[0][0] = 1.0\nw[0][1] = 0.5\nw[1][0] = 0.25\nw[1][1] = 2.0\n";
    assert_eq!(described, due);
}

#[test]
fn values_that_do_not_fit_are_refused() {
    let text = "struct A { n: usize, g, m: [n] } H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) + g*q[i]^2 } + q[2]";
    let definition = Definition::parse(text, "text").unwrap_or_else(|errors| panic!("{errors}"));
    let with = |n: f64, g: f64, m: &[f64]| {
        let values = Values::new().with("n", n).with("g", g).with("m", m);
        definition
            .system(values)
            .map(|_| ())
            .map_err(|error| error.to_string())
    };
    assert_eq!(with(3.0, 1.0, &[1.0; 3]), Ok(()));
    for (n, g, m, words) in [
        (-3.0, 1.0, &[1.0; 3][..], "`n` must be a size"),
        (2.5, 1.0, &[1.0; 3], "`n` must be a size"),
        (f64::NAN, 1.0, &[1.0; 3], "`n` must be a size"),
        (1e18, 1.0, &[1.0; 3], "`n` must be a size"),
        (8e15, 1.0, &[1.0; 3], "does not fit into memory"),
        (2.0, 1.0, &[1.0; 2], "`q[2]` reaches 2"),
        (3.0, f64::NAN, &[1.0; 3], "`g` is NaN"),
        (3.0, 1.0, &[1.0; 2], "`m` must have 3 elements, found 2"),
    ] {
        let error = with(n, g, m).unwrap_err();
        assert!(error.contains(words), "{error}");
    }
    let error = definition.system([("n", 3), ("g", 1)]).unwrap_err();
    assert_eq!(error.to_string(), "`m` has no default: give it a value");
    let error = definition
        .system(Values::new().with("n", [1.0]))
        .unwrap_err();
    assert!(matches!(error, SystemError::NoNumber { .. }), "{error}");
}

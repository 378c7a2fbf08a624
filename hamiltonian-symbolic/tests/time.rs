//! Another time: the new H, with its observables, splits and forces; splits and forces as they are
//! checked.

use crate::common::{parse, system, values};
use hamiltonian_symbolic::dag::{Array, Column, Dependence, Kind, Node, Side};
use hamiltonian_symbolic::diff;
use hamiltonian_symbolic::index::Index;
use hamiltonian_symbolic::model::{Model, Observable, ObservableKind, VectorEntry};
use hamiltonian_symbolic::print;
use hamiltonian_symbolic::transform::{check_split, retime};

#[test]
fn another_time_adds_the_old_one_as_a_coordinate() {
    let mut kepler = system(
        "x, y; p_x, p_y; t",
        "",
        "e",
        "(p_x^2 + p_y^2)/2 - 1/sqrt(x^2 + y^2) + e*x*cos(t)",
    );
    let angular = parse(&mut kepler, "(x*p_y - y*p_x)*t");
    kepler.observables.push(Observable {
        name: "L".into(),
        kind: ObservableKind::Monitor,
        components: vec![angular],
    });
    kepler.factor = Some(parse(&mut kepler, "sqrt(x^2 + y^2)"));
    let mut new = retime(&kepler).unwrap();
    let factor = new.model.factor.unwrap();
    assert_eq!(new.group, 2);
    assert_eq!(new.model.time, None);
    assert_eq!(new.model.groups[2].coordinate, "t");
    assert_eq!(new.model.groups[2].momentum, "p_t");
    let h = new.model.h();
    let expected = parse(
        &mut new.model,
        "-1 + sqrt(x^2 + y^2)*((p_x^2 + p_y^2)/2 + e*x*cos(t) + p_t)",
    );
    let text = print::text(&new.model, h);
    assert_eq!(h, expected, "{text}");
    for root in [
        h,
        new.energy,
        new.start,
        new.model.observables[0].components[0],
    ] {
        assert!(!new.model.dag.dependence(root).on(Dependence::TIME));
    }

    // On the shell the equations are g times the old ones, and dt/ds = g.
    let both = Dependence(Dependence::Q.0 | Dependence::P.0);
    let slopes = diff::gradient(&mut new.model.dag, h, both);
    let old = diff::gradient(&mut new.model.dag, new.energy, both);
    let read = |new: &mut Model, side, group| {
        let array = Array::Phase(Column {
            side,
            group,
            column: 0,
        });
        new.dag.element(array, Index::constant(0), None)
    };
    let p_t = read(&mut new.model, Side::P, 2);
    let start = values(&new.model, &[new.start], &[])[0];
    let given = [(p_t, start)];
    let mut compared = 0;
    for (leaf, slope) in &slopes {
        let expected = if *leaf == p_t {
            factor
        } else {
            let (_, slope) = old.iter().find(|(other, _)| other == leaf).unwrap();
            new.model.dag.mul(&[factor, *slope])
        };
        let pair = values(&new.model, &[*slope, expected], &given);
        assert!((pair[0] - pair[1]).abs() < 1e-12, "{pair:?}");
        compared += 1;
    }
    assert_eq!(compared, 6);
    assert!(values(&new.model, &[h], &given)[0].abs() < 1e-14);
    // Off it they are not.
    let x = read(&mut new.model, Side::Q, 0);
    let of = |list: &[(Node, Node)]| list.iter().find(|(leaf, _)| *leaf == x).unwrap().1;
    let (slope, was) = (of(&slopes), of(&old));
    let expected = new.model.dag.mul(&[factor, was]);
    let pair = values(&new.model, &[slope, expected], &[(p_t, start + 1.0)]);
    assert!((pair[0] - pair[1]).abs() > 1e-3, "{pair:?}");
}

#[test]
fn mino_time_takes_the_fraction_away() {
    let mut kerr = system(
        "r, theta; p_r, p_theta",
        "",
        "a",
        "((r^2 + a^2)*p_r^2 + p_theta^2 - r^3)/(2*(r^2 + a^2*cos(theta)^2))",
    );
    kerr.factor = Some(parse(&mut kerr, "r^2 + a^2*cos(theta)^2"));
    kerr.split = vec![parse(&mut kerr, "p_theta^2/(2*(r^2 + a^2*cos(theta)^2))")];
    let mut new = retime(&kerr).unwrap();
    let h = new.model.h();
    let expected = parse(
        &mut new.model,
        "((r^2 + a^2)*p_r^2 + p_theta^2 - r^3)/2 + (r^2 + a^2*cos(theta)^2)*p_t",
    );
    let text = print::text(&new.model, h);
    assert_eq!(h, expected, "{text}");
    let half = parse(&mut new.model, "p_theta^2/2");
    let clock = parse(&mut new.model, "(r^2 + a^2*cos(theta)^2)*p_t");
    assert_eq!(new.model.split, [half, clock]);
}

#[test]
fn taken_names_get_a_number_and_factors_are_checked() {
    let mut model = system("t, x; p_t, p_x", "", "p_t_2", "p_x^2/2 + t^2");
    let in_time = |model: &Model, g: Node| {
        let factor = Some(g);
        let model = model.clone();
        retime(&Model { factor, ..model })
    };
    let g = parse(&mut model, "1 + x^2");
    let new = in_time(&model, g).unwrap();
    assert_eq!(new.model.groups[2].coordinate, "t_2");
    assert_eq!(new.model.groups[2].momentum, "p_t_3");
    assert_eq!(
        retime(&model).unwrap_err().to_string(),
        "the factor of `dt = …*ds` is missing"
    );
    let zero = model.dag.integer(0);
    assert_eq!(
        in_time(&model, zero).unwrap_err().to_string(),
        "the factor of `dt = …*ds` is 0"
    );
    let coefficient = model.dag.coefficient();
    assert!(in_time(&model, coefficient).is_err());
    let mut loops = system("q[n]; p[n]", "n", "", "sum(i in 0..n) { p[i]^2 }");
    let h = loops.h();
    let Kind::Reduce(_, body) = *loops.dag.kind(h) else {
        panic!("a loop")
    };
    assert!(in_time(&loops, body).is_err());
    let g = loops.dag.integer(2);
    assert!(in_time(&loops, g).is_ok());
}

#[test]
fn a_force_in_another_time_keeps_the_shell() {
    let mut model = system("x; p", "", "c", "p^2/2 + x^2/2");
    model.factor = Some(parse(&mut model, "1 + x^2"));
    model.force = vec![VectorEntry {
        at: Column::first(Side::P, 0),
        row: Index::constant(0),
        value: parse(&mut model, "-c*p"),
    }];
    let mut new = retime(&model).unwrap();
    let expected = [
        parse(&mut new.model, "-(1 + x^2)*c*p"),
        parse(&mut new.model, "(1 + x^2)*c*p*p"),
    ];
    let force = &new.model.force;
    assert_eq!([force[0].value, force[1].value], expected);
    assert_eq!(force[1].at.group, new.group);
}

#[test]
fn a_split_adds_up_or_is_refused_with_the_difference() {
    let mut model = system("q; p", "", "k", "(q^2 + 1)*(p^2 + 1)/2 + k*cos(2*q)");
    let mut split = |pieces: &[&str]| {
        let pieces: Vec<Node> = pieces.iter().map(|text| parse(&mut model, text)).collect();
        check_split(&mut model, &pieces)
    };
    assert_eq!(
        split(&["q^2/2 + p^2/2 + 1/2", "q^2*p^2/2 + k*cos(2*q)"]),
        Ok(())
    );
    assert_eq!(
        split(&["(q^2 + 1)*p^2/2", "(q^2 + 1)/2 + k - 2*k*sin(q)^2"]),
        Ok(())
    );
    let wrong = split(&["q^2/2 + p^2/2", "q^2*p^2 + k*cos(2*q)"]).unwrap_err();
    assert_eq!(wrong.text, "0.5 - 0.5*q^2*p^2");
    let (point, value) = wrong.point.unwrap();
    assert!(value != 0.0 && point.len() == 2, "{point:?}");
    assert!(split(&["q^2/2"]).is_err());
    // A term that is missing at one value of a parameter, or of a coordinate, is missing.
    let whole = "(q^2 + 1)*(p^2 + 1)/2 + k*cos(2*q)";
    for condition in ["k == 1", "q == p", "q == 0"] {
        let extra = format!("if {condition} {{ 7*p }} else {{ 0 }}");
        let wrong = split(&[whole, &extra]).unwrap_err();
        assert_eq!(wrong.point, None, "{condition}");
    }

    let mut chain = system(
        "q[n]; p[n]",
        "n",
        "",
        "sum(i in 0..n) { p[i]^2/2 + exp(q[i] - q[(i + 1) % n]) }",
    );
    let kinetic = parse(&mut chain, "sum(i in 0..n) { p[i]^2/2 }");
    let potential = parse(&mut chain, "sum(i in 0..n) { exp(q[i] - q[(i + 1) % n]) }");
    assert_eq!(check_split(&mut chain, &[kinetic, potential]), Ok(()));
    assert!(check_split(&mut chain, &[kinetic, kinetic]).is_err());
}

//! Splittings: which pieces are found, which terms are refused, and that a search ends.

pub mod arrays;
mod order;
mod perturbed;
pub mod rows;
pub mod table;

use crate::common;
use crate::tree::{Random, grow};
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::Purpose;
use hamiltonian_symbolic::rational::Rational;
use hamiltonian_symbolic::split::{NODES, Refusal, find};
use hamiltonian_symbolic::transform::check_split;
use table::{FOUND, REFUSED};

#[test]
fn systems_are_split_unaided() {
    let mut others = Vec::new();
    for found in FOUND {
        let mut model = common::system(found.signature, "", found.parameters, found.h);
        let splitting = match find(&mut model) {
            Ok(splitting) => splitting,
            Err(refusal) => panic!("{}: {refusal:?}", found.h),
        };
        let names: Vec<&str> = splitting.pieces.iter().map(|p| p.name.as_str()).collect();
        println!("{} {:?}", found.h, splitting.choice);
        if names != found.pieces {
            others.push((
                names.iter().map(|n| n.to_string()).collect::<Vec<_>>(),
                found.pieces,
            ));
        }
        let pieces: Vec<_> = splitting.pieces.iter().map(|p| p.h).collect();
        assert!(check_split(&mut model, &pieces).is_ok(), "{}", found.h);
    }
    assert!(others.is_empty(), "{others:#?}");
}

#[test]
fn what_has_no_flow_is_refused_by_its_term() {
    let mut others = Vec::new();
    for refused in REFUSED {
        let mut model = common::system(refused.signature, "", refused.parameters, refused.h);
        match find(&mut model) {
            Err(Refusal { text, .. }) if text == refused.term => {}
            other => others.push((refused.h, other)),
        }
    }
    assert!(others.is_empty(), "{others:#?}");
}

/// Sharing may cancel a prepared expression to a number, which has no name to be handed on by.
#[test]
fn numbers_are_not_handed_on() {
    for (signature, parameters, h) in [
        ("q; p", "m w k", "p^2/(2*m) + w*q*p + k*q^2/2"),
        ("q; p", "m g", "p^2/(2*m) - g*q*p/2 + q^4"),
        ("x; u", "c d", "u + c*x*u + d*x*u"),
    ] {
        let mut model = common::system(signature, "", parameters, h);
        model.pieces = find(&mut model).unwrap().pieces;
        let mut wanted = vec![Purpose::EnergyAndGradient, Purpose::ParameterGradient];
        wanted.extend((0..model.pieces.len()).map(|n| Purpose::Piece(n as u16)));
        let program = derive(&mut model, &wanted).unwrap();
        for value in &program.prepared {
            assert!(!program.instruction(*value).is_number(), "{h}");
        }
    }
}

/// Whatever is asked, a search ends, and adds no more to the arena than it may (and what one step
/// of it makes at once).
#[test]
fn searches_are_bounded() {
    let mut random = Random(0xB0);
    let (mut largest, mut found) = (0, 0);
    let all = common::cases(300, 3000);
    for _ in 0..all {
        let mut model = grow(&mut random).0.model();
        // Products and quotients of the expressions so far: long, and of the pattern of no row.
        let h = model.hamiltonian.expect("there is an H");
        if random.chance(0.3) {
            let sine = model.dag.call(Op::Sin, &[h]);
            let squares = model.dag.product(&Rational::ONE, &[(sine, 2), (h, 3)]);
            model.hamiltonian = Some(model.dag.div(squares, sine));
        }
        let before = model.dag.len();
        found += usize::from(find(&mut model).is_ok());
        largest = largest.max(model.dag.len() - before);
    }
    println!("{found} of {all} split, at most {largest} nodes");
    assert!(largest <= 4 * NODES, "{largest} nodes");
    assert!(found > 0 && found < all);
}

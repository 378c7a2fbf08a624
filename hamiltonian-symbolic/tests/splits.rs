//! Splittings: which pieces are found, which terms are refused, and that a search ends.

pub mod arrays;
pub mod forms;
mod order;
mod perturbed;
mod rewrite;
pub mod table;

use crate::common;
use crate::judge::{Definition, Subject, Verdict, verdicts};
use crate::tree::{Random, grow};
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::Purpose;
use hamiltonian_symbolic::rational::Rational;
use hamiltonian_symbolic::split::{EXPRESSIONS, Limit, NoFlow, declared, find};
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
            Err(NoFlow { text, .. }) if text == refused.term => {}
            other => others.push((refused.h, other)),
        }
    }
    assert!(others.is_empty(), "{others:#?}");
}

#[test]
fn terms_that_commute_are_one_piece_however_many_there_are() {
    for count in 3..=12 {
        let [q, p] = ["q", "p"].map(|name| names(name, count));
        let terms = sum_of(count, |at| format!("(q{at}^2 + 1)*(p{at}^2 + 1)/2"));
        let product = q.replace(", ", "*");
        let mut model = common::system(
            &format!("{q}; {p}"),
            "",
            "",
            &format!("{terms} + {product}"),
        );
        let found = find(&mut model).expect("there are three families");
        assert_eq!(found.pieces.len(), 3, "{count}");
    }
}

/// `q1, q2, …`
fn names(name: &str, count: usize) -> String {
    (1..=count)
        .map(|at| format!("{name}{at}"))
        .collect::<Vec<_>>()
        .join(", ")
}

/// Terms `c(1) + c(2) + …`
fn sum_of(count: usize, term: impl Fn(usize) -> String) -> String {
    (1..=count).map(term).collect::<Vec<_>>().join(" + ")
}

/// `q1, q2, …; p1, p2, …`
fn pairs(count: usize) -> String {
    let list = |letter: char| (1..=count).map(move |at| format!("{letter}{at}"));
    let [q, p] = ['q', 'p'].map(|letter| list(letter).collect::<Vec<_>>().join(", "));
    format!("{q}; {p}")
}

/// The limit that a refusal of a search names; `Err` where the search finds pieces.
fn limit_of_search(signature: &str, sizes: &str, h: &str) -> Result<Option<Limit>, usize> {
    match find(&mut common::system(signature, sizes, "", h)) {
        Ok(splitting) => Err(splitting.pieces.len()),
        Err(refusal) => Ok(refusal.limit),
    }
}

/// The same of a piece that is declared, which is all of H.
fn limit_of_piece(signature: &str, h: &str) -> Result<Option<Limit>, usize> {
    let mut model = common::system(signature, "", "", h);
    let parts = [("A".to_owned(), model.h())];
    match declared(&mut model, &parts) {
        Ok(splitting) => Err(splitting.pieces.len()),
        Err((_, refusal)) => Ok(refusal.limit),
    }
}

/// A refusal by a limit names it. The same definition with one term or one degree of freedom less is
/// split, or is refused by its term alone.
#[test]
fn limits_that_are_met_are_named() {
    // Monomials, no two of which have a flow together.
    let monomials = |count| sum_of(count, |k| format!("q^{}*p^{}", 2 * k + 1, 3 * k + 1));
    let search = |count| limit_of_search("q; p", "", &monomials(count));
    assert_eq!(search(8), Err(8));
    assert_eq!(search(9), Ok(Some(Limit::Pieces)));
    assert_eq!(search(33), Ok(Some(Limit::Terms)));
    let piece = |count| limit_of_piece("q; p", &monomials(count));
    assert_eq!(piece(3), Ok(None));
    assert_eq!(piece(37), Ok(Some(Limit::Commuting)));

    // Powers of q*p commute.
    let powers = |count| limit_of_piece("q; p", &sum_of(count, |k| format!("q^{k}*p^{k}")));
    assert_eq!(powers(9), Err(1));
    assert_eq!(powers(10), Ok(Some(Limit::Parts)));

    // Terms without a flow.
    let hard = |count| {
        let terms = sum_of(count, |k| format!("sin({}*q)*cos(p)", k + 1));
        limit_of_search("q; p", "", &terms)
    };
    assert_eq!(hard(5), Ok(None));
    assert_eq!(hard(6), Ok(Some(Limit::Coupled)));
    assert_eq!(hard(12), Ok(Some(Limit::Sums)));

    // A term that joins degrees of freedom, and one without a flow.
    let joined = |count| {
        let h = format!(
            "p1^2/(1 + q1^2) + sin({})",
            sum_of(count, |k| format!("q{k}"))
        );
        limit_of_search(&pairs(count), "", &h)
    };
    assert_eq!(joined(32), Ok(None));
    assert_eq!(joined(33), Ok(Some(Limit::Pairs)));

    // A loop whose body names sites of a ring.
    let body = |count| {
        let sites: Vec<String> = (1..count).map(|k| format!("q[(i + {k}) % N]")).collect();
        let h = format!("sum(i in 0..N) {{ p[i]^2*{} }}", sites.join("*"));
        limit_of_search("q[N]; p[N]", "N", &h)
    };
    assert_eq!(body(4), Err(1));
    assert_eq!(body(5), Ok(Some(Limit::BodyRows)));

    // A chain of five, as a piece of a system of eight or nine.
    let chain = |count| {
        let springs = sum_of(4, |k| format!("(q{k} - q{})^2/{}", k + 1, k + 1));
        let h = format!("{} + {springs}", sum_of(5, |k| format!("p{k}^2/2")));
        limit_of_piece(&pairs(count), &h)
    };
    assert_eq!(chain(8), Err(1));
    assert_eq!(chain(9), Ok(Some(Limit::Components)));
}

/// So does a search that has spent its budget: comparisons, products, expressions. Fewer terms, or lower powers, are
/// far within the budget.
#[test]
fn budgets_that_are_spent_are_named() {
    // Radicands that are equal when they are multiplied out: each pair of terms takes a comparison.
    let squares = ["q^2 + p^2", "(q + p)^2 - 2*q*p", "(q - p)^2 + 2*q*p"];
    let roots = |count| {
        let root = |k: usize| format!("sqrt({k} + {})", squares[k % 3]);
        limit_of_piece("q; p", &sum_of(count, root))
    };
    assert_eq!(roots(6), Err(1));
    assert_eq!(roots(18), Ok(Some(Limit::Parts)));
    assert_eq!(roots(36), Ok(Some(Limit::Comparisons)));

    // Quotients: each comparison takes many products.
    let quotients = |count| {
        let term = |k| format!("sin({k}*x*u + {k}*y*v)/(1 + {k}*x^2*v^2)");
        limit_of_piece("x, y; u, v", &sum_of(count, term))
    };
    assert_eq!(quotients(4), Ok(None));
    assert_eq!(quotients(12), Ok(Some(Limit::Products)));

    // Products of three functions, whose derivatives have many terms.
    let waves = |count| {
        let term = |k| format!("sin({k}*q*p)*exp({k}*q)*cos({k}*p)");
        limit_of_piece("q; p", &sum_of(count, term))
    };
    assert_eq!(waves(4), Ok(None));
    assert_eq!(waves(16), Ok(Some(Limit::Expressions)));

    // Powers that commute: one comparison multiplies their bracket out.
    let powers = |power: u32| {
        let (m, r) = ("x*v - y*u", "x^2 + y^2 + u^2 + v^2");
        limit_of_piece(
            "x, y; u, v",
            &format!("({m})^{power} + ({r} + 1 + {m})^{power}"),
        )
    };
    assert_eq!(powers(3), Err(1));
    assert_eq!(powers(12), Ok(Some(Limit::Comparison)));
}

/// Terms of coordinates alone have a flow without any question, however many and however long they are: they exhaust no
/// limit of the terms beside them.
#[test]
fn a_long_potential_exhausts_no_limit() {
    let series = |x: &str, count| sum_of(count, |k| format!("sin({k}*{x})/{k}^2"));
    let pair = "(q^2 + 1)*(p^2 + 1)/2";
    for count in [10, 40, 700] {
        let apart = format!("{pair} + {}", series("x", count));
        let moving = format!("{pair} + y^2/2 + {}", series("x", count));
        let same = format!("{pair} + {}", series("q", count));
        for (signature, h) in [
            ("q, x; p, y", &apart),
            ("x, q; y, p", &moving),
            ("q; p", &same),
        ] {
            let definition = Definition::of(signature, "", h, 0);
            let subject = Subject::split(&definition).expect("it is split");
            for verdict in verdicts(&subject, 2, 0.0, &mut Random(count as u64)) {
                assert_eq!(verdict, Verdict::Right, "{signature}, {count} terms");
            }
            let mut model = common::system(signature, "", "", h);
            let found = find(&mut model).expect("it is split");
            assert!(found.pieces.len() <= 4, "{signature}, {count} terms");
            // An error is stated only where all of H was followed.
            let error = found.choice.map_or(0.0, |choice| choice.error);
            let is_whole = count < 700 || signature == "q, x; p, y";
            assert_eq!(error.is_finite(), is_whole, "{signature}, {count} terms");
            let parts: Vec<_> = found.pieces.iter().map(|piece| piece.h).collect();
            assert!(check_split(&mut model, &parts).is_ok(), "{signature}");
        }
    }
    // Beside a term without a flow nothing else is blamed.
    for count in [10, 40, 700] {
        let hard = |h: &str| limit_of_search("q; p", "", &format!("{h} + {}", series("q", count)));
        assert_eq!(hard("sin(q)*cos(p)"), Ok(None), "{count} terms");
        assert_eq!(hard("sin(q)*cos(p) + p^2/2"), Ok(None), "{count} terms");
    }
    let declared = format!("p^2/2 + {}", series("q", 33));
    assert_eq!(limit_of_piece("q; p", &declared), Ok(None));
    // Where coordinates and momenta meet, the number of terms and of subexpressions counts.
    let mixed = |count| limit_of_search("q; p", "", &sum_of(count, |k| format!("p*sin({k}*q)")));
    assert_eq!(mixed(33), Ok(Some(Limit::Terms)));
    assert_eq!(mixed(400), Ok(Some(Limit::Subexpressions)));
    let in_loop = sum_of(400, |k| format!("p[i]*sin({k}*q[i])"));
    let in_loop = format!("sum(i in 0..N) {{ {in_loop} }}");
    assert_eq!(
        limit_of_search("q[N]; p[N]", "N", &in_loop),
        Ok(Some(Limit::Subexpressions))
    );
}

/// A question leaves the budget of the next untouched: two terms, each of which takes more than half of the products
/// that a flow may take, are refused because they have no flow.
#[test]
fn a_question_leaves_the_others_their_limits() {
    let hard = |[x, y, u, v]: [&str; 4]| {
        let term =
            |k| format!("sin({k}*{x}*{u} + {k}*{y}*{v})/(1 + {k}*{x}^2*{u}^2 + {k}*{y}^4*{v}^4)");
        format!("exp({})", sum_of(5, term))
    };
    let (one, other) = (hard(["x", "y", "u", "v"]), hard(["a", "b", "c", "d"]));
    let h = format!("{one} + {other} + x*a");
    assert_eq!(limit_of_search("x, y, a, b; u, v, c, d", "", &h), Ok(None));
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
        // Products and quotients of the expressions so far: long, and of the pattern of no form.
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
    assert!(largest <= 4 * EXPRESSIONS, "{largest} nodes");
    assert!(found > 0 && found < all);
}

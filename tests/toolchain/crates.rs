//! Crates that use the library under other names, editions and lints, without `std`, and through
//! each other; and the pages of rustdoc about a definition.
//!
//! Their sources stand in `tests/crates`; packages around them are made in the target directory.

use crate::cargo::{self, Outcome, Package, workspace};

const PACKAGES: &[Package] = &[
    Package::new("systems_2018", "systems.rs")
        .edition("2018")
        .depends("mechanics"),
    Package::new("systems_2021", "systems.rs")
        .edition("2021")
        .depends("mechanics"),
    Package::new("systems_2024", "systems.rs").depends("mechanics"),
    Package::new("facade", "facade.rs").depends("mechanics"),
    Package::new("through", "through.rs").depends_on_package("facade"),
    Package::new("bare", "bare.rs").depends_without_std("mechanics"),
];

fn demand(outcome: Outcome) -> Outcome {
    assert!(outcome.success, "{}", outcome.text);
    outcome
}

#[test]
fn crates_compile_with_lints_denied() {
    let workspace = workspace("crates", PACKAGES);
    let everything = ["--workspace", "--exclude", "bare"];
    if workspace.cargo(&["clippy", "--version"]).success {
        demand(workspace.cargo(&[&["clippy"], &everything[..]].concat()));
    } else {
        cargo::note("skipped: clippy is not installed; lints of rustc only");
        demand(workspace.cargo(&[&["check"], &everything[..]].concat()));
    }
    // Alone, since the features of shared dependencies are united.
    demand(workspace.cargo(&["check", "--package", "bare"]));
}

#[test]
fn documentation_reads_well() {
    let workspace = workspace("crates", PACKAGES);
    demand(workspace.cargo(&["doc", "--no-deps", "--package", "systems_2024"]));
    let pages: [(&str, &[&str]); 3] = [
        (
            "Driven",
            &[
                "A driven oscillator.",
                "H(q; p; t) = p^2/2 + (q^2/2 + q^4/4) - a*q*cos(omega*t)",
                "H is separable",
                "H depends on time",
                "dq/dt = p",
                "dp/dt = -q - q^3 + a*cos(omega*t)",
                r"\frac{p^{2}}{2}",
            ],
        ),
        (
            "Coupled",
            &["H is not separable: see the term <code>0.5*q^2*p^2</code>"],
        ),
        (
            "Toda",
            &[
                "H(q[N]; p[N]) = sum(i in 0..N) { ",
                "dq[k]/dt = p[k]",
                r"\sum_{i=0}^{N - 1}",
            ],
        ),
    ];
    for (system, due) in pages {
        let page = workspace.doc(&format!("systems_2024/struct.{system}.html"));
        for due in due {
            assert!(
                page.contains(due),
                "`{due}` is not on the page of {system}:\n{page}"
            );
        }
    }
}

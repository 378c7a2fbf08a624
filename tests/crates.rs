//! Crates that use the library under other names, editions and lints, without `std`, and through
//! each other; and what rustdoc makes of a definition.
//!
//! Their sources stand in `tests/crates`; packages around them are made in the target directory.

mod cargo;

use cargo::{Outcome, Package, workspace};

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
    // Alone, since features of what all depend on are united.
    demand(workspace.cargo(&["check", "--package", "bare"]));
}

#[test]
fn documentation_reads_well() {
    let workspace = workspace("crates", PACKAGES);
    demand(workspace.cargo(&["doc", "--no-deps", "--package", "systems_2024"]));
    let page = workspace.doc("systems_2024/struct.Driven.html");
    for due in [
        "A driven oscillator.",
        "H(q; p; t) = ",
        "cos(omega*t)",
        "dq/dt = p",
        "dp/dt = ",
    ] {
        assert!(page.contains(due), "`{due}` is not on the page:\n{page}");
    }
}

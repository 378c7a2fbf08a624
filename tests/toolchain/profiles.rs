//! Code that is compiled without optimisation has the bits of these tests, which are compiled with it.

use crate::cargo::{Package, workspace, write};
use std::fs::create_dir_all;

#[path = "../crates/profiles.rs"]
mod runs;

const STEP: f64 = 0.0625;

#[test]
fn debug_and_optimised_code_have_the_same_bits() {
    let package = Package::new("profiles", "profiles.rs").depends("mechanics");
    let workspace = workspace("profiles", &[package]);
    let folder = workspace.path.join("profiles/src");
    create_dir_all(&folder).expect("the target directory can be written to");
    let print = format!(
        "fn main() {{\n    for (kind, end) in profiles::ends({STEP:?}) {{\n        println!(\"{{kind}}: {{end:x}}\");\n    }}\n}}\n"
    );
    write(&folder.join("main.rs"), &print);
    let debug = workspace.cargo(&["run", "--quiet"]);
    assert!(debug.success, "{}", debug.text);
    let ends = runs::ends(STEP);
    let optimised: String = (ends.iter())
        .map(|(kind, end)| format!("{kind}: {end:x}\n"))
        .collect();
    assert_eq!(debug.printed, optimised);
    // The numbers tell ends apart that differ by rounding.
    for (one, other) in ends.iter().zip(runs::ends(STEP.next_up())) {
        assert_ne!(*one, other);
    }
}

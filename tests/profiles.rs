//! Code that is compiled without optimisation has the bits of these tests, which are compiled with it.

use crate::cargo::{Package, workspace, write};

#[path = "crates/profiles.rs"]
mod runs;

#[test]
fn debug_and_optimised_code_have_the_same_bits() {
    let package = Package::new("profiles", "profiles.rs").depends("mechanics");
    let workspace = workspace("profiles", &[package]);
    let print = "fn main() {\n    for (kind, end) in profiles::ends() {\n        println!(\"{kind}: {end:x}\");\n    }\n}\n";
    let program = workspace.path.join("profiles/src/main.rs");
    std::fs::create_dir_all(program.parent().expect("a folder"))
        .expect("the target directory can be written to");
    write(&program, print);
    let debug = workspace.cargo(&["run", "--quiet"]);
    assert!(debug.success, "{}", debug.text);
    let optimised: String = runs::ends()
        .iter()
        .map(|(kind, end)| format!("{kind}: {end:x}\n"))
        .collect();
    assert_eq!(debug.printed, optimised);
}

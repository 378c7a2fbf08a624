//! No test is left out: every file beside the root of a crate's test binary is a module of it, or a
//! binary of its own that the manifest names.

use std::fs;
use std::path::Path;

#[test]
fn every_file_of_tests_is_a_module() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for directory in [
        "tests",
        "hamiltonian-symbolic/tests",
        "hamiltonian-lanes/tests",
        "hamiltonian-core/tests",
        "hamiltonian-runtime/tests",
    ] {
        let directory = root.join(directory);
        let main = fs::read_to_string(directory.join("main.rs")).expect("there is a root");
        // What takes long to compile is a binary of its own.
        let manifest = directory.with_file_name("Cargo.toml");
        let manifest = fs::read_to_string(manifest).expect("it is a package");
        for entry in fs::read_dir(&directory).expect("it can be listed") {
            let path = entry.expect("it can be listed").path();
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            if path.extension().is_some_and(|extension| extension == "rs") && name != "main" {
                let module = format!("mod {name};");
                let target = format!("[[test]]\nname = \"{name}\"\n");
                let mut modules = main.lines().map(|line| line.trim_start_matches("pub "));
                assert!(
                    modules.any(|line| line == module) || manifest.contains(&target),
                    "{}",
                    path.display()
                );
            }
        }
    }
}

//! No test is left out: each crate has one test binary, and every file beside its root is a module
//! of it.

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
    ] {
        let directory = root.join(directory);
        let main = fs::read_to_string(directory.join("main.rs")).expect("there is a root");
        for entry in fs::read_dir(&directory).expect("it can be listed") {
            let path = entry.expect("it can be listed").path();
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            if path.extension().is_some_and(|extension| extension == "rs") && name != "main" {
                let module = format!("mod {name};");
                assert!(
                    main.lines()
                        .any(|line| line.trim_start_matches("pub ") == module),
                    "{}",
                    path.display()
                );
            }
        }
    }
}

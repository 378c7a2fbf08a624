//! Packages made for a test, and the words of cargo about them.
//!
//! They share a target directory of their own, so that their dependencies are compiled once.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A package with one source file of `tests/crates`, or with programs that are written later.
#[derive(Debug, Clone, Copy)]
pub struct Package {
    name: &'static str,
    source: &'static str,
    edition: &'static str,
    dependency: Dependency,
}

#[derive(Debug, Clone, Copy)]
enum Dependency {
    /// The library under another name, with or without `std`.
    Library(&'static str, bool),
    /// Another package of the workspace.
    Package(&'static str),
}

impl Package {
    /// A package that depends on the library under its own name.
    pub const fn new(name: &'static str, source: &'static str) -> Package {
        Package {
            name,
            source,
            edition: "2024",
            dependency: Dependency::Library("hamiltonian", true),
        }
    }

    /// Of another edition.
    pub const fn edition(self, edition: &'static str) -> Package {
        Package { edition, ..self }
    }

    /// On the library under another name.
    pub const fn depends(self, name: &'static str) -> Package {
        let dependency = Dependency::Library(name, true);
        Package { dependency, ..self }
    }

    /// On the library under another name, without its features.
    pub const fn depends_without_std(self, name: &'static str) -> Package {
        let dependency = Dependency::Library(name, false);
        Package { dependency, ..self }
    }

    /// On another package, and on the library only through it.
    pub const fn depends_on_package(self, name: &'static str) -> Package {
        let dependency = Dependency::Package(name);
        Package { dependency, ..self }
    }

    fn manifest(&self) -> String {
        let root = env!("CARGO_MANIFEST_DIR");
        let dependency = match self.dependency {
            Dependency::Library(name, std) => format!(
                "{name} = {{ package = \"hamiltonian-dynamics\", path = {root:?}, default-features = {std} }}"
            ),
            Dependency::Package(name) => format!("{name} = {{ path = \"../{name}\" }}"),
        };
        let library = match self.source {
            "" => String::new(),
            source => format!(
                "[lib]\npath = {:?}\n",
                Path::new(root).join("tests/crates").join(source)
            ),
        };
        format!(
            "[package]\nname = {:?}\nversion = \"0.0.0\"\nedition = {:?}\n{library}[dependencies]\n{dependency}\n",
            self.name, self.edition
        )
    }
}

/// A workspace in the target directory.
#[derive(Debug)]
pub struct Workspace {
    /// Its folder.
    pub path: PathBuf,
    target: PathBuf,
}

/// The outcome of a call of cargo.
#[derive(Debug)]
pub struct Outcome {
    /// True if it went well.
    pub success: bool,
    /// Everything it said.
    pub text: String,
    /// The output of the program that cargo ran.
    pub printed: String,
}

/// Writes a workspace.
pub fn workspace(name: &str, packages: &[Package]) -> Workspace {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let path = directory.join(name);
    for package in packages {
        let place = path.join(package.name);
        fs::create_dir_all(&place).expect("the target directory can be written to");
        write(&place.join("Cargo.toml"), &package.manifest());
    }
    let members: Vec<&str> = packages.iter().map(|package| package.name).collect();
    write(
        &path.join("Cargo.toml"),
        &format!(
            "[workspace]\nresolver = \"3\"\nmembers = {members:?}\n[profile.dev]\ndebug = 0\nincremental = false\n"
        ),
    );
    let lock = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.lock");
    let lock = fs::read_to_string(lock).expect("Cargo.lock is committed");
    write(&path.join("Cargo.lock"), &lock);
    Workspace {
        path,
        target: directory.join("packages"),
    }
}

/// Writes a file unless it holds the text already, so that nothing is compiled again for nothing.
pub fn write(path: &Path, text: &str) {
    if fs::read_to_string(path).is_ok_and(|old| old == text) {
        return;
    }
    fs::write(path, text).expect("the target directory can be written to");
}

impl Workspace {
    /// Runs cargo in the workspace, without the network and with warnings of rustdoc denied.
    pub fn cargo(&self, arguments: &[&str]) -> Outcome {
        let output = Command::new(env!("CARGO"))
            .args(arguments)
            .current_dir(&self.path)
            .env("CARGO_TARGET_DIR", &self.target)
            .env("CARGO_NET_OFFLINE", "true")
            .env("CARGO_TERM_COLOR", "never")
            .env("RUSTDOCFLAGS", "-D warnings")
            .output()
            .expect("cargo runs");
        Outcome {
            success: output.status.success(),
            text: String::from_utf8_lossy(&output.stderr).into_owned(),
            printed: String::from_utf8_lossy(&output.stdout).into_owned(),
        }
    }

    /// A page of the documentation that was made.
    pub fn doc(&self, page: &str) -> String {
        let path = self.target.join("doc").join(page);
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    }
}

/// The program that expands definitions, compiled without optimisation as cargo compiles macros.
pub fn show() -> PathBuf {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("packages");
    let output = Command::new(env!("CARGO"))
        .args([
            "build",
            "--package",
            "hamiltonian-macros",
            "--example",
            "show",
        ])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("CARGO_TARGET_DIR", &target)
        // As the packages are compiled: most of it is there already.
        .env("CARGO_PROFILE_DEV_DEBUG", "0")
        .env("CARGO_PROFILE_DEV_INCREMENTAL", "false")
        .env("CARGO_NET_OFFLINE", "true")
        .env("CARGO_TERM_COLOR", "never")
        .output()
        .expect("cargo runs");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    target
        .join("debug/examples")
        .join(format!("show{}", std::env::consts::EXE_SUFFIX))
}

/// Says something whether the test passes or not; the harness keeps `eprintln!` to itself.
pub fn note(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

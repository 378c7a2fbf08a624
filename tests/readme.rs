//! The README and the book: what they print, what they link to, and the programs they promise.

use hamiltonian::prelude::*;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

hamiltonian! {
    /// The pendulum of the README.
    pub struct Pendulum { m = 1.0, l = 10.0, g = 9.81 }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)
}

#[test]
fn its_first_program_prints_what_it_says() -> Result<(), Error> {
    let pendulum = Pendulum {
        l: 2.0,
        ..Default::default()
    };
    let start = State::new([0.5], [0.0]);
    let mut run = Integrator::new(&pendulum, StormerVerlet::default(), start, 1e-3)?
        .observe(EnergyDrift::new());
    run.advance(10_000)?;
    let printed = format!(
        "theta({}) = {:.6}\nmax |ΔH/H₀| = {:.1e}\n",
        run.state().t,
        run.state().q[0],
        run.observer().max_relative()
    );
    let readme = include_str!("../README.md").replace('\r', "");
    assert!(readme.contains(&printed), "the README lacks:\n{printed}");
    Ok(())
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    let text =
        fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    text.replace('\r', "")
}

/// The chapters of the book.
fn chapters() -> Vec<PathBuf> {
    let book = root().join("book/src");
    let mut found = Vec::new();
    for folder in [book.clone(), book.join("tour")] {
        let entries = fs::read_dir(&folder).expect("the folder of the book");
        let files = entries.map(|entry| entry.expect("an entry").path());
        found.extend(files.filter(|path| path.extension().is_some_and(|end| end == "md")));
    }
    found.sort();
    found
}

/// Lines outside listings, and the listings.
fn prose_and_listings(text: &str) -> (Vec<&str>, Vec<String>) {
    let (mut prose, mut listings, mut open) = (Vec::new(), Vec::new(), None::<String>);
    for line in text.lines() {
        match (&mut open, line.starts_with("```")) {
            (None, true) => open = Some(format!("{line}\n")),
            (None, false) => prose.push(line),
            (Some(_), true) => listings.extend(open.take()),
            (Some(listing), false) => {
                listing.push_str(line);
                listing.push('\n');
            }
        }
    }
    (prose, listings)
}

/// The anchor that mdBook and GitHub make of a heading.
fn anchor(heading: &str) -> String {
    let kept = heading.trim_start_matches('#').trim().chars();
    kept.filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'))
        .map(|c| if c == ' ' { '-' } else { c })
        .flat_map(char::to_lowercase)
        .collect()
}

fn anchors(text: &str) -> BTreeSet<String> {
    let (prose, _) = prose_and_listings(text);
    let headings = prose.into_iter().filter(|line| line.starts_with('#'));
    headings.map(anchor).collect()
}

/// The targets of links, without those of other sites.
fn links(text: &str) -> Vec<String> {
    let (prose, _) = prose_and_listings(text);
    let mut found = Vec::new();
    for line in prose {
        // Code between backquotes has no links.
        let plain: String = line.split('`').step_by(2).collect();
        for (_, rest) in plain
            .match_indices("](")
            .map(|(at, _)| plain.split_at(at + 2))
        {
            let target = rest.split(')').next().unwrap_or_default();
            if !target.contains("://") {
                found.push(target.to_owned());
            }
        }
    }
    found
}

#[test]
fn links_lead_to_files_and_headings() {
    let mut files = chapters();
    for name in ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"] {
        files.push(root().join(name));
    }
    let mut count = 0;
    for file in files {
        let text = read(&file);
        for target in links(&text) {
            let (path, heading) = target.split_once('#').unwrap_or((&target, ""));
            let there = match path {
                "" => file.clone(),
                path => file.parent().expect("a folder").join(path),
            };
            assert!(there.exists(), "{}: no file {target}", file.display());
            let known = heading.is_empty() || anchors(&read(&there)).contains(heading);
            assert!(known, "{}: no heading {target}", file.display());
            count += 1;
        }
    }
    assert!(count > 80, "{count} links were found");
}

/// The contents name each chapter once, and each chapter with listings is among the doc tests.
#[test]
fn each_chapter_is_in_the_contents_and_tested() {
    let contents = links(&read(&root().join("book/src/SUMMARY.md")));
    let facade = read(&root().join("src/lib.rs"));
    for chapter in chapters() {
        let name = chapter.strip_prefix(root().join("book/src"));
        let name = name
            .expect("a chapter")
            .to_string_lossy()
            .replace('\\', "/");
        if name == "SUMMARY.md" {
            continue;
        }
        let named = contents.iter().filter(|target| **target == name).count();
        assert_eq!(named, 1, "{name} in SUMMARY.md");
        let (_, listings) = prose_and_listings(&read(&chapter));
        let compiled = listings.iter().any(|listing| {
            listing.starts_with("```rust\n") || listing.starts_with("```rust,compile_fail")
        });
        let tested = facade.contains(&format!("\"{name}\""))
            || facade.contains(&format!("\"../book/src/{name}\""));
        assert!(tested || !compiled, "{name} in src/lib.rs");
    }
}

/// Each link of the chapter `tasks.md` leads to a heading whose first listing in Rust is a program of at
/// most 40 lines.
#[test]
fn tasks_are_short_programs() {
    let book = root().join("book/src");
    let tasks = links(&read(&book.join("tasks.md")));
    assert!(tasks.len() >= 18, "{} tasks", tasks.len());
    for task in tasks {
        let (path, heading) = task.split_once('#').expect("a heading");
        let text = read(&book.join(path));
        let after = text
            .lines()
            .skip_while(|line| !line.starts_with('#') || anchor(line) != heading);
        let after: Vec<&str> = after.collect();
        let (_, listings) = prose_and_listings(&after.join("\n"));
        let program = listings
            .iter()
            .find(|listing| listing.starts_with("```rust"));
        let program = program.unwrap_or_else(|| panic!("{task} has no program"));
        let lines = program.lines().count() - 1;
        assert!(
            program.contains("fn main()") && lines <= 40,
            "{task}: {lines} lines"
        );
    }
}

/// The chapter on other crates shows the programs of the package that compiles them.
#[test]
fn programs_elsewhere_are_those_of_the_package() {
    let (_, listings) = prose_and_listings(&read(&root().join("book/src/elsewhere.md")));
    for name in ["solver", "optimiser"] {
        let program = read(&root().join(format!("book/elsewhere/src/bin/{name}.rs")));
        let shown = format!("```rust,ignore\n{program}");
        assert!(
            listings.contains(&shown),
            "elsewhere.md lacks {name}.rs as it is"
        );
    }
}

/// The files of a folder and of its folders.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let found = paths.map(|path| match path.is_dir() {
        true => sources(&path),
        false => vec![path],
    });
    found.flatten().collect()
}

/// Examples of the inner crates are programs of users: they name the facade alone, in hidden lines too.
#[test]
fn examples_import_the_facade() {
    let mut listings = 0;
    for crate_ in ["real", "lanes", "core"] {
        for file in sources(&root().join(format!("hamiltonian-{crate_}/src"))) {
            let mut within = false;
            for line in read(&file).lines().map(str::trim_start) {
                let text = line
                    .strip_prefix("///")
                    .or_else(|| line.strip_prefix("//!"));
                let text = text.or_else(|| line.strip_prefix("#[doc = concat!(\""));
                let Some(text) = text.map(str::trim_start) else {
                    continue;
                };
                if text.starts_with("```") {
                    within = !within;
                    listings += usize::from(within);
                } else if within {
                    let inner = [
                        "hamiltonian_core",
                        "hamiltonian_lanes",
                        "hamiltonian_real",
                        "private::",
                    ];
                    let named = inner.iter().find(|name| text.contains(*name));
                    assert!(named.is_none(), "{}: {text}", file.display());
                }
            }
            assert!(!within, "{}: a listing does not end", file.display());
        }
    }
    assert!(listings > 150, "{listings} listings were found");
}

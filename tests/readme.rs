//! The README and the book: what they print, what they link to, and the programs they promise.

use hamiltonian::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

hamiltonian! {
    /// The pendulum of the README.
    pub struct Pendulum { m = 1.0, l = 10.0, g = 9.81 }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)
}

#[test]
fn pages_of_the_root_are_short() {
    for (name, most) in [("README.md", 150), ("ARCHITECTURE.md", 220)] {
        let lines = read(&root().join(name)).lines().count();
        assert!(lines <= most, "{name} has {lines} lines, more than {most}");
    }
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

/// The README of the macro, whose package cannot depend on the library, shows the tested example of its front page.
#[test]
fn the_macro_shows_a_tested_example() {
    let (_, listings) = prose_and_listings(&read(&root().join("hamiltonian-macros/README.md")));
    let [listing] = &listings[..] else {
        panic!("{listings:?}");
    };
    let shown = listing.strip_prefix("```rust\n").expect("Rust");
    let page = read(&root().join("src/lib.rs")).replace("//! ", "");
    assert!(page.replace("//!\n", "\n").contains(shown), "{shown}");
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

/// The listings in Rust between a heading and the next one.
fn programs_below(text: &str, heading: &str) -> Vec<String> {
    let mut in_listing = false;
    let mut section: Option<Vec<&str>> = None;
    for line in text.lines() {
        in_listing ^= line.starts_with("```");
        let is_heading = !in_listing && line.starts_with('#');
        match &mut section {
            Some(_) if is_heading => break,
            Some(lines) => lines.push(line),
            None if is_heading && anchor(line) == heading => section = Some(vec![]),
            None => {}
        }
    }
    let (_, mut listings) = prose_and_listings(&section.unwrap_or_default().join("\n"));
    listings.retain(|listing| listing.starts_with("```rust"));
    listings
}

/// The programs among listings; an error for a listing of more than 40 lines.
fn short_programs(listings: &[String]) -> Result<usize, String> {
    for listing in listings {
        let lines = listing.lines().count() - 1;
        if lines > 40 {
            return Err(format!("{lines} lines:\n{listing}"));
        }
    }
    let programs = listings.iter().filter(|one| one.contains("fn main()"));
    Ok(programs.count())
}

/// Each link of the chapter `tasks.md` leads to a heading with a program of its own, and all listings below the heading
/// have at most 40 lines.
#[test]
fn tasks_are_short_programs() {
    let book = root().join("book/src");
    let tasks = links(&read(&book.join("tasks.md")));
    let mut listed = BTreeMap::new();
    for task in tasks.iter().filter(|task| task.contains(".md#")) {
        *listed.entry(task.as_str()).or_insert(0) += 1;
    }
    assert!(listed.len() >= 18, "{} headings", listed.len());
    for (task, count) in listed {
        let (path, heading) = task.split_once('#').expect("a heading");
        let found = short_programs(&programs_below(&read(&book.join(path)), heading));
        let found = found.unwrap_or_else(|error| panic!("{task}: {error}"));
        assert!(found >= count, "{task}: {found} programs for {count} tasks");
    }
}

#[test]
fn long_listings_are_found_wherever_they_stand() {
    let program =
        |lines: usize| format!("```rust\nfn main() {{}}\n{}```\n", "# \n".repeat(lines - 1));
    let page = |second| {
        format!(
            "## One\n{}text\n{}## Two\n{}",
            program(1),
            program(second),
            program(99)
        )
    };
    assert_eq!(short_programs(&programs_below(&page(40), "one")), Ok(2));
    assert!(short_programs(&programs_below(&page(41), "one")).is_err());
    assert!(programs_below(&page(40), "three").is_empty());
}

/// Each example has its picture, of at most 50 KB, in the book and in the API pages, under the same words, and
/// a script makes it.
#[test]
fn each_example_has_its_picture() {
    let book = root().join("book/src");
    let (chapter, facade) = (
        read(&book.join("gallery.md")),
        read(&root().join("src/lib.rs")),
    );
    let script = read(&root().join("scripts/gallery.sh"));
    let mut pictures = BTreeSet::new();
    for line in chapter.lines() {
        let Some((caption, file)) = line
            .strip_prefix("![")
            .and_then(|l| l.split_once("](images/"))
        else {
            continue;
        };
        let name = file.strip_suffix(".svg)").expect("a picture");
        assert!(
            chapter.contains(&format!("## {name}\n\n{caption}\n")),
            "{name}"
        );
        assert!(
            facade.contains(&format!("    {name} \"{caption}\"\n")),
            "{name} in src/lib.rs"
        );
        assert!(
            script.contains(&format!("\n{name} ")),
            "{name} in scripts/gallery.sh"
        );
        let picture = read(&book.join(format!("images/{name}.svg")));
        assert!(picture.len() <= 51_200, "{name}: {} bytes", picture.len());
        // An empty line ends a block of HTML in Markdown.
        assert!(!picture.contains("\n\n"), "{name} has an empty line");
        pictures.insert(name.to_owned());
    }
    for file in fs::read_dir(book.join("images")).expect("the folder of the pictures") {
        let name = file.expect("an entry").file_name();
        let name = name.to_string_lossy();
        let name = name.strip_suffix(".svg").expect("a picture");
        assert!(pictures.contains(name), "{name} in gallery.md");
    }
    for file in fs::read_dir(root().join("examples")).expect("the folder of the examples") {
        let name = file.expect("an entry").file_name();
        let Some(name) = name
            .to_string_lossy()
            .strip_suffix(".rs")
            .map(str::to_owned)
        else {
            continue;
        };
        let drawn = pictures.iter().any(|picture| picture.starts_with(&name));
        assert!(
            drawn || chapter.contains(&format!("`{name}`")),
            "{name} in gallery.md"
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

/// Examples of all crates, of the README and of the book are programs of users: they name the facade alone, in
/// hidden lines too. Only the front pages of core, lanes and real show those crates by themselves.
#[test]
fn examples_import_the_facade() {
    let inner = [
        "hamiltonian_core",
        "hamiltonian_lanes",
        "hamiltonian_real",
        "hamiltonian_macros",
        "private::",
    ];
    let mut listings = 0;
    let folders = [
        "src",
        "hamiltonian-core/src",
        "hamiltonian-lanes/src",
        "hamiltonian-real/src",
    ];
    for file in folders
        .into_iter()
        .flat_map(|folder| sources(&root().join(folder)))
    {
        let text = read(&file);
        let front_pages = [
            ("hamiltonian-core/src/lib.rs", "hamiltonian_core"),
            ("hamiltonian-lanes/src/lib.rs", "hamiltonian_lanes"),
            ("hamiltonian-real/src/lib.rs", "hamiltonian_real"),
        ];
        let own = front_pages.iter().find(|(page, _)| file.ends_with(page));
        let is_page = file.extension().is_some_and(|end| end == "md");
        let mut within = false;
        for line in text.lines().map(str::trim_start) {
            let doc = ["///", "//!", "#[doc = concat!(\""]
                .into_iter()
                .find_map(|start| line.strip_prefix(start));
            let Some(doc) = doc.or(is_page.then_some(line)).map(str::trim_start) else {
                continue;
            };
            if doc.starts_with("```") {
                within = !within;
                listings += usize::from(within);
            } else if within || is_page {
                // The pages are parts of listings.
                let is_named =
                    |name: &&&str| doc.contains(**name) && own.is_none_or(|own| own.1 != **name);
                let named = inner.iter().find(is_named);
                assert!(named.is_none(), "{}: {doc}", file.display());
            }
        }
        assert!(!within, "{}: a listing does not end", file.display());
    }
    assert!(listings > 150, "{listings} listings were found");
    for page in chapters().into_iter().chain([root().join("README.md")]) {
        for listing in prose_and_listings(&read(&page)).1 {
            let named = inner.iter().find(|name| listing.contains(*name));
            assert!(named.is_none(), "{}: {listing}", page.display());
        }
    }
}
